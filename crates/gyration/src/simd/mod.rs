//! Arithmetic on several numbers at once, in whatever registers the processor has: the one place with the idiom.
//!
//! There are two kinds. [`F64s`] is one register of as many numbers as the widest hold, for sums over many triangles,
//! rulings and nodes (`surface`); powers and logarithms of them are in `pow`. [`F64x4`] is four numbers side by side,
//! whose places can be exchanged, for the 3×3 matrices of a body that deforms ([`SimdMat3`]). [`dispatch`] and
//! [`dispatch_f64x4`] find the instruction set at run time and call the work with it.
//!
//! Products and sums are rounded one by one, never fused, and added in a fixed order, so that every width gives the
//! same bytes. Every function that takes registers is `inline(always)`: it has to become part of the one that was
//! compiled for the instruction set, which what closures, `map` and loops over slices call need not.

mod f64x4;
mod matrix;
mod pow;
mod register;

#[cfg(test)]
pub(crate) use f64x4::in_memory;
pub(crate) use f64x4::{F64x4, WithF64x4, dispatch_f64x4};
pub(crate) use matrix::{SimdMat3, SimdVec3, UNIT};
pub(crate) use pow::{Log2, SplitExponent, exponent_and_mantissa, integer_power, polynomial};
pub(crate) use register::{F64s, Row, WIDTH, dispatch, fold, registers_mut};
