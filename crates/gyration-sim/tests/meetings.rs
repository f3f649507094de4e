//! Bodies that come within reach of one another and part again: islands that become one and fall apart.
//!
//! Balls whose contact has a reach. Samples, windows, threads and kills leave no trace; momentum and energy are kept;
//! one step for all bodies finds the same paths.

use crate::islands::{Seen, motion_in, parsed};
use crate::runs::StopAfter;
use gyration::Party;
use gyration::dynamics::Workspace;
use gyration::instant::PairGaps;
use gyration::load::{Spring, SpringLaw};
use gyration::model::Model;
use gyration::neighbours::BodyPair;
use gyration::state::State;
use gyration::tensor::Vec3;
use gyration_ode::Statistics;
use gyration_sim::events::{APEX, EVENT_KINDS};
use gyration_sim::{MemorySink, Outcome, RunPlan, Simulation, Unwatched};
use std::num::NonZeroUsize;

/// No two of a cloud begin nearer than that from centre to centre [m].
const APART: f64 = 0.24;

/// The distance of the centres of the first two from which on they do nothing to each other [m].
fn cutoff(model: &Model) -> f64 {
    model.cutoff(&BodyPair { rule: 0, bodies: [0, 1] }).unwrap().centers
}

const HEAD: &str = r#"
    world = { gravity = [0, 0, 0] }
    time = { end = 4, sample = 0.25 }
    solver = { rtol = 1e-9, atol = 1e-11 }
    [[contact]]
    between = ["ball", "ball"]
    repulsion = { alpha = 1e6, nu = 6, d0 = 0.01 }
    reach = 0.1
"#;

/// Balls of so many numbers each: where they are, and how fast.
fn balls(starts: &[([f64; 3], [f64; 3])], overrides: &[&str]) -> (Model, State, RunPlan) {
    let mut text = HEAD.to_owned();
    for (k, (place, speed)) in starts.iter().enumerate() {
        text += &format!(
            "[[body]]\nname = \"b{k}\"\ngroup = \"ball\"\nshape = {{ sphere = {{ radius = 0.05 }} }}\nmass = {}\n\
             position = {place:?}\nvelocity = {speed:?}\n\
             angular_velocity = [1, 2, {k}]\n",
            1.0 + 0.1 * k as f64
        );
    }
    let scene = parsed(&text, overrides);
    let built = scene.built();
    (built.model.clone(), built.state.clone(), RunPlan::from(built))
}

/// A cloud of balls within a box, all towards its middle and a little beside it.
fn cloud(count: usize, overrides: &[&str]) -> (Model, State, RunPlan) {
    let mut seed = 1_u64;
    let mut number = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let mut starts: Vec<([f64; 3], [f64; 3])> = Vec::new();
    while starts.len() < count {
        let place = [0; 3].map(|_| 2.0 * number());
        let apart = |other: &[f64; 3]| (Vec3::from(*other) - Vec3::from(place)).norm() > APART;
        if starts.iter().all(|(other, _)| apart(other)) {
            starts.push((place, [0, 1, 2].map(|axis| -0.6 * place[axis] + 0.5 * number())));
        }
    }
    balls(&starts, overrides)
}

/// Rows, events, outcome, checkpoint and counters.
struct Found {
    kept: MemorySink,
    outcome: Outcome,
    checkpoint: Vec<u8>,
    statistics: Statistics,
    state: State,
    residual: f64,
}

fn run_of(mut simulation: Simulation) -> Found {
    let mut kept = MemorySink::default();
    simulation.begin(&mut kept).unwrap();
    let outcome = simulation.run(&mut kept, &mut Unwatched).unwrap();
    Found {
        outcome,
        checkpoint: simulation.checkpoint(),
        statistics: simulation.statistics(),
        state: simulation.state(),
        residual: simulation.run_state().largest_residual,
        kept,
    }
}

fn run((model, start, plan): &(Model, State, RunPlan)) -> Found {
    run_of(Simulation::new(model, start, *plan).unwrap())
}

fn momentum(model: &Model, state: &State) -> Vec3 {
    let own = |body: usize| model.bodies[body].solid.mass.mass * state.motion(model, body).velocity.velocity;
    (0..model.bodies.len()).map(own).sum()
}

