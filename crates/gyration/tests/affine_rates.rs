//! Relations that the rates of affine bodies obey, whatever the scene: exact Jacobian, power balance, dissipation,
//! objectivity.

use crate::moving::*;
use gyration::affine::{AffineBody, Kinetic, Viscosity};
use gyration::balance::observe;
use gyration::body::{Affine, Body, BodyKind, RigidInertia, Solid};
use gyration::contact::{AreaMeasure, Contact, LawSet};
use gyration::dynamics::Workspace;
use gyration::fluid::{Fluid, Form};
use gyration::kinematics::{Placement, Quaternion, Velocity};
use gyration::ledger::{Energy, Work};
use gyration::load::Frame;
use gyration::material::{Material, MooneyRivlin};
use gyration::model::Model;
use gyration::shape::{Cuboid, Shape, Sphere};
use gyration::signal::{Signal, Wave};
use gyration::state::{RigidStart, Start, State};
use gyration::tensor::{Mat3, Vec3};
use proptest::prelude::*;
use std::sync::Arc;

const MEASURES: [AreaMeasure; 3] =
    [AreaMeasure::DeformedArea, AreaMeasure::ReferenceArea, AreaMeasure::DeformedAreaPotential];

/// A box of each variant, and one body of each other shape.
fn model(exponents: [f64; 4], measure: AreaMeasure) -> Model {
    let free = Variant { incompressible: false, pinned: false, frame: Frame::Space };
    let boxes = [
        free,
        Variant { incompressible: true, frame: Frame::Body, ..free },
        Variant { pinned: true, frame: Frame::Body, ..free },
        Variant { incompressible: true, pinned: true, ..free },
    ];
    let [cuboid, round @ ..] = shapes();
    let boxes = boxes.map(|variant| body(cuboid.clone(), variant));
    let others = round.map(|shape| body(shape, Variant { incompressible: true, ..free }));
    let model = Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), boxes.into_iter().chain(others));
    attached(model, exponents, measure)
}

