//! What in a model is prescribed in time.

use super::Model;
use crate::body::Body;
use crate::load::{Couple, FieldOfForce, OwnFriction, PointForce, Potential, Spring};
use crate::signal::Signal;
use crate::support::SupportMotion;
use std::sync::Arc;

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
        let mut flows = self.fluid.iter().flat_map(|fluid| fluid.signals());
        supports.chain(solid).any(SupportMotion::oscillates)
            || anchors.any(|anchor| !anchor.motion.is_fixed())
            || flows.any(|signal| !signal.is_steady())
            || self.joints().iter().any(|joint| joint.motor.uses_time())
            || self.bonds().iter().any(|bond| bond.law.as_ref().is_some_and(|law| !law.is_energy()))
            || self.bodies.iter().any(|body: &Arc<Body>| body.is_driven())
    }
}

impl Body {
    /// Whether a force of its own or its contraction is prescribed in time.
    fn is_driven(&self) -> bool {
        let contraction = self.contraction().map(|contraction| contraction.signal());
        let couple = self.affine().and_then(|affine| affine.couple.as_ref());
        let forces = self.own.body_force.iter().map(|force| force.field());
        let mut forces = forces.chain(self.own.point_forces.iter().map(|force: &PointForce| &force.field));
        contraction.is_some_and(|signal: &Signal| !signal.is_steady())
            || couple.is_some_and(|couple| matches!(couple, Couple::Table(_)))
            || self.own.potential.as_deref().is_some_and(|potential: &Potential| !potential.is_energy())
            || forces.any(FieldOfForce::uses_time)
            || self.own.frictions.iter().any(OwnFriction::uses_time)
    }
}
