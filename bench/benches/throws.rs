//! Throws of a die: how many a second, against the part of final faces that change when rtol is tightened tenfold.
//!
//!     cargo bench -p gyration-bench --bench throws -- 0.03 5e-4 1000 1e-4 1e-5 …     gap, damping, throws, tolerances
//!     cargo bench -p gyration-bench --bench throws -- growth 0.03 5e-4 100 1e-12     how a disturbance grows
//!
//! A throw is a run like any other, to rest, of which nothing is stored. One thread; seconds are those of the
//! processor.
#![allow(clippy::expect_used, reason = "a benchmark that cannot go on has failed")]

use gyration::state::State;
use gyration_benchmark::die::{BETA, Die, SIDE};
use gyration_benchmark::processor_seconds;
use gyration_ode::Statistics;
use gyration_sim::{MemorySink, Outcome, Simulation, Unwatched};

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let numbers: Vec<f64> = arguments.iter().filter_map(|argument| argument.parse().ok()).collect();
    let gap = numbers.first().copied().unwrap_or(0.03);
    let damping = numbers.get(1).copied().unwrap_or(BETA);
    let throws = numbers.get(2).map_or(100, |count| *count as u64);
    let tolerances = if numbers.len() > 3 { numbers[3..].to_vec() } else { vec![1e-6, 1e-7, 1e-8] };
    println!("rest gap {gap} of the side, damping {damping}, {throws} throws");
    if arguments.iter().any(|argument| argument == "growth") {
        tolerances.iter().for_each(|rtol| growth(&Die::new(gap, damping, *rtol), throws));
    } else {
        restitutions(gap, damping);
        curve((gap, damping), throws, &tolerances);
    }
}

/// What is known of a series of throws.
struct Series {
    endings: Vec<Ending>,
    faces: Vec<usize>,
    seconds: f64,
}

impl Series {
    fn of(die: &Die, throws: u64) -> Self {
        let began = processor_seconds();
        let endings: Vec<Ending> = (0..throws).map(|number| end(die, &die.throw(number))).collect();
        let seconds = processor_seconds() - began;
        let faces = endings.iter().map(|ending| die.lowest_face(&ending.state)).collect();
        Self { endings, faces, seconds }
    }

    fn mean(&self, of: impl Fn(&Ending) -> f64) -> f64 {
        self.endings.iter().map(of).sum::<f64>() / self.endings.len() as f64
    }
}

/// How a throw ended.
struct Ending {
    outcome: Outcome,
    state: State,
    statistics: Statistics,
    /// How many events of each kind.
    events: [u64; 3],
}

fn end(die: &Die, start: &State) -> Ending {
    let (simulation, outcome) = run(die, start, &mut MemorySink::default());
    let (statistics, events) = (simulation.statistics(), simulation.run_state().events);
    Ending { outcome, state: simulation.state(), statistics, events }
}

fn run(die: &Die, start: &State, sink: &mut MemorySink) -> (Simulation, Outcome) {
    let mut simulation = Simulation::new(&die.model, start, die.plan).expect("the start is admissible");
    simulation.begin(sink).expect("memory");
    let outcome = simulation.run(sink, &mut Unwatched).expect("memory");
    (simulation, outcome)
}

/// Throws a second against the part of faces that change from one tolerance to the next.
fn curve((gap, damping): (f64, f64), throws: u64, tolerances: &[f64]) {
    println!("    rtol  throws/s  changed  evaluations  explicit  implicit  rejected  closest approaches  seconds");
    let mut looser: Option<Vec<usize>> = None;
    for rtol in tolerances {
        let series = Series::of(&Die::new(gap, damping, *rtol), throws);
        let differ = |faces: &Vec<usize>| faces.iter().zip(&series.faces).filter(|(a, b)| a != b).count() as f64;
        println!(
            "{rtol:8.0e} {:9.1} {:8.4} {:12.0} {:9.0} {:9.0} {:9.1} {:19.1} {:8.3}{}",
            throws as f64 / series.seconds,
            looser.as_ref().map_or(f64::NAN, differ) / throws as f64,
            series.mean(|ending| ending.statistics.rate_evaluations as f64),
            series.mean(|ending| ending.statistics.explicit_steps as f64),
            series.mean(|ending| ending.statistics.implicit_steps as f64),
            series.mean(|ending| {
                let s = &ending.statistics;
                (s.rejected_error + s.rejected_domain + s.newton_failures) as f64
            }),
            series.mean(|ending| ending.events[1] as f64),
            series.mean(|ending| ending.state.time),
            match series.endings.iter().filter(|ending| !matches!(ending.outcome, Outcome::AtRest { .. })).count() {
                0 => String::new(),
                count => format!("   {count} not at rest"),
            },
        );
        looser = Some(series.faces);
    }
}