#[test]
fn two_balls_that_meet_part_as_their_law_says() {
    // Head on in the frame of their centre of mass: they turn back with the speeds they came with.
    let starts = [([-0.5, 0.0, 0.0], [1.0, 0.3, 0.0]), ([0.5, 0.0, 0.0], [-1.0, 0.3, 0.0])];
    let scene = balls(&starts, &["time.end=1"]);
    let found = run(&scene);
    assert_eq!(found.outcome, Outcome::Completed);
    let (m, n) = (1.0, 1.1);
    let center = (m - n) / (m + n);
    let speeds = [0, 1].map(|body| found.state.motion(&scene.0, body).velocity.velocity);
    println!("{speeds:?}, residual {:.1e} J, {} steps", found.residual, found.statistics.accepted());
    for (speed, came) in speeds.iter().zip([1.0, -1.0]) {
        let error = speed - Vec3::new(2.0 * center - came, 0.3, 0.0);
        assert!(error.norm() < 1e-9, "{error}");
    }
    // Before and behind the impact each has steps of its own, which free flight makes long.
    assert!(found.statistics.accepted() < 200, "{}", found.statistics.accepted());
    assert!(found.residual < 1e-9);
}

#[test]
fn one_step_for_all_finds_the_same_paths() {
    let scene = cloud(12, &["solver.rtol=1e-11", "solver.atol=1e-13"]);
    let own = run(&scene);
    let together = run_of(Simulation::together(&scene.0, &scene.1, scene.2).unwrap());
    assert_eq!((&own.outcome, &together.outcome), (&Outcome::Completed, &Outcome::Completed));
    let place = |found: &Found, body: usize| found.state.motion(&scene.0, body).placement.position;
    let apart = (0..12).map(|body| (place(&own, body) - place(&together, body)).norm()).fold(0.0, f64::max);
    let moved = (0..12).map(|body| (place(&own, body) - scene.1.motion(&scene.0, body).placement.position).norm());
    println!(
        "apart by {apart:.1e}; {} against {} evaluations of all, moved by {:.2} at most",
        own.statistics.rate_evaluations,
        together.statistics.rate_evaluations,
        moved.fold(0.0, f64::max)
    );
    // Each impact multiplies errors of 1e-12 by some five.
    assert!(apart < 1e-8, "{apart:e}");
    let change = (momentum(&scene.0, &own.state) - momentum(&scene.0, &scene.1)).norm();
    println!("momentum changed by {change:.1e}, residual {:.1e} J", own.residual);
    assert!(change < 1e-13 && own.residual < 1e-9);
}

#[test]
fn samples_windows_and_threads_leave_no_trace() {
    let found = |sample: &str, threads: usize| {
        let (model, start, plan) = cloud(20, &[sample]);
        let plan = RunPlan { threads: NonZeroUsize::new(threads), ..plan };
        run(&(model, start, plan))
    };
    let one = found("time.sample=0.25", 1);
    assert_eq!(one.outcome, Outcome::Completed);
    for (sample, threads) in [("time.sample=0.25", 2), ("time.sample=4", 1), ("time.sample=0.01", 3)] {
        let other = found(sample, threads);
        assert_eq!(other.state, one.state, "{sample}, {threads} threads");
        assert_eq!(other.statistics, one.statistics);
        assert_eq!(format!("{:?}", other.kept.events), format!("{:?}", one.kept.events));
    }
    let again = found("time.sample=0.25", 2);
    assert!(again.checkpoint == one.checkpoint && format!("{:?}", again.kept.rows) == format!("{:?}", one.kept.rows));
}

