//! The gallery's `settle`, `tumble-tremble` and `swimmer`: bodies without inertia in a viscous fluid.
//!
//!   settle      U = Δm g (cos α p/ζ_∥ + …):  a tilted spheroid drifts by the angle β, tan β = (ζ_⊥ − ζ_∥) sin α cos α/(ζ_⊥ cos² α + ζ_∥ sin² α)
//!   tumble      the form's section in the plane of the shear, q = Q_xx − Q_zz + 2i Q_xz, goes round 0 or does not
//!   swim        a ball strained in its plane by ε that goes round once turns by −2π ε²/(1 + ε²); to and fro, by nothing
//!
//! The last: P = R U, U = I + ε e; skw L = Ṙ Rᵀ − ωε²/(1 − ε²), sym L = εω/(1 − ε²) across the axes, of which a body
//! without couple has skw L = (a² − b²)/(a² + b²) sym L = 2ε/(1 + ε²) sym L (Jeffery, in a fluid at rest). The third
//! axis does not count.

use crate::independent::Equations as _;
use crate::independent::inclusion::{Particle, directions};
use crate::independent::integrate;
use gyration::tensor::{Mat3, Vec3};
use gyration_validation::{Case, Experiment, Turning, largest, passage, threshold};
use std::f64::consts::{PI, TAU};

/// Drag along and across the axis of a spheroid, 6πη times the radius of its equator: Happel and Brenner, §5-11.
fn drags(r: f64) -> [f64; 2] {
    if r > 1.0 {
        let e = (1.0 - 1.0 / (r * r)).sqrt();
        let log = ((1.0 + e) / (1.0 - e)).ln();
        let along = 8.0 / 3.0 * r * e.powi(3) / ((1.0 + e * e) * log - 2.0 * e);
        [along, 16.0 / 3.0 * r * e.powi(3) / (2.0 * e + (3.0 * e * e - 1.0) * log)]
    } else {
        let e = (1.0 - r * r).sqrt();
        let along = 4.0 / 3.0 * e.powi(3) / ((2.0 * e * e - 1.0) * e.asin() + e * r);
        [along, 8.0 / 3.0 * e.powi(3) / ((2.0 * e * e + 1.0) * e.asin() - e * r)]
    }
}

#[test]
fn tilted_bodies_drift_as_their_two_drags_say() {
    let experiment = Experiment::of_gallery("settle", &[]).until(5.0);
    let run = experiment.run();
    let volume = 4.0 / 3.0 * PI * 8e-9;
    let weight = 1340.0 * volume * 9.81;
    let rod_radius = 1.264_911_064_067_351_8e-3;
    let disc_radius = 3.651_483_716_701_107_4e-3;
    // Both axes are tilted by 45° from the vertical.
    let cases = [
        (1, "scene settle, the rod", rod_radius, 5e-3 / rod_radius, Vec3::new(1.0, 0.0, 0.0)),
        (2, "scene settle, the disc", disc_radius, 0.6e-3 / disc_radius, Vec3::new(0.0, 0.0, 1.0)),
    ];
    for (body, name, radius, ratio, axis) in cases {
        let case = Case { row: None, name, source: "Happel and Brenner, §5-11: drags of a spheroid" };
        let [along, across] = drags(ratio).map(|drag| 6.0 * PI * 1.4 * radius * drag);
        let orientation = experiment.start.motion(&experiment.model, body).placement.gradient;
        let axis = orientation * axis;
        let down = Vec3::new(0.0, 0.0, -weight);
        let velocity = axis * axis.dot(&down) / along + (down - axis * axis.dot(&down)) / across;
        let end = run.end.motion(&experiment.model, body).placement;
        let way = (end.position - experiment.start.motion(&experiment.model, body).placement.position) / 5.0;
        case.check("velocity of sinking [m/s]", -velocity.z, -way.z, 1e-10);
        case.check("velocity of drifting [m/s]", velocity.x, way.x, 1e-10);
        let drift = |v: &Vec3| (v.x / -v.z).atan().to_degrees();
        case.check("angle of the way from the vertical [°]", drift(&velocity), drift(&way), 1e-10);
        case.by("no couple").check(
            "largest change of P over 5 s",
            0.0,
            largest((end.gradient - orientation).iter().copied()),
            1e-12,
        );
    }
}

