//! Joints of bodies of every kind: equations that hold, derivatives, power, momenta, states put back, dependence.

use crate::between::{DIRECTED, assert_blocks_are_derivatives, bodies, joined, state};
use crate::moving::*;
use gyration::body::{Body, BodyKind, RigidInertia};
use gyration::dynamics::{Held, Workspace, acting};
use gyration::joint::{ANGLE_NAMES, Drive, Joint, JointKind, Motor, Stop, StopLaw, WAY_NAMES, frame_about};
use gyration::kinematics::{Placement, Quaternion};
use gyration::load::{Frame, Interaction, Party, SpringLaw};
use gyration::model::Model;
use gyration::state::{RigidStart, Start, State};
use gyration::support::{MotionPart, SupportMotion};
use gyration::tensor::{Mat3, Vec3, axial};
use gyration_expression::Expression;
use std::sync::Arc;

const KINDS: [JointKind; 5] =
    [JointKind::Ball, JointKind::Hinge, JointKind::Distance, JointKind::Slider, JointKind::Weld];
const PLAIN: SpringLaw = SpringLaw { stiffness: 1.9, rest_length: 0.0, damping: 0.0 };

fn vector(seed: f64) -> Vec3 {
    Vec3::new(seed.sin(), (2.0 * seed).cos(), (3.0 * seed).sin())
}

/// A joint without any symmetry.
fn joint(kind: JointKind, parties: [Party; 2], seed: f64) -> Joint {
    let points = [seed + 0.3, seed + 1.1].map(|seed| 0.4 * vector(seed));
    let frames = [seed + 0.7, seed + 1.9].map(|seed| frame_about(&vector(seed)));
    Joint::new(("joint", kind), parties, points, frames, 0.7)
}

/// How places of space are carried: two turns and a swing.
fn carriage() -> Arc<SupportMotion> {
    let turn = |axis: Vec3, point, rate| MotionPart::Rotation { axis: axis.normalize(), point, rate };
    let swing = MotionPart::Oscillation { direction: Vec3::z(), amplitude: 0.2, frequency: 0.5, phase: 0.3 };
    let turns = [turn(Vec3::new(0.2, 1.0, 0.3), Vec3::x(), 0.7), turn(Vec3::z(), Vec3::zeros(), -0.4)];
    Arc::new(SupportMotion::new(turns.into_iter().chain([swing]).collect()))
}

/// A row of bodies, each joined to the next, the first to a place that is carried; those that deform by balls and
/// distances, of which all kinds of bodies have them.
fn row(bodies: &[Body]) -> Vec<Joint> {
    let deforms = |body: usize| bodies[body].affine().is_some();
    let next = |k: usize| {
        let kind = if deforms(k) || deforms(k + 1) { KINDS[k % 3] } else { KINDS[k % 5] };
        joint(kind, [Party::Body(k), Party::Body(k + 1)], k as f64)
    };
    let to_space = joint(JointKind::Ball, [Party::Body(0), Party::Space], 0.4).carried(carriage());
    std::iter::once(to_space).chain((0..bodies.len() - 1).map(next)).collect()
}

fn rigid_bodies(count: usize) -> Vec<Body> {
    let [shape, ..] = shapes();
    let soft = body(shape, Variant { incompressible: false, pinned: false, frame: Frame::Space });
    let inertia = RigidInertia::new(&soft.solid.mass, None).unwrap();
    vec![Body { kind: BodyKind::Rigid(inertia), ..soft }; count]
}

/// The state with places and velocities as joints have them.
fn held(model: &Model, mut state: State) -> State {
    let mut workspace = Workspace::default();
    let mut held = Held { time: state.time, high: &mut state.bodies, low: &mut [] };
    for _ in 0..20 {
        workspace.hold_places(model, &mut held).unwrap();
    }
    workspace.hold_velocities(model, &mut held).unwrap();
    state
}

