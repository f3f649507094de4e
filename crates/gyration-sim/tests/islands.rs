//! Bodies with steps of their own: each moves as if it were alone, and the run joins them whatever the windows and the
//! threads.

use crate::runs::{StopAfter, bytes, provenance};
use gyration::load::Applied;
use gyration::state::BodyMotion;
use gyration::tensor::Vec3;
use gyration_record::RecordError;
use gyration_scene::Scene;
use gyration_sim::events::Event;
use gyration_sim::{
    Job, MemorySink, Monitor, Outcome, Progress, Reason, RecordingEnd, RunError, RunPlan, Simulation, Sink, SteppedRun,
    Unwatched,
};
use std::num::NonZeroUsize;
use std::path::Path;

pub const HEAD: &str = r#"
    time = { end = 0.4, sample = 0.02 }
    [[support]]
    name = "table"
    plane = {}
    [[contact]]
    support = "table"
    measure = "reference_area"
    repulsion = { alpha = "245 Pa", nu = 6, d0 = "0.6 mm" }
    damping = { beta = 1e4, nu = 3, d0 = "0.6 mm" }
    friction = { beta = 1e4, nu = 3, d0 = "0.6 mm" }
"#;

/// A die that is thrown in a way of its own; every third is a ball, every fifth of rubber.
pub fn body(index: usize) -> String {
    let shape =
        if index % 3 == 2 { "{ sphere = { radius = \"1 cm\" } }" } else { "{ box = { size = [0.02, 0.02, 0.02] } }" };
    let kind =
        if index % 5 == 4 { "affine = { material = { neo_hookean = { shear = 2e4 } }, viscosity = 20 }" } else { "" };
    format!(
        "[[body]]\nname = \"b{index}\"\nshape = {shape}\ndensity = 1250\n{kind}\nposition = [{}, 0, {}]\n\
         orientation = {{ axis_angle = {{ axis = [1, {}, 0.3], angle = \"{} deg\" }} }}\n\
         velocity = [0.3, 0, {}]\nangular_velocity = [{}, 20, 3]\n",
        0.05 * index as f64,
        0.04 + 0.003 * index as f64,
        0.1 * (index % 7) as f64,
        10 + 7 * (index % 11),
        -0.2 + 0.01 * index as f64,
        3 * (index % 4),
    )
}

fn scene_of(indices: impl IntoIterator<Item = usize>, overrides: &[&str]) -> Scene {
    let mut text = HEAD.to_owned();
    indices.into_iter().for_each(|index| text.push_str(&body(index)));
    parsed(&text, overrides)
}

pub fn parsed(text: &str, overrides: &[&str]) -> Scene {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Scene::parse("scene.toml", text, Path::new(""), &overrides).unwrap()
}

/// Rows, events and event rows.
#[derive(Debug, Default, PartialEq)]
pub struct Seen {
    pub kept: MemorySink,
    pub at_events: Vec<(Event, Vec<f64>)>,
    pub wants_rows: bool,
}

impl Sink for Seen {
    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        self.kept.row(time, row)
    }

    fn event(&mut self, event: &Event) -> Result<(), RecordError> {
        self.kept.event(event)
    }

    fn wants_event_rows(&self) -> bool {
        self.wants_rows
    }

    fn event_row(&mut self, event: &Event, row: &[f64]) -> Result<(), RecordError> {
        self.at_events.push((*event, row.to_vec()));
        Ok(())
    }
}

/// Counts windows.
struct Counter(usize);

impl Monitor for Counter {
    fn after_step(&mut self, _: &Progress) -> Option<Reason> {
        self.0 += 1;
        None
    }
}

/// Stops after so many steps of all bodies together.
struct Most(u64);

impl Monitor for Most {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        (progress.statistics.accepted() >= self.0).then_some(Reason::Interrupted)
    }

    fn counts_steps(&self) -> bool {
        true
    }
}

/// What a run tells, its outcome, and its last checkpoint.
pub fn run(scene: &Scene, threads: usize, wants_rows: bool) -> (Seen, Outcome, Vec<u8>) {
    let job = Job::of(scene, &provenance());
    let mut plan = job.plan;
    plan.threads = NonZeroUsize::new(threads);
    let mut simulation = Simulation::new(job.model, job.start, plan).unwrap();
    let mut seen = Seen { wants_rows, ..Seen::default() };
    simulation.begin(&mut seen).unwrap();
    let outcome = simulation.run(&mut seen, &mut Unwatched).unwrap();
    (seen, outcome, simulation.checkpoint())
}

