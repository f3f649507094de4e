//! The flow about a sphere that moves along a plane wall, in bispherical coordinates.

use super::dual::Dual;
use std::f64::consts::SQRT_2;

/// Terms of a series, in parts of 1/α: beyond, they are below rounding.
const TERMS: f64 = 20.0;

/// How the sphere moves along the wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Motion {
    /// With unit velocity.
    Translation,
    /// With unit spin about an axis along the wall, lengths in units of R sinh α.
    Rotation,
}

/// The flow about a sphere that moves along a wall, harmonic by harmonic.
///
///   p = Q cos φ, …,   Q = Σ (B_n cosh + C_n sinh) P′_n,   U₀ = Σ (D_n cosh + E_n sinh) P_n
///   U₂ = Σ (F_n cosh + G_n sinh) P″_n
///
/// No slip gives all of them from the A_n of the velocity across the wall, for instance C_n = −2 k_n X_n + c_n with k_n
/// = (n + ½) coth (n + ½)α − coth α; that the fluid keeps its volume gives
///
///   p_n [(n−1)A_{n−1}/(2n−1) − nA_n/(2n+1)] − q_n [(n+1)A_n/(2n+1) − (n+2)A_{n+1}/(2n+3)] = ½ r_n
///   p_n = (2n−1)k_{n−1} − (2n−3)k_n,   q_n = (2n+5)k_n − (2n+3)k_{n+1}
///   r_n = 5c_n − (n−1)c_{n−1} + (n+2)c_{n+1} − e_{n−1} + 2e_n − e_{n+1}
///         + (n−2)(n−1)g_{n−1} − 2(n−1)(n+2)g_n + (n+2)(n+3)g_{n+1}
///
/// where c, e, g are what the motion of the sphere adds to C, E, G.
pub(super) struct Parallel<'a> {
    harmonics: &'a Harmonics,
    motion: Motion,
    /// A_n; zero at both ends.
    a: Vec<Dual>,
}

/// What harmonics at a height have in common.
pub(super) struct Harmonics {
    pub alpha: Dual,
    pub sinh: Dual,
    cosh: Dual,
    coth: Dual,
    /// How many are summed.
    pub terms: usize,
    /// e^(−(n+½)α).
    pub falls: Vec<Dual>,
    /// 1/sinh (n+½)α.
    over: Vec<Dual>,
    /// k_n.
    k: Vec<Dual>,
}

impl Harmonics {
    /// At a height, cosh α; beyond 20/α terms are below rounding.
    pub fn at(alpha: Dual) -> Self {
        let terms = (TERMS / alpha.value) as usize + 10;
        let coth = alpha.coth();
        let (mut falls, mut over, mut k) = (Vec::new(), Vec::new(), Vec::new());
        for n in 0..terms + 3 {
            let m = n as f64 + 0.5;
            let x = m * alpha;
            let fall = (-x).exp();
            let open = Dual { value: -libm::expm1(-2.0 * x.value), slope: 2.0 * fall.value * fall.value * x.slope };
            let sink = 2.0 * (fall / open);
            falls.push(fall);
            over.push(sink);
            k.push(m * (Dual::constant(1.0) + fall * sink) - coth);
        }
        Self { alpha, sinh: alpha.sinh(), cosh: alpha.cosh(), coth, terms, falls, over, k }
    }
}

impl<'a> Parallel<'a> {
    pub fn new(harmonics: &'a Harmonics, motion: Motion) -> Self {
        let mut this = Self { harmonics, motion, a: vec![Dual::default(); harmonics.terms + 3] };
        this.solve();
        this
    }

    /// e^(−(n+½)α) and 1/sinh (n+½)α.
    fn fall(&self, n: usize) -> [Dual; 2] {
        [self.harmonics.falls[n], self.harmonics.over[n]]
    }

    /// e^(−(n−½)α)/(2n−1) − e^(−(n+3/2)α)/(2n+3).
    fn difference(&self, n: usize) -> Dual {
        let m = n as f64;
        let [before, after] = [n - 1, n + 1].map(|n| self.fall(n)[0]);
        1.0 / (2.0 * m - 1.0) * before - 1.0 / (2.0 * m + 3.0) * after
    }

    fn c(&self, n: usize) -> Dual {
        match self.motion {
            Motion::Rotation if n > 0 => -2.0 * SQRT_2 * (self.difference(n) * self.fall(n)[1] / self.harmonics.sinh),
            Motion::Rotation | Motion::Translation => Dual::default(),
        }
    }

