//! A contact of a rigid ball about its centre of mass, in closed form: the wrench of `wrench` and its derivatives.
//!
//! The moments of a ball are A₁ = a₁ m and A₂ = a_c m⊗m + a_⊥ (1 − m⊗m), and turning it changes none. With the sums C,
//! N, T of the central, normal and tangential laws and w = m×Rᵀv, the formulas of `wrench` become
//!
//!   f = (C₀ − N₀ s) n − (1 − n⊗n)(T₀v + T₁ R(Ω×m))
//!   τ = −(T₁ w + k Ω + (k_m − k) (m·Ω) m),   k = N_⊥ + T_c,   k_m = 2T_⊥
//!
//! and with δm = m×δθ, δw = w×δθ,
//!
//!   ∂f/∂θ = −T₁ (1 − n⊗n) R [m]× [Ω]×,   ∂τ/∂θ = −(T₁ [w]× + (k_m − k) ((m·Ω) 1 + m⊗Ω) [m]×)
//!
//! Derivatives by the height are the same formulas with the sums of ν + 1. Friction alone takes 2R = T₀v² + 2T₁
//! v·R(Ω×m) + T_c |Ω×m|² + 2T_⊥ (m·Ω)², from which its bound is:
//!
//!   ∂(2R)/∂θ = 2 (T₁ Ω×w + (2T_⊥ − T_c) (m·Ω) Ω×m)

use super::law_set::{ContactScratch, LawSet, PlannedTerm};
use super::sums::push;
use super::wrench::{ContactWrench, RigidLoads, RigidMotion};
use super::{Action, Bound, Sliding, Term};
use crate::load::{Wrench, WrenchSlope};
use crate::surface::{AxialMoments, GapClosed, GapField, Surface};
use crate::tensor::{Mat3, Vec3, cross_matrix};

/// Σ c a₀, Σ c a₁, Σ c a_c and Σ c a_⊥ of one action.
#[derive(Debug, Clone, Copy, Default)]
struct AxialSums {
    zeroth: f64,
    first: f64,
    along: f64,
    across: f64,
}

/// The sums of each [`Action`].
type ByAction = [AxialSums; Action::COUNT];

/// A ball that moves at a plane.
struct Rolling<'a> {
    motion: &'a RigidMotion,
    /// m·Ω [rad/s].
    drilling: f64,
    /// w [m/s].
    dragged: Vec3,
    /// R(Ω×m) [rad/s].
    swing: Vec3,
}

impl AxialSums {
    fn add(&mut self, coefficient: f64, moments: &AxialMoments) {
        let AxialMoments { zeroth, first, along, across } = moments;
        self.zeroth += coefficient * zeroth;
        self.first += coefficient * first;
        self.along += coefficient * along;
        self.across += coefficient * across;
    }

    /// All of it times a factor.
    fn scale(&mut self, factor: f64) {
        *self = Self::default().plus(factor, self);
    }

    /// These sums and others times a factor.
    fn plus(&self, factor: f64, other: &Self) -> Self {
        Self {
            zeroth: self.zeroth + factor * other.zeroth,
            first: self.first + factor * other.first,
            along: self.along + factor * other.along,
            across: self.across + factor * other.across,
        }
    }
}

/// k and k_m: the torques of a unit of spin across m and along it.
fn resistances([_, normal, tangential]: &ByAction) -> (f64, f64) {
    (normal.across + tangential.along, 2.0 * tangential.across)
}

/// Σ factor × moments of the terms, action by action.
fn by_action<'a>(terms: impl Iterator<Item = (&'a Term, f64, &'a AxialMoments)>) -> ByAction {
    let mut sums = ByAction::default();
    for (term, factor, moments) in terms {
        sums[term.action as usize].add(factor, moments);
    }
    sums
}

impl<'a> Rolling<'a> {
    fn new(motion: &'a RigidMotion) -> Self {
        let RigidMotion { direction, sliding, rotation, spin, .. } = motion;
        Self {
            motion,
            drilling: direction.dot(spin),
            dragged: direction.cross(&rotation.tr_mul(sliding)),
            swing: rotation * spin.cross(direction),
        }
    }

