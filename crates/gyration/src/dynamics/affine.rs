//! An affine body: the balance solved for its rates.
//!
//!   m p̈₀ = m g + f,   P̈ J = M − V S;   pinned at r: P̈ J_p = M − (f + m g) ⊗ r − V S
//!
//! That of a sphere whose motion the fluid remembers is in `affine_history`.

use super::affine_history::AffineHistory;
use super::guided::GuidedStrain;
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
    let excess = excess(at, &affine.interior, gyration, &mut balance.acceleration, balance.pressure.is_some());
    if let Some(pressure) = &mut balance.pressure {
        *pressure -= excess;
        balance.stress += excess * gyration.inverse.transpose();
    }
    balance
}

/// Takes P̈ to that with the guide of the body, if it has one; returns by how much the pressure that keeps det P, if
/// there is one, is less than without guide and with inertia \[Pa\]. Without inertia P̈ = λ Y is no acceleration but
/// what that pressure takes back, λ/V.
pub(super) fn excess(
    at: &MotionAt,
    interior: &AffineBody,
    gyration: &Gyration,
    acceleration: &mut Mat3,
    keeps_volume: bool,
) -> f64 {
    let mut excess = 0.0;
    if let Some(strain) = GuidedStrain::of(interior, gyration, keeps_volume) {
        let (held, push) = strain.hold(acceleration);
        *acceleration = held;
        excess = -push / interior.volume;
    }
    if at.body.has_inertia() || !keeps_volume {
        return excess;
    }
    let across = gyration.inverse.transpose();
    excess + acceleration.dot(&across) / (interior.way(&gyration.inverse).dot(&across) * interior.volume)
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
    let remembered = AffineHistory::of(at, affine, gyration);
    let balance = match &remembered {
        Some(sphere) => sphere.balance(&acting.total),
        None => balance(at, affine, gyration, &acting.total),
    };
    acting.powers[Work::Viscosity] -= balance.dissipation;
    if let Some(pressure) = balance.pressure {
        let growth = gyration.velocity_gradient.trace();
        acting.powers[Work::Constraint] += pressure * affine.interior.volume * growth;
    }
    match &remembered {
        Some(sphere) => sphere.write(acting, &balance.acceleration, slots, rates),
        None => write(at, acting, &balance.acceleration, slots, rates),
    }
}

/// Writes the rates of p₀, P, ṗ₀ and Ṗ, those of the velocities from the force and P̈.
#[inline]
pub(super) fn write(at: &MotionAt, acting: &Acting, acceleration: &Mat3, slots: &Slots, rates: &mut [f64]) {
    let velocity = &at.motion.velocity;
    if at.body.pin.is_none() {
        let mut linear = at.model.gravity + acting.total.force / at.body.solid.mass.mass;
        if let Some(center) = at.body.guide.as_ref().and_then(|guide| guide.center) {
            linear = center * linear;
        }
        rates[slots.position()].copy_from_slice(velocity.velocity.as_slice());
        rates[slots.velocity()].copy_from_slice(linear.as_slice());
    }
    rates[slots.attitude()].copy_from_slice(velocity.gradient_rate.as_slice());
    rates[slots.rate()].copy_from_slice(acceleration.as_slice());
}
