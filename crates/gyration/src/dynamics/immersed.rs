//! A body in the fluid at one instant: the form of the fluid's loads that goes with its kind.

use crate::fluid::{Form, Immersed, RigidDrag, UnresolvedForm, WallLoads};
use crate::inadmissible::{Inadmissible, Quantity};
use crate::instant::{KindAt, MotionAt};
use crate::load::{Loads, Wrench, WrenchSlope};
use crate::tensor::{Mat3, Vec3, cross_matrix};

/// A body that deforms, in the fluid; none if it is not immersed.
///
/// # Errors
/// [`Inadmissible`] where the resistance of its form is not known.
#[inline]
pub(crate) fn immersion<'a>(at: &MotionAt<'a>) -> Result<Option<Immersed<'a>>, Inadmissible> {
    let (Some(fluid), Some(inclusion)) = (&at.model.fluid, &at.body.inclusion) else { return Ok(None) };
    let Some(gyration) = at.gyration() else { return Ok(None) };
    let around = (&**fluid, &fluid.flow(at.time), &at.model.gravity);
    let unresolved = |UnresolvedForm { quantity, value }| at.outside(quantity, value);
    Immersed::of(inclusion, around, (&at.motion.placement, &at.motion.velocity), gyration).map_err(unresolved)
}

/// What the planes of the model change for a sphere of a radius [m] in the fluid.
///
/// # Errors
/// [`Inadmissible`] where the sphere touches one.
pub(crate) fn beside_walls(at: &MotionAt, radius: f64) -> Result<WallLoads, Inadmissible> {
    let MotionAt { model, motion, time, .. } = *at;
    let center = &motion.placement.position;
    let planes = || model.supports.iter().map(|support| support.at(time));
    for (support, plane) in planes().enumerate() {
        let gap = plane.gap(center) - radius;
        // Also where it is no number.
        if gap.is_nan() || gap <= 0.0 {
            return Err(at.outside(Quantity::Gap { support }, gap));
        }
    }
    let viscosity = model.fluid.as_ref().map_or(0.0, |fluid| fluid.viscosity);
    let walls = planes().map(|plane| (plane.gap(center), plane.normal));
    Ok(WallLoads::of(radius, viscosity, (&motion.velocity, &at.inverse()), walls))
}

/// A rigid body in the fluid at one instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RigidImmersion<'a> {
    pub drag: RigidDrag<'a>,
    /// −ρ_f V g in the axes of space [N].
    lift: Vec3,
    /// The same in those of the body, and where it acts.
    seen: Vec3,
    arm: Vec3,
    /// 2ηV sym L∞, in the axes of space [N m].
    pub ambient: Mat3,
}

impl<'a> RigidImmersion<'a> {
    /// None if the body is not immersed.
    pub fn of(at: &MotionAt<'a>) -> Option<Self> {
        let MotionAt { model, body, motion, .. } = at;
        let (fluid, inclusion) = (model.fluid.as_deref()?, body.inclusion.as_ref()?);
        let (Form::Fixed(form), KindAt::Rigid(_, turn)) = (&inclusion.form, at.kind()) else { return None };
        let flow = fluid.flow(at.time);
        let drag = form.drag((fluid, &flow), (&motion.placement, &motion.velocity), &turn.spin);
        let lift = -(fluid.density * inclusion.volume) * model.gravity;
        let seen = motion.placement.gradient.tr_mul(&lift);
        let ambient = (flow.gradient + flow.gradient.transpose()) * (fluid.viscosity * inclusion.volume);
        Some(Self { drag, lift, seen, arm: inclusion.center, ambient })
    }

    /// Force and torque of the fluid.
    pub fn wrench(&self) -> Wrench {
        let mut wrench = self.drag.wrench();
        wrench += Wrench { force: self.lift, torque: self.arm.cross(&self.seen) };
        wrench
    }

    /// The same as a force and an affine moment M = N R; the stress of the undisturbed flow included.
    pub fn loads(&self, rotation: &Mat3) -> Loads {
        let force = self.drag.force() + self.lift;
        let moment = (self.drag.couple() + self.ambient) * rotation + self.lift * self.arm.transpose();
        Loads { force, moment }
    }

    /// The derivative of the torque of the lift by a turn.
    pub fn lift_by_turn(&self) -> WrenchSlope {
        WrenchSlope { force: Mat3::zeros(), torque: cross_matrix(&self.arm) * cross_matrix(&self.seen) }
    }
}
