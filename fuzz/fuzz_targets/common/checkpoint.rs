//! What goes on from a checkpoint owes whatever bytes it gets: a refusal in words, or a run that goes on or stops in
//! words; in time and memory in proportion.
//!
//! An input damages a sound checkpoint: its first byte says of which scene, its second how. The rest takes the place of
//! the checkpoint, or is a list of changes (two bytes of the place of a number, one that says what stands there then),
//! or tells where the checkpoint is cut.

use gyration_scene::Scene;
use gyration_sim::{Job, MemorySink, Monitor, Progress, Provenance, Reason, Simulation};

/// A body alone, one that drives itself, balls that meet within a reach, and one that a fluid remembers.
const SCENES: [(&str, &[&str]); 4] = [
    ("dice", &["solver.rtol=1e-4"]),
    ("hop", &["solver.rtol=1e-4"]),
    ("cradle", &["solver.rtol=1e-4"]),
    ("basset", &["solver.rtol=1e-4", "body.remembered.inclusion.history_error=0.1"]),
];
/// Windows before the checkpoint, and after it.
const WINDOWS: [usize; 2] = [8, 3];

/// Scenes and a checkpoint of each.
pub struct Sound(Vec<(Scene, Vec<u8>)>);

impl Sound {
    /// Runs each of them a little.
    pub fn new() -> Self {
        let run = |(name, overrides): &(&str, &[&str])| {
            let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
            let scene = Scene::open(name, &overrides).unwrap_or_else(|errors| panic!("{errors}"));
            let job = job(&scene);
            let begun = Simulation::new(job.model, job.start, job.plan);
            let mut simulation = begun.unwrap_or_else(|error| panic!("{error}"));
            let mut kept = MemorySink::default();
            simulation.begin(&mut kept).unwrap_or_else(|error| panic!("{error}"));
            let _ = simulation.run(&mut kept, &mut Windows(WINDOWS[0]));
            let checkpoint = simulation.checkpoint();
            (scene, checkpoint)
        };
        Self(SCENES.iter().map(run).collect())
    }

    /// Damages one of them as the input says, and goes on from it.
    pub fn check(&self, input: &[u8]) {
        let [which, how, rest @ ..] = input else { return };
        let (scene, sound) = &self.0[usize::from(*which) % self.0.len()];
        let job = job(scene);
        match Simulation::resume(job.model, job.start, job.plan, &damaged(sound, *how, rest)) {
            Ok(mut simulation) => match simulation.run(&mut MemorySink::default(), &mut Windows(WINDOWS[1])) {
                Ok(outcome) => assert!(!outcome.in_words().is_empty()),
                Err(error) => assert!(!error.to_string().is_empty()),
            },
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
}

fn job(scene: &Scene) -> Job<'_> {
    Job::of(scene, &Provenance { version: "fuzz".into(), commit: None })
}

/// Ends a run after so many windows.
struct Windows(usize);

impl Monitor for Windows {
    fn after_step(&mut self, _: &Progress) -> Option<Reason> {
        self.0 = self.0.saturating_sub(1);
        (self.0 == 0).then_some(Reason::Interrupted)
    }

    fn counts_steps(&self) -> bool {
        true
    }
}

/// What a changed number is then.
fn changed(number: u64, how: u8) -> u64 {
    let real = f64::from_bits(number);
    match how {
        0..64 => number ^ 1 << how,
        64..96 => u64::from(how - 64),
        96..128 => u64::MAX >> (how - 96),
        128..160 => (real * f64::from(how - 144)).to_bits(),
        160..192 => (real + f64::from(how - 176) * f64::EPSILON * real).to_bits(),
        192..224 => u64::from(how - 192) << 58,
        _ => [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, f64::MIN_POSITIVE, -1.0, 1e300, -1e300]
            [usize::from(how) % 8]
            .to_bits(),
    }
}

fn damaged(bytes: &[u8], how: u8, rest: &[u8]) -> Vec<u8> {
    match how % 3 {
        0 => rest.to_vec(),
        1 => {
            let mut bytes = bytes.to_vec();
            let count = (bytes.len() / 8).max(1);
            for [high, low, how] in rest.as_chunks::<3>().0 {
                let place = 8 * (usize::from(u16::from_be_bytes([*high, *low])) % count);
                if let Some(number) = bytes.get_mut(place..place + 8).and_then(|number| number.first_chunk_mut::<8>()) {
                    *number = changed(u64::from_le_bytes(*number), *how).to_le_bytes();
                }
            }
            bytes
        }
        _ => {
            let place = rest.iter().fold(0, |place, byte| 256 * (place % 256) + usize::from(*byte));
            bytes[..place % (bytes.len() + 1)].to_vec()
        }
    }
}
