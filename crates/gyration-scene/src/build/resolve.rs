//! What the file leaves to be derived, written back into it: kind, start, defaults that depend on other keys.
//!
//! A scene resolves to itself: what is written here is read again as it stands.

use crate::file::{Body, InternalFriction, Rigid};
use crate::quantity::{GradientRate, Velocity as Speed};
use gyration::state::Start;
use gyration::tensor::Mat3;

/// Completes a body as it starts.
pub(super) fn resolve(body: &mut Body, start: &Start) {
    match start {
        Start::Rigid(start) => {
            body.rigid = Some(Rigid {});
            body.orientation.get_or_insert_default();
            body.angular_velocity.get_or_insert_default();
            body.velocity = start.velocity.map(Speed).into();
        }
        Start::Affine(placement, velocity) | Start::Contractile(placement, velocity, _) => {
            body.orientation = None;
            body.angular_velocity = None;
            body.gradient = Some(rows(&placement.gradient));
            body.gradient_rate = Some(rows(&velocity.gradient_rate).map(|row| row.map(GradientRate)));
            body.velocity = velocity.velocity.map(Speed).into();
        }
    }
    if let Some(friction) = body.affine.as_mut().and_then(|affine| affine.internal_friction.as_mut()) {
        complete(friction);
    }
}

/// Of the two coefficients the one not given is zero.
fn complete(friction: &mut InternalFriction) {
    if friction.matrix.is_none() {
        friction.shear.get_or_insert_default();
        friction.bulk.get_or_insert_default();
    }
}

fn rows(matrix: &Mat3) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[(row, column)]))
}
