//! Puts a state back to where the equations keep it: what a guide keeps, |q| = 1, det P = 1 and tr L = 0, det G where
//! it is kept, joints.

use crate::hold_joints::hold_joints;
use gyration::affine::AffineBody;
use gyration::body::{Body, BodyKind, Contractile, Slots, matrix};
use gyration::dynamics::Workspace;
use gyration::extended;
use gyration::ledger::Work;
use gyration::model::Model;
use gyration::state::contraction_at;
use gyration::tensor::Mat3;
use gyration_ode::ExtendedMut;
use std::ops::Range;

/// Puts a state back to where the equations keep it, and the energy that it took among the works; returns the size of
/// the largest correction.
pub(crate) fn project(model: &Model, workspace: &mut Workspace, t: f64, y: ExtendedMut, w: &mut [f64]) -> f64 {
    let ExtendedMut { high, low } = y;
    let correction = restore_bodies(model, t, ExtendedMut { high, low }, w);
    if model.joints().is_empty() {
        return correction;
    }
    let restore = |y: ExtendedMut| _ = restore_bodies(model, t, y, &mut []);
    let (size, energy) = hold_joints(model, workspace, t, ExtendedMut { high, low }, restore);
    if let Some(work) = model.works().iter().position(|work| *work == Work::Constraint) {
        w[work] += energy;
    }
    correction.max(size)
}

/// Puts each body back to what it keeps by itself, and the energy that it took among the works, if they are given;
/// returns the size of the largest correction.
fn restore_bodies(model: &Model, t: f64, y: ExtendedMut, w: &mut [f64]) -> f64 {
    let ExtendedMut { high: y, low } = y;
    let work = model.works().iter().position(|work| *work == Work::Constraint);
    let mut correction: f64 = 0.0;
    for (index, body) in model.bodies.iter().enumerate() {
        let slots = model.slots(index);
        if body.guide.is_some() {
            restore_guided(body, slots, y, low);
        }
        let (size, energy) = match &body.kind {
            BodyKind::Rigid(_) => {
                let quaternion = slots.attitude();
                let lacking = low.get_mut(quaternion.clone()).unwrap_or_default();
                (normalize(&mut y[quaternion], lacking), 0.0)
            }
            BodyKind::Affine(affine) => restore_volume(&affine.interior, slots, y),
            BodyKind::Contractile(contractile) => restore_contraction(contractile, slots, t, y),
        };
        correction = correction.max(size);
        if let Some(work) = work.and_then(|work| w.get_mut(work)) {
            *work += energy;
        }
    }
    correction
}

/// Puts a body back to what its motion is kept to. Of its numbers only those of a centre have digits beyond their own.
pub(crate) fn restore_guided(body: &Body, slots: &Slots, y: &mut [f64], low: &mut [f64]) {
    if let Some(lacking) = low.get_mut(slots.position().end..slots.velocities().end) {
        lacking.fill(0.0);
    }
    let lacking = low.get_mut(slots.position()).unwrap_or_default();
    let (_, own) = y.split_at_mut(slots.position().start);
    let (position, own) = own.split_at_mut(slots.position().len());
    let (attitude, own) = own.split_at_mut(slots.attitude().len());
    let (velocity, own) = own.split_at_mut(slots.velocity().len());
    body.restore_guided([position, attitude, velocity, &mut own[..slots.rate().len()]], lacking);
}

/// Puts a quaternion back to length one, by a factor: its direction keeps all its digits, those in `low` too, if there
/// are any. Returns by how much it was off.
pub(crate) fn normalize(quaternion: &mut [f64], low: &mut [f64]) -> f64 {
    let norm = quaternion.iter().map(|c| c * c).sum::<f64>().sqrt();
    if low.is_empty() {
        quaternion.iter_mut().for_each(|c| *c /= norm);
        return (norm - 1.0).abs();
    }
    let factor = extended::Extended::from(1.0 / norm);
    for (high, low) in quaternion.iter_mut().zip(low) {
        let scaled = extended::Extended { high: *high, low: *low } * factor;
        (*high, *low) = (scaled.high, scaled.low);
    }
    (norm - 1.0).abs()
}

/// Puts an incompressible body back to det P = 1, tr L = 0; returns |det P − 1| before, and the energy that it took
/// [J].
fn restore_volume(interior: &AffineBody, slots: &Slots, y: &mut [f64]) -> (f64, f64) {
    if !interior.is_incompressible() {
        return (0.0, 0.0);
    }
    let energy = |p: &Mat3, rate: &Mat3| interior.energy(p) + 0.5 * (rate * interior.euler_tensor).dot(rate);
    let (p, rate) = (matrix(&y[slots.attitude()]), rate_in(slots, y));
    let corrected = interior.project(&p, &rate);
    write(y, slots.attitude(), &corrected.gradient);
    write(y, slots.rate(), &corrected.rate);
    (corrected.size, energy(&corrected.gradient, &corrected.rate) - energy(&p, &rate))
}

/// Puts det G, or P and Ṗ, of a contractile body back to where they have to be; returns the error before, and the
/// energy that it took [J].
fn restore_contraction(contractile: &Contractile, slots: &Slots, time: f64, y: &mut [f64]) -> (f64, f64) {
    let (p, rate) = (matrix(&y[slots.attitude()]), rate_in(slots, y));
    let contraction = contraction_at(&contractile.contraction, time, &y[slots.extra()]);
    let restored = contractile.restore(time, (&p, &rate, &contraction));
    write(y, slots.attitude(), &restored.gradient);
    write(y, slots.rate(), &restored.rate);
    write(y, slots.extra(), &restored.contraction);
    let kept = if slots.rate().is_empty() { rate } else { restored.rate };
    let before = contractile.energy((&p, &rate, &contraction));
    (restored.size, contractile.energy((&restored.gradient, &kept, &restored.contraction)) - before)
}

/// Ṗ of a body that deforms; zero of one without inertia, whose state has none.
fn rate_in(slots: &Slots, y: &[f64]) -> Mat3 {
    if slots.rate().is_empty() { Mat3::zeros() } else { matrix(&y[slots.rate()]) }
}

/// Writes a matrix into its slot, if the state has it.
fn write(y: &mut [f64], slot: Range<usize>, value: &Mat3) {
    if !slot.is_empty() {
        y[slot].copy_from_slice(value.as_slice());
    }
}