/// Speed after a drop from 0.2 m over the speed before, of a die that falls on a face, an edge and a vertex.
///
/// From the energies at the first apex: e² = 1 − (energy lost)/(kinetic energy at the height of touching).
fn restitutions(gap: f64, damping: f64) {
    let diagonal = (1.0_f64 / 3.0).sqrt().acos();
    let attitudes = [
        ("face", gyration::tensor::Vec3::x(), 0.0),
        ("edge", gyration::tensor::Vec3::x(), std::f64::consts::FRAC_PI_4),
        ("vertex", gyration::tensor::Vec3::new(1.0, -1.0, 0.0), diagonal),
    ];
    for (name, axis, angle) in attitudes {
        let mut die = Die::new(gap, damping, 1e-10);
        die.plan.stop_at_rest = None;
        (die.plan.end, die.plan.sample) = (0.6, 1e-3);
        let start = die.drop(&axis, angle);
        let (rows, first_apex) = record(&die, &start);
        let half = [0.5, 0.5_f64.sqrt(), 0.75_f64.sqrt()][attitudes.iter().position(|a| a.0 == name).unwrap_or(0)];
        let fall = start.bodies[2] - SIDE * (half + gap);
        let height = rows.iter().find(|(time, _)| *time >= first_apex).map_or(0.0, |(_, row)| row[2]);
        let rise = (height - SIDE * (half + gap)).max(0.0);
        println!("restitution on a {name}, from 0.2 m: {:.4}", (rise / fall).sqrt());
    }
}

/// The rows of a run, and the time of its first apex after a closest approach.
fn record(die: &Die, start: &State) -> (Vec<(f64, Vec<f64>)>, f64) {
    let mut sink = MemorySink::default();
    run(die, start, &mut sink);
    let touch = sink.events.iter().find(|event| event.kind == 1).map_or(f64::INFINITY, |event| event.time);
    let apex = sink.events.iter().find(|event| event.kind == 0 && event.time > touch);
    (sink.rows, apex.map_or(f64::INFINITY, |event| event.time))
}

/// How far two throws have drifted apart that differ by 1e-13 of the height at the start.
///
/// Distances of the attitudes, |P − P'|, by time; the quartiles over all throws.
fn growth(die: &Die, throws: u64) {
    let mut die = die.clone();
    die.plan.sample = 0.02;
    let mut distances: Vec<Vec<f64>> = Vec::new();
    let mut changed = 0;
    for number in 0..throws {
        let start = die.throw(number);
        let mut beside = start.clone();
        beside.bodies[2] *= 1.0 + 1e-13;
        let (one, other) = (record(&die, &start).0, record(&die, &beside).0);
        for (k, ((_, a), (_, b))) in one.iter().zip(&other).enumerate() {
            if distances.len() <= k {
                distances.push(Vec::new());
            }
            distances[k].push((3..12).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt());
        }
        let face =
            |rows: &[(f64, Vec<f64>)]| rows.last().map(|(_, row)| [row[9].round(), row[10].round(), row[11].round()]);
        changed += usize::from(face(&one) != face(&other));
    }
    println!("rtol {:e}: {changed} of {throws} final faces change; |P - P'| by time:", die.plan.tolerance.rtol);
    println!("  time  throws   quarter    median   three quarters");
    for (k, mut sorted) in distances.into_iter().enumerate().step_by(2) {
        sorted.sort_by(f64::total_cmp);
        let quantile = |part: f64| sorted[((sorted.len() - 1) as f64 * part) as usize];
        println!(
            "{:6.2} {:7} {:9.1e} {:9.1e} {:9.1e}",
            0.02 * k as f64,
            sorted.len(),
            quantile(0.25),
            quantile(0.5),
            quantile(0.75)
        );
    }
}
