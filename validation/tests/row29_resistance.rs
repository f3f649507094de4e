//! Row 29: what slow flow does to spheres and ellipsoids, in runs of whole bodies and below the scene.
//!
//!   drag 6πηRU,   couple 8πηR³Ω,   stress 5ηE of a sphere held in a strain,   −4ηṘ/R of one that grows
//!   spheroids: Happel and Brenner §4-26, Lamb §339;   any ellipsoid: Carlson's R_F and R_D, and averages over a sphere (`independent`)

use crate::independent::inclusion::{Averages, carlson_d, carlson_f, stress};
use gyration::fluid::FluidEllipsoid;
use gyration::tensor::{Mat3, Vec3};
use gyration_validation::{Case, Experiment, largest};
use std::f64::consts::PI;

const VISCOSITY: f64 = 1.3;
const RADIUS: f64 = 0.02;

/// A ball in the fluid; the flow is a strain along with a shear where it is not still.
fn ball(end: f64, flow: &str, body: &str) -> Experiment {
    Experiment::of_scene(&format!(
        r#"
        world = {{ gravity = [0, 0, -9.81] }}
        time = {{ end = {end}, sample = {end} }}
        fluid = {{ viscosity = {VISCOSITY}, density = 900, {flow} }}
        [[body]]
        name = "ball"
        shape = {{ sphere = {{ radius = {RADIUS} }} }}
        {body}
        "#
    ))
}

#[test]
fn ball_sinks_stops_and_ceases_to_spin_as_stokes_says() {
    let case = Case { row: Some(29), name: "sphere in a fluid, R = 20 mm, η = 1.3 Pa s", source: "6πηR" };
    // Velocities of a body without inertia are in the rows: its state has none.
    let velocity = ball(1.0, "", "density = 1100\ninclusion = { inertia = false }").run().column("ball.vz")[1];
    let known = -2.0 / 9.0 * 200.0 * 9.81 * RADIUS * RADIUS / VISCOSITY;
    case.by("2(ρ_p − ρ_f)gR²/(9η)").check("velocity of sinking without inertia [m/s]", known, velocity, 1e-12);
    let volume = 4.0 / 3.0 * PI * RADIUS.powi(3);
    let moving = "density = 900\nvelocity = [0.2, 0, 0]\nangular_velocity = [0, 0, 7]\ninclusion = {}";
    let end = ball(0.1, "", moving).motion_at(0.1).velocity;
    let mass = 900.0 * volume;
    let slowed = 0.2 * (-6.0 * PI * VISCOSITY * RADIUS / mass * 0.1).exp();
    // A run keeps 1e-8 of the velocity at the start, of which a fifth is left.
    case.check("velocity after 0.1 s, with inertia [m/s]", slowed, end.velocity.x, 1e-6);
    let spin = 7.0 * (-8.0 * PI * VISCOSITY * RADIUS.powi(3) / (0.4 * mass * RADIUS * RADIUS) * 0.1).exp();
    let run = ball(0.1, "", moving).run();
    let couple = run.vectors_of(0, "rotlet");
    let first = -8.0 * PI * VISCOSITY * RADIUS.powi(3) * 7.0;
    case.by("8πηR³").check("couple at the start [N m]", first, couple[0].z, 1e-12);
    let last = -8.0 * PI * VISCOSITY * RADIUS.powi(3) * spin;
    // After five decay times: a run keeps 1e-8 of the start.
    case.by("8πηR³").check("couple after 0.1 s, over that at the start", last / first, couple[1].z / first, 1e-6);
}

#[test]
fn held_and_growing_balls_feel_the_stresses_of_the_books() {
    let flow = "velocity_gradient = [[0.3, 1, 0], [0.2, -0.5, 0.4], [0, 0.6, 0.2]]";
    let strain = Mat3::new(0.3, 0.6, 0.0, 0.6, -0.5, 0.5, 0.0, 0.5, 0.2);
    let held = ball(1.0, flow, "density = 900\ninclusion = { inertia = false }").run();
    let case = Case { row: Some(29), name: "rigid sphere free in a linear flow", source: "σ = 5ηE" };
    let found = held.matrices_of(0, "particle_stress")[0];
    let difference = (found - strain * 5.0 * VISCOSITY).norm() / (5.0 * VISCOSITY * strain.norm());
    case.check("largest error of the particle stress, over its size", 0.0, difference, 1e-13);
    case.by("Einstein 1906").check("intrinsic viscosity", 2.5, held.scalars_of(0, "intrinsic_viscosity")[0], 1e-13);
    let grows = "density = 900\naffine = {}\ngradient_rate = [[2, 0, 0], [0, 2, 0], [0, 0, 2]]\ninclusion = {}";
    let run = ball(0.05, "", grows).run();
    let case = Case { row: Some(29), name: "free sphere set growing at 2 /s", source: "−4ηṘ/R" };
    // N/V − 2η L of L = 2 I.
    let [start, _] = [0, 1].map(|k| run.matrices_of(0, "particle_stress")[k]);
    case.check("particle stress at the start [Pa]", -12.0 * VISCOSITY, start[(1, 1)], 1e-13);
    // j g̈ = −4ηV g ġ: ġ + k g² = c, k = 2ηV/j, j = mR²/5; g = √(c/k) tanh(√(ck) t + atanh √(k/c)) for c > k.
    let rate = 2.0 * VISCOSITY * 5.0 / (900.0 * RADIUS * RADIUS);
    let (all, root) = (2.0 + rate, (rate * (2.0 + rate)).sqrt());
    let known = (all / rate).sqrt() * (root * 0.05 + (rate / all).sqrt().atanh()).tanh();
    case.by("ġ + 2(ηV/j)g² const").check("stretch after 0.05 s", known, run.column("ball.P_xx")[1], 1e-7);
}

