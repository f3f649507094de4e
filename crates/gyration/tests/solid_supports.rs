//! Bodies of every kind at supports with a shape that move and turn: derivatives, powers, and what two bodies do to
//! each other.

use crate::between::{assert_blocks_are_derivatives, bodies_of, state_at};
use crate::moving::*;
use gyration::acting::Load;
use gyration::body::Solid;
use gyration::contact::{AreaMeasure, RelativeMotion};
use gyration::dynamics::Workspace;
use gyration::kinematics::{BodyMotion, Placement, Quaternion, Velocity};
use gyration::ledger::Work;
use gyration::mass::MassProperties;
use gyration::model::Model;
use gyration::neighbours::PairRule;
use gyration::pair::{PairLaws, Reach};
use gyration::shape::{Cuboid, Cylinder, Shape, Sphere};
use gyration::solid_support::SolidSupport;
use gyration::state::State;
use gyration::support::{MotionPart, Support, SupportMotion};
use gyration::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::{Rotation3, UnitQuaternion};
use std::convert::Infallible;
use std::sync::Arc;

fn support(shape: Shape, position: Vec3, parts: Vec<MotionPart>) -> SolidSupport {
    let mass = MassProperties { mass: f64::INFINITY, ..shape.mass_properties(1.0) };
    let gradient = Quaternion::from_axis_angle(&Vec3::new(0.3, 0.2, -0.4), 0.7).rotation();
    SolidSupport {
        name: "support".into(),
        size: shape.size(),
        solid: Solid::new(shape, mass).into(),
        start: Placement { position, gradient },
        motion: SupportMotion::new(parts),
    }
}

/// A plate that turns about a point beside it and is carried along, a ball that wobbles, a cylinder at rest.
fn solid_supports() -> Vec<SolidSupport> {
    let turn = MotionPart::Rotation { axis: Vec3::new(0.6, 0.0, 0.8), point: Vec3::new(0.5, -0.2, -0.4), rate: 1.3 };
    let drift = MotionPart::Velocity(Vec3::new(0.2, -0.1, 0.3));
    let wobble = MotionPart::Oscillation { direction: Vec3::y(), amplitude: 0.1, frequency: 0.6, phase: 0.3 };
    vec![
        support(Shape::Box(Cuboid { size: Vec3::new(1.1, 0.9, 0.3) }), Vec3::new(0.1, 0.0, -0.7), vec![turn, drift]),
        support(Shape::Sphere(Sphere { radius: 0.4 }), Vec3::new(-1.2, 0.4, 1.5), vec![wobble]),
        support(Shape::Cylinder(Cylinder { radius: 0.3, height: 0.8 }), Vec3::new(1.5, 0.3, 1.9), Vec::new()),
    ]
}

fn rule(bodies: usize, supports: usize, viscous: bool, measure: AreaMeasure) -> PairRule {
    let [repulsion, damping, friction, _] = laws([5.0, 4.0, 3.0, 2.0]).try_into().unwrap();
    let laws = if viscous { vec![repulsion, damping, friction] } else { vec![repulsion] };
    PairRule {
        bodies: [(0..bodies).collect(), Arc::from([])],
        supports: (0..supports).collect(),
        laws: Arc::new(PairLaws::new(measure, laws).unwrap()),
        reach: None,
    }
}

/// Bodies that meet all supports and not one another.
fn model(shape: &Shape, viscous: bool, measure: AreaMeasure) -> Model {
    let bodies = bodies_of(shape);
    let (count, supports) = (bodies.len(), solid_supports());
    let rule = rule(count, supports.len(), viscous, measure);
    Model::new(Vec3::new(0.3, -0.2, -9.81), Vec::new(), bodies).with_solid_supports(supports).meeting(vec![rule])
}

fn among_supports(model: &Model, time: f64) -> State {
    State { time, ..state_at(model, |_| Vec3::new(0.2, 0.1, 1.6)) }
}

