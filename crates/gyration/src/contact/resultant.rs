//! Force, moment and their derivatives of the contact laws over a whole surface, from its moments.
//!
//! With the relative velocity w(X) = w₀ + W X and the moments A₀, A₁, A₂ of d^−ν (times the law's coefficient):
//!
//!   central     f = A₀ n                      M = n ⊗ A₁
//!   normal      f = −n (c₀A₀ + c·A₁)          M = −n ⊗ (c₀A₁ + A₂c),      c₀ = n·w₀, c = Wᵀn
//!   tangential  f = −(w₀A₀ + W A₁) − normal   M = −(w₀⊗A₁ + W A₂) − normal
//!
//! f [N], M = ∫ q ⊗ X dA [N m]. These are linear in the moments and in (w₀, W), so that a derivative is the same
//! formula with moments of exponent ν + 1, or with the increment of the velocity. Source: `physics.md` §2–3.

use super::plan::{Contact, ContactScratch};
use super::sums::{SumSlopes, Sums};
use super::{Action, LawKind};
use crate::load::Loads;
use crate::surface::{GapClosed, GapField, Surface};
use crate::tensor::{Mat3, Vec3};

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

impl Sums {
    fn central(&self, normal: &Vec3) -> Loads {
        Loads { force: self.zeroth * normal, moment: normal * self.first.transpose() }
    }

    fn normal(&self, n: &Vec3, velocity: &Vec3, gradient_rate: &Mat3) -> Loads {
        let speed = n.dot(velocity);
        let slope = gradient_rate.tr_mul(n);
        let push = -(speed * self.zeroth + slope.dot(&self.first));
        let lever = -(speed * self.first + self.second * slope);
        Loads { force: push * n, moment: n * lever.transpose() }
    }

    fn tangential(&self, n: &Vec3, velocity: &Vec3, gradient_rate: &Mat3) -> Loads {
        let force = -(velocity * self.zeroth + gradient_rate * self.first);
        let moment = -(velocity * self.first.transpose() + gradient_rate * self.second);
        // Less what of it is along n: the projection (I − n⊗n) from the left.
        Loads { force: force - n * n.dot(&force), moment: moment - n * moment.tr_mul(n).transpose() }
    }

    fn act(&self, action: Action, n: &Vec3, velocity: &Vec3, gradient_rate: &Mat3) -> Loads {
        match action {
            Action::Central => self.central(n),
            Action::Normal => self.normal(n, velocity, gradient_rate),
            Action::Tangential => self.tangential(n, velocity, gradient_rate),
        }
    }
}

const ACTIONS: [Action; 3] = [Action::Central, Action::Normal, Action::Tangential];

/// The loads of one contact, law by law.
#[derive(Debug, Clone, Copy)]
pub struct ContactLoads {
    motion: RelativeMotion,
    loads: [Loads; LawKind::COUNT],
}

impl ContactLoads {
    /// Integrates the laws of a contact over a surface.
    ///
    /// # Errors
    /// [`GapClosed`] if a point of the surface lies on or behind the plane.
    pub fn integrate(
        contact: &Contact,
        surface: &Surface,
        field: &GapField,
        motion: RelativeMotion,
        scratch: &mut ContactScratch,
    ) -> Result<Self, GapClosed> {
        let plan = contact.values();
        let moments = scratch.take(plan.requests().len());
        surface.planned_moments(field, plan, moments)?;
        let mut loads = [Loads::default(); LawKind::COUNT];
        for planned in contact.terms() {
            let term = &planned.term;
            let mut sums = Sums::default();
            sums.add(term.coefficient, term.action, &moments[planned.value]);
            loads[term.kind as usize] += sums.act(term.action, &motion.normal, &motion.velocity, &motion.gradient_rate);
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

/// The loads of one contact and their derivatives.
#[derive(Debug, Clone, Copy)]
pub struct ContactSlopes {
    /// f and M of all laws together.
    pub total: Loads,
    normal: Vec3,
    /// ∂(f, M)/∂g₀ and ∂(f, M)/∂m along the three axes, velocities kept.
    by_gap: [Loads; 4],
    /// Σ β d₀^ν × moments of damping and of friction: the derivative by (w₀, W) is their action on the increment.
    viscous: [Sums; 2],
    is_viscous: [bool; 2],
}

impl ContactSlopes {
    /// Integrates the laws of a contact and their derivatives over a surface.
    ///
    /// # Errors
    /// [`GapClosed`] if a point of the surface lies on or behind the plane.
    pub fn integrate(
        contact: &Contact,
        surface: &Surface,
        field: &GapField,
        motion: RelativeMotion,
        scratch: &mut ContactScratch,
    ) -> Result<Self, GapClosed> {
        let plan = contact.derivatives();
        let moments = scratch.take(plan.requests().len());
        surface.planned_moments(field, plan, moments)?;
        let SumSlopes { values, by_gap: slopes, acts } = SumSlopes::new(contact, moments);
        let RelativeMotion { normal, velocity, gradient_rate } = &motion;
        let mut total = Loads::default();
        let mut by_gap = [Loads::default(); 4];
        for action in ACTIONS.into_iter().filter(|action| acts[*action as usize]) {
            total += values[action as usize].act(action, normal, velocity, gradient_rate);
            for (sum, slope) in by_gap.iter_mut().zip(&slopes[action as usize]) {
                *sum += slope.act(action, normal, velocity, gradient_rate);
            }
        }
        let [_, damping, friction] = values;
        let [_, damps, rubs] = acts;
        Ok(Self { total, normal: *normal, by_gap, viscous: [damping, friction], is_viscous: [damps, rubs] })
    }

    /// The change of f and M when the gap field changes by δg₀ + δm·X, velocities kept.
    pub fn along_gap(&self, height: f64, direction: &Vec3) -> Loads {
        let mut change = Loads::default();
        for (slope, weight) in self.by_gap.iter().zip([height, direction.x, direction.y, direction.z]) {
            change.force += weight * slope.force;
            change.moment += weight * slope.moment;
        }
        change
    }

    /// The change of f and M when the relative velocity changes by δw₀ + δW X, gaps kept.
    pub fn along_velocity(&self, velocity: &Vec3, gradient_rate: &Mat3) -> Loads {
        let mut change = Loads::default();
        if self.is_viscous[0] {
            change += self.viscous[0].normal(&self.normal, velocity, gradient_rate);
        }
        if self.is_viscous[1] {
            change += self.viscous[1].tangential(&self.normal, velocity, gradient_rate);
        }
        change
    }
}
