//! The forces that a body has of its own: formulas of its place and of time, friction, its own gravity.

use super::{BodyForce, LinearResistance, MassFriction, OwnFriction, PointForce, Potential, SelfGravity};

/// Forces of a body's own.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OwnForces {
    /// V(p₀, P, t).
    pub potential: Option<Box<Potential>>,
    /// b(x, t) over its volume.
    pub body_force: Option<Box<BodyForce>>,
    /// F(x, t) at material points.
    pub point_forces: Vec<PointForce>,
    /// Friction, linear in (ṗ₀, L), of a matrix that is the same everywhere.
    pub resistance: Option<Box<LinearResistance>>,
    /// Frictions whose matrices change with place or time.
    pub frictions: Vec<OwnFriction>,
    /// By which a free end of a lattice absorbs waves.
    pub absorption: Option<MassFriction>,
    /// The gravity of the body on itself; none of a rigid one, whose energy it does not change.
    pub self_gravity: Option<SelfGravity>,
}

impl OwnForces {
    /// True if one of them may hold the body at a place.
    pub fn hold(&self) -> bool {
        self.body_force.is_some()
            || !self.point_forces.is_empty()
            || self.potential.as_ref().is_some_and(|potential| potential.acts())
    }
}