/// A state above both supports for any 24 numbers in [−1, 1]; incompressible bodies on their constraint.
fn state(model: &Model, numbers: &[f64]) -> State {
    let position = Vec3::new(numbers[0], numbers[1], 1.5 + 0.2 * numbers[2]);
    let strain = Mat3::from_column_slice(&numbers[3..12]);
    let rotation = *nalgebra::Rotation3::new(Vec3::new(numbers[3], numbers[7], numbers[11])).matrix();
    let (gradient, rate) = (rotation * (Mat3::identity() + 0.15 * strain), Mat3::from_column_slice(&numbers[15..24]));
    let velocity = Vec3::new(numbers[12], numbers[13], numbers[14]);
    let start = |body: &Arc<Body>| {
        let corrected = body.affine().unwrap().interior.project(&gradient, &rate);
        Start::Affine(
            Placement { position, gradient: corrected.gradient },
            Velocity { velocity, gradient_rate: corrected.rate },
        )
    };
    let starts: Vec<Start> = model.bodies.iter().map(start).collect();
    State { time: 0.37, ..State::start(model, &starts) }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn jacobian_and_power_of_inclusions_are_those_of_their_rates(numbers in numbers(24), exponents in exponents()) {
        for inertia in [true, false] {
            let ellipsoids = immersed(model(exponents, AreaMeasure::DeformedArea), inertia);
            for model in [ellipsoids.clone(), any_form::of_any_form(ellipsoids)] {
                let state = state(&model, &numbers);
                assert_jacobian_is_the_derivative(&model, &state);
                assert_power_is_the_rate_of_energy(&model, &state);
            }
        }
    }

    #[test]
    fn jacobian_and_power_of_spheres_whose_strain_the_fluid_remembers_are_those_of_their_rates(
        numbers in numbers(24), exponents in exponents(),
    ) {
        let free = Variant { incompressible: false, pinned: false, frame: Frame::Space };
        let [_, sphere, ..] = shapes();
        let spheres = [false, true].map(|incompressible| body(sphere.clone(), Variant { incompressible, ..free }));
        let model = Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), spheres);
        let model = with_history(attached(model, exponents, AreaMeasure::DeformedArea), true);
        prop_assert!(model.bodies.len() == 2);
        let mut state = state(&model, &numbers);
        shake_modes(&model, &mut state);
        assert_jacobian_is_the_derivative(&model, &state);
        assert_power_is_the_rate_of_energy(&model, &state);
    }

    #[test]
    fn jacobian_is_the_derivative_of_the_rates(numbers in numbers(24), exponents in exponents()) {
        for measure in MEASURES {
            let model = model(exponents, measure);
            let state = state(&model, &numbers);
            assert_jacobian_is_the_derivative(&model, &state);
        }
    }

    #[test]
    fn jacobian_and_power_under_a_controller_are_those_of_the_rates(numbers in numbers(24), exponents in exponents()) {
        let model = controlled(model(exponents, AreaMeasure::DeformedArea));
        let state = state(&model, &numbers);
        assert_jacobian_is_the_derivative(&model, &state);
        assert_power_is_the_rate_of_energy(&model, &state);
        let without_inertia = controlled(immersed(model, false));
        let state = self::state(&without_inertia, &numbers);
        assert_jacobian_is_the_derivative(&without_inertia, &state);
        assert_power_is_the_rate_of_energy(&without_inertia, &state);
    }

    #[test]
    fn jacobian_and_power_under_forces_of_their_own_are_those_of_the_rates(
        numbers in numbers(24), exponents in exponents(),
    ) {
        let model = model(exponents, AreaMeasure::DeformedArea);
        for model in [with_own_forces(model.clone()), with_own_forces(immersed(model, false))] {
            let state = state(&model, &numbers);
            assert_jacobian_is_the_derivative(&model, &state);
            assert_power_is_the_rate_of_energy(&model, &state);
        }
    }

    #[test]
    fn jacobian_and_power_of_other_kinetic_energies_are_those_of_the_rates(
        numbers in numbers(24), exponents in exponents(),
    ) {
        for kinetic in [Kinetic::Comoving, Kinetic::Invariant { square: 0.04, trace: -0.03 }] {
            let free = Variant { incompressible: false, pinned: false, frame: Frame::Space };
            let own = |shape| {
                let mut body = body(shape, free);
                if let BodyKind::Affine(affine) = &mut body.kind {
                    affine.interior.kinetic = Some(kinetic);
                }
                body
            };
            let model = Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), shapes().map(own));
            let model = attached(model, exponents, AreaMeasure::DeformedArea);
            for model in [with_own_forces(model.clone()), immersed(model, true)] {
                let state = state(&model, &numbers);
                assert_jacobian_is_the_derivative(&model, &state);
                assert_power_is_the_rate_of_energy(&model, &state);
            }
        }
    }

    #[test]
    fn jacobian_and_power_under_a_bound_on_friction_are_those_of_the_rates(
        numbers in numbers(24), exponents in exponents(), mu in 0.01..1.0_f64,
    ) {
        let models = MEASURES.map(|measure| bounded(model(exponents, measure), mu));
        let without_inertia = immersed(models[0].clone(), false);
        for model in models.into_iter().chain([without_inertia]) {
            let state = state(&model, &numbers);
            assert_jacobian_is_the_derivative(&model, &state);
            assert_power_is_the_rate_of_energy(&model, &state);
        }
    }

    #[test]
    fn power_of_works_is_the_rate_of_energy(numbers in numbers(24), exponents in exponents()) {
        for measure in MEASURES {
            let model = model(exponents, measure);
            let state = state(&model, &numbers);
            assert_power_is_the_rate_of_energy(&model, &state);
        }
    }

    #[test]
    fn friction_of_every_kind_dissipates(numbers in numbers(24), exponents in exponents()) {
        let model = model(exponents, AreaMeasure::DeformedArea);
        let state = state(&model, &numbers);
        let (_, powers) = evaluate(&model, state.time, &state.bodies);
        for (work, power) in model.works().iter().zip(powers) {
            if [Work::Damping, Work::Friction, Work::Viscosity].contains(work) {
                prop_assert!(power <= 0.0, "{} does {power} W", work.name());
            }
        }
    }

    #[test]
    fn turning_everything_about_the_vertical_turns_the_answer(numbers in numbers(24), angle in -3.0..3.0_f64) {
        // Friction fixed in space and couples single out directions: without them.
        let shape = Shape::Box(Cuboid { size: Vec3::new(0.8, 1.0, 0.6) });
        let variant = Variant { incompressible: true, pinned: false, frame: Frame::Body };
        let mut soft = body(shape, variant);
        if let BodyKind::Affine(affine) = &mut soft.kind {
            affine.couple = None;
        }
        let law_set = LawSet::new(AreaMeasure::DeformedArea, laws([6.0, 3.0, 3.0, 2.0]));
        let model = Model::new(Vec3::new(0.0, 0.0, -9.81), supports(), vec![soft]);
        let model = model.with_contacts(vec![Contact::new(0, 0, law_set)]);
        let state = state(&model, &numbers);
        let turn = *nalgebra::Rotation3::from_axis_angle(&Vec3::z_axis(), angle).matrix();
        let turned = |numbers: &[f64]| -> Vec<f64> {
            numbers.chunks(3).flat_map(|column| Vec::from((turn * Vec3::from_column_slice(column)).as_slice())).collect()
        };
        let (expected, powers) = evaluate(&model, state.time, &state.bodies);
        let (found, powers_turned) = evaluate(&model, state.time, &turned(&state.bodies));
        let scale = expected.iter().fold(1.0, |most: f64, rate| most.max(rate.abs()));
        // Rounding of some thousand operations.
        for (a, b) in turned(&expected).iter().zip(&found) {
            prop_assert!((a - b).abs() < 1e-11 * scale, "{a} {b}");
        }
        for (a, b) in powers.iter().zip(&powers_turned) {
            prop_assert!((a - b).abs() < 1e-11 * (a.abs() + scale), "{a} {b}");
        }
    }
}