/// Position, P, velocity and Ṗ of a body in the row of a model of so many rigid bodies.
pub fn motion_in(row: &[f64], bodies: usize, body: usize) -> Vec<f64> {
    let (mut numbers, mut start) = (Vec::new(), 0);
    for width in [3, 9, 3, 9] {
        numbers.extend_from_slice(&row[start + width * body..start + width * (body + 1)]);
        start += width * bodies;
    }
    numbers
}

#[test]
fn each_body_moves_to_the_last_bit_as_if_it_were_alone() {
    const COUNT: usize = 12;
    for wants_rows in [false, true] {
        let (all, outcome, _) = run(&scene_of(0..COUNT, &[]), 1, wants_rows);
        assert_eq!(outcome, Outcome::Completed);
        for body in 0..COUNT {
            let (alone, ..) = run(&scene_of([body], &[]), 1, wants_rows);
            assert_eq!(all.kept.rows.len(), alone.kept.rows.len());
            for ((time, row), (own_time, own)) in all.kept.rows.iter().zip(&alone.kept.rows) {
                assert_eq!(time, own_time);
                assert_eq!(motion_in(row, COUNT, body), motion_in(own, 1, 0), "b{body} at {time} s");
            }
            let own = |event: &&Event| event.body == body;
            let told: Vec<_> = all.kept.events.iter().filter(own).map(|event| (event.time, event.kind)).collect();
            assert_eq!(told, alone.kept.events.iter().map(|event| (event.time, event.kind)).collect::<Vec<_>>());
            let at_own = all.at_events.iter().filter(|(event, _)| event.body == body);
            let at_own: Vec<_> = at_own.map(|(_, row)| motion_in(row, COUNT, body)).collect();
            assert_eq!(at_own, alone.at_events.iter().map(|(_, row)| motion_in(row, 1, 0)).collect::<Vec<_>>());
        }
        assert!(all.kept.events.len() > 5 * COUNT && all.kept.events.is_sorted_by_key(|event| event.time));
        assert_eq!(all.at_events.len(), if wants_rows { all.kept.events.len() } else { 0 });
    }
}

#[test]
fn the_number_of_threads_leaves_no_trace() {
    let scene = scene_of(0..20, &[]);
    // In words, since some numbers are none.
    let one = format!("{:?}", run(&scene, 1, false));
    for threads in [2, 3, 7] {
        assert!(format!("{:?}", run(&scene, threads, false)) == one, "{threads} threads");
    }
}

#[test]
fn fifty_bodies_are_resumed_at_any_moment_to_the_same_bytes() {
    let scene = scene_of(0..50, &["time.end=0.2"]);
    let folder = tempfile::tempdir().unwrap();
    let job = Job::of(&scene, &provenance());
    let whole = folder.path().join("whole.gyr");
    let mut counter = Counter(0);
    job.record(&whole, &mut counter).unwrap();
    let Counter(all) = counter;
    assert!(all > 10, "{all} windows");
    for windows in [1, all / 4, all / 2, 3 * all / 4, all - 1] {
        let path = folder.path().join(format!("{windows}.gyr"));
        let RecordingEnd::Ran(summary) = job.record(&path, &mut StopAfter(windows)).unwrap() else { panic!("not run") };
        assert!(!summary.outcome.is_final(), "{windows} windows were too many");
        job.resume(&path, &mut StopAfter(3)).unwrap();
        job.resume(&path, &mut Unwatched).unwrap();
        assert!(bytes(&whole) == bytes(&path), "after {windows} windows");
    }
}

