//! The arithmetic of this machine: products and sums a second in its widest registers.

use crate::clock::seconds_each;
use pulp::{Simd, WithSimd};
use serde::Serialize;
use std::hint::black_box;

/// Chains of products and sums that do not wait for one another: enough for what the units have under way.
const CHAINS: usize = 10;
/// Products and sums of each lane of each chain in a batch.
const LENGTH: usize = 4096;

/// How fast numbers are multiplied and added.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Arithmetic {
    /// Numbers of 64 bits in the widest register.
    pub lanes: usize,
    /// Products and sums a second on one thread, each rounded, never fused.
    pub operations: f64,
}

impl Arithmetic {
    /// Measured on this thread: the fastest of five batches.
    pub fn measured() -> Self {
        let arch = pulp::Arch::new();
        let lanes = arch.dispatch(Lanes);
        let seconds = seconds_each(|| {
            black_box(arch.dispatch(Batch { factor: black_box(0.999_999), term: black_box(1e-6) }));
        });
        Self { lanes, operations: (2 * CHAINS * LENGTH * lanes) as f64 / seconds }
    }

    /// The least time of so many products and sums \[s\].
    pub fn seconds(&self, operations: f64) -> f64 {
        operations / self.operations
    }
}

/// How wide the registers are.
struct Lanes;

impl WithSimd for Lanes {
    type Output = usize;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> usize {
        S::F64_LANES
    }
}

/// x ← a x + b, in all lanes of all chains.
struct Batch {
    factor: f64,
    term: f64,
}

impl WithSimd for Batch {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let (factor, term) = (simd.splat_f64s(self.factor), simd.splat_f64s(self.term));
        let mut chains = [simd.splat_f64s(1.0); CHAINS];
        for _ in 0..LENGTH {
            for chain in &mut chains {
                *chain = simd.add_f64s(simd.mul_f64s(*chain, factor), term);
            }
        }
        chains.into_iter().map(|chain| simd.reduce_sum_f64s(chain)).sum()
    }
}
