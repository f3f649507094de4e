//! Numbers that move a wall, by what a body does that comes back from it without loss.
//!
//! Symptom: where the gap of the impact was a hundred-thousandth of the number and less, derivatives had three digits.
//! Neighbouring numbers were differences of 1e-9 of it, which are rounded to a ten-millionth.

use crate::sensitivities::support::{at_end, scene};

/// A body of 1 kg that comes towards what turns it back at 0.5 m/s, 0.1 m away, within the first half of the run.
fn turned_back(shape: &str, wall: &str) -> String {
    format!(
        r#"
    time = {{ end = 0.4, sample = 0.4 }}
    world = {{ gravity = [0, 0, 0] }}
    solver = {{ rtol = 1e-11 }}
    [[body]]
    name = "b"
    shape = {{ {shape} }}
    mass = 1
    position = [0, 0, 0]
    velocity = [0.5, 0, 0]
    {wall}
"#
    )
}

/// A plane 0.1 m before a body that is 0.03 m wide on either side, with a repulsion of this strength [Pa].
fn plane(strength: f64) -> String {
    format!(
        r#"
    [[support]]
    name = "wall"
    plane = {{ origin = [0.13, 0, 0], normal = [-1, 0, 0] }}
    [[contact]]
    support = "wall"
    repulsion = {{ alpha = {strength:e}, nu = 6, d0 = 1e-3 }}
"#
    )
}

/// A slider with a stop of this strength [N] at 0.1 m.
fn slider(strength: f64) -> String {
    format!(
        r#"
    [[joint]]
    name = "s"
    between = ["b", "space"]
    kind = "slider"
    points = [[0, 0, 0], [0, 0, 0]]
    axis = [1, 0, 0]
    limits = [-0.1, 0.1]
    stop = {{ repulsion = {{ alpha = {strength:e}, nu = 6, d0 = 1e-3 }} }}
"#
    )
}

#[test]
fn a_wall_takes_along_what_it_turns_back() {
    let (ball, block) = ("sphere = { radius = 0.03 }", "box = { size = [0.06, 0.05, 0.04] }");
    let origin = "support.wall.plane.origin.0";
    let radius = "body.b.shape.sphere.radius";
    // Of a wall that is moved the place moves twice as far, of half a width as much. A ball that is larger is pushed
    // farther off, too: U = 2πR α d₀^ν (g^(2−ν) − (g + 2R)^(2−ν))/((ν−1)(ν−2)), the times of both ways by quadrature.
    let strengths = [1e3, 1.0, 1e-3, 1e-6, 1e-9];
    let by_radius =
        [-2.000_930_393_535_8, -2.000_165_449_967, -2.000_029_421_627, -2.000_005_231_987_3, -2.000_000_930_393_5];
    let mut rows: Vec<(String, &str, f64, f64)> = Vec::new();
    for (strength, expected) in strengths.into_iter().zip(by_radius) {
        rows.push((turned_back(ball, &plane(strength)), origin, 2.0, 1e-5));
        rows.push((turned_back(ball, &plane(strength)), radius, expected, 1e-5));
        rows.push((turned_back(block, &plane(strength)), origin, 2.0, 5e-6));
        rows.push((turned_back(block, &plane(strength)), "body.b.shape.box.size.0", -1.0, 5e-6));
    }
    // A stop has the digits of one number.
    for (strength, tolerance) in [(1e-3, 1e-7), (1e-6, 2e-7), (1e-9, 1e-6), (1e-12, 3e-5), (1e-15, 2e-4)] {
        rows.push((turned_back(ball, &slider(strength)), "joint.s.limits.0", -2.0, tolerance));
    }
    let mut worst: f64 = 0.0;
    for (text, key, expected, tolerance) in rows {
        let found = at_end(&scene(&text, &[]), &[key], &["b.x"]);
        let derivative = found.derivatives[0].at_end().unwrap()[0];
        let apart = (derivative - expected).abs();
        println!("d x / d {key} = {derivative:.12}, {apart:.1e} of {tolerance:.0e}");
        assert!(apart < tolerance, "{key}: {derivative} for {expected}\n{text}");
        worst = worst.max(apart);
    }
    println!("worst {worst:.1e}");
}
