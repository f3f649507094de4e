//! A ball is what its surface is.

use super::*;
use crate::contact::{Adhesion, AreaMeasure, ContactLaw, Damping, Friction, RelativeMotion, Repulsion};

const RADIUS: f64 = 0.3;

/// Without μ damping is two-sided, too.
fn laws(measure: AreaMeasure, exponent: f64, mu: Option<f64>) -> LawSet {
    let reference_gap = 0.1;
    let laws = vec![
        ContactLaw::Repulsion(Repulsion { alpha: 2.0, exponent, reference_gap }),
        ContactLaw::Damping(Damping { beta: 0.7, exponent, reference_gap, release: mu }),
        ContactLaw::Friction(Friction { beta: 0.9, exponent: exponent - 1.0, reference_gap, mu }),
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

/// The general method has a torque and derivatives that are differences of central and normal moments: it knows them to
/// the rounding of R f, R ∂f/∂g₀ and R ∂f/∂w₀.
#[test]
fn ball_is_what_its_surface_is() {
    let surface = Surface::sphere(RADIUS);
    let rotation = *nalgebra::Rotation3::new(Vec3::new(0.4, -1.1, 0.7)).matrix();
    let normal = Vec3::new(0.3, -0.5, 2.0).normalize();
    let spin = Vec3::new(1.0, -0.8, 0.6);
    let (velocity, gradient_rate) = (Vec3::new(0.9, -0.4, 0.5), rotation * cross_matrix(&spin));
    let motion = RigidMotion::new(&RelativeMotion { normal, velocity, gradient_rate }, &rotation, spin);
    let (mut worst, mut scratch): (f64, _) = (0.0, ContactScratch::default());
    let cases = [2.5, 6.0, 12.0].into_iter().flat_map(|nu| (-9..=1).map(move |power| (nu, power)));
    let cases = cases.flat_map(|(nu, power)| [None, Some(0.3)].map(|mu| (nu, power, mu)));
    for measure in [AreaMeasure::DeformedArea, AreaMeasure::ReferenceArea, AreaMeasure::DeformedAreaPotential] {
        for (exponent, power, mu) in cases.clone() {
            let field = surface.field_at(RADIUS * 10.0_f64.powi(power), motion.direction);
            let laws = laws(measure, exponent, mu);
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
            let powers =
                |loads: &RigidLoads| Mat3::from_diagonal(&Vec3::new(loads.damping_power, loads.friction_power, 0.0));
            compare(&powers(&of_ball), &powers(&of_any), 0.0);
        }
    }
    println!("a ball and its surface differ by {worst:.1e}");
    assert!(worst < 1e-14);
}
