//! Homogeneous fluid under its own gravity, πGρ = 1: incompressible affine spheres of R = 1 without elasticity.
//!
//!   the sphere rings at ω² = 16/15, five-fold;   dust at rest falls together in t = (β + ½ sin 2β)/√(8/3), s = cos²β
//!   turning with Ω: P̈ = −Ω² diag(1, 1, 0) P;    with a tide Ω² (3 e ⊗ e − 1) where a moon goes round once a turn
//!
//! Figures are sought by P̈ as the program has it. It is affine in Ω², so that two evaluations tell what gravity does
//! and what Ω² = 1 adds. References: `validation/oracles/self_gravity.py`.

use crate::soft::entry;
use gyration::body::matrix;
use gyration::dynamics::{Workspace, jacobian, rates};
use gyration::kinematics::{Placement, Velocity};
use gyration::state::{Start, State};
use gyration::tensor::{Mat3, Vec3};
use gyration_sim::modes::{ModeBehaviour, modes, rest};
use gyration_validation::{Case, Experiment};
use nalgebra::DMatrix;
use std::f64::consts::{PI, TAU};

/// A ball of fluid of density one, G = 1/π; of the kind and with what else is written.
fn ball(kind: &str, lines: &str) -> Experiment {
    Experiment::of_scene(&format!(
        r#"
        world = {{ gravity = [0, 0, 0], self_gravity = {{ constant = {:?} }} }}
        time = {{ end = 1, sample = 1 }}
        solver = {{ rtol = 1e-13, atol = 1e-14 }}
        [[body]]
        name = "body"
        density = 1
        shape = {{ sphere = {{ radius = 1 }} }}
        affine = {{ {kind} }}
        {lines}
        "#,
        1.0 / PI
    ))
}

const FLUID: &str = "material = { mooney_rivlin = { c1 = 0, c2 = 0 } }";
/// The tide of Ω² = 1 along x.
const TIDE: &str = "body_force = [\"2*x\", \"-y\", \"-z\"]";
const CHANDRASEKHAR: &str = "Chandrasekhar, Ellipsoidal Figures of Equilibrium";

/// e_z × P.
fn turned(p: &Mat3) -> Mat3 {
    Mat3::from_columns(&[0, 1, 2].map(|k| Vec3::z().cross(&p.column(k))))
}

/// The state of a body that turns with Ω.
fn turning(model: &Experiment, p: &Mat3, omega: f64) -> State {
    let place = Placement { position: Vec3::zeros(), gradient: *p };
    let velocity = Velocity { velocity: Vec3::zeros(), gradient_rate: omega * turned(p) };
    State::start(&model.model, &[Start::Affine(place, velocity)])
}

/// P̈ of the program, less that of the turn, P̈ + Ω² diag(1, 1, 0) P: zero of a figure of equilibrium.
fn unbalanced(model: &Experiment, p: &Mat3, omega: f64) -> Mat3 {
    let state = turning(model, p, omega);
    let (mut slopes, mut powers) = (vec![0.0; state.bodies.len()], vec![0.0; model.model.works().len()]);
    let numbers = (&state.bodies[..]).into();
    rates(&model.model, &mut Workspace::default(), 0.0, numbers, &mut slopes, &mut powers).unwrap();
    let turn = turned(&turned(p));
    matrix(&slopes[model.model.slots(0).rate()]) - omega * omega * turn
}

/// Fluid alone, and fluid in the tide of Ω² = 1.
struct Fluid {
    alone: Experiment,
    in_tide: Experiment,
}

impl Fluid {
    fn new() -> Self {
        Self { alone: ball(FLUID, ""), in_tide: ball(FLUID, TIDE) }
    }

    /// What is unbalanced along x and z of an ellipsoid of these axes at rest, and by Ω² = 1 besides.
    fn parts(&self, axes: [f64; 3], tide: bool) -> [[f64; 2]; 2] {
        let scale = (axes[0] * axes[1] * axes[2]).cbrt();
        let p = Mat3::from_diagonal(&(Vec3::from(axes) / scale));
        let seen = |found: Mat3| [found.m11, found.m33];
        let still = seen(unbalanced(&self.alone, &p, 0.0));
        let moving = seen(unbalanced(if tide { &self.in_tide } else { &self.alone }, &p, 1.0));
        [still, [moving[0] - still[0], moving[1] - still[1]]]
    }

