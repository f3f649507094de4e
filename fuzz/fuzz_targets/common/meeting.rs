//! What a scene of bodies that meet owes whatever is written of them: errors in words, or a start whose numbers are
//! numbers.
//!
//! The input stands behind a sound scene of three bodies in two groups: contacts, springs and bodies more.

use gyration_scene::Scene;
use gyration_sim::{Job, MemorySink, Provenance, Simulation};
use std::path::Path;

const SOUND: &str = r#"
time = { end = 1, sample = 0.5 }
[[body]]
name = "a"
group = ["one", "all"]
shape = { box = { size = [0.2, 0.3, 0.1] } }
mass = 1
[[body]]
name = "b"
group = "all"
shape = { ellipsoid = { semi_axes = [0.1, 0.2, 0.15] } }
mass = 2
position = [0.5, 0, 0]
affine = { material = { neo_hookean_log = { mu = 100, lambda = 100 } } }
[[body]]
name = "c"
group = ["all", "one"]
shape = { union = { parts = [{ shape = { sphere = { radius = 0.1 } } }, { shape = { box = { size = [0.1, 0.1, 0.1] } }, offset = [0.1, 0, 0] }] } }
mass = 1
position = [0, 0.6, 0.1]
"#;

/// Reads the input behind the sound scene and begins the run.
pub fn check(input: &str) {
    let scene = match Scene::parse("scene.toml", &format!("{SOUND}\n{input}"), Path::new("/nowhere"), &[]) {
        Ok(scene) => scene,
        Err(errors) => return assert!(errors.count() > 0 && !errors.to_string().is_empty()),
    };
    let resolved = scene.resolved();
    let again = Scene::parse("again.json", &resolved.to_string(), Path::new("/nowhere"), &[]);
    let again = again.unwrap_or_else(|errors| panic!("a resolved scene is refused: {errors}"));
    assert_eq!(again.resolved(), resolved, "a resolved scene resolves to another");
    let job = Job::of(&scene, &Provenance { version: "fuzz".into(), commit: None });
    let mut kept = MemorySink::default();
    let begun = Simulation::new(job.model, job.start, job.plan)
        .and_then(|mut simulation| simulation.begin(&mut kept).map(|()| simulation.checkpoint()));
    match begun {
        // A body that can touch nothing has an infinite gap.
        Ok(_) => assert!(kept.rows.iter().all(|(_, row)| row.iter().all(|number| !number.is_nan()))),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