/// Each with its own steps against one step for all, at a tolerance where both are exact.
#[test]
fn own_steps_and_one_step_for_all_find_the_same_paths() {
    let scene = scene_of(0..6, &["solver.rtol=1e-11", "solver.atol=1e-13", "time.end=0.12"]);
    let job = Job::of(&scene, &provenance());
    let end = |mut simulation: Simulation| {
        let mut sink = MemorySink::default();
        simulation.begin(&mut sink).unwrap();
        assert_eq!(simulation.run(&mut sink, &mut Unwatched).unwrap(), Outcome::Completed);
        (simulation.state(), simulation.statistics().rate_evaluations)
    };
    let (own, _) = end(Simulation::new(job.model, job.start, job.plan).unwrap());
    let (together, _) = end(Simulation::together(job.model, job.start, job.plan).unwrap());
    let mut worst: f64 = 0.0;
    for body in 0..6 {
        let [a, b] = [&own, &together].map(|state| state.motion(job.model, body).placement);
        let size = job.model.bodies[body].size;
        worst = worst.max((a.position - b.position).norm() / size).max((a.gradient - b.gradient).norm());
    }
    println!("apart by {worst:.1e} sizes");
    assert!(worst < 1e-10, "{worst:e}");
    for (work, (a, b)) in job.model.works().iter().zip(own.works.iter().zip(&together.works)) {
        assert!((a - b).abs() < 1e-10 * a.abs().max(1e-4), "{work:?}: {a} {b}");
    }
}

