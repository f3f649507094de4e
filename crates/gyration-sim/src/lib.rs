//! Joins mechanics, steppers and recordings: the run loop, samples, ledger, checkpoints, outcome.
//!
//! ```text
//! Model, State → Simulation::run → Sink → recording
//!     step = stepper(rates, jacobian)            adapter.rs shows a model to a stepper
//!     samples and events from the dense output   rows.rs, events.rs
//!     audit, next sample, rest                   run_state.rs: with the stepper's memory, the checkpoint
//! ```

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod adapter;
mod crowd;
mod eigenvalues;
pub mod events;
mod field_samples;
pub mod fields;
mod first_steps;
pub mod format;
mod hold_joints;
mod in_play;
mod island;
mod looseness;
pub mod modes;
mod network;
pub mod orbit;
mod outcome;
mod peaks;
mod period;
mod plan;
mod ports;
mod projection;
mod record;
pub mod replay;
pub mod resistance;
mod ring_spectrum;
pub mod rows;
mod run;
mod run_state;
mod scales;
mod scene_files;
pub mod sensitivity;
mod singular_values;
mod stepping;
mod sum;
mod summary;
pub mod survey;
mod variation;
mod wall_time;
pub mod waves;

pub use adapter::Tolerance;
pub use crowd::CrowdState;
pub use field_samples::{FieldGrid, FieldLayer, FieldMap, FieldMaps, FieldPoints, FieldSurvey, NoFields};
pub use first_steps::{FirstSteps, MomentumChange};
pub use network::{Push, network};
pub use outcome::{Outcome, Reason, Stop, limit_in_words};
pub use plan::{RestCriterion, RunPlan};
pub use ports::{Communicator, Monitor, Progress, RunError, Sink, WindowEnd};
pub use record::pairs::entries;
pub use record::{BegunRun, Job, MemorySink, Provenance, RecordingEnd, Unwatched, differences, pairs_csv};
pub use resistance::{complete, completed, open, open_at_rest};
pub use ring_spectrum::{BranchSpectrum, NoRingSpectrum, RingSpectrum};
pub use run::Simulation;
pub use stepping::{BodyStart, Refusal, SteppedRun};
pub use summary::{Balance, BodySummary, LedgerSummary, OpenLedgers, RunSummary, Verdict};
pub use survey::remarks::Remarks;
pub use wall_time::within_wall_time;
