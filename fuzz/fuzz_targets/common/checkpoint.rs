//! What a run owes whatever bytes it is to go on from: a refusal in words, or steps that come to an end.
//!
//! The bytes are those of a checkpoint of one small scene: two balls and a box that meet within a reach and part again,
//! so that its islands change.

use gyration_scene::Scene;
use gyration_sim::{Job, MemorySink, Monitor, Outcome, Progress, Provenance, Reason, RunError, Simulation};
use gyration_threads::Interruption;
use std::path::Path;
use std::time::Duration;

/// The scene: two balls fly at a box that turns.
const SCENE: &str = r#"
world = { gravity = [0, 0, 0] }
time = { end = 1, sample = 0.125, stop_at_rest = { speed = 1e-3, hold = 0.1 } }
solver = { rtol = 1e-4 }
[[contact]]
between = ["all", "all"]
repulsion = { alpha = 100, nu = 4, d0 = 1e-3 }
friction = { beta = 10, nu = 3, d0 = 1e-3 }
reach = 0.02
[[body]]
name = "box"
group = "all"
shape = { box = { size = [0.2, 0.3, 0.1] } }
mass = 2
angular_velocity = [1, 0, 2]
[[body]]
name = "ball"
group = "all"
shape = { sphere = { radius = 0.1 } }
mass = 1
position = [0.3, 0.05, 0]
velocity = [-1, 0, 0]
[[body]]
name = "second"
group = "all"
shape = { sphere = { radius = 0.05 } }
mass = 0.5
position = [-0.02, 0.3, 0.02]
velocity = [0, -1, 0]
angular_velocity = [3, 1, 0]
"#;

/// Windows that a resumed run makes.
const WINDOWS: usize = 3;
/// For how long it is followed [s].
const LONGEST: Duration = Duration::from_secs(3);

/// The scene, read once.
pub struct Meeting(Scene);

impl Meeting {
    /// Reads it.
    pub fn new() -> Self {
        let scene = Scene::parse("scene.toml", SCENE, Path::new("/nowhere"), &[]);
        Self(scene.unwrap_or_else(|errors| panic!("{errors}")))
    }

    /// Resumes the run from the bytes and lets it make a few windows; whether they were taken for a checkpoint.
    pub fn check(&self, bytes: &[u8]) -> bool {
        Interruption::default().after(Some(LONGEST)).within(|| match self.resumed(bytes) {
            Ok(mut simulation) => {
                let written = simulation.checkpoint();
                let again = self.resumed(&written);
                let mut again = again.unwrap_or_else(|error| panic!("a checkpoint just written: {error}"));
                assert!(again.checkpoint() == written, "the checkpoint read is not the one written");
                run(&mut simulation, Windows { left: WINDOWS, are_steps: true });
                run(&mut again, Windows { left: WINDOWS, are_steps: false });
                true
            }
            Err(error) => {
                assert!(!error.to_string().is_empty());
                false
            }
        })
    }

    /// The checkpoints of a run after each of so many windows, from its start on.
    #[allow(dead_code, reason = "the fuzzer begins with those of its corpus")]
    pub fn checkpoints(&self, count: usize) -> Vec<Vec<u8>> {
        let job = job(&self.0);
        let whole = Simulation::new(job.model, job.start, job.plan);
        let mut whole = whole.unwrap_or_else(|error| panic!("{error}"));
        whole.begin(&mut MemorySink::default()).unwrap_or_else(|error| panic!("{error}"));
        let after_next = || {
            let checkpoint = whole.checkpoint();
            run(&mut whole, Windows { left: 1, are_steps: true }).is_none().then_some(checkpoint)
        };
        std::iter::from_fn(after_next).take(count).collect()
    }

    fn resumed(&self, bytes: &[u8]) -> Result<Simulation, RunError> {
        let job = job(&self.0);
        Simulation::resume(job.model, job.start, job.plan, bytes)
    }
}

fn job(scene: &Scene) -> Job<'_> {
    Job::of(scene, &Provenance { version: "fuzz".into(), commit: None })
}

/// Runs for so many windows; how the run has ended, if it has.
fn run(simulation: &mut Simulation, mut windows: Windows) -> Option<Outcome> {
    match simulation.run(&mut MemorySink::default(), &mut windows) {
        Ok(Outcome::Stopped(stop)) if matches!(stop.reason, Reason::Interrupted | Reason::WallTime) => None,
        Ok(outcome) => Some(outcome),
        Err(error) => panic!("{error}"),
    }
}

/// Ends a run after so many windows, each one step of the bodies that have come least far, or as wide as they come.
struct Windows {
    left: usize,
    are_steps: bool,
}

impl Monitor for Windows {
    fn after_step(&mut self, _: &Progress) -> Option<Reason> {
        self.left = self.left.saturating_sub(1);
        (self.left == 0).then_some(Reason::Interrupted)
    }

    fn counts_steps(&self) -> bool {
        self.are_steps
    }
}
