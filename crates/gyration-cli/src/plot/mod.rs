//! Pictures of recordings and scenes.
//!
//! ```text
//! recording, scene → show (which quantities) → chart, strip (how they are laid out) → draw (marks on a page) → SVG, PNG, PDF
//! table of a study → study (how often, how on average, where) ↗
//! ```
//!
//! The same recording gives the same bytes: there are neither dates nor names of machines in a picture.

#[cfg(feature = "study")]
pub mod calibration;
// Without studies nobody fills areas or names places of an axis.
#[cfg_attr(not(feature = "study"), allow(dead_code, unused_imports))]
pub mod chart;
mod cycle;
pub mod draw;
pub mod recorded;
pub mod show;
pub mod strip;
#[cfg(feature = "study")]
pub mod study;
mod thin;

use gyration_record::RecordError;
use std::path::PathBuf;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// The recording cannot be read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The recording does not describe what is in it.
    #[error("{path}: the attribute `{name}` of the recording cannot be used ({reason}): record the scene anew", path = path.display())]
    Attribute {
        /// The recording.
        path: PathBuf,
        /// The attribute.
        name: &'static str,
        /// What is wrong with it.
        reason: String,
    },
    /// There is no sample.
    #[error("{path}: the recording has no samples yet", path = path.display())]
    Empty {
        /// The recording.
        path: PathBuf,
    },
    /// What was asked for is not there.
    #[error("there is nothing to draw for `{what}`: {reason}")]
    Nothing {
        /// What was asked for.
        what: &'static str,
        /// Why not.
        reason: &'static str,
    },
    /// A measure that no body of the recording has.
    #[error(
        "the recording has no measure `{name}` of a body that contracts\n  fix: two measures with a comma between them, named as \
         columns of the CSV without the body: `--measures G_xz,G_zz`, P_xx, Pdot_xx, x, vx, fx, gap, pressure; V_xx and \
         Q_xx are contraction velocity and drive"
    )]
    Measure {
        /// What was asked for.
        name: String,
    },
}