/// The passage by the equations once more.
fn passage_apart(ratio: f64, capillary: f64) -> f64 {
    let span = 1.3 * TAU * (ratio + 1.0 / ratio);
    let flow = [[0.0, 0.0, 1.0], [0.0; 3], [0.0; 3]];
    let sphere = directions(20, 20);
    let particle = Particle { axes: [ratio, 1.0, 1.0], shear: 1.0 / capillary, viscosity: 1.0, flow, sphere };
    let times: Vec<f64> = (0..=200).map(|k| span * f64::from(k) / 200.0).collect();
    let numbers = integrate(&particle, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], &times, 1e-9);
    let rates = numbers.iter().filter_map(|y| particle.rates(y)).map(|rate| Mat3::from_row_slice(&rate)).collect();
    let placements = numbers.iter().map(|y| Mat3::from_row_slice(y)).collect();
    let squares = Mat3::from_diagonal(&Vec3::new(ratio * ratio, 1.0, 1.0));
    Turning { times, placements, rates }.passage(&squares).unwrap_or(f64::NAN)
}

#[test]
fn threshold_of_tumbling_is_that_of_the_equations_once_more() {
    let case = Case {
        row: None,
        name: "prolate neo-Hookean particle in shear, r = 2",
        source: "the equations once more, by extrapolation",
    };
    let found = threshold(|capillary| passage(2.0, capillary), 0.25, 0.3);
    let apart = threshold(|capillary| passage_apart(2.0, capillary), 0.99 * found, 1.01 * found);
    // Cubics between samples of 0.1 shear units err by 1e-6.
    case.check("ηγ̇/μ_s between tumbling and trembling", apart, found, 1e-5);
}

#[test]
fn threshold_of_a_nearly_round_particle_is_that_of_small_strains() {
    let case =
        Case { row: None, name: "prolate neo-Hookean particle in shear, r → 1", source: "5G/4 = (r − 1)/(r + 1)" };
    let reduced = |ratio: f64| {
        let small = 0.8 * (ratio - 1.0) / (ratio + 1.0);
        threshold(|capillary| passage(ratio, capillary), 0.9 * small, 1.1 * small) / small
    };
    // In the first order of r − 1; the second leaves 1e-4.
    let (coarse, fine) = (reduced(1.04), reduced(1.02));
    case.check("threshold over 4(r − 1)/(5(r + 1))", 1.0, 2.0 * fine - coarse, 5e-4);
}

#[test]
fn stiff_body_of_the_scene_tumbles_and_soft_one_trembles() {
    let run = Experiment::of_gallery("tumble-tremble", &[]).run();
    let whole = |body: usize| {
        let angles = run.scalars_of(body, "inclination");
        // By half turns: an axis has no head.
        angles.windows(2).map(|pair| (pair[1] - pair[0]) - PI * ((pair[1] - pair[0]) / PI).round()).sum::<f64>() / TAU
    };
    let material = |body: usize| {
        let angle = |p: &Mat3| (p[(0, 2)] - p[(2, 0)]).atan2(p[(0, 0)] + p[(2, 2)]);
        let placements = run.matrices_of(body, "placement_gradient");
        placements
            .windows(2)
            .map(|pair| {
                let change = angle(&pair[1]) - angle(&pair[0]);
                change - TAU * (change / TAU).round()
            })
            .sum::<f64>()
            / TAU
    };
    assert!(whole(0) < -1.5 && whole(1).abs() < 0.25, "{} {}", whole(0), whole(1));
    assert!(material(0) > 1.5 && material(1) > 1.0, "{} {}", material(0), material(1));
}

/// Amplitude matrix of a muscle along (cos φ, 0, sin φ).
fn muscle(amplitude: f64, degrees: f64) -> Mat3 {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let along = Vec3::new(cosine, 0.0, sine);
    amplitude * along * along.transpose()
}

