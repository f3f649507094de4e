//! The resistance of a rigid sphere beside a plane wall, in a fluid at rest: exact.
//!
//!   f = −6πηR [f_⊥ nn + f_∥ (1 − nn)] v − 8πηR² c n × ω,   τ = 8πηR² c n × v − 8πηR³ [g_⊥ nn + g_∥ (1 − nn)] ω
//!
//! n is the normal of the wall into the fluid. In bispherical coordinates, cosh α = h/R,
//!
//!   f_⊥ = (4/3) sinh α Σ n(n+1)/((2n−1)(2n+3)) [(2 sinh mα + m sinh 2α)/(4 sinh²(mα/2) − m² sinh²α) − 1],   m = 2n + 1
//!   g_⊥ = sinh³α Σ 1/sinh³ nα
//!
//! and f_∥, c, g_∥ are sums over the solution A_n of a tridiagonal system (`harmonics`). A series takes 20/α terms.
//! Below a gap of 1e-4 R what lubrication makes singular is added to the values there,
//!
//!   f_⊥  1/ξ − (1/5) ln ξ − (1/21) ξ ln ξ      f_∥  −(8/15) ln ξ − (64/375) ξ ln ξ
//!   c    −(1/10) ln ξ − (43/250) ξ ln ξ          g_∥  −(2/5) ln ξ − (66/125) ξ ln ξ
//!                                                g_⊥  ½ ξ ln ξ
//!
//! with an error of 1e-4 of the drag of a sphere alone at most. Sources: Brenner, *Chem. Engng Sci.* 16 (1961) 242;
//! Jeffery, *Proc. Lond. Math. Soc.* 14 (1915) 327; Dean and O'Neill, *Mathematika* 10 (1963) 13; O'Neill,
//! *Mathematika* 11 (1964) 67; Goldman, Cox and Brenner, *Chem. Engng Sci.* 22 (1967) 637; Chaoui and Feuillebois, *Q.
//! Jl Mech. Appl. Math.* 56 (2003) 381.

use super::dual::Dual;
use super::harmonics::{Harmonics, Motion, Parallel};
use std::f64::consts::SQRT_2;
use std::sync::LazyLock;

/// The gap ξ, in parts of the radius, below which the singular functions go on.
const NEAREST: f64 = 1e-4;

/// The resistance in parts of that of a sphere alone, and its derivative by h/R.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WallFactors {
    /// f_⊥.
    pub normal: Dual,
    /// f_∥.
    pub along: Dual,
    /// c.
    pub coupling: Dual,
    /// g_⊥.
    pub spin: Dual,
    /// g_∥.
    pub roll: Dual,
}

/// Those at the gap from which the singular functions go on.
static EDGE: LazyLock<WallFactors> = LazyLock::new(|| WallFactors::by_series(Dual::constant(1.0 + NEAREST)));

impl WallFactors {
    /// At a height of the centre of so many radii, more than 1.
    pub fn at(height: f64) -> Self {
        let gap = height - 1.0;
        if gap >= NEAREST {
            return Self::by_series(Dual::variable(height));
        }
        let edge = *EDGE;
        let (here, there) = (Dual::variable(gap), Dual::constant(NEAREST));
        let go_on = |at: Dual, pole: f64, logarithm: f64, next: f64| {
            let singular = |x: Dual| {
                let pole = if pole > 0.0 { Dual::constant(pole) / x } else { Dual::default() };
                pole - (Dual::constant(logarithm) + next * x) * x.ln()
            };
            at + singular(here) - singular(there)
        };
        Self {
            normal: go_on(edge.normal, 1.0, 0.2, 1.0 / 21.0),
            along: go_on(edge.along, 0.0, 8.0 / 15.0, 64.0 / 375.0),
            coupling: go_on(edge.coupling, 0.0, 0.1, 43.0 / 250.0),
            spin: go_on(edge.spin, 0.0, 0.0, -0.5),
            roll: go_on(edge.roll, 0.0, 0.4, 66.0 / 125.0),
        }
    }

    fn by_series(height: Dual) -> Self {
        let harmonics = Harmonics::at(angle(height));
        let [along, coupling] = Parallel::new(&harmonics, Motion::Translation).sums();
        let [_, roll] = Parallel::new(&harmonics, Motion::Rotation).sums();
        let sinh = harmonics.sinh;
        Self {
            normal: towards(&harmonics),
            along: SQRT_2 / 6.0 * (sinh * along),
            coupling: 1.0 / (12.0 * SQRT_2) * (sinh * sinh * coupling),
            spin: about_normal(&harmonics),
            // The sum is of the torque less that of the stress which a turning sphere of fluid would have, −⅓.
            roll: Dual::constant(1.0 / 3.0) - 1.0 / (12.0 * SQRT_2) * (sinh * sinh * sinh * roll),
        }
    }
}

/// α with cosh α = h.
fn angle(height: Dual) -> Dual {
    let gap = height.value - 1.0;
    // ln(1 + ξ + √(ξ(2 + ξ))).
    let root = (gap * (2.0 + gap)).sqrt();
    Dual { value: libm::log1p(gap + root), slope: height.slope / root }
}

