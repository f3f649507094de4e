//! What a run needs from outside: a place for its rows, somebody who watches, and the ways in which it can fail.

use crate::events::Event;
use crate::outcome::{Reason, Stop};
use gyration::dynamics::Exchange;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::{MemoryError, Statistics, StepReport};
use gyration_record::RecordError;
use std::path::PathBuf;
use std::{fmt, io};

/// Where rows, events and checkpoints go; what is left out goes nowhere.
pub trait Sink {
    /// One sample, flattened in the order of `rows::Fields::arrays`.
    ///
    /// # Errors
    /// Whatever keeps it from being stored.
    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        let _ = (time, row);
        Ok(())
    }

    /// What any two do to each other at the sample whose row comes next, where the run is asked for it.
    ///
    /// # Errors
    /// Whatever keeps it from being stored.
    fn exchanges(&mut self, exchanges: &[Exchange]) -> Result<(), RecordError> {
        let _ = exchanges;
        Ok(())
    }

    /// One event.
    ///
    /// # Errors
    /// Whatever keeps it from being stored.
    fn event(&mut self, event: &Event) -> Result<(), RecordError> {
        let _ = event;
        Ok(())
    }

    /// Whether [`Sink::event_row`] is to be called.
    fn wants_event_rows(&self) -> bool {
        false
    }

    /// The row at the time of an event, right after the event itself; from the dense output, as samples are.
    ///
    /// # Errors
    /// Whatever keeps it from being stored.
    fn event_row(&mut self, event: &Event, row: &[f64]) -> Result<(), RecordError> {
        let _ = (event, row);
        Ok(())
    }

    /// The end of a window, when a checkpoint may be taken.
    ///
    /// # Errors
    /// Whatever keeps it from being stored.
    fn window_end(&mut self, at: &dyn WindowEnd) -> Result<(), RecordError> {
        let _ = at;
        Ok(())
    }
}

/// A run at the end of a window.
pub trait WindowEnd {
    /// What a resumed run goes on from to the same bytes.
    fn checkpoint(&self) -> Vec<u8>;

    /// The state of all bodies at the time that they have come to.
    fn state(&self) -> State;
}

/// What the run says of itself after each window, now and then within a long one, and whether it is to go on.
pub trait Monitor {
    /// Called after each window, and now and then within a long one; a reason to stop ends the run.
    fn after_step(&mut self, progress: &Progress) -> Option<Reason>;

    /// Whether it is to be called after each step of any body, since what it asks for depends on their number.
    fn counts_steps(&self) -> bool {
        false
    }
}

/// Where a run stands.
#[derive(Debug, Clone, Copy)]
pub struct Progress<'a> {
    /// Simulated time [s].
    pub time: f64,
    /// The end [s].
    pub end: f64,
    /// The last step of the body that holds the run up: the shortest of all.
    pub step: &'a StepReport,
    /// Counters of all bodies.
    pub statistics: &'a Statistics,
    /// The model of that body, for names.
    pub model: &'a Model,
}

/// The processes that share out a run: its ranks, counted from zero, and how they tell one another bytes.
///
/// Ranks call [`Communicator::all_gather`] equally often and in the same order, each time with bytes of any length.
pub trait Communicator: fmt::Debug + Send + Sync {
    /// The number of this rank.
    fn rank(&self) -> usize;

    /// How many there are.
    fn size(&self) -> usize;

    /// Tells all ranks some bytes, and waits for theirs: those of each rank, in order, its own among them.
    ///
    /// # Errors
    /// Whatever keeps them from being told or heard: the run then ends.
    fn all_gather(&self, own: Vec<u8>) -> io::Result<Vec<Vec<u8>>>;

    /// From how many islands a rank on these are shared out. A step of a ball takes some ten microseconds, and so does
    /// a message within a machine.
    fn least_share(&self) -> usize {
        16
    }
}

/// Why a run could not begin, or its recording not go on.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The start is outside the model.
    #[error("the start is outside the model: {}. {}", .0.what, .0.advice)]
    Start(Stop),
    /// It was given up before its first step.
    #[error("{}, before its first step{}", .0.what, fix_of(.0))]
    Interrupted(Stop),
    /// The thread flushes the smallest numbers to zero, with which steps have other bytes and the first never ends.
    #[error(
        "this thread rounds the smallest numbers to zero, a mode of the processor that a library has set: runs would \
         not be what they are elsewhere\n  fix: run in a thread or process that was begun before, or reset the mode, as by \
         torch.set_flush_denormal(False)"
    )]
    Flushing,
    /// The recording failed.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The ranks of the run cannot go on together.
    #[error("the ranks of this run cannot go on together: {0}\n  fix: give all of them one scene and one program")]
    Ranks(String),
    /// The recording to be resumed is of another scene.
    #[error(
        "{} is a recording of another scene:\n  {what}\n  fix: {fix}; else give another -o, or --force to overwrite it",
        path.display()
    )]
    OtherScene {
        /// The recording.
        path: PathBuf,
        /// A line for each key or file that differs.
        what: String,
        /// With which overrides, or files, it goes on.
        fix: String,
    },
    /// The checkpoint is not one of this program.
    #[error("the checkpoint cannot be used: {0}; run the scene anew with --force")]
    Checkpoint(String),
}

impl RunError {
    /// A checkpoint that cannot be read.
    pub(crate) fn unfit_checkpoint(bytes: &[u8]) -> Self {
        let why = match bytes.is_empty() {
            true => "there is none, since the motion was stepped by hand",
            false => "its bytes are damaged, or another version of the program wrote them",
        };
        Self::Checkpoint(why.into())
    }

    /// Why a run cannot start.
    pub(crate) fn at_start(stop: Stop) -> Self {
        match stop.reason {
            Reason::Interrupted | Reason::WallTime => Self::Interrupted(stop),
            _ => Self::Start(stop),
        }
    }
}

/// What to do about a run that was given up before it had anything to resume.
fn fix_of(stop: &Stop) -> &'static str {
    match stop.reason {
        Reason::WallTime => {
            "\n  fix: raise solver.max_wall_time, or give very many bodies that meet a `reach`, or inclusion.triangles \
             a smaller number"
        }
        _ => "",
    }
}

impl From<MemoryError> for RunError {
    fn from(error: MemoryError) -> Self {
        Self::Checkpoint(error.to_string())
    }
}
