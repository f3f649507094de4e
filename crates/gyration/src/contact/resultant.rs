//! Force and moment of the contact laws over a whole surface, from its moments.
//!
//! With the relative velocity w(X) = w₀ + W X and the moments A₀, A₁, A₂ of d^−ν (times the law's coefficient):
//!
//!   central     f = A₀ n                      M = n ⊗ A₁
//!   normal      f = −n (c₀A₀ + c·A₁)          M = −n ⊗ (c₀A₁ + A₂c),      c₀ = n·w₀, c = Wᵀn
//!   tangential  f = −(w₀A₀ + W A₁) − normal   M = −(w₀⊗A₁ + W A₂) − normal
//!
//! f [N], M = ∫ q ⊗ X dA [N m]. On a body that deforms the moments are those per deformed or per reference area, as the
//! measure of the contact says; `tension` adds what makes tractions per deformed area derive from a potential. These are
//! linear in the moments and in (w₀, W), from which `slopes` takes the derivatives. Source: `physics.md` §2–3.

use super::plan::{Contact, ContactScratch};
use super::sums::Sums;
use super::tension::Tension;
use super::{Action, AreaMeasure, LawKind};
use crate::load::Loads;
use crate::surface::{GapClosed, GapField, MomentPlan, Moments, Surface};
use crate::tensor::{Mat3, Vec3, cofactor};

/// The support's normal and the motion relative to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativeMotion {
    /// n, unit normal.
    pub normal: Vec3,
    /// w₀ [m/s], relative velocity of the centre of mass.
    pub velocity: Vec3,
    /// W = Ṗ [1/s].
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
    pub(super) fn area_change(&self, contact: &Contact) -> Option<&Deformation> {
        self.deformation.as_ref().filter(|_| contact.measure != AreaMeasure::ReferenceArea)
    }

    /// The moments of a plan in the measure of the contact.
    pub(super) fn moments(&self, contact: &Contact, plan: &MomentPlan, out: &mut [Moments]) -> Result<(), GapClosed> {
        match self.area_change(contact) {
            Some(deformation) => self.surface.deformed_moments(&self.field, &deformation.cofactor, plan, out),
            None => self.surface.planned_moments(&self.field, plan, out),
        }
    }
}

impl Sums {
    fn central(&self, normal: &Vec3) -> Loads {
        Loads { force: self.zeroth * normal, moment: normal * self.first.transpose() }
    }

    pub(super) fn normal(&self, n: &Vec3, velocity: &Vec3, gradient_rate: &Mat3) -> Loads {
        let speed = n.dot(velocity);
        let slope = gradient_rate.tr_mul(n);
        let push = -(speed * self.zeroth + slope.dot(&self.first));
        let lever = -(speed * self.first + self.second * slope);
        Loads { force: push * n, moment: n * lever.transpose() }
    }

    pub(super) fn tangential(&self, n: &Vec3, velocity: &Vec3, gradient_rate: &Mat3) -> Loads {
        let force = -(velocity * self.zeroth + gradient_rate * self.first);
        let moment = -(velocity * self.first.transpose() + gradient_rate * self.second);
        // Less what of it is along n: the projection (I − n⊗n) from the left.
        Loads { force: force - n * n.dot(&force), moment: moment - n * moment.tr_mul(n).transpose() }
    }

    pub(super) fn act(&self, action: Action, n: &Vec3, velocity: &Vec3, gradient_rate: &Mat3) -> Loads {
        match action {
            Action::Central => self.central(n),
            Action::Normal => self.normal(n, velocity, gradient_rate),
            Action::Tangential => self.tangential(n, velocity, gradient_rate),
        }
    }
}

/// The loads of one contact, law by law.
#[derive(Debug, Clone, Copy)]
pub struct ContactLoads {
    motion: RelativeMotion,
    loads: [Loads; LawKind::COUNT],
}

impl ContactLoads {
    /// Integrates the laws of a contact over the surface of a body.
    ///
    /// # Errors
    /// [`GapClosed`] if a point of the surface lies on or behind the plane.
    pub fn integrate(contact: &Contact, meeting: &Meeting, scratch: &mut ContactScratch) -> Result<Self, GapClosed> {
        let plan = contact.values();
        let moments = scratch.take(plan.requests().len());
        meeting.moments(contact, plan, moments)?;
        let motion = meeting.motion;
        let mut loads = [Loads::default(); LawKind::COUNT];
        for planned in contact.terms() {
            let term = &planned.term;
            let mut sums = Sums::default();
            sums.add(term.coefficient, term.action, &moments[planned.value]);
            loads[term.kind as usize] += sums.act(term.action, &motion.normal, &motion.velocity, &motion.gradient_rate);
        }
        if let Some(tension) = Tension::integrate(contact, meeting, scratch)? {
            tension.add_to(&mut loads);
        }
        Ok(Self { motion, loads })
    }

    /// f and M of all laws together.
    pub fn total(&self) -> Loads {
        self.loads.iter().copied().sum()
    }

    /// The power f·w₀ + M·W [W] of one law on the relative motion.
    pub fn relative_power(&self, kind: LawKind) -> f64 {
        self.loads[kind as usize].power(&self.motion.velocity, &self.motion.gradient_rate)
    }
}
