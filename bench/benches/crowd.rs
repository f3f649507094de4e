//! Crowds of dice on a table: what a die costs among others, on one thread and on two, and what it takes to open them.
//!
//!     cargo bench -p gyration-bench --bench crowd
//!
//! Times are of whole runs of 0.2 s in memory, beside which stand the dice a second; the cost is linear where these do
//! not fall.
#![allow(clippy::expect_used, reason = "a benchmark that cannot go on has failed")]

use divan::Bencher;
use divan::counter::ItemsCount;
use gyration_benchmark::crowd::{self, Throws};
use gyration_scene::Scene;
use gyration_sim::{MemorySink, RunPlan, Simulation, Unwatched};
use std::num::NonZeroUsize;
use std::path::Path;

/// Numbers of dice.
const COUNTS: [usize; 3] = [10, 100, 1000];
/// How long a run lasts [s]: all dice have come to the table, most of them twice.
const END: f64 = 0.2;

fn main() {
    divan::main();
}

#[divan::bench(args = COUNTS, consts = [1, 2], sample_count = 5, sample_size = 1)]
fn alike<const THREADS: usize>(bencher: Bencher, count: usize) {
    run(bencher, count, Throws::Alike, THREADS);
}

#[divan::bench(args = COUNTS, consts = [1, 2], sample_count = 5, sample_size = 1)]
fn different<const THREADS: usize>(bencher: Bencher, count: usize) {
    run(bencher, count, Throws::Different, THREADS);
}

/// From the text of a scene to its simulation, before anything is recorded.
#[divan::bench(args = [10, 100, 1000, 10_000], sample_count = 5, sample_size = 1)]
fn opening(bencher: Bencher, count: usize) {
    let text = crowd::text(count, Throws::Different, END);
    bencher.counter(ItemsCount::new(count)).bench_local(|| {
        let scene = Scene::parse("crowd.toml", &text, Path::new(""), &[]).expect("the scene is valid");
        let built = scene.built();
        Simulation::new(&built.model, &built.state, built.into()).expect("the start is admissible")
    });
}

fn run(bencher: Bencher, count: usize, throws: Throws, threads: usize) {
    let scene = crowd::scene(count, throws, END);
    let built = scene.built();
    let plan = RunPlan { threads: NonZeroUsize::new(threads), ..built.into() };
    bencher.counter(ItemsCount::new(count)).bench_local(|| {
        let mut sink = MemorySink::default();
        let mut simulation = Simulation::new(&built.model, &built.state, plan).expect("the start is admissible");
        simulation.begin(&mut sink).expect("memory");
        simulation.run(&mut sink, &mut Unwatched).expect("memory")
    });
}
