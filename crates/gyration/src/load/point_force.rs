//! A force F(x, t) [N] on a material point of a body, where that is in space.
//!
//!   f = F,   M = F ⊗ X,   x = p₀ + P X,   ∂Q/∂q = (∂F/∂x) X̃ ⊗ X̃
//!
//! Its work is always booked as one: F need have no potential.

use super::body_force::FieldOfForce;
use super::{LoadSlopes, Loads, add_blocks};
use crate::kinematics::Placement;
use crate::tensor::Vec3;
use gyration_expression::{Scratch, Undefined};

/// A force on a material point.
#[derive(Debug, Clone, PartialEq)]
pub struct PointForce {
    /// X, from the centre of mass in the reference shape [m].
    pub point: Vec3,
    /// F.
    pub field: FieldOfForce,
}

impl PointForce {
    /// f and M.
    ///
    /// # Errors
    /// [`Undefined`] where F has no finite value.
    pub fn loads(&self, place: &Placement, time: f64, scratch: &mut Scratch) -> Result<Loads, Undefined> {
        let (force, _) = self.field.at(&place.place(&self.point), time, false, scratch)?;
        Ok(Loads::at_point(force, &self.point))
    }
}

impl LoadSlopes {
    /// Adds a force on a material point.
    ///
    /// # Errors
    /// [`Undefined`] where F has no first derivative.
    pub fn add_point_force(
        &mut self,
        load: &PointForce,
        place: &Placement,
        time: f64,
        scratch: &mut Scratch,
    ) -> Result<(), Undefined> {
        let (force, by_place) = load.field.at(&place.place(&load.point), time, true, scratch)?;
        let point = |a: usize| if a == 0 { 1.0 } else { load.point[a - 1] };
        add_blocks(&mut self.by_place, &by_place, |a, b| point(a) * point(b));
        self.loads += Loads::at_point(force, &load.point);
        Ok(())
    }
}
