//! What whole runs cost: throws, cubes to a true error, crowds.
//!
//! Floors of runs of a box are those of its calls: evaluations of rates and Jacobians at the floor of `kernels`, and
//! factorizations of a matrix of 13 rows, one real and one complex, 2n³/3 products and sums and four times as many.
//! Those of dice apart are what they take a few at a time.

use crate::arithmetic::Arithmetic;
use crate::clock::{processor_seconds, seconds_each};
use crate::crowd::{self, Throws};
use crate::die::Die;
use crate::kernels::{LOADS_OF_BOX, SLOPES_OF_BOX};
use crate::near::{SHAPES, near_table};
use crate::row::{BenchmarkRow, Floor, Size};
use crate::soft::{cube_over_table, material};
use crate::{gas, heap};
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::{ImplicitOrder, Integrator, Method, Options, Statistics};
use gyration_scene::Scene;
use gyration_sim::adapter::ModelSystem;
use gyration_sim::{MemorySink, RunPlan, Simulation, Tolerance, Unwatched};
use std::num::NonZeroUsize;
use std::path::Path;
use std::time::Instant;

/// Unknowns of an implicit step of a rigid body.
const UNKNOWNS: f64 = 13.0;
/// Products and sums of its factorizations.
const FACTORS: f64 = 5.0 * 2.0 / 3.0 * UNKNOWNS * UNKNOWNS * UNKNOWNS;
/// The tolerance of the throws, the rest gap of their die over its side, and its damping in units of side, density and
/// g: a vertex returns with 0.42 of its speed, and less than a face in a hundred changes with the tolerance.
const THROWN: (f64, f64, f64) = (1e-4, 0.03, 0.04);
/// The true error at which cubes are compared, and the time up to which they run.
const ERROR: f64 = 1e-8;
const END: f64 = 10.0;
/// The part of its energy that the ledger of the free cube may miss.
const BALANCE: f64 = 1e-6;

/// Measures them.
pub fn rows(arithmetic: &Arithmetic, size: Size, add: &mut impl FnMut(BenchmarkRow)) {
    let whole = size == Size::Whole;
    add(throws(arithmetic, if whole { 200 } else { 20 }));
    add(cube(arithmetic, "rigid", &near_table(SHAPES[0].1, 2.0, (6.0, 3.0))));
    add(cube(arithmetic, "affine", &cube_over_table(material("neo_hookean_log"), 2.0)));
    add(free_cube());
    let [apart, balls, dice, opened] = if whole { [1000, 1000, 20, 10_000] } else { [100, 125, 8, 1000] };
    dice_apart(apart, add);
    add(gas_of(balls));
    add(heap_of(dice));
    add(opening(opened));
}

/// A run from a model and its start, in memory, to its end.
fn run(model: &Model, start: &State, plan: RunPlan) -> Simulation {
    let mut sink = MemorySink::default();
    let mut simulation = Simulation::new(model, start, plan).unwrap_or_else(|error| panic!("{error}"));
    simulation.begin(&mut sink).unwrap_or_else(|error| panic!("{error}"));
    simulation.run(&mut sink, &mut Unwatched).unwrap_or_else(|error| panic!("{error}"));
    simulation
}

fn run_scene(scene: &Scene, threads: usize) -> Simulation {
    let built = scene.built();
    run(&built.model, &built.state, RunPlan { threads: NonZeroUsize::new(threads), ..built.into() })
}

/// The fastest of so many runs \[s\], and what the last left.
fn fastest<T>(times: usize, mut work: impl FnMut() -> T) -> (f64, T) {
    let mut once = || {
        let begin = processor_seconds();
        let left = work();
        (processor_seconds() - begin, left)
    };
    let first = once();
    (1..times).fold(first, |(seconds, _), _| {
        let (again, left) = once();
        (seconds.min(again), left)
    })
}

fn at_tolerance(rtol: f64) -> Tolerance {
    Tolerance { rtol, atol: 1e-2 * rtol }
}

