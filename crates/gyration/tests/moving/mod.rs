//! Bodies under everything that may act on them, and relations that all rates obey.

#![allow(dead_code, reason = "each test uses a part of this")]

pub mod any_form;

use gyration::affine::{AffineBody, Viscosity};
use gyration::balance::energies;
use gyration::body::{Affine, Body, BodyKind, Pin, Solid};
use gyration::contact::{Adhesion, AreaMeasure, Contact, ContactLaw, Damping, Friction, LawSet, Repulsion};
use gyration::dynamics::jacobian;
use gyration::dynamics::{Workspace, rates};
use gyration::fluid::{FixedForm, Fluid, Form, History, Inclusion};
use gyration::kinematics::Placement;
use gyration::load::{
    Anchor, Applied, BodyForce, Couple, FieldOfForce, Formula, Frame, FrictionEntry, FrictionMatrix, LinearResistance,
    MassFriction, Mat12, OwnForces, OwnFriction, PointForce, Potential, SelfGravity, Spring, SpringLaw,
};
use gyration::material::{Material, MooneyRivlin, NeoHookeanLog};
use gyration::model::Model;
use gyration::shape::{Cuboid, Cylinder, Ellipsoid, Shape, Sphere};
use gyration::signal::{Signal, Wave};
use gyration::state::State;
use gyration::support::{MotionPart, Support, SupportMotion};
use gyration::tensor::{Mat3, Vec3};
use nalgebra::DMatrix;
use proptest::prelude::*;
use std::sync::Arc;

pub fn laws(exponents: [f64; 4]) -> Vec<ContactLaw> {
    let [repulsion, damping, friction, adhesion] = exponents;
    vec![
        ContactLaw::Repulsion(Repulsion { alpha: 2.0, exponent: repulsion, reference_gap: 0.3 }),
        ContactLaw::Damping(Damping { beta: 0.7, exponent: damping, reference_gap: 0.4, release: None }),
        ContactLaw::Friction(Friction { beta: 0.9, exponent: friction, reference_gap: 0.2, mu: None }),
        ContactLaw::Adhesion(Adhesion {
            beta: 1.3,
            attractive_exponent: adhesion,
            repulsive_exponent: adhesion + 2.5,
            reference_gap: 0.25,
        }),
    ]
}

pub fn supports() -> Vec<Support> {
    let wobble = MotionPart::Oscillation { direction: Vec3::z(), amplitude: 0.05, frequency: 0.7, phase: 0.4 };
    let moving = |part: MotionPart| SupportMotion::new(vec![part]);
    vec![
        Support { name: "table".into(), origin: Vec3::zeros(), normal: Vec3::z(), motion: moving(wobble) },
        Support {
            name: "slope".into(),
            origin: Vec3::new(-2.0, 0.0, -1.0),
            normal: Vec3::new(0.6, 0.0, 0.8),
            motion: moving(MotionPart::Velocity(Vec3::new(0.1, -0.2, 0.05))),
        },
    ]
}

/// A friction and a gyroscopic load without any symmetry but that of their kind.
pub fn resistances(frame: Frame) -> Vec<LinearResistance> {
    let root = Mat12::from_fn(|i, j| 0.2 * (1.3 * i as f64 + 0.7 * (j * j) as f64).sin());
    let skew = root - root.transpose();
    vec![
        LinearResistance::friction(&(root * root.transpose()), frame).unwrap(),
        LinearResistance::gyroscopic(&skew, frame).unwrap(),
    ]
}

/// The same model, the friction of whose contacts has a bound μ, and whose damping is one-sided with some w₀ [m/s].
pub fn bounded(model: Model, mu: f64) -> Model {
    let bind = |contact: &Contact| {
        let laws = contact.law_set.laws().iter().map(|law| bounded_law(*law, mu)).collect();
        Contact::new(contact.body, contact.support, LawSet::new(contact.law_set.measure, laws))
    };
    let contacts = model.contacts().iter().map(bind).collect();
    model.with_contacts(contacts)
}

/// The same law, with a bound if it is a friction, and one-sided if it is a damping.
pub fn bounded_law(law: ContactLaw, mu: f64) -> ContactLaw {
    match law {
        ContactLaw::Friction(friction) => ContactLaw::Friction(Friction { mu: Some(mu), ..friction }),
        ContactLaw::Damping(damping) => ContactLaw::Damping(Damping { release: Some(0.3), ..damping }),
        other => other,
    }
}

/// What bodies differ in.
#[derive(Debug, Clone, Copy)]
pub struct Variant {
    pub incompressible: bool,
    pub pinned: bool,
    pub frame: Frame,
}

