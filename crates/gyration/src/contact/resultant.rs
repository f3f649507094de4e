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
use super::{Action, LawKind};
use crate::load::Loads;
use crate::surface::{GapClosed, GapField, Moments, Surface};
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

/// An increment of the gap field: δd(X) = δg₀ + δm·X.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GapDirection {
    /// δg₀ [m].
    pub height: f64,
    /// δm.
    pub direction: Vec3,
}

/// The sums of coefficient × moment over the terms of one action.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    zeroth: f64,
    first: Vec3,
    second: Mat3,
}

impl Sums {
    fn add(&mut self, coefficient: f64, zeroth: f64, first: &Vec3, second: &Mat3) {
        self.zeroth += coefficient * zeroth;
        self.first += coefficient * first;
        self.second += coefficient * second;
    }

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
        let normal = self.normal(n, velocity, gradient_rate);
        let force = -(velocity * self.zeroth + gradient_rate * self.first);
        let moment = -(velocity * self.first.transpose() + gradient_rate * self.second);
        Loads { force: force - normal.force, moment: moment - normal.moment }
    }

    fn act(&self, kind: LawKind, n: &Vec3, velocity: &Vec3, gradient_rate: &Mat3) -> Loads {
        match kind {
            LawKind::Repulsion | LawKind::Adhesion => self.central(n),
            LawKind::Damping => self.normal(n, velocity, gradient_rate),
            LawKind::Friction => self.tangential(n, velocity, gradient_rate),
        }
    }
}

/// The loads of one contact, law by law, and what their derivatives need.
#[derive(Debug, Clone, Copy)]
pub struct ContactLoads {
    motion: RelativeMotion,
    sums: [Sums; LawKind::COUNT],
    /// −ν × moments of exponent ν + 1: the derivative of `sums` along δg₀ and along the axes of δm.
    slopes: [[Sums; 4]; LawKind::COUNT],
    active: [bool; LawKind::COUNT],
}

impl ContactLoads {
    /// Integrates the laws of a contact over a surface; with the slopes too if `derivatives`.
    ///
    /// # Errors
    /// [`GapClosed`] if a point of the surface lies on or behind the plane.
    pub fn integrate(
        contact: &Contact,
        surface: &Surface,
        field: &GapField,
        motion: RelativeMotion,
        derivatives: bool,
        scratch: &mut ContactScratch,
    ) -> Result<Self, GapClosed> {
        let requests = if derivatives { contact.derivative_requests() } else { contact.value_requests() };
        let moments = scratch.take(requests.len());
        surface.moments(field, requests, moments)?;
        let mut loads =
            Self { motion, sums: Default::default(), slopes: Default::default(), active: [false; LawKind::COUNT] };
        for planned in contact.terms() {
            let kind = planned.term.kind as usize;
            loads.active[kind] = true;
            let index = if derivatives { planned.value_with_derivative } else { planned.value };
            let value = &moments[index];
            let viscous = planned.term.action != Action::Central;
            let second = if viscous { value.second } else { Mat3::zeros() };
            loads.sums[kind].add(planned.term.coefficient, value.zeroth, &value.first, &second);
            if derivatives {
                let slope = -planned.term.exponent * planned.term.coefficient;
                add_slopes(&mut loads.slopes[kind], slope, &moments[planned.derivative], viscous);
            }
        }
        Ok(loads)
    }

    /// f and M of one law.
    pub fn of(&self, kind: LawKind) -> Loads {
        let RelativeMotion { normal, velocity, gradient_rate } = &self.motion;
        self.sums[kind as usize].act(kind, normal, velocity, gradient_rate)
    }

    /// f and M of all laws together.
    pub fn total(&self) -> Loads {
        self.kinds().map(|kind| self.of(kind)).sum()
    }

    /// The power f·w₀ + M·W [W] of one law on the relative motion.
    pub fn relative_power(&self, kind: LawKind) -> f64 {
        self.of(kind).power(&self.motion.velocity, &self.motion.gradient_rate)
    }

    /// The laws that act in this contact.
    pub fn kinds(&self) -> impl Iterator<Item = LawKind> + '_ {
        LawKind::ALL.into_iter().filter(|kind| self.active[*kind as usize])
    }

    /// The change of f and M when the gap field changes, velocities kept.
    pub fn along_gap(&self, change: &GapDirection) -> Loads {
        let RelativeMotion { normal, velocity, gradient_rate } = &self.motion;
        let weights = [change.height, change.direction.x, change.direction.y, change.direction.z];
        self.kinds()
            .map(|kind| {
                let mut sums = Sums::default();
                for (slope, weight) in self.slopes[kind as usize].iter().zip(weights) {
                    sums.add(weight, slope.zeroth, &slope.first, &slope.second);
                }
                sums.act(kind, normal, velocity, gradient_rate)
            })
            .sum()
    }

    /// The change of f and M when the relative velocity changes by (δw₀, δW), gaps kept.
    pub fn along_velocity(&self, velocity: &Vec3, gradient_rate: &Mat3) -> Loads {
        self.kinds()
            .filter(|kind| matches!(kind, LawKind::Damping | LawKind::Friction))
            .map(|kind| self.sums[kind as usize].act(kind, &self.motion.normal, velocity, gradient_rate))
            .sum()
    }
}

/// Adds `slope` × the moments of exponent ν + 1 to the four derivatives.
fn add_slopes(slopes: &mut [Sums; 4], slope: f64, moments: &Moments, viscous: bool) {
    let second = if viscous { moments.second } else { Mat3::zeros() };
    slopes[0].add(slope, moments.zeroth, &moments.first, &second);
    for axis in 0..3 {
        let first = moments.second.column(axis).into_owned();
        let mut unit = Vec3::zeros();
        unit[axis] = 1.0;
        let second = if viscous { moments.third.contract(&unit) } else { Mat3::zeros() };
        slopes[axis + 1].add(slope, moments.first[axis], &first, &second);
    }
}
