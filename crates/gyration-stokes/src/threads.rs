//! The threads that share the work.

use rayon::{ThreadPool, ThreadPoolBuilder};
use std::process;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Does work whose parts are shared out by rayon, on threads that this process has.
///
/// The threads of a pool are not there in a process that was forked from the one that started them, and to wait for them is
/// to wait for ever. Such a process, a worker of a Python pool say, gets a pool of its own.
pub fn on_own_threads<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    static FIRST: OnceLock<u32> = OnceLock::new();
    static FORKED: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);
    let here = process::id();
    if *FIRST.get_or_init(|| here) == here {
        return work();
    }
    let mut forked = FORKED.lock().unwrap_or_else(PoisonError::into_inner);
    let pool = match &*forked {
        Some((owner, pool)) if *owner == here => pool.clone(),
        _ => {
            let Ok(pool) = ThreadPoolBuilder::new().build().map(Arc::new) else { return work() };
            // That of a process further up is not waited for either.
            std::mem::forget(forked.replace((here, pool.clone())));
            pool
        }
    };
    drop(forked);
    pool.install(work)
}