/// The model whose bodies feel all laws of both supports, and hang on two springs each, one of them on an anchor that
/// swings round.
pub fn attached(model: Model, exponents: [f64; 4], measure: AreaMeasure) -> Model {
    let bodies = 0..model.bodies.len();
    let law_set = Arc::new(LawSet::new(measure, laws(exponents)));
    let contacts = bodies.clone().flat_map(|body| [0, 1].map(|support| Contact::new(body, support, law_set.clone())));
    let directed = SpringLaw { stiffness: 1.7, rest_length: 0.6, damping: 0.4 };
    let plain = SpringLaw { rest_length: 0.0, damping: 0.0, ..directed };
    let (point, start) = (Vec3::new(0.1, 0.2, -0.3), Vec3::new(1.0, 2.0, 3.0));
    let turn = MotionPart::Rotation { axis: Vec3::y(), point: Vec3::x(), rate: 0.8 };
    let swing = MotionPart::Oscillation { direction: Vec3::z(), amplitude: 0.3, frequency: 0.4, phase: 0.2 };
    let anchor = Anchor { start, motion: Arc::new(SupportMotion::new(vec![turn, swing])) };
    let springs = bodies.flat_map(|body| {
        [Spring::to(body, point, anchor.clone(), directed), Spring::to_anchor(body, point, start, plain)]
    });
    let (contacts, springs) = (contacts.collect(), springs.collect());
    model.with_contacts(contacts).with_springs(springs)
}

pub fn body(shape: Shape, variant: Variant) -> Body {
    let mass = shape.mass_properties(0.8);
    let pin = variant.pinned.then(|| Pin { point: Vec3::new(0.2, -0.1, 0.3), anchor: Vec3::new(0.3, 0.1, 1.4) });
    let material = match variant.incompressible {
        true => Material::MooneyRivlin(MooneyRivlin { c1: 2.0, c2: 1.0, bulk: None }),
        false => Material::NeoHookeanLog(NeoHookeanLog { mu: 3.0, lambda: 2.0 }),
    };
    let viscosity = Viscosity { kirchhoff: 0.3, shear: 0.2, bulk: 0.1 };
    let interior = AffineBody::new(&mass, pin.as_ref().map(|pin| &pin.point), Some(material), viscosity).unwrap();
    let couple = Couple::Constant(Mat3::new(0.1, -0.2, 0.3, 0.0, 0.2, 0.1, -0.3, 0.4, 0.1));
    let affine = Affine { interior, couple: Some(couple), resistances: resistances(variant.frame) };
    Body {
        kind: BodyKind::Affine(Box::new(affine)),
        size: shape.size(),
        solid: Solid::new(shape, mass).into(),
        inclusion: None,
        own: OwnForces::default(),
        pin,
        guide: None,
    }
}

/// A fluid that flows in every way it may, and weighs something.
pub fn fluid() -> Fluid {
    let swirl = Mat3::new(0.3, 1.1, -0.4, 0.2, -0.5, 0.7, 0.6, -0.1, 0.2);
    let wave = |amplitude| Signal::Sine(Wave { amplitude, frequency: 0.6, phase: 0.2 });
    let stream = Mat3::from_columns(&[Vec3::new(0.4, -0.3, 0.2), Vec3::zeros(), Vec3::zeros()]);
    let gradient = Signal::Sum(vec![Signal::Constant(0.5 * swirl), wave(swirl)]);
    Fluid { viscosity: 0.8, density: 0.6, velocity: wave(stream), gradient }
}

/// What makes a body an inclusion, with its centre of mass off that of its volume.
fn inclusion(body: &Body, inertia: bool) -> Inclusion {
    let center = Vec3::new(0.05, -0.1, 0.08);
    let form = match body.kind {
        BodyKind::Rigid(_) => {
            let root = Mat12::from_fn(|i, j| 0.3 * (0.9 * i as f64 + 1.7 * (j * j) as f64).sin());
            Form::Fixed(Box::new(FixedForm::shifted(&(root * root.transpose() + Mat12::identity()), &center)))
        }
        _ => Form::Ellipsoid(Vec3::new(0.5, 0.3, 0.4)),
    };
    Inclusion { inertia, volume: 0.4, center, form, history: None, neighbours: None, walls: None }
}

/// The same bodies immersed in a fluid, with inertia or without.
pub fn immersed(model: Model, inertia: bool) -> Model {
    let immerse = |body: &Arc<Body>| Body { inclusion: Some(inclusion(body, inertia)), ..(**body).clone() };
    let bodies: Vec<Body> = model.bodies.iter().map(immerse).collect();
    model.with_bodies(bodies).in_fluid(fluid())
}

