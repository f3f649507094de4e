//! Driven and prescribed contraction, beside differences of runs: signals with kinks that move.

use crate::sensitivities::support::{TIGHT, disagreement, strings, table};
use gyration_scene::Scene;
use gyration_sim::sensitivity::{At, Sensitivities};
use std::path::Path;

const CRAWLER: &str = r#"
    [[body]]
    name = "crawler"
    shape = { box = { size = [0.2, 0.1, 0.1] } }
    density = 1000
    position = [0, 0, 0.052]
"#;

fn crawler() -> String {
    let laws = table("\"2 mm\"", ["alpha = \"1 kPa\", nu = 6", "beta = 1e3, nu = 6", "beta = 2e3, nu = 6"]);
    format!("time = {{ end = 0.15, sample = 0.1 }}\n{laws}{CRAWLER}")
}

fn driven(source: &str) -> String {
    let material = "material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }, viscosity = 20";
    format!("{}    contractile = {{ {material}, {source} }}\n", crawler())
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
    // Differences of runs are as good as h⁴: of steps of 1e-3, which move the phase of the sine by a hundredth, 1e-6.
    let worst = disagreement(&text, &strings(&TIGHT), &keys, &quantities, 2e-4);
    assert!(worst < 2e-7, "{worst:e}");
}

#[test]
fn the_edges_of_a_square_wave_move_with_its_frequency_and_phase() {
    let text = driven(
        "contraction_viscosity = 50,
         drive = { square = { amplitude = [[600, 0, 0], [0, 0, 0], [0, 0, -600]], frequency = 7, phase = 0.3 } }",
    );
    let keys = ["body.crawler.contractile.drive.square.frequency", "body.crawler.contractile.drive.square.phase"];
    let quantities = ["crawler.z", "crawler.G_xx", "crawler.P_zz", "work.drive", "work.contraction", "work.viscosity"];
    let worst = disagreement(&text, &strings(&TIGHT), &keys, &quantities, 2e-4);
    // The work of viscosity is a fortieth of those that make it up, and its difference as much less exact.
    assert!(worst < 1e-6, "{worst:e}");
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
    let quantities = ["crawler.x", "crawler.P_xx", "crawler.P_zz", "crawler.pressure", "work.drive"];
    let worst = disagreement(&text, &strings(&TIGHT), &keys, &quantities, 2e-4);
    assert!(worst < 2e-7, "{worst:e}");
}

#[test]
fn a_kink_that_leaves_another_one_is_told() {
    let ramp = |to: f64, duration: f64| {
        format!(
            "{{ ramp = {{ from = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], to = [[1, 0, 0], [0, 1, 0], [0, 0, {to:?}]], \
                duration = {duration:?} }} }}"
        )
    };
    let by_duration = |other: f64, end: f64| {
        let still = "{ constant = { value = [[-1, 0, 0], [0, -1, 0], [0, 0, -1]] } }";
        let sum = format!("prescribed = {{ sum = [{still}, {}, {}] }}", ramp(1.1, 0.1), ramp(1.3, other));
        let text = driven(&sum).replace("c2 = 1000 }", "c2 = 1000, bulk = 1e5 }");
        let scene = Scene::parse("kinks", &text, Path::new(""), &[format!("time.end={end:?}")]).unwrap();
        let keys = strings(&["body.crawler.contractile.prescribed.sum.1.ramp.duration"]);
        let mut found = Sensitivities::along(&scene, &keys, &strings(&["crawler.z"]), At::End).unwrap();
        found.derivatives.remove(0)
    };
    // Also where it looks as if one had come over the end.
    for end in [0.15, 0.104] {
        let lost = by_duration(0.1, end).lost.unwrap();
        assert!(lost.reason.contains("kink at the same time"), "{lost}");
    }
    assert_eq!(by_duration(0.12, 0.15).lost, None);
    assert_eq!(by_duration(0.15, 0.15).lost, None);
}

#[test]
fn a_rate_that_jumps_at_a_moving_kink_takes_the_derivative_along() {
    let text = driven(
        "prescribed = { ramp = { from = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], to = [[1, 0, 0], [0, 1, 0], [0, 0, 1.2]], duration = 0.1 } }",
    )
    .replace("c2 = 1000 }", "c2 = 1000, bulk = 1e5 }");
    let keys = ["body.crawler.contractile.prescribed.ramp.duration"];
    let quantities = ["crawler.z", "crawler.vz", "crawler.P_zz", "crawler.Pdot_zz", "work.drive", "work.viscosity"];
    let worst = disagreement(&text, &strings(&TIGHT), &keys, &quantities, 1e-4);
    assert!(worst < 1e-6, "{worst:e}");
}
