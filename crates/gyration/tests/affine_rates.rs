//! Relations that the rates of affine bodies obey, whatever the scene: exact Jacobian, power balance, dissipation, objectivity.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use gyration::affine::{AffineBody, Viscosity};
use gyration::balance::{energies, observe};
use gyration::body::{Affine, Body, BodyKind, Pin, RigidInertia};
use gyration::contact::{Adhesion, AreaMeasure, Contact, ContactLaw, Damping, Friction, Repulsion};
use gyration::jacobian::jacobian;
use gyration::kinematics::{Placement, Quaternion, Velocity};
use gyration::ledger::{Energy, Work};
use gyration::load::{Couple, Frame, LinearResistance, Mat12, Spring};
use gyration::material::{Material, MooneyRivlin, NeoHookeanLog};
use gyration::model::Model;
use gyration::rates::{Workspace, rates};
use gyration::shape::{Cuboid, Cylinder, Ellipsoid, Shape, Sphere};
use gyration::state::{RigidStart, Start, State};
use gyration::support::{Support, SupportMotion};
use gyration::tensor::{Mat3, Vec3};
use nalgebra::DMatrix;
use proptest::prelude::*;

const MEASURES: [AreaMeasure; 3] =
    [AreaMeasure::DeformedArea, AreaMeasure::ReferenceArea, AreaMeasure::DeformedAreaPotential];

fn laws(exponents: [f64; 4]) -> Vec<ContactLaw> {
    let [repulsion, damping, friction, adhesion] = exponents;
    vec![
        ContactLaw::Repulsion(Repulsion { alpha: 2.0, exponent: repulsion, reference_gap: 0.3 }),
        ContactLaw::Damping(Damping { beta: 0.7, exponent: damping, reference_gap: 0.4 }),
        ContactLaw::Friction(Friction { beta: 0.9, exponent: friction, reference_gap: 0.2 }),
        ContactLaw::Adhesion(Adhesion {
            beta: 1.3,
            attractive_exponent: adhesion,
            repulsive_exponent: adhesion + 2.5,
            reference_gap: 0.25,
        }),
    ]
}

fn supports() -> Vec<Support> {
    let wobble = SupportMotion::Oscillation { direction: Vec3::z(), amplitude: 0.05, frequency: 0.7, phase: 0.4 };
    vec![
        Support { name: "table".into(), origin: Vec3::zeros(), normal: Vec3::z(), motion: wobble },
        Support {
            name: "slope".into(),
            origin: Vec3::new(-2.0, 0.0, -1.0),
            normal: Vec3::new(0.6, 0.0, 0.8),
            motion: SupportMotion::Velocity(Vec3::new(0.1, -0.2, 0.05)),
        },
    ]
}

/// A friction and a gyroscopic load without any symmetry but that of their kind.
fn resistances(frame: Frame) -> Vec<LinearResistance> {
    let root = Mat12::from_fn(|i, j| 0.2 * (1.3 * i as f64 + 0.7 * (j * j) as f64).sin());
    let skew = root - root.transpose();
    vec![
        LinearResistance::friction(&(root * root.transpose()), frame).unwrap(),
        LinearResistance::gyroscopic(&skew, frame).unwrap(),
    ]
}

/// What bodies differ in.
#[derive(Debug, Clone, Copy)]
struct Variant {
    measure: AreaMeasure,
    incompressible: bool,
    pinned: bool,
    frame: Frame,
}

fn body(shape: Shape, exponents: [f64; 4], variant: Variant) -> Body {
    let mass = shape.mass_properties(0.8);
    let surface = shape.surface().map(|surface| surface.translated(&-mass.center));
    let pin = variant.pinned.then(|| Pin { point: Vec3::new(0.2, -0.1, 0.3), anchor: Vec3::new(0.3, 0.1, 1.4) });
    let spring = Spring {
        point: Vec3::new(0.1, 0.2, -0.3),
        anchor: Vec3::new(1.0, 2.0, 3.0),
        stiffness: 1.7,
        rest_length: 0.6,
        damping: 0.4,
    };
    let material = match variant.incompressible {
        true => Material::MooneyRivlin(MooneyRivlin { c1: 2.0, c2: 1.0, bulk: None }),
        false => Material::NeoHookeanLog(NeoHookeanLog { mu: 3.0, lambda: 2.0 }),
    };
    let viscosity = Viscosity { kirchhoff: 0.3, shear: 0.2, bulk: 0.1 };
    let interior = AffineBody::new(&mass, pin.as_ref().map(|pin| &pin.point), Some(material), viscosity).unwrap();
    let couple = Couple::Constant(Mat3::new(0.1, -0.2, 0.3, 0.0, 0.2, 0.1, -0.3, 0.4, 0.1));
    let affine = Affine { interior, couple: Some(couple), resistances: resistances(variant.frame) };
    Body {
        name: "body".into(),
        kind: BodyKind::Affine(Box::new(affine)),
        size: shape.size(),
        mass,
        shape,
        surface,
        contacts: (0..2).map(|support| Contact::new(support, variant.measure, laws(exponents))).collect(),
        springs: vec![spring, Spring { rest_length: 0.0, damping: 0.0, ..spring }],
        pin,
    }
}