/// Spheres whose motion a fluid remembers, roughly; their strain as well, if that is asked for.
pub fn with_history(model: Model, strains: bool) -> Model {
    let model = immersed(model, true);
    let is_free = |body: &Body| body.pin.is_none() && matches!(body.solid.shape, Shape::Sphere(_));
    let free: Vec<usize> = (0..model.bodies.len()).filter(|body| is_free(&model.bodies[*body])).collect();
    let model = model.part(&free);
    let mut bodies = model.bodies.clone();
    for body in &mut bodies {
        let own = Arc::make_mut(body);
        if let (Some(inclusion), Shape::Sphere(sphere)) = (&mut own.inclusion, &own.solid.shape) {
            let history = if strains { History::of_straining_sphere } else { History::of_sphere };
            inclusion.history = Some(history(sphere.radius, [0.8, 0.6], 0.5, 0.05).unwrap());
        }
    }
    model.with_bodies(bodies)
}

/// Gives the relaxation modes of all histories some numbers.
pub fn shake_modes(model: &Model, state: &mut State) {
    for body in 0..model.bodies.len() {
        for (place, number) in state.bodies[model.slots(body).extra()].iter_mut().enumerate() {
            *number = (1.7 * (place + body) as f64).sin();
        }
    }
}

/// The same bodies under a controller that applies force, affine moment and torque to each.
pub fn controlled(model: Model) -> Model {
    let mut model = model.under_control();
    let applied = Applied {
        force: Vec3::new(0.7, -0.4, 1.1),
        moment: Mat3::new(0.3, -0.5, 0.2, 0.8, 0.1, -0.6, 0.4, -0.2, 0.5),
        torque: Vec3::new(-0.9, 0.6, 0.3),
    };
    for body in 0..model.bodies.len() {
        assert!(model.apply(body, applied));
    }
    model
}

/// The same bodies under forces of their own without any symmetry: a potential that changes in time or not, a body
/// force that is a polynomial or not, friction of a matrix with a scale or of formulas, by turns.
pub fn with_own_forces(model: Model) -> Model {
    let still = "k*sin(x*P_xy + 0.3*z) + 0.7*y^2*P_zz^2 + exp(0.2*P_yx - 0.1*P_zy) + sqrt(1 + x^2 + P_xx^2)";
    let waving = "k*(P_xx*P_yz - 0.5)^2*cos(3*t) + tanh(x - y*t)*z + 0.3*P_zx^3*P_xz/(2 + sin(t)) + ln(3 + P_yy)";
    let quadratic = ["0.4*x^2 - y*z*cos(t)", "k*x*y", "0.3 - z"];
    let smooth = ["sin(2*x + y)", "exp(-0.2*z^2)*x", "tanh(x*y*z + t)"];
    let constants = [("k".to_owned(), 1.3)];
    let formula = |text: &str| Formula::parse(text, &constants).unwrap();
    let root = Mat12::from_fn(|i, j| 0.2 * (0.9 * i as f64 + 1.1 * (j * j) as f64).sin());
    let square = root * root.transpose();
    let own = |(index, body): (usize, &Arc<Body>)| {
        let potential = Potential::parse([still, waving][index % 2], &constants).unwrap();
        let field = FieldOfForce::parse([quadratic, smooth][index / 2 % 2], &constants).unwrap();
        let place = Placement { position: Vec3::zeros(), gradient: Mat3::identity() };
        let body_force = BodyForce::new(field, &body.solid.shape, &body.solid.mass.center, (&place, 0.0)).unwrap();
        let scaled = FrictionMatrix::Scaled(Box::new(square), formula("1 + k*x^2*P_xx^2 + sin(t)^2*P_yz^2"));
        let entry = |row: usize, column: usize| {
            let text = format!("{:?}*(1 + 0.3*x*P_yx) + {:?}*z^2", square[(row, column)], square[(row, column)]);
            FrictionEntry::Formula(Box::new(formula(&text)))
        };
        let entries = || std::array::from_fn(|row| std::array::from_fn(|column| entry(row, column)));
        let by_entries = || OwnFriction::new(FrictionMatrix::Entries(Box::new(entries())), Frame::Space);
        let own = OwnForces {
            potential: Some(Box::new(potential)),
            body_force: Some(Box::new(body_force)),
            point_forces: vec![PointForce {
                point: Vec3::new(0.3, -0.2, 0.4),
                field: FieldOfForce::parse([quadratic, smooth][index % 2], &constants).unwrap(),
            }],
            resistance: Some(Box::new(LinearResistance::friction(&square, Frame::Body).unwrap())),
            // A gross of formulas takes a tenth of a millisecond.
            frictions: std::iter::once(OwnFriction::new(scaled, Frame::Body))
                .chain((index % 3 == 0).then(by_entries))
                .collect(),
            absorption: Some(MassFriction { rate: 0.7 }),
            self_gravity: Some(SelfGravity::new(0.9, 1.4, &Vec3::new(0.5, [0.3, 0.5][index % 2], 0.5))),
        };
        Body { own, ..(**body).clone() }
    };
    let bodies: Vec<Body> = model.bodies.iter().enumerate().map(own).collect();
    model.with_bodies(bodies)
}

