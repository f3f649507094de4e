//! Runs under forces of their own: where they are undefined, and frictions that are none.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration_sim::modes::{modes, rest};
use gyration_sim::survey::Survey;
use gyration_sim::{Job, MemorySink, Outcome, Reason, Simulation, Stop, Unwatched};

/// A ball of half a kilogram that moves along x, without gravity.
fn ball(lines: &str) -> String {
    format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 2, sample = 0.1 }}
        [[body]]
        name = "ball"
        mass = 0.5
        shape = {{ sphere = {{ radius = 0.1 }} }}
        position = [1, 0, 0]
        velocity = [-1, 0, 0]
        {lines}
        "#
    )
}

/// H = diag(entry, 0, …).
fn along_x(entry: &str) -> String {
    let zeros = "0, ".repeat(11);
    let others = format!("[0, {zeros}]").repeat(11).replace("][", "], [");
    format!("[[{entry}, {zeros}], {others}]").replace(", ]", "]")
}

fn outcome(text: &str) -> Outcome {
    let scene = parsed(text, &[]);
    let job = Job::of(&scene, &provenance());
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut sink = MemorySink::default();
    simulation.begin(&mut sink).unwrap();
    simulation.run(&mut sink, &mut Unwatched).unwrap()
}

fn stop(text: &str) -> Stop {
    match outcome(text) {
        Outcome::Stopped(stop) => stop,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_run_ends_where_a_potential_has_no_derivative() {
    let stop = stop(&ball("potential = \"sqrt(x)\""));
    assert_eq!((stop.reason, stop.body.as_deref()), (Reason::Undefined, Some("ball")));
    assert!(stop.what.contains("the potential of body \"ball\" ends there: `sqrt` has no"), "{}", stop.what);
}

#[test]
fn a_run_ends_where_a_body_force_has_no_value() {
    let stop = stop(&ball("body_force = [\"0\", \"sqrt(x - 0.3)\", 0]"));
    assert_eq!(stop.reason, Reason::Undefined);
    assert!(stop.what.contains("the body_force of body \"ball\""), "{}", stop.what);
}

#[test]
fn a_run_ends_where_friction_would_feed_energy_in() {
    let scaled = format!("linear_friction = {{ matrix = {}, scale = \"0.01*x\" }}", along_x("1"));
    let entries = format!("linear_friction = {{ matrix = {} }}", along_x("\"0.01*x\""));
    for text in [scaled, entries] {
        let stop = stop(&ball(&text));
        assert_eq!((stop.reason, stop.body.as_deref()), (Reason::IndefiniteFriction, Some("ball")));
        assert!(stop.what.contains("not positive semi-definite: the pivot of row 0"), "{}", stop.what);
        // At the end of the step in which x becomes negative.
        assert!(stop.time > 1.0 && stop.time <= 2.0, "{}", stop.time);
    }
}

#[test]
fn a_potential_holds_a_body_at_rest_against_gravity() {
    let text = ball("potential = \"20*z^2 + 5*(x^2 + y^2)\"").replace("[0, 0, 0] }", "[0, 0, -10] }");
    let scene = parsed(&text, &[]);
    let (model, start) = (&scene.built().model, &scene.built().state);
    let found = rest(model, start, 0).unwrap();
    assert!((found.placement.position.z + 5.0 / 40.0).abs() < 1e-9, "{}", found.placement.position);
    let frequencies: Vec<f64> =
        modes(model, start, 0, &found).unwrap().iter().map(gyration_sim::modes::Mode::frequency).collect();
    println!("{frequencies:?}");
    assert!(frequencies.iter().any(|omega| (omega - 80.0_f64.sqrt()).abs() < 1e-9), "{frequencies:?}");
    assert!(frequencies.iter().any(|omega| (omega - 20.0_f64.sqrt()).abs() < 1e-9), "{frequencies:?}");
}

#[test]
fn the_survey_tells_own_forces_and_the_error_of_a_rule() {
    let told = |lines: &str| {
        let scene = parsed(&ball(lines), &[]);
        Survey::of(&scene).unwrap().text(&scene).unwrap()
    };
    assert!(told("body_force = [\"-0.1*x\", \"0\", \"2*sin(3*t)\"]").contains("body force, integrated exactly"));
    assert!(told("body_force = [\"sin(40*x)\", 0, 0]").contains("wrong by"));
    assert!(told("potential = \"x*t\"").contains("potential that changes in time"));
    assert!(told("affine = { kinetic = \"comoving\" }").contains("comoving kinetic energy"));
    let heavy = ball("affine = {}").replace("[0, 0, 0] }", "[0, 0, 0], self_gravity = { constant = 1 } }");
    let scene = parsed(&heavy, &[]);
    assert!(Survey::of(&scene).unwrap().text(&scene).unwrap().contains("gravity of its own"));
}