/// Balls that fall into a corner of three planes, so that islands meet and part while events come and go.
#[test]
fn events_of_a_step_that_is_cut_stay_what_they_were() {
    let events = |sample: &str, threads: usize| {
        let mut text = HEAD.replace("gravity = [0, 0, 0]", "gravity = [0, 0, -9.81]");
        for (name, normal) in [("left", [1.0, 0.0, 0.4]), ("right", [-1.0, 0.2, 0.5]), ("back", [0.0, -1.0, 0.7])] {
            text += &format!(
                "[[support]]\nname = \"{name}\"\nplane = {{ normal = {normal:?} }}\n[[contact]]\nsupport = \"{name}\"\n\
                 repulsion = {{ alpha = 1e6, nu = 6, d0 = 0.01 }}\ndamping = {{ beta = 1e4, nu = 3, d0 = 0.01 }}\n"
            );
        }
        for k in 0..40 {
            text += &format!(
                "[[body]]\nname = \"b{k}\"\ngroup = \"ball\"\nshape = {{ sphere = {{ radius = 0.05 }} }}\nmass = 1\n\
                 position = [{}, {}, {}]\n",
                0.11 * (f64::from(k % 2) - 0.5),
                -0.11 * f64::from(k / 2 % 2) - 0.01 * f64::from(k / 4),
                0.5 + 0.13 * f64::from(k / 4),
            );
        }
        let scene = parsed(&text, &["time.end=0.6", "solver.rtol=1e-4", "solver.atol=1e-6", sample]);
        let built = scene.built();
        let plan = RunPlan { threads: NonZeroUsize::new(threads), ..RunPlan::from(built) };
        let found = run(&(built.model.clone(), built.state.clone(), plan));
        assert_eq!(found.outcome, Outcome::Completed);
        (found.kept.events, found.state)
    };
    let (one, end) = events("time.sample=0.1", 1);
    assert!(one.len() > 100, "{}", one.len());
    let runs = [("time.sample=0.01", 1), ("time.sample=0.001", 1), ("time.sample=0.0003", 1), ("time.sample=0.1", 3)];
    for (sample, threads) in runs {
        let (other, there) = events(sample, threads);
        assert_eq!((other.len(), there), (one.len(), end.clone()), "{sample}");
        assert_eq!(format!("{other:?}"), format!("{one:?}"), "{sample}");
    }
}

/// A row of boxes that run into one another on a floor, one island: threads share out their pairs and loads.
#[test]
fn a_team_leaves_no_trace() {
    for method in ["explicit", "implicit"] {
        let found = |threads: usize| {
            let mut text =
                "time = { end = 0.06, sample = 0.02 }\n[[support]]\nname = \"floor\"\nplane = {}\n".to_owned();
            for parties in ["support = \"floor\"", "between = [\"box\", \"box\"]\nreach = 0.05"] {
                text += &format!(
                    "[[contact]]\n{parties}\nrepulsion = {{ alpha = 1e3, nu = 6, d0 = 0.003 }}\n\
                     damping = {{ beta = 1e3, nu = 3, d0 = 0.003 }}\nfriction = {{ beta = 1e3, nu = 3, d0 = 0.003 }}\n"
                );
            }
            for k in 0..14 {
                text += &format!(
                    "[[body]]\nname = \"b{k}\"\ngroup = \"box\"\nshape = {{ box = {{ size = [0.05, 0.06, 0.07] }} }}\n\
                     mass = 1\nposition = [{}, 0, 0.038]\nvelocity = [{}, 0, 0]\nangular_velocity = [0, 0, {}]\n",
                    0.056 * f64::from(k),
                    0.1 * f64::from(7 - k),
                    0.3 * f64::from(k % 3),
                );
            }
            let scene = parsed(&text, &[&format!("solver.method=\"{method}\""), "solver.rtol=1e-5"]);
            let built = scene.built();
            let plan = RunPlan { threads: NonZeroUsize::new(threads), ..RunPlan::from(built) };
            run(&(built.model.clone(), built.state.clone(), plan))
        };
        let (alone, team) = (found(1), found(3));
        assert_eq!(alone.outcome, Outcome::Completed);
        println!("{method}: {:?}", alone.statistics);
        assert!(alone.checkpoint == team.checkpoint && alone.statistics.accepted() > 10);
        assert_eq!(format!("{:?}", alone.kept.rows), format!("{:?}", team.kept.rows));
    }
}

#[test]
fn a_run_goes_on_from_any_checkpoint_to_the_same_bytes() {
    let scene = cloud(12, &[]);
    let whole = run(&scene);
    for windows in [1, 4, 9, 14] {
        let mut run = Simulation::new(&scene.0, &scene.1, scene.2).unwrap();
        let (mut kept, mut stop) = (MemorySink::default(), StopAfter(windows));
        run.begin(&mut kept).unwrap();
        assert!(matches!(run.run(&mut kept, &mut stop).unwrap(), Outcome::Stopped(_)), "{windows} were too many");
        let mut rest = Simulation::resume(&scene.0, &scene.1, scene.2, &run.checkpoint()).unwrap();
        rest.run(&mut kept, &mut Unwatched).unwrap();
        assert_eq!(rest.state(), whole.state, "{windows}");
        assert_eq!(rest.statistics(), whole.statistics);
        assert!(rest.checkpoint() == whole.checkpoint);
        assert_eq!(format!("{:?}", kept.rows), format!("{:?}", whole.kept.rows));
    }
}

