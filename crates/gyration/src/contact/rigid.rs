//! What a plane does to a rigid body: a ball about its centre of mass has a closed form, other surfaces have moments.

use super::law_set::{ContactScratch, LawSet};
use super::wrench::{ContactWrench, RigidLoads, RigidMotion};
use crate::surface::{GapClosed, GapField, Surface};

impl RigidLoads {
    /// Integrates the laws of a contact over a surface.
    ///
    /// # Errors
    /// [`GapClosed`] if a point of the surface lies on or behind the plane.
    pub fn integrate(
        laws: &LawSet,
        surface: &Surface,
        field: &GapField,
        motion: &RigidMotion,
        scratch: &mut ContactScratch,
    ) -> Result<Self, GapClosed> {
        Self::of_ball(laws, surface, field, motion, scratch)
            .unwrap_or_else(|| Self::of_surface(laws, surface, field, motion, scratch))
    }
}

impl ContactWrench {
    /// Integrates the laws of a contact and their derivatives over a surface.
    ///
    /// # Errors
    /// [`GapClosed`] if a point of the surface lies on or behind the plane.
    pub fn integrate(
        laws: &LawSet,
        surface: &Surface,
        field: &GapField,
        motion: &RigidMotion,
        scratch: &mut ContactScratch,
    ) -> Result<Self, GapClosed> {
        Self::of_ball(laws, surface, field, motion, scratch)
            .unwrap_or_else(|| Self::of_surface(laws, surface, field, motion, scratch))
    }
}
