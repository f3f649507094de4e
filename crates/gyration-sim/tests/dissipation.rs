//! What contraction and viscosity take at every step, in a run and in a resumed one.

use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::{Job, Monitor, Progress, Provenance, Reason, RecordingEnd, RunSummary, Unwatched};
use std::path::Path;
use tempfile::TempDir;

/// A box on a table that stretches and shears itself out of phase, ten times a second.
const CRAWLER: &str = r#"
    [time]
    end = 0.3
    sample = 0.0025
    [[support]]
    name = "table"
    plane = {}
    [[contact]]
    support = "table"
    repulsion = { alpha = "1 kPa", nu = 6, d0 = "2 mm" }
    damping = { beta = 1e3, nu = 6, d0 = "2 mm" }
    friction = { beta = 2e3, nu = 6, d0 = "2 mm" }
    [[body]]
    name = "crawler"
    shape = { box = { size = [0.2, 0.1, 0.1] } }
    density = 1000
    contractile = { material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }, viscosity = 20, contraction_viscosity = 50,
                    drive = { sum = [
                        { sine = { amplitude = [[600, 0, 0], [0, 0, 0], [0, 0, -600]], frequency = 10 } },
                        { sine = { amplitude = [[0, 0, 600], [0, 0, 0], [0, 0, 0]], frequency = 20, phase = 1.5 } } ] } }
    position = [0, 0, 0.052]
"#;

/// Runs the crawler, or goes on with it.
fn run(path: &Path, monitor: &mut dyn Monitor, resume: bool) -> RunSummary {
    let scene = Scene::parse("crawler.toml", CRAWLER, Path::new(""), &[]).unwrap();
    let job = Job::of(&scene, &Provenance { version: "0".into(), commit: None });
    let recorded = if resume { job.resume(path, monitor) } else { job.record(path, monitor) };
    match recorded.unwrap() {
        RecordingEnd::Ran(summary) => *summary,
        RecordingEnd::AlreadyFinished(_) => panic!("nothing was run"),
    }
}

#[test]
fn contraction_and_viscosity_take_energy_at_every_step() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("crawler.gyr");
    let ledger = run(&path, &mut Unwatched, false).ledger;
    println!("least in a step {:?} J, of {:?} J", ledger.least_dissipation, ledger.works);
    assert_eq!(ledger.least_dissipation.len(), 2);
    for (name, least) in &ledger.least_dissipation {
        // A step may be off by a tenth of rtol, 1e-8, of the energies.
        assert!(*least > -1e-9 * ledger.energy_in_play, "{name}: {least:e} J");
        assert!(ledger.work(name).unwrap() < 0.0);
    }
    let attributes = Recording::open(&path).unwrap().attributes().clone();
    let told = &attributes["least_dissipation"];
    assert_eq!(told["contraction"].as_f64(), Some(ledger.least_dissipation[0].1));
    assert_eq!(told["viscosity"].as_f64(), Some(ledger.least_dissipation[1].1));
    let body = &attributes["bodies"][0];
    assert_eq!((body["period"].as_f64(), body["kind"].as_str()), (Some(0.1), Some("contractile")));
    // A rounding of 0.2 × 0.1 × 0.1.
    assert!((body["volume"].as_f64().unwrap() - 2e-3).abs() < 1e-17);
}

/// Stops a run at a time \[s\].
struct StopAt(f64);

impl Monitor for StopAt {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        (progress.time > self.0).then_some(Reason::Interrupted)
    }
}

#[test]
fn resumed_run_tells_the_same_least_dissipation() {
    let folder = TempDir::new().unwrap();
    let [whole, part] = ["whole.gyr", "part.gyr"].map(|name| folder.path().join(name));
    let whole = run(&whole, &mut Unwatched, false).ledger;
    let first = run(&part, &mut StopAt(0.1), false).ledger;
    let resumed = run(&part, &mut Unwatched, true).ledger;
    assert_eq!(resumed, whole);
    // The first part is part of the least.
    let pairs = first.least_dissipation.iter().zip(&whole.least_dissipation);
    assert!(pairs.clone().count() == 2 && pairs.into_iter().all(|(first, whole)| first.1 >= whole.1));
}