/// The calls of a rigid box at their floors.
fn floor_of_calls(arithmetic: &Arithmetic, calls: [f64; 3]) -> Floor {
    let [evaluations, jacobians, factorizations] = calls;
    let operations = evaluations * LOADS_OF_BOX + jacobians * SLOPES_OF_BOX + factorizations * FACTORS;
    Floor { seconds: arithmetic.seconds(operations), of: "its calls at their floors".to_owned() }
}

fn calls(statistics: &Statistics) -> [f64; 3] {
    [statistics.rate_evaluations, statistics.jacobians, statistics.factorizations].map(|count| count as f64)
}

fn throws(arithmetic: &Arithmetic, count: u64) -> BenchmarkRow {
    let (rtol, gap, damping) = THROWN;
    let die = Die::new(gap, damping, rtol);
    let mut sums = [0.0; 3];
    let begin = processor_seconds();
    for number in 0..count {
        let made = calls(&run(&die.model, &die.throw(number), die.plan).statistics());
        (0..3).for_each(|k| sums[k] += made[k]);
    }
    let seconds = (processor_seconds() - begin) / count as f64;
    let means = sums.map(|sum| sum / count as f64);
    BenchmarkRow {
        key: "throw".to_owned(),
        work: format!("a die thrown until it rests, rtol {rtol:.0e}"),
        seconds,
        floor: Some(floor_of_calls(arithmetic, means)),
        remark: format!(
            "{:.0} throws a second; {:.0} evaluations, {:.0} Jacobians each",
            1.0 / seconds,
            means[0],
            means[1]
        ),
    }
}

