//! Force and moment of the contact laws over a whole surface, from its moments.
//!
//! With the relative velocity w(X) = w₀ + W X and the moments A₀, A₁, A₂ of d^−ν (times the law's coefficient):
//!
//!   central     f = A₀ n                      M = n ⊗ A₁
//!   normal      f = −n (c₀A₀ + c·A₁)          M = −n ⊗ (c₀A₁ + A₂c),      c₀ = n·w₀, c = Wᵀn
//!   tangential  f = −(w₀A₀ + W A₁) − normal   M = −(w₀⊗A₁ + W A₂) − normal
//!
//! Tangential loads follow likewise from what of (w₀, W) is not along n. f [N], M = ∫ q ⊗ X dA [N m]. On a body that
//! deforms the moments are those per deformed or per reference area, as the measure of the contact says; `tension` adds
//! what makes tractions per deformed area derive from a potential. These are linear in the moments and in (w₀, W), from
//! which `slopes` takes the derivatives. Source: `docs/theory-rigid.md`.

use super::law_set::{ContactScratch, LawSet};
use super::meeting::{Meeting, RelativeMotion};
use super::sums::Sums;
use super::tension::Tension;
use super::{Action, LawKind, Shift};
use crate::load::Loads;
use crate::surface::{GapClosed, Moments};
use crate::tensor::{Mat3, Vec3};

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

/// The loads of one contact, and what each law does.
#[derive(Debug, Clone, Copy)]
pub struct ContactLoads {
    total: Loads,
    powers: [f64; LawKind::COUNT],
}

/// What the whole of a surface tells each part of it: laws with a bound, and one-sided ones, are not sums over parts.
#[derive(Debug, Clone, Copy)]
pub struct Overall {
    /// σ, by which a bound multiplies friction.
    friction: Option<f64>,
    /// What a one-sided damping adds to the speed along n [m/s].
    shift: Option<f64>,
}

impl ContactLoads {
    /// Integrates the laws of a contact over the surface of a body.
    ///
    /// # Errors
    /// [`GapClosed`] if a point of the surface lies on or behind the plane.
    pub fn integrate(laws: &LawSet, meeting: &Meeting, scratch: &mut ContactScratch) -> Result<Self, GapClosed> {
        let plan = laws.values();
        let moments = scratch.take(plan.requests().len());
        meeting.moments(laws, plan, moments)?;
        let split = SplitMotion::new(&meeting.motion);
        let mut sums = Sums::by_action(laws, moments);
        Sums::bind(&mut sums, laws, moments, |friction| split.lost(friction));
        let shift = split.shift(laws, &sums[Action::Normal as usize]);
        let mut this = split.loads(laws, &sums, shift.map(|shift| shift.by));
        for planned in laws.terms().iter().filter(|planned| planned.term.action == Action::Central) {
            let power = split.central_power(&moments[planned.value]);
            this.powers[planned.term.kind as usize] += planned.term.coefficient * power;
        }
        if let Some(tension) = Tension::integrate(laws, meeting, scratch)? {
            for kind in LawKind::ALL {
                let moment = tension.moment(kind);
                this.total.moment += moment;
                this.powers[kind as usize] += moment.dot(&meeting.motion.gradient_rate);
            }
        }
        Ok(this)
    }

    /// The force on a part of a surface [N], given what the whole of it tells.
    ///
    /// # Errors
    /// [`GapClosed`] if a point of the part lies on or behind the plane.
    pub fn force_on_part(
        laws: &LawSet,
        part: &Meeting,
        whole: Overall,
        scratch: &mut ContactScratch,
    ) -> Result<Vec3, GapClosed> {
        let plan = laws.values();
        let moments = scratch.take(plan.requests().len());
        part.moments(laws, plan, moments)?;
        let mut sums = Sums::by_action(laws, moments);
        if let Some(factor) = whole.friction {
            sums[Action::Tangential as usize].scale(factor);
        }
        Ok(SplitMotion::new(&part.motion).loads(laws, &sums, whole.shift).total.force)
    }

    /// f and M of all laws together.
    pub fn total(&self) -> Loads {
        self.total
    }

    /// The power f·w₀ + M·W [W] of one law on the relative motion.
    pub fn relative_power(&self, kind: LawKind) -> f64 {
        self.powers[kind as usize]
    }
}

