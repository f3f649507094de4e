//! Springs between bodies of any two kinds, and bodies that meet, with inertia and without: blocks of the Jacobian B_i
//! ∂Q_i A_j against differences, action and reaction, and the balance of power.

use crate::moving::*;
use gyration::body::{Body, BodyKind, Contractile, RigidInertia};
use gyration::contact::AreaMeasure;
use gyration::contractile::{Contraction, ContractionSource, Spin};
use gyration::dynamics::{Blocks, Workspace, jacobian};
use gyration::kinematics::{Placement, Quaternion, Velocity};
use gyration::load::{Frame, Spring, SpringLaw};
use gyration::model::Model;
use gyration::neighbours::PairRule;
use gyration::pair::PairLaws;
use gyration::shape::{Shape, Sphere};
use gyration::signal::Signal;
use gyration::state::{BodyMotion, RigidStart, Start, State};
use gyration::tensor::{Mat3, Vec3};
use nalgebra::DMatrix;
use std::ops::Range;
use std::sync::Arc;

/// With a direction, and without.
pub const DIRECTED: SpringLaw = SpringLaw { stiffness: 2.3, rest_length: 0.4, damping: 0.7 };
const PLAIN: SpringLaw = SpringLaw { stiffness: 1.9, rest_length: 0.0, damping: 0.0 };

/// Rigid, affine and contractile bodies, free and pinned, compressible or not.
pub fn bodies() -> Vec<Body> {
    let [shape, ..] = shapes();
    bodies_of(&shape)
}

