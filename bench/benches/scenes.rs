//! Whole scenes in memory, from the start to the end or to rest.
#![allow(clippy::expect_used, reason = "a benchmark that cannot go on has failed")]

use divan::Bencher;
use gyration_scene::{Scene, gallery};
use gyration_sim::{Job, MemorySink, Provenance, Simulation, Unwatched};

fn main() {
    divan::main();
}

#[divan::bench(args = gallery().iter().map(|(name, _)| *name), sample_count = 10)]
fn scene(bencher: Bencher, name: &str) {
    let scene = Scene::open(name, &[]).expect("the gallery is valid");
    let job = Job::of(&scene, &Provenance { version: String::new(), commit: None });
    bencher.bench_local(|| {
        let mut sink = MemorySink::default();
        let mut simulation = Simulation::new(job.model, job.start, job.plan).expect("the start is admissible");
        simulation.begin(&mut sink).expect("memory");
        simulation.run(&mut sink, &mut Unwatched).expect("memory")
    });
}
