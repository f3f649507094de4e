//! Derivatives along runs: against closed forms, and against differences of runs.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use gyration_scene::Scene;
use gyration_sim::sensitivity::{At, Sensitivities};
use std::path::Path;

fn scene(text: &str, overrides: &[String]) -> Scene {
    Scene::parse("scene.toml", text, Path::new("scenes"), overrides).unwrap()
}

fn strings(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_owned()).collect()
}

fn at_end(scene: &Scene, keys: &[&str], quantities: &[&str]) -> Sensitivities {
    Sensitivities::along(scene, &strings(keys), &strings(quantities), At::End).unwrap()
}

/// Values of quantities at the end of a run.
fn values(text: &str, overrides: &[String], quantities: &[&str]) -> Vec<f64> {
    at_end(&scene(text, overrides), &[], quantities).values.pop().unwrap()
}

/// Differences of fourth order between runs, each quantity by one number; h relative to it, absolute where it is zero.
fn by_differences(text: &str, overrides: &[String], key: &str, quantities: &[&str], h: f64) -> Vec<f64> {
    let number = at_end(&scene(text, overrides), &[key], quantities).numbers[0];
    let step = if number == 0.0 { 0.1 * h } else { h * number };
    let set = |k: f64| {
        let all = [overrides, &[format!("{key}={:?}", number + k * step)]].concat();
        values(text, &all, quantities)
    };
    let points = [-2.0, -1.0, 1.0, 2.0].map(set);
    let at = |i: usize| (8.0 * (points[2][i] - points[1][i]) - (points[3][i] - points[0][i])) / (12.0 * step);
    (0..quantities.len()).map(at).collect()
}

/// The largest disagreement with differences of runs, relative to the larger of the derivative and a hundredth of the value per
/// number.
fn disagreement(text: &str, overrides: &[String], keys: &[&str], quantities: &[&str], h: f64) -> f64 {
    let found = at_end(&scene(text, overrides), keys, quantities);
    let mut worst: f64 = 0.0;
    for ((key, number), derivatives) in keys.iter().zip(&found.numbers).zip(&found.derivatives) {
        let derivatives = derivatives.at_end().unwrap();
        let expected = by_differences(text, overrides, key, quantities, h);
        for (((quantity, value), derivative), expected) in
            quantities.iter().zip(&found.values[0]).zip(derivatives).zip(expected)
        {
            // A quantity is known to some digits of itself, and so are its differences.
            let apart = (derivative - expected).abs() / expected.abs().max(1e-2 * (value / number).abs());
            println!("d {quantity} / d {key} = {derivative:.12e}, by runs {expected:.12e}: {apart:.1e}");
            worst = worst.max(apart);
        }
    }
    println!("growth {:.2e}, worst {worst:.1e}", found.growth);
    worst
}

const TIGHT: [&str; 2] = ["solver.rtol=1e-11", "solver.atol=1e-13"];

#[test]
fn free_fall_is_differentiated_exactly() {
    let text = r#"
        time = { end = 0.7, sample = 0.1 }
        [[body]]
        name = "ball"
        shape = { sphere = { radius = 0.1 } }
        density = 1000
        position = [0, 0, 3]
        velocity = [0.2, 0, 1]
    "#;
    let keys = [
        "world.gravity.2",
        "body.ball.position.2",
        "body.ball.velocity.2",
        "body.ball.density",
        "body.ball.velocity.0",
    ];
    let found = at_end(&scene(text, &[]), &keys, &["ball.z", "ball.vz", "energy.kinetic"]);
    let (t, g, m) = (0.7, -9.81, 1000.0 * 4e-3 * std::f64::consts::PI / 3.0);
    let vz = 1.0 + g * t;
    let kinetic = 0.5 * (0.04 + vz * vz) * m / 1000.0;
    let expected =
        [[0.5 * t * t, t, m * vz * t], [1.0, 0.0, 0.0], [t, 1.0, m * vz], [0.0, 0.0, kinetic], [0.0, 0.0, m * 0.2]];
    for (derivatives, expected) in found.derivatives.iter().zip(expected) {
        for (value, expected) in derivatives.at_end().unwrap().iter().zip(expected) {
            println!("{value:e} {expected:e}");
            // Rounding of the differences, 1e-16 of the energies over a five thousandth of what they depend on.
            assert!((value - expected).abs() < 1e-9 * expected.abs().max(1.0), "{value} {expected}");
        }
    }
}