#[test]
fn blocks_of_joined_bodies_of_every_kind_are_derivatives_of_the_rates() {
    let all = bodies();
    let joints = row(&all);
    let model = joined(Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), all), [DIRECTED, PLAIN]);
    let model = model.with_joints(joints);
    let state = state(&model);
    assert_eq!(Workspace::default().dependent_joint(&model, state.time, state.numbers()).unwrap(), None);
    assert_blocks_are_derivatives(&model, &state);
    assert_power_is_the_rate_of_energy(&model, &state);
}

#[test]
fn blocks_of_rigid_bodies_under_every_joint_are_derivatives_of_the_rates() {
    let all = rigid_bodies(6);
    let hinge = joint(JointKind::Hinge, [Party::Body(5), Party::Space], 2.3).carried(carriage());
    let joints = row(&all).into_iter().chain([hinge]).collect();
    let model = attached(
        Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), all),
        [6.0, 5.0, 4.0, 3.0],
        gyration::contact::AreaMeasure::ReferenceArea,
    );
    let model = model.with_joints(joints);
    let state = state(&model);
    assert_blocks_are_derivatives(&model, &state);
    assert_power_is_the_rate_of_energy(&model, &state);
}

/// The same row, at points and in directions in which a state has the bodies.
fn row_at(model: &Model, state: &State) -> Vec<Joint> {
    let place = |party: Party| {
        let space = Placement { position: Vec3::zeros(), gradient: Mat3::identity() };
        party.body().map_or(space, |body| state.motion(model, body).placement)
    };
    let bodies: Vec<Body> = model.bodies.iter().map(|body| (**body).clone()).collect();
    let at = |joint: Joint| {
        let parties = joint.parties();
        let [one, other] = parties.map(place);
        let [x, y] = [one.place(&joint.points[0]), other.place(&Vec3::zeros())];
        let inverse = other.gradient.try_inverse().unwrap();
        let apart = if joint.kind == JointKind::Distance { Vec3::new(0.3, 0.2, -0.4) } else { Vec3::zeros() };
        let frame = frame_about(&vector(0.6));
        let frames = [one.gradient.try_inverse().unwrap() * frame, inverse * frame];
        let mut points = [joint.points[0], inverse * (x - y + apart)];
        if parties[1].body().is_none() {
            points[1] = joint.anchor.motion.carriage(state.time).start_of(&points[1]);
        }
        let motion = joint.anchor.motion.clone();
        Joint::new(("joint", joint.kind), parties, points, frames, apart.norm()).carried(motion)
    };
    row(&bodies).into_iter().map(at).collect()
}

/// The motor of every hinge and slider: a drive that feels place and rate, and stops with damping.
fn motor(kind: JointKind) -> Motor {
    let names = if kind == JointKind::Hinge { ANGLE_NAMES } else { WAY_NAMES };
    let text = format!("0.7*sin(3*t) - 1.3*{0}*rate + 0.4*{0}^2", names[0]);
    let drive = Expression::parse(&text, &names, &[]).unwrap();
    let law = |coefficient: f64, exponent: f64| StopLaw { coefficient, exponent, reference: 0.8 };
    let stop = Stop { limits: [-3.5, 3.7], repulsion: law(0.9, 3.0), damping: Some(law(0.4, 2.0)) };
    Motor { drive: Some(Drive::Feedback(Arc::new(drive))), stop: Some(stop) }
}

#[test]
fn blocks_of_rigid_bodies_with_motors_are_derivatives_of_the_rates() {
    for is_reversed in [false, true] {
        let all = rigid_bodies(6);
        let driven = |joint: Joint| match joint.kind {
            JointKind::Hinge | JointKind::Slider => {
                let joint = if is_reversed { joint.reversed() } else { joint };
                let motor = motor(joint.kind);
                joint.driven(motor)
            }
            JointKind::Ball | JointKind::Weld | JointKind::Distance => joint,
        };
        let joints: Vec<Joint> = row(&all).into_iter().map(driven).collect();
        assert_eq!(joints.iter().filter(|joint| joint.motor.acts()).count(), 2);
        let model = Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), all).with_joints(joints);
        let state = State { time: 0.3, ..state(&model) };
        assert_blocks_are_derivatives(&model, &state);
        assert_power_is_the_rate_of_energy(&model, &state);
    }
}

