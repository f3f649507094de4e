//! Copies of a body move as the same bodies written one by one: to the byte.

use crate::islands::{parsed, run};
use crate::resumption::resumes_after_every_window;
use crate::runs::provenance;
use gyration_record::Recording;
use gyration_record::export::csv;
use gyration_scene::Scene;
use gyration_sim::replay::Replay;
use gyration_sim::sensitivity::{At, Sensitivities};
use gyration_sim::survey::Survey;
use gyration_sim::{Job, Monitor, Progress, Reason, RunError, Unwatched};
use std::path::Path;

const WORLD: &str = r#"
time = { end = 0.12, sample = 0.01 }
support = [{ name = "table", plane = {} }]
[[contact]]
support = "table"
repulsion = { alpha = "245 Pa", nu = 6, d0 = "0.6 mm" }
damping = { beta = 1e4, nu = 3, d0 = "0.6 mm" }
[[contact]]
between = ["die", "die"]
repulsion = { alpha = "245 Pa", nu = 6, d0 = "0.6 mm" }
reach = "2 mm"
"#;
const DIE: &str = "shape = { box = { size = [0.02, 0.02, 0.02] } }\ndensity = 1250\n";

/// Three dice, two of which strike each other on their way to the table: place, quaternion, velocity, spin.
const PLACES: [[f64; 13]; 3] = [
    [0.0, 0.0, 0.03, 1.0, 0.2, 0.3, -0.1, 0.4, 0.0, -0.5, 3.0, 1.0, -2.0],
    [0.035, 0.002, 0.035, 0.7, -0.2, 0.0, 0.5, -0.4, 0.1, -0.4, 0.0, 7.0, 1.0],
    [0.2, 0.0, 0.02, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0],
];

fn list(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
}

fn by_hand() -> String {
    let bodies = PLACES.iter().enumerate().map(|(k, numbers)| {
        format!(
            "[[body]]\nname = \"die-{k}\"\ngroup = \"die\"\n{DIE}position = [{}]\n\
             orientation = {{ quaternion = [{}] }}\nvelocity = [{}]\nangular_velocity = [{}]\n",
            list(&numbers[..3]),
            list(&numbers[3..7]),
            list(&numbers[7..10]),
            list(&numbers[10..])
        )
    });
    WORLD.to_owned() + &bodies.collect::<String>()
}

fn table() -> String {
    let rows = PLACES.iter().map(|numbers| list(numbers) + "\n");
    "x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n".to_owned() + &rows.collect::<String>()
}

fn by_table(folder: &Path) -> Scene {
    std::fs::write(folder.join("places.csv"), table()).unwrap();
    let text = format!("{WORLD}[[body]]\nname = \"die\"\n{DIE}copies = {{ places = \"places.csv\" }}\n");
    Scene::parse("dice.toml", &text, folder, &[]).unwrap()
}

#[test]
fn copies_move_as_bodies_written_one_by_one() {
    let folder = tempfile::tempdir().unwrap();
    let (hand, copies) = (parsed(&by_hand(), &[]), by_table(folder.path()));
    assert!(hand.built().model.names().eq(copies.built().model.names()));
    let (wanted, found) = (run(&hand, 1, false), run(&copies, 2, false));
    // Two dice that never come within reach would make no difference.
    let rows = &found.0.kept.rows;
    assert!(rows.len() == 13 && !found.0.kept.events.is_empty());
    assert_eq!(found, wanted);
    resumes_after_every_window(&copies, 20);
}

struct Early;

impl Monitor for Early {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        (progress.time > 0.05).then_some(Reason::Interrupted)
    }
}

