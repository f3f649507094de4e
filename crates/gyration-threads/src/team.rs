//! Short jobs by number, on threads that are at hand: they look for jobs as long as the work lasts that has them.
//!
//! Each work has a pool to itself while it lasts. A thread that waits for a job of its pool begins others meanwhile,
//! above the one that waits: jobs of another work, or a look for jobs that only ends with it, would hold it up.

use crate::count::THERE_ARE_THREADS;
use crate::interruption::Interruption;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder, Yield};
use std::cell::Cell;
use std::num::NonZeroUsize;
use std::process;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// So often a thread that finds nothing to do looks again at once, before others may have its processor.
const LOOKS: u32 = 1 << 10;

/// A pool that no work has, and the process whose threads it has.
struct Idle {
    process: u32,
    pool: ThreadPool,
}

static IDLE: Mutex<Vec<Idle>> = Mutex::new(Vec::new());

/// A pool of so many threads that no other work has; none where they cannot be had.
fn borrowed(threads: NonZeroUsize) -> Option<ThreadPool> {
    let mut idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner);
    // The threads of a process further up are not there; nobody waits for them.
    let here = process::id();
    let (own, others): (Vec<Idle>, Vec<Idle>) = idle.drain(..).partition(|idle| idle.process == here);
    others.into_iter().for_each(std::mem::forget);
    *idle = own;
    match idle.iter().position(|idle| idle.pool.current_num_threads() == threads.get()) {
        Some(place) => Some(idle.swap_remove(place).pool),
        None => ThreadPoolBuilder::new().num_threads(threads.get()).build().ok(),
    }
}

thread_local! {
    /// Whether this thread has work with others at hand.
    static HAS_TEAM: Cell<bool> = const { Cell::new(false) };
}

/// Does some work with so many threads at hand, this one included, which otherwise sleep: what it shares out among them
/// by [`each_on_threads`] is begun within a microsecond.
///
/// # Panics
/// If the work does.
pub fn with_threads_at_hand<T: Send>(threads: NonZeroUsize, work: impl FnOnce() -> T + Send) -> T {
    let Some(pool) = (THERE_ARE_THREADS && threads.get() > 1).then(|| borrowed(threads)).flatten() else {
        return work();
    };
    let interruption = Interruption::in_force();
    let is_done = AtomicBool::new(false);
    let done = pool.scope(|scope| {
        (1..threads.get()).for_each(|_| scope.spawn(|_| help_until(&is_done)));
        // Also where the work ends in a panic.
        let _ended = Ended(&is_done);
        HAS_TEAM.set(true);
        interruption.within(work)
    });
    IDLE.lock().unwrap_or_else(PoisonError::into_inner).push(Idle { process: process::id(), pool });
    done
}

/// Tells that work has ended, when it goes.
struct Ended<'a>(&'a AtomicBool);

impl Drop for Ended<'_> {
    fn drop(&mut self) {
        HAS_TEAM.set(false);
        self.0.store(true, Ordering::Release);
    }
}

/// Does what jobs there are until a flag is raised, on a thread that does not have the work itself.
fn help_until(is_done: &AtomicBool) {
    let mut looks = 0;
    while !HAS_TEAM.get() && !is_done.load(Ordering::Acquire) {
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

/// Does each of so many jobs once, by their numbers, on so many threads at most of those that are at hand; returns when
/// all are done. Without any it does them one after the other.
///
/// # Panics
/// If a job does.
pub fn each_on_threads(threads: NonZeroUsize, jobs: usize, job: &(dyn Fn(usize) + Sync)) {
    if !HAS_TEAM.get() {
        return (0..jobs).for_each(job);
    }
    let (next, interruption) = (AtomicUsize::new(0), Interruption::in_force());
    let work = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= jobs {
                return;
            }
            job(number);
        }
    };
    let shares = (0..threads.get().min(jobs)).into_par_iter().with_max_len(1);
    shares.for_each(|_| interruption.within(work));
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::sync::{Arc, Barrier};

    fn threads(count: usize) -> NonZeroUsize {
        NonZeroUsize::new(count).unwrap()
    }

    #[test]
    fn each_job_is_done_once() {
        for (count, jobs) in [(1, 0), (1, 7), (2, 0), (3, 2), (2, 1000)] {
            let counts: Vec<AtomicUsize> = (0..jobs).map(|_| AtomicUsize::new(0)).collect();
            let job = |job: usize| {
                counts[job].fetch_add(1, Ordering::Relaxed);
            };
            with_threads_at_hand(threads(count), || each_on_threads(threads(count), jobs, &job));
            each_on_threads(threads(count), jobs, &job);
            assert!(counts.iter().all(|count| count.load(Ordering::Relaxed) == 2), "{count} threads, {jobs} jobs");
        }
    }

    /// Jobs on several threads at once, each of which waits for another.
    #[test]
    fn work_and_its_jobs_are_interrupted_as_they_would_be_without_threads() {
        let flag = Arc::new(AtomicBool::new(true));
        let due = || {
            with_threads_at_hand(threads(2), || {
                let (seen, barrier) = (AtomicUsize::new(0), Barrier::new(2));
                each_on_threads(threads(2), 2, &|_| {
                    barrier.wait();
                    seen.fetch_add(usize::from(Interruption::due().is_some()), Ordering::Relaxed);
                });
                (seen.into_inner(), Interruption::due().is_some())
            })
        };
        assert_eq!(Interruption::default().raised_by(flag).within(due), (2, true));
        assert_eq!(due(), (0, false));
    }

    /// Works that share out jobs at once, on more threads than there are.
    #[test]
    fn works_do_not_wait_for_one_another() {
        let count = AtomicUsize::new(0);
        let job = |_| {
            count.fetch_add(1, Ordering::Relaxed);
            // Long enough for others to take some.
            (0..1000).for_each(|_| std::hint::spin_loop());
        };
        let work = || (0..50).for_each(|_| each_on_threads(threads(3), 8, &job));
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| (0..10).for_each(|_| with_threads_at_hand(threads(3), work)));
            }
        });
        assert_eq!(count.into_inner(), 4 * 10 * 50 * 8);
    }

    #[test]
    fn threads_are_let_go_by_work_that_panics() {
        let panics = || with_threads_at_hand(threads(2), || panic!("on purpose"));
        assert!(catch_unwind(AssertUnwindSafe(panics)).is_err());
        assert_eq!(with_threads_at_hand(threads(2), || 5), 5);
    }
}
