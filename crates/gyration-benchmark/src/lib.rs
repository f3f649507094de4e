//! Pieces of work that tell how fast Gyration is on a machine, and what is the least that they can take.
//!
//! `near`, `soft`, `die`, `crowd`, `gas` and `heap` make the bodies; [`measure`] has the work of `gyration bench`, row
//! by row, with floors from the [arithmetic](Arithmetic) of the machine. The benchmarks under `bench/` measure the same
//! bodies more closely. Nothing here is a test: times depend on the machine and on what else it does.

#![forbid(unsafe_code)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod arithmetic;
mod clock;
pub mod crowd;
pub mod die;
mod gas;
mod heap;
mod kernels;
mod near;
mod random;
mod row;
mod runs;
pub mod soft;

pub use arithmetic::Arithmetic;
pub use clock::{processor_seconds, seconds_each};
pub use kernels::{Kernel, kernels};
pub use near::{SHAPES, near_table, particle_in_shear};
pub use row::{BenchmarkRow, Floor, Size};

/// Measures all rows, telling each as soon as it is known; returns them.
pub fn measure(arithmetic: &Arithmetic, size: Size, mut tell: impl FnMut(&BenchmarkRow)) -> Vec<BenchmarkRow> {
    let mut rows = Vec::new();
    let mut add = |row: BenchmarkRow| {
        tell(&row);
        rows.push(row);
    };
    kernels::rows(arithmetic, size, &mut add);
    runs::rows(arithmetic, size, &mut add);
    rows
}
