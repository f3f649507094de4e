//! Makes the runs that are missing in a table, on the threads of one machine.
//!
//! Threads take run numbers from one line and hand rows to the thread that writes. Which thread makes a run, and when,
//! leaves no trace in the table.

use crate::error::StudyError;
use crate::run::Worker;
use crate::study::Study;
use crate::table::Table;
use crate::value::{Row, Value};
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// Between two looks of a monitor that nothing else calls.
const LOOK: Duration = Duration::from_millis(100);
/// Threads at most.
const MOST_THREADS: usize = 1024;
/// Rows that wait for the writer at most, per thread.
const WAITING: usize = 64;

/// Watches a study, and may ask it to stop.
pub trait Watcher {
    /// Called now and then; true asks to stop: runs that are under way are given up, and come again when it is resumed.
    fn look(&mut self, progress: &Progress) -> bool;
}

/// Where a study stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// Rows of the table, those of earlier times included.
    pub done: u64,
    /// Rows that it will have.
    pub total: u64,
    /// Rows of this time.
    pub made: u64,
    /// Of these, rows that ended neither completed nor at rest.
    pub early: u64,
}

/// How many threads compute.
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
            None => Ok(thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)),
            Some(threads) if threads > MOST_THREADS => Err(Self::TooMany(threads)),
            Some(threads) => NonZeroUsize::new(threads).ok_or(Self::None),
        }
    }

    /// What to do.
    pub fn fix(self) -> String {
        format!("ask for 1 to {MOST_THREADS}, or leave it out for all processors")
    }
}

/// Watches nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Watcher for Unwatched {
    fn look(&mut self, _: &Progress) -> bool {
        false
    }
}

/// Makes the missing runs of a table and finishes it; false if it was asked to stop before.
///
/// # Errors
/// Whatever keeps rows or recordings from being written; the rows before are kept.
pub fn execute(
    study: &Study,
    table: &mut Table,
    threads: NonZeroUsize,
    watcher: &mut dyn Watcher,
) -> Result<bool, StudyError> {
    let stop = Arc::new(AtomicBool::new(false));
    let numbers = Mutex::new(table.missing());
    let worker = Worker::new().recording_into(&table.recordings()).stopped_by(Arc::clone(&stop));
    let written = thread::scope(|scope| {
        let (sender, receiver) = sync_channel(WAITING * threads.get());
        for _ in 0..threads.get() {
            let (sender, numbers, worker, stop) = (sender.clone(), &numbers, worker.clone(), Arc::clone(&stop));
            scope.spawn(move || work(study, numbers, &worker, (&stop, &sender)));
        }
        drop(sender);
        let mut progress = Progress { done: table.rows(), total: table.runs(), made: 0, early: 0 };
        let mut written = Ok(());
        loop {
            let mut rows = Vec::new();
            match receiver.recv_timeout(LOOK) {
                Ok(row) => rows.push(row),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            rows.extend(receiver.try_iter());
            if written.is_ok() {
                written = write(table, rows, &mut progress);
            }
            if watcher.look(&progress) || written.is_err() {
                stop.store(true, Ordering::Relaxed);
            }
        }
        written
    });
    written?;
    table.finish()
}

/// Makes runs until there are no more, or a recording fails.
fn work(
    study: &Study,
    numbers: &Mutex<impl Iterator<Item = u64>>,
    worker: &Worker,
    (stop, sender): (&AtomicBool, &SyncSender<Result<Row, StudyError>>),
) {
    while !stop.load(Ordering::Relaxed) {
        // A thread that panics leaves an iterator that is whole.
        let next = numbers.lock().unwrap_or_else(PoisonError::into_inner).next();
        let Some(run) = next else { return };
        let row = match study.attempt(run, worker) {
            Ok(Some(row)) => Ok(row),
            Ok(None) => return,
            Err(error) => Err(error),
        };
        let is_over = row.is_err();
        if sender.send(row).is_err() || is_over {
            return;
        }
    }
}

fn write(table: &mut Table, rows: Vec<Result<Row, StudyError>>, progress: &mut Progress) -> Result<(), StudyError> {
    let mut fault = Ok(());
    let mut whole = Vec::with_capacity(rows.len());
    for row in rows {
        match row {
            Ok(row) => whole.push(row),
            Err(error) => fault = Err(error),
        }
    }
    table.append(&whole)?;
    progress.done = table.rows();
    progress.made += whole.len() as u64;
    progress.early += whole.iter().filter(|row| is_early(row, table)).count() as u64;
    fault
}

/// Whether a run ended neither completed nor at rest.
fn is_early(row: &Row, table: &Table) -> bool {
    let outcome = table.outcome().and_then(|index| row.values.get(index)).and_then(Value::text);
    !matches!(outcome, Some("completed" | "at_rest"))
}
