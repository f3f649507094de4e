//! Blocks of the Jacobian between two bodies: B_i ∂Q_i A_j against differences, for any two kinds.
//!
//! The load is a spring and dashpot between two material points, F = −k (x_i − x_j) − c (ẋ_i − ẋ_j), which no scene
//! has: it is applied to body i by hand, so that the rates of i follow the numbers of j through it.

use crate::moving::{Variant, body, shapes, supports};
use gyration::body::{Body, BodyKind, Contractile, RigidInertia};
use gyration::contact::AreaMeasure;
use gyration::contractile::{Contraction, ContractionSource, Spin};
use gyration::dynamics::{Coupling, Lift, Lower, Workspace, rates};
use gyration::kinematics::{Placement, Quaternion, Velocity};
use gyration::load::{Applied, Frame, Mat12};
use gyration::model::Model;
use gyration::signal::Signal;
use gyration::state::{RigidStart, Start, State};
use gyration::tensor::{Mat3, Vec3};
use nalgebra::DMatrix;

/// The spring between the same material point of two bodies.
const POINT: Vec3 = Vec3::new(0.3, -0.2, 0.4);
const STIFFNESS: f64 = 2.3;
const DAMPING: f64 = 0.7;

/// Rigid, affine and contractile bodies, free and pinned, compressible or not.
fn bodies() -> Vec<Body> {
    let [shape, ..] = shapes();
    let variant = |incompressible, pinned| Variant {
        measure: AreaMeasure::DeformedArea,
        incompressible,
        pinned,
        frame: Frame::Space,
    };
    let mut bodies = Vec::new();
    for pinned in [false, true] {
        for incompressible in [false, true] {
            let soft = body(shape.clone(), [6.0, 5.0, 4.0, 3.0], variant(incompressible, pinned));
            let source = ContractionSource::Driven { drive: Signal::Constant(Mat3::identity()), feedback: Vec::new() };
            for kept_volume in [None, Some(1.0)] {
                let contraction = Contraction { viscosity: 0.8, kept_volume, spin: Spin::Full, source: source.clone() };
                let contractile = Contractile::new(soft.affine().unwrap().clone(), contraction);
                bodies.push(Body { kind: BodyKind::Contractile(Box::new(contractile)), ..soft.clone() });
            }
            let inertia = RigidInertia::new(&soft.solid.mass, soft.pin.as_ref()).unwrap();
            bodies.push(Body { kind: BodyKind::Rigid(inertia), ..soft.clone() });
            bodies.push(soft);
        }
    }
    bodies
}

/// A start that no symmetry makes simple; the constraints hold.
fn start(body: &Body, seed: f64) -> Start {
    let vector = |seed: f64| Vec3::new(seed.sin(), (2.0 * seed).cos(), (3.0 * seed).sin());
    let (position, velocity) = (Vec3::new(0.2, 0.1, 1.6) + 0.1 * vector(seed), vector(seed + 0.4));
    let orientation = Quaternion::from_axis_angle(&vector(seed + 0.8), 0.9 + seed);
    match body.affine() {
        None => RigidStart { position, orientation, velocity, angular_velocity: vector(seed + 1.2) }.into(),
        Some(affine) => {
            let strain = Mat3::from_fn(|i, j| 0.1 * (seed + 1.3 * i as f64 + 0.7 * (j * j) as f64).sin());
            let gradient = orientation.rotation() * (Mat3::identity() + strain);
            let corrected = affine.interior.project(&gradient, &(3.0 * strain));
            let placement = Placement { position, gradient: corrected.gradient };
            let velocity = Velocity { velocity, gradient_rate: corrected.rate };
            Start::Contractile(placement, velocity, Mat3::identity())
        }
    }
}

/// The rates of body i under the spring to body j.
fn rates_under_spring(model: &mut Model, state: &State, (i, j): (usize, usize)) -> Vec<f64> {
    let [one, other] = [i, j].map(|body| state.motion(model, body));
    let stretch = one.placement.place(&POINT) - other.placement.place(&POINT);
    let speed = one.velocity.at(&POINT) - other.velocity.at(&POINT);
    assert!(model.apply(i, Applied::at_point(-STIFFNESS * stretch - DAMPING * speed, &POINT)));
    let (mut slopes, mut powers) = (vec![0.0; model.dimension()], vec![0.0; model.works().len()]);
    rates(model, &mut Workspace::default(), state.time, state.numbers(), &mut slopes, &mut powers).unwrap();
    slopes[model.slots(i).block()].to_vec()
}

/// ∂Q_i/∂q_j = k X̃_i ⊗ X̃_j ⊗ 1, and with c by the rates.
fn spring() -> Coupling {
    let point = [1.0, POINT.x, POINT.y, POINT.z];
    let blocks = |factor: f64| {
        let entry = |row: usize, column: usize| factor * point[row / 3] * point[column / 3];
        Mat12::from_fn(|row, column| if row % 3 == column % 3 { entry(row, column) } else { 0.0 })
    };
    Coupling { by_place: blocks(STIFFNESS), by_rate: blocks(DAMPING) }
}

#[test]
fn the_block_of_two_bodies_is_the_derivative_of_the_rates_of_one_by_the_numbers_of_the_other() {
    let mut model = Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), bodies()).under_control();
    let starts: Vec<Start> = model.bodies.iter().enumerate().map(|(k, body)| start(body, 0.1 * k as f64)).collect();
    let state = State::start(&model, &starts);
    let mut workspace = Workspace::default();
    let (instant, _) = workspace.read(&model, &state).unwrap();
    let maps: Vec<(Lower, Lift)> = (0..model.bodies.len())
        .map(|index| (Lower::of(&instant.at(&model, index)), Lift::of(&instant.at(&model, index))))
        .collect();
    for i in 0..maps.len() {
        for j in (0..maps.len()).filter(|j| *j != i) {
            let columns = model.slots(j).block();
            let mut block = DMatrix::zeros(model.slots(i).block().len(), columns.len());
            spring().add_to(&mut block, &maps[i].0, &maps[j].1);
            let largest = block.amax();
            assert!(largest > 0.0);
            for (column, place) in columns.enumerate() {
                let step = 1e-5;
                let mut shifted = |shift: f64| {
                    let mut moved = state.clone();
                    moved.bodies[place] += shift;
                    rates_under_spring(&mut model, &moved, (i, j))
                };
                let (ahead, behind) = (shifted(step), shifted(-step));
                for (row, (ahead, behind)) in ahead.iter().zip(&behind).enumerate() {
                    let difference = (ahead - behind) / (2.0 * step);
                    // step² of the third derivatives, and the rounding of rates of some 1e3 over the step.
                    let error = (difference - block[(row, column)]).abs();
                    assert!(error < 1e-6 * largest.max(1.0), "({i}, {j}) at ({row}, {column}): {error:e}");
                }
            }
        }
    }
}
