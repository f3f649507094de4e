//! Symptom: a field of short range was jumped over within one long step, by an oscillating support or by a spinning
//! rod, and the run ended with a wrong momentum, a closed ledger and no word.

use gyration_scene::Scene;
use gyration_sim::{Job, MemorySink, Outcome, Provenance, RunSummary, Simulation, Unwatched};
use std::path::Path;

fn run(text: &str, overrides: &[String]) -> RunSummary {
    let scene = Scene::parse("scene.toml", text, Path::new(""), overrides).unwrap();
    let job = Job::of(&scene, &Provenance { version: "test".into(), commit: None });
    let mut sink = MemorySink::default();
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    simulation.begin(&mut sink).unwrap();
    let outcome = simulation.run(&mut sink, &mut Unwatched).unwrap();
    RunSummary::of(job.model, &mut simulation, outcome, None)
}

/// The z-momentum with the default steps, and with steps so short that nothing can be missed.
fn momenta(text: &str, overrides: &[String], short: &str) -> [f64; 2] {
    let limited = [overrides, &[format!("solver.max_step={short}")]].concat();
    [run(text, overrides), run(text, &limited)].map(|summary| {
        assert_eq!(summary.outcome, Outcome::Completed, "{}", summary.in_words);
        summary.bodies[0].linear_momentum[2]
    })
}

#[test]
fn a_shaken_plate_hits_a_slow_ball_whatever_the_steps() {
    let text = r#"
        [world]
        gravity = [0, 0, 0]
        [time]
        end = 5
        sample = 5
        [[support]]
        name = "plate"
        plane = {}
        motion = { oscillate = { direction = [0, 0, 1], amplitude = 0.02, frequency = 50.0 } }
        [[contact]]
        support = "plate"
        repulsion = { alpha = 245, nu = 6, d0 = "0.05 mm" }
        [[body]]
        name = "ball"
        shape = { sphere = { radius = 0.01 } }
        density = 1250
        position = [0, 0, 0.1]
    "#;
    for (frequency, speed) in [(20, 0.2), (50, 0.1), (100, 0.05)] {
        let overrides = [
            format!("support.plate.motion.oscillate.frequency={frequency}"),
            format!("body.ball.velocity=[0, 0, -{speed}]"),
        ];
        let [found, reference] = momenta(text, &overrides, "5e-4");
        println!("{frequency} Hz, {speed} m/s: {found:e} against {reference:e} kg m/s");
        // Both have errors of the tolerance, 1e-8 a step; one impact magnifies them by speed over closing speed.
        assert!((found / reference - 1.0).abs() < 1e-6);
    }
}

#[test]
fn a_spinning_rod_touches_down_whatever_the_steps() {
    let text = r#"
        [world]
        gravity = [0, 0, 0]
        [time]
        end = 2
        sample = 2
        [[support]]
        name = "plate"
        plane = {}
        [[contact]]
        support = "plate"
        repulsion = { alpha = 245, nu = 6, d0 = "0.06 mm" }
        [[body]]
        name = "rod"
        shape = { capsule = { radius = 0.002, height = 0.2 } }
        density = 1250
        position = [0, 0, 0.10199]
        angular_velocity = [0, 30, 0]
        orientation = { axis_angle = { axis = [0, 1, 0], angle = "90 deg" } }
    "#;
    let [found, reference] = momenta(text, &[], "1e-4");
    println!("{found:e} against {reference:e} kg m/s");
    assert!((found / reference - 1.0).abs() < 1e-6);
}

#[test]
fn a_body_that_only_spins_is_not_at_rest() {
    let text = r#"
        [world]
        gravity = [0, 0, 0]
        [time]
        end = 1
        sample = 0.1
        stop_at_rest = { speed = 1e-3, hold = 0.05 }
        [[body]]
        name = "rotor"
        mass_properties = { mass = 1, center = [0, 0, 0], euler_tensor = [[0.01, 0, 0], [0, 0.02, 0], [0, 0, 0.03]] }
        angular_velocity = [0, 0, 20]
    "#;
    assert_eq!(run(text, &[]).outcome, Outcome::Completed);
    let Outcome::AtRest { time } = run(text, &["body.rotor.angular_velocity=[0, 0, 1e-4]".into()]).outcome else {
        panic!("a rotor as slow as this is at rest")
    };
    assert_eq!(time, 0.05);
}
