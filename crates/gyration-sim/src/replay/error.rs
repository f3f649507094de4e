//! Why a recording cannot be brought back to life.

use gyration::Inadmissible;
use gyration_record::RecordError;
use gyration_scene::SceneErrors;
use std::path::PathBuf;

/// Failure to replay a recording.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReplayError {
    /// The recording cannot be read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The recording does not say of which scene it is.
    #[error("{path} has neither the attribute `resolved` nor `scene`: what depends on the scene cannot be computed")]
    NoScene {
        /// The recording.
        path: PathBuf,
    },
    /// Its scene is no scene for this program, or a file that it refers to is not there.
    #[error(
        "the scene of {path} cannot be built again (a file that it refers to is looked for beside the recording and \
         in the current folder): {errors}"
    )]
    Scene {
        /// The recording.
        path: PathBuf,
        /// What is wrong.
        errors: Box<SceneErrors>,
    },
    /// Files that its scene refers to have other numbers than when the run was made.
    #[error("{path}: what its scene refers to has changed since the run was made: {files}")]
    OtherFiles {
        /// The recording.
        path: PathBuf,
        /// Each with the key that names it.
        files: String,
    },
    /// Its scene now leads to another body than the one recorded.
    #[error(
        "{path}: the scene no longer leads to the body `{body}` that was recorded: {quantity} differs; a file that the \
         scene refers to has changed"
    )]
    OtherBody {
        /// The recording.
        path: PathBuf,
        /// Name of the body recorded.
        body: String,
        /// What differs.
        quantity: &'static str,
    },
    /// Its checkpoint is not understood.
    #[error("{path}: what the run had reached cannot be told ({reason})")]
    Checkpoint {
        /// The recording.
        path: PathBuf,
        /// Why not.
        reason: String,
    },
    /// A row is outside the model.
    #[error("row {row} is outside the model: {source}")]
    Inadmissible {
        /// The row.
        row: usize,
        /// Which body, which quantity.
        source: Inadmissible,
    },
}