    /// Ω² at which a spheroid of this eccentricity is in equilibrium.
    fn spheroid(&self, e: f64) -> f64 {
        let [still, by_turning] = self.parts([1.0, 1.0, (1.0 - e * e).sqrt()], false);
        -still[0] / by_turning[0]
    }

    /// b/a and Ω² of the ellipsoid in equilibrium with this c/a, b/a near a guess.
    fn ellipsoid(&self, c: f64, guess: f64, tide: bool) -> (f64, f64) {
        let found = |b: f64| {
            let [still, turn] = self.parts([1.0, b, c], tide);
            (still[0] * turn[1] - still[1] * turn[0], -still[0] / turn[0])
        };
        let b = root(guess, |b| found(b).0);
        (b, found(b).1)
    }
}

/// A root near a guess, by secants.
fn root(guess: f64, function: impl Fn(f64) -> f64) -> f64 {
    let (mut before, mut now) = (guess * (1.0 - 1e-3), guess);
    let (mut value_before, mut value) = (function(before), function(now));
    for _ in 0..40 {
        let step = -value * (now - before) / (value - value_before);
        if value == value_before || step.abs() < 1e-15 {
            return now;
        }
        (before, value_before) = (now, value);
        now += step;
        value = function(now);
    }
    now
}

/// df/dx by differences of sixth order.
fn slope(x: f64, function: impl Fn(f64) -> f64) -> f64 {
    /// h⁶ beside eps/h.
    const STEP: f64 = 2e-3;
    let odd = |k: f64| function(x + k * STEP) - function(x - k * STEP);
    (45.0 * odd(1.0) - 9.0 * odd(2.0) + odd(3.0)) / (60.0 * STEP)
}

#[test]
fn a_fluid_sphere_rings_as_kelvin_says() {
    let case =
        Case { row: None, name: "fluid sphere, πGρ = 1", source: "ω² = 8πGρ l(l − 1)/(3(2l + 1)), l = 2" };
    let omega = (16.0_f64 / 15.0).sqrt();
    let sphere = ball(FLUID, "");
    let at_rest = rest(&sphere.model, &sphere.start, 0).unwrap();
    let found = modes(&sphere.model, &sphere.start, 0, &at_rest).unwrap();
    let ringing: Vec<f64> =
        found.iter().filter(|mode| mode.motion == ModeBehaviour::Oscillates).map(|mode| mode.frequency()).collect();
    assert_eq!((found.len(), ringing.len()), (11, 5));
    case.check("lowest ω² of five modes", 16.0 / 15.0, ringing[0].powi(2), 1e-12);
    case.check("highest ω² of five modes", 16.0 / 15.0, ringing[4].powi(2), 1e-12);
    // The frequency of an amplitude a differs by a².
    let mode = Mat3::from_diagonal(&[-0.5, -0.5, 1.0].into());
    let shaken = ball(FLUID, &entry("gradient", &(Mat3::identity() + 1e-5 * mode)));
    let time = 10.0 * TAU / omega;
    let motion = shaken.motion_at(time);
    let place = mode.dot(&(motion.placement.gradient - Mat3::identity()));
    let phase = (-mode.dot(&motion.velocity.gradient_rate) / omega).atan2(place);
    case.check("ω² over ten periods", 16.0 / 15.0, ((10.0 * TAU + phase) / time).powi(2), 1e-8);
}

#[test]
fn dust_falls_together_in_the_time_of_free_fall() {
    let case = Case {
        row: None,
        name: "sphere of dust at rest, πGρ = 1",
        source: "s = cos²β at t = (β + ½ sin 2β)/√(8πGρ/3)",
    };
    let dust = ball("", "").until((0.25 * PI + 0.5) / (8.0_f64 / 3.0).sqrt());
    let run = dust.run();
    let motion = run.end.motion(&dust.model, 0);
    let s = motion.placement.gradient.m11;
    case.check("s at β = 45°", 0.5, s, 1e-9);
    case.check("ṡ there", -(8.0_f64 / 3.0).sqrt(), motion.velocity.gradient_rate.m11, 1e-9);
    // −(3/5) G m²/s, m = 4π/3.
    let energy = *run.column("energy.load").last().unwrap();
    case.check("energy of its gravity", -0.6 / PI * (4.0 / 3.0 * PI).powi(2) / s, energy, 1e-12);
    case.by("the ledger").check("residual over the energy in play", 0.0, run.relative_residual(), 1e-10);
}

