//! Long bodies near one another, whose spheres overlap: islands go by their shapes.

use crate::islands::parsed;
use gyration::state::State;
use gyration_sim::{MemorySink, Outcome, RunPlan, Simulation, Unwatched};

const LAWS: &str = r#"
    repulsion = { alpha = "1 kPa", nu = 6, d0 = "0.1 mm" }
    damping = { beta = 5e4, nu = 6, d0 = "0.1 mm" }
    friction = { beta = 3e5, nu = 6, d0 = "0.1 mm", mu = 0.3 }
"#;

/// The first of two dominoes falls against the second; so many stand behind it, one pitch apart.
fn dominoes(behind: usize) -> String {
    let mut text = format!(
        "time = {{ end = 0.2, sample = 0.05 }}\nsolver = {{ rtol = 1e-6 }}\n\
         [[support]]\nname = \"floor\"\nplane = {{}}\n[[contact]]\nsupport = \"floor\"{LAWS}\
         [[contact]]\nbetween = [\"domino\", \"domino\"]{LAWS}reach = \"5 mm\"\n"
    );
    for k in 0..2 + behind {
        let place = if k < 2 { k as f64 } else { 1.0 - k as f64 };
        let push = if k == 0 { "velocity = [0.5, 0, 0.075]\nangular_velocity = [0, 20, 0]\n" } else { "" };
        text += &format!(
            "[[body]]\nname = \"d{k}\"\ngroup = \"domino\"\nshape = {{ box = {{ size = [0.0075, 0.025, 0.05] }} }}\n\
             density = 700\nposition = [{}, 0, 0.02512]\n{push}",
            0.0375 * place
        );
    }
    text
}

fn end_of(simulation: Result<Simulation, gyration_sim::RunError>) -> State {
    let mut simulation = simulation.unwrap();
    let mut kept = MemorySink::default();
    simulation.begin(&mut kept).unwrap();
    assert_eq!(simulation.run(&mut kept, &mut Unwatched).unwrap(), Outcome::Completed);
    simulation.state()
}

/// Their spheres have a diameter of 57 mm, and stand 37.5 mm apart.
#[test]
fn dominoes_that_stand_leave_no_trace_in_those_that_fall() {
    let ends = [0, 6].map(|behind| {
        let scene = parsed(&dominoes(behind), &[]);
        let built = scene.built();
        let state = end_of(Simulation::new(&built.model, &built.state, RunPlan::from(built)));
        [0, 1].map(|body| state.motion(&built.model, body))
    });
    assert!(ends[0][1].placement.gradient[(0, 2)] > 0.1, "the second falls, too");
    assert_eq!(ends[0], ends[1]);
}

/// Planks in layers that turn over, pass and hit one another.
#[test]
fn planks_in_islands_take_the_paths_of_one_step_for_all() {
    let mut text = "world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 0.5 }\n\
                    solver = { rtol = 1e-10, atol = 1e-12 }\n[[contact]]\nbetween = [\"plank\", \"plank\"]\n\
                    repulsion = { alpha = 1e4, nu = 6, d0 = 0.01 }\nreach = 0.03\n"
        .to_owned();
    for k in 0..6 {
        let height = 0.15 * k as f64;
        let [speed, turn] = [if k % 2 == 0 { 0.2 } else { -0.1 }, 0.9 - 0.4 * k as f64];
        text += &format!(
            "[[body]]\nname = \"p{k}\"\ngroup = \"plank\"\nshape = {{ box = {{ size = [1, 0.1, 0.02] }} }}\nmass = 1\n\
             position = [{}, 0, {height}]\nvelocity = [0, 0, {speed}]\nangular_velocity = [0.1, {}, {turn}]\n",
            0.1 * (k as f64).sin(),
            0.1 * turn
        );
    }
    let scene = parsed(&text, &[]);
    let (model, start, plan) = (&scene.built().model, &scene.built().state, RunPlan::from(scene.built()));
    let own = end_of(Simulation::new(model, start, plan));
    let together = end_of(Simulation::together(model, start, plan));
    let place = |state: &State, body: usize| state.motion(model, body).placement;
    let apart = |body: usize| {
        let [own, other] = [&own, &together].map(|state| place(state, body));
        (own.position - other.position).norm() + (own.gradient - other.gradient).norm()
    };
    let apart = (0..6).map(apart).fold(0.0, f64::max);
    let changed = (0..6).filter(|body| {
        let speed = |state: &State| state.motion(model, *body).velocity.velocity;
        (speed(&own) - speed(start)).norm() > 1e-2
    });
    let changed = changed.count();
    println!("{changed} planks were hit, paths apart by {apart:.1e}");
    assert!(changed >= 4, "they meet");
    // Impacts multiply errors of 1e-10 by some ten each.
    assert!(apart < 1e-7, "{apart:e}");
}
