//! Impacts that are over within a few hundred-thousandths of the time between them: no step may pass over one.

use crate::sensitivities::support::{TIGHT, at_end, by_differences, disagreement, scene, strings};

/// A ball that falls from a height above the table, at rest; the run ends on its way up again.
fn falling(radius: f64, height: f64, laws: &str) -> String {
    let end = 1.5 * (2.0 * height / 9.81_f64).sqrt();
    format!(
        r#"
    time = {{ end = {end:?}, sample = {end:?} }}
    [[support]]
    name = "table"
    plane = {{}}
    [[contact]]
    support = "table"
    {laws}
    [[body]]
    name = "ball"
    shape = {{ sphere = {{ radius = {radius:?} }} }}
    density = 2500
    position = [0, 0, {:?}]
"#,
        radius + height
    )
}

#[test]
fn short_impacts_are_seen() {
    let steel = "repulsion = { alpha = 1e4, nu = 6, d0 = 1e-4 }\n    damping = { beta = 2e4, nu = 4, d0 = 1e-4 }";
    let bead = "repulsion = { alpha = 5e3, nu = 6, d0 = 1e-5 }\n    damping = { beta = 3e4, nu = 4, d0 = 1e-5 }";
    let moon = "repulsion = { alpha = 1e8, nu = 12, d0 = 1.0 }\n    damping = { beta = 1e5, nu = 6, d0 = 1.0 }";
    let keys = ["contact.0.damping.beta", "contact.0.repulsion.nu", "contact.0.repulsion.alpha"];
    let mut worst: f64 = 0.0;
    for (radius, height, laws, rtol) in [
        (0.05, 0.1, steel, 1e-8),
        (0.05, 0.2, steel, 1e-9),
        (0.05, 0.35, steel, 1e-10),
        (1e-3, 0.01, bead, 1e-10),
        (1e3, 1e3, moon, 1e-8),
    ] {
        let text = falling(radius, height, laws);
        let expected = keys.map(|key| by_differences(&text, &strings(&TIGHT), key, &["ball.vz"], 1e-3)[0]);
        for method in ["auto", "explicit", "implicit"] {
            let overrides = [format!("solver.method={method}"), format!("solver.rtol={rtol:e}")];
            let found = at_end(&scene(&text, &overrides), &keys, &["ball.vz"]);
            for ((key, derivatives), expected) in keys.iter().zip(&found.derivatives).zip(expected) {
                let derivative = derivatives.at_end().map_or(f64::NAN, |row| row[0]);
                let apart = (derivative / expected - 1.0).abs();
                println!(
                    "{radius} m from {height} m, {method}: d vz / d {key} = {derivative:e}, by runs {expected:e}: \
                        {apart:.1e}"
                );
                worst = if apart > worst || apart.is_nan() { apart } else { worst };
            }
        }
    }
    println!("worst {worst:.1e}");
    // The runs are known to 1e-8 or better, and what is not known of them has grown some hundred thousand times.
    assert!(worst < 1e-4, "{worst:e}");
}

/// Without losses the energy is that of the start, and so is its derivative. Within the impact of a corner, at a gap of
/// 1e-7 of the places, neighbours grow apart some 1e6 times and come together again: what is left has the digits that
/// the growth tells.
#[test]
fn energy_behind_the_impact_of_a_corner_changes_as_at_the_start() {
    let text = r#"
        time = { end = 0.1, sample = 0.05 }
        [[support]]
        name = "table"
        plane = {}
        [[contact]]
        support = "table"
        repulsion = { alpha = 1e3, nu = 4, d0 = 1e-3 }
        [[body]]
        name = "box"
        shape = { box = { size = [0.05, 0.06, 0.07] } }
        density = 1000
        position = [0, 0, 0.2]
        velocity = [0.1, 0, -2]
        angular_velocity = [1, 2, 0]
    "#;
    let keys = ["body.box.velocity.2", "body.box.angular_velocity.0", "body.box.position.2"];
    let energies = ["energy.kinetic", "energy.gravity", "energy.contact"];
    // m v, I ω and m g, of 0.21 kg.
    let expected = [-0.42, 0.21 / 12.0 * (0.06 * 0.06 + 0.07 * 0.07), 0.21 * 9.81];
    for rtol in [1e-9_f64, 1e-11] {
        let found = at_end(&scene(text, &[format!("solver.rtol={rtol:e}")]), &keys, &energies);
        for ((key, derivatives), expected) in keys.iter().zip(&found.derivatives).zip(expected) {
            let row = derivatives.at_end().unwrap();
            let (sum, size) = row.iter().fold((0.0, 0.0), |(sum, size), part| (sum + part, size + part.abs()));
            let off = (sum - expected).abs() / size;
            println!("{key} at rtol = {rtol:e}: {sum} of {row:?}, {off:.1e} off, growth {:.1e}", found.growth);
            // Measured with rtol from 1e-8 to 1e-11: 6e-4 to 2.5e-3 of rtol × growth.
            assert!(off < 0.01 * rtol * found.growth && found.growth < 1e7, "{key}: {sum} and not {expected}");
        }
    }
}

