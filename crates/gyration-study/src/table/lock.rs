//! The lock of a table that is being written, and what becomes of it where processes are forked.

use std::fs::File;
use std::sync::{Arc, Mutex, PoisonError};

/// The lock of a table.
#[derive(Debug, Clone)]
pub struct TableLock(Arc<Mutex<Option<File>>>);

impl TableLock {
    pub(super) fn new(lock: File) -> Self {
        Self(Arc::new(Mutex::new(Some(lock))))
    }

    /// Leaves the lock to the process from which this one was forked: what is shut here is open there, and the lock
    /// ends with that process.
    pub fn leave(&self) {
        // Somebody who is at it was at it there.
        if let Ok(mut lock) = self.0.try_lock() {
            drop(lock.take());
        }
    }

    /// Unlocks: a process that was forked meanwhile may have the file open as well, and with it the lock, so that to
    /// close it would not do.
    pub(super) fn release(&self) {
        let lock = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        let _ = lock.as_ref().map(File::unlock);
    }
}
