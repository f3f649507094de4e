//! Relations that the rates of rigid bodies obey, whatever the scene: exact Jacobian, power balance, dissipation.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use gyration::balance::{energies, kinetic_energy, observe};
use gyration::body::{Body, BodyKind, Pin, RigidInertia};
use gyration::contact::{Adhesion, AreaMeasure, Contact, ContactLaw, Damping, Friction, Repulsion};
use gyration::jacobian::jacobian;
use gyration::kinematics::Quaternion;
use gyration::ledger::{Energy, Work};
use gyration::load::Spring;
use gyration::model::Model;
use gyration::rates::{Workspace, rates};
use gyration::shape::{Cuboid, Cylinder, Ellipsoid, Shape, Sphere};
use gyration::state::{RigidStart, State, Turn};
use gyration::support::{Support, SupportMotion};
use gyration::tensor::Vec3;
use nalgebra::DMatrix;
use proptest::prelude::*;

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

fn body(shape: Shape, exponents: [f64; 4], pinned: bool) -> Body {
    let mass = shape.mass_properties(0.8);
    let surface = shape.surface().map(|surface| surface.translated(&-mass.center));
    let pin = pinned.then(|| Pin { point: Vec3::new(0.2, -0.1, 0.3), anchor: Vec3::new(0.3, 0.1, 1.4) });
    let spring = Spring {
        point: Vec3::new(0.1, 0.2, -0.3),
        anchor: Vec3::new(1.0, 2.0, 3.0),
        stiffness: 1.7,
        rest_length: 0.6,
        damping: 0.4,
    };
    Body {
        name: "body".into(),
        kind: BodyKind::Rigid(RigidInertia::new(&mass, pin.as_ref()).unwrap()),
        size: shape.size(),
        mass,
        shape,
        surface,
        contacts: (0..2).map(|support| Contact::new(support, AreaMeasure::default(), laws(exponents))).collect(),
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

/// One body of each shape, free and pinned.
fn model(exponents: [f64; 4]) -> Model {
    let bodies =
        shapes().into_iter().flat_map(|shape| [false, true].map(|pinned| body(shape.clone(), exponents, pinned)));
    Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), bodies.collect())
}

/// A state above both supports for any ten numbers in [−1, 1].
fn state(model: &Model, numbers: &[f64; 10]) -> State {
    let start = RigidStart {
        position: Vec3::new(numbers[0], numbers[1], 1.3 + 0.2 * numbers[2]),
        orientation: Quaternion::from_axis_angle(&Vec3::new(1.0, numbers[3], 0.5), 3.0 * numbers[4]),
        velocity: Vec3::new(numbers[5], numbers[6], numbers[7]),
        angular_velocity: Vec3::new(2.0 * numbers[8], 1.0 - numbers[9], 3.0 * numbers[9]),
    };
    let mut state = State::start(model, &vec![start.into(); model.bodies.len()]);
    state.time = 0.37;
    state
}

fn evaluate(model: &Model, time: f64, bodies: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (mut slopes, mut powers) = (vec![0.0; bodies.len()], vec![0.0; model.works().len()]);
    rates(model, &mut Workspace::default(), time, bodies, &mut slopes, &mut powers).unwrap();
    (slopes, powers)
}

fn strategy() -> impl Strategy<Value = ([f64; 10], [f64; 4])> {
    (prop::array::uniform10(-1.0..1.0_f64), prop::array::uniform4(1.0..7.0_f64))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn jacobian_is_the_derivative_of_the_rates((numbers, exponents) in strategy()) {
        let model = model(exponents);
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
                        "body {body}, ({row}, {column}): {difference} against {exact}"
                    );
                }
            }
        }
    }

    #[test]
    fn power_of_works_is_the_rate_of_energy((numbers, exponents) in strategy()) {
        let model = model(exponents);
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
        // Central differences along the flow, as above, and the rounding of the energies: the potential of a repulsion
        // with ν close to 1 is large, α d₀/(ν − 1), and hardly changes.
        let scale = powers.iter().map(|p| p.abs()).sum::<f64>() + rate.abs() + 1.0;
        let energy: f64 = after.iter().map(|energy| energy.abs()).sum();
        let tolerance = 1e-6 * scale + 32.0 * f64::EPSILON * energy / step;
        prop_assert!((rate - power).abs() < tolerance, "{rate} W against {power} W");
    }

    #[test]
    fn damping_friction_and_dashpots_dissipate((numbers, exponents) in strategy()) {
        let model = model(exponents);
        let state = state(&model, &numbers);
        let (_, powers) = evaluate(&model, state.time, &state.bodies);
        for (work, power) in model.works().iter().zip(powers) {
            if *work != Work::Support {
                prop_assert!(power <= 0.0, "{} does {power} W", work.name());
            }
        }
    }
}

#[test]
fn the_ledger_has_the_entries_of_its_scene() {
    let model = model([6.0, 3.0, 3.0, 2.0]);
    assert_eq!(model.works(), [Work::Damping, Work::Friction, Work::Load, Work::Support]);
    assert_eq!(model.energies(), [Energy::Kinetic, Energy::Gravity, Energy::Contact, Energy::Load]);
}

#[test]
fn kinetic_energy_and_spin_agree_with_the_inertia_tensor() {
    let model = model([6.0, 3.0, 3.0, 2.0]);
    let state = state(&model, &[0.1, -0.3, 0.2, 0.5, 0.3, 0.7, -0.4, 0.2, 0.6, -0.1]);
    for index in 0..model.bodies.len() {
        let body = &model.bodies[index];
        let seen = observe(&model, &mut Workspace::default(), &state, index).unwrap();
        let motion = seen.motion;
        let turn = Turn::unpack(body, &state.bodies[model.blocks()[index].clone()]);
        let spin_momentum = motion.placement.gradient * body.mass.inertia() * turn.spin;
        let velocity = motion.velocity.velocity;
        let expected = 0.5 * (body.mass.mass * velocity.norm_squared() + spin_momentum.dot(&motion.angular_velocity()));
        assert!((kinetic_energy(body, &motion) - expected).abs() < 1e-14 * expected);
        let orbital = motion.placement.position.cross(&seen.linear_momentum);
        assert!((seen.angular_momentum - orbital - spin_momentum).norm() < 1e-14 * seen.angular_momentum.norm());
    }
}

#[test]
fn the_length_of_the_quaternion_does_not_matter() {
    let model = model([5.5, 3.0, 2.5, 1.5]);
    let state = state(&model, &[0.1, -0.3, 0.2, 0.5, 0.3, 0.7, -0.4, 0.2, 0.6, -0.1]);
    let (slopes, _) = evaluate(&model, state.time, &state.bodies);
    let mut longer = state.bodies.clone();
    longer[3..7].iter_mut().for_each(|c| *c *= 1.5);
    let (other, _) = evaluate(&model, state.time, &longer);
    for number in (0..3).chain(7..13) {
        assert!((slopes[number] - other[number]).abs() < 1e-12 * (1.0 + slopes[number].abs()));
    }
}
