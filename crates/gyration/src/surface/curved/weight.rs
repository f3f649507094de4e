//! Weights of a surface element by its current area vector v = cof(P) N.
//!
//! A weight is homogeneous of degree one in v and even: |v| = k itself, or k times a product of an even number of components
//! of the normal m = v/|v|,
//!
//!   w(v) = v_a v_b/|v|,   w(v) = v_a v_b v_c v_d/|v|³.
//!
//! All of them are analytic but for the zeros of v·v at complex places, which is all that the rules have to know.

use super::super::GapField;
use crate::tensor::{Mat3, Vec3};

/// What a primitive has to know of a deformed body, in its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Deformed<const N: usize> {
    pub(crate) field: GapField,
    /// C, which takes the reference normal N to the current area vector v = C N.
    pub(crate) cofactor: Mat3,
    pub(crate) weight: Product<N>,
}

/// k times a product of components of the current normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Product<const N: usize> {
    /// Which components; none for the area factor itself.
    pub(crate) factors: [usize; N],
}

/// The area factor alone.
#[allow(non_upper_case_globals, reason = "it is the value of a weight and stands beside `Product`")]
pub(crate) const Area: Product<0> = Product { factors: [] };

impl<const N: usize> Product<N> {
    /// w(v); 0 for an element without area.
    #[inline(always)]
    pub(crate) fn of(&self, v: &Vec3) -> f64 {
        let squared = v.norm_squared();
        self.factors.iter().fold(Self::base(squared), |product, &factor| product * v[factor])
    }

    /// |v|^(1−N) from |v|², 0 where that is not positive.
    #[inline(always)]
    pub(crate) fn base(squared: f64) -> f64 {
        if squared > 0.0 {
            match N {
                0 => squared.sqrt(),
                2 => 1.0 / squared.sqrt(),
                _ => 1.0 / (squared * squared.sqrt()),
            }
        } else {
            0.0
        }
    }

    /// Digits, as a natural logarithm, by which the weight is harder to resolve than |v|: its singularities are stronger.
    pub(crate) const EXTRA_DIGITS: f64 = 2.5 * N as f64;
}
