//! Lattices in time: bodies that meet across cells, drift together and stray.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration::tensor::Vec3;
use gyration_scene::Scene;
use gyration_sim::survey::modes;
use gyration_sim::{FirstSteps, Job, MemorySink, Outcome, Reason, Simulation, Unwatched};

/// Balls in a row that press on one another.
fn balls(lattice: &str, body: &str, contact: &str) -> Scene {
    let text = format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 40, sample = 1 }}
        [lattice]
        cell = [[0.0403, 0, 0]]
        {lattice}
        [[body]]
        name = "a"
        density = 1000
        shape = {{ sphere = {{ radius = 0.02 }} }}
        {body}
        [[contact]]
        between = ["a", "a"]
        repulsion = {{ alpha = 100, nu = 6, d0 = 1e-4 }}
        {contact}
        "#
    );
    parsed(&text, &[])
}

fn run(scene: &Scene) -> (Outcome, Vec<Vec3>, f64) {
    let job = Job::of(scene, &provenance());
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut sink = MemorySink::default();
    simulation.begin(&mut sink).unwrap();
    let outcome = simulation.run(&mut sink, &mut Unwatched).unwrap();
    let motion = |body: usize| simulation.state().motion_in_space(job.model, body);
    let places = (0..job.model.bodies.len()).map(|body| motion(body).placement.position).collect();
    (outcome, places, simulation.run_state().largest_residual)
}

#[test]
fn a_ring_of_balls_drifts_far_and_resumes_to_the_same_bytes() {
    // A thousand cells away, which is more than a ball may stray alone.
    let scene = balls("repeat = [5, 1, 1]", "velocity = [1, 0, 0]", "reach = 0.002");
    let steps = FirstSteps::of(&Job::of(&scene, &provenance()), 8).unwrap();
    // Round a ring the angular momentum is none.
    let kept = steps.momenta.unwrap();
    assert!(kept.momentum < 1e-14 && kept.angular_momentum.is_none(), "{steps:?}");
    assert!(steps.windows > 0 && steps.difference.is_none(), "{steps:?}");
    let (outcome, places, residual) = run(&scene);
    assert_eq!(outcome, Outcome::Completed);
    for (cell, place) in places.iter().enumerate() {
        let expected = Vec3::new(40.0 + 0.0403 * cell as f64, 0.0, 0.0);
        // Steps may err by 1e-9 of the way.
        assert!((place - expected).norm() < 1e-7, "{cell}: {place}");
    }
    assert!(residual < 1e-12, "{residual:e}");
}

#[test]
fn a_ball_that_leaves_its_neighbours_strays() {
    // Two balls a cell, one of which flies off across the row.
    let scene = balls("repeat = [2, 1, 1]", "", "");
    let text = scene.text().replace("cell = [[0.0403, 0, 0]]", "cell = [[0.0806, 0, 0]]");
    let text = text.replace(
        "[[contact]]",
        "[[body]]\nname = \"b\"\ndensity = 1000\nshape = { sphere = { radius = 0.02 } }\nposition = [0.0403, 0, 0]\n\
         velocity = [0, 1, 0]\n[[contact]]",
    );
    let scene = parsed(&text.replace("between = [\"a\", \"a\"]", "between = [\"a\", \"b\"]"), &[]);
    let (outcome, ..) = run(&scene);
    let Outcome::Stopped(stop) = outcome else { panic!("{outcome:?}") };
    assert!(stop.reason == Reason::Strayed && stop.what.contains("\"b-0\""), "{stop:?}");
    // Half a cell at 1 m/s, less what the neighbours give.
    assert!((stop.time - 0.0403).abs() < 1e-3, "{}", stop.time);
}

#[test]
fn a_cell_of_one_body_is_a_system_with_its_images() {
    let found = modes(&balls("", "", ""));
    let [system] = &found.systems[..] else { panic!("{:?}", found.systems) };
    let rest = system.rest_state.as_ref().unwrap();
    assert_eq!((rest.modes.len(), found.bodies[0].system), (6, Some(0)));
    let [(_, place)] = &rest.bodies.0[..] else { panic!("{:?}", rest.bodies) };
    assert!((place.gap.unwrap() - 3e-4).abs() < 1e-12);
}