/// The first body of the scene, its three muscles with these phases [°], as a ball of this modulus if one is given.
fn swimming(amplitude: f64, phases: [f64; 3], ball: Option<f64>) -> Experiment {
    let part = |k: usize| {
        let m = muscle(amplitude, 60.0 * k as f64);
        let row = |i: usize| format!("[{:e}, {:e}, {:e}]", m[(i, 0)], m[(i, 1)], m[(i, 2)]);
        let matrix = format!("[{}, {}, {}]", row(0), row(1), row(2));
        format!("{{ sine = {{ amplitude = {matrix}, frequency = 1, phase = {:e} }} }}", phases[k].to_radians())
    };
    let one = "{ constant = { value = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] } }";
    let stroke =
        format!("body.three.contractile.prescribed={{ sum = [{one}, {}, {}, {}] }}", part(0), part(1), part(2));
    let mut overrides = vec![stroke];
    if let Some(shear) = ball {
        overrides.push("body.three.shape={ sphere = { radius = 0.004 } }".into());
        overrides.push(format!("body.three.contractile.material.neo_hookean.shear={shear:e}"));
    }
    let overrides: Vec<&str> = overrides.iter().map(String::as_str).collect();
    Experiment::of_gallery("swimmer", &overrides)
}

/// The turn of a body in its plane [rad] between two seconds, and how far it has gone [m].
fn turn(experiment: &Experiment, body: usize) -> (f64, f64) {
    let run = experiment.until(2.0).sampled(1.0).run();
    let placements = run.matrices_of(body, "placement_gradient");
    // A whole number of strokes after the first, with which the elastic stress has settled.
    let change = placements[2] * placements[1].try_inverse().unwrap_or_else(Mat3::zeros);
    let angle = (change[(0, 2)] - change[(2, 0)]).atan2(change[(0, 0)] + change[(2, 2)]);
    let start = experiment.start.motion(&experiment.model, body).placement.position;
    (angle, (run.end.motion(&experiment.model, body).placement.position - start).norm())
}

const IN_TURN: [f64; 3] = [0.0, 120.0, 240.0];

#[test]
fn three_phases_turn_a_ball_as_the_closed_form_says() {
    let case = Case {
        row: None,
        name: "scene swimmer as a ball, ε = ¾ of the amplitude of a muscle",
        source: "2π ε²/(1 + ε²), body without couple",
    };
    for (quantity, amplitude) in [("turn a stroke, ε = 0.3 [rad]", 0.4), ("turn a stroke, ε = 0.03 [rad]", 0.04)] {
        let strain: f64 = 0.75 * amplitude;
        let known = TAU * strain * strain / (1.0 + strain * strain);
        // What elasticity yields is of the order of ηω/μ_s, and of its square.
        let at = |shear: f64| turn(&swimming(amplitude, IN_TURN, Some(shear)), 0).0;
        let (coarse, fine) = (at(2e3), at(4e3));
        case.check(quantity, known, (2.0 * fine - coarse).abs(), 1e-6);
    }
    let there = turn(&swimming(0.4, IN_TURN, Some(1e3)), 0).0;
    let back = turn(&swimming(0.4, [240.0, 120.0, 0.0], Some(1e3)), 0).0;
    case.by("the other order of phases").check(
        "turn there and back, over the turn there",
        0.0,
        (there + back) / there,
        1e-7,
    );
}

#[test]
fn a_stroke_that_goes_back_its_way_turns_nothing() {
    let case = Case { row: None, name: "scene swimmer, strokes with one phase", source: "scallop theorem" };
    // A soft body lags behind its muscle, and goes back another way: by ηω/μ_s of a turn.
    let oblique = |shear: f64| {
        let modulus = format!("body.one.contractile.material.neo_hookean.shear={shear:e}");
        turn(&Experiment::of_gallery("swimmer", &[&modulus]), 1).0
    };
    case.check("turn a stroke of one muscle, stiff limit [rad]", 0.0, 2.0 * oblique(1.6e4) - oblique(8e3), 1e-9);
    case.check("turn a stroke of all three at once [rad]", 0.0, turn(&swimming(0.3, [0.0; 3], None), 0).0, 1e-9);
    let (ball, _) = turn(&swimming(0.3, [0.0; 3], Some(1e3)), 0);
    case.by("symmetry").check("turn a stroke of all three of a soft ball [rad]", 0.0, ball, 1e-9);
    // Two phases are enough.
    let scene = Experiment::of_gallery("swimmer", &[]);
    let ((three, gone), (_, other)) = (turn(&scene, 0), turn(&scene, 1));
    assert!(three.abs() > 0.1 && turn(&swimming(0.3, [0.0, 90.0, 180.0], None), 0).0.abs() > 0.01, "{three}");
    case.by("symmetry about the centre").check("way of either body in two strokes [m]", 0.0, gone.max(other), 1e-12);
}
