//! Integrals of integer powers of the gap around a circle, in closed form and in registers.
//!
//! With v = 1 − cos θ the gap around a circle runs from n at v = 0 to f at v = 2. For ν = 1, 2, … tan(θ/2) = s tan ψ,
//! s² = p = n/f, gives
//!
//!   J_k = ∮ vᵏ d^−ν dθ = 2^(k+1) n^−ν s pᵏ ∫ sin²ᵏψ cos^(2(ν−1−k))ψ (1 + p tan²ψ)^(ν−1−k) dψ,   |ψ| < ½π.
//!
//! For k < ν this is a polynomial in p with coefficients of beta functions,
//!
//!   J_k = 2^(k+1) n^−ν s pᵏ Σ_j (ν−1−k over j) B(k+j+½, ν−½−k−j) p^j,
//!
//! for k ≥ ν a rational function of s: with N = k+1−ν
//!
//!   J_k = 2^(k+1) π f^−ν P_kN(s)/(1+s)ᵏ,   ∫ sin²ᵏψ (cos²ψ + p sin²ψ)^−N dψ = π P_kN(s)/(s^(2N−1) (1+s)ᵏ),
//!   P₁₁ = 1,   (1−s) P_(k+1)1 = P_k1 − (½)_k/k! s (1+s)ᵏ,
//!   2N P_(k+1)(N+1) = ((2N−1)(1+s) + ks) P_kN − s (1+s) P_kN′,
//!
//! the last by differentiation with respect to p. All coefficients are positive, so that nothing cancels however near
//! or far the circle is, b = 0 included.

use std::f64::consts::PI;

use pulp::Simd;

use crate::simd::{F64s, integer_power};
use crate::surface::Kernel;

/// The highest k.
const HIGHEST: usize = 4;

/// The largest ν, as large as exponents of laws with their derivatives are.
const LARGEST: usize = 16;

/// The integrals for one ν.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ClosedCircle {
    exponent: usize,
    /// The coefficients in p for k < ν.
    near: [[f64; LARGEST]; HIGHEST + 1],
    /// Those in s for k ≥ ν.
    far: [[f64; HIGHEST]; HIGHEST + 1],
}

impl ClosedCircle {
    /// The integrals of this kernel; none where they have no closed form here.
    pub(crate) fn of(kernel: Kernel) -> Option<&'static Self> {
        static INTEGRALS: [ClosedCircle; LARGEST] = {
            let mut integrals = [ClosedCircle::new(1); LARGEST];
            let mut exponent = 1;
            while exponent <= LARGEST {
                integrals[exponent - 1] = ClosedCircle::new(exponent);
                exponent += 1;
            }
            integrals
        };
        match kernel {
            Kernel::Power(nu) if nu.fract() == 0.0 && nu >= 1.0 => INTEGRALS.get(nu as usize - 1),
            Kernel::Power(_) | Kernel::Log => None,
        }
    }

    const fn new(exponent: usize) -> Self {
        let mut circle = Self { exponent, near: [[0.0; LARGEST]; HIGHEST + 1], far: [[0.0; HIGHEST]; HIGHEST + 1] };
        let beta = beta(exponent);
        let mut far = if exponent <= HIGHEST { first_rational(exponent) } else { [0.0; HIGHEST] };
        let mut scale = 2.0;
        let mut k = 0;
        while k <= HIGHEST {
            if k < exponent {
                let (mut binomial, mut j) = (1.0, 0);
                while j < exponent - k {
                    circle.near[k][j] = scale * binomial * beta[k + j];
                    binomial *= (exponent - 1 - k - j) as f64 / (j + 1) as f64;
                    j += 1;
                }
            } else {
                let mut j = 0;
                while j < HIGHEST {
                    circle.far[k][j] = scale * PI * far[j];
                    j += 1;
                }
                if k < HIGHEST {
                    far = next_rational(&far, k, k + 1 - exponent);
                }
            }
            scale *= 2.0;
            k += 1;
        }
        circle
    }

    /// J_0 … J_degree from n and f; those above the degree have no meaning.
    #[inline(always)]
    pub(crate) fn versines<S: Simd>(&self, near: F64s<S>, far: F64s<S>, degree: usize) -> [F64s<S>; HIGHEST + 1] {
        let inverse = 1.0 / far;
        let p = near * inverse;
        let s = p.sqrt();
        let narrowing = 1.0 / (s + 1.0);
        let mut near_power = s * integer_power(near, 1.0 / near, self.exponent as i32);
        let mut far_power = integer_power(far, inverse, self.exponent as i32);
        let mut integrals = [s; HIGHEST + 1];
        for (k, integral) in integrals.iter_mut().enumerate().take(degree + 1) {
            if k < self.exponent {
                *integral = near_power * horner(&self.near[k][..self.exponent - k], p);
            } else {
                *integral = far_power * horner(&self.far[k][..k], s);
            }
            near_power = near_power * p;
            far_power = far_power * narrowing;
        }
        integrals
    }

    /// ∮ cosᵏθ d^−ν dθ for k up to the degree.
    #[inline(always)]
    pub(crate) fn cosines<S: Simd>(&self, near: F64s<S>, far: F64s<S>, degree: usize) -> [F64s<S>; HIGHEST + 1] {
        let [j0, j1, j2, j3, j4] = self.versines(near, far, degree);
        [j0, j0 - j1, j0 - j1 * 2.0 + j2, j0 - j1 * 3.0 + j2 * 3.0 - j3, j0 - j1 * 4.0 + j2 * 6.0 - j3 * 4.0 + j4]
    }
}