#[test]
fn joints_keep_their_equations_along_the_flow() {
    let model = Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), bodies());
    let start = state(&model);
    let joints = row_at(&model, &start);
    let model = model.with_joints(joints);
    let state = held(&model, State { works: vec![0.0; model.works().len()], ..start });
    let mut workspace = Workspace::default();
    let misfits = workspace.joint_misfits(&model, &state).unwrap();
    assert!(misfits.iter().all(|misfit| misfit.place.max(misfit.turn) < 1e-14), "{misfits:?}");
    assert!(misfits.iter().all(|misfit| misfit.velocity.max(misfit.spin) < 1e-13), "{misfits:?}");
    let (rates, _) = evaluate(&model, state.time, &state.bodies);
    // Ċ along a step is of its second order, C of its third.
    let step = 1e-6;
    let bodies = state.bodies.iter().zip(&rates).map(|(y, dy)| y + step * dy).collect();
    let ahead = State { time: state.time + step, bodies, ..state };
    let misfits = workspace.joint_misfits(&model, &ahead).unwrap();
    let size = rates.iter().fold(1.0, |most: f64, rate| most.max(rate.abs()));
    let most = 10.0 * step * step * size * size;
    assert!(misfits.iter().all(|misfit| misfit.velocity.max(misfit.spin) < most), "{size}: {misfits:?}");
}

#[test]
fn forces_of_joints_are_opposite_and_do_no_work() {
    let all = rigid_bodies(6);
    let joints = row(&all).split_off(1);
    let model = Model::new(Vec3::zeros(), supports(), all).with_joints(joints);
    let state = held(&model, state(&model));
    let mut workspace = Workspace::default();
    let (instant, scratch) = workspace.read(&model, &state).unwrap();
    let (mut force, mut torque, mut power, mut size) = (Vec3::zeros(), Vec3::zeros(), 0.0, 0.0);
    for index in 0..model.bodies.len() {
        let at = instant.at(index);
        let loads = acting(&at, scratch).unwrap().total;
        let (placement, velocity) = (&at.motion.placement, &at.motion.velocity);
        force += loads.force;
        torque += placement.position.cross(&loads.force) + axial(&(loads.moment * placement.gradient.transpose()));
        power += loads.power(&velocity.velocity, &velocity.gradient_rate);
        size += loads.force.norm();
    }
    assert!(size > 1e-3, "{size}");
    // The rounding of some dozen products.
    assert!(force.norm() < 1e-14 * size && torque.norm() < 1e-13 * size && power.abs() < 1e-12 * size);
}

#[test]
fn held_velocities_keep_the_momentum_of_an_isolated_linkage() {
    let all = rigid_bodies(6);
    let joints = row(&all).split_off(1);
    let model = Model::new(Vec3::zeros(), supports(), all).with_joints(joints);
    let mut free = state(&model);
    let mut workspace = Workspace::default();
    let mut both = Held { time: 0.0, high: &mut free.bodies, low: &mut [] };
    for _ in 0..20 {
        workspace.hold_places(&model, &mut both).unwrap();
    }
    let momenta = |state: &State| {
        let sum = |index: usize| {
            let (body, motion) = (&model.bodies[index], state.motion(&model, index));
            let linear = body.solid.mass.mass * motion.velocity.velocity;
            let euler = motion.placement.gradient * body.solid.mass.euler_tensor;
            let own = axial(&(euler * motion.velocity.gradient_rate.transpose()));
            (linear, motion.placement.position.cross(&linear) - own)
        };
        (0..model.bodies.len()).map(sum).fold((Vec3::zeros(), Vec3::zeros()), |a, b| (a.0 + b.0, a.1 + b.1))
    };
    let before = momenta(&free);
    let after = momenta(&held(&model, free.clone()));
    assert!(before.0.norm() > 0.1 && held(&model, free.clone()) != free);
    assert!((before.0 - after.0).norm() < 1e-13 && (before.1 - after.1).norm() < 1e-13);
    // What is held is held already.
    let once = held(&model, free);
    assert_eq!(held(&model, once.clone()), once);
}

