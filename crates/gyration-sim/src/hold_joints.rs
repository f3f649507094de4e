//! Puts a state back to where its joints keep it, with the energy that it took.
//!
//! Places come first; then the bodies themselves, which a displacement leaves to second order; then velocities, within
//! what the bodies keep.

use gyration::balance::kinetic_energy;
use gyration::body::{Body, BodyKind};
use gyration::dynamics::{Held, Workspace};
use gyration::model::Model;
use gyration::state::{BodyMotion, contraction_at};
use gyration_ode::ExtendedMut;

/// Puts a state back to its joints, the bodies themselves by `restore`; returns the largest misfit before, and the
/// energy that it took \[J\].
///
/// A state outside the model is left where it has come to: the next rates tell.
pub(crate) fn hold_joints(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    y: ExtendedMut,
    restore: impl FnOnce(ExtendedMut),
) -> (f64, f64) {
    let ExtendedMut { high, low } = y;
    let before = own_energies(model, time, high);
    let found = workspace.hold_places(model, &mut Held { time, high, low });
    if found.is_ok() {
        restore(ExtendedMut { high, low });
        // What fails there has moved as far as it has.
        let _outside = workspace.hold_velocities(model, &mut Held { time, high, low });
    }
    (found.unwrap_or(0.0), own_energies(model, time, high) - before)
}

/// Kinetic, gravity and elastic energy of the bodies with joints \[J\].
fn own_energies(model: &Model, time: f64, y: &[f64]) -> f64 {
    let Some(graph) = model.joint_graph() else { return 0.0 };
    let own = |index: &usize| {
        let (body, slots) = (&*model.bodies[*index], model.slots(*index));
        let motion = BodyMotion::read(body, slots, y);
        let weight = body.solid.mass.mass * model.gravity;
        let stored = elastic_energy(body, &motion, time, &y[slots.extra()]);
        kinetic_energy(body, &motion) - weight.dot(&motion.placement.position) + stored
    };
    graph.bodies.iter().map(own).sum()
}

fn elastic_energy(body: &Body, motion: &BodyMotion, time: f64, extra: &[f64]) -> f64 {
    match &body.kind {
        BodyKind::Rigid(_) => 0.0,
        BodyKind::Affine(affine) => affine.interior.energy(&motion.placement.gradient),
        BodyKind::Contractile(contractile) => {
            let contraction = contraction_at(&contractile.contraction, time, extra);
            // Its own kinetic energy stands with the motion.
            contractile.energy((&motion.placement.gradient, &gyration::tensor::Mat3::zeros(), &contraction))
        }
    }
}