fn shapes() -> [Shape; 4] {
    [
        Shape::Box(Cuboid { size: Vec3::new(0.8, 1.0, 0.6) }),
        Shape::Sphere(Sphere { radius: 0.5 }),
        Shape::Cylinder(Cylinder { radius: 0.4, height: 0.9 }),
        Shape::Ellipsoid(Ellipsoid { semi_axes: Vec3::new(0.5, 0.3, 0.4) }),
    ]
}

/// A box of each variant, and one body of each other shape.
fn model(exponents: [f64; 4], measure: AreaMeasure) -> Model {
    let free = Variant { measure, incompressible: false, pinned: false, frame: Frame::Space };
    let boxes = [
        free,
        Variant { incompressible: true, frame: Frame::Body, ..free },
        Variant { pinned: true, frame: Frame::Body, ..free },
        Variant { incompressible: true, pinned: true, ..free },
    ];
    let [cuboid, round @ ..] = shapes();
    let boxes = boxes.map(|variant| body(cuboid.clone(), exponents, variant));
    let others = round.map(|shape| body(shape, exponents, Variant { incompressible: true, ..free }));
    Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), boxes.into_iter().chain(others).collect())
}

/// A state above both supports for any 24 numbers in [−1, 1]; incompressible bodies on their constraint.
fn state(model: &Model, numbers: &[f64]) -> State {
    let position = Vec3::new(numbers[0], numbers[1], 1.5 + 0.2 * numbers[2]);
    let strain = Mat3::from_column_slice(&numbers[3..12]);
    let rotation = *nalgebra::Rotation3::new(Vec3::new(numbers[3], numbers[7], numbers[11])).matrix();
    let (gradient, rate) = (rotation * (Mat3::identity() + 0.15 * strain), Mat3::from_column_slice(&numbers[15..24]));
    let velocity = Vec3::new(numbers[12], numbers[13], numbers[14]);
    let start = |body: &Body| {
        let corrected = body.affine().unwrap().interior.project(&gradient, &rate);
        Start::Affine(
            Placement { position, gradient: corrected.gradient },
            Velocity { velocity, gradient_rate: corrected.rate },
        )
    };
    let starts: Vec<Start> = model.bodies.iter().map(start).collect();
    State { time: 0.37, ..State::start(model, &starts) }
}

fn evaluate(model: &Model, time: f64, bodies: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (mut slopes, mut powers) = (vec![0.0; bodies.len()], vec![0.0; model.works().len()]);
    rates(model, &mut Workspace::default(), time, bodies, &mut slopes, &mut powers).unwrap();
    (slopes, powers)
}

fn numbers() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.0..1.0_f64, 24)
}