pub fn bodies_of(shape: &Shape) -> Vec<Body> {
    let variant = |incompressible, pinned| Variant { incompressible, pinned, frame: Frame::Space };
    let mut bodies = Vec::new();
    for pinned in [false, true] {
        for incompressible in [false, true] {
            let soft = body(shape.clone(), variant(incompressible, pinned));
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

fn vector(seed: f64) -> Vec3 {
    Vec3::new(seed.sin(), (2.0 * seed).cos(), (3.0 * seed).sin())
}

/// How a body starts to be turned, before it is strained.
pub fn orientation(seed: f64) -> Quaternion {
    Quaternion::from_axis_angle(&vector(seed + 0.8), 0.9 + seed)
}

/// A start that no symmetry makes simple; the constraints hold.
fn start(body: &Body, seed: f64, place: Vec3) -> Start {
    let (position, velocity) = (place + 0.1 * vector(seed), vector(seed + 0.4));
    let orientation = orientation(seed);
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

/// A ring of springs, and two more between bodies that it does not join.
fn ring(bodies: usize, laws: [SpringLaw; 2]) -> Vec<Spring> {
    let spring = |k: usize, one: usize, other: usize| {
        let seed = k as f64;
        let point = |seed: f64| 0.4 * Vec3::new(seed.sin(), (2.0 * seed).cos(), (3.0 * seed).sin());
        Spring::between([one, other], [point(seed + 0.3), point(seed + 1.1)], laws[k % 2])
    };
    let mut ring: Vec<Spring> = (0..bodies).map(|k| spring(k, k, (k + 1) % bodies)).collect();
    ring.extend([spring(bodies, 2, 0), spring(bodies + 1, 0, 2)]);
    ring
}

/// The model on supports and anchors, whose bodies are joined by such springs too.
pub fn joined(model: Model, laws: [SpringLaw; 2]) -> Model {
    let model = attached(model, [6.0, 5.0, 4.0, 3.0], AreaMeasure::DeformedArea);
    let springs = model.springs().iter().cloned().chain(ring(model.bodies.len(), laws)).collect();
    model.with_springs(springs)
}

pub fn state(model: &Model) -> State {
    state_at(model, |_| Vec3::new(0.2, 0.1, 1.6))
}

pub fn state_at(model: &Model, place: impl Fn(usize) -> Vec3) -> State {
    let start = |(k, body): (usize, &Arc<Body>)| start(body, 0.1 * k as f64, place(k));
    let starts: Vec<Start> = model.bodies.iter().enumerate().map(start).collect();
    State::start(model, &starts)
}

/// All blocks, in rows, and the pairs of which they are said to be.
struct Whole(Vec<Vec<DMatrix<f64>>>, Vec<(usize, usize)>);

impl Blocks for Whole {
    fn arrange(&mut self, pairs: &mut dyn Iterator<Item = (usize, usize)>) {
        self.1.extend(pairs);
    }

    fn block(&mut self, row: usize, column: usize) -> Option<&mut DMatrix<f64>> {
        self.0.get_mut(row)?.get_mut(column)
    }
}

/// Fails where a block is not the derivative of the rates, whatever bodies it is of.
pub fn assert_blocks_are_derivatives(model: &Model, state: &State) {
    let blocks = model.blocks();
    let zeros = |row: &Range<usize>| blocks.iter().map(|column| DMatrix::zeros(row.len(), column.len())).collect();
    let mut whole = Whole(blocks.iter().map(zeros).collect(), Vec::new());
    jacobian(model, &mut Workspace::default(), state.time, state.numbers(), &mut whole).unwrap();
    for (j, columns) in blocks.iter().enumerate() {
        for (column, place) in columns.clone().enumerate() {
            let step = 1e-5;
            let shifted = |shift: f64| {
                let mut moved = state.bodies.clone();
                moved[place] += shift;
                evaluate(model, state.time, &moved).0
            };
            let (ahead, behind) = (shifted(step), shifted(-step));
            for (i, rows) in blocks.iter().enumerate() {
                let block = &whole.0[i][j];
                for (row, at) in rows.clone().enumerate() {
                    let difference = (ahead[at] - behind[at]) / (2.0 * step);
                    // step² of the third derivatives, and the rounding of rates of some 1e3 over the step.
                    let error = (difference - block[(row, column)]).abs();
                    let scale = block.column(column).norm() + 1.0;
                    assert!(error < 1e-6 * scale, "({i}, {j}) at ({row}, {column}): {error:e} of {scale:e}");
                }
            }
        }
    }
    for (i, j) in (0..blocks.len()).flat_map(|i| (0..blocks.len()).map(move |j| (i, j))) {
        assert!(i == j || whole.1.contains(&(i, j)) == (whole.0[i][j].amax() > 0.0), "({i}, {j})");
    }
}

#[test]
fn blocks_between_joined_bodies_are_derivatives_of_the_rates() {
    let model = joined(Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), bodies()), [DIRECTED, PLAIN]);
    let state = state(&model);
    assert_blocks_are_derivatives(&model, &state);
    assert_power_is_the_rate_of_energy(&model, &state);
}

#[test]
fn blocks_of_joined_spheres_that_the_fluid_remembers_are_derivatives_of_the_rates() {
    let [_, sphere, ..] = shapes();
    let soft = body(sphere, Variant { incompressible: false, pinned: false, frame: Frame::Space });
    let inertia = RigidInertia::new(&soft.solid.mass, None).unwrap();
    let rigid = Body { kind: BodyKind::Rigid(inertia), ..soft.clone() };
    for (bodies, strains) in [(vec![rigid.clone(); 4], false), (vec![rigid.clone(), soft.clone(), soft, rigid], true)] {
        let model = with_history(Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), bodies), strains);
        assert!(model.bodies.len() == 4 && model.bodies.iter().all(|body| body.history().is_some()));
        let model = joined(model, [DIRECTED, PLAIN]);
        let mut state = state(&model);
        shake_modes(&model, &mut state);
        assert_blocks_are_derivatives(&model, &state);
        assert_power_is_the_rate_of_energy(&model, &state);
    }
}

#[test]
fn blocks_of_joined_bodies_without_inertia_are_derivatives_of_the_rates() {
    let free: Vec<Body> = bodies().into_iter().filter(|body| body.pin.is_none()).collect();
    let model = immersed(Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), free), false);
    // Every third has inertia.
    let mut bodies = model.bodies.clone();
    for body in bodies.iter_mut().step_by(3) {
        Arc::make_mut(body).inclusion.as_mut().unwrap().inertia = true;
    }
    let model = joined(model.with_bodies(bodies), [DIRECTED, PLAIN]);
    let state = state(&model);
    assert_blocks_are_derivatives(&model, &state);
    assert_power_is_the_rate_of_energy(&model, &state);
}

