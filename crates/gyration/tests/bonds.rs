//! Bonds between bodies of any two kinds, in a cell and across cells: blocks of the Jacobian against differences,
//! action and reaction, the balance of power.

use crate::between::*;
use crate::moving::{assert_power_is_the_rate_of_energy, laws};
use gyration::body::Body;
use gyration::contact::AreaMeasure;
use gyration::dynamics::Workspace;
use gyration::kinematics::Placement;
use gyration::lattice::Lattice;
use gyration::load::{
    Bond, BondAxes, BondLaw, BondStiffness, DISTANCE_NAMES, Dashpot, InvariantPotential, Spring, Stiffness6,
};
use gyration::model::Model;
use gyration::neighbours::{BodyPair, Extent, ImagePair, ImagePairs, PairRule};
use gyration::pair::PairLaws;
use gyration::shape::{Shape, Sphere};
use gyration::state::State;
use gyration::tensor::{Mat3, Vec3};
use gyration_expression::Expression;
use std::sync::Arc;

fn distance(text: &str) -> BondLaw {
    BondLaw::Distance(Arc::new(Expression::parse(text, &DISTANCE_NAMES, &[]).unwrap().holding(&[1])))
}

fn invariants(text: &str) -> BondLaw {
    BondLaw::Invariants(Arc::new(InvariantPotential::parse(text, &[]).unwrap()))
}

/// A symmetric matrix without negative eigenvalues.
fn positive(seed: f64) -> Stiffness6 {
    let root = Stiffness6::from_fn(|i, j| libm::sin(seed + 1.3 * i as f64 + 0.7 * (j * j) as f64));
    root * root.transpose()
}

fn axes(seed: f64) -> BondAxes {
    let turned = |angle: f64| *nalgebra::Rotation3::from_euler_angles(angle, 0.3 * angle, -0.5).matrix();
    let strain = Mat3::from_fn(|i, j| 0.1 * libm::sin(seed + i as f64 - 2.0 * j as f64));
    let start = |angle: f64| Placement { position: Vec3::zeros(), gradient: turned(angle) + strain };
    BondAxes::new(&turned(seed), [&start(0.2 * seed), &start(0.4 * seed)], &Vec3::new(0.3, -0.2, 0.1))
}

/// A ring of bonds of every sort, and some across cells to other bodies and to a body's own image.
fn bonds(bodies: usize) -> Vec<Bond> {
    let laws = [
        Some(distance("1.7*(l - 0.4)^2 + 0.3*exp(-2*l)")),
        Some(invariants(
            "2*(d_x^2 + 0.5*d_y*d_z) + 0.4*(C_xx + D_yy - 2*H_xy) + sin(H_zz)*d_z + 0.2*C_xy*D_xz + H_yx^2*d_x",
        )),
        Some(BondLaw::Stiffness(Arc::new(BondStiffness { axes: axes(0.7), matrix: positive(0.4) }))),
        None,
        Some(distance("cos(3*t)*l^2")),
        Some(invariants("t*(d_x^2 + H_xy)")),
    ];
    let dashpots = [None, Some(Dashpot::Vector(0.9)), Some(Dashpot::Matrix(Arc::new((axes(1.1), positive(1.7)))))];
    let bond = |k: usize, one: usize, other: usize| {
        let seed = k as f64;
        let point = |seed: f64| 0.3 * Vec3::new(libm::sin(seed), libm::cos(2.0 * seed), libm::sin(3.0 * seed));
        let (law, damping) = (laws[k % laws.len()].clone(), dashpots[(k + k / 3) % dashpots.len()].clone());
        let damping = if law.is_none() { Some(Dashpot::Vector(0.6)) } else { damping };
        Bond::new([one, other], [point(seed + 0.3), point(seed + 1.1)], law, damping)
    };
    let mut ring: Vec<Bond> = (0..bodies).map(|k| bond(k, k, (k + 1) % bodies)).collect();
    let across = (0..6).map(|k| Bond { cell: [1 - (k as i32 % 3), 1, 0], ..bond(k, k, if k < 3 { k } else { k + 2 }) });
    ring.extend(across.collect::<Vec<_>>());
    ring
}

fn joined_by_bonds() -> Model {
    let vectors = vec![Vec3::new(0.9, 0.1, 0.0), Vec3::new(-0.2, 1.1, 0.3)];
    let bodies = bodies();
    let count = bodies.len();
    let model = Model::new(Vec3::new(0.3, -0.2, -9.81), vec![], bodies).in_lattice(Lattice::new(vectors).unwrap());
    let springs = [([0, 0], [1, 0, 0]), ([1, 4], [0, -1, 0]), ([2, 2], [1, 1, 0])];
    let springs = springs.map(|(bodies, cell)| {
        Spring::between(bodies, [Vec3::new(0.1, 0.2, 0.0), Vec3::new(-0.1, 0.0, 0.3)], DIRECTED).across(cell)
    });
    model.with_springs(springs.to_vec()).with_bonds(bonds(count))
}