fn exponents() -> impl Strategy<Value = [f64; 4]> {
    prop::array::uniform4(prop_oneof![1.0..7.0_f64, Just(1.0), Just(3.0)])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn jacobian_is_the_derivative_of_the_rates(numbers in numbers(), exponents in exponents()) {
        for measure in MEASURES {
            let model = model(exponents, measure);
            let state = state(&model, &numbers);
            let mut blocks: Vec<_> =
                model.bodies.iter().map(|body| DMatrix::zeros(body.dimension(), body.dimension())).collect();
            jacobian(&model, &mut Workspace::default(), state.time, &state.bodies, &mut blocks).unwrap();
            for (body, (block, range)) in blocks.iter().zip(model.blocks()).enumerate() {
                for column in range.clone() {
                    let step = 1e-5;
                    let shifted = |sign: f64| {
                        let mut bodies = state.bodies.clone();
                        bodies[column] += sign * step;
                        evaluate(&model, state.time, &bodies).0
                    };
                    let (ahead, behind) = (shifted(1.0), shifted(-1.0));
                    for row in range.clone() {
                        let difference = (ahead[row] - behind[row]) / (2.0 * step);
                        let exact = block[(row - range.start, column - range.start)];
                        // Central differences: step² × third derivative, which the powers of the gap make large.
                        let scale = block.column(column - range.start).norm() + 1.0;
                        prop_assert!(
                            (difference - exact).abs() < 1e-6 * scale,
                            "{measure:?}, body {body}, ({row}, {column}): {difference} against {exact}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn power_of_works_is_the_rate_of_energy(numbers in numbers(), exponents in exponents()) {
        for measure in MEASURES {
            let model = model(exponents, measure);
            let state = state(&model, &numbers);
            let (slopes, powers) = evaluate(&model, state.time, &state.bodies);
            let step = 1e-5;
            let at = |sign: f64| {
                let ahead = |(y, dy): (&f64, &f64)| y + sign * step * dy;
                let bodies = state.bodies.iter().zip(&slopes).map(ahead).collect();
                let mut values = vec![0.0; model.energies().len()];
                let ahead = State { time: state.time + sign * step, bodies, works: state.works.clone() };
                energies(&model, &mut Workspace::default(), &ahead, &mut values).unwrap();
                values
            };
            let (before, after) = (at(-1.0), at(1.0));
            let rate = (after.iter().sum::<f64>() - before.iter().sum::<f64>()) / (2.0 * step);
            let power: f64 = powers.iter().sum();
            // As for rigid bodies: differences along the flow, and the rounding of the energies.
            let scale = powers.iter().map(|p| p.abs()).sum::<f64>() + rate.abs() + 1.0;
            let energy: f64 = after.iter().map(|energy| energy.abs()).sum();
            let tolerance = 1e-6 * scale + 32.0 * f64::EPSILON * energy / step;
            prop_assert!((rate - power).abs() < tolerance, "{measure:?}: {rate} W against {power} W");
        }
    }

    #[test]
    fn friction_of_every_kind_dissipates(numbers in numbers(), exponents in exponents()) {
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
    fn turning_everything_about_the_vertical_turns_the_answer(numbers in numbers(), angle in -3.0..3.0_f64) {
        // Friction fixed in space and couples single out directions: without them.
        let shape = Shape::Box(Cuboid { size: Vec3::new(0.8, 1.0, 0.6) });
        let variant = Variant { measure: AreaMeasure::DeformedArea, incompressible: true, pinned: false, frame: Frame::Body };
        let mut soft = body(shape, [6.0, 3.0, 3.0, 2.0], variant);
        soft.springs.clear();
        soft.contacts.truncate(1);
        if let BodyKind::Affine(affine) = &mut soft.kind {
            affine.couple = None;
        }
        let model = Model::new(Vec3::new(0.0, 0.0, -9.81), supports(), vec![soft]);
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
    let variant =
        Variant { measure: AreaMeasure::DeformedArea, incompressible: true, pinned: false, frame: Frame::Space };
    let soft = body(cuboid, [6.0, 3.0, 3.0, 2.0], variant);
    let inertia = RigidInertia::new(&soft.mass, None).unwrap();
    let hard = Body { name: "hard".into(), kind: BodyKind::Rigid(inertia), ..soft.clone() };
    let model = Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), vec![soft, hard]);
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
    let (slopes, powers) = evaluate(&model, 0.0, &state.bodies);
    let energy = |step: f64| {
        let bodies = state.bodies.iter().zip(&slopes).map(|(y, dy)| y + step * dy).collect();
        let mut values = vec![0.0; model.energies().len()];
        let ahead = State { time: step, bodies, works: state.works.clone() };
        energies(&model, &mut Workspace::default(), &ahead, &mut values).unwrap();
        values.iter().sum::<f64>()
    };
    let rate = (energy(1e-5) - energy(-1e-5)) / 2e-5;
    let power: f64 = powers.iter().sum();
    // Central differences and the rounding of the energies, as above.
    assert!((rate - power).abs() < 1e-6 * powers.iter().map(|power| power.abs()).sum::<f64>(), "{rate} {power}");
}