impl Overall {
    /// Over the surface of a body.
    ///
    /// # Errors
    /// [`GapClosed`] if a point of the surface lies on or behind the plane.
    pub fn integrate(laws: &LawSet, meeting: &Meeting, scratch: &mut ContactScratch) -> Result<Self, GapClosed> {
        let plan = laws.values();
        let moments = scratch.take(plan.requests().len());
        meeting.moments(laws, plan, moments)?;
        let (split, sums) = (SplitMotion::new(&meeting.motion), Sums::by_action(laws, moments));
        let bound = Sums::bound(&sums, laws, moments, |friction| split.lost(friction));
        let shift = split.shift(laws, &sums[Action::Normal as usize]);
        Ok(Self { friction: bound.map(|bound| bound.factor()), shift: shift.map(|shift| shift.by) })
    }
}

/// The relative motion split into what is along the normal, n·w = c₀ + c·X, and the rest, w − (n·w) n = v + V X.
pub(super) struct SplitMotion<'a> {
    motion: &'a RelativeMotion,
    /// c₀ [m/s].
    speed: f64,
    /// c [1/s].
    slope: Vec3,
}

impl<'a> SplitMotion<'a> {
    #[inline]
    pub fn new(motion: &'a RelativeMotion) -> Self {
        let RelativeMotion { normal, velocity, gradient_rate } = motion;
        Self { motion, speed: normal.dot(velocity), slope: gradient_rate.tr_mul(normal) }
    }

    /// The power of a central law with these moments, c₀A₀ + c·A₁.
    #[inline]
    fn central_power(&self, moments: &Moments) -> f64 {
        self.speed * moments.zeroth + self.slope.dot(&moments.first)
    }

    /// What a one-sided damping adds to the speed along n; none of one that is not, or is nothing.
    pub fn shift(&self, laws: &LawSet, damping: &Sums) -> Option<Shift> {
        let one_sided = laws.one_sided().filter(|_| damping.zeroth > 0.0)?;
        Some(one_sided.shift(self.speed + self.slope.dot(&damping.first) / damping.zeroth))
    }

    /// The change of the mean speed w by which that is, with the sums, at velocities that are kept.
    pub fn mean_along(&self, damping: &Sums, change: &Sums) -> f64 {
        let center = damping.first / damping.zeroth;
        self.slope.dot(&(change.first - change.zeroth * center)) / damping.zeroth
    }

    /// What friction takes [W], ∫κ |v + V X|² dA.
    pub fn lost(&self, friction: &Sums) -> f64 {
        let Self { motion: RelativeMotion { normal, velocity, gradient_rate }, speed, slope } = self;
        let (across, rate) = (velocity - *speed * normal, gradient_rate - normal * slope.transpose());
        let swept = across * friction.first.transpose() + rate * friction.second;
        across.dot(&(across * friction.zeroth + rate * friction.first)) + swept.dot(&rate)
    }

    /// The loads of these sums, and the powers of the viscous laws; a shift is what damping adds to the speed along n.
    #[inline]
    fn loads(
        &self,
        laws: &LawSet,
        [central, damping, friction]: &[Sums; Action::COUNT],
        shift: Option<f64>,
    ) -> ContactLoads {
        let Self { motion: RelativeMotion { normal, velocity, gradient_rate }, speed, slope } = self;
        let mut powers = [0.0; LawKind::COUNT];
        let (mut along, mut lever) = (central.zeroth, central.first);
        if laws.acts(Action::Normal) {
            let damped = shift.map_or(*speed, |shift| speed + shift);
            let push = -(damped * damping.zeroth + slope.dot(&damping.first));
            let pull = -(damped * damping.first + damping.second * slope);
            along += push;
            lever += pull;
            powers[LawKind::Damping as usize] = speed * push + slope.dot(&pull);
        }
        let mut total = Loads { force: along * normal, moment: normal * lever.transpose() };
        if laws.acts(Action::Tangential) {
            let (across, rate) = (velocity - *speed * normal, gradient_rate - normal * slope.transpose());
            let drag = -(across * friction.zeroth + rate * friction.first);
            let moment = -(across * friction.first.transpose() + rate * friction.second);
            powers[LawKind::Friction as usize] = drag.dot(&across) + moment.dot(&rate);
            total += Loads { force: drag, moment };
        }
        ContactLoads { total, powers }
    }
}