    /// v without what rounding leaves of it along n.
    fn across(&self, v: &Vec3) -> Vec3 {
        let n = &self.motion.normal;
        v - n * n.dot(v)
    }

    /// f and τ.
    fn wrench(&self, sums: &ByAction) -> Wrench {
        let RigidMotion { normal: n, direction: m, approach, sliding, spin, .. } = self.motion;
        let [central, normal, tangential] = sums;
        let (k, k_m) = resistances(sums);
        let drag = tangential.zeroth * sliding + tangential.first * self.swing;
        Wrench {
            force: (central.zeroth - normal.zeroth * approach) * n - self.across(&drag),
            torque: -(tangential.first * self.dragged + k * spin + (k_m - k) * self.drilling * m),
        }
    }

    /// 2R [W] of these sums of friction.
    fn lost(&self, friction: &AxialSums) -> f64 {
        // |Ω − (m·Ω) m|² = |Ω×m|².
        let (drilling, tilting) = (self.drilling.powi(2), self.swing.norm_squared());
        let sliding = self.motion.sliding.norm_squared() * friction.zeroth
            + 2.0 * self.motion.sliding.dot(&self.swing) * friction.first
            + friction.along * tilting;
        sliding + 2.0 * friction.across * drilling
    }

    /// ∂(2R)/∂θ.
    fn loss_by_turn(&self, friction: &AxialSums) -> Vec3 {
        let RigidMotion { direction: m, spin, .. } = self.motion;
        let drilled = (2.0 * friction.across - friction.along) * self.drilling;
        2.0 * (friction.first * spin.cross(&self.dragged) + drilled * spin.cross(m))
    }

    /// The bound of friction with a coefficient μ, from its sums and N [N].
    fn bound(&self, mu: f64, friction: &AxialSums, push: f64) -> Bound {
        Bound::new(mu, Sliding { lost: self.lost(friction), resistance: friction.zeroth, push })
    }

    /// Puts a bound on the friction among sums and their derivatives by the height, given N and its derivative; what is
    /// returned has the sums without it.
    fn bind(&self, mu: f64, [values, slopes]: [&mut ByAction; 2], [push, by_height]: [f64; 2]) -> (Bound, AxialSums) {
        let (friction, slope) = (&mut values[Action::Tangential as usize], &mut slopes[Action::Tangential as usize]);
        let (bound, free) = (self.bound(mu, friction, push), *friction);
        let change = bound.change(&Sliding { lost: self.lost(slope), resistance: slope.zeroth, push: by_height });
        slope.scale(bound.factor());
        *slope = slope.plus(change, &free);
        friction.scale(bound.factor());
        (bound, free)
    }

    /// ∂f/∂θ and ∂τ/∂θ.
    fn by_turn(&self, sums: &ByAction) -> WrenchSlope {
        let RigidMotion { normal: n, direction: m, rotation, spin, .. } = self.motion;
        let first = sums[Action::Tangential as usize].first;
        let (k, k_m) = resistances(sums);
        let turned = cross_matrix(m);
        let swing = -first * rotation * turned * cross_matrix(spin);
        let drilled = Mat3::from_diagonal_element(self.drilling) + m * spin.transpose();
        WrenchSlope {
            force: swing - n * swing.tr_mul(n).transpose(),
            torque: -(first * cross_matrix(&self.dragged) + (k_m - k) * drilled * turned),
        }
    }

    /// By w₀ and by Ω.
    fn by_motion(&self, sums: &ByAction) -> (WrenchSlope, WrenchSlope) {
        let RigidMotion { normal: n, direction: m, rotation, .. } = self.motion;
        let [_, normal, tangential] = sums;
        let (k, k_m) = resistances(sums);
        let along = n * n.transpose();
        let coupling = tangential.first * rotation * cross_matrix(m);
        let translation = -(normal.zeroth * along + tangential.zeroth * (Mat3::identity() - along));
        let rotation = -(Mat3::from_diagonal_element(k) + (k_m - k) * m * m.transpose());
        (
            WrenchSlope { force: translation, torque: coupling.transpose() },
            WrenchSlope { force: coupling, torque: rotation },
        )
    }
}

