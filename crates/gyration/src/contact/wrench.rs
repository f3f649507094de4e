//! A contact of a rigid body: its force in space, its torque in the body's own axes, and their derivatives.
//!
//! With the normal n, m = Rᵀn, the relative velocity of the centre split into approach s = n·w₀ and sliding v = w₀ − s
//! n, the sums C, N, T of the central, normal and tangential laws and c = m×Ω, so that m·u(X) = s + c·X,
//!
//!   f = (C₀ − push) n − (1 − n⊗n)(T₀v + R(Ω×T₁))                        push = N₀ s + N₁·c
//!   τ = (C₁ − lever)×m − (T₁×Rᵀv + (tr T₂ − T₂)Ω − T₂c×m)               lever = N₁ s + N₂c
//!
//! These are f and M of `resultant` for P = R, τ_i = ε_ijk (RᵀM)_kj. They depend on few numbers, g₀, m, w₀ and Ω,
//! however many the state has; derivatives are taken here and carried over to the state once (`jacobian`). Moments are
//! linear in the sums, so that derivatives through the gap are the same formula with other sums.
//!
//! Coulomb's bound scales T, and brings the change of its factor (`bound`): F_T ⊗ ∂σ beside, F_T the viscous friction.
//! One-sided damping adds s(w) − w to the approach that N resists, w = s + N₁·c/N₀, and brings the change of that
//! (`one_sided`): F_N ⊗ ∂(s(w) − w) beside, F_N = −(N₀ n, N₁×m).
//!
//! Normal and tangential parts are not mixed: next to a support one may exceed the other by more than the digits of a
//! number. The force is therefore formed in space, where the normal of a support is often an axis.

use super::law_set::{ContactScratch, LawSet};
use super::meeting::RelativeMotion;
use super::sums::{SumSlopes, Sums};
use super::{Action, Bound, Shift, Sliding};
use crate::load::{Wrench, WrenchSlope};
use crate::surface::{GapClosed, GapField, Surface};
use crate::tensor::{Mat3, Vec3, cross_matrix, turning};

/// The motion of a rigid body relative to a support.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidMotion {
    /// n, unit normal of the support.
    pub normal: Vec3,
    /// m = Rᵀn, the same in the body's axes.
    pub direction: Vec3,
    /// s = n·w₀ [m/s], relative velocity of the centre of mass along the normal.
    pub approach: f64,
    /// v = w₀ − s n [m/s], the rest of it.
    pub sliding: Vec3,
    /// R.
    pub rotation: Mat3,
    /// Ω [rad/s], in the body's axes.
    pub spin: Vec3,
}

/// The wrench of one contact and the powers of its viscous laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidLoads {
    /// f and τ of all laws together.
    pub wrench: Wrench,
    /// The power of damping on the relative motion [W], −∫κ (m·u)² dA.
    pub damping_power: f64,
    /// The power of friction on the relative motion [W], −∫κ (|u|² − (m·u)²) dA.
    pub friction_power: f64,
}

/// The wrench of one contact and its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactWrench {
    /// f and τ of all laws together.
    pub wrench: Wrench,
    /// By the height g₀ of the centre of mass.
    pub by_height: Wrench,
    /// By a turn δθ, δR = R[δθ]×, with w₀ and Ω kept.
    pub by_turn: WrenchSlope,
    /// By w₀.
    pub by_velocity: WrenchSlope,
    /// By Ω.
    pub by_spin: WrenchSlope,
}

impl RigidMotion {
    /// The motion of a body of this rotation and spin.
    pub fn new(relative: &RelativeMotion, rotation: &Mat3, spin: Vec3) -> Self {
        let RelativeMotion { normal, velocity, .. } = relative;
        let approach = normal.dot(velocity);
        let sliding = velocity - approach * normal;
        Self { normal: *normal, direction: rotation.tr_mul(normal), approach, sliding, rotation: *rotation, spin }
    }

    /// The same with another approach.
    pub(super) fn approaching(&self, approach: f64) -> Self {
        Self { approach, ..*self }
    }

    /// c.
    fn slope(&self) -> Vec3 {
        self.direction.cross(&self.spin)
    }

    /// ∫κ (m·u)² dA = s² A₀ + 2s c·A₁ + c·A₂c.
    fn squared_along_normal(&self, sums: &Sums) -> f64 {
        let (s, c) = (self.approach, self.slope());
        s * (s * sums.zeroth + 2.0 * c.dot(&sums.first)) + c.dot(&(sums.second * c))
    }

    /// ∫κ |u − (m·u) m|² dA = v² A₀ + 2v·R(Ω×A₁) + Ω·(tr A₂ − A₂)Ω − c·A₂c.
    fn squared_across(&self, sums: &Sums) -> f64 {
        let (v, spin, c) = (&self.sliding, &self.spin, self.slope());
        v.norm_squared() * sums.zeroth
            + 2.0 * v.dot(&(self.rotation * spin.cross(&sums.first)))
            + (spin.dot(&(turning(&sums.second) * spin)) - c.dot(&(sums.second * c)))
    }

