//! Where there is no derivative: each reason, with the number that it belongs to and the time from which it holds.

use crate::sensitivities::bodies::tumbling;
use crate::sensitivities::support::{at_end, scene, strings};
use gyration_sim::sensitivity::{At, Meaningless, Sensitivities, SensitivityError};

const BALL: &str = r#"
    time = { end = 0.5, sample = 0.1 }
    [[body]]
    name = "ball"
    shape = { sphere = { radius = 0.1 } }
    density = 1000
"#;

/// A repulsion whose potential is finite at touch does not stop a ball.
const TABLE: &str = r#"
    [[support]]
    name = "table"
    plane = {}
    [[contact]]
    support = "table"
    repulsion = { alpha = 1, nu = 1.5, d0 = 1e-3 }
"#;

/// Why there is no derivative by a number.
fn lost(text: &str, overrides: &[&str], key: &str) -> Meaningless {
    let found = at_end(&scene(text, &strings(overrides)), &[key], &[]);
    let lost = found.derivatives[0].lost.clone().unwrap();
    println!("{key}: {lost}");
    assert_eq!(found.derivatives[0].at_end(), Err(&lost));
    lost
}

fn contractile(source: &str) -> String {
    let material =
        "material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }, viscosity = 20, contraction_viscosity = 50";
    format!("{BALL}    contractile = {{ {material}, drive = {source} }}\n")
}

#[test]
fn how_a_motion_is_computed_is_no_quantity() {
    for key in ["solver.rtol", "time.end", "time.sample"] {
        let lost = lost(BALL, &[], key);
        assert_eq!((lost.from, lost.reason.contains("computed or recorded")), (0.0, true), "{key}");
    }
}

