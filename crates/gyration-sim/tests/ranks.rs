//! A run on several ranks: bytes do not tell how many there were, or that there were any.
//!
//! Ranks are threads here that tell one another bytes through channels, and share nothing else.

use crate::islands::parsed;
use crate::runs::{StopAfter, bytes, provenance};
use gyration_scene::Scene;
use gyration_sim::{
    Communicator, Job, MemorySink, Outcome, Reason, RecordingEnd, RunError, RunPlan, RunSummary, Simulation, Unwatched,
};
use gyration_threads::Interruption;
use std::io;
use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread;

/// One of several threads.
#[derive(Debug)]
struct Thread {
    rank: usize,
    /// To each of all.
    tell: Vec<Sender<Vec<u8>>>,
    /// From each of all.
    hear: Mutex<Vec<Receiver<Vec<u8>>>>,
    /// Bytes that it has told.
    told: AtomicUsize,
}

impl Communicator for Thread {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.tell.len()
    }

    fn all_gather(&self, own: Vec<u8>) -> io::Result<Vec<Vec<u8>>> {
        self.told.fetch_add(own.len(), Ordering::Relaxed);
        let gone = |_| io::Error::other("a rank is gone");
        // One that is gone is heard of below.
        self.tell.iter().for_each(|tell| drop(tell.send(own.clone())));
        self.hear.lock().unwrap().iter().map(|hear| hear.recv().map_err(|_| gone(()))).collect()
    }

    fn least_share(&self) -> usize {
        1
    }
}

fn threads(size: usize) -> Vec<Arc<Thread>> {
    let mut tell: Vec<Vec<Sender<Vec<u8>>>> = (0..size).map(|_| Vec::new()).collect();
    let mut hear: Vec<Vec<Receiver<Vec<u8>>>> = (0..size).map(|_| Vec::new()).collect();
    for teller in &mut tell {
        for hearer in &mut hear {
            let (sender, receiver) = channel();
            teller.push(sender);
            hearer.push(receiver);
        }
    }
    let both = tell.into_iter().zip(hear).enumerate();
    let thread = |(rank, (tell, hear))| Thread { rank, tell, hear: Mutex::new(hear), told: AtomicUsize::new(0) };
    both.map(|both| Arc::new(thread(both))).collect()
}

/// What each of so many ranks makes of something.
fn on_ranks<T: Send>(size: usize, work: impl Fn(Arc<Thread>) -> T + Sync) -> Vec<T> {
    thread::scope(|scope| {
        let running: Vec<_> = threads(size).into_iter().map(|rank| scope.spawn(|| work(rank))).collect();
        running.into_iter().map(|rank| rank.join().unwrap()).collect()
    })
}

/// Rows and events, outcome, checkpoint and counters of a run.
#[derive(Debug, PartialEq)]
struct Found {
    kept: MemorySink,
    outcome: Outcome,
    checkpoint: Vec<u8>,
    counters: String,
}

fn run(scene: &Scene, threads: usize, rank: Option<Arc<Thread>>) -> Result<Found, RunError> {
    let job = Job::of(scene, &provenance());
    let plan = RunPlan { threads: NonZeroUsize::new(threads), ..job.plan };
    let (mut kept, mut simulation) = (MemorySink::default(), Simulation::new(job.model, job.start, plan)?);
    let rank = rank.map(|rank| rank as Arc<dyn Communicator>);
    simulation = rank.into_iter().fold(simulation, Simulation::on_ranks);
    simulation.begin(&mut kept)?;
    let outcome = simulation.run(&mut kept, &mut Unwatched)?;
    let counters = format!("{:?}, {}", simulation.statistics(), simulation.energy_in_play());
    Ok(Found { kept, outcome, checkpoint: simulation.checkpoint(), counters })
}

const LAWS: &str = "repulsion = { alpha = 245, nu = 6, d0 = 6e-4 }\ndamping = { beta = 1e4, nu = 3, d0 = 6e-4 }\n\
                    friction = { beta = 1e4, nu = 3, d0 = 6e-4 }\n";