#[test]
fn blocks_at_solid_supports_are_derivatives_and_powers_the_rates_of_energy() {
    let [cuboid, sphere, ..] = shapes();
    for (shape, viscous) in [(&cuboid, true), (&sphere, true), (&cuboid, false)] {
        for measure in [AreaMeasure::ReferenceArea, AreaMeasure::DeformedArea, AreaMeasure::DeformedAreaPotential] {
            let model = model(shape, viscous, measure);
            assert!(model.works().contains(&Work::Support));
            let state = among_supports(&model, 0.13);
            // Per deformed area the factors are held.
            if measure != AreaMeasure::DeformedArea {
                assert_blocks_are_derivatives(&model, &state);
            }
            assert_power_is_the_rate_of_energy(&model, &state);
        }
    }
}

#[test]
fn bodies_without_inertia_at_solid_supports_have_derivatives_and_powers() {
    let ball = Shape::Sphere(Sphere { radius: 0.3 });
    let free: Vec<_> = bodies_of(&ball).into_iter().filter(|body| body.pin.is_none()).collect();
    let (count, supports) = (free.len(), solid_supports());
    let model = immersed(Model::new(Vec3::new(0.3, -0.2, -9.81), Vec::new(), free), false);
    let model = model.with_solid_supports(supports).meeting(vec![rule(count, 3, true, AreaMeasure::ReferenceArea)]);
    let state = among_supports(&model, 0.13);
    assert_blocks_are_derivatives(&model, &state);
    assert_power_is_the_rate_of_energy(&model, &state);
}

/// What each body gets from a support, in order.
fn forces(model: &Model, state: &State, of: impl Fn(usize) -> bool) -> Vec<(Vec3, Mat3)> {
    let mut workspace = Workspace::default();
    let (instant, _) = workspace.read(model, state).unwrap();
    let mut forces = Vec::new();
    for body in (0..model.bodies.len()).filter(|body| of(*body)) {
        let Ok(()) = instant.at(body).try_each_load(|load| {
            if let Load::Pair(pair) = load {
                forces.push((pair.on_body().force, pair.on_body().moment));
            }
            Ok::<(), Infallible>(())
        });
    }
    forces
}

/// A support is to a body what another body of its shape, place and velocity is, to the last digit.
#[test]
fn a_support_does_what_a_body_in_its_place_does() {
    for reach in [None, Some(Reach::Length(3.0))] {
        let whole = model(&shapes()[0], true, AreaMeasure::ReferenceArea);
        let state = among_supports(&whole, 0.4);
        let count = whole.bodies.len();
        let alone = PairRule { reach, ..rule(count, 1, true, AreaMeasure::ReferenceArea) };
        let at_support = whole.clone().meeting(vec![alone.clone()]);
        let carried = at_support.solid_supports[0].at(state.time);
        let mut double = (*whole.bodies[0]).clone();
        double.solid = at_support.solid_supports[0].solid.clone();
        double.kind =
            whole.bodies.iter().find(|body| body.affine().is_none() && body.pin.is_none()).unwrap().kind.clone();
        let bodies = whole.bodies.iter().map(|body| (**body).clone()).chain([double]);
        let rule = PairRule { bodies: [(0..count).collect(), Arc::from([count])], supports: Arc::from([]), ..alone };
        let between = Model::new(whole.gravity, Vec::new(), bodies).meeting(vec![rule]);
        let mut both = State { time: state.time, ..state_at(&between, |_| Vec3::zeros()) };
        both.bodies[..state.bodies.len()].copy_from_slice(&state.bodies);
        let slots = between.slots(count);
        let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(carried.placement.gradient));
        let turn = [turn.w, turn.i, turn.j, turn.k];
        both.bodies[slots.position()].copy_from_slice(carried.placement.position.as_slice());
        both.bodies[slots.attitude()].copy_from_slice(&turn);
        both.bodies[slots.velocity()].copy_from_slice(carried.velocity.velocity.as_slice());
        let spin = carried.placement.gradient.tr_mul(&carried.angular_velocity());
        both.bodies[slots.rate()].copy_from_slice(spin.as_slice());
        let (one, other) = (forces(&at_support, &state, |_| true), forces(&between, &both, |body| body < count));
        assert_eq!(one.len(), count);
        // The rotation of the double is made of a quaternion: a few roundings.
        for ((force, moment), (expected, expected_moment)) in one.iter().zip(&other) {
            assert!(force.norm() > 1e-6);
            assert!((force - expected).norm() < 1e-12 * expected.norm(), "{force} {expected}");
            assert!((moment - expected_moment).norm() < 1e-12 * expected_moment.norm());
        }
    }
}

