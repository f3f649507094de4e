//! Why there is no picture.

use gyration_record::RecordError;
use std::path::PathBuf;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// The recording cannot be read, or the picture not be written.
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
    /// The arguments ask for something that is not to be had.
    #[error("{problem}\n  fix: {fix}")]
    Arguments {
        /// What is wrong.
        problem: String,
        /// What to do.
        fix: String,
    },
}

impl PlotError {
    /// Arguments that cannot be met, and what to do instead.
    pub(crate) fn arguments(problem: impl Into<String>, fix: impl Into<String>) -> Self {
        Self::Arguments { problem: problem.into(), fix: fix.into() }
    }
}