#[test]
fn rows_at_events_are_those_of_the_path() {
    // Gravity bends the ways, and bodies that rise have an apex.
    let overrides = ["world.gravity=[0, 0, -2]", "time.end=2"];
    let (model, start, plan) = cloud(9, &overrides);
    let rows = |wants_rows| {
        let mut simulation = Simulation::new(&model, &start, plan).unwrap();
        let mut seen = Seen { wants_rows, ..Seen::default() };
        simulation.begin(&mut seen).unwrap();
        simulation.run(&mut seen, &mut Unwatched).unwrap();
        (seen, simulation.state())
    };
    let ((with, end), (without, same)) = (rows(true), rows(false));
    assert_eq!((&end, &with.kept.events), (&same, &without.kept.events));
    assert!(with.kept.events.len() > 3 && with.at_events.len() == with.kept.events.len());
    let apices = with.at_events.iter().filter(|(event, _)| event.kind == APEX);
    for (event, row) in apices {
        // The apex of a body is where its centre has no velocity upwards.
        let speed = motion_in(row, 9, event.body)[12 + 2];
        assert!(speed.abs() < 1e-6, "{event:?}: {speed:e} m/s");
    }
}

#[test]
fn balls_that_pass_one_another_never_know_of_each_other() {
    let starts = |beside: f64| [([-0.5, 0.0, 0.0], [1.0, 0.0, 0.0]), ([0.5, beside, 0.0], [-1.0, 0.0, 0.0])];
    let beside = cutoff(&balls(&starts(1.0), &[]).0) + 1e-4;
    let (model, start, plan) = balls(&starts(beside), &["time.end=1"]);
    let found = run(&(model.clone(), start.clone(), plan));
    let apart = model.meeting(Vec::new());
    let alone = run(&(apart.clone(), State { works: vec![0.0; apart.works().len()], ..start }, plan));
    assert_eq!(found.state.bodies, alone.state.bodies);
    assert_eq!(found.statistics, alone.statistics);
}

#[test]
fn the_slabs_of_one_body_are_those_among_all() {
    let starts: Vec<_> = (0..6).map(|k| ([0.13 * f64::from(k), 0.02 * f64::from(k % 2), 0.0], [0.0; 3])).collect();
    let (model, start, _) = balls(&starts, &[]);
    let gaps = |found: &PairGaps, body: usize| found.of(body).map(|slab| slab.gap).collect::<Vec<_>>();
    let mut workspace = Workspace::default();
    for body in 0..starts.len() {
        let all = gaps(workspace.pair_gaps(&model, 0.0, start.numbers()).unwrap(), body);
        let own = workspace.pair_gaps_of((&model, body), 0.0, start.numbers()).unwrap();
        assert_eq!(gaps(own, body), all);
        assert!(all.iter().any(|gap| gap.is_finite()), "one is within reach: {all:?}");
        // Nobody looks at two others.
        let others = own.iter().filter(|(pair, _)| !pair.parties.contains(&Party::Body(body)));
        let others: Vec<f64> = others.map(|(_, slab)| slab.gap).collect();
        assert!(!others.is_empty() && others.iter().all(|gap| gap.is_infinite()), "{others:?}");
    }
}

