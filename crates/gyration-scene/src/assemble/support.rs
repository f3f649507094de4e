//! Supports: planes with unit normals, and their motions.

use crate::check::direction;
use crate::file::{Motion, Support};
use crate::quantity::si;
use gyration::support::{Support as Plane, SupportMotion};

/// The support, if its directions are not zero (which the checks have noted otherwise).
pub(super) fn support(support: &Support) -> Option<Plane> {
    let motion = match &support.motion {
        None => SupportMotion::Fixed,
        Some(Motion::Velocity(velocity)) => SupportMotion::Velocity(si(velocity)),
        Some(Motion::Oscillate(oscillation)) => SupportMotion::Oscillation {
            direction: direction(&oscillation.direction)?,
            amplitude: oscillation.amplitude.0,
            frequency: oscillation.frequency.value(),
            phase: oscillation.phase.0,
        },
    };
    let normal = direction(&support.plane.normal)?;
    Some(Plane { name: support.name.clone(), origin: si(&support.plane.origin), normal, motion })
}