const FORMS: [(&str, [f64; 3]); 5] = [
    ("ellipsoid 3 : 2 : 1", [3.0, 2.0, 1.0]),
    ("ellipsoid 0.2 : 1 : 5", [0.2, 1.0, 5.0]),
    ("near-sphere 1 : 1 : 1 + 1e-7", [1.0, 1.0, 1.0 + 1e-7]),
    ("needle 1 : 1 : 1000", [1.0, 1.0, 1000.0]),
    ("disc 1 : 1 : 0.001", [1.0, 1.0, 1e-3]),
];

#[test]
fn drag_of_ellipsoids_is_that_of_carlsons_integrals() {
    for (name, axes) in FORMS {
        let case = Case { row: Some(29), name, source: "16πη/(2R_F + ⅔ R_D a_i²), by Carlson's duplication" };
        let [a, b, c] = axes.map(|axis| axis * axis);
        let whole = 2.0 * carlson_f(a, b, c);
        let own = [carlson_d(b, c, a) * a, carlson_d(c, a, b) * b, carlson_d(a, b, c) * c];
        let force = FluidEllipsoid::new(axes, VISCOSITY).force(&Vec3::repeat(1.0));
        let known = own.map(|own| -16.0 * PI * VISCOSITY / (whole + own * 2.0 / 3.0));
        case.check(
            "largest relative error of the drag",
            0.0,
            largest((0..3).map(|k| force[k] / known[k] - 1.0)),
            1e-12,
        );
    }
}

/// Stresses of nine motions in a still fluid, and of eight flows around a body that is held: 17 × 9 numbers.
fn motions() -> Vec<(Mat3, Mat3)> {
    let unit = |k: usize| Mat3::from_fn(|i, j| f64::from(u8::from(3 * i + j == k)));
    let flow = |k: usize| if k.is_multiple_of(4) { unit(k) - unit((k + 4) % 12) } else { unit(k) };
    (0..9).map(|k| (unit(k), Mat3::zeros())).chain((0..8).map(|k| (Mat3::zeros(), flow(k)))).collect()
}

#[test]
fn stress_on_ellipsoids_is_that_of_averages_over_directions() {
    for (name, axes) in FORMS {
        let case = Case { row: Some(29), name, source: "averages over the directions of waves, by Gauss's rule" };
        let (at, body) = (Averages::of_axes(axes), FluidEllipsoid::new(axes, VISCOSITY));
        let errors = motions().into_iter().map(|(gradient, flow)| {
            let rows = |m: &Mat3| [0, 1, 2].map(|i| [m[(i, 0)], m[(i, 1)], m[(i, 2)]]);
            let known = stress(&at, VISCOSITY, &rows(&gradient), &rows(&flow));
            let found = body.stress(&gradient, &flow).total;
            let scale = largest(known.iter().flatten().copied());
            largest((0..9).map(|k| (found[(k / 3, k % 3)] - known[k / 3][k % 3]) / scale))
        });
        // Each motion by its own largest entry.
        case.check("largest error of the stress of 17 motions, over its size", 0.0, largest(errors), 1e-9);
    }
}

/// Drag along and across the axis of a spheroid of axial ratio r, over 6πη times the radius of the equator.
fn spheroid(r: f64) -> [f64; 2] {
    if r > 1.0 {
        let e = (1.0 - 1.0 / (r * r)).sqrt();
        let log = ((1.0 + e) / (1.0 - e)).ln();
        let along = 8.0 / 3.0 * r * e.powi(3) / ((1.0 + e * e) * log - 2.0 * e);
        [along, 16.0 / 3.0 * r * e.powi(3) / (2.0 * e + (3.0 * e * e - 1.0) * log)]
    } else {
        let e = (1.0 - r * r).sqrt();
        let angle = e.asin();
        let along = 4.0 / 3.0 * e.powi(3) / ((2.0 * e * e - 1.0) * angle + e * r);
        [along, 8.0 / 3.0 * e.powi(3) / ((2.0 * e * e + 1.0) * angle - e * r)]
    }
}

#[test]
fn spheroids_sink_askew_as_their_two_drags_say() {
    for (name, r) in [("prolate spheroid, r = 4", 4.0), ("oblate spheroid, r = 0.25", 0.25)] {
        let case = Case { row: Some(29), name, source: "Happel and Brenner, §5-11" };
        let [along, across] = spheroid(r);
        let force = FluidEllipsoid::new([1.0, 1.0, r], VISCOSITY).force(&Vec3::repeat(1.0)) / (-6.0 * PI * VISCOSITY);
        case.check("drag along the axis", along, force.z, 1e-12);
        case.check("drag across the axis", across, force.x, 1e-12);
    }
    // A disc: 16ηR along its axis, 32/3 ηR across; a needle: half as much along as across, but for logarithms.
    let disc = FluidEllipsoid::new([1.0, 1.0, 1e-9], VISCOSITY).force(&Vec3::repeat(1.0)) / -VISCOSITY;
    let case = Case { row: Some(29), name: "disc 1 : 1 : 1e-9", source: "16ηR and 32ηR/3" };
    case.check("drag along the axis", 16.0, disc.z, 1e-8);
    case.check("drag across the axis", 32.0 / 3.0, disc.x, 1e-8);
}