#[test]
fn spheroids_spin_no_faster_than_maclaurin_says() {
    let case = Case { row: None, name: "Maclaurin's spheroids, πGρ = 1", source: CHANDRASEKHAR };
    let fluid = Fluid::new();
    let e = root(0.93, |e| slope(e, |e| fluid.spheroid(e)));
    case.check("e of the largest Ω²", 0.929955685456233, e, 1e-8);
    case.check("largest Ω²", 0.4493314121239139, fluid.spheroid(e), 1e-10);
    let closed = |e: f64| {
        let c = (1.0 - e * e).sqrt();
        2.0 * c / e.powi(3) * (3.0 - 2.0 * e * e) * e.asin() - 6.0 * (1.0 - e * e) / (e * e)
    };
    case.by("Maclaurin's formula").check("Ω² at e = 0.5", closed(0.5), fluid.spheroid(0.5), 1e-12);
}

/// About the spheroids, the motion along diag(1, −1, 0) that stands still in the axes which turn with Ω: δP̈ = −Ω² δP.
#[test]
fn jacobis_ellipsoids_leave_the_spheroids_where_a_mode_is_neutral() {
    let case = Case { row: None, name: "Jacobi's ellipsoids, πGρ = 1", source: CHANDRASEKHAR };
    let fluid = Fluid::new();
    let model = &fluid.alone.model;
    let opposed = |e: f64| {
        let c = (1.0 - e * e).powf(1.0 / 6.0);
        let (p, square) = (Mat3::from_diagonal(&[1.0 / c, 1.0 / c, c * c].into()), fluid.spheroid(e));
        let state = turning(&fluid.alone, &p, square.sqrt());
        let mut blocks = [DMatrix::zeros(state.bodies.len(), state.bodies.len())];
        jacobian(model, &mut Workspace::default(), 0.0, state.numbers(), &mut blocks[..]).unwrap();
        let along = Mat3::from_diagonal(&[1.0, -1.0, 0.0].into());
        let (slots, moving) = (model.slots(0), square.sqrt() * turned(&along));
        let product = |numbers: std::ops::Range<usize>, change: &Mat3| {
            blocks[0].view((slots.rate().start, numbers.start), (9, 9))
                * DMatrix::from_column_slice(9, 1, change.as_slice())
        };
        let change = product(slots.attitude(), &along) + product(slots.rate(), &moving);
        Mat3::from_column_slice(change.as_slice()).dot(&along) + square * along.norm_squared()
    };
    let e = root(0.81, opposed);
    case.check("e of the neutral spheroid", 0.812670010633, e, 1e-10);
    case.check("Ω² of the neutral spheroid", 0.374229674804, fluid.spheroid(e), 1e-10);
    let (b, square) = fluid.ellipsoid(0.4337810348915061, 0.59, false);
    case.check("b/a at c/a = 0.4337810349", 0.6, b, 1e-10);
    case.check("Ω² at c/a = 0.4337810349", 0.3373299033756934, square, 1e-10);
}

#[test]
fn a_small_moon_ends_at_roches_limit() {
    let case = Case { row: None, name: "small moon in the tide of a planet, πGρ = 1", source: CHANDRASEKHAR };
    let fluid = Fluid::new();
    let moon = |c: f64| fluid.ellipsoid(c, 1.06 * c, true);
    let c = root(0.48, |c| slope(c, |c| moon(c).1));
    case.check("c/a at the limit", 0.482573598192185, c, 1e-8);
    case.check("b/a at the limit", 0.5113428042723464, moon(c).0, 1e-8);
    case.check("largest Ω²", 0.0900929971212751, moon(c).1, 1e-10);
    case.check("Ω² at c/a = 0.6", 0.08375855467283654, moon(0.6).1, 1e-10);
}