#[test]
fn a_body_that_cannot_go_on_stops_all_at_its_time() {
    // The first law is that of the first body alone; nothing keeps the second from the table.
    let weak = "[[contact]]\nbody = \"b1\"\nsupport = \"table\"\nrepulsion = { alpha = 1e-30, nu = 1, d0 = 1 }\n";
    let strong = HEAD.replace("    [[contact]]", "    [[contact]]\n    body = \"b0\"");
    let text = [strong, body(0), body(1), weak.to_owned()].concat();
    let scene = parsed(&text, &["time.end=2"]);
    let (seen, outcome, _) = run(&scene, 2, false);
    assert_eq!(run(&scene, 1, true).1, outcome, "by the smallest windows");
    let Outcome::Stopped(stop) = &outcome else { panic!("{outcome:?}") };
    assert_eq!((stop.reason, stop.body.as_deref()), (Reason::GapClosed, Some("b1")));
    let (last, row) = seen.kept.rows.last().unwrap();
    assert_eq!(*last, stop.time);
    let (alone, ..) = run(&scene_of([0], &[&format!("time.end={last:?}")]), 1, false);
    let (end, own) = alone.kept.rows.last().unwrap();
    assert_eq!(end, last);
    // The one that is alone lands on that time by a step of another length, here in free fall: steps may err by 1e-9 of
    // its own scales, of which the largest is a rate of 20 1/s.
    let apart = motion_in(row, 2, 0).iter().zip(motion_in(own, 1, 0)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("apart by {apart:.1e}");
    assert!(apart < 2e-8, "{apart:e}");
    assert!(seen.kept.events.iter().all(|event| event.time <= *last));
}

#[test]
fn rest_is_when_the_last_body_has_come_to_it() {
    let rest = ["time.stop_at_rest.speed=1e-3", "time.stop_at_rest.hold=0.05", "time.end=3"];
    let time = |indices: &[usize]| match run(&scene_of(indices.iter().copied(), &rest), 1, false) {
        (seen, Outcome::AtRest { time }, _) => {
            assert_eq!(seen.kept.rows.last().unwrap().0, time);
            assert!(seen.kept.rows.is_sorted_by(|a, b| a.0 < b.0));
            time
        }
        (_, outcome, _) => panic!("{outcome:?}"),
    };
    let alone = [0, 1, 3].map(|body| time(&[body]));
    assert_eq!(time(&[0, 1, 3]), alone.into_iter().fold(0.0, f64::max), "{alone:?}");
}

#[test]
fn a_controller_finds_all_bodies_at_one_time() {
    let scene = scene_of(0..5, &[]);
    let mut run = SteppedRun::new(scene.built()).unwrap();
    for until in [0.05, 0.051, 0.13] {
        run.advance(until, &mut Unwatched).unwrap();
        assert_eq!((run.time(), run.state().time), (until, until));
        for body in 0..5 {
            assert_eq!(run.state().motion(run.model(), body), *run.motion(body));
        }
    }
    let before = run.time();
    run.step().unwrap();
    assert!(run.time() > before);
    for body in 0..5 {
        assert_eq!(run.state().motion(run.model(), body), *run.motion(body));
    }
}

/// Position, P, velocity and Ṗ of a body, in one list.
fn numbers(motion: &BodyMotion) -> Vec<f64> {
    let (placement, velocity) = (&motion.placement, &motion.velocity);
    let vectors = [placement.position.as_slice(), velocity.velocity.as_slice()].concat();
    [vectors.as_slice(), placement.gradient.as_slice(), velocity.gradient_rate.as_slice()].concat()
}

#[test]
fn a_controller_that_is_stopped_on_its_way_finds_all_bodies_at_one_time_too() {
    let scene = scene_of(0..5, &[]);
    let end = |stops: &[usize]| {
        let mut run = SteppedRun::new(scene.built()).unwrap();
        for windows in stops {
            let stop = run.advance(0.1, &mut StopAfter(*windows)).unwrap_err();
            assert_eq!((stop.time, run.state().time), (run.time(), run.time()));
            assert!(run.time() > 0.0 && run.time() < 0.1);
            for body in 0..5 {
                assert_eq!(run.state().motion(run.model(), body), *run.motion(body), "b{body}");
            }
            run.apply(2, Applied { force: Vec3::new(0.0, 0.0, 1e-3), ..Applied::default() }).unwrap();
            run.apply(2, Applied::default()).unwrap();
        }
        run.advance(0.1, &mut Unwatched).unwrap();
        assert_eq!(run.time(), 0.1);
        let residual = run.ledger().unwrap().residual;
        assert!(residual.abs() < 1e-9, "{residual:e}");
        (0..5).flat_map(|body| numbers(run.motion(body))).collect::<Vec<_>>()
    };
    let whole = end(&[]);
    let apart = end(&[12, 3, 2]).iter().zip(&whole).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("apart by {apart:.1e}");
    // Other steps to the same place, rates up to 30 1/s among the numbers: a hundred errors of steps, 1e-9 of these.
    assert!(apart < 3e-6, "{apart:e}");
}

#[test]
fn a_limit_of_steps_does_not_depend_on_samples_or_threads() {
    let stopped = |sample: &str, threads: usize| {
        let scene = scene_of(0..9, &[sample]);
        let job = Job::of(&scene, &provenance());
        let plan = RunPlan { threads: NonZeroUsize::new(threads), ..job.plan };
        let mut simulation = Simulation::new(job.model, job.start, plan).unwrap();
        let mut sink = MemorySink::default();
        simulation.begin(&mut sink).unwrap();
        let outcome = simulation.run(&mut sink, &mut Most(700)).unwrap();
        (format!("{outcome:?}"), simulation.statistics().accepted(), simulation.state().bodies)
    };
    let found = stopped("time.sample=0.02", 1);
    println!("{} after {} steps", found.0, found.1);
    assert!((700..700 + 9).contains(&found.1));
    assert_eq!(found, stopped("time.sample=0.4", 1));
    assert_eq!(found, stopped("time.sample=0.001", 2));
}

#[test]
fn a_checkpoint_whose_times_do_not_fit_is_refused() {
    let scene = scene_of(0..2, &[]);
    let job = Job::of(&scene, &provenance());
    let (.., whole) = run(&scene, 1, false);
    // Behind a list of four integers, the first of the reals is the time of the run.
    for time in [f64::NAN, f64::INFINITY, 5.0, -1.0] {
        let mut damaged = whole.clone();
        damaged[48..56].copy_from_slice(&time.to_le_bytes());
        let refused = Simulation::resume(job.model, job.start, job.plan, &damaged).err();
        assert!(matches!(refused, Some(RunError::Checkpoint(_))), "{time}");
    }
    assert!(Simulation::resume(job.model, job.start, job.plan, &whole).is_ok());
}

#[test]
fn a_checkpoint_of_another_number_of_bodies_is_refused() {
    let (.., two) = run(&scene_of(0..2, &[]), 1, false);
    let three = scene_of(0..3, &[]);
    let job = Job::of(&three, &provenance());
    let refused = Simulation::resume(job.model, job.start, job.plan, &two).err();
    assert!(matches!(refused, Some(RunError::Checkpoint(_))));
}
