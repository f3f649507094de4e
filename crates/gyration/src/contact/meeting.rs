//! A body at a support: its surface, the gaps, the relative motion, and how it takes its surface along.

use super::AreaMeasure;
use super::law_set::LawSet;
use crate::kinematics::BodyMotion;
use crate::support::Support;
use crate::surface::{GapClosed, GapField, MomentPlan, Moments, Surface};
use crate::tensor::{Mat3, Vec3, cofactor, cross_matrix};

/// The support's normal and the motion relative to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativeMotion {
    /// n, unit normal.
    pub normal: Vec3,
    /// w₀ [m/s], relative velocity of the centre of mass.
    pub velocity: Vec3,
    /// W = Ṗ [1/s], less [ω]× P at a support that turns.
    pub gradient_rate: Mat3,
}

/// How a body that deforms takes its surface along.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deformation {
    /// P⁻¹.
    pub inverse: Mat3,
    /// cof P: the area factor is |cof(P) N|.
    pub cofactor: Mat3,
}

/// A body at a support: surface, gaps and motion at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Meeting<'a> {
    /// The surface of the body.
    pub surface: &'a Surface,
    /// The gap to the support.
    pub field: GapField,
    /// The motion relative to it.
    pub motion: RelativeMotion,
    /// None for a rigid body, on which all measures of area are the same.
    pub deformation: Option<Deformation>,
}

impl RelativeMotion {
    /// The motion of a body relative to a support.
    #[inline]
    pub fn to(support: &Support, motion: &BodyMotion, time: f64) -> Self {
        let BodyMotion { placement, velocity } = motion;
        let carrying = support.motion_at(time);
        let turned = carrying.spin.map(|spin| cross_matrix(&spin) * placement.gradient);
        Self {
            normal: support.at(time).normal,
            velocity: velocity.velocity - carrying.at(&placement.position),
            gradient_rate: turned.map_or(velocity.gradient_rate, |turned| velocity.gradient_rate - turned),
        }
    }
}

impl Deformation {
    /// Of the gradient P; none where it cannot be inverted.
    pub fn of(p: &Mat3) -> Option<Self> {
        let cofactor = cofactor(p);
        let volume_ratio = p.column(0).dot(&cofactor.column(0));
        (volume_ratio != 0.0).then(|| Self { inverse: cofactor.transpose() * (1.0 / volume_ratio), cofactor })
    }
}

impl Meeting<'_> {
    /// The deformation, where areas are those of the deformed body.
    pub(super) fn area_change(&self, laws: &LawSet) -> Option<&Deformation> {
        self.deformation.as_ref().filter(|_| laws.measure != AreaMeasure::ReferenceArea)
    }

    /// The moments of a plan in the measure of the contact.
    pub(super) fn moments(&self, laws: &LawSet, plan: &MomentPlan, out: &mut [Moments]) -> Result<(), GapClosed> {
        match self.area_change(laws) {
            Some(deformation) => self.surface.deformed_moments(&self.field, &deformation.cofactor, plan, out),
            None => self.surface.planned_moments(&self.field, plan, out),
        }
    }
}