/// Planes that turn, one about a point beside it while it is carried along.
fn turning_planes() -> Vec<Support> {
    let turn = MotionPart::Rotation { axis: Vec3::new(0.6, 0.0, 0.8), point: Vec3::new(0.5, -0.2, -0.4), rate: 0.9 };
    let drift = MotionPart::Velocity(Vec3::new(0.2, -0.1, 0.3));
    let other = MotionPart::Rotation { axis: Vec3::x(), point: Vec3::new(0.0, 0.3, 0.0), rate: -0.4 };
    let [mut table, mut slope] = supports().try_into().unwrap();
    table.motion = SupportMotion::new(vec![turn, drift]);
    slope.motion = SupportMotion::new([slope.motion.parts(), &[other, turn]].concat());
    vec![table, slope]
}

#[test]
fn blocks_at_planes_that_turn_are_derivatives_and_powers_the_rates_of_energy() {
    for shape in &shapes()[..2] {
        for measure in [AreaMeasure::DeformedArea, AreaMeasure::DeformedAreaPotential] {
            let model = Model::new(Vec3::new(0.3, -0.2, -9.81), turning_planes(), bodies_of(shape));
            let model = attached(model, [6.0, 5.0, 4.0, 3.0], measure);
            assert!(model.works().contains(&Work::Support));
            let state = among_supports(&model, 0.13);
            assert_jacobian_is_the_derivative(&model, &state);
            assert_power_is_the_rate_of_energy(&model, &state);
        }
    }
}

/// At rest on a plane that turns a body has the velocity of the plane, and feels no damping or friction.
#[test]
fn what_turns_with_a_plane_is_at_rest_to_it() {
    let [plane, _] = turning_planes().try_into().unwrap();
    let time = 0.7;
    let carried = plane.motion.carriage(time);
    let place = Placement {
        position: Vec3::new(0.3, 1.0, 2.0),
        gradient: Mat3::new(1.1, 0.2, 0.0, 0.1, 0.9, 0.3, 0.0, 0.1, 1.2),
    };
    let velocity = Velocity {
        velocity: carried.velocity_at(&place.position),
        gradient_rate: cross_matrix(&carried.spin) * place.gradient,
    };
    let relative = RelativeMotion::to(&plane, &BodyMotion { placement: place, velocity }, time);
    assert!(relative.velocity.norm() < 1e-15 && relative.gradient_rate.norm() < 1e-15);
    let start = plane.at(0.0);
    let gap = start.gap(&Vec3::new(0.4, 0.2, 0.9));
    assert!((plane.gap(&carried.place(&Vec3::new(0.4, 0.2, 0.9)), time) - gap).abs() < 1e-14);
}

#[test]
fn a_part_of_a_model_has_the_supports_of_its_bodies() {
    let whole = model(&shapes()[0], false, AreaMeasure::ReferenceArea);
    assert_eq!(whole.pairs_with_supports().len(), 3 * whole.bodies.len());
    assert_eq!((whole.chain().count(), whole.count_pairs()), (0, [3 * whole.bodies.len(); 2]));
    let part = whole.part(&[2, 5]);
    assert_eq!(part.pairs_with_supports().len(), 6);
    assert!(part.has_contact(1) && part.has_pairs(1) && !part.meets_bodies(1) && !part.is_joined(1));
    let state = among_supports(&whole, 0.2);
    let of_whole = forces(&whole, &state, |body| [2, 5].contains(&body));
    let own = [2, 5].map(|body| whole.blocks()[body].clone());
    let bodies = own.into_iter().flat_map(|block| state.bodies[block].to_vec()).collect();
    let of_part = forces(&part, &State { bodies, low: Vec::new(), ..state }, |_| true);
    assert_eq!(of_whole, of_part);
}
