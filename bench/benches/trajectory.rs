//! One trajectory against its error: the rigid or the soft cube of `bench/peers` to t = 10, with exact integrals.
//!
//!     cargo bench -p gyration-bench --bench trajectory [-- rigid|affine [REFERENCE]]
//!
//! Prints a line a run, as the peers do: solver, rule, rtol, error, milliseconds, calls of the rates. The error is the
//! largest difference of the state at the end from that at rtol 1e-13; with the file of references of the peers, also
//! from that of their graded rule, which resolves the same equations. Times are those of the fastest run, as the peers'
//! are.
#![allow(clippy::expect_used, reason = "a benchmark that cannot go on has failed")]

use gyration::model::Model;
use gyration::state::State;
use gyration_benchmark::near_table;
use gyration_benchmark::soft::{cube_over_table, material};
use gyration_ode::{ImplicitOrder, Integrator, Method, Options};
use gyration_sim::adapter::ModelSystem;
use gyration_sim::rows::Extras;
use gyration_sim::{RunPlan, Simulation, Sink, Tolerance, Unwatched};
use std::time::Instant;

const END: f64 = 10.0;

/// The state at the end and the calls it took.
struct Reached {
    state: Vec<f64>,
    calls: u64,
}

/// atol is a hundredth of rtol, as in a scene's defaults.
fn tolerance(rtol: f64) -> Tolerance {
    Tolerance { rtol, atol: 1e-2 * rtol }
}

/// By the steppers alone, works included.
fn by_integrator(model: &Model, start: &State, method: Method, rtol: f64) -> Reached {
    let mut system = ModelSystem::new(model.clone(), start, tolerance(rtol)).expect("the start is admissible");
    let options = Options { method, order: ImplicitOrder::at_tolerance(rtol), ..Options::default() };
    let mut integrator = Integrator::new(0.0, &start.bodies, &start.works, options);
    while integrator.time() < END {
        integrator.step(&mut system, END).expect("the cube never touches");
    }
    Reached { state: integrator.state().to_vec(), calls: integrator.statistics().rate_evaluations }
}

/// Keeps nothing.
struct Nowhere;

impl Sink for Nowhere {}

/// By a whole run: horizon, events, ledger, a row at the end.
fn by_simulation(model: &Model, start: &State, method: Method, rtol: f64) -> Reached {
    let options = Options { method, order: ImplicitOrder::at_tolerance(rtol), ..Options::default() };
    let plan = RunPlan {
        end: END,
        sample: END,
        stop_at_rest: None,
        tolerance: tolerance(rtol),
        options,
        extras: Extras::default(),
        pairs: false,
        threads: None,
    };
    let mut simulation = Simulation::new(model, start, plan).expect("the start is admissible");
    simulation.begin(&mut Nowhere).expect("nothing is stored");
    simulation.run(&mut Nowhere, &mut Unwatched).expect("nothing is stored");
    Reached { state: simulation.state().bodies, calls: simulation.statistics().rate_evaluations }
}

/// The fastest of at least three runs, and of those that a second has room for [s].
fn fastest_seconds(run: impl Fn()) -> f64 {
    let (mut fastest, mut spent, mut runs) = (f64::INFINITY, 0.0, 0);
    while runs < 3 || (runs < 25 && spent < 1.0) {
        let begin = Instant::now();
        run();
        let took = begin.elapsed().as_secs_f64();
        (fastest, spent, runs) = (took.min(fastest), spent + took, runs + 1);
    }
    fastest
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The second line of the peers' file, their graded rule.
fn peers_reference(path: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(path).expect("the file of references can be read");
    let line = text.lines().nth(1).expect("it has a line a rule");
    line.split_whitespace().map(|word| word.parse().expect("it holds numbers")).collect()
}

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|argument| !argument.starts_with('-'));
    let (model, start) = match arguments.next().as_deref() {
        Some("affine") => cube_over_table(material("neo_hookean_log"), 2.0),
        _ => near_table("{ box = { size = [1, 1, 1] } }", 2.0, (6.0, 3.0)),
    };
    let reference = by_integrator(&model, &start, Method::Explicit, 1e-13).state;
    if let Some(path) = arguments.next() {
        println!(
            "# {:.1e} from the reference of the peers' graded rule",
            distance(&reference, &peers_reference(&path))
        );
    }
    type Solve = fn(&Model, &State, Method, f64) -> Reached;
    let plans: [(&str, Solve, Method, std::ops::RangeInclusive<i32>); 4] = [
        ("gyration", by_integrator, Method::Auto, 4..=12),
        ("gyration-explicit", by_integrator, Method::Explicit, 4..=12),
        ("gyration-implicit", by_integrator, Method::Implicit, 4..=9),
        ("gyration-simulation", by_simulation, Method::Auto, 4..=12),
    ];
    for (name, solve, method, exponents) in plans {
        for exponent in exponents {
            let rtol = 10_f64.powi(-exponent);
            let Reached { state, calls } = solve(&model, &start, method, rtol);
            let seconds = fastest_seconds(|| drop(solve(&model, &start, method, rtol)));
            println!("{name} exact {rtol:.0e} {:.3e} {:.4} {calls}", distance(&state, &reference), 1e3 * seconds);
        }
    }
}
