//! Work on as many threads as there are cores.

use std::sync::Mutex;
use std::thread::{available_parallelism, scope};

/// Does the work for every item; which thread does which is left to chance.
pub fn each<T: Send>(items: impl Iterator<Item = T> + Send, work: impl Fn(T) + Sync) {
    let queue = Mutex::new(items);
    scope(|threads| {
        for _ in 0..available_parallelism().map_or(1, usize::from) {
            threads.spawn(|| {
                // The lock is held while an item is taken, not while it is worked on.
                let next = || queue.lock().ok().and_then(|mut queue| queue.next());
                while let Some(item) = next() {
                    work(item);
                }
            });
        }
    });
}