/// Dice and balls that are poured onto a table in two columns, a pair of them on a spring: islands merge and fall
/// apart.
fn poured(overrides: &[&str]) -> Scene {
    let mut text = format!(
        "time = {{ end = 0.09, sample = 0.003 }}\nsolver = {{ rtol = 1e-4, atol = 1e-6, threads = 1 }}\n\
         record = {{ quantities = [\"impulse\", \"peak_force\"], pairs = true }}\n\
         [[support]]\nname = \"table\"\nplane = {{}}\n[[contact]]\nsupport = \"table\"\n{LAWS}\
         [[contact]]\nbetween = [\"grain\", \"grain\"]\nreach = 0.003\n{LAWS}\
         [[spring]]\nbetween = [\"b5\", \"b4\"]\nstiffness = 3\nrest_length = 0.1\ndamping = 0.01\n"
    );
    for k in 0..6 {
        let shape =
            if k % 3 == 2 { "{ sphere = { radius = 0.01 } }" } else { "{ box = { size = [0.02, 0.02, 0.02] } }" };
        text += &format!(
            "[[body]]\nname = \"b{k}\"\ngroup = \"grain\"\nshape = {shape}\ndensity = 1250\n\
             position = [{}, {}, {}]\nvelocity = [0.02, 0, -0.3]\nangular_velocity = [{}, 2, 3]\n\
             orientation = {{ axis_angle = {{ axis = [1, 0.4, 0.3], angle = {} }} }}\n",
            0.1 * f64::from(k % 2),
            0.002 * f64::from(k),
            0.02 + 0.02 * f64::from(k),
            3 - k,
            0.3 * f64::from(k),
        );
    }
    parsed(&text, overrides)
}

/// A gas of balls in a box without gravity that hit one another and two walls.
fn gas(overrides: &[&str]) -> Scene {
    let mut text = "world = { gravity = [0, 0, 0] }\ntime = { end = 3, sample = 0.1 }\n\
                    solver = { rtol = 1e-6, atol = 1e-8 }\n"
        .to_owned();
    let law = "repulsion = { alpha = 1e5, nu = 6, d0 = 0.01 }";
    for (k, place) in [-1.0, 1.0].into_iter().enumerate() {
        text += &format!(
            "[[support]]\nname = \"w{k}\"\nplane = {{ origin = [{place}, 0, 0], normal = [{}, 0, 0] }}\n\
             [[contact]]\nsupport = \"w{k}\"\n{law}\n",
            -place
        );
    }
    text += &format!("[[contact]]\nbetween = [\"ball\", \"ball\"]\nreach = 0.1\n{law}\n");
    for k in 0..27 {
        let at = [k % 3, k / 3 % 3, k / 9].map(|cell| 0.5 * f64::from(cell - 1));
        let speed = [7 * k % 5 - 2, 3 * k % 7 - 3, 5 * k % 9 - 4].map(|part| 0.3 * f64::from(part));
        text += &format!(
            "[[body]]\nname = \"b{k}\"\ngroup = \"ball\"\nshape = {{ sphere = {{ radius = 0.07 }} }}\nmass = 1\n\
             position = {at:?}\nvelocity = {speed:?}\n"
        );
    }
    parsed(&text, overrides)
}

#[test]
fn ranks_leave_no_trace() {
    for scene in [gas(&[]), poured(&[])] {
        let alone = run(&scene, 1, None).unwrap();
        assert_eq!(alone.outcome, Outcome::Completed);
        println!("{} events, {}", alone.kept.events.len(), alone.counters);
        for (size, threads) in [(1, 1), (2, 2), (3, 1), (4, 1)] {
            let told = on_ranks(size, |rank| {
                let found = run(&scene, threads, Some(rank.clone())).unwrap();
                assert!(found == alone, "rank {} of {size}", rank.rank);
                rank.told.load(Ordering::Relaxed)
            });
            // The steps are shared out, and are not all made by everybody.
            assert!(size == 1 || told.iter().sum::<usize>() > 20_000, "{told:?}");
        }
    }
}

/// A recording at a place by so many ranks, begun or gone on with, which the first one may interrupt after some
/// windows.
fn record(scene: &Scene, path: &Path, size: usize, resumes: bool, windows: Option<usize>) -> Vec<RunSummary> {
    let ends = on_ranks(size, |rank| {
        let is_first = rank.rank == 0;
        let job = Job::of(scene, &provenance()).on_ranks(rank);
        let (mut unwatched, mut stopping) = (Unwatched, StopAfter(windows.unwrap_or(0)));
        let monitor: &mut dyn gyration_sim::Monitor =
            if windows.is_some() && is_first { &mut stopping } else { &mut unwatched };
        if resumes { job.resume(path, monitor).unwrap() } else { job.record(path, monitor).unwrap() }
    });
    let ran = |end| match end {
        RecordingEnd::Ran(summary) => *summary,
        RecordingEnd::AlreadyFinished(_) => panic!("there was nothing to do"),
    };
    ends.into_iter().map(ran).collect()
}