/// With the density and the viscosity of the fluid, a sphere is fluid: at every instant at which it moves with the
/// undisturbed flow it goes on to do so.
#[test]
fn sphere_of_the_fluid_itself_goes_with_the_flow() {
    let (radius, viscosity, density, time) = (0.5, 0.8, 0.6, 0.37);
    let shape = Shape::Sphere(Sphere { radius });
    let mass = shape.mass_properties(density);
    for incompressible in [false, true] {
        let material = incompressible.then_some(Material::MooneyRivlin(MooneyRivlin { c1: 0.0, c2: 0.0, bulk: None }));
        let friction = Viscosity { kirchhoff: 0.0, shear: viscosity, bulk: 0.0 };
        let interior = AffineBody::new(&mass, None, material, friction).unwrap();
        let own = Affine { interior, couple: None, resistances: vec![] };
        let [_, sphere, ..] = shapes();
        let free = Variant { incompressible, pinned: false, frame: Frame::Space };
        let soft = Body { kind: BodyKind::Affine(Box::new(own)), ..body(sphere, free) };
        let soft = Body { solid: Solid::new(shape.clone(), mass).into(), ..soft };
        let model = with_history(Model::new(Vec3::new(0.3, -0.2, -9.81), vec![], vec![soft]), true);
        // A flow without vorticity, of which the pressure keeps account.
        let strain = Mat3::new(0.3, 0.6, -0.4, 0.6, -0.5, 0.7, -0.4, 0.7, 0.2);
        let wave = |amplitude| Signal::Sine(Wave { amplitude, frequency: 0.6, phase: 0.2 });
        let gradient = Signal::Sum(vec![Signal::Constant(0.5 * strain), wave(strain)]);
        let model = model.in_fluid(Fluid { viscosity, density, gradient, ..fluid() });
        let inclusion = |body: &Arc<Body>| {
            let mut own = (**body).clone();
            let inclusion = own.inclusion.as_mut().unwrap();
            (inclusion.center, inclusion.volume) = (Vec3::zeros(), own.solid.mass.volume);
            inclusion.form = Form::Ellipsoid(Vec3::repeat(radius));
            own
        };
        let bodies: Vec<Body> = model.bodies.iter().map(inclusion).collect();
        let model = model.with_bodies(bodies);
        let around = model.fluid.clone().unwrap();
        let (flow, position) = (around.flow(time), Vec3::new(0.4, -0.7, 0.2));
        let placement = Placement { position, gradient: Mat3::identity() };
        let velocity = Velocity { velocity: flow.at(&position), gradient_rate: flow.gradient };
        let mut state = State { time, ..State::start(&model, &[Start::Affine(placement, velocity)]) };
        // Modes that have come to rest with the fluid.
        let slots = model.slots(0);
        state.bodies[slots.extra()].fill(0.0);
        let (rates, _) = evaluate(&model, time, &state.bodies);
        let (changing, spreading) = around.rate(time, &position);
        let linear =
            Vec3::from_column_slice(&rates[slots.velocity()]) - (changing + flow.gradient * flow.at(&position));
        let strained = Mat3::from_column_slice(&rates[slots.rate()]) - (spreading + flow.gradient * flow.gradient);
        // A compressible sphere is pressed by the pressure from its centre outward, ⅒ m_f R² tr L∞².
        let pressed = 0.1 * mass.mass * radius * radius * (flow.gradient * flow.gradient).trace();
        let grown = pressed / (1.2 * mass.mass * radius * radius);
        let expected = if incompressible { Mat3::zeros() } else { Mat3::from_diagonal_element(grown) };
        assert!(linear.norm() < 1e-12, "{linear}");
        assert!((strained - expected).norm() < 1e-12, "{strained}");
    }
}