const DROP: &str = r#"
    time = { end = 0.5, sample = 0.1 }
    [[support]]
    name = "table"
    plane = { origin = [0, 0, 0], normal = [0, 0, 1] }
    [[contact]]
    support = "table"
    repulsion = { alpha = 1e4, nu = 6, d0 = 0.003 }
    damping = { beta = 4e3, nu = 4, d0 = 0.003 }
    friction = { beta = 1e4, nu = 4, d0 = 0.003 }
    [[body]]
    name = "box"
    shape = { box = { size = [0.1, 0.1, 0.2] } }
    density = 1000
    position = [0, 0, 0.5]
    orientation = { axis_angle = { axis = [1, 2, 0], angle = 0.3 } }
    velocity = [0.3, 0, -1]
    angular_velocity = [0.1, 2, 0.5]
"#;

#[test]
fn a_tumbling_box_agrees_with_differences_of_runs() {
    let keys = [
        "contact.0.repulsion.alpha",
        "contact.0.repulsion.nu",
        "contact.0.damping.beta",
        "contact.0.friction.beta",
        "body.box.position.2",
        "body.box.angular_velocity.1",
        "body.box.shape.box.size.0",
        "body.box.density",
        "body.box.orientation.axis_angle.angle",
        "support.table.plane.normal.0",
        "support.table.plane.origin.2",
    ];
    let quantities =
        ["box.x", "box.z", "box.P_xy", "box.vz", "energy.kinetic", "work.damping", "work.friction", "energy.contact"];
    let worst = disagreement(DROP, &strings(&TIGHT), &keys, &quantities, 1e-4);
    // S is good to 1e-9 of its largest entries, and some quantities change by a ten-thousandth of them.
    assert!(worst < 1e-5, "{worst:e}");
}

const RUBBER: &str = r#"
    time = { end = 0.15, sample = 0.1 }
    [[support]]
    name = "table"
    plane = { origin = [0, 0, 0], normal = [0, 0, 1] }
    [[contact]]
    support = "table"
    repulsion = { alpha = 1e3, nu = 6, d0 = 0.005 }
    damping = { beta = 100, nu = 4, d0 = 0.005 }
    friction = { beta = 500, nu = 4, d0 = 0.005 }
    [[body]]
    name = "cube"
    shape = { box = { size = [0.1, 0.1, 0.1] } }
    density = 1000
    affine = { material = { mooney_rivlin = { c1 = 3e3, c2 = 1e3 } }, viscosity = 20 }
    position = [0, 0, 0.08]
    velocity = [0.2, 0, -0.5]
    gradient = [[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]
"#;

#[test]
fn an_incompressible_body_agrees_with_differences_of_runs() {
    let keys = [
        "body.cube.affine.material.mooney_rivlin.c1",
        "body.cube.affine.viscosity",
        "contact.0.repulsion.nu",
        "body.cube.gradient.0.1",
        "body.cube.shape.box.size.2",
    ];
    let quantities =
        ["cube.z", "cube.P_xz", "cube.Pdot_zz", "cube.pressure", "energy.elastic", "work.viscosity", "work.repulsion"];
    let worst = disagreement(RUBBER, &strings(&TIGHT), &keys, &quantities, 1e-3);
    assert!(worst < 1e-5, "{worst:e}");
}

/// det P = 1 along the run, whatever the number: tr(P⁻¹ ∂P/∂p) = 0.
#[test]
fn derivatives_of_an_incompressible_body_are_tangent_to_its_constraint() {
    let places = [
        "cube.P_xx",
        "cube.P_xy",
        "cube.P_xz",
        "cube.P_yx",
        "cube.P_yy",
        "cube.P_yz",
        "cube.P_zx",
        "cube.P_zy",
        "cube.P_zz",
    ];
    let found = at_end(&scene(RUBBER, &[]), &["contact.0.repulsion.nu", "body.cube.gradient.0.1"], &places);
    let matrix = |numbers: &[f64]| nalgebra::Matrix3::from_row_slice(numbers);
    let inverse = matrix(&found.values[0]).try_inverse().unwrap();
    for derivatives in &found.derivatives {
        let slope = matrix(derivatives.at_end().unwrap());
        let off = (inverse * slope).trace() / slope.norm();
        println!("off the constraint by {off:e} of {:e}", slope.norm());
        // rtol = 1e-8, over the run.
        assert!(off.abs() < 1e-7, "{off:e}");
    }
}

const DRIVEN: &str = r#"
    time = { end = 0.15, sample = 0.1 }
    [[support]]
    name = "table"
    plane = {}
    [[contact]]
    support = "table"
    repulsion = { alpha = "1 kPa", nu = 6, d0 = "2 mm" }
    damping = { beta = 1e3, nu = 6, d0 = "2 mm" }
    friction = { beta = 2e3, nu = 6, d0 = "2 mm" }
    [[body]]
    name = "crawler"
    shape = { box = { size = [0.2, 0.1, 0.1] } }
    density = 1000
    position = [0, 0, 0.052]
"#;

fn driven(source: &str) -> String {
    let material = "material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }, viscosity = 20";
    format!("{DRIVEN}    contractile = {{ {material}, {source} }}\n")
}

#[test]
fn a_driven_body_agrees_with_differences_of_runs() {
    let text = driven(
        "contraction_viscosity = 50, drive = { sum = [
            { sine = { amplitude = [[600, 0, 0], [0, 0, 0], [0, 0, -600]], frequency = 10 } },
            { ramp = { from = [[0, 0, 0], [0, 0, 0], [0, 0, 0]], to = [[0, 0, 300], [0, 0, 0], [0, 0, 0]], duration = 0.06 } } ] }",
    );
    let keys = [
        "body.crawler.contractile.contraction_viscosity",
        "body.crawler.contractile.drive.sum.0.sine.frequency",
        "body.crawler.contractile.drive.sum.0.sine.amplitude.0.0",
        "body.crawler.contractile.drive.sum.1.ramp.duration",
        "contact.0.friction.beta",
    ];
    let quantities = [
        "crawler.x",
        "crawler.z",
        "crawler.G_xx",
        "crawler.P_xz",
        "crawler.pressure",
        "work.drive",
        "work.contraction",
    ];
    let worst = disagreement(&text, &strings(&TIGHT), &keys, &quantities, 1e-3);
    assert!(worst < 1e-5, "{worst:e}");
}

