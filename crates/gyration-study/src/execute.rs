//! Makes the runs that are missing in a table, on the threads of one machine.
//!
//! Threads take run numbers from one line and hand rows to the thread that writes (`gyration_threads`). Which thread
//! makes a run, and when, leaves no trace in the table.

use crate::error::StudyError;
use crate::run::Worker;
use crate::study::Study;
use crate::table::Table;
use crate::value::{Row, Value};
use gyration_sim::Unwatched;
use gyration_threads::share;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Watches a study, and may ask it to stop.
pub trait StudyMonitor {
    /// Called now and then; true asks to stop: runs that are under way are given up, and come again when it is resumed.
    fn after_rows(&mut self, progress: &StudyProgress) -> bool;
}

/// Where a study stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StudyProgress {
    /// Rows of the table, those of earlier times included.
    pub done: u64,
    /// Rows that it will have.
    pub total: u64,
    /// Rows of this time.
    pub made: u64,
    /// Of these, rows that ended neither completed nor at rest.
    pub early: u64,
}

impl StudyMonitor for Unwatched {
    fn after_rows(&mut self, _: &StudyProgress) -> bool {
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
    monitor: &mut dyn StudyMonitor,
) -> Result<bool, StudyError> {
    let stop = Arc::new(AtomicBool::new(false));
    let worker = Worker::new().recording_into(&table.recordings()).stopped_by(Arc::clone(&stop));
    let mut progress = StudyProgress { done: table.rows(), total: table.runs(), made: 0, early: 0 };
    let mut written = Ok(());
    let run = |run| study.attempt(run, &worker).transpose();
    share(table.missing(), threads, &stop, run, |rows| {
        if written.is_ok() {
            written = write(table, rows, &mut progress);
        }
        if monitor.after_rows(&progress) || written.is_err() {
            stop.store(true, Ordering::Relaxed);
        }
    });
    // Also where a row could not be made: those before it are kept.
    written.and(table.sync())?;
    table.finish()
}

fn write(
    table: &mut Table,
    rows: Vec<Result<Row, StudyError>>,
    progress: &mut StudyProgress,
) -> Result<(), StudyError> {
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
