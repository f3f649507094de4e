//! Bodies whose law hardly forbids them to touch: the run ends with that, and does not grind on.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration_sim::{Job, MemorySink, Outcome, Reason, Simulation, Unwatched};

/// How a run of two bodies ends, in how many steps.
fn ended(law: &str, bodies: [&str; 2], end: f64) -> (Outcome, u64) {
    let text = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = {end:?}, sample = {end:?} }}\n\
         [[contact]]\nbetween = [\"a\", \"b\"]\n{law}\n\
         [[body]]\nname = \"a\"\nmass = 1\n{}\n[[body]]\nname = \"b\"\nmass = 1\n{}\n",
        bodies[0], bodies[1]
    );
    let scene = parsed(&text, &[]);
    let job = Job::of(&scene, &provenance());
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut sink = MemorySink::default();
    simulation.begin(&mut sink).unwrap();
    let outcome = simulation.run(&mut sink, &mut Unwatched).unwrap();
    (outcome, simulation.statistics().accepted())
}

/// A corner that comes towards a face.
const BLOCKS: [&str; 2] = [
    "shape = { box = { size = [0.1, 0.14, 0.08] } }\nposition = [-0.14, 0, 0]\nvelocity = [0.6, 0.1, 0]\n\
     orientation = { quaternion = [0.5, 0.1, 0.8, 0.3] }\nangular_velocity = [3, -2, 5]",
    "shape = { box = { size = [0.12, 0.1, 0.1] } }\nposition = [0.14, 0.01, 0.02]\nvelocity = [-0.8, 0, 0.1]\n\
     orientation = { quaternion = [0.2, 0.9, -0.3, 0.25] }\nangular_velocity = [-4, 1, 2]",
];

#[test]
fn a_corner_under_a_law_that_hardly_forbids_touch_ends_the_run_with_that() {
    for nu in [2.0, 2.2] {
        let law = format!(
            "repulsion = {{ alpha = 1e3, nu = {nu}, d0 = 0.004 }}\ndamping = {{ beta = 50, nu = {nu}, d0 = 0.004 }}"
        );
        let (outcome, steps) = ended(&law, BLOCKS, 0.4);
        let Outcome::Stopped(stop) = outcome else { panic!("{outcome:?}") };
        println!("ν = {nu}, {steps} steps: {}. {}", stop.what, stop.advice);
        assert_eq!((stop.reason, steps < 500), (Reason::Touching, true));
        assert!(stop.what.contains("\"a\" and \"b\" touch") && stop.advice.contains("larger exponent"));
    }
}

/// A law that forbids it and is a tenth of a micrometre hard: the plane comes to 1e-9 of the size from one of the two,
/// and they turn back without loss.
#[test]
fn corners_that_turn_back_near_the_last_digits_do_not_touch() {
    for alpha in ["8e15", "8e14"] {
        let law = format!("repulsion = {{ alpha = {alpha}, nu = 6, d0 = 1e-7 }}");
        let blocks = BLOCKS
            .map(|block| block.replace("position = [-0.14", "position = [-0.12").replace("[0.14, 0.01", "[0.12, 0.01"));
        let (outcome, steps) = ended(&law, [&blocks[0], &blocks[1]], 0.3);
        println!("alpha = {alpha}: {steps} steps");
        assert_eq!((outcome, steps < 1000), (Outcome::Completed, true));
    }
}

/// Balls have a gap of two places alone: a thousand millionth of their size is still told.
#[test]
fn balls_are_told_apart_where_other_bodies_are_not() {
    let law = "repulsion = { alpha = 1e-3, nu = 6, d0 = 1e-9 }";
    let [ball, cube] = ["sphere = { radius = 0.05 }", "box = { size = [0.1, 0.1, 0.1] }"];
    let apart = |shape: &str| {
        let at = |x: f64| format!("shape = {{ {shape} }}\nposition = [{x:?}, 0, 0]");
        let bodies = [at(0.0), at(0.1 + 1e-10)];
        ended(law, [&bodies[0], &bodies[1]], 1e-9).0
    };
    assert_eq!(apart(ball), Outcome::Completed);
    assert!(matches!(apart(cube), Outcome::Stopped(stop) if stop.reason == Reason::Touching && stop.time == 0.0));
}
