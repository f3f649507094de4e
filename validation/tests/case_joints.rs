//! Joints against reduced equations: compound and double pendulum, a gyroscope in gimbals.

use crate::independent::{Equations, integrate};
use gyration_validation::{Case, Experiment, largest};
use std::f64::consts::{FRAC_PI_2, TAU};

const GRAVITY: f64 = 9.81;
const TIGHT: &str = "solver = { rtol = 1e-12, atol = 1e-14 }\n";

/// A rod of a mass \[kg\] and a length \[m\] about its centre, along z.
fn rod(mass: f64, length: f64) -> String {
    let along = mass * length * length / 12.0;
    format!("mass_properties = {{ mass = {mass}, euler_tensor = [[1e-3, 0, 0], [0, 1e-3, 0], [0, 0, {along:e}]] }}\n")
}

/// The moment of inertia of a rod about its centre, across it \[kg m²\].
fn across(mass: f64, length: f64) -> f64 {
    1e-3 + mass * length * length / 12.0
}

#[test]
fn a_rod_on_a_hinge_swings_with_the_period_of_the_elliptic_integral() {
    const SOURCE: &str = "T = 4√(I/(mgl)) K(sin θ₀/2)";
    let case = Case { row: None, name: "rod on a hinge, released at 2 rad", source: SOURCE };
    let (mass, length, amplitude) = (3.0, 0.8, 2.0_f64);
    let arm = 0.5 * length;
    let center = [-arm * amplitude.sin(), 0.0, -arm * amplitude.cos()];
    let scene = format!(
        "time = {{ end = 1, sample = 1 }}\n{TIGHT}[[body]]\nname = \"rod\"\n{}position = {center:?}\n\
         orientation = {{ axis_angle = {{ axis = [0, 1, 0], angle = {amplitude} }} }}\n\
         [[joint]]\nname = \"pivot\"\nbetween = [\"space\", \"rod\"]\nkind = \"hinge\"\naxis = [0, 1, 0]\n\
         points = [[0, 0, 0], [0, 0, {arm}]]\n",
        rod(mass, length)
    );
    let (inertia, moment) = (across(mass, length) + mass * arm * arm, mass * GRAVITY * arm);
    // K by the arithmetic-geometric mean.
    let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
    for _ in 0..40 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    let reference = TAU * (inertia / moment).sqrt() / a;
    let experiment = Experiment::of_scene(&scene);
    let run = experiment.until(reference).run();
    let rate = run.end.motion(&experiment.model, 0).angular_velocity().y;
    // There θ̇ ≈ θ̈ (t − T), with θ̈ = −(mgl/I) sin θ₀.
    case.check("period [s]", reference, reference + rate * inertia / (moment * amplitude.sin()), 1e-10);
    let long = experiment.until(60.0).sampled(0.1).run();
    let angle = long.column("joint.pivot.angle");
    assert!((angle[0] - amplitude).abs() < 1e-15, "{}", angle[0]);
    let force = ["x", "y", "z"].map(|axis| long.column(&format!("joint.pivot.f{axis}")));
    let [x, z] = ["x", "z"].map(|axis| long.column(&format!("rod.{axis}")));
    let off = largest(x.iter().zip(&z).map(|(x, z)| x.hypot(*z) / arm - 1.0));
    case.by("the joint").check("largest error of the joint over 60 s, of the arm", 0.0, off, 1e-15);
    case.by("the plane").check(
        "largest force along the axis over the weight",
        0.0,
        largest(force[1].iter().copied()) / (mass * GRAVITY),
        1e-14,
    );
    // On space: along the rod m (g cos θ + ω² l), across it m g sin θ (1 − m l²/I).
    let error = (0..angle.len()).map(|k| {
        let (sin, cos) = angle[k].sin_cos();
        let speed = 2.0 * moment * (cos - amplitude.cos()) / inertia;
        let pull = mass * (GRAVITY * cos + speed * arm);
        let push = mass * GRAVITY * sin * (1.0 - mass * arm * arm / inertia);
        // The rod points down along (−sin θ, −cos θ), its centre turns towards (−cos θ, sin θ).
        let [fx, fz] = [-pull * sin + push * cos, -pull * cos - push * sin];
        (force[0][k] - fx).hypot(force[2][k] - fz)
    });
    case.by("m (g cos θ + ω²l), m g sin θ (1 − ml²/I)").check(
        "largest error of the force [N]",
        0.0,
        largest(error),
        1e-8,
    );
    case.by("the ledger").check("residual over the energy in play", 0.0, long.relative_residual(), 1e-9);
}

/// Two rods one below the other: θ₁, θ₂ from the vertical and their rates.
struct DoublePendulum {
    masses: [f64; 2],
    inertias: [f64; 2],
    /// Pivot to centre of each, pivot to pivot \[m\].
    arms: [f64; 2],
    length: f64,
}