/// f_⊥.
fn towards(harmonics: &Harmonics) -> Dual {
    let Harmonics { alpha, sinh, terms, falls, .. } = harmonics;
    let (sinh, twice) = (*sinh, (2.0 * *alpha).sinh());
    let mut sum = Dual::default();
    for (k, fall) in falls.iter().enumerate().take(*terms + 1).skip(1) {
        let n = k as f64;
        let m = 2.0 * n + 1.0;
        // All times e^(−mα), which keeps it in the range of numbers; 4 sinh²(mα/2) = e^mα (1 − e^(−mα))².
        let small = *fall * *fall;
        let below = Dual::constant(1.0) - small;
        let numerator = Dual::constant(1.0) - small * small + m * (twice * small);
        let denominator = below * below - m * m * (sinh * sinh * small);
        let term = numerator / denominator - Dual::constant(1.0);
        sum = sum + n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * term;
    }
    4.0 / 3.0 * (sinh * sum)
}

/// g_⊥.
fn about_normal(harmonics: &Harmonics) -> Dual {
    let alpha = harmonics.alpha;
    let mut sum = Dual::constant(1.0);
    for k in 2..=harmonics.terms {
        // sinh α/sinh nα = e^(−(n−1)α) (1 − e^(−2α))/(1 − e^(−2nα)).
        let n = k as f64;
        let open = |of: f64| {
            let x = 2.0 * of * alpha;
            Dual { value: -libm::expm1(-x.value), slope: libm::exp(-x.value) * x.slope }
        };
        let ratio = (-((n - 1.0) * alpha)).exp() * open(1.0) / open(n);
        sum = sum + ratio * ratio * ratio;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Goldman, Cox and Brenner (1967), table 2; Brenner (1961), table 1; near and far as Chaoui and Feuillebois (2003)
    /// and Faxén have them.
    #[test]
    fn factors_are_those_in_print() {
        for (height, along) in [(10.0677, 1.0591), (3.7622, 1.1738), (1.543_080_6, 1.5675), (1.045_338_5, 2.6475)] {
            let found = WallFactors::at(height).along.value;
            assert!((found - along).abs() < 1e-4, "{height}: {found}");
        }
        let (gap, far) = (1e-3_f64, 10.0_f64);
        let (logarithm, near) = (-gap.ln(), WallFactors::at(1.0 + gap));
        let along = 8.0 / 15.0 * logarithm + 0.9543 + 64.0 / 375.0 * gap * logarithm;
        let roll = 0.4 * logarithm + 0.3709 + 66.0 / 125.0 * gap * logarithm;
        assert!((near.along.value - along).abs() < gap && (near.roll.value - roll).abs() < gap, "{near:?}");
        let found = WallFactors::at(far);
        assert!((found.roll.value - 1.0 - 0.3125 * far.powi(-3)).abs() < far.powi(-5), "{found:?}");
        assert!((found.spin.value - 1.0 - 0.125 * far.powi(-3)).abs() < far.powi(-5), "{found:?}");
        assert!((found.coupling.value - 3.0 / 32.0 * far.powi(-4)).abs() < far.powi(-5), "{found:?}");
        for (height, normal) in [(1.543_080_6, 3.0361), (1.127_626, 9.2518), (10.067_66, 1.1252)] {
            assert!((WallFactors::at(height).normal.value / normal - 1.0).abs() < 2e-4, "{height}");
        }
        // ζ(3) in touch.
        assert!((WallFactors::at(1.0 + 1e-9).spin.value - 1.202_056_9).abs() < 1e-3);
    }

    /// The force of a spin is the torque of a velocity.
    #[test]
    fn walls_are_reciprocal() {
        for height in [1.0002, 1.01, 1.2, 3.0] {
            let harmonics = Harmonics::at(angle(Dual::constant(height)));
            let [force, _] = Parallel::new(&harmonics, Motion::Rotation).sums();
            let spun = -0.75 * SQRT_2 / 6.0 * (harmonics.sinh * harmonics.sinh * force).value;
            let found = WallFactors::at(height).coupling.value;
            println!("{height}: {found} {spun}");
            assert!((found - spun).abs() < 1e-9 * found, "{height}: {found} {spun}");
        }
    }

    /// Across the gap from where on the singular functions go on, and by differences.
    #[test]
    fn factors_go_on_below_the_series() {
        for gap in [3e-5, 1e-5] {
            let (found, known) = (WallFactors::at(1.0 + gap), WallFactors::by_series(Dual::variable(1.0 + gap)));
            let parts = |of: &WallFactors| [of.normal, of.along, of.coupling, of.spin, of.roll];
            for (found, known) in parts(&found).into_iter().zip(parts(&known)) {
                println!("{gap}: {found:?} {known:?}");
                assert!((found.value - known.value).abs() < 1e-4, "{gap}: {found:?} {known:?}");
            }
        }
        for height in [1.00005, 1.003, 1.4, 6.0] {
            let step = 1e-5 * (height - 1.0);
            let found = WallFactors::at(height);
            let parts = |of: &WallFactors| [of.normal, of.along, of.coupling, of.roll];
            let [up, down] = [step, -step].map(|step| parts(&WallFactors::at(height + step)));
            for ((found, up), down) in parts(&found).into_iter().zip(up).zip(down) {
                let known = (up.value - down.value) / (2.0 * step);
                assert!((found.slope - known).abs() < 1e-5 * known.abs(), "{height}: {found:?} {known}");
            }
        }
    }
}