#[test]
fn a_start_that_keeps_its_volume_admits_no_other_entry() {
    let soft = format!(
        "{BALL}    affine = {{ material = {{ mooney_rivlin = {{ c1 = 3000, c2 = 1000 }} }} }}
        gradient = [[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]"
    );
    let stretched = lost(&soft, &[], "body.ball.gradient.0.0");
    assert!(stretched.from == 0.0 && stretched.reason.starts_with("the scene admits no other value of it: "));
    let sheared = at_end(&scene(&soft, &[]), &["body.ball.gradient.0.1"], &["ball.P_xy"]);
    assert!(sheared.derivatives[0].at_end().is_ok());
}

#[test]
fn another_number_of_modes_of_a_memory_is_another_set_of_equations() {
    let text = format!("{BALL}    inclusion = {{ history = true, history_error = 1e-3 }}\n");
    let fluid = |viscosity: f64| format!("fluid={{viscosity={viscosity:?}, density=900}}");
    let modes = |viscosity: f64| scene(&text, &[fluid(viscosity)]).built().model.dimension();
    let (mut below, mut above) = (1.0, 100.0);
    assert_ne!(modes(below), modes(above));
    while above - below > 1e-10 * above {
        let middle = 0.5 * (below + above);
        if modes(middle) == modes(below) { below = middle } else { above = middle }
    }
    let lost = lost(&text, &[&fluid(below)], "fluid.viscosity");
    assert_eq!(lost.reason, "the scene admits no other value of it: it changes which equations there are");
    assert!(at_end(&scene(&text, &[fluid(1.01 * above)]), &["fluid.viscosity"], &[]).derivatives[0].at_end().is_ok());
}

#[test]
fn kinks_beyond_number_are_not_followed() {
    let wave = contractile("{ square = { amplitude = [[1, 0, 0], [0, 0, 0], [0, 0, 0]], frequency = 1e6 } }");
    // The run itself is over within a millisecond, at the table.
    let text = format!("{wave}{TABLE}");
    let start = ["time.end=3e-2", "body.ball.position=[0, 0, 0.101]", "body.ball.velocity=[0, 0, -1e3]"];
    let lost = lost(&text, &start, "body.ball.contractile.drive.square.frequency");
    assert_eq!((lost.from, lost.reason.as_str()), (0.0, "its signals have more than 100000 kinks"));
}

#[test]
fn kinks_that_run_into_each_other_leave_no_room_for_differences() {
    let ramp = |duration: f64| {
        format!(
            "{{ ramp = {{ from = [[0, 0, 0], [0, 0, 0], [0, 0, 0]], to = [[1, 0, 0], [0, 0, 0], [0, 0, 0]], duration = {duration} }} }}"
        )
    };
    let text = contractile(&format!("{{ sum = [{}, {}] }}", ramp(0.1), ramp(0.1 + 1e-12)));
    let lost = lost(&text, &[], "body.ball.contractile.drive.sum.0.ramp.duration");
    assert_eq!((lost.from, lost.reason.contains("move too far for their distance")), (0.0, true));
}

/// A point in a face of a hull that moves outwards makes a body of it, and inwards none; and a face of four corners
/// folds along one diagonal or the other. Central differences see neither.
#[test]
fn what_a_hull_has_beside_its_triangles_has_two_sides() {
    let corners = "[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1], [-1, -1, 1], [1, -1, 1], [-1, 1, 1], [1, 1, 1]";
    let hull = |vertices: &str| {
        let text = BALL.replace("sphere = { radius = 0.1 }", &format!("polyhedron = {{ vertices = [{vertices}] }}"));
        format!("{text}    angular_velocity = [1, 2, 3]\n")
    };
    for (text, key) in [(hull(&format!("{corners}, [0, 0, 1]")), "8.2"), (hull(corners), "7.2")] {
        let lost = lost(&text, &[], &format!("body.ball.shape.polyhedron.vertices.{key}"));
        assert_eq!((lost.from, lost.reason.as_str()), (0.0, "the equations are not smooth in it"));
    }
    let tetrahedron = hull("[-1, -1, -1], [1, 1, -1], [1, -1, 1], [-1, 1, 1]");
    let corner = at_end(&scene(&tetrahedron, &[]), &["body.ball.shape.polyhedron.vertices.3.2"], &["ball.P_xx"]);
    assert!(corner.derivatives[0].at_end().is_ok());
}

fn samples(text: &str, overrides: &[&str], keys: &[&str], quantities: &[&str]) -> Sensitivities {
    Sensitivities::along(&scene(text, &strings(overrides)), &strings(keys), &strings(quantities), At::Samples).unwrap()
}

#[test]
fn growth_beyond_the_digits_of_a_run_is_told_with_its_time() {
    let coarse = lost(&tumbling(), &["solver.rtol=1e-4"], "contact.0.repulsion.alpha");
    assert!(coarse.reason.contains("has grown") && coarse.reason.contains("rtol = 1e-4"), "{}", coarse.reason);
    assert!(0.0 < coarse.from && coarse.from < 0.5, "{}", coarse.from);
    // More digits last longer.
    let finer = at_end(&scene(&tumbling(), &strings(&["solver.rtol=1e-8"])), &["contact.0.repulsion.alpha"], &[]);
    assert!(finer.derivatives[0].at_end().is_ok());
    // What came before has its derivatives.
    let found = samples(&tumbling(), &["solver.rtol=1e-4"], &["contact.0.repulsion.alpha"], &["box.z"]);
    let before = found.times.iter().filter(|time| **time < coarse.from).count();
    assert_eq!(found.derivatives[0].rows.len(), before);
}

fn crashing() -> String {
    format!("{BALL}    position = [0, 0, 1]\n{TABLE}")
}

#[test]
fn a_run_that_stops_has_no_end_to_differentiate_at() {
    let lost = lost(&crashing(), &[], "body.ball.position.2");
    assert!(lost.reason.contains("body \"ball\" reaches support \"table\""), "{}", lost.reason);
    // It falls by 0.9 m.
    assert!((lost.from - (1.8f64 / 9.81).sqrt()).abs() < 1e-2, "{}", lost.from);
}

#[test]
fn a_neighbour_below_its_support_takes_the_derivative_with_it() {
    let found = samples(&crashing(), &[], &["body.ball.position.2"], &["ball.z"]);
    let (rows, lost) = (&found.derivatives[0].rows, found.derivatives[0].lost.as_ref().unwrap());
    println!("{} of {} samples, {lost}", rows.len(), found.times.len());
    assert!(lost.reason.contains("body \"ball\" reaches support \"table\""), "{}", lost.reason);
    assert_eq!(rows.len(), 5);
    assert!(found.times[4] < lost.from && lost.from <= found.times[5], "{}", lost.from);
    // Falling freely until then.
    assert!(rows.iter().all(|row| (row[0] - 1.0).abs() < 1e-6), "{rows:?}");
}

#[test]
fn keys_and_quantities_that_are_none_are_refused_with_what_there_is() {
    let along = |key: &str, quantity: &str| {
        Sensitivities::along(&scene(BALL, &[]), &strings(&[key]), &strings(&[quantity]), At::End).unwrap_err()
    };
    let told = |key: &str, quantity: &str| {
        let error = along(key, quantity);
        println!("{error}");
        error.to_string()
    };
    assert!(told("body.bell.density", "ball.z").contains("ball"));
    assert!(told("body.ball.position", "ball.z").contains("several numbers"));
    assert!(told("body.ball.name", "ball.z").contains("no number"));
    assert!(told("body.ball.position.3", "ball.z").contains("0 to 2"));
    assert!(told("body.ball.density", "ball.w").contains("did you mean `ball.x`?"));
    assert!(told("body.ball.density", "colour").contains("ball.vz"));
    assert!(matches!(along("body.ball.density", "energy.residual"), SensitivityError::Quantity { .. }));
}