impl Equations<4> for DoublePendulum {
    fn rates(&self, y: &[f64; 4]) -> Option<[f64; 4]> {
        let [one, other, first, second] = *y;
        let ([m1, m2], [a1, a2], l) = (self.masses, self.arms, self.length);
        let (sin, cos) = (one - other).sin_cos();
        let matrix = [
            [self.inertias[0] + m1 * a1 * a1 + m2 * l * l, m2 * l * a2 * cos],
            [m2 * l * a2 * cos, self.inertias[1] + m2 * a2 * a2],
        ];
        let right = [
            -m2 * l * a2 * sin * second * second - GRAVITY * (m1 * a1 + m2 * l) * one.sin(),
            m2 * l * a2 * sin * first * first - m2 * GRAVITY * a2 * other.sin(),
        ];
        let determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
        let solved = [
            (right[0] * matrix[1][1] - right[1] * matrix[0][1]) / determinant,
            (right[1] * matrix[0][0] - right[0] * matrix[1][0]) / determinant,
        ];
        Some([first, second, solved[0], solved[1]])
    }

    fn scale(&self, _: usize) -> f64 {
        1.0
    }
}

#[test]
fn a_double_pendulum_moves_as_its_reduced_equations_do() {
    let (masses, lengths, angles) = ([1.0, 0.7], [0.5, 0.4], [2.0_f64, 1.2_f64]);
    let arms = lengths.map(|length| 0.5 * length);
    let equations =
        DoublePendulum { masses, inertias: [0, 1].map(|k| across(masses[k], lengths[k])), arms, length: lengths[0] };
    let ends: Vec<f64> = (0..=6).map(|k| 0.5 * f64::from(k)).collect();
    let reference = integrate(&equations, &[angles[0], angles[1], 0.0, 0.0], &ends, 1e-14);
    // A turn by −θ about y takes the rod from below to (sin θ, −cos θ).
    let down = |angle: f64| [angle.sin(), -angle.cos()];
    let [first, second] = angles.map(down);
    let centers = [
        [arms[0] * first[0], 0.0, arms[0] * first[1]],
        [lengths[0] * first[0] + arms[1] * second[0], 0.0, lengths[0] * first[1] + arms[1] * second[1]],
    ];
    let body = |k: usize| {
        format!(
            "[[body]]\nname = \"{k}\"\n{}position = {:?}\n\
             orientation = {{ axis_angle = {{ axis = [0, -1, 0], angle = {} }} }}\n",
            rod(masses[k], lengths[k]),
            centers[k],
            angles[k]
        )
    };
    let scene = |solver: &str, second: &str| {
        format!(
            "time = {{ end = 3, sample = 0.5 }}\n{solver}{}{}[[joint]]\nname = \"upper\"\n\
             between = [\"0\", \"space\"]\n\
             kind = \"hinge\"\naxis = [0, 1, 0]\npoints = [[0, 0, {}], [0, 0, 0]]\n[[joint]]\nname = \"lower\"\n\
             between = [\"0\", \"1\"]\n{second}points = [[0, 0, {}], [0, 0, {}]]\n",
            body(0),
            body(1),
            arms[0],
            -arms[0],
            arms[1]
        )
    };
    let hinge = "kind = \"hinge\"\naxis = [0, 1, 0]\n";
    let cases = [
        ("double pendulum of two hinges", TIGHT, hinge, 1e-9),
        ("double pendulum of a hinge and a ball", TIGHT, "kind = \"ball\"\n", 1e-9),
        // Seven stages of order 13 at their tightest.
        (
            "double pendulum by the implicit method",
            "solver = { rtol = 1e-10, atol = 1e-12, method = \"implicit\" }\n",
            hinge,
            1e-7,
        ),
    ];
    for (name, solver, second, tolerance) in cases {
        let case = Case { row: None, name, source: "Lagrange's equations of the two angles, by extrapolation" };
        let run = Experiment::of_scene(&scene(solver, second)).run();
        let angle = |k: usize, row: usize| {
            let [x, z] = ["P_xz", "P_zz"].map(|entry| run.column(&format!("{k}.{entry}"))[row]);
            (-x).atan2(z)
        };
        let error = (0..ends.len()).flat_map(|row| {
            [0, 1].map(|k| (angle(k, row) - reference[row][k] + FRAC_PI_2 * 2.0).rem_euclid(TAU) - FRAC_PI_2 * 2.0)
        });
        case.check("largest error of the angles over 3 s [rad]", 0.0, largest(error), tolerance);
        case.by("the ledger").check(
            "residual over the energy in play",
            0.0,
            run.relative_residual(),
            100.0 * tolerance,
        );
    }
}

/// A gyroscope in two rings, centres at rest: θ, its rate, ψ, φ; p_ψ and p_φ are constant.
struct Gimbals {
    outer: f64,
    /// About the axis of the outer, along the nodes, about the axis of the rotor.
    inner: [f64; 3],
    /// Across and along its axis.
    rotor: [f64; 2],
    momenta: [f64; 2],
}

