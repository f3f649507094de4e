//! A force and a torque on a rigid body, in the body's own axes, and their derivatives.

use crate::tensor::{Mat3, Vec3};
use std::ops::AddAssign;

/// A force F [N] and a torque τ about the centre of mass [N m] in the body's axes.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Wrench {
    /// F = Rᵀf.
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
