//! Relations that the balance of an affine body obeys, whatever it is made of.

use gyration::affine::{AffineBalance, AffineBody, AnisotropicFriction, Gyration, Viscosity};
use gyration::mass::MassProperties;
use gyration::material::{Fung, Hencky, Material, MooneyRivlin, Ogden, OgdenTerm};
use gyration::tensor::{Mat3, Vec3};
use nalgebra::Matrix6;
use proptest::prelude::*;

fn mass() -> MassProperties {
    let euler_tensor = Mat3::new(0.5, 0.1, 0.0, 0.1, 0.3, 0.05, 0.0, 0.05, 0.9);
    MassProperties { mass: 2.0, center: Vec3::zeros(), euler_tensor, volume: 0.7 }
}

/// Friction that has no symmetry but that of the matrix.
fn fibres() -> AnisotropicFriction {
    let root = Matrix6::from_fn(|i, j| (1.3 * i as f64 + 0.7 * (j * j) as f64).sin());
    AnisotropicFriction::new(&(root * root.transpose())).unwrap()
}

/// Bodies of several materials, compressible and not, with and without friction, one of them pinned.
fn bodies() -> Vec<AffineBody> {
    let viscosity = Viscosity { kirchhoff: 0.4, shear: 0.3, bulk: 0.2 };
    let rubber = |bulk| Material::MooneyRivlin(MooneyRivlin { c1: 3.0, c2: 1.0, bulk });
    let body = |material, viscosity| AffineBody::new(&mass(), None, material, viscosity).unwrap();
    let pin = Vec3::new(0.4, -0.2, 0.7);
    vec![
        body(None, Viscosity::default()),
        body(Some(rubber(None)), Viscosity::default()),
        body(Some(rubber(None)), viscosity),
        body(Some(rubber(Some(20.0))), viscosity),
        body(Some(Material::Fung(Fung { shear: 2.0, exponent: 0.5, bulk: None })), viscosity),
        body(Some(Material::Ogden(Ogden { terms: vec![OgdenTerm { mu: 2.0, alpha: 1.7 }], bulk: None })), viscosity),
        AffineBody { anisotropic: Some(fibres()), ..body(Some(rubber(None)), Viscosity::default()) },
        AffineBody::new(&mass(), Some(&pin), Some(Material::Hencky(Hencky { shear: 2.0, bulk: 5.0 })), viscosity)
            .unwrap(),
    ]
}

fn balance(body: &AffineBody, p: &Mat3, rate: &Mat3, moment: &Mat3) -> AffineBalance {
    body.balance(&Gyration::of(p, rate).unwrap(), moment)
}

fn matrix(size: f64) -> impl Strategy<Value = Mat3> {
    prop::array::uniform9(-size..size).prop_map(|entries| Mat3::from_row_slice(&entries))
}

/// Gradients not too far from a rotation, on det P = 1 and tr L = 0 for an incompressible body.
fn admissible(body: &AffineBody, h: &Mat3, rate: &Mat3) -> (Mat3, Mat3) {
    let correction = body.project(&(Mat3::identity() + h), rate);
    (correction.gradient, correction.rate)
}

