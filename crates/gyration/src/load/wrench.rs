//! A force and a torque on a rigid body and their derivatives: the force in space, the torque in the body's own axes.

use crate::tensor::{Mat3, Vec3};
use std::ops::AddAssign;

/// A force f in space [N] and a torque τ about the centre of mass in the body's axes [N m].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Wrench {
    /// f.
    pub force: Vec3,
    /// τ.
    pub torque: Vec3,
}

/// The derivatives of a wrench by a vector, one column a component.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WrenchSlope {
    /// ∂F.
    pub force: Mat3,
    /// ∂τ.
    pub torque: Mat3,
}

impl Wrench {
    /// All of it times a factor.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        Self { force: factor * self.force, torque: factor * self.torque }
    }
}

impl AddAssign for Wrench {
    fn add_assign(&mut self, other: Self) {
        self.force += other.force;
        self.torque += other.torque;
    }
}

impl AddAssign for WrenchSlope {
    fn add_assign(&mut self, other: Self) {
        self.force += other.force;
        self.torque += other.torque;
    }
}

impl WrenchSlope {
    /// The derivatives by a vector of which the old one is `map` times: the chain rule.
    pub fn times(&self, map: &Mat3) -> Self {
        Self { force: self.force * map, torque: self.torque * map }
    }
}
