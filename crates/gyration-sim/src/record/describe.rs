//! Supports as a recording describes them, for whoever draws them.

use gyration::solid_support::SolidSupport;
use gyration::support::{MotionPart, Support, SupportMotion};
use serde_json::{Value, json};

/// A plane.
pub(super) fn describe_support(support: &Support) -> Value {
    json!({
        "name": support.name,
        "origin": support.origin.as_slice(),
        "normal": support.normal.as_slice(),
        "motion": describe_motion(&support.motion),
    })
}

/// A support with a shape: which of the surfaces is its own, and where it is before any motion.
pub(super) fn describe_solid_support(support: &SolidSupport, surface: Option<usize>) -> Value {
    json!({
        "name": support.name,
        "surface": surface,
        "position": support.start.position.as_slice(),
        "gradient": support.start.gradient.transpose().as_slice(),
        "motion": describe_motion(&support.motion),
    })
}

/// Nothing of a support at rest, the motion of one that has a single part, else a list of them.
fn describe_motion(motion: &SupportMotion) -> Value {
    let described = |part: &MotionPart| match part {
        MotionPart::Velocity(velocity) => json!({ "velocity": velocity.as_slice() }),
        MotionPart::Oscillation { direction, amplitude, frequency, phase } => json!({ "oscillate": {
            "direction": direction.as_slice(), "amplitude": amplitude, "frequency": frequency, "phase": phase,
        }}),
        MotionPart::Rotation { axis, point, rate } => json!({ "rotate": {
            "axis": axis.as_slice(), "point": point.as_slice(), "rate": rate,
        }}),
    };
    match motion.parts() {
        [] => Value::Null,
        [part] => described(part),
        parts => parts.iter().map(described).collect(),
    }
}
