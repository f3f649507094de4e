//! A run that goes on from the checkpoint at the end of any of its windows steps as the one that left it: to the byte.
//!
//! Whatever a step depends on must stand in the checkpoint, or follow from what stands there. Recordings of whole runs
//! find a fault of this kind where a stop happens to fall; here every window is such a stop.

use crate::islands::parsed;
use crate::random::meetings;
use crate::random::scene::scene;
use gyration_scene::Scene;
use gyration_sim::{Job, MemorySink, Monitor, Outcome, Progress, Provenance, Reason, Simulation};

/// Windows of random scenes that are looked at.
const WINDOWS: usize = 40;

/// Ends a run after a window. It counts steps, so that a window is one step of the islands that have come least far,
/// however wide the windows before it were.
struct OneWindow;

impl Monitor for OneWindow {
    fn after_step(&mut self, _: &Progress) -> Option<Reason> {
        Some(Reason::Interrupted)
    }

    fn counts_steps(&self) -> bool {
        true
    }
}

/// One window: how the run has ended, if it has; rows and events are added to those before.
fn window(simulation: &mut Simulation, kept: &mut MemorySink) -> Option<Outcome> {
    match simulation.run(kept, &mut OneWindow).unwrap() {
        Outcome::Stopped(stop) if stop.reason == Reason::Interrupted => None,
        outcome => Some(outcome),
    }
}

/// The first window after which a run that is resumed there steps otherwise, and what is other; none if it never does.
pub fn first_difference(scene: &Scene, most: usize) -> Option<String> {
    let job = Job::of(scene, &Provenance { version: "test".into(), commit: None });
    let mut whole = Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut kept = MemorySink::default();
    whole.begin(&mut kept).unwrap();
    for count in 0..most {
        let checkpoint = whole.checkpoint();
        let mut resumed = Simulation::resume(job.model, job.start, job.plan, &checkpoint).unwrap();
        if resumed.checkpoint() != checkpoint {
            return Some(format!("{count} windows: the checkpoint read is not the one written"));
        }
        let (mut after, mut again) = (MemorySink::default(), MemorySink::default());
        let outcomes = [window(&mut whole, &mut after), window(&mut resumed, &mut again)];
        let time = whole.time();
        for (what, differs) in [
            ("outcome", outcomes[0] != outcomes[1]),
            ("rows", format!("{:?}", after.rows) != format!("{:?}", again.rows)),
            ("events", after.events != again.events),
            ("state", whole.state() != resumed.state()),
            ("counters", whole.statistics() != resumed.statistics()),
            ("checkpoint", whole.checkpoint() != resumed.checkpoint()),
        ] {
            if differs {
                return Some(format!("{count} windows, t = {time:e} s: another {what}"));
            }
        }
        if outcomes[0].is_some() {
            return None;
        }
    }
    None
}

/// Asks that a run steps the same from the checkpoint at the end of each of its first windows.
pub fn resumes_after_every_window(scene: &Scene, most: usize) {
    assert_eq!(first_difference(scene, most), None, "{}", scene.name());
}

#[test]
fn bodies_alone_resume_after_every_window() {
    let folder = tempfile::tempdir().unwrap();
    let mut differing = Vec::new();
    for case in 0..30 {
        let text = scene(case, folder.path());
        let scene = Scene::parse("scene.json", &text, folder.path(), &[]).unwrap_or_else(|e| panic!("{case}: {e}"));
        differing.extend(first_difference(&scene, WINDOWS).map(|told| format!("case {case}, after {told}")));
    }
    assert!(differing.is_empty(), "{} scenes:\n{}", differing.len(), differing.join("\n"));
}

#[test]
fn bodies_that_meet_resume_after_every_window() {
    let mut differing = Vec::new();
    for case in 0..24 {
        let scene = parsed(&meetings::scene(case), &[]);
        differing.extend(first_difference(&scene, WINDOWS).map(|told| format!("case {case}, after {told}")));
    }
    assert!(differing.is_empty(), "{} scenes:\n{}", differing.len(), differing.join("\n"));
}

/// Two bricks that rattle on a table, one on the other: long enough for implicit steps and changes of the stepper.
#[test]
fn a_stack_resumes_after_every_window() {
    resumes_after_every_window(&Scene::open("overhang", &["time.end=0.05".into()]).unwrap(), 400);
}

/// Two boxes with a spin of their own in a ring with its image: what is symmetric has planes that are not unique to the
/// digits of a number.
#[test]
fn symmetric_bodies_resume_after_every_window() {
    let mut text = "world = { gravity = [0, 0, 0] }\ntime = { end = 0.4, sample = 0.1 }\n\
                    [[contact]]\nbetween = [\"box\", \"box\"]\nrepulsion = { alpha = 100, nu = 6, d0 = 0.001 }\n"
        .to_owned();
    for (k, (x, y)) in [(0.15, 0.0), (0.0, 0.15), (-0.15, 0.0), (0.0, -0.15)].into_iter().enumerate() {
        text += &format!(
            "[[body]]\nname = \"b{k}\"\ngroup = \"box\"\nshape = {{ box = {{ size = [0.1, 0.1, 0.1] }} }}\nmass = 1\n\
             position = [{x}, {y}, 0]\nvelocity = [{}, {}, 0]\nangular_velocity = [0, 0, 1]\n",
            -2.0 * x,
            -2.0 * y
        );
    }
    resumes_after_every_window(&parsed(&text, &[]), 200);
}
