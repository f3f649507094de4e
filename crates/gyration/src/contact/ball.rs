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
//! Derivatives by the height are the same formulas with the sums of ν + 1.

use super::law_set::{ContactScratch, LawSet};
use super::wrench::{ContactWrench, RigidLoads, RigidMotion};
use super::{Action, Term};
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
        let sums = by_action(terms.map(|planned| (&planned.term, planned.term.coefficient, &moments[planned.value])));
        let rolling = Rolling::new(motion);
        let [_, normal, tangential] = &sums;
        // |Ω − (m·Ω) m|² = |Ω×m|².
        let (drilling, tilting) = (rolling.drilling.powi(2), rolling.swing.norm_squared());
        let sliding = motion.sliding.norm_squared() * tangential.zeroth
            + 2.0 * motion.sliding.dot(&rolling.swing) * tangential.first
            + tangential.along * tilting;
        Some(Ok(Self {
            wrench: rolling.wrench(&sums),
            damping_power: -(motion.approach.powi(2) * normal.zeroth + normal.across * tilting),
            friction_power: -(sliding + 2.0 * tangential.across * drilling),
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
        let (values, slopes) = (by_action(values), by_action(slopes));
        let rolling = Rolling::new(motion);
        let (by_velocity, by_spin) = rolling.by_motion(&values);
        Some(Ok(Self {
            wrench: rolling.wrench(&values),
            by_height: rolling.wrench(&slopes),
            by_turn: rolling.by_turn(&values),
            by_velocity,
            by_spin,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Adhesion, AreaMeasure, ContactLaw, Damping, Friction, RelativeMotion, Repulsion};

    const RADIUS: f64 = 0.3;

    fn laws(measure: AreaMeasure, exponent: f64) -> LawSet {
        let reference_gap = 0.1;
        let laws = vec![
            ContactLaw::Repulsion(Repulsion { alpha: 2.0, exponent, reference_gap }),
            ContactLaw::Damping(Damping { beta: 0.7, exponent, reference_gap }),
            ContactLaw::Friction(Friction { beta: 0.9, exponent: exponent - 1.0, reference_gap }),
            ContactLaw::Adhesion(Adhesion {
                beta: 1.3,
                attractive_exponent: exponent - 1.0,
                repulsive_exponent: exponent,
                reference_gap,
            }),
        ];
        LawSet::new(measure, laws)
    }

    /// |a − b| as a part of |b| and of what the general method sums to it.
    fn differ(a: &Mat3, b: &Mat3, summed: f64) -> f64 {
        (a - b).norm() / (b.norm() + summed)
    }

    /// f and τ as a matrix.
    fn columns(wrench: &Wrench) -> [Mat3; 2] {
        [wrench.force, wrench.torque].map(|vector| Mat3::from_columns(&[vector, Vec3::zeros(), Vec3::zeros()]))
    }

    /// The general method has a torque and derivatives that are differences of central and normal moments: it knows
    /// them to the rounding of R f, R ∂f/∂g₀ and R ∂f/∂w₀.
    #[test]
    fn ball_is_what_its_surface_is() {
        let surface = Surface::sphere(RADIUS);
        let rotation = *nalgebra::Rotation3::new(Vec3::new(0.4, -1.1, 0.7)).matrix();
        let normal = Vec3::new(0.3, -0.5, 2.0).normalize();
        let spin = Vec3::new(1.0, -0.8, 0.6);
        let (velocity, gradient_rate) = (Vec3::new(0.9, -0.4, 0.5), rotation * cross_matrix(&spin));
        let motion = RigidMotion::new(&RelativeMotion { normal, velocity, gradient_rate }, &rotation, spin);
        let (mut worst, mut scratch): (f64, _) = (0.0, ContactScratch::default());
        for measure in [AreaMeasure::DeformedArea, AreaMeasure::ReferenceArea, AreaMeasure::DeformedAreaPotential] {
            for (exponent, power) in [2.5, 6.0, 12.0].into_iter().flat_map(|nu| (-9..=1).map(move |power| (nu, power)))
            {
                let field = surface.field_at(RADIUS * 10.0_f64.powi(power), motion.direction);
                let laws = laws(measure, exponent);
                let of_ball = RigidLoads::of_ball(&laws, &surface, &field, &motion, &mut scratch).unwrap().unwrap();
                let of_any = RigidLoads::of_surface(&laws, &surface, &field, &motion, &mut scratch).unwrap();
                let ball = ContactWrench::of_ball(&laws, &surface, &field, &motion, &mut scratch).unwrap().unwrap();
                let any = ContactWrench::of_surface(&laws, &surface, &field, &motion, &mut scratch).unwrap();
                let (force, stiffness) = (any.wrench.force.norm(), any.by_height.force.norm());
                let mut compare = |one: &Mat3, other: &Mat3, summed: f64| {
                    worst = worst.max(differ(one, other, summed));
                };
                for (one, other) in [(&of_ball.wrench, &of_any.wrench), (&ball.wrench, &any.wrench)] {
                    let ([push, twist], [any_push, any_twist]) = (columns(one), columns(other));
                    compare(&push, &any_push, 0.0);
                    compare(&twist, &any_twist, RADIUS * force);
                }
                let ([push, twist], [any_push, any_twist]) = (columns(&ball.by_height), columns(&any.by_height));
                compare(&push, &any_push, 0.0);
                compare(&twist, &any_twist, RADIUS * stiffness);
                compare(&ball.by_turn.force, &any.by_turn.force, RADIUS * stiffness);
                compare(&ball.by_turn.torque, &any.by_turn.torque, RADIUS * RADIUS * stiffness);
                let resistance = any.by_velocity.force.norm();
                compare(&ball.by_velocity.force, &any.by_velocity.force, 0.0);
                compare(&ball.by_velocity.torque, &any.by_velocity.torque, RADIUS * resistance);
                compare(&ball.by_spin.force, &any.by_spin.force, RADIUS * resistance);
                compare(&ball.by_spin.torque, &any.by_spin.torque, RADIUS * RADIUS * resistance);
                let powers = |loads: &RigidLoads| {
                    Mat3::from_diagonal(&Vec3::new(loads.damping_power, loads.friction_power, 0.0))
                };
                compare(&powers(&of_ball), &powers(&of_any), 0.0);
            }
        }
        println!("a ball and its surface differ by {worst:.1e}");
        assert!(worst < 1e-14);
    }
}
