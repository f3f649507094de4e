//! Formulas with `abs`, `min` and `max`: where the state goes from one part of them to another, S goes along.

use crate::sensitivities::support::{TIGHT, at_end, close, disagreement, scene, strings};
use gyration_sim::sensitivity::Sensitivities;

/// A ball of a kilogram that flies along x from 0.1 m with 1 m/s.
fn ball(potential: &str) -> String {
    format!(
        r#"
        time = {{ end = 1, sample = 0.5 }}
        world = {{ gravity = [0, 0, 0] }}
        constants = {{ a = 0.3, k = 2 }}
        [[body]]
        name = "ball"
        shape = {{ sphere = {{ radius = 0.05 }} }}
        mass = 1
        position = [0.1, 0, 0]
        velocity = [1, 0, 0]
        potential = "{potential}"
    "#
    )
}

const KEYS: [&str; 4] = ["body.ball.position.0", "body.ball.velocity.0", "constants.a", "constants.k"];

fn compare(found: &Sensitivities, expected: [[f64; 2]; 4], tolerance: f64) {
    for ((key, derivatives), expected) in KEYS.iter().zip(&found.derivatives).zip(expected) {
        let derivatives = derivatives.at_end().unwrap();
        for (value, expected) in derivatives.iter().zip(expected) {
            println!("{key}: {value:.12} {expected:.12} {:.1e}", value - expected);
            assert!((value - expected).abs() < tolerance, "{key}: {value} {expected}");
        }
    }
}

/// Symptom: by the velocity (0.4, 1.0), without a word. The ball flies freely to a at s = (a − x₀)/v, then the force −k
/// brakes it: x = a + v r − k r²/2, r = t − s.
#[test]
fn a_force_that_jumps_takes_neighbours_along() {
    let found = at_end(&scene(&ball("k*max(0, x - a)"), &[]), &KEYS, &["ball.x", "ball.vx"]);
    let (start, v, a, k, t) = (0.1, 1.0, 0.3, 2.0, 1.0);
    let rest = t - (a - start) / v;
    close("x", found.values[0][0], a + v * rest - 0.5 * k * rest * rest, 1e-8);
    let speed = v - k * rest;
    // ∂r by x₀, v, a, k.
    let by = [1.0 / v, (a - start) / (v * v), -1.0 / v, 0.0];
    let expected = [
        [speed * by[0], -k * by[0]],
        [rest + speed * by[1], 1.0 - k * by[1]],
        [1.0 + speed * by[2], -k * by[2]],
        [-0.5 * rest * rest, -rest],
    ];
    // rtol = 1e-8; by a, of a parabola beside the jump.
    compare(&found, expected, 5e-8);
}

/// A cord that holds only when it is taut: x = a + (v/ω) sin ωr. Symptom: six digits.
#[test]
fn a_force_whose_slope_jumps_keeps_its_digits() {
    let found = at_end(&scene(&ball("0.5*k*max(0, x - a)^2"), &[]), &KEYS, &["ball.x", "ball.vx"]);
    let (start, v, a, k, t) = (0.1, 1.0, 0.3, 2.0_f64, 1.0);
    let (rest, omega) = (t - (a - start) / v, k.sqrt());
    let (sin, cos) = (omega * rest).sin_cos();
    close("x", found.values[0][0], a + v / omega * sin, 1e-8);
    let by = [1.0 / v, (a - start) / (v * v), -1.0 / v, 0.0];
    let by_omega = 0.5 / omega;
    let expected = [
        [v * cos * by[0], -v * omega * sin * by[0]],
        [sin / omega + v * cos * by[1], cos - v * omega * sin * by[1]],
        [1.0 + v * cos * by[2], -v * omega * sin * by[2]],
        [by_omega * v * (rest * cos - sin / omega) / omega, -v * rest * sin * by_omega],
    ];
    compare(&found, expected, 5e-8);
}

/// To and fro in V = k|x|, with works and a body that turns: against runs. Symptoms: of passages that the run made in
/// short steps none was seen; powers were differentiated across a jump, so that works had five digits and after 4 s
/// nothing could be followed.
#[test]
fn many_passages_of_a_spinning_box_agree_with_runs() {
    let text = r#"
        time = { end = 7, sample = 1 }
        world = { gravity = [0, 0, 0] }
        constants = { k = 2, w = 0.002 }
        [[body]]
        name = "box"
        shape = { box = { size = [0.3, 0.2, 0.1] } }
        mass = 1.3
        position = [0.4, 0.1, 0]
        velocity = [0.1, 0.2, 0]
        angular_velocity = [1, 0.3, 0.2]
        potential = "k*(1 + 0.1*sin(t))*abs(x) + k*max(y, -0.5*y) + w*abs(P_xy + 0.2)"
    "#;
    let keys = ["body.box.position.0", "body.box.velocity.1", "constants.k", "constants.w", "body.box.mass"];
    let quantities = ["box.x", "box.vy", "box.P_xy", "energy.kinetic", "work.load"];
    let worst = disagreement(text, &strings(&TIGHT), &keys, &quantities, 1e-3);
    // Of a velocity by w, as far as runs of such forces agree; the others 1e-7.
    assert!(worst < 5e-5, "{worst:e}");
}

/// Two balls, alike but for a length, come to walls of their own at one time: whose force jumps first nobody can say.
/// And one that starts at such a wall has neighbours on both sides.
#[test]
fn jumps_without_an_order_leave_no_derivative() {
    let text = ball("2*max(0, x - 0.3)");
    let other = text[text.find("[[body]]").unwrap()..].replace("ball", "other").replace("[0.1, 0, 0]", "[0.1, 3, 0]");
    let together = scene(&format!("{text}{other}"), &[]);
    let lost = |scene, key| at_end(scene, &[key], &["ball.x"]).derivatives[0].lost.clone().unwrap();
    let two = lost(&together, "body.other.velocity.0");
    println!("{two}");
    assert!(two.reason.contains("two forces jump at the same time") && (two.from - 0.2).abs() < 1e-9, "{two}");
    let start = lost(&scene(&text.replace("x - 0.3", "x - 0.1"), &[]), "body.ball.position.0");
    println!("{start}");
    assert!(start.reason.contains("where the motion starts") && start.from == 0.0, "{start}");
}
