//! Random numbers that depend on the seed, the number of the run and the name of the parameter alone.

mod normal;
mod permutation;
mod sobol;
mod stream;

pub(crate) use normal::inverse_normal;
pub(crate) use permutation::permuted;
pub(crate) use sobol::{MOST_DIMENSIONS, Sobol};
pub(crate) use stream::{RandomStream, hash, unit};
