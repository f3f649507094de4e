//! Weights of a surface element by its current area vector v = cof(P) N.
//!
//! A weight is homogeneous of degree one in v and even: |v| = k itself, or k times a product of an even number of
//! components of the normal m = v/|v|,
//!
//!   w(v) = v_a v_b/|v|,   w(v) = v_a v_b v_c v_d/|v|³.
//!
//! All of them are analytic but for the zeros of v·v at complex places, which is all that the rules have to know.

use pulp::Simd;

use super::integrand::GROUP;
use crate::simd::F64s;
use crate::surface::{GapField, Moments};
use crate::tensor::{Mat3, Vec3};

/// What a primitive has to know of a deformed body, in its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Deformed<const N: usize, const W: usize> {
    pub(crate) field: GapField,
    /// C, which takes the reference normal N to the current area vector v = C N.
    pub(crate) cofactor: Mat3,
    /// The weights that are wanted together.
    pub(crate) weights: Weights<N, W>,
}

/// Moments of the requests of a group for each weight.
pub(crate) type Weighted<const W: usize> = [[Moments; GROUP]; W];

/// Weights of the same kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Weights<const N: usize, const W: usize> {
    /// Which components are multiplied, for each of them; none for the area factor itself.
    pub(crate) factors: [[usize; N]; W],
}

/// The area factor alone.
pub(crate) const AREA: Weights<0, 1> = Weights { factors: [[]] };

impl<const N: usize, const W: usize> Weights<N, W> {
    /// w(v) for each of them; 0 for an element without area.
    #[inline(always)]
    pub(crate) fn of(&self, v: &Vec3) -> [f64; W] {
        let mut weights = [base::<N>(v.norm_squared()); W];
        for (weight, factors) in weights.iter_mut().zip(&self.factors) {
            for &factor in factors {
                *weight *= v[factor];
            }
        }
        weights
    }
}

/// |v|^(1−N) from |v|², 0 where that is not positive.
#[inline(always)]
pub(crate) fn base<const N: usize>(squared: f64) -> f64 {
    // What is not a number stays so.
    if squared <= 0.0 {
        return 0.0;
    }
    match N {
        0 => squared.sqrt(),
        2 => 1.0 / squared.sqrt(),
        _ => 1.0 / (squared * squared.sqrt()),
    }
}

/// The same of a register.
#[inline(always)]
pub(crate) fn bases<S: Simd, const N: usize>(squared: F64s<S>) -> F64s<S> {
    let zero = F64s::splat(squared.simd, 0.0);
    let base = match N {
        0 => squared.sqrt(),
        2 => 1.0 / squared.sqrt(),
        _ => 1.0 / (squared * squared.sqrt()),
    };
    // What is not a number stays so.
    squared.less_than(F64s::splat(squared.simd, f64::MIN_POSITIVE)).select(zero, base)
}

/// Digits, as a natural logarithm, by which a weight is harder to resolve than |v|: its singularities are stronger.
pub(crate) const fn extra_digits<const N: usize>() -> f64 {
    2.5 * N as f64
}