/// The rigid or the affine cube that falls on a plane, at the loosest tolerance that keeps its error.
fn cube(arithmetic: &Arithmetic, kind: &str, (model, start): &(Model, State)) -> BenchmarkRow {
    let reference = integrate(model, start, Method::Explicit, 1e-13).0;
    let off = |rtol: f64| {
        let ends = integrate(model, start, Method::Auto, rtol).0;
        ends.iter().zip(&reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let tolerances = (10..=24).map(|k| libm::pow(10.0, -0.5 * f64::from(k)));
    let found = tolerances.map(|rtol| (rtol, off(rtol))).find(|(_, error)| *error <= ERROR);
    let (rtol, error) = found.unwrap_or((1e-13, 0.0));
    let statistics = integrate(model, start, Method::Auto, rtol).1;
    let seconds = seconds_each(|| drop(integrate(model, start, Method::Auto, rtol)));
    BenchmarkRow {
        key: format!("cube/{kind}"),
        work: format!("{kind} cube on a plane to t = {END}, true error {ERROR:.0e}"),
        seconds,
        floor: Some(floor_of_calls(arithmetic, calls(&statistics))),
        remark: format!("rtol {rtol:.0e}, error {error:.1e}, {} evaluations", statistics.rate_evaluations),
    }
}

/// The state at the end, by the steppers alone.
fn integrate(model: &Model, start: &State, method: Method, rtol: f64) -> (Vec<f64>, Statistics) {
    let system = ModelSystem::new(model.clone(), start, at_tolerance(rtol));
    let mut system = system.unwrap_or_else(|error| panic!("{error}"));
    let options = Options { method, order: ImplicitOrder::at_tolerance(rtol), ..Options::default() };
    let mut integrator = Integrator::new(0.0, &start.bodies, &start.works, options);
    while integrator.time() < END {
        integrator.step(&mut system, END).unwrap_or_else(|error| panic!("{error:?}"));
    }
    (integrator.state().to_vec(), *integrator.statistics())
}

/// A soft cube alone for 2 s, at the loosest tolerance that keeps its energy.
fn free_cube() -> BenchmarkRow {
    let scene = |rtol: f64| {
        let text = format!(
            r#"
world = {{ gravity = [0, 0, 0] }}
time = {{ end = 2, sample = 0.02 }}
solver = {{ rtol = {rtol:?}, atol = {:?} }}
[[body]]
name = "cube"
shape = {{ box = {{ size = [0.1, 0.1, 0.1] }} }}
mass = 1
affine = {{ material = {{ neo_hookean_log = {{ mu = 3846.153846153846, lambda = 5769.230769230769 }} }} }}
gradient_rate = [[3, 0, 0], [0, -1.5, 0], [0, 0, -1.5]]
"#,
            1e-2 * rtol
        );
        Scene::parse("cube.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
    };
    let missed = |rtol: f64| {
        let simulation = run_scene(&scene(rtol), 1);
        simulation.run_state().largest_residual / simulation.energy_in_play()
    };
    let tolerances = (6..=20).map(|k| libm::pow(10.0, -0.5 * f64::from(k)));
    let found = tolerances.map(|rtol| (rtol, missed(rtol))).find(|(_, missed)| *missed <= BALANCE);
    let (rtol, missed) = found.unwrap_or((1e-10, 0.0));
    let scene = scene(rtol);
    let simulation = run_scene(&scene, 1);
    let seconds = seconds_each(|| drop(run_scene(&scene, 1)));
    BenchmarkRow {
        key: "free-cube".to_owned(),
        work: format!("soft cube alone for 2 s, balance {BALANCE:.0e} of its energy"),
        seconds,
        floor: None,
        remark: format!("rtol {rtol:.0e}, balance {missed:.1e}, {} steps", simulation.statistics().accepted()),
    }
}

/// Dice that never meet, on one thread and on two, beside what the same dice take a few at a time.
fn dice_apart(count: usize, add: &mut impl FnMut(BenchmarkRow)) {
    const FEW: usize = 10;
    const UNTIL: f64 = 0.2;
    let groups: Vec<Scene> =
        (0..count).step_by(FEW).map(|first| crowd::part(first..first + FEW, Throws::Different, UNTIL)).collect();
    let (few, ()) = fastest(2, || groups.iter().for_each(|scene| drop(run_scene(scene, 1))));
    let scene = crowd::scene(count, Throws::Different, UNTIL);
    let (seconds, simulation) = fastest(2, || run_scene(&scene, 1));
    add(BenchmarkRow {
        key: format!("apart/{count}"),
        work: format!("{count} dice that never meet, {UNTIL} s"),
        seconds,
        floor: Some(Floor { seconds: few, of: format!("the same dice, {FEW} at a time") }),
        remark: format!("{} steps", simulation.statistics().accepted()),
    });
    let begin = Instant::now();
    run_scene(&scene, 2);
    add(BenchmarkRow {
        key: format!("apart/{count}/two-threads"),
        work: "the same on two threads, by the clock on the wall".to_owned(),
        seconds: begin.elapsed().as_secs_f64(),
        floor: Some(Floor { seconds: 0.5 * seconds, of: "half of the time on one".to_owned() }),
        remark: String::new(),
    });
}

fn gas_of(count: usize) -> BenchmarkRow {
    let scene = gas::scene(count, 1.0);
    let (seconds, simulation) = fastest(2, || run_scene(&scene, 1));
    BenchmarkRow {
        key: format!("gas/{count}"),
        work: format!("gas of {count} balls, a tenth filled, for the time of a radius, rtol 1e-7"),
        seconds,
        floor: None,
        remark: format!("{} steps", simulation.statistics().accepted()),
    }
}

fn heap_of(count: usize) -> BenchmarkRow {
    const UNTIL: f64 = 0.25;
    let scene = heap::scene(count, UNTIL);
    let (seconds, simulation) = fastest(1, || run_scene(&scene, 1));
    BenchmarkRow {
        key: format!("heap/{count}"),
        work: format!("{count} dice poured into a bin, the impact, {UNTIL} s, rtol 1e-4"),
        seconds,
        floor: None,
        remark: format!("{} steps", simulation.statistics().accepted()),
    }
}

/// From the text of a scene to its simulation, before anything is recorded.
fn opening(count: usize) -> BenchmarkRow {
    let text = crowd::text(count, Throws::Different, 0.2);
    let (seconds, _) = fastest(2, || {
        let scene = Scene::parse("crowd.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
        let built = scene.built();
        Simulation::new(&built.model, &built.state, built.into()).unwrap_or_else(|error| panic!("{error}"))
    });
    BenchmarkRow {
        key: format!("open/{count}"),
        work: format!("a scene of {count} dice, each written out, until its run begins"),
        seconds,
        floor: None,
        remark: format!("{:.1} MB of text", 1e-6 * text.len() as f64),
    }
}