    /// How that changes with a turn, the sums being kept.
    fn loss_by_turn(&self, sums: &Sums) -> Vec3 {
        let Self { direction: m, sliding, rotation, spin, .. } = self;
        let swept = sums.second * self.slope();
        2.0 * (spin.cross(&sums.first).cross(&rotation.tr_mul(sliding)) - spin.cross(&swept).cross(m))
    }

    /// f and τ of the sums C, N, T.
    fn wrench(&self, [central, normal, tangential]: [&Sums; 3]) -> Wrench {
        let Self { normal: n, direction: m, approach, sliding, rotation, spin } = self;
        let c = self.slope();
        let push = normal.zeroth * approach + normal.first.dot(&c);
        let lever = normal.first * *approach + normal.second * c;
        let drag = tangential.zeroth * sliding + rotation * spin.cross(&tangential.first);
        let along = (tangential.second * c).cross(m);
        let sliding = rotation.tr_mul(sliding);
        let drag_torque = tangential.first.cross(&sliding) + (turning(&tangential.second) * spin - along);
        Wrench {
            force: (central.zeroth - push) * n - (drag - n * n.dot(&drag)),
            torque: (central.first - lever).cross(m) - drag_torque,
        }
    }

    /// By a turn, the sums being kept: δm = m×δθ, δ(Rᵀv) = Rᵀv×δθ.
    fn by_turn(&self, [central, normal, tangential]: [&Sums; 3]) -> WrenchSlope {
        let Self { normal: n, direction: m, approach, sliding, rotation, spin } = self;
        let c = self.slope();
        let lever = normal.first * *approach + normal.second * c;
        let (across, turn_of_slope) = (cross_matrix(m), cross_matrix(spin) * cross_matrix(m));
        let swing = rotation * cross_matrix(&spin.cross(&tangential.first));
        let upright = n * spin.cross(&normal.first).cross(m).transpose();
        let pressed = cross_matrix(&(central.first - lever)) * across - across * normal.second * turn_of_slope;
        let dragged = cross_matrix(&(tangential.second * c)) * across + across * tangential.second * turn_of_slope
            - cross_matrix(&tangential.first) * cross_matrix(&rotation.tr_mul(sliding));
        WrenchSlope { force: project(n, &swing) - upright, torque: pressed + dragged }
    }

    /// By w₀ and by Ω: minus a symmetric 6×6 matrix, the resistance of the contact.
    fn by_motion(&self, [_, normal, tangential]: [&Sums; 3]) -> (WrenchSlope, WrenchSlope) {
        let Self { normal: n, direction: m, rotation, .. } = self;
        let across = cross_matrix(m);
        let translation =
            project(n, &Mat3::from_diagonal_element(-tangential.zeroth)) - normal.zeroth * n * n.transpose();
        let dragged = rotation * cross_matrix(&tangential.first);
        let coupling = project(n, &dragged) - n * normal.first.cross(m).transpose();
        let rotation =
            across * normal.second * across - (turning(&tangential.second) + across * tangential.second * across);
        (
            WrenchSlope { force: translation, torque: coupling.transpose() },
            WrenchSlope { force: coupling, torque: rotation },
        )
    }
}

/// One-sided damping of a rigid body, and that of a motion with n alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Opening {
    pub shift: Shift,
    /// w [m/s].
    pub speed: f64,
    /// N₁/N₀ [m].
    pub center: Vec3,
    /// F_N.
    pub wrench: Wrench,
    pub normal: Vec3,
    resistance: f64,
    /// c.
    slope: Vec3,
}

impl Opening {
    /// Of the sums of damping; none of one that is two-sided, or is nothing.
    fn of(laws: &LawSet, motion: &RigidMotion, damping: &Sums) -> Option<Self> {
        let one_sided = laws.one_sided().filter(|_| damping.zeroth > 0.0)?;
        let (center, slope) = (damping.first / damping.zeroth, motion.slope());
        let speed = motion.approach + center.dot(&slope);
        let RigidMotion { normal, direction, .. } = motion;
        let wrench = Wrench { force: -damping.zeroth * normal, torque: -damping.first.cross(direction) };
        let shift = one_sided.shift(speed);
        Some(Self { shift, speed, center, wrench, normal: *normal, resistance: damping.zeroth, slope })
    }

    /// δw with the sums of damping, the motion being kept.
    fn mean_along(&self, change: &Sums) -> f64 {
        self.slope.dot(&(change.first - change.zeroth * self.center)) / self.resistance
    }

    /// A change of the wrench, with that of w.
    fn along(&self, mut change: Wrench, mean: f64) -> Wrench {
        change += self.wrench.scaled(self.shift.slope * mean);
        change
    }
}

