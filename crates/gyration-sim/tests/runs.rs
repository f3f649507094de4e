//! Runs as a whole: determinism, resumption, sampling, events, outcomes.

use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::{
    Job, MemorySink, Monitor, Outcome, Progress, Provenance, Reason, RecordingEnd, RunSummary, Simulation, Unwatched,
};
use std::collections::BTreeMap;
use std::path::Path;

pub fn provenance() -> Provenance {
    Provenance { version: "test".into(), commit: None }
}

fn gallery(name: &str, overrides: &[&str]) -> Scene {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Scene::open(name, &overrides).unwrap()
}

fn run(scene: &Scene) -> (MemorySink, RunSummary) {
    let job = Job::of(scene, &provenance());
    let mut sink = MemorySink::default();
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    simulation.begin(&mut sink).unwrap();
    let outcome = simulation.run(&mut sink, &mut Unwatched).unwrap();
    let summary = RunSummary::of(job.model, &mut simulation, outcome, None);
    (sink, summary)
}

/// Every file of a directory with its bytes.
pub fn bytes(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut pending = vec![directory.to_path_buf()];
    while let Some(place) = pending.pop() {
        for entry in std::fs::read_dir(place).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                pending.push(path);
            } else {
                let name = path.strip_prefix(directory).unwrap().display().to_string();
                files.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    files
}

pub struct StopAfter(pub usize);

impl Monitor for StopAfter {
    fn after_step(&mut self, _: &Progress) -> Option<Reason> {
        self.0 = self.0.checked_sub(1)?;
        (self.0 == 0).then_some(Reason::Interrupted)
    }
}

#[test]
fn a_resumed_run_leaves_the_bytes_of_an_uninterrupted_one() {
    assert_resumes(&gallery("dice", &["time.end=0.8"]), &[1, 2, 7, 40, 150]);
}

/// What a fluid remembers is state; what has no inertia has no velocities to remember.
#[test]
fn resumed_runs_in_a_fluid_leave_the_same_bytes() {
    let error = "body.remembered.inclusion.history_error=1e-3";
    assert_resumes(&gallery("basset", &["time.end=0.02", error]), &[1, 5, 12]);
    assert_resumes(&gallery("tank-tread", &[]), &[2, 10]);
    let soft = "affine = { material = { neo_hookean = { shear = 200 } } }\nangular_velocity = [3, 0, 1]\n";
    let text = "time = { end = 0.02, sample = 0.001 }\n\
                fluid = { viscosity = 1, density = 900, velocity_gradient = [[0, 3, 0], [0, 0, 0], [0, 0, 0]] }\n\
                [[body]]\nname = \"ball\"\nshape = { sphere = { radius = 2e-3 } }\ndensity = 1500\n\
                inclusion = { history = true, history_error = 1e-3 }\n";
    for body in ["", soft] {
        let scene = Scene::parse("scene.toml", &format!("{text}{body}"), Path::new(""), &[]).unwrap();
        assert_resumes(&scene, &[1, 5, 12]);
    }
}

/// Two bodies that are thrown up, each in a few steps with thousands of samples, an apex among them.
#[test]
fn rows_of_a_long_step_come_in_portions_from_each_of_which_a_run_goes_on() {
    let body = |k: usize| {
        format!(
            "[[body]]\nname = \"b{k}\"\nshape = {{ sphere = {{ radius = 0.05 }} }}\nmass = 1\n\
             position = [{k}, 0, 0]\nvelocity = [0, 0, {}]\n",
            0.6 + 0.1 * k as f64
        )
    };
    for count in [1, 2] {
        let bodies: String = (0..count).map(body).collect();
        let text = format!("time = {{ end = 0.12, sample = 1e-5 }}\n{bodies}");
        let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
        let job = Job::of(&scene, &provenance());
        let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
        let (mut sink, mut portions) = (MemorySink::default(), vec![]);
        simulation.begin(&mut sink).unwrap();
        while let Outcome::Stopped(_) = simulation.run(&mut sink, &mut StopAfter(1)).unwrap() {
            portions.push(sink.rows.len());
        }
        assert_eq!((sink.rows.len(), sink.events.len()), (12_001, count));
        let most = portions.windows(2).map(|two| two[1] - two[0]).max().unwrap();
        println!("{} portions, of {most} rows at most", portions.len());
        assert!(most <= 5000, "{most}");
        let mut interruptions = vec![1, portions.len() / 2, portions.len()];
        interruptions.dedup();
        assert_resumes(&scene, &interruptions);
    }
}

fn assert_resumes(scene: &Scene, interruptions: &[usize]) {
    let folder = tempfile::tempdir().unwrap();
    let job = Job::of(scene, &provenance());
    let whole = folder.path().join("whole.gyr");
    job.record(&whole, &mut Unwatched).unwrap();
    let expected = bytes(&whole);
    for &steps in interruptions {
        let path = folder.path().join(format!("{steps}.gyr"));
        let RecordingEnd::Ran(summary) = job.record(&path, &mut StopAfter(steps)).unwrap() else { panic!("not run") };
        let Outcome::Stopped(stop) = &summary.outcome else { panic!("{steps} steps were too many") };
        assert_eq!(stop.reason, Reason::Interrupted);
        // Interrupted a second time, then run to the end.
        job.resume(&path, &mut StopAfter(3)).unwrap();
        job.resume(&path, &mut Unwatched).unwrap();
        let found = bytes(&path);
        assert_eq!(expected.keys().collect::<Vec<_>>(), found.keys().collect::<Vec<_>>());
        let different: Vec<_> = expected.iter().filter(|(name, bytes)| found[*name] != **bytes).collect();
        assert!(different.is_empty(), "after {steps} steps {:?} differ", different[0].0);
    }
}

#[test]
fn a_finished_run_is_not_resumed_and_another_scene_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    let scene = gallery("bounce", &["time.end=0.2"]);
    let job = Job::of(&scene, &provenance());
    job.record(&path, &mut Unwatched).unwrap();
    let before = bytes(&path);
    assert!(matches!(job.resume(&path, &mut Unwatched).unwrap(), RecordingEnd::AlreadyFinished(_)));
    assert_eq!(before, bytes(&path));
    let other = gallery("bounce", &["time.end=0.3"]);
    let refused = Job::of(&other, &provenance()).resume(&path, &mut Unwatched).unwrap_err();
    assert!(refused.to_string().contains("another scene"), "{refused}");
}

