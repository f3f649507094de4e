//! Planes that close on a rigid body: the run ends in words where it could go on for ever, and not before.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration_sim::{Job, MemorySink, Outcome, Reason, Simulation, Unwatched};

/// A body between a floor and a press, both with the same laws, to an end; the outcome and its evaluations.
fn pressed(shape: &str, motion: &str, end: f64) -> (Outcome, u64) {
    let laws =
        "repulsion = { alpha = 100, nu = 6, d0 = 1e-3 }\nfriction = { beta = 500, nu = 6, d0 = 1e-3, mu = 0.4 }\n";
    let text = format!(
        r#"
        time = {{ end = {end}, sample = 0.05 }}
        [[support]]
        name = "floor"
        plane = {{}}
        [[support]]
        name = "press"
        plane = {{ origin = [0, 0, 0.045], normal = [0, 0, -1] }}
        motion = {{ {motion} }}
        [[contact]]
        support = "floor"
        {laws}
        [[contact]]
        support = "press"
        {laws}
        [[body]]
        name = "b"
        shape = {{ {shape} }}
        density = 1000
        position = [0, 0, 0.02]
        "#
    );
    let scene = parsed(&text, &[]);
    let job = Job::of(&scene, &provenance());
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut sink = MemorySink::default();
    simulation.begin(&mut sink).unwrap();
    let outcome = simulation.run(&mut sink, &mut Unwatched).unwrap();
    (outcome, simulation.statistics().rate_evaluations)
}

#[test]
fn a_body_that_is_left_no_room_ends_its_run_in_words() {
    for (shape, until) in [("box = { size = [0.05, 0.04, 0.03] }", 0.15), ("sphere = { radius = 0.018 }", 0.09)] {
        let (outcome, evaluations) = pressed(shape, "velocity = [0, 0, -0.1]", 1.0);
        let Outcome::Stopped(stop) = outcome else { panic!("{shape}: {outcome:?}") };
        println!("{shape}: {} s before, {evaluations} evaluations", until - stop.time);
        assert!(stop.reason == Reason::GapClosed && stop.body.as_deref() == Some("b"), "{stop:?}");
        assert!(stop.what.contains(&format!("no room from t = {until} s")) && stop.time < until, "{stop:?}");
        assert!(until - stop.time < 2e-2 * until, "{stop:?}");
    }
}

#[test]
fn a_press_that_turns_back_lets_its_body_go() {
    // Down to 31 mm, a millimetre above the body, and up again.
    let oscillation =
        "oscillate = { direction = [0, 0, 1], amplitude = 0.007, frequency = 2, phase = 3.141592653589793 }";
    let press = "velocity = [0, 0, -0.02] }";
    let (outcome, _) = pressed("box = { size = [0.05, 0.04, 0.03] }", oscillation, 0.3);
    assert_eq!(outcome, Outcome::Completed);
    // The run ends before the room does.
    let (outcome, _) = pressed("box = { size = [0.05, 0.04, 0.03] }", press.trim_end_matches(" }"), 0.74);
    assert_eq!(outcome, Outcome::Completed);
}
