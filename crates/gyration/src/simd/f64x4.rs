//! Four numbers that are worked on at once: what a column of a 3×3 matrix is kept in.
//!
//! `[f64; 4]` is four numbers in memory, or in whatever registers the plain build has; where the processor has
//! registers of 256 bits, [`dispatch_f64x4`] finds it at run time and calls the work with one of them
//! ([`F64s`](super::F64s)).

/// Four numbers side by side.
pub trait F64x4: Copy {
    /// These numbers, in registers of the same kind.
    fn like(self, numbers: [f64; 4]) -> Self;
    /// The numbers.
    fn numbers(self) -> [f64; 4];
    /// One of them; where the place is not a constant, it is fetched from memory.
    fn at(&self, place: usize) -> f64;
    /// a_i + b_i.
    fn plus(self, other: Self) -> Self;
    /// a_i − b_i.
    fn minus(self, other: Self) -> Self;
    /// a_i b_i.
    fn product(self, other: Self) -> Self;
    /// a_i f.
    fn times(self, factor: f64) -> Self;
    /// One of them in all places.
    fn broadcast<const PLACE: usize>(self) -> Self;
    /// (a₁, a₂, a₀, a₃).
    fn yzx(self) -> Self;
    /// (a_i, b_i, c_i, d_i) for i = 0, 1, 2.
    fn transposed(rows: [Self; 4]) -> [Self; 3];
}

/// What is done with four numbers at once.
pub trait WithF64x4 {
    /// What it gives.
    type Output;

    /// Does it in registers of the kind of these, which hold zeros.
    fn run<F: F64x4>(self, zeros: F) -> Self::Output;
}

/// Does the work in the widest registers for four numbers that this processor has.
#[inline]
pub(crate) fn dispatch_f64x4<W: WithF64x4>(work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    if let Some(simd) = pulp::x86::V3::try_new() {
        return simd.vectorize(wide::Wide { simd, work });
    }
    in_memory(work)
}

/// Does the work in four numbers in memory, with the same bytes.
#[inline(never)]
pub(crate) fn in_memory<W: WithF64x4>(work: W) -> W::Output {
    work.run([0.0; 4])
}

impl F64x4 for [f64; 4] {
    #[inline(always)]
    fn like(self, numbers: [f64; 4]) -> Self {
        numbers
    }

    #[inline(always)]
    fn numbers(self) -> [f64; 4] {
        self
    }

    #[inline(always)]
    fn at(&self, place: usize) -> f64 {
        self[place]
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        let ([a, b, c, d], [x, y, z, w]) = (self, other);
        [a + x, b + y, c + z, d + w]
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        let ([a, b, c, d], [x, y, z, w]) = (self, other);
        [a - x, b - y, c - z, d - w]
    }

    #[inline(always)]
    fn product(self, other: Self) -> Self {
        let ([a, b, c, d], [x, y, z, w]) = (self, other);
        [a * x, b * y, c * z, d * w]
    }

    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        self.product([factor; 4])
    }

    #[inline(always)]
    fn broadcast<const PLACE: usize>(self) -> Self {
        [self[PLACE]; 4]
    }

    #[inline(always)]
    fn yzx(self) -> Self {
        let [a, b, c, d] = self;
        [b, c, a, d]
    }

    #[inline(always)]
    fn transposed(rows: [Self; 4]) -> [Self; 3] {
        let [[a0, a1, a2, _], [b0, b1, b2, _], [c0, c1, c2, _], [d0, d1, d2, _]] = rows;
        [[a0, b0, c0, d0], [a1, b1, c1, d1], [a2, b2, c2, d2]]
    }
}

/// Registers of 256 bits.
#[cfg(target_arch = "x86_64")]
mod wide {
    use super::super::register::F64s;
    use super::{F64x4, WithF64x4};
    use pulp::x86::V3;
    use pulp::{NullaryFnOnce, cast};