#[test]
fn the_edges_of_a_square_wave_move_with_its_frequency_and_phase() {
    let text = driven(
        "contraction_viscosity = 50,
         drive = { square = { amplitude = [[600, 0, 0], [0, 0, 0], [0, 0, -600]], frequency = 7, phase = 0.3 } }",
    );
    let keys = ["body.crawler.contractile.drive.square.frequency", "body.crawler.contractile.drive.square.phase"];
    let worst = disagreement(&text, &strings(&TIGHT), &keys, &["crawler.z", "crawler.G_xx", "crawler.P_zz"], 1e-3);
    assert!(worst < 1e-5, "{worst:e}");
}

#[test]
fn a_prescribed_contraction_keeps_its_volume_while_it_varies() {
    let text = driven(
        "prescribed = { sum = [
            { constant = { value = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] } },
            { sine = { amplitude = [[0.1, 0, 0.2], [0, 0, 0], [0, 0, 0]], frequency = 3 } } ] }",
    );
    let keys = [
        "body.crawler.contractile.prescribed.sum.1.sine.frequency",
        "body.crawler.contractile.prescribed.sum.1.sine.amplitude.0.2",
        "body.crawler.contractile.prescribed.sum.1.sine.amplitude.0.0",
        "body.crawler.contractile.viscosity",
    ];
    let quantities = ["crawler.x", "crawler.P_xx", "crawler.P_zz", "crawler.pressure"];
    let worst = disagreement(&text, &strings(&TIGHT), &keys, &quantities, 1e-3);
    assert!(worst < 1e-5, "{worst:e}");
}

#[test]
fn a_rate_that_jumps_at_a_moving_kink_takes_the_derivative_along() {
    let text = driven(
        "prescribed = { ramp = { from = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], to = [[1, 0, 0], [0, 1, 0], [0, 0, 1.2]], duration = 0.1 } }",
    )
    .replace("c2 = 1000 }", "c2 = 1000, bulk = 1e5 }");
    let keys = ["body.crawler.contractile.prescribed.ramp.duration"];
    let worst = disagreement(
        &text,
        &strings(&TIGHT),
        &keys,
        &["crawler.z", "crawler.vz", "crawler.P_zz", "crawler.Pdot_zz"],
        1e-4,
    );
    assert!(worst < 1e-5, "{worst:e}");
}
