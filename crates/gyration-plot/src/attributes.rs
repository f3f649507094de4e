//! What a recording says of itself, in types of ours: attributes, and motions of supports.

use crate::error::PlotError;
use gyration::support::{MotionPart, SupportMotion};
use gyration_record::Recording;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// How a support moves: one motion, or several that add up.
#[derive(Deserialize)]
#[serde(untagged)]
pub(crate) enum MotionPicture {
    One(MotionPartPicture),
    Several(Vec<MotionPartPicture>),
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum MotionPartPicture {
    Velocity([f64; 3]),
    Oscillate { direction: [f64; 3], amplitude: f64, frequency: f64, phase: f64 },
    Rotate { axis: [f64; 3], point: [f64; 3], rate: f64 },
}

impl From<MotionPartPicture> for MotionPart {
    fn from(picture: MotionPartPicture) -> Self {
        match picture {
            MotionPartPicture::Velocity(velocity) => Self::Velocity(velocity.into()),
            MotionPartPicture::Oscillate { direction, amplitude, frequency, phase } => {
                Self::Oscillation { direction: direction.into(), amplitude, frequency, phase }
            }
            MotionPartPicture::Rotate { axis, point, rate } => {
                Self::Rotation { axis: axis.into(), point: point.into(), rate }
            }
        }
    }
}

/// The motion that a recording describes.
pub(crate) fn motion(picture: Option<MotionPicture>) -> SupportMotion {
    let parts = match picture {
        None => Vec::new(),
        Some(MotionPicture::One(part)) => vec![part],
        Some(MotionPicture::Several(parts)) => parts,
    };
    SupportMotion::new(parts.into_iter().map(MotionPart::from).collect())
}

/// An attribute of the recording in a type of ours.
pub(crate) fn attribute<T: DeserializeOwned>(recording: &Recording, name: &'static str) -> Result<T, PlotError> {
    described(recording, name, recording.attributes().get(name).unwrap_or(&Value::Null))
}

/// A part of an attribute in a type of ours.
pub(crate) fn described<T: DeserializeOwned>(
    recording: &Recording,
    name: &'static str,
    value: &Value,
) -> Result<T, PlotError> {
    T::deserialize(value).map_err(|error| PlotError::Attribute {
        path: recording.path().to_path_buf(),
        name,
        reason: error.to_string(),
    })
}
