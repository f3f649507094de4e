//! The survey of a scene: what can be said before it runs.
//!
//! ```text
//! Model, State → Survey: mass properties, rest gaps and time scales over supports, rest states and modes, verdicts
//!                Survey → text (what `gyration check` prints), JSON
//! ```
//!
//! Nothing here steps in time, and nothing is written anywhere.

pub(crate) mod balance;
mod bands;
mod bodies;
mod cell;
mod complex_bands;
mod continuum;
mod contraction;
mod crowd;
mod encounter;
mod joints;
mod kind;
mod laws;
mod mass;
mod meetings;
mod modes;
mod reach_change;
pub(crate) mod remarks;
mod rest;
mod slip;
mod slipping;
mod softness;
mod springs;
mod strained;
mod supports;
mod text;
mod topology;
mod varied_bands;
mod words;

pub use bands::{BandDerivatives, BandOptions, BandSurvey, CellRestSurvey, EdgeShares, passing_waves};
pub use bodies::{BodyModes, BodySurvey, PairSurvey, SceneModes, Survey, SystemModes, modes, modes_in_json};
pub use cell::unit_cell;
pub use complex_bands::{ComplexBandOptions, ComplexBandSurvey};
pub use continuum::{ContinuumMap, ContinuumSurvey};
pub use encounter::Encounter;
pub use joints::{JointSurvey, LinkageSurvey};
pub use kind::KindSurvey;
pub use laws::LawSurvey;
pub use mass::MassSurvey;
pub use meetings::MeetingSurvey;
pub use modes::{ModeSurvey, Named, RestPlace, RestState, ShapeSurvey, SystemRestState};
pub use rest::{Approach, RestGap};
pub use slip::Slip;
pub use softness::{ProposedLaws, SoftnessSurvey};
pub use springs::SpringSurvey;
pub use strained::{InstabilitySurvey, StrainRow, StrainSurvey};
pub use supports::{PlaneSurvey, SupportSurvey};
pub use topology::{ChernSurvey, TopologySurvey, USUAL_MESH};
pub use varied_bands::{VariedBands, VariedFrequencies};
pub use words::write_rest;