/// Σ c_j x^j.
#[inline(always)]
fn horner<S: Simd>(coefficients: &[f64], x: F64s<S>) -> F64s<S> {
    let mut sum = F64s::splat(x.simd, 0.0);
    for coefficient in coefficients.iter().rev() {
        sum = sum * x + *coefficient;
    }
    sum
}

/// B(a + ½, ν − ½ − a) = ∫ sin²ᵃψ cos^(2(ν−1−a))ψ dψ for a = 0 … ν − 1.
const fn beta(exponent: usize) -> [f64; LARGEST] {
    let mut beta = [0.0; LARGEST];
    let mut value = PI;
    let mut j = 1;
    while j < exponent {
        value *= (j as f64 - 0.5) / j as f64;
        j += 1;
    }
    let mut a = 0;
    while a < exponent {
        beta[a] = value;
        if a + 1 < exponent {
            value *= (a as f64 + 0.5) / ((exponent - 1 - a) as f64 - 0.5);
        }
        a += 1;
    }
    beta
}

/// P_k1.
const fn first_rational(k: usize) -> [f64; HIGHEST] {
    let mut p = [0.0; HIGHEST];
    p[0] = 1.0;
    // (½)_j/j!
    let mut mean = 0.5;
    let mut j = 1;
    while j < k {
        let (mut quotient, mut binomial, mut i) = (p[0], 1.0, 1);
        let mut next = [0.0; HIGHEST];
        while i <= j {
            next[i - 1] = quotient;
            let own = if i < HIGHEST { p[i] } else { 0.0 };
            quotient += own - mean * binomial;
            binomial *= (j + 1 - i) as f64 / i as f64;
            i += 1;
        }
        next[j] = quotient;
        p = next;
        mean *= (2 * j + 1) as f64 / (2 * j + 2) as f64;
        j += 1;
    }
    p
}

/// P_(k+1)(N+1) from P_kN.
const fn next_rational(p: &[f64; HIGHEST], k: usize, n: usize) -> [f64; HIGHEST] {
    let mut next = [0.0; HIGHEST];
    let mut i = 0;
    while i < HIGHEST {
        let degree = i as f64;
        next[i] += ((2 * n - 1) as f64 - degree) * p[i] / (2 * n) as f64;
        if i + 1 < HIGHEST {
            next[i + 1] += ((2 * n - 1 + k) as f64 - degree) * p[i] / (2 * n) as f64;
        }
        i += 1;
    }
    next
}

#[cfg(test)]
mod tests {
    use super::super::ring::{Demand, Rings, nodes};
    use super::*;
    use crate::simd::{Row, WIDTH, dispatch, registers_mut};
    use pulp::WithSimd;

    /// J_0 … J_4 for gaps from these to 1.
    struct Circles {
        near: Row,
        circle: &'static ClosedCircle,
    }

    impl WithSimd for Circles {
        type Output = [Row; HIGHEST + 1];

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
            let mut out = [[0.0; WIDTH]; HIGHEST + 1];
            for register in 0..WIDTH / S::F64_LANES {
                let near = F64s::load(simd, &self.near, register);
                let integrals = self.circle.versines(near, F64s::splat(simd, 1.0), HIGHEST);
                for (row, integral) in out.iter_mut().zip(integrals) {
                    registers_mut::<S>(row)[register] = integral.values;
                }
            }
            out
        }
    }

    #[test]
    fn closed_forms_are_the_sums_of_a_fine_rule() {
        let mut worst: f64 = 0.0;
        let near: Row = [1e-5, 1e-4, 1e-3, 0.03, 0.2, 0.5, 0.9, 1.0];
        for nu in 1..=LARGEST {
            let circle = ClosedCircle::of(Kernel::Power(nu as f64)).unwrap();
            let found = dispatch(Circles { near, circle });
            let fine = Rings::new(&Demand { sharpest: 60.0, mildest: nu as f64, degree: 20 });
            for (lane, near) in near.into_iter().enumerate() {
                for (k, integrals) in found.iter().enumerate() {
                    let term = |versine: f64| {
                        (near + 0.5 * (1.0 - near) * versine).powi(-(nu as i32)) * versine.powi(k as i32)
                    };
                    let expected: f64 =
                        nodes(fine.chunks(near, 1.0)).map(|node| node.weight * term(node.versine)).sum();
                    let error = (integrals[lane] / expected - 1.0).abs();
                    worst = worst.max(error);
                    // The steps of the fine rule add up some hundred roundings, of cn ≈ s on the far side.
                    let rounding = 1e-12 + 1e-13 / near.sqrt();
                    assert!(error < rounding, "ν = {nu}, n/f = {near}, k = {k}: {error:e}");
                }
            }
        }
        println!("circle in closed form: worst relative error {worst:.1e}");
    }

    #[test]
    fn other_kernels_have_no_closed_form() {
        for kernel in [Kernel::Log, Kernel::Power(0.0), Kernel::Power(2.5), Kernel::Power(17.0), Kernel::Power(-1.0)] {
            assert_eq!(ClosedCircle::of(kernel), None);
        }
    }
}