impl RigidLoads {
    /// The laws of a contact over a ball about its centre of mass; none of any other surface.
    pub(super) fn of_ball(
        laws: &LawSet,
        surface: &Surface,
        field: &GapField,
        motion: &RigidMotion,
        scratch: &mut ContactScratch,
    ) -> Option<Result<Self, GapClosed>> {
        let plan = laws.values();
        let moments = scratch.take_axial(plan.requests().len());
        if let Err(closed) = surface.axial_moments(field, plan, moments)? {
            return Some(Err(closed));
        }
        let terms = laws.terms().iter();
        let mut sums =
            by_action(terms.map(|planned| (&planned.term, planned.term.coefficient, &moments[planned.value])));
        let one_sided = laws.one_sided().map(|one_sided| one_sided.shift(motion.approach));
        let damped = one_sided.map(|shift| motion.approaching(motion.approach + shift.by));
        let damped = damped.as_ref().unwrap_or(motion);
        let rolling = Rolling::new(damped);
        if let Some(mu) = laws.mu() {
            let push = push(laws, |planned| planned.term.coefficient * moments[planned.value].zeroth);
            let friction = &mut sums[Action::Tangential as usize];
            friction.scale(rolling.bound(mu, friction, push).factor());
        }
        let [_, normal, tangential] = &sums;
        let tilting = rolling.swing.norm_squared();
        Some(Ok(Self {
            wrench: rolling.wrench(&sums),
            damping_power: -(motion.approach * damped.approach * normal.zeroth + normal.across * tilting),
            friction_power: -rolling.lost(tangential),
        }))
    }
}

impl ContactWrench {
    /// The laws of a contact over a ball about its centre of mass, and their derivatives; none of any other surface.
    pub(super) fn of_ball(
        laws: &LawSet,
        surface: &Surface,
        field: &GapField,
        motion: &RigidMotion,
        scratch: &mut ContactScratch,
    ) -> Option<Result<Self, GapClosed>> {
        let plan = laws.derivatives();
        let moments = scratch.take_axial(plan.requests().len());
        if let Err(closed) = surface.axial_moments(field, plan, moments)? {
            return Some(Err(closed));
        }
        let terms = || laws.terms().iter();
        let values = terms().map(|planned| {
            let term = &planned.term;
            (term, term.coefficient, &moments[planned.value_with_derivative])
        });
        let slopes = terms().map(|planned| {
            let term = &planned.term;
            (term, -term.exponent * term.coefficient, &moments[planned.derivative])
        });
        let (mut values, mut slopes) = (by_action(values), by_action(slopes));
        let one_sided = laws.one_sided().map(|one_sided| one_sided.shift(motion.approach));
        let damped = one_sided.map(|shift| motion.approaching(motion.approach + shift.by));
        let rolling = Rolling::new(damped.as_ref().unwrap_or(motion));
        let bounded = laws.mu().map(|mu| {
            let of_term = |planned: &PlannedTerm| {
                let term = &planned.term;
                let slope = -term.exponent * term.coefficient * moments[planned.derivative].zeroth;
                (term.coefficient * moments[planned.value_with_derivative].zeroth, slope)
            };
            rolling.bind(
                mu,
                [&mut values, &mut slopes],
                [push(laws, |planned| of_term(planned).0), push(laws, |planned| of_term(planned).1)],
            )
        });
        let (by_velocity, by_spin) = rolling.by_motion(&values);
        let mut found = Self {
            wrench: rolling.wrench(&values),
            by_height: rolling.wrench(&slopes),
            by_turn: rolling.by_turn(&values),
            by_velocity,
            by_spin,
        };
        if let Some(shift) = one_sided {
            let n = &motion.normal;
            found.by_velocity.force -= shift.slope * values[Action::Normal as usize].zeroth * n * n.transpose();
        }
        if let Some((bound, free)) = bounded {
            let mut only = ByAction::default();
            only[Action::Tangential as usize] = free;
            found.add_bound(&bound, &rolling.wrench(&only), &rolling.loss_by_turn(&free));
        }
        Some(Ok(found))
    }
}

#[cfg(test)]
mod tests;
