//! Loads on a body: the force f and the affine moment M = ∫ q ⊗ (X − X₀), those of springs at material points, of
//! bonds, of couples, of friction that is linear in the velocity, in proportion to the mass, those of formulas, of the
//! gravity of a body on itself, and what a controller applies.
//!
//! f [N] is spatial; M [N m] has its first index spatial, its second material, so that its power is M·Ṗ. A force F at a
//! material point adds F to f and F ⊗ X to M. Source: `docs/theory-affine.md`.

mod applied;
mod body_force;
mod bond;
mod couple;
mod formula;
mod interactions;
mod mass_friction;
mod own;
mod own_friction;
mod point_force;
mod potential;
mod resistance;
mod self_gravity;
mod slopes;
mod spring;
mod wrench;

pub use crate::party::Party;
pub use applied::Applied;
pub use body_force::{BodyForce, FieldOfForce, POINT_NAMES};
pub use bond::{
    Bond, BondAxes, BondEnd, BondFault, BondLaw, BondLoads, BondPlace, BondSlopes, BondStiffness, DISTANCE_NAMES,
    Dashpot, INVARIANT_NAMES, InvariantPotential, Stiffness6,
};
pub use couple::Couple;
pub use formula::{Formula, PLACE_NAMES};
pub use interactions::{Interaction, InteractionEnd, Interactions};
pub use mass_friction::MassFriction;
pub use own::OwnForces;
pub use own_friction::{FrictionEntry, FrictionFault, FrictionMatrix, OwnFriction};
pub use point_force::PointForce;
pub use potential::Potential;
pub use resistance::{Frame, LinearResistance, Mat12, ResistanceError};
pub(crate) use resistance::{mirrored, semi_definite};
pub use self_gravity::SelfGravity;
pub use slopes::LoadSlopes;
pub(crate) use slopes::{COORDINATES, add_blocks, loads, numbers, unit};
pub use spring::{Anchor, Attachment, Spring, SpringEnd, SpringLaw, SpringLoads};
pub use wrench::{Wrench, WrenchSlope};

use crate::tensor::{Mat3, Vec3, axial};

/// A force and an affine moment.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Loads {
    /// f [N].
    pub force: Vec3,
    /// M = ∫ q ⊗ (X − X₀) [N m].
    pub moment: Mat3,
}

impl Loads {
    /// The loads of a force at a material point X (from the centre of mass).
    pub fn at_point(force: Vec3, point: &Vec3) -> Self {
        Self { force, moment: force * point.transpose() }
    }

    /// All of it times a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        Self { force: factor * self.force, moment: factor * self.moment }
    }

    /// The power f·v + M·Ṗ [W].
    pub fn power(&self, velocity: &Vec3, gradient_rate: &Mat3) -> f64 {
        self.force.dot(velocity) + self.moment.dot(gradient_rate)
    }

    /// Force and torque on a rigid body.
    pub fn wrench(&self, rotation: &Mat3) -> Wrench {
        Wrench { force: self.force, torque: self.body_torque(rotation) }
    }

    /// The torque about the centre of mass in the axes of a rigid body, τ_i = ε_ijk (RᵀM)_kj [N m].
    pub fn body_torque(&self, rotation: &Mat3) -> Vec3 {
        axial(&rotation.tr_mul(&self.moment))
    }
}

impl std::ops::AddAssign for Loads {
    fn add_assign(&mut self, other: Self) {
        self.force += other.force;
        self.moment += other.moment;
    }
}

impl std::iter::Sum for Loads {
    fn sum<I: Iterator<Item = Self>>(iter: I) -> Self {
        let mut total = Self::default();
        for loads in iter {
            total += loads;
        }
        total
    }
}