/// A row that moves as a whole, each ball at the end of the reach of the next: to the last digit, and within the part
/// of it that is left out.
#[test]
fn balls_that_stay_at_the_end_of_their_reach_do_not_meet_and_part_in_turns() {
    let row = |spacing: f64| -> Vec<_> {
        (0..5).map(|k| ([0.07 + spacing * f64::from(k), 0.0, 0.0], [-1.0, 0.0, 0.0])).collect()
    };
    let edge = cutoff(&balls(&row(1.0), &[]).0);
    let (model, start, plan) = balls(&row(edge + 1e-10), &["time.end=2"]);
    let found = run(&(model.clone(), start.clone(), plan));
    let apart = model.clone().meeting(Vec::new());
    let alone = run(&(apart.clone(), State { works: vec![0.0; apart.works().len()], ..start }, plan));
    assert_eq!(found.state.bodies, alone.state.bodies);
    assert_eq!(found.statistics, alone.statistics);
    let of = |spacing| run(&balls(&row(spacing), &["time.end=2"]));
    // Some of them are one island, and stay so: they push each other.
    let nearer = of(edge - 1e-3);
    assert_ne!(nearer.state.motion(&model, 0).velocity.velocity.x, -1.0);
    let most = nearer.statistics.rate_evaluations + alone.statistics.rate_evaluations;
    for spacing in [edge, edge.next_up(), edge.next_down()] {
        let count = of(spacing).statistics.rate_evaluations;
        println!("{count} evaluations, {most} expected at most");
        assert!(count <= most, "{count}");
    }
}

#[test]
fn springs_stay_while_neighbours_come_and_go() {
    // A pair on a spring is hit by a ball, and goes on as a pair.
    let starts = [
        ([0.0, 0.0, 0.0], [0.0; 3]),
        ([0.0, 0.6, 0.0], [0.0; 3]),
        ([-1.0, 0.02, 0.0], [1.5, 0.0, 0.0]),
        ([0.0, 3.0, 0.0], [0.0; 3]),
    ];
    let (model, start, plan) = balls(&starts, &["time.end=3"]);
    let spring = SpringLaw { stiffness: 30.0, rest_length: 0.6, damping: 0.0 };
    let model = model.with_springs(vec![Spring::between([1, 0], [Vec3::zeros(); 2], spring)]);
    let start = State { works: vec![0.0; model.works().len()], ..start };
    let own = run(&(model.clone(), start.clone(), plan));
    let together = run_of(Simulation::together(&model, &start, plan).unwrap());
    let place = |found: &Found, body: usize| found.state.motion(&model, body).placement.position;
    let apart = (0..4).map(|body| (place(&own, body) - place(&together, body)).norm()).fold(0.0, f64::max);
    println!("apart by {apart:.1e}; hit: {:?}", place(&own, 0));
    assert!(apart < 1e-7 && place(&own, 0).x > 0.5 && place(&own, 3) == Vec3::new(0.0, 3.0, 0.0));
    let change = (momentum(&model, &own.state) - momentum(&model, &start)).norm();
    assert!(change < 1e-13 && own.residual < 1e-8, "{change:e} {:e}", own.residual);
}

/// Two pairs of balls that turn back soon after each other, mostly within the same part of a step: where the second one
/// does is not where slabs were looked at to find the first.
#[test]
fn events_of_one_pair_leave_those_of_another_where_they_are() {
    let mut fastest: f64 = 0.0;
    for k in -10..=10 {
        let later = 0.1 + 4e-4 * f64::from(k);
        let ball = |x: f64, y: f64, speed: f64| ([x, y, 0.0], [speed, 0.0, 0.0]);
        let starts = [ball(-0.1, 0.0, 0.5), ball(0.1, 0.0, -0.5), ball(-later, 1.0, 0.5), ball(later, 1.0, -0.5)];
        let (model, start, plan) = balls(&starts, &["solver.rtol=1e-6", "time.end=0.4"]);
        let found = run_of(Simulation::together(&model, &start, plan).unwrap());
        let closest = found.kept.events.iter().filter(|event| EVENT_KINDS[event.kind] == "closest_approach");
        let closest: Vec<_> = closest.collect();
        assert_eq!(closest.len(), 4, "{closest:?}");
        for event in closest {
            let plan = RunPlan { end: event.time, ..plan };
            let there = run_of(Simulation::together(&model, &start, plan).unwrap()).state;
            let speed = |body: usize| there.motion(&model, body).velocity.velocity.x;
            fastest = fastest.max((speed(event.body) - speed(event.body ^ 1)).abs());
        }
    }
    println!("balls that turn back move by {fastest:.1e} m/s towards each other");
    // Another end makes other steps, at rtol 1e-6: some 1e-6 of a speed of 1 m/s.
    assert!(fastest < 1e-5);
}
