//! The gallery's `ball-on-ball`, `turntable`, `drum` and `stair`: bodies at supports with a shape.

use gyration_sim::events::LIFT_OFF;
use gyration_validation::{Case, Experiment, largest};
use std::f64::consts::{PI, TAU};

const GRAVITY: f64 = 9.81;

#[test]
fn a_ball_that_rolls_leaves_a_fixed_ball_later_than_one_that_slides() {
    let experiment = Experiment::of_gallery("ball-on-ball", &[]);
    let run = experiment.run();
    let (start, weight) = (0.2_f64.cos(), 7800.0 * 4.0 / 3.0 * PI * 0.02_f64.powi(3) * GRAVITY);
    let case =
        Case {
            row: None, name: "gallery: ball-on-ball", source: "mg (3 cosθ − 2 cosθ₀), mg (17 cosθ − 10 cosθ₀)/7"
        };
    let of = |ball: &str, center: f64, pressed: &dyn Fn(f64) -> f64| {
        let [x, z, fx, fz] = ["x", "z", "fx", "fz"].map(|column| run.column(&format!("{ball}.{column}")));
        let off = (0..x.len()).map(|k| {
            let (x, distance) = (x[k] - center, (x[k] - center).hypot(z[k]));
            let cosine = z[k] / distance;
            // Where it lets go a power law does so slowly.
            let counts = cosine > 0.75;
            if counts { ((fx[k] * x + fz[k] * z[k]) / (distance * weight) - pressed(cosine)).abs() } else { 0.0 }
        });
        largest(off)
    };
    let (slides, rolls) = (|c: f64| 3.0 * c - 2.0 * start, |c: f64| (17.0 * c - 10.0 * start) / 7.0);
    case.check("largest error of the force on the one that slides, in weights", 0.0, of("slides", -0.2, &slides), 2e-3);
    case.check("largest error of the force on the one that rolls, in weights", 0.0, of("rolls", 0.2, &rolls), 2e-3);
    let leaves =
        |body: usize| run.events.iter().find(|event| event.body == body && event.kind == LIFT_OFF).unwrap().time;
    assert!(leaves(1) > leaves(0), "{} {}", leaves(1), leaves(0));
    assert!(run.relative_residual() < 1e-7, "{}", run.relative_residual());
}

#[test]
fn balls_on_a_turntable_go_round_at_two_sevenths_of_its_rate() {
    let run = Experiment::of_gallery("turntable", &["solver.rtol=1e-5", "solver.atol=1e-7"]).run();
    let case = Case { row: None, name: "gallery: turntable", source: "2/7 Ω t, Ω = π rad/s, t = 3.5 s" };
    for (quantity, ball, center) in [
        ("angle of the near ball [rad]", "near", 0.0),
        ("angle of the far ball [rad]", "far", 0.0),
        ("angle of the ball aside, about its own centre [rad]", "aside", -0.16),
    ] {
        let [x, y] = ["x", "y"].map(|axis| *run.column(&format!("{ball}.{axis}")).last().unwrap());
        let angle = y.atan2(x - center).rem_euclid(TAU);
        // Damping resists the rolling by some (5/7) c g d/((ν−2) R) = 2e-3 a second, and drives the circles apart.
        case.check(quantity, PI, angle, 2e-2);
    }
}

#[test]
fn a_drum_carries_balls_up_the_side_that_rises() {
    let experiment = Experiment::of_gallery("drum", &[]);
    let run = Experiment::of_gallery("drum", &["solver.rtol=1e-5", "solver.atol=1e-7"]).run();
    let places = |run: &gyration_validation::Run, axis: &str| {
        [0, 1, 2].map(|ball| *run.column(&format!("ball-{ball}.{axis}")).last().unwrap())
    };
    let (x, z) = (places(&run, "x"), places(&run, "z"));
    println!("at {x:.4?}, {z:.4?}");
    // A slope at more than 20° to the left, where this drum rises.
    let (across, down) = (x.iter().sum::<f64>(), z.iter().sum::<f64>());
    assert!((-across).atan2(-down) > 0.35, "{across} {down}");
    // The corners of the drum are at 0.13 m, the balls measure 0.03 m.
    assert!(x.iter().zip(&z).all(|(x, z)| x.hypot(*z) < 0.1), "{x:?} {z:?}");
    assert!(*run.column("work.support").last().unwrap() > 0.0);
    assert!(run.relative_residual() < 1e-7, "{}", run.relative_residual());
    // Turned the other way it does the same to the other side: the start is its own mirror image.
    let short = experiment.until(0.2).run();
    let back = Experiment::of_gallery("drum", &["support.drum.motion.rotate.rate=-20 rpm"]).until(0.2).run();
    let (one, other) = (places(&short, "x"), places(&back, "x"));
    let case = Case { row: None, name: "gallery: drum", source: "the drum turned the other way" };
    let off = largest([one[0] + other[1], one[1] + other[0], one[2] + other[2]]);
    case.check("largest distance of a ball from its mirror image [m]", 0.0, off, 1e-8);
}

#[test]
fn a_stair_takes_the_same_part_of_the_speed_at_every_bounce() {
    let run = Experiment::of_gallery("stair", &[]).run();
    let [x, z, v] = ["x", "z", "vz"].map(|column| run.column(&format!("ball.{column}")));
    // Two samples before and behind the one at which the ball turns upwards it is in flight.
    let parts: Vec<f64> = (2..v.len() - 3)
        .filter(|k| v[*k] < 0.0 && v[k + 1] >= 0.0)
        .map(|k| {
            let step = -0.1 * (x[k] / 0.2).floor() + 0.02;
            let speed = |sample: usize| (v[sample] * v[sample] + 2.0 * GRAVITY * (z[sample] - step)).sqrt();
            speed(k + 3) / speed(k - 2)
        })
        .collect();
    println!("parts of the speed {parts:.4?}");
    assert!(parts.len() >= 3, "{parts:?}");
    let mean = parts.iter().sum::<f64>() / parts.len() as f64;
    let case = Case { row: None, name: "gallery: stair", source: "ν_d = (ν + 2)/2 of a ball: the same at any speed" };
    case.check(
        "largest deviation of a restitution from the mean",
        0.0,
        largest(parts.iter().map(|it| it - mean)),
        5e-3,
    );
    assert!(run.relative_residual() < 1e-7, "{}", run.relative_residual());
}