pub fn shapes() -> [Shape; 4] {
    [
        Shape::Box(Cuboid { size: Vec3::new(0.8, 1.0, 0.6) }),
        Shape::Sphere(Sphere { radius: 0.5 }),
        Shape::Cylinder(Cylinder { radius: 0.4, height: 0.9 }),
        Shape::Ellipsoid(Ellipsoid { semi_axes: Vec3::new(0.5, 0.3, 0.4) }),
    ]
}

/// Rates and powers.
pub fn evaluate(model: &Model, time: f64, bodies: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (mut slopes, mut powers) = (vec![0.0; bodies.len()], vec![0.0; model.works().len()]);
    rates(model, &mut Workspace::default(), time, bodies.into(), &mut slopes, &mut powers).unwrap();
    (slopes, powers)
}

/// Numbers in [−1, 1].
pub fn numbers(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.0..1.0_f64, count)
}

/// An exponent of each law.
pub fn exponents() -> impl Strategy<Value = [f64; 4]> {
    prop::array::uniform4(prop_oneof![1.0..7.0_f64, Just(1.0), Just(3.0)])
}

/// Fails where the Jacobian is not the derivative of the rates.
pub fn assert_jacobian_is_the_derivative(model: &Model, state: &State) {
    let dimensions = model.bodies.iter().map(|body| body.dimension());
    let mut blocks: Vec<_> = dimensions.map(|dimension| DMatrix::zeros(dimension, dimension)).collect();
    jacobian(model, &mut Workspace::default(), state.time, state.numbers(), &mut blocks[..]).unwrap();
    for (body, (block, range)) in blocks.iter().zip(model.blocks()).enumerate() {
        assert!(block.iter().all(|entry| entry.is_finite()), "body {body}: {block}");
        for column in range.clone() {
            let step = 1e-5;
            let shifted = |sign: f64| {
                let mut bodies = state.bodies.clone();
                bodies[column] += sign * step;
                evaluate(model, state.time, &bodies).0
            };
            let (ahead, behind) = (shifted(1.0), shifted(-1.0));
            for row in range.clone() {
                let difference = (ahead[row] - behind[row]) / (2.0 * step);
                let exact = block[(row - range.start, column - range.start)];
                // Central differences: step² × third derivative, which the powers of the gap make large.
                let scale = block.column(column - range.start).norm() + 1.0;
                assert!(
                    (difference - exact).abs() < 1e-6 * scale,
                    "body {body}, ({row}, {column}): {difference} against {exact}"
                );
            }
        }
    }
}

/// Fails where the powers of the works are not the rate of the energies.
pub fn assert_power_is_the_rate_of_energy(model: &Model, state: &State) {
    let (slopes, powers) = evaluate(model, state.time, &state.bodies);
    let step = 1e-5;
    let at = |sign: f64| {
        let ahead = |(y, dy): (&f64, &f64)| y + sign * step * dy;
        let bodies = state.bodies.iter().zip(&slopes).map(ahead).collect();
        let mut values = vec![0.0; model.energies().len()];
        let ahead = State { time: state.time + sign * step, bodies, ..state.clone() };
        energies(model, &mut Workspace::default(), &ahead, &mut values).unwrap();
        values
    };
    let (before, after) = (at(-1.0), at(1.0));
    let rate = (after.iter().sum::<f64>() - before.iter().sum::<f64>()) / (2.0 * step);
    let power: f64 = powers.iter().sum();
    // Central differences along the flow, and the rounding of the energies: the potential of a repulsion with ν close
    // to 1 is large, α d₀/(ν − 1), and hardly changes.
    let scale = powers.iter().map(|p| p.abs()).sum::<f64>() + rate.abs() + 1.0;
    let energy: f64 = after.iter().map(|energy| energy.abs()).sum();
    let tolerance = 1e-6 * scale + 32.0 * f64::EPSILON * energy / step;
    assert!((rate - power).abs() < tolerance, "{rate} W against {power} W");
}