    /// The work in such registers.
    pub struct Wide<W> {
        pub simd: V3,
        pub work: W,
    }

    impl<W: WithF64x4> NullaryFnOnce for Wide<W> {
        type Output = W::Output;

        #[inline(always)]
        fn call(self) -> W::Output {
            self.work.run(F64s::splat(self.simd, 0.0))
        }
    }

    impl F64x4 for F64s<V3> {
        #[inline(always)]
        fn like(self, numbers: [f64; 4]) -> Self {
            Self { values: cast(numbers), ..self }
        }

        #[inline(always)]
        fn numbers(self) -> [f64; 4] {
            cast(self.values)
        }

        #[inline(always)]
        fn at(&self, place: usize) -> f64 {
            self.numbers()[place]
        }

        #[inline(always)]
        fn plus(self, other: Self) -> Self {
            self + other
        }

        #[inline(always)]
        fn minus(self, other: Self) -> Self {
            self - other
        }

        #[inline(always)]
        fn product(self, other: Self) -> Self {
            self * other
        }

        #[inline(always)]
        fn times(self, factor: f64) -> Self {
            self * factor
        }

        #[inline(always)]
        fn broadcast<const PLACE: usize>(self) -> Self {
            let [a, b, c, d] = self.numbers();
            Self::splat(self.simd, [a, b, c, d][PLACE])
        }

        #[inline(always)]
        fn yzx(self) -> Self {
            const ORDER: i32 = 0b11_00_10_01;
            Self { values: cast(self.simd.avx2._mm256_permute4x64_pd::<ORDER>(cast(self.values))), ..self }
        }

        #[inline(always)]
        fn transposed([a, b, c, d]: [Self; 4]) -> [Self; 3] {
            const LOWER: i32 = 0b10_00_00;
            const UPPER: i32 = 0b11_00_01;
            let avx = a.simd.avx;
            let (x, y, z, w) = (cast(a.values), cast(b.values), cast(c.values), cast(d.values));
            let (even, odd) = (avx._mm256_unpacklo_pd(x, y), avx._mm256_unpackhi_pd(x, y));
            let (even_end, odd_end) = (avx._mm256_unpacklo_pd(z, w), avx._mm256_unpackhi_pd(z, w));
            [
                Self { values: cast(avx._mm256_permute2f128_pd::<LOWER>(even, even_end)), ..a },
                Self { values: cast(avx._mm256_permute2f128_pd::<LOWER>(odd, odd_end)), ..a },
                Self { values: cast(avx._mm256_permute2f128_pd::<UPPER>(even, even_end)), ..a },
            ]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All that is done with four numbers.
    struct All([f64; 4], [f64; 4]);

    impl WithF64x4 for All {
        type Output = Vec<[u64; 4]>;

        fn run<F: F64x4>(self, zeros: F) -> Self::Output {
            let (a, b) = (zeros.like(self.0), zeros.like(self.1));
            let spread = [a.broadcast::<0>(), a.broadcast::<1>(), a.broadcast::<2>(), a.broadcast::<3>()];
            let rest = [zeros, a.plus(b), a.minus(b), a.product(b), a.times(0.7), a.yzx()];
            let columns = F::transposed([a, b, a.plus(b), b.yzx()]);
            let places = [a.at(0), a.at(1), a.at(2), a.at(3)].map(f64::to_bits);
            spread
                .iter()
                .chain(&rest)
                .chain(&columns)
                .map(|four| four.numbers().map(f64::to_bits))
                .chain([places])
                .collect()
        }
    }

    #[test]
    fn registers_do_what_four_numbers_in_memory_do() {
        let (a, b) = ([1.1, -0.3, -0.0, f64::INFINITY], [0.7, 3.3e-310, 5.0, 2.0]);
        assert_eq!(dispatch_f64x4(All(a, b)), All(a, b).run([0.0; 4]));
        assert_eq!(a.yzx(), [-0.3, -0.0, 1.1, f64::INFINITY]);
    }
}
