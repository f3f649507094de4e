//! How many threads compute.

use std::num::NonZeroUsize;
use std::sync::OnceLock;
use std::thread;

/// A page in a browser has one thread, no processes and no clock.
pub(crate) const THERE_ARE_THREADS: bool = !cfg!(target_family = "wasm");
/// Threads at most.
const MOST: usize = 1024;

/// A number of threads that makes no sense.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Threads {
    /// None do no work.
    #[error("no thread does no work")]
    None,
    /// So many that the machine would do nothing but change between them.
    #[error("{0} threads are too many for any machine")]
    TooMany(usize),
}

impl Threads {
    /// As many as are asked for, else one for each processor.
    ///
    /// # Errors
    /// None, or more than any machine has processors for.
    pub fn asked(threads: Option<usize>) -> Result<NonZeroUsize, Self> {
        match threads {
            None => Ok(processors()),
            Some(threads) if threads > MOST => Err(Self::TooMany(threads)),
            Some(threads) => NonZeroUsize::new(threads).ok_or(Self::None),
        }
    }

    /// What to do.
    pub fn fix(self) -> String {
        format!("ask for 1 to {MOST}, or leave it out for all processors")
    }
}

/// The processors that this process may use, as they were when it first asked: a system reads a dozen files to answer,
/// which takes as long as a hundred evaluations of a body.
pub fn processors() -> NonZeroUsize {
    static PROCESSORS: OnceLock<NonZeroUsize> = OnceLock::new();
    *PROCESSORS.get_or_init(|| thread::available_parallelism().unwrap_or(NonZeroUsize::MIN))
}