#[test]
fn a_recording_by_ranks_goes_on_with_other_ranks() {
    let (scene, folder) = (poured(&["time.end=0.05"]), tempfile::tempdir().unwrap());
    let [whole, shared] = ["whole.gyr", "shared.gyr"].map(|name| folder.path().join(name));
    Job::of(&scene, &provenance()).record(&whole, &mut Unwatched).unwrap();
    for windows in [1, 6] {
        let stopped = record(&scene, &shared, 2, false, Some(windows));
        for summary in &stopped {
            let Outcome::Stopped(stop) = &summary.outcome else { panic!("{windows} windows were too many") };
            assert_eq!((stop.reason, &summary.outcome), (Reason::Interrupted, &stopped[0].outcome));
        }
        record(&scene, &shared, 3, true, Some(2));
        let ended = record(&scene, &shared, 4, true, None);
        assert!(ended.iter().all(|summary| summary.outcome == Outcome::Completed));
        assert!(bytes(&shared) == bytes(&whole), "after {windows} windows");
        std::fs::remove_dir_all(&shared).unwrap();
    }
    // What has ended is over for all of them.
    let ends =
        on_ranks(2, |rank| Job::of(&scene, &provenance()).on_ranks(rank).resume(&whole, &mut Unwatched).unwrap());
    assert!(ends.iter().all(|end| matches!(end, RecordingEnd::AlreadyFinished(_))));
}

/// A gas in which the cube that comes last touches another one under a law that hardly forbids it.
#[test]
fn a_stop_is_the_same_on_all_ranks() {
    let mut text = gas(&[]).text().to_owned();
    text += "[[contact]]\nbetween = [\"one\", \"other\"]\nreach = 0.05\n\
             repulsion = { alpha = 1e3, nu = 2, d0 = 0.004 }\n";
    for (name, place, speed) in [("one", 3.0, 0.6), ("other", 3.3, -0.8)] {
        text += &format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ box = {{ size = [0.1, 0.14, 0.08] }} }}\nmass = 1\n\
             position = [0, {place}, 0]\nvelocity = [0.1, {speed}, 0]\n\
             orientation = {{ quaternion = [0.5, 0.1, {place}, 0.3] }}\nangular_velocity = [3, -2, 5]\n"
        );
    }
    let scene = parsed(&text, &[]);
    let alone = run(&scene, 1, None).unwrap();
    assert!(matches!(&alone.outcome, Outcome::Stopped(stop) if stop.reason == Reason::Touching), "{:?}", alone.outcome);
    for size in [2, 3] {
        on_ranks(size, |rank| assert!(run(&scene, 1, Some(rank)).unwrap() == alone, "{size} ranks"));
    }
}

#[test]
fn an_interruption_on_one_rank_ends_the_run_on_all() {
    let scene = gas(&[]);
    let found = on_ranks(3, |rank| {
        let flag = Arc::new(AtomicBool::new(rank.rank == 2));
        Interruption::default().raised_by(flag).within(|| {
            let job = Job::of(&scene, &provenance());
            let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap().on_ranks(rank);
            simulation.state();
            let outcome = simulation.run(&mut MemorySink::default(), &mut Unwatched).unwrap();
            (outcome, simulation.is_whole(), simulation.checkpoint())
        })
    });
    assert!(matches!(&found[0], (Outcome::Stopped(stop), true, _) if stop.reason == Reason::Interrupted));
    assert!(found.iter().all(|other| *other == found[0]));
}

#[test]
fn ranks_that_cannot_go_on_together_say_so() {
    // Of another scene.
    let scenes = [gas(&[]), gas(&["solver.rtol=1e-5"])];
    let told = on_ranks(2, |rank| run(&scenes[rank.rank], 1, Some(rank)).unwrap_err().to_string());
    assert!(told.iter().all(|told| told.contains("different scenes")), "{told:?}");
    // One that is gone.
    let told = on_ranks(2, |rank| match rank.rank {
        0 => run(&scenes[0], 1, Some(rank)).unwrap_err().to_string(),
        _ => String::new(),
    });
    assert!(told[0].contains("a rank is gone"), "{told:?}");
    // One that tells what cannot be read.
    let told = on_ranks(2, |rank| match rank.rank {
        0 => run(&scenes[0], 1, Some(rank)).unwrap_err().to_string(),
        _ => {
            let mut heard = rank.all_gather(Vec::new());
            while let Ok(all) = heard {
                heard = rank.all_gather(if all[0].len() < 100 { all[0].clone() } else { vec![7; 40] });
            }
            String::new()
        }
    });
    assert!(told[0].contains("cannot go on together"), "{told:?}");
}