#[test]
fn a_run_of_copies_is_resumed_to_the_same_bytes_and_not_with_another_table() {
    let folder = tempfile::tempdir().unwrap();
    let scene = by_table(folder.path());
    let [whole, parts] = ["whole.gyr", "parts.gyr"].map(|name| folder.path().join(name));
    let provenance = provenance();
    let job = Job::of(&scene, &provenance);
    job.record(&whole, &mut Unwatched).unwrap();
    job.record(&parts, &mut Early).unwrap();
    std::fs::write(folder.path().join("places.csv"), table().replace("0.2,0,0.02", "0.25,0,0.02")).unwrap();
    let moved = Scene::parse("dice.toml", scene.text(), folder.path(), &[]).unwrap();
    match Job::of(&moved, &provenance).resume(&parts, &mut Unwatched) {
        Err(RunError::OtherScene { what, .. }) => assert!(what.contains("the file places.csv has changed"), "{what}"),
        other => panic!("{other:?}"),
    }
    by_table(folder.path());
    job.resume(&parts, &mut Unwatched).unwrap();
    let texts = [whole, parts].map(|path| {
        let mut text = Vec::new();
        let recording = Recording::open(&path).unwrap();
        csv(&recording, &mut text).unwrap();
        let state = Replay::open(&recording).unwrap().state(recording.rows() - 1).unwrap();
        (text, state)
    });
    assert_eq!(texts[0], texts[1]);
    let header = String::from_utf8_lossy(&texts[0].0);
    assert!(header.starts_with("t,die-0.x,"), "{}", &header[..40]);
}

const CROWD: &str = "time = { end = 0.1, sample = 0.1 }\n[[body]]\nname = \"grain\"\n\
                     shape = { sphere = { radius = 0.01 } }\ndensity = 1250\nvelocity = [1, 0, 0]\n\
                     potential = \"2*x^2\"\ncopies = { grid = { count = [40, 5, 1], spacing = [\"3 cm\", 0.03, 0] } }\n";

#[test]
fn check_tells_copies_in_one_place() {
    let scene = parsed(&CROWD.replace("potential", "# potential"), &[]);
    let text = Survey::of(&scene).unwrap().text(&scene).unwrap();
    assert!(text.contains("\n200 bodies alike, grain-0 to grain-199\n"), "{text}");
    assert_eq!((text.matches("[[body]]").count(), text.matches("[body.copies.grid]").count()), (1, 1), "{text}");
    let resolved = &text[text.find("# The resolved scene").unwrap()..];
    assert_eq!(parsed(resolved, &[]).built().state, scene.built().state);
}

#[test]
fn check_tells_bodies_of_one_kind_once() {
    let few = CROWD.replace("potential", "# potential").replace("[40, 5, 1]", "[3, 1, 1]");
    let other =
        "[[body]]\nname = \"stone\"\nshape = { sphere = { radius = 0.02 } }\ndensity = 1250\nposition = [1, 0, 0]\n";
    let scene = parsed(&(few + other), &[]);
    let text = Survey::of(&scene).unwrap().text(&scene).unwrap();
    assert!(text.contains("\nbodies grain-0, grain-1, grain-2\n  kind            rigid\n"), "{text}");
    assert!(text.contains("\nbody stone\n  kind            rigid\n"), "{text}");
}

/// Each grain swings in a potential of its own place: x(t) = x₀ cos ωt + (v₀/ω) sin ωt with ω² = 4/m.
#[test]
fn derivatives_reach_all_copies() {
    let scene = parsed(CROWD, &["body.grain.copies.grid.count=[3, 1, 1]"]);
    let keys = ["body.grain.density", "body.grain.position.0", "body.grain.copies.grid.spacing.0"];
    let quantities = ["grain-0.x", "grain-2.x"].map(String::from);
    let found = Sensitivities::along(&scene, &keys.map(String::from), &quantities, At::End).unwrap();
    let volume = 4.0 / 3.0 * std::f64::consts::PI * 1e-6;
    let (mass, time) = (1250.0 * volume, 0.1_f64);
    let rate = (4.0 / mass).sqrt();
    let (sin, cos) = (rate * time).sin_cos();
    // dω/dρ = −ω/(2ρ).
    let by_density = |start: f64| -rate / 2500.0 * (-start * time * sin + time / rate * cos - sin / (rate * rate));
    let wanted = [[by_density(0.0), by_density(0.06)], [cos, cos], [0.0, 2.0 * cos]];
    for (derivatives, wanted) in found.derivatives.iter().zip(wanted) {
        let derivatives = derivatives.at_end().unwrap();
        println!("{derivatives:?} of {wanted:?}");
        // The tolerance of the run, with the scale of the largest.
        let scale = wanted.iter().fold(0.0, |largest: f64, one| largest.max(one.abs()));
        assert!(derivatives.iter().zip(wanted).all(|(one, other)| (one - other).abs() < 1e-6 * scale));
    }
}
