//! An affine body: the balance solved for its rates.
//!
//!   m p̈₀ = m g + f,   P̈ J = M − V S;   pinned at r: P̈ J_p = M − (f + m g) ⊗ r − V S

use super::loads::Acting;
use crate::affine::{AffineBalance, AffineBody, Gyration};
use crate::body::{Affine, Slots};
use crate::instant::MotionAt;
use crate::ledger::Work;
use crate::load::Loads;
use crate::tensor::Mat3;

/// The affine moment of some loads about the centre of mass, or about the pin.
#[inline]
pub(crate) fn moment(at: &MotionAt, loads: &Loads) -> Mat3 {
    match &at.body.pin {
        None => loads.moment,
        Some(pin) => loads.moment - (loads.force + at.body.solid.mass.mass * at.model.gravity) * pin.point.transpose(),
    }
}

/// P̈, stress and pressure of an affine body under some loads.
#[inline]
pub(crate) fn balance(at: &MotionAt, affine: &Affine, gyration: &Gyration, loads: &Loads) -> AffineBalance {
    let mut balance = affine.interior.balance(gyration, &moment(at, loads));
    if let Some(pressure) = &mut balance.pressure {
        let excess = excess(at, &affine.interior, gyration, &balance.acceleration);
        *pressure -= excess;
        balance.stress += excess * gyration.inverse.transpose();
    }
    balance
}

/// λ/V, by which the pressure that keeps det P is less where the body has no inertia \[Pa\]: P̈ = λ Y is then no
/// acceleration but what that pressure takes back.
pub(super) fn excess(at: &MotionAt, interior: &AffineBody, gyration: &Gyration, acceleration: &Mat3) -> f64 {
    if at.body.has_inertia() {
        return 0.0;
    }
    let across = gyration.inverse.transpose();
    let way = across * interior.inverse;
    acceleration.dot(&across) / (way.dot(&across) * interior.volume)
}

/// Solves the balance for the rates, and adds the powers of friction and constraint.
#[inline]
pub(super) fn fill(
    at: &MotionAt,
    affine: &Affine,
    gyration: &Gyration,
    acting: &mut Acting,
    slots: &Slots,
    rates: &mut [f64],
) {
    let balance = balance(at, affine, gyration, &acting.total);
    acting.powers[Work::Viscosity] -= balance.dissipation;
    if let Some(pressure) = balance.pressure {
        let growth = gyration.velocity_gradient.trace();
        acting.powers[Work::Constraint] += pressure * affine.interior.volume * growth;
    }
    write(at, acting, &balance.acceleration, slots, rates);
}

/// Writes the rates of p₀, P, ṗ₀ and Ṗ, those of the velocities from the force and P̈.
#[inline]
pub(super) fn write(at: &MotionAt, acting: &Acting, acceleration: &Mat3, slots: &Slots, rates: &mut [f64]) {
    let velocity = &at.motion.velocity;
    if at.body.pin.is_none() {
        let linear = at.model.gravity + acting.total.force / at.body.solid.mass.mass;
        rates[slots.position()].copy_from_slice(velocity.velocity.as_slice());
        rates[slots.velocity()].copy_from_slice(linear.as_slice());
    }
    rates[slots.attitude()].copy_from_slice(velocity.gradient_rate.as_slice());
    rates[slots.rate()].copy_from_slice(acceleration.as_slice());
}