/// (1 − n⊗n) A.
fn project(n: &Vec3, a: &Mat3) -> Mat3 {
    a - n * a.tr_mul(n).transpose()
}

impl RigidLoads {
    /// The laws of a contact over any surface.
    pub(super) fn of_surface(
        laws: &LawSet,
        surface: &Surface,
        field: &GapField,
        motion: &RigidMotion,
        scratch: &mut ContactScratch,
    ) -> Result<Self, GapClosed> {
        let plan = laws.values();
        let moments = scratch.take(plan.requests().len());
        surface.planned_moments(field, plan, moments)?;
        let mut sums = Sums::by_action(laws, moments);
        Sums::bind(&mut sums, laws, moments, |friction| motion.squared_across(friction));
        let [_, normal, tangential] = &sums;
        let mut found = Self {
            wrench: motion.wrench(sums.each_ref()),
            damping_power: -motion.squared_along_normal(normal),
            friction_power: -motion.squared_across(tangential),
        };
        if let Some(opening) = Opening::of(laws, motion, normal) {
            found.wrench += opening.wrench.scaled(opening.shift.by);
            found.damping_power -= opening.shift.by * opening.speed * normal.zeroth;
        }
        Ok(found)
    }
}

impl ContactWrench {
    /// The laws of a contact over any surface, and their derivatives.
    pub(super) fn of_surface(
        laws: &LawSet,
        surface: &Surface,
        field: &GapField,
        motion: &RigidMotion,
        scratch: &mut ContactScratch,
    ) -> Result<Self, GapClosed> {
        let plan = laws.derivatives();
        let moments = scratch.take(plan.requests().len());
        surface.planned_moments(field, plan, moments)?;
        let mut sums = SumSlopes::new(laws, moments);
        let bounded = sums.bind(laws, moments, |friction| motion.squared_across(friction));
        let opening = Opening::of(laws, motion, &sums.values[Action::Normal as usize]);
        let damped = opening.as_ref().map(|opening| motion.approaching(motion.approach + opening.shift.by));
        let motion = damped.as_ref().unwrap_or(motion);
        let through_gap = |slope: usize| {
            let [central, normal, tangential] = &sums.by_gap;
            let wrench = motion.wrench([&central[slope], &normal[slope], &tangential[slope]]);
            opening.as_ref().map_or(wrench, |opening| opening.along(wrench, opening.mean_along(&normal[slope])))
        };
        let by_direction = [through_gap(1), through_gap(2), through_gap(3)];
        let through_direction = WrenchSlope {
            force: Mat3::from_columns(&by_direction.map(|slope| slope.force)),
            torque: Mat3::from_columns(&by_direction.map(|slope| slope.torque)),
        };
        let values = sums.values.each_ref();
        let mut by_turn = motion.by_turn(values);
        by_turn += through_direction.times(&cross_matrix(&motion.direction));
        let (by_velocity, by_spin) = motion.by_motion(values);
        let mut found =
            Self { wrench: motion.wrench(values), by_height: through_gap(0), by_turn, by_velocity, by_spin };
        if let Some((bound, free)) = bounded {
            let mut only = [Sums::default(); Action::COUNT];
            only[Action::Tangential as usize] = free;
            found.add_bound(&bound, &motion.wrench(only.each_ref()), &motion.loss_by_turn(&free));
        }
        if let Some(opening) = &opening {
            found.add_opening(opening, &motion.direction, &motion.spin);
        }
        Ok(found)
    }

    /// Adds what the shift of a one-sided damping changes by with the motion and a turn, the moments being kept.
    pub(super) fn add_opening(&mut self, opening: &Opening, direction: &Vec3, spin: &Vec3) {
        let Opening { shift, center, wrench, normal, .. } = opening;
        let along = |by: &Vec3| WrenchSlope {
            force: wrench.force * (shift.slope * by).transpose(),
            torque: wrench.torque * (shift.slope * by).transpose(),
        };
        self.by_turn += along(&spin.cross(center).cross(direction));
        self.by_velocity += along(normal);
        self.by_spin += along(&center.cross(direction));
    }

    /// Adds what the factor of a bound changes by with the motion and a turn, given the viscous friction and how what
    /// it takes changes with a turn, the moments being kept [W].
    pub(super) fn add_bound(&mut self, bound: &Bound, friction: &Wrench, by_turn: &Vec3) {
        let by_turn = by_turn.map(|lost| bound.change(&Sliding { lost, resistance: 0.0, push: 0.0 }));
        let along = |by: &Vec3| WrenchSlope {
            force: friction.force * by.transpose(),
            torque: friction.torque * by.transpose(),
        };
        self.by_turn += along(&by_turn);
        self.by_velocity += along(&(bound.by_motion() * friction.force));
        self.by_spin += along(&(bound.by_motion() * friction.torque));
    }
}