#[test]
fn sampling_does_not_change_the_motion() {
    let last = |sample: &str| {
        let scene = gallery("dice", &["time.end=0.6", sample]);
        let (sink, summary) = run(&scene);
        let (time, row) = sink.rows.last().unwrap().clone();
        (time, row, summary.statistics)
    };
    assert_eq!(last("time.sample=0.001"), last("time.sample=0.6"));
}

/// Of a pile another rounding would be another pile.
#[test]
fn how_long_a_run_goes_on_leaves_no_trace_in_its_beginning() {
    for (name, end) in [("dice", 0.5), ("dice-pair", 0.5), ("soft-collision", 0.3), ("stair", 0.3), ("cells", 0.1)] {
        let beginning = |longer: f64| {
            let time = format!("time={{ end = {}, sample = {} }}", longer * end, 0.05 * end);
            let (mut sink, _) = run(&gallery(name, &[&time]));
            // The last step of a run, which none of these makes long, is cut at its end.
            sink.rows.retain(|(time, _)| *time < 0.8 * end);
            sink.rows
        };
        let short = beginning(1.0);
        assert!(short.len() > 15 && [1.3, 3.0].map(beginning).iter().all(|long| *long == short), "{name}");
    }
}

#[test]
fn samples_are_multiples_and_the_last_is_the_end() {
    let (sink, _) = run(&gallery("bounce", &["time.end=0.25", "time.sample=0.1"]));
    let times: Vec<f64> = sink.rows.iter().map(|(time, _)| *time).collect();
    assert_eq!(times, [0.0, 0.1, 0.2, 0.25]);
    let (sink, _) = run(&gallery("bounce", &["time.end=0.3", "time.sample=0.1"]));
    let times: Vec<f64> = sink.rows.iter().map(|(time, _)| *time).collect();
    // 3 × 0.1 is not 0.3 in binary: the end is the end, once.
    assert_eq!(times, [0.0, 0.1, 0.2, 0.3]);
}

#[test]
fn a_bouncing_ball_has_a_closest_approach_a_lift_off_and_an_apex_in_turn() {
    let (sink, summary) = run(&gallery("bounce", &["time.end=1.0"]));
    let kinds: Vec<usize> = sink.events.iter().map(|event| event.kind).collect();
    assert!(kinds.len() >= 5, "{kinds:?}");
    assert_eq!(&kinds[..3], [1, 2, 0]);
    // Free fall from 0.5 m above the touching height: the repulsion stops it a little above.
    let fall = (2.0 * 0.5_f64 / 9.81).sqrt();
    assert!((sink.events[0].time - fall).abs() < 5e-3, "{}", sink.events[0].time);
    assert_eq!(summary.outcome, Outcome::Completed);
}

#[test]
fn a_die_comes_to_rest_and_the_run_ends_there() {
    let (sink, summary) = run(&gallery("dice", &[]));
    let Outcome::AtRest { time } = summary.outcome else { panic!("{}", summary.in_words) };
    assert!(time < 4.0);
    assert_eq!(sink.rows.last().unwrap().0, time);
    // The default rtol is 1e-8; the ledger closes to a hundred times that of the energy in play.
    let ledger = &summary.ledger;
    assert!(ledger.largest_residual < 1e-6 * ledger.energy_in_play, "{:e} J", ledger.largest_residual);
}

#[test]
fn a_touch_that_nothing_forbids_ends_the_run_with_names_and_numbers() {
    // A logarithmic potential under a sphere is finite at contact: at 3 m/s the ball gets there.
    let scene = gallery(
        "bounce",
        &[
            "contact.0.repulsion.nu=1",
            "contact.0.repulsion.alpha=1",
            "contact.0.damping.nu=1",
            "contact.0.friction.nu=1",
        ],
    );
    let (_, summary) = run(&scene);
    let Outcome::Stopped(stop) = &summary.outcome else { panic!("{}", summary.in_words) };
    assert_eq!((stop.reason, stop.body.as_deref()), (Reason::GapClosed, Some("ball")));
    assert!(summary.in_words.contains("table"), "{}", summary.in_words);
}

#[test]
fn a_recording_holds_scene_outcome_and_rows() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("slide.gyr");
    let scene = gallery("slide", &["time.end=0.5"]);
    Job::of(&scene, &provenance()).record(&path, &mut Unwatched).unwrap();
    let recording = Recording::open(&path).unwrap();
    assert_eq!(recording.rows(), 51);
    assert_eq!(recording.attributes()["scene"], scene.text());
    assert_eq!(recording.attributes()["outcome"], "completed");
    let columns: Vec<&str> = recording.columns().collect();
    // x, P, v, Ṗ, gap and force of the block, then the ledger.
    assert_eq!(columns.len(), 3 + 9 + 3 + 9 + 1 + 3 + 6, "{columns:?}");
    assert_eq!(columns[..4], ["block.x", "block.y", "block.z", "block.P_xx"]);
    let tail =
        ["energy.kinetic", "energy.gravity", "energy.contact", "work.damping", "work.friction", "energy.residual"];
    assert_eq!(columns[columns.len() - 6..], tail);
}