    fn e(&self, n: usize) -> Dual {
        let [fall, over] = self.fall(n);
        match self.motion {
            Motion::Translation => 2.0 * SQRT_2 * (fall * over),
            Motion::Rotation => {
                let m = n as f64;
                let before = if n > 0 { m / (2.0 * m - 1.0) * self.fall(n - 1)[0] } else { Dual::default() };
                let after = (m + 1.0) / (2.0 * m + 3.0) * self.fall(n + 1)[0];
                let root = self.harmonics.cosh * fall - before - after;
                SQRT_2 * (((2.0 * m + 1.0) * fall - root / self.harmonics.sinh) * over)
            }
        }
    }

    fn g(&self, n: usize) -> Dual {
        match self.motion {
            Motion::Rotation if n > 1 => 2.0 * SQRT_2 * (self.difference(n) * self.fall(n)[1] / self.harmonics.sinh),
            Motion::Rotation | Motion::Translation => Dual::default(),
        }
    }

    /// ½ r_n.
    fn side(&self, n: usize) -> Dual {
        let m = n as f64;
        let turned = match self.motion {
            Motion::Translation => Dual::default(),
            Motion::Rotation => {
                5.0 * self.c(n) - (m - 1.0) * self.c(n - 1)
                    + (m + 2.0) * self.c(n + 1)
                    + (m - 2.0) * (m - 1.0) * self.g(n - 1)
                    - 2.0 * (m - 1.0) * (m + 2.0) * self.g(n)
                    + (m + 2.0) * (m + 3.0) * self.g(n + 1)
            }
        };
        0.5 * (turned - self.e(n - 1) + 2.0 * self.e(n) - self.e(n + 1))
    }

    /// Solves the tridiagonal system.
    fn solve(&mut self) {
        let Harmonics { k, terms, .. } = self.harmonics;
        let terms = *terms;
        let (mut diagonal, mut upper) = (vec![Dual::default(); terms + 1], vec![Dual::default(); terms + 1]);
        for n in 1..=terms {
            let m = n as f64;
            let p = (2.0 * m - 1.0) * k[n - 1] - (2.0 * m - 3.0) * k[n];
            let q = (2.0 * m + 5.0) * k[n] - (2.0 * m + 3.0) * k[n + 1];
            let lower = (m - 1.0) / (2.0 * m - 1.0) * p;
            diagonal[n] = -(m / (2.0 * m + 1.0) * p) - (m + 1.0) / (2.0 * m + 1.0) * q;
            upper[n] = (m + 2.0) / (2.0 * m + 3.0) * q;
            let mut side = self.side(n);
            if n > 1 {
                let factor = lower / diagonal[n - 1];
                diagonal[n] = diagonal[n] - factor * upper[n - 1];
                side = side - factor * self.a[n - 1];
            }
            self.a[n] = side;
        }
        for n in (1..=terms).rev() {
            self.a[n] = (self.a[n] - upper[n] * self.a[n + 1]) / diagonal[n];
        }
    }

    /// Σ E_n + n(n+1) C_n of the force, and the sum of the torque.
    pub fn sums(&self) -> [Dual; 2] {
        let Harmonics { k, coth, terms, .. } = self.harmonics;
        let coth = *coth;
        let (mut force, mut torque) = (Dual::default(), Dual::default());
        for (n, k) in k.iter().enumerate().take(terms + 1) {
            let m = n as f64;
            let (before, here, after) = (if n > 0 { self.a[n - 1] } else { Dual::default() }, self.a[n], self.a[n + 1]);
            let x = (m - 1.0) / (2.0 * m - 1.0) * before - here + (m + 2.0) / (2.0 * m + 3.0) * after;
            let y = (m - 1.0) * m / (2.0 * m - 1.0) * before - (m + 1.0) * (m + 2.0) / (2.0 * m + 3.0) * after;
            let b = (m - 1.0) * before - (2.0 * m + 1.0) * here + (m + 2.0) * after;
            let d = 0.5 * ((m + 1.0) * (m + 2.0) * after - (m - 1.0) * m * before);
            let c = if n > 0 { self.c(n) - 2.0 * (*k * x) } else { Dual::default() };
            let e = *k * y + self.e(n);
            let fall = self.fall(n)[0];
            let (harmonics, small) = (m * (m + 1.0), fall * fall);
            let weight = Dual::constant(2.0 * m + 1.0) - coth;
            force = force + e + harmonics * c;
            let odd = harmonics * (2.0 * here + c * coth) - weight * e;
            let even = harmonics * (b * coth) - weight * d;
            torque = torque + (Dual::constant(2.0) + small) * odd + (Dual::constant(2.0) - small) * even;
        }
        [force, torque]
    }
}
