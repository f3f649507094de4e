//! Jobs from one line, on many threads; results to the one that asked.

use crate::count::THERE_ARE_THREADS;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::thread::{self, ScopedJoinHandle};
use std::time::Duration;

/// Between two looks while nothing comes.
const LOOK: Duration = Duration::from_millis(50);
/// Results that wait at most, per thread.
const WAITING: usize = 64;

/// Does jobs on so many threads, and gives the results to `take` on this one, in the order in which they come.
///
/// `take` is also called while nothing comes, with nothing. Once `stop` is true no job is begun; the ones under way may
/// look at it too. A job without a result ends its thread. Where there are no threads all is done on this one.
///
/// # Panics
/// If a job does, when the others have ended.
pub fn share<J: Send, T: Send>(
    jobs: impl Iterator<Item = J> + Send,
    threads: NonZeroUsize,
    stop: &AtomicBool,
    work: impl Fn(J) -> Option<T> + Sync,
    mut take: impl FnMut(Vec<T>),
) {
    if !THERE_ARE_THREADS {
        let results = jobs.take_while(|_| !stop.load(Ordering::Relaxed)).map_while(work);
        return results.for_each(|result| take(vec![result]));
    }
    let jobs = Mutex::new(jobs);
    let work = |results: SyncSender<T>| {
        while !stop.load(Ordering::Relaxed) {
            // A thread that panics leaves an iterator that is whole.
            let next = jobs.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some(result) = next.and_then(&work) else { return };
            if results.send(result).is_err() {
                return;
            }
        }
    };
    thread::scope(|scope| {
        let (sender, receiver) = sync_channel(WAITING * threads.get());
        let work = &work;
        let workers: Vec<_> = (0..threads.get())
            .map(|_| {
                let sender = sender.clone();
                scope.spawn(move || work(sender))
            })
            .collect();
        drop(sender);
        while let Some(results) = received(&receiver) {
            take(results);
        }
        workers.into_iter().map(ScopedJoinHandle::join).for_each(|ended| {
            if let Err(panic) = ended {
                std::panic::resume_unwind(panic);
            }
        });
    });
}

/// What has come, or nothing if that takes long; none once all threads have ended.
fn received<T>(receiver: &Receiver<T>) -> Option<Vec<T>> {
    match receiver.recv_timeout(LOOK) {
        Ok(first) => Some(std::iter::once(first).chain(receiver.try_iter()).collect()),
        Err(RecvTimeoutError::Timeout) => Some(Vec::new()),
        Err(RecvTimeoutError::Disconnected) => None,
    }
}

/// The results of jobs that are done on so many threads, in the order of the jobs.
///
/// # Panics
/// If a job does.
pub fn in_order<J: Send, T: Send>(
    jobs: impl IntoIterator<Item = J, IntoIter: Send>,
    threads: NonZeroUsize,
    work: impl Fn(J) -> T + Sync,
) -> Vec<T> {
    let mut done = Vec::new();
    let job = |(index, job)| Some((index, work(job)));
    share(jobs.into_iter().enumerate(), threads, &AtomicBool::new(false), job, |results| done.extend(results));
    done.sort_unstable_by_key(|(index, _): &(usize, T)| *index);
    done.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::sync::Barrier;

    fn threads(count: usize) -> NonZeroUsize {
        NonZeroUsize::new(count).unwrap()
    }

    #[test]
    fn results_are_in_the_order_of_the_jobs_on_any_number_of_threads() {
        let squares: Vec<u64> = (0..1000).map(|job| job * job).collect();
        for count in [1, 3, 64] {
            assert_eq!(in_order(0..1000, threads(count), |job: u64| job * job), squares);
        }
        assert_eq!(in_order(0..0, threads(2), |job: u64| job), []);
    }

    /// Each of two jobs waits for the other: on one thread neither would end.
    #[test]
    fn jobs_are_done_side_by_side() {
        let barrier = Barrier::new(2);
        assert_eq!(in_order(0..2, threads(2), |_| barrier.wait()).len(), 2);
    }

    #[test]
    fn whoever_takes_the_results_may_stop_the_rest() {
        let (stop, mut taken) = (AtomicBool::new(false), Vec::new());
        share(0_u64.., threads(3), &stop, Some, |results| {
            taken.extend(results);
            stop.store(!taken.is_empty(), Ordering::Relaxed);
        });
        // What waited when it was stopped is taken too: nothing is lost, nothing is left out.
        taken.sort_unstable();
        assert!(!taken.is_empty() && taken.iter().copied().eq(0..taken.len() as u64), "{taken:?}");
    }

    #[test]
    fn one_looks_around_while_a_job_takes_long() {
        let (seen, mut looks) = (AtomicBool::new(false), 0);
        let long = |(): ()| {
            while !seen.load(Ordering::Relaxed) {
                thread::yield_now();
            }
            Some(())
        };
        share([()].into_iter(), threads(1), &AtomicBool::new(false), long, |results| {
            looks += usize::from(results.is_empty());
            seen.store(looks >= 2, Ordering::Relaxed);
        });
        assert!(looks >= 2);
    }

    #[test]
    fn a_job_without_a_result_ends_its_thread_alone() {
        let odd = |job: u64| (job != 0).then_some(job);
        let mut taken = Vec::new();
        share(0..9, threads(1), &AtomicBool::new(false), odd, |results| taken.extend(results));
        assert!(taken.is_empty());
    }

    #[test]
    fn a_panic_of_a_job_is_that_of_the_whole() {
        let caught = catch_unwind(AssertUnwindSafe(|| {
            in_order(0..8, threads(2), |job: u64| if job == 3 { panic!("the third") } else { job })
        }));
        assert_eq!(caught.unwrap_err().downcast_ref::<&str>(), Some(&"the third"));
    }
}
