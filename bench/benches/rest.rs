//! A hundred simulated seconds of a damped box at rest, and of free flight, in memory with default options.
#![allow(clippy::expect_used, reason = "a benchmark that cannot go on has failed")]

use divan::Bencher;
use gyration_scene::Scene;
use gyration_sim::{Job, MemorySink, Outcome, Provenance, Simulation, Unwatched};
use std::path::Path;

fn main() {
    divan::main();
}

const BOX: &str = r#"
[time]
end = 100.0
sample = 100.0
[[body]]
name = "box"
shape = { box = { size = [0.1, 0.1, 0.1] } }
density = 1000
"#;

const TABLE: &str = r#"
[[support]]
name = "table"
plane = {}
[[contact]]
support = "table"
repulsion = { alpha = "1 kPa", nu = 6, d0 = "3 mm" }
damping = { beta = 1e4, nu = 3, d0 = "3 mm" }
friction = { beta = 1e4, nu = 3, d0 = "3 mm" }
"#;

fn simulate(bencher: Bencher, text: &str, overrides: &[&str]) {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    let scene = Scene::parse("rest.toml", text, Path::new(""), &overrides).expect("the scene is valid");
    let job = Job::of(&scene, &Provenance { version: String::new(), commit: None });
    let run = || {
        let mut sink = MemorySink::default();
        let mut simulation = Simulation::new(job.model, job.start, job.plan).expect("the start is admissible");
        simulation.begin(&mut sink).expect("memory");
        assert_eq!(simulation.run(&mut sink, &mut Unwatched).expect("memory"), Outcome::Completed);
        simulation.statistics()
    };
    println!("{:?}", run());
    bencher.bench_local(run);
}

#[divan::bench(sample_count = 20)]
fn damped_box_at_rest(bencher: Bencher) {
    simulate(bencher, &[BOX, TABLE].concat(), &["body.box.position=[0, 0, 0.053]"]);
}

#[divan::bench(sample_count = 20)]
fn damped_box_sampled(bencher: Bencher) {
    simulate(bencher, &[BOX, TABLE].concat(), &["body.box.position=[0, 0, 0.053]", "time.sample=0.01"]);
}

#[divan::bench(sample_count = 20)]
fn free_flight(bencher: Bencher) {
    simulate(bencher, BOX, &["body.box.velocity=[1, 0, 3]", "body.box.angular_velocity=[1, 2, 0.5]"]);
}

#[divan::bench(sample_count = 20)]
fn flight_above_a_table(bencher: Bencher) {
    let text = [BOX, TABLE].concat();
    let far = "body.box.position=[0, 0, 100000]";
    simulate(bencher, &text, &[far, "body.box.velocity=[1, 0, 3]", "body.box.angular_velocity=[1, 2, 0.5]"]);
}