/// What an earlier impact does to works cancels over the impact but for a millionth. Symptom: derivatives of works were
/// off by a hundredth of two balls that strike obliquely, by 3e-3 of one that bounces and slides, by 1e-3 of an arm
/// that strikes its stops, at any tolerance.
#[test]
fn works_of_impacts_keep_their_digits() {
    let balls = r#"
    time = { end = 0.3, sample = 0.3 }
    world = { gravity = [0, 0, 0] }
    [[contact]]
    between = ["a", "b"]
    repulsion = { alpha = 3000, nu = 3, d0 = 1e-3 }
    damping = { beta = 600, nu = 3, d0 = 1e-3 }
    friction = { beta = 9e5, nu = 3, d0 = 1e-3, mu = 0.2 }
    [[body]]
    name = "a"
    shape = { sphere = { radius = 0.05 } }
    density = 1000
    velocity = [1, 0, 0]
    [[body]]
    name = "b"
    shape = { sphere = { radius = 0.05 } }
    density = 1000
    position = [0.2, 0.03, 0]
"#;
    let bouncing = r#"
    time = { end = 0.3, sample = 0.3 }
    [[support]]
    name = "table"
    plane = {}
    [[contact]]
    support = "table"
    from = { rest_gap = 2e-4, restitution = 0.5, at_speed = 1, friction_angle = 0.35, sliding_speed = 2e-3 }
    [[body]]
    name = "a"
    shape = { sphere = { radius = 0.05 } }
    density = 900
    position = [0, 0, 0.15]
    velocity = [0.5, 0, 0]
"#;
    let arm = r#"
    time = { end = 1.3, sample = 1.3 }
    [[body]]
    name = "arm"
    shape = { box = { size = [0.05, 0.04, 0.5] } }
    density = 800
    position = [0, 0, -0.25]
    [[joint]]
    name = "h"
    between = ["arm", "space"]
    kind = "hinge"
    points = [[0, 0, 0.25], [0, 0, 0]]
    axis = [0, 1, 0]
    limits = ["-60 deg", "40 deg"]
    stop = { repulsion = { alpha = 1e-3, nu = 2.5, d0 = 0.05 }, damping = { beta = 5e-4, nu = 2.5, d0 = 0.05 } }
    drive = { torque = "a*sin(w*t) - b*rate", constants = { a = 2.5, w = 7, b = 0.02 } }
"#;
    // The gap of two balls is known to 1e-11 of itself, that of a ball over a plane and of a joint to all digits.
    for (text, keys, quantities, tolerance) in [
        (balls, &["body.a.velocity.0"][..], &["work.friction", "work.damping"][..], 1e-5),
        (bouncing, &["world.gravity.2"], &["work.friction", "work.damping"], 1e-5),
        (arm, &["joint.h.drive.constants.w", "joint.h.drive.constants.b", "world.gravity.2"], &["work.load"], 1e-6),
    ] {
        let worst = disagreement(text, &strings(&TIGHT), keys, quantities, 1e-4);
        assert!(worst < tolerance, "{worst:e}");
    }
}

/// A floor that comes does what one that stands does to a body that comes. Symptom: works differed by 4e-6, since
/// powers were differentiated by time over steps that are no multiple of what a time is known to.
#[test]
fn works_at_a_floor_that_comes_are_those_at_one_that_stands() {
    let text = |floor: f64| {
        format!(
            r#"
    time = {{ end = 0.4, sample = 0.4 }}
    world = {{ gravity = [0, 0, 0] }}
    [[support]]
    name = "floor"
    plane = {{}}
    motion = {{ velocity = [0, 0, {floor:?}] }}
    [[contact]]
    support = "floor"
    repulsion = {{ alpha = 1, nu = 6, d0 = 3e-3 }}
    damping = {{ beta = 0.02, nu = 6, d0 = 3e-3 }}
    friction = {{ beta = 0.1, nu = 6, d0 = 3e-3 }}
    [[body]]
    name = "b"
    shape = {{ sphere = {{ radius = 0.05 }} }}
    density = 1000
    position = [0, 0, 0.1]
    velocity = [0.2, 0, {:?}]
"#,
            floor - 0.2
        )
    };
    let works = |floor: f64| {
        let found = at_end(&scene(&text(floor), &[]), &["contact.0.damping.beta"], &["work.damping", "work.friction"]);
        found.derivatives[0].at_end().unwrap().to_vec()
    };
    for (comes, stands) in works(0.2).into_iter().zip(works(0.0)) {
        let off = (comes / stands - 1.0).abs();
        println!("{comes:e} and {stands:e}: {off:.1e}");
        assert!(off < 1e-7, "{comes:e} and {stands:e}: {off:e}");
    }
}
