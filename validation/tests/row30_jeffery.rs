//! Row 30: a rigid spheroid of aspect ratio r in a simple shear u = γ̇ y e_x, and scene `jeffery`.
//!
//!   T = (2π/γ̇)(r + 1/r),   φ̇ = −γ̇ (r² sin²φ + cos²φ)/(r² + 1),  φ from the flow;   tan θ √(r² cos²φ' + sin²φ') = C r
//!
//! with θ from the vorticity and φ' from the gradient: C is kept. Source: Jeffery, *Proc. R. Soc. A* 102 (1922) 161.

use gyration_validation::{Case, Experiment, largest};
use std::f64::consts::{PI, TAU};

const RATE: f64 = 2.0;

/// A spheroid about the x axis, turned about z by φ and before that about y by a tilt [rad], without inertia; the
/// solver as it is by default.
fn grain(r: f64, tilt: f64, phi: f64, end: f64) -> Experiment {
    Experiment::of_scene(&format!(
        r#"
        time = {{ end = {end}, sample = {end} }}
        fluid = {{ viscosity = 0.8, density = 1000, velocity_gradient = [[0, {RATE}, 0], [0, 0, 0], [0, 0, 0]] }}
        [[body]]
        name = "grain"
        shape = {{ ellipsoid = {{ semi_axes = [{}, 1e-3, 1e-3] }} }}
        density = 1000
        orientation = {{ euler_xyz = [0, {tilt}, {phi}] }}
        inclusion = {{ inertia = false }}
        "#,
        r * 1e-3
    ))
}

fn period(r: f64) -> f64 {
    TAU / RATE * (r + 1.0 / r)
}

#[test]
fn grains_tumble_with_jefferys_period() {
    let cases = [
        ("prolate grain, r = 3", 3.0),
        ("oblate grain, r = 0.2", 0.2),
        ("fibre, r = 20", 20.0),
        ("near-sphere, r = 1.001", 1.001),
    ];
    for (name, r) in cases {
        let case = Case { row: Some(30), name, source: "T = (2π/γ̇)(r + 1/r)" };
        // Across the flow a rod turns fastest and a disc slowest: the instant of either is sharp where the other one is
        // not.
        let phi = if r > 1.0 { 0.5 * PI } else { 0.0 };
        let start = grain(r, 0.0, phi, 1.0);
        // The way across the direction of the start, whose first return is after half a period.
        let across = |gradient: &gyration::tensor::Mat3| -phi.sin() * gradient[(0, 0)] + phi.cos() * gradient[(1, 0)];
        let found = start.time_when(period(r) * (1.0 + 1e-5), |motion| across(&motion.placement.gradient));
        case.check("period [s]", period(r), found, 1e-7);
        let half = start.time_when(0.5 * period(r) * (1.0 + 1e-5), |motion| across(&motion.placement.gradient));
        case.check("half a period [s]", 0.5 * period(r), half, 1e-7);
    }
}

#[test]
fn grain_turns_at_jefferys_rate() {
    let r = 4.0;
    let run = grain(r, 0.0, 0.3, period(r)).sampled(period(r) / 200.0).run();
    let errors = run.matrices("placement_gradient").into_iter().zip(run.matrices("gradient_rate")).map(|(p, rate)| {
        let (cosine, sine) = (p[(0, 0)], p[(1, 0)]);
        let turning = cosine * rate[(1, 0)] - sine * rate[(0, 0)];
        let known = -RATE * (r * r * sine * sine + cosine * cosine) / (r * r + 1.0);
        turning / known - 1.0
    });
    let case = Case { row: Some(30), name: "prolate grain, r = 4", source: "−γ̇(r² sin²φ + cos²φ)/(r² + 1)" };
    case.check("largest relative error of φ̇ over a period", 0.0, largest(errors), 1e-12);
}

/// C/(1 + C) of an axis.
fn orbit(r: f64, axis: &[f64; 3]) -> f64 {
    let plane = (axis[1]).hypot(axis[0] / r);
    plane / (plane + axis[2].abs())
}

#[test]
fn askew_grains_come_back_and_keep_their_orbit() {
    for (name, r) in [("prolate grain askew, r = 3", 3.0), ("oblate grain askew, r = 0.2", 0.2)] {
        let case = Case { row: Some(30), name, source: "Jeffery 1922: closed orbits" };
        let periods = 5.0;
        let run = grain(r, 0.7, 0.4, periods * period(r)).sampled(period(r) / 40.0).run();
        let placements = run.matrices("placement_gradient");
        let first = placements[0].column(0).into_owned();
        let last = placements[placements.len() - 1].column(0).into_owned();
        // A run keeps 1e-8 of an angle; a fibre is swept past its slow place with r² times the error.
        case.check("distance of the axis from its start after five periods", 0.0, (last - first).norm(), 1e-6);
        let start = orbit(r, &[first.x, first.y, first.z]);
        let kept = run.scalars_of(0, "orbit_constant").into_iter().map(|value| value / start - 1.0);
        case.check("largest change of the orbit constant over five periods, relative", 0.0, largest(kept), 1e-7);
    }
}

#[test]
fn orbit_does_not_drift_in_a_thousand_periods() {
    let scene = Experiment::of_gallery("jeffery", &[]);
    let span = 1000.0 * TAU * (3.0 + 1.0 / 3.0);
    let run = scene.until(span).sampled(span / 100.0).run();
    let values = run.scalars_of(0, "orbit_constant");
    let case =
        Case { row: Some(30), name: "scene jeffery over a thousand periods", source: "Jeffery 1922: closed orbits" };
    // 1e-8 a period, if all errors had one sign.
    case.check(
        "largest change of the orbit constant, relative",
        0.0,
        largest(values.iter().map(|v| v / values[0] - 1.0)),
        1e-5,
    );
}