impl Gimbals {
    /// About the vertical, at the inclination θ, and its derivative.
    fn vertical(&self, angle: f64) -> [f64; 2] {
        let (sin, cos) = angle.sin_cos();
        let [across, along] = [self.inner[1] + self.rotor[0], self.inner[2]];
        [self.outer + across * sin * sin + along * cos * cos, 2.0 * (across - along) * sin * cos]
    }
}

impl Equations<4> for Gimbals {
    fn rates(&self, y: &[f64; 4]) -> Option<[f64; 4]> {
        let [angle, rate, ..] = *y;
        let (sin, cos) = angle.sin_cos();
        let [vertical, spin] = self.momenta;
        let [inertia, change] = self.vertical(angle);
        let turn = (vertical - spin * cos) / inertia;
        let acceleration = (0.5 * turn * turn * change - spin * turn * sin) / (self.inner[0] + self.rotor[0]);
        Some([rate, acceleration, turn, spin / self.rotor[1] - turn * cos])
    }

    fn scale(&self, _: usize) -> f64 {
        1.0
    }
}

#[test]
fn a_gyroscope_in_gimbals_moves_as_its_reduced_equations_do() {
    let case = Case {
        row: None,
        name: "gyroscope in two rings, 40 rad/s",
        source: "Lagrange's equations of θ with p_ψ, p_φ constant, by extrapolation",
    };
    // Principal moments [kg m²], about x y z of each body.
    let (outer, inner, rotor) = ([2e-3, 3e-3, 4e-3], [1e-3, 2.2e-3, 1.5e-3], [6e-4, 6e-4, 1e-3]);
    let (tilt, rates) = (0.9_f64, [3.0, 2.0, 40.0]);
    let (sin, cos) = tilt.sin_cos();
    let spin = rotor[2] * (rates[2] + rates[1] * cos);
    let mut gimbals = Gimbals { outer: outer[2], inner, rotor: [rotor[0], rotor[2]], momenta: [0.0, spin] };
    gimbals.momenta[0] = gimbals.vertical(tilt)[0] * rates[1] + spin * cos;
    let ends: Vec<f64> = (0..=4).map(|k| 0.5 * f64::from(k)).collect();
    let reference = integrate(&gimbals, &[tilt, rates[0], 0.0, 0.0], &ends, 1e-14);
    // The outer turns about z by ψ, the inner on it about its x by θ, the rotor on that about its z by φ.
    let body = |name: &str, moments: [f64; 3], turned: &str, spin: [f64; 3]| {
        let [x, y, z] = moments;
        let half = 0.5 * (x + y + z);
        format!(
            "[[body]]\nname = \"{name}\"\n\
             mass_properties = {{ mass = 1, euler_tensor = [[{:e}, 0, 0], [0, {:e}, 0], [0, 0, {:e}]] }}\n\
             {turned}angular_velocity = {spin:?}\n",
            half - x,
            half - y,
            half - z
        )
    };
    let turned = format!("orientation = {{ axis_angle = {{ axis = [1, 0, 0], angle = {tilt} }} }}\n");
    let of_inner = [rates[0], 0.0, rates[1]];
    // The rotor's axis is (0, −sin θ, cos θ).
    let of_rotor = [rates[0], -sin * rates[2], rates[1] + cos * rates[2]];
    let joint = |name: &str, between: [&str; 2], axis: [f64; 3]| {
        format!("[[joint]]\nname = \"{name}\"\nbetween = {between:?}\nkind = \"hinge\"\naxis = {axis:?}\n")
    };
    let scene = format!(
        "time = {{ end = 2, sample = 0.5 }}\n{TIGHT}{}{}{}{}{}{}",
        body("outer", outer, "", [0.0, 0.0, rates[1]]),
        body("inner", inner, &turned, of_inner),
        body("rotor", rotor, &turned, of_rotor),
        joint("vertical", ["space", "outer"], [0.0, 0.0, 1.0]),
        joint("nodes", ["outer", "inner"], [1.0, 0.0, 0.0]),
        joint("axle", ["inner", "rotor"], [0.0, 0.0, 1.0]),
    );
    let run = Experiment::of_scene(&scene).run();
    let angles = ["nodes", "vertical", "axle"].map(|name| run.column(&format!("joint.{name}.angle")));
    let error = |k: usize, place: usize| {
        let of = |row: usize| (angles[k][row] - reference[row][place] + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
        largest((0..ends.len()).map(of))
    };
    case.check("largest error of the inclination over 2 s [rad]", 0.0, error(0, 0), 1e-9);
    case.check("largest error of the precession over 2 s [rad]", 0.0, error(1, 2), 1e-9);
    case.check("largest error of the spin over 2 s [rad]", 0.0, error(2, 3), 1e-9);
    case.by("the ledger").check("residual over the energy in play", 0.0, run.relative_residual(), 1e-9);
}
