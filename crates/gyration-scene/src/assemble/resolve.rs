//! What the file leaves to be derived, written back into it: kind, start, defaults that depend on other keys.
//!
//! A scene resolves to itself: what is written here is read again as it stands.

use super::unit::Unit;
use crate::file::{Affine, Body, Contractile, DriveLaw, Entry, Joint, Rigid, Signal};
use crate::quantity::{GradientRate, Pressure, Velocity as Speed};
use crate::units::parse_quantity;
use gyration::kinematics::{Placement, Velocity};
use gyration::state::Start;
use gyration::tensor::Mat3;

/// Writes a torque or force of a drive that has a unit of one in SI units.
pub(super) fn resolve_drive(joint: &mut Joint) {
    let Some(drive) = &mut joint.drive else { return };
    for (law, of) in [(&mut drive.torque, &Unit::TORQUE), (&mut drive.force, &Unit::FORCE)] {
        if let Some(DriveLaw::Feedback(Entry::Expression(text))) = law
            && let Ok((number, unit)) = parse_quantity(text)
            && of.is_of(unit.dimension)
        {
            *law = Some(DriveLaw::Feedback(Entry::Number(number * unit.size)));
        }
    }
}

/// Completes a body as it starts.
pub(super) fn resolve(body: &mut Body, start: &Start) {
    match start {
        Start::Rigid(start) => {
            body.rigid = Some(Rigid {});
            body.orientation.get_or_insert_default();
            body.angular_velocity.get_or_insert_default();
            body.velocity = start.velocity.map(Speed).into();
        }
        Start::Affine(placement, velocity) => {
            moves(body, placement, velocity);
            if let Some(affine) = &mut body.affine {
                complete(affine);
            }
        }
        Start::Contractile(placement, velocity, contraction) => {
            moves(body, placement, velocity);
            if let Some(contractile) = &mut body.contractile {
                complete(&mut contractile.affine);
                contracts(contractile, contraction);
            }
        }
    }
    inclusion_start(body);
}

/// The velocities of a body without inertia are no part of its start; a history has an error.
fn inclusion_start(body: &mut Body) {
    if let Some(inclusion) = body.inclusion.as_mut().filter(|inclusion| inclusion.history) {
        inclusion.history_error.get_or_insert(super::fluid::HISTORY_ERROR);
    }
    if body.inclusion.as_ref().is_some_and(|inclusion| !inclusion.inertia) {
        body.velocity = Default::default();
        body.angular_velocity = None;
        body.gradient_rate = None;
    }
}

/// Placement and velocity of a body that deforms.
fn moves(body: &mut Body, placement: &Placement, velocity: &Velocity) {
    body.orientation = None;
    body.gradient = Some(rows(&placement.gradient));
    // A copy that is turned keeps a spin in space, and turns a rate of the gradient.
    if body.copies.is_none() || body.gradient_rate.is_some() {
        body.angular_velocity = None;
        body.gradient_rate = Some(rows(&velocity.gradient_rate).map(|row| row.map(GradientRate)));
    }
    body.velocity = velocity.velocity.map(Speed).into();
}

/// How a body contracts, and where its ramps start.
fn contracts(written: &mut Contractile, contraction: &Mat3) {
    if let Some(drive) = &mut written.drive {
        start_ramps(drive, [[Pressure(0.0); 3]; 3]);
    }
    match &mut written.prescribed {
        Some(prescribed) => start_ramps(prescribed, rows(&Mat3::identity())),
        None => {
            written.contraction = Some(rows(contraction));
            written.isochoric.get_or_insert_default();
            written.spin.get_or_insert_default();
        }
    }
}

fn start_ramps<V: Copy>(signal: &mut Signal<V>, rest: V) {
    match signal {
        Signal::Ramp(ramp) => {
            ramp.from.get_or_insert(rest);
        }
        Signal::Sum(parts) => parts.iter_mut().for_each(|part| start_ramps(part, rest)),
        Signal::Constant(_) | Signal::Sine(_) | Signal::Square(_) | Signal::Table(_) => {}
    }
}

/// Of the two coefficients of internal friction the one not given is zero.
fn complete(affine: &mut Affine) {
    if let Some(friction) = affine.internal_friction.as_mut().filter(|friction| friction.matrix.is_none()) {
        friction.shear.get_or_insert_default();
        friction.bulk.get_or_insert_default();
    }
}

fn rows(matrix: &Mat3) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[(row, column)]))
}
