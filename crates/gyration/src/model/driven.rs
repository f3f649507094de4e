//! What in a model is prescribed in time.

use super::Model;
use crate::body::Body;
use crate::load::{Couple, FieldOfForce, OwnFriction, Spring};
use crate::signal::Signal;
use crate::support::SupportMotion;

impl Model {
    /// Whether a force, a drive or a flow is another one at another time, or something to which bodies are attached
    /// moves.
    ///
    /// Supports that go on or turn at a constant rate are left to whoever asks: a turntable is the same at all times.
    pub fn is_driven(&self) -> bool {
        let supports = self.supports.iter().map(|support| &support.motion);
        let solid = self.solid_supports.iter().map(|support| &support.motion);
        let springs = self.springs().iter().filter_map(Spring::anchor);
        let mut anchors = springs.chain(self.joints().iter().map(|joint| &joint.anchor));
        supports.chain(solid).any(SupportMotion::oscillates)
            || anchors.any(|anchor| !anchor.motion.is_fixed())
            || self.signals().any(|signal| !signal.is_steady())
            || self.joints().iter().any(|joint| joint.motor.feels_time())
            || self.bonds().iter().any(|bond| bond.law.as_ref().is_some_and(|law| !law.is_energy()))
            || self.bodies.iter().any(|body| body.feels_time())
    }

    /// What drives bodies and joints, and the flow around them.
    pub fn signals(&self) -> impl Iterator<Item = &Signal> {
        let drives = self.bodies.iter().filter_map(|body| Some(body.contraction()?.signal()));
        let drives = drives.chain(self.joints().iter().filter_map(|joint| joint.motor.signal()));
        drives.chain(self.fluid.iter().flat_map(|fluid| fluid.signals()))
    }
}

impl Body {
    /// Whether a couple or a force of its own is another one at another time.
    fn feels_time(&self) -> bool {
        let couple = self.affine().and_then(|affine| affine.couple.as_ref());
        let forces = self.own.body_force.iter().map(|force| force.field());
        let mut forces = forces.chain(self.own.point_forces.iter().map(|force| &force.field));
        couple.is_some_and(|couple| matches!(couple, Couple::Table(_)))
            || self.own.potential.as_ref().is_some_and(|potential| !potential.is_energy())
            || forces.any(FieldOfForce::uses_time)
            || self.own.frictions.iter().any(OwnFriction::uses_time)
    }
}
