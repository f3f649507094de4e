//! Rayon in a process that may have been forked.

use crate::count::THERE_ARE_THREADS;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::process;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A pool and the process whose threads it has.
type Owned = (u32, Arc<ThreadPool>);

/// Does work whose parts are shared out by rayon, on threads that this process has.
///
/// The threads of a pool are not there in a process that was forked from the one that started them, and to wait for
/// them is to wait for ever. Such a process, a worker of a Python pool say, gets a pool of its own.
pub fn on_own_threads<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    if !THERE_ARE_THREADS {
        return work();
    }
    static FIRST: OnceLock<u32> = OnceLock::new();
    static FORKED: Mutex<Option<Owned>> = Mutex::new(None);
    let here = process::id();
    if *FIRST.get_or_init(|| here) == here {
        return work();
    }
    match pool_of(here, &FORKED) {
        Ok(pool) => pool.install(work),
        // Not even this thread makes one: it is in another pool already, whose threads then are here.
        Err(_) => work(),
    }
}

fn pool_of(here: u32, forked: &Mutex<Option<Owned>>) -> Result<Arc<ThreadPool>, ThreadPoolBuildError> {
    let mut forked = forked.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((owner, pool)) = &*forked
        && *owner == here
    {
        return Ok(pool.clone());
    }
    // Where no more threads are to be had, this one does the work.
    let alone = || ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
    let pool = Arc::new(ThreadPoolBuilder::new().build().or_else(|_| alone())?);
    // That of a process further up is not waited for either.
    std::mem::forget(forked.replace((here, pool.clone())));
    Ok(pool)
}