/// Balls of every kind in a row that nearly touch, in a fluid; every third has inertia.
#[test]
fn blocks_of_meeting_bodies_without_inertia_are_derivatives_of_the_rates() {
    let balls = bodies_of(&Shape::Sphere(Sphere { radius: 0.3 }));
    let free: Vec<Body> = balls.into_iter().filter(|body| body.pin.is_none()).collect();
    let count = free.len();
    let model = immersed(Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), free), false);
    let mut bodies = model.bodies.clone();
    for body in bodies.iter_mut().step_by(3) {
        Arc::make_mut(body).inclusion.as_mut().unwrap().inertia = true;
    }
    let [repulsion, damping, friction, _] = laws([5.0, 4.0, 3.0, 2.0]).try_into().unwrap();
    let bound = bounded_law(friction, 0.2);
    for (measure, friction) in [
        (AreaMeasure::DeformedArea, friction),
        (AreaMeasure::DeformedArea, bound),
        (AreaMeasure::DeformedAreaPotential, bound),
    ] {
        let laws = Arc::new(PairLaws::new(measure, vec![repulsion, damping, friction]).unwrap());
        let all: Arc<[usize]> = (0..count).collect();
        let rule = PairRule { bodies: [all.clone(), all], supports: Arc::from([]), laws, reach: None };
        let model = model.clone().with_bodies(bodies.clone()).meeting(vec![rule]);
        let state = state_at(&model, |k| Vec3::new(0.8 * k as f64, 0.0, 0.0));
        assert_blocks_are_derivatives(&model, &state);
        assert_power_is_the_rate_of_energy(&model, &state);
    }
}

#[test]
fn what_a_spring_does_to_one_body_it_undoes_to_the_other() {
    let count = bodies().len();
    let model = Model::new(Vec3::zeros(), supports(), bodies()).with_springs(ring(count, [DIRECTED, PLAIN]));
    let state = state(&model);
    let motions: Vec<BodyMotion> = (0..count).map(|body| state.motion(&model, body)).collect();
    let mut sums = vec![(Vec3::zeros(), Vec3::zeros()); model.springs().len()];
    for (body, own) in motions.iter().enumerate() {
        for end in model.springs_of(body) {
            let force = end.loads(&end.interaction.loads(&model.lattice, 0.0, |body| &motions[body]).unwrap()).force;
            assert!(force.norm() > 1e-3);
            sums[end.number].0 += force;
            sums[end.number].1 += own.placement.place(&end.point()).cross(&force);
        }
    }
    for (force, torque) in sums {
        // The forces to the last digit, their moments about the origin as the rounding of products lets them.
        assert!(force == Vec3::zeros() && torque.norm() < 1e-14, "{force} {torque}");
    }
}

#[test]
fn a_part_of_a_model_has_the_springs_between_its_bodies() {
    let count = bodies().len();
    let anchored = attached(Model::new(Vec3::zeros(), supports(), bodies()), [6.0; 4], AreaMeasure::default());
    let springs = anchored.springs().iter().cloned().chain(ring(count, [DIRECTED, PLAIN])).collect();
    let model = anchored.with_springs(springs);
    let part = model.part(&[0, 2, 3, 7]);
    let kept: Vec<[usize; 2]> = part.joined().collect();
    // 2 and 3 of the ring, and the two more.
    assert_eq!(kept, [[1, 2], [1, 0], [0, 1]]);
    assert!(part.is_joined(0) && !part.is_joined(3));
    // Two contacts and two anchors each.
    assert_eq!((part.contacts().len(), part.springs().len()), (8, 8 + 3));
    assert!((0..4).all(|body| part.contacts_of(body).all(|contact| contact.body == body)));
}
