//! The same arithmetic on as many numbers at once as the widest registers of the processor hold.
//!
//! What [`dispatch`] calls is generic over the instruction set and compiled once for each (512 and 256 bits, 128 on
//! ARM, one number at a time elsewhere). Whatever the width, a sum runs over [`WIDTH`] logical lanes: number i belongs
//! to lane i mod `WIDTH`, and [`fold`] adds the lanes in a fixed order.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use pulp::{Simd, WithSimd};

/// Logical lanes: the widest registers hold as many numbers.
pub(crate) const WIDTH: usize = 8;

/// Numbers of one kind, one for each logical lane.
pub(crate) type Row = [f64; WIDTH];

/// Calls the work with the widest instruction set that this processor has.
#[cfg(not(all(target_family = "wasm", target_feature = "simd128")))]
pub(crate) fn dispatch<W: WithSimd>(work: W) -> W::Output {
    pulp::Arch::new().dispatch(work)
}

/// Calls the work with the registers of 128 bits that the module is built for: a browser without them refuses all of
/// it, and one version of each work is half of the bytes.
#[cfg(all(target_family = "wasm", target_feature = "simd128"))]
pub(crate) fn dispatch<W: WithSimd>(work: W) -> W::Output {
    match pulp::wasm::Simd128::try_new() {
        Some(simd) => Simd::vectorize(simd, work),
        None => unreachable!("the module is built for these registers"),
    }
}

/// The registers that make up a row.
#[inline(always)]
fn registers<S: Simd>(row: &Row) -> &[S::f64s] {
    const { assert!(WIDTH.is_multiple_of(S::F64_LANES), "a row must consist of whole registers") };
    S::as_simd_f64s(row).0
}

/// The registers that make up a row, to be written.
#[inline(always)]
pub(crate) fn registers_mut<S: Simd>(row: &mut Row) -> &mut [S::f64s] {
    S::as_mut_simd_f64s(row).0
}

/// The sum of a row, in an order that does not depend on the width of registers.
#[inline(always)]
pub(crate) fn fold(row: &Row) -> f64 {
    let four = [row[0] + row[4], row[1] + row[5], row[2] + row[6], row[3] + row[7]];
    (four[0] + four[2]) + (four[1] + four[3])
}

/// One register of numbers.
#[derive(Clone, Copy)]
pub(crate) struct F64s<S: Simd> {
    pub simd: S,
    pub values: S::f64s,
}

/// A truth for each lane.
#[derive(Clone, Copy)]
pub(crate) struct Mask<S: Simd> {
    simd: S,
    values: S::m64s,
}

impl<S: Simd> F64s<S> {
    /// The number in every lane.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self { simd, values: simd.splat_f64s(value) }
    }

    /// The register of a row at this place.
    #[inline(always)]
    pub fn load(simd: S, row: &Row, register: usize) -> Self {
        Self { simd, values: registers::<S>(row)[register] }
    }

    /// Adds the register to that of a row at this place.
    #[inline(always)]
    pub fn add_to(self, row: &mut Row, register: usize) {
        let sum = &mut registers_mut::<S>(row)[register];
        *sum = self.simd.add_f64s(*sum, self.values);
    }

    /// Where a < b.
    #[inline(always)]
    pub fn less_than(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, values: self.simd.less_than_f64s(self.values, other.values) }
    }

    /// a + b and what its rounding leaves out.
    #[inline(always)]
    pub fn exact_sum(self, other: Self) -> (Self, Self) {
        let sum = self + other;
        let of_other = sum - self;
        (sum, (self - (sum - of_other)) + (other - of_other))
    }

    /// a b and what its rounding leaves out.
    #[inline(always)]
    pub fn exact_product(self, other: Self) -> (Self, Self) {
        let product = self * other;
        let negative = (-product).values;
        (product, Self { simd: self.simd, values: self.simd.mul_add_f64s(self.values, other.values, negative) })
    }

    /// The square roots.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { simd: self.simd, values: self.simd.sqrt_f64s(self.values) }
    }

    /// The smallest of the lanes; none of them may be NaN.
    #[inline(always)]
    pub fn smallest(self) -> f64 {
        self.simd.reduce_min_f64s(self.values)
    }

    /// The largest of the lanes; none of them may be NaN.
    #[inline(always)]
    pub fn largest(self) -> f64 {
        self.simd.reduce_max_f64s(self.values)
    }
}

impl<S: Simd> Mask<S> {
    /// `yes` where it is true, `no` elsewhere.
    #[inline(always)]
    pub fn select(self, yes: F64s<S>, no: F64s<S>) -> F64s<S> {
        F64s { simd: self.simd, values: self.simd.select_f64s(self.values, yes.values, no.values) }
    }

    /// Exchanges a and b where it is true.
    #[inline(always)]
    pub fn exchange(self, a: &mut F64s<S>, b: &mut F64s<S>) {
        (*a, *b) = (self.select(*b, *a), self.select(*a, *b));
    }
}

macro_rules! operator {
    ($trait:ident, $function:ident, $instruction:ident) => {
        impl<S: Simd> $trait for F64s<S> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self { simd: self.simd, values: self.simd.$instruction(self.values, other.values) }
            }
        }

        impl<S: Simd> $trait<f64> for F64s<S> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: f64) -> Self {
                $trait::$function(self, Self::splat(self.simd, other))
            }
        }

        impl<S: Simd> $trait<F64s<S>> for f64 {
            type Output = F64s<S>;

            #[inline(always)]
            fn $function(self, other: F64s<S>) -> F64s<S> {
                $trait::$function(F64s::splat(other.simd, self), other)
            }
        }
    };
}

operator!(Add, add, add_f64s);
operator!(Sub, sub, sub_f64s);
operator!(Mul, mul, mul_f64s);
operator!(Div, div, div_f64s);

impl<S: Simd> AddAssign for F64s<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd> Neg for F64s<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { simd: self.simd, values: self.simd.neg_f64s(self.values) }
    }
}