#[test]
fn blocks_between_bonded_bodies_are_derivatives_of_the_rates() {
    let model = joined_by_bonds();
    let state = State { time: 0.6, ..state(&model) };
    assert_blocks_are_derivatives(&model, &state);
    assert_power_is_the_rate_of_energy(&model, &state);
}

#[test]
fn bonds_keep_momentum_and_angular_momentum() {
    let model = joined_by_bonds();
    let mut state = state(&model);
    state.time = 0.6;
    let mut workspace = Workspace::default();
    let (instant, _) = workspace.read(&model, &state).unwrap();
    for (number, bond) in model.bonds().iter().enumerate() {
        let [one, other] = bond.bodies.map(|body| instant.at(body));
        let loads = one.bond_loads(number);
        // Moments about one point; what is far away acts from its image.
        let places = [
            one.motion.placement,
            Placement {
                position: other.motion.placement.position + model.lattice.place(bond.cell),
                ..other.motion.placement
            },
        ];
        let force = loads.on[0].force + loads.on[1].force;
        let turning = |end: usize| {
            let torque = gyration::tensor::axial(&(loads.on[end].moment * places[end].gradient.transpose()));
            places[end].position.cross(&loads.on[end].force) + torque
        };
        let torque = turning(0) + turning(1);
        let size = loads.on[0].force.norm() + loads.on[0].moment.norm() + loads.on[1].moment.norm();
        // Rounding of sums of some twenty terms at lengths of two metres.
        assert!(force.norm() <= 1e-14 * size && torque.norm() < 1e-13 * size, "{number}: {force} {torque} of {size}");
    }
}

/// Balls of every kind that meet their own images and those of others, with damping and friction.
#[test]
fn blocks_between_bodies_that_meet_across_cells_are_derivatives_of_the_rates() {
    let balls = bodies_of(&Shape::Sphere(Sphere { radius: 0.3 }));
    let free: Vec<Body> = balls.into_iter().filter(|body| body.pin.is_none()).collect();
    let count = free.len();
    let [repulsion, damping, friction, _] = laws([5.0, 4.0, 3.0, 2.0]).try_into().unwrap();
    let laws = PairLaws::new(AreaMeasure::ReferenceArea, vec![repulsion, damping, friction]).unwrap();
    let all: Arc<[usize]> = (0..count).collect();
    let rule = PairRule { bodies: [all.clone(), all], supports: Arc::from([]), laws: Arc::new(laws), reach: None };
    let lattice = Lattice::new(vec![Vec3::new(1.2, 0.1, 0.0)]).unwrap();
    let model = Model::new(Vec3::new(0.3, -0.2, -9.81), vec![], free).in_lattice(lattice);
    let place = |k: usize| Vec3::new(0.0, 1.1 * k as f64, 0.0);
    let image = |one: usize, other: usize, n: i32| ImagePair {
        pair: BodyPair { rule: 0, bodies: [one, other] },
        cell: [n, 0, 0],
    };
    let own = (0..count).map(|body| image(body, body, 1));
    let beside = (0..count - 1).flat_map(|body| [-1, 0, 1].map(|n| image(body, body + 1, n)));
    let images = ImagePairs::new(own.chain(beside).collect(), (0..count).map(|k| extent(place(k), 1.0)).collect(), 0.6);
    let model = model.meeting_images(vec![rule], images);
    let state = state_at(&model, place);
    assert_blocks_are_derivatives(&model, &state);
    assert_power_is_the_rate_of_energy(&model, &state);
}

fn extent(place: Vec3, radius: f64) -> Extent {
    Extent { place, radius }
}

#[test]
fn a_body_strays_where_the_others_do_not_go_along() {
    let images = ImagePairs::new(Vec::new(), vec![extent(Vec3::x(), 0.2), extent(Vec3::y(), 0.2)], 0.5);
    let drift = Vec3::new(7.0, 0.0, -3.0);
    let at = |away: f64| {
        let place = move |body: usize| if body == 0 { Vec3::x() } else { Vec3::y() + away * Vec3::z() };
        images.strayed(move |body| extent(drift + place(body), 0.2))
    };
    assert!(at(0.4).is_none());
    let (body, distance) = at(0.75).unwrap();
    assert!(body == 1 && (distance - 0.75).abs() < 1e-14);
    // What it grows counts as well.
    let grown = |radius: f64| images.strayed(move |body| extent([Vec3::x(), 1.3 * Vec3::y()][body], radius));
    assert!(grown(0.1).is_none() && grown(0.35).is_none());
    assert!(grown(0.45).is_some_and(|(body, distance)| body == 1 && (distance - 0.55).abs() < 1e-14));
}