/// The derivative of a function by differences of sixth order: h⁶ of the seventh derivative and eps/h of rounding.
fn difference(f: impl Fn(f64) -> Mat3) -> Mat3 {
    let h = 1e-3;
    let pair = |k: f64| f(k * h) - f(-k * h);
    (45.0 * pair(1.0) - 9.0 * pair(2.0) + pair(3.0)) / (60.0 * h)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn power_of_the_moment_is_the_rate_of_the_energies_and_what_friction_takes(
        h in matrix(0.25), rate in matrix(2.0), moment in matrix(3.0),
    ) {
        for body in bodies() {
            let (p, rate) = admissible(&body, &h, &rate);
            let balance = balance(&body, &p, &rate, &moment);
            // T = ½ tr(Ṗ J Ṗᵀ); the energy of the material changes with S_e·Ṗ, of which V S·Ṗ is short by the friction.
            let kinetic = (balance.acceleration * body.euler_tensor).dot(&rate);
            let work = body.volume * balance.stress.dot(&rate);
            let scale = moment.norm() * rate.norm() + work.abs() + balance.dissipation.abs();
            prop_assert!((kinetic + work - moment.dot(&rate)).abs() < 1e-12 * scale);
            prop_assert!(balance.dissipation >= 0.0);
            let elastic = difference(|t| {
                let energy = body.energy(&(p + t * rate));
                Mat3::from_diagonal_element(energy)
            })[(0, 0)];
            prop_assert!((work - balance.dissipation - elastic).abs() < 1e-8 * (scale + elastic.abs()));
        }
    }

    #[test]
    fn volume_stays_when_the_body_is_incompressible(h in matrix(0.25), rate in matrix(2.0), moment in matrix(3.0)) {
        for body in bodies().iter().filter(|body| body.is_incompressible()) {
            let (p, rate) = admissible(body, &h, &rate);
            prop_assert!((p.determinant() - 1.0).abs() < 1e-14);
            let inverse = p.try_inverse().unwrap();
            let l = rate * inverse;
            prop_assert!(l.trace().abs() < 1e-13 * l.norm());
            let balance = balance(body, &p, &rate, &moment);
            let (there, asked) = ((balance.acceleration * inverse).trace(), (l * l).trace());
            prop_assert!((there - asked).abs() < 1e-12 * (asked.abs() + balance.acceleration.norm()));
        }
    }

    #[test]
    fn spin_changes_with_the_torque_alone(h in matrix(0.25), rate in matrix(2.0), moment in matrix(3.0)) {
        for body in bodies() {
            let (p, rate) = admissible(&body, &h, &rate);
            let balance = balance(&body, &p, &rate, &moment);
            // d/dt skw(P J Ṗᵀ) = skw(P (P̈ J)ᵀ): the stress, S Pᵀ symmetric, has no part in it.
            let k = p * (balance.acceleration * body.euler_tensor).transpose();
            let n = p * moment.transpose();
            let torque = (k - k.transpose()) - (n - n.transpose());
            prop_assert!(torque.norm() < 1e-12 * (k.norm() + n.norm()));
        }
    }

    #[test]
    fn slopes_are_the_derivative_of_the_balance(
        h in matrix(0.25), rate in matrix(2.0), moment in matrix(3.0), dp in matrix(1.0), drate in matrix(1.0), dm in matrix(1.0),
    ) {
        for body in bodies() {
            let (p, rate) = admissible(&body, &h, &rate);
            let here = Gyration::of(&p, &rate).unwrap();
            let slopes = body.slopes(&here, &moment);
            let at = |s: f64| balance(&body, &(p + s * dp), &(rate + s * drate), &(moment + s * dm));
            let (acceleration, pressure) = slopes.apply(&dp, &drate, &dm);
            let by_differences = difference(|s| at(s).acceleration);
            prop_assert!((acceleration - by_differences).norm() < 1e-8 * (1.0 + acceleration.norm()), "{body:?}{acceleration}{by_differences}");
            let by_differences = difference(|s| Mat3::from_diagonal_element(at(s).pressure.unwrap_or(0.0)))[(0, 0)];
            prop_assert!((pressure - by_differences).abs() < 1e-8 * (1.0 + pressure.abs()), "{pressure} {by_differences}");
        }
    }

    #[test]
    fn projection_leaves_the_spin_and_what_is_admissible(h in matrix(0.25), rate in matrix(2.0)) {
        for body in bodies().iter().filter(|body| body.is_incompressible()) {
            let once = body.project(&(Mat3::identity() + h), &rate);
            let twice = body.project(&once.gradient, &once.rate);
            prop_assert!((twice.gradient - once.gradient).norm() < 1e-14 && twice.size < 1e-14);
            prop_assert!((twice.rate - once.rate).norm() < 1e-13 * (1.0 + rate.norm()));
            // At the corrected P the velocity loses no spin.
            let spin = |rate: &Mat3| {
                let k = rate * body.euler_tensor * once.gradient.transpose();
                k - k.transpose()
            };
            prop_assert!((spin(&rate) - spin(&once.rate)).norm() < 1e-13 * (1.0 + rate.norm()));
        }
    }
}

#[test]
fn simple_shear_needs_no_pressure() {
    let (p, rate) = (
        Mat3::new(1.0, 0.8, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        Mat3::new(0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    );
    let free = Material::MooneyRivlin(MooneyRivlin { c1: 0.0, c2: 0.0, bulk: None });
    let body = AffineBody::new(&mass(), None, Some(free), Viscosity::default()).unwrap();
    let balance = balance(&body, &p, &rate, &Mat3::zeros());
    assert!(balance.pressure.unwrap().abs() < 1e-15 && balance.acceleration.norm() < 1e-15, "{balance:?}");
}

#[test]
fn flat_bodies_and_flattened_gradients_are_refused() {
    let flat = MassProperties { euler_tensor: Mat3::from_diagonal(&Vec3::new(1.0, 1.0, 0.0)), ..mass() };
    let error = AffineBody::new(&flat, None, None, Viscosity::default()).unwrap_err();
    assert!(error.to_string().contains("in one plane"), "{error}");
    let singular = Mat3::from_diagonal(&Vec3::new(1.0, 1.0, 0.0));
    assert_eq!(Gyration::of(&singular, &Mat3::zeros()), Err(0.0));
}