/// Crank, coupler and rocker in a plane, with these joints.
fn four_bar(kinds: [JointKind; 4]) -> (Model, State) {
    let points = [Vec3::zeros(), Vec3::new(0.0, 0.0, 1.0), Vec3::new(3.0, 0.0, 2.0), Vec3::new(3.0, 0.0, 0.0)];
    let center = |k: usize| 0.5 * (points[k] + points[k + 1]);
    let starts: Vec<Start> = (0..3)
        .map(|k| {
            Start::Rigid(RigidStart {
                position: center(k),
                orientation: Quaternion::IDENTITY,
                velocity: Vec3::zeros(),
                angular_velocity: Vec3::zeros(),
            })
        })
        .collect();
    let frames = [frame_about(&Vec3::y()); 2];
    let joint = |k: usize| {
        let (parties, points) = match k {
            0 => ([Party::Body(0), Party::Space], [points[0] - center(0), points[0]]),
            3 => ([Party::Body(2), Party::Space], [points[3] - center(2), points[3]]),
            _ => ([Party::Body(k - 1), Party::Body(k)], [points[k] - center(k - 1), points[k] - center(k)]),
        };
        Joint::new(("joint", kinds[k]), parties, points, frames, 1.0)
    };
    let model = Model::new(Vec3::zeros(), supports(), rigid_bodies(3)).with_joints((0..4).map(joint).collect());
    let state = State::start(&model, &starts);
    (model, state)
}

#[test]
fn over_determined_joint_of_a_loop_is_found() {
    let (model, state) = four_bar([JointKind::Hinge; 4]);
    let found = Workspace::default().dependent_joint(&model, state.time, state.numbers()).unwrap().unwrap();
    assert_eq!((found.joint, found.dependent), (3, 3));
    let (model, state) = four_bar([JointKind::Hinge, JointKind::Ball, JointKind::Ball, JointKind::Hinge]);
    assert_eq!(Workspace::default().dependent_joint(&model, state.time, state.numbers()).unwrap(), None);
}

#[test]
fn parts_of_a_model_have_the_joints_between_their_bodies() {
    let all = rigid_bodies(6);
    let model = Model::new(Vec3::zeros(), supports(), all.clone()).with_joints(row(&all));
    let part = model.part(&[0, 1, 4]);
    assert_eq!(part.joints().len(), 2);
    assert!(part.is_joined(1) && !part.is_joined(2) && model.joined().count() == 5);
    assert_eq!(part.joint_graph().unwrap().bodies, [0, 1]);
}

#[test]
fn frames_of_a_hinge_tell_its_angle() {
    use gyration::dynamics::observe_joint;
    let all = rigid_bodies(1);
    for is_reversed in [false, true] {
        let axis = Vec3::new(0.3, 0.4, -0.5);
        let frame = frame_about(&axis);
        let hinge =
            Joint::new(("a", JointKind::Hinge), [Party::Body(0), Party::Space], [Vec3::zeros(); 2], [frame; 2], 0.0);
        let hinge = if is_reversed { hinge.reversed() } else { hinge };
        let model = Model::new(Vec3::new(0.0, 0.0, -9.0), supports(), all.clone()).with_joints(vec![hinge]);
        let start = RigidStart {
            position: Vec3::zeros(),
            orientation: Quaternion::from_axis_angle(&axis, 0.7),
            velocity: Vec3::zeros(),
            angular_velocity: Vec3::zeros(),
        };
        let state = State::start(&model, &[start.into()]);
        let mut workspace = Workspace::default();
        let (instant, scratch) = workspace.read(&model, &state).unwrap();
        let seen = observe_joint(&instant, scratch, 0);
        // Of the second beside the first; the force that carries the body, on the first that the scene names.
        let sign = if is_reversed { 1.0 } else { -1.0 };
        assert!((seen.angle.unwrap() - sign * 0.7).abs() < 1e-15 && seen.misfit < 1e-15);
        let weight = 9.0 * all[0].solid.mass.mass;
        assert!((seen.force + Vec3::new(0.0, 0.0, sign * weight)).norm() < 1e-13 * weight);
        assert!(seen.torque.norm() < 1e-13 * weight && seen.distance.is_none() && seen.place == Vec3::zeros());
    }
}