#[test]
fn the_ledger_has_the_entries_of_its_scene() {
    let deformed = model([6.0, 3.0, 3.0, 2.0], AreaMeasure::DeformedArea);
    let works = [Work::Damping, Work::Friction, Work::Viscosity, Work::Load, Work::Support, Work::Constraint];
    let (energies, contact) = ([Energy::Kinetic, Energy::Gravity, Energy::Elastic], [Energy::Contact]);
    let with = |central: &[Work]| [&central[..1], &works[..2], &central[1..], &works[2..]].concat();
    assert_eq!(deformed.works(), with(&[Work::Repulsion, Work::Adhesion]));
    assert_eq!(deformed.energies(), [&energies[..], &[Energy::Load]].concat());
    for measure in [AreaMeasure::ReferenceArea, AreaMeasure::DeformedAreaPotential] {
        let model = model([6.0, 3.0, 3.0, 2.0], measure);
        assert_eq!(model.works(), works);
        assert_eq!(model.energies(), [&energies[..], &contact[..], &[Energy::Load]].concat());
    }
}

#[test]
fn pressure_is_told_of_incompressible_bodies_alone() {
    let model = model([6.0, 3.0, 3.0, 2.0], AreaMeasure::DeformedArea);
    let numbers: Vec<f64> = (0..24).map(|k| (1.7 * f64::from(k)).sin()).collect();
    let state = state(&model, &numbers);
    for index in 0..model.bodies.len() {
        let seen = observe(&model, &mut Workspace::default(), &state, index).unwrap();
        let incompressible = model.bodies[index].affine().unwrap().interior.is_incompressible();
        assert_eq!(seen.pressure.is_some_and(f64::is_finite), incompressible);
    }
}

#[test]
fn the_ledger_closes_for_a_rigid_body_beside_a_soft_one() {
    let [cuboid, ..] = shapes();
    let soft = body(cuboid, Variant { incompressible: true, pinned: false, frame: Frame::Space });
    let inertia = RigidInertia::new(&soft.solid.mass, None).unwrap();
    let hard = Body { kind: BodyKind::Rigid(inertia), ..soft.clone() };
    let model = Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), vec![soft, hard]);
    let model = attached(model, [6.0, 3.0, 3.0, 2.0], AreaMeasure::DeformedArea);
    let position = Vec3::new(0.1, -0.2, 1.4);
    let velocity = Vec3::new(0.3, 0.5, -0.7);
    let (orientation, angular_velocity) = (Quaternion::IDENTITY, Vec3::new(0.4, -0.8, 0.3));
    let starts = [
        Start::Affine(
            Placement { position, gradient: Mat3::identity() },
            Velocity { velocity, gradient_rate: Mat3::new(0.3, 0.1, 0.0, -0.2, 0.4, 0.5, 0.1, 0.0, -0.7) },
        ),
        Start::Rigid(RigidStart { position, orientation, velocity, angular_velocity }),
    ];
    let state = State::start(&model, &starts);
    assert_power_is_the_rate_of_energy(&model, &state);
}
