//! Joins mechanics, steppers and recordings: the run loop, samples, ledger, checkpoints, outcome.
//!
//! ```text
//! Model, State → Simulation::run → Sink → recording
//!     step = stepper(rates, jacobian)            adapter.rs shows a model to a stepper
//!     samples and events from the dense output   rows.rs, events.rs
//!     audit, next sample, rest                   tally.rs: with the stepper's memory, the checkpoint
//! ```

pub mod adapter;
mod by_hand;
mod detached;
pub mod events;
pub mod format;
mod horizon;
pub mod modes;
mod outcome;
mod period;
mod plan;
mod ports;
mod record;
pub mod replay;
pub mod resistance;
pub mod rows;
mod run;
pub mod sensitivity;
mod summary;
pub mod survey;
mod tally;
mod views;
mod watch;

pub use adapter::Tolerance;
pub use by_hand::{HandStepper, Refusal};
pub use outcome::{Outcome, Reason, Stop, limit_in_words};
pub use plan::{RestCriterion, RunPlan};
pub use ports::{Monitor, Progress, RunError, Sink};
pub use record::{Job, MemorySink, Provenance, Recorded, Unwatched};
pub use resistance::{complete, completed, open};
pub use run::Simulation;
pub use summary::{BodySummary, LedgerSummary, RunSummary};
