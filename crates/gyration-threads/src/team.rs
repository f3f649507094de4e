//! Short jobs by number, on threads that are at hand: they look for jobs as long as the work lasts that has them.
//!
//! A thread of rayon that waits for a job begins others meanwhile, above the one that waits. To be at hand is a job
//! that ends only with the work that it is for: above another work it would hold that up, and two works might wait for
//! each other. So a thread that has work, or is at hand already, is not at hand for more.

use crate::interruption::Interruption;
use crate::own::on_own_threads;
use rayon::Yield;
use rayon::prelude::*;
use std::cell::Cell;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// So often a thread that finds nothing to do looks again at once, before others may have its processor.
const LOOKS: u32 = 1 << 10;

/// Does some work with so many threads at hand, this one included, which otherwise sleep: what it shares out among them
/// by [`each_on_threads`] is begun within a microsecond.
///
/// # Panics
/// If the work does.
pub fn with_threads_at_hand<T: Send>(threads: NonZeroUsize, work: impl FnOnce() -> T + Send) -> T {
    let interruption = Interruption::in_force();
    let is_done = AtomicBool::new(false);
    on_own_threads(|| {
        rayon::scope(|scope| {
            for _ in 1..threads.get().min(rayon::current_num_threads()) {
                scope.spawn(|_| help_until(&is_done));
            }
            // Also where the work ends in a panic.
            let (_done, _taken) = (Raised(&is_done), Taken::now());
            interruption.within(work)
        })
    })
}

/// Raises a flag when it goes.
struct Raised<'a>(&'a AtomicBool);

impl Drop for Raised<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}

thread_local! {
    /// Whether this thread has work, or is at hand for some.
    static IS_TAKEN: Cell<bool> = const { Cell::new(false) };
}

/// A thread that is taken as long as this lives; what it was before.
struct Taken(bool);

impl Taken {
    fn now() -> Self {
        Self(IS_TAKEN.replace(true))
    }
}

impl Drop for Taken {
    fn drop(&mut self) {
        IS_TAKEN.set(self.0);
    }
}

/// Does what jobs there are until a flag is raised, on a thread that is not taken.
fn help_until(is_done: &AtomicBool) {
    if IS_TAKEN.get() {
        return;
    }
    let (mut looks, _taken) = (0, Taken::now());
    while !is_done.load(Ordering::Acquire) {
        match rayon::yield_now() {
            Some(Yield::Executed) => looks = 0,
            _ if looks < LOOKS => {
                looks += 1;
                std::hint::spin_loop();
            }
            _ => std::thread::yield_now(),
        }
    }
}

/// Does each of so many jobs once, by their numbers, on so many threads at most; returns when all are done.
///
/// # Panics
/// If a job does.
pub fn each_on_threads(threads: NonZeroUsize, jobs: usize, job: &(dyn Fn(usize) + Sync)) {
    let next = AtomicUsize::new(0);
    let work = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= jobs {
                return;
            }
            job(number);
        }
    };
    on_own_threads(|| (0..threads.get().min(jobs)).into_par_iter().with_max_len(1).for_each(|_| work()));
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    fn threads(count: usize) -> NonZeroUsize {
        NonZeroUsize::new(count).unwrap()
    }

    #[test]
    fn each_job_is_done_once() {
        for (count, jobs) in [(1, 0), (1, 7), (3, 2), (2, 1000)] {
            let counts: Vec<AtomicUsize> = (0..jobs).map(|_| AtomicUsize::new(0)).collect();
            let job = |job: usize| {
                counts[job].fetch_add(1, Ordering::Relaxed);
            };
            with_threads_at_hand(threads(count), || each_on_threads(threads(count), jobs, &job));
            each_on_threads(threads(count), jobs, &job);
            assert!(counts.iter().all(|count| count.load(Ordering::Relaxed) == 2), "{count} threads, {jobs} jobs");
        }
    }

    #[test]
    fn work_is_interrupted_as_it_would_be_without_them() {
        let flag = std::sync::Arc::new(AtomicBool::new(true));
        let due = || with_threads_at_hand(threads(2), Interruption::due);
        assert!(Interruption::default().raised_by(flag).within(due).is_some() && due().is_none());
    }

    /// Two works that share out jobs at once, in a pool that has fewer threads than they ask for.
    #[test]
    fn works_do_not_wait_for_one_another() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(4).build().unwrap();
        let count = AtomicUsize::new(0);
        let job = |_| {
            count.fetch_add(1, Ordering::Relaxed);
            // Long enough for others to take some.
            (0..1000).for_each(|_| std::hint::spin_loop());
        };
        let work = || (0..200).for_each(|_| each_on_threads(threads(4), 8, &job));
        pool.scope(|scope| {
            for _ in 0..2 {
                scope.spawn(|_| (0..20).for_each(|_| with_threads_at_hand(threads(4), work)));
            }
        });
        assert_eq!(count.into_inner(), 2 * 20 * 200 * 8);
    }

    #[test]
    fn threads_are_let_go_by_work_that_panics() {
        let panics = || with_threads_at_hand(threads(2), || panic!("on purpose"));
        assert!(catch_unwind(AssertUnwindSafe(panics)).is_err());
        assert_eq!(with_threads_at_hand(threads(2), || 5), 5);
    }
}
