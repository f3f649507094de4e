//! Micromorphic fields: balances that close whatever bodies are and whatever is between them, and what is refused.

use crate::runs::provenance;
use gyration::tensor::Vec3;
use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::{FieldMaps, FieldPoints, FieldSurvey, Job, NoFields, Unwatched, open};
use gyration_threads::Interruption;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// The recording of a scene that is run.
fn recorded(folder: &tempfile::TempDir, scene: &Scene) -> Recording {
    let path = folder.path().join("run.gyr");
    Job::of(scene, &provenance()).record(&path, &mut Unwatched).unwrap();
    Recording::open(&path).unwrap()
}

/// The fields of a scene that is run.
fn fields(scene: &Scene, width: f64, points: &FieldPoints) -> Result<FieldSurvey, NoFields> {
    let folder = tempfile::tempdir().unwrap();
    FieldSurvey::of(&recorded(&folder, scene), width, points, 1)
}

fn scene(text: &str) -> Scene {
    Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The text of a scene that records what is between two.
fn with_pairs(text: &str) -> String {
    text.replace("time = ", "record = { pairs = true }\ntime = ")
}

/// The first samples of a scene of the gallery, with what is between two.
fn begun(name: &str) -> Scene {
    let plan = open(name, &[]).unwrap_or_else(|error| panic!("{error}")).built().plan;
    let overrides = [format!("time.end={:?}", plan.end.min(3.0 * plan.sample)), "record.pairs=true".to_owned()];
    open(name, &overrides).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn balances_close_in_scenes_of_all_kinds() {
    // Rigid, affine, incompressible and contractile bodies; pins, guides, joints, springs, bonds, contacts, rings,
    // fluids.
    let names = [
        "active-chain",
        "affine-chain",
        "cells",
        "contact-chain",
        "crawl",
        "gripper",
        "jacobi-ellipsoid",
        "jeffery",
        "kagome",
        "linkage",
        "micromorphic",
        "pendulum-chain",
        "pile",
        "pinned-strain",
        "rattleback",
        "soft-collision",
        "stair",
        "swimmer",
        "top",
        "wave-gap",
    ];
    for name in names {
        let scene = begun(name);
        let width = scene.built().model.bodies.iter().map(|body| body.size).fold(0.0, f64::max);
        let found = fields(&scene, width, &FieldPoints::Grid([3, 2, 3])).unwrap();
        for (time, fields) in found.times.iter().zip(&found.fields) {
            let [affine, linear] =
                fields.iter().fold([0.0_f64; 2], |[a, b], it| [a.max(it.scales[0]), b.max(it.scales[1])]);
            for (point, it) in found.points.iter().zip(fields) {
                assert!(it.residual <= 1e-9 * affine, "{name}, {time} s, {point}: {:e} of {affine:e}", it.residual);
                let left = it.momentum_residual;
                assert!(left <= 1e-9 * linear, "{name}, {time} s, {point}: {left:e} of {linear:e}");
            }
        }
    }
}

/// Two soft cubes that a spring joins and that turn.
const CUBES: &str = r#"
world = { gravity = [0, 0, 0] }
time = { end = 0.2, sample = 0.1 }
[[body]]
name = "a"
shape = { box = { size = [0.1, 0.1, 0.1] } }
density = 1000
position = [0, 0, 0]
velocity = [0, 1, 0]
gradient_rate = [[0, 1, 0], [-2, 0, 0], [0, 0.5, 0]]
affine = { material = { neo_hookean = { shear = "20 kPa" } }, viscosity = 3 }
[[body]]
name = "b"
shape = { box = { size = [0.1, 0.1, 0.2] } }
density = 500
position = [0.3, 0, 0.1]
affine = { material = { st_venant_kirchhoff = { lambda = 1e4, mu = 1e4 } } }
[[spring]]
between = ["a", "b"]
points = [[0.05, 0.02, 0], [-0.05, 0, 0.05]]
stiffness = 300
rest_length = 0.1
damping = 2
"#;

#[test]
fn fields_over_all_space_have_the_sums_of_the_bodies() {
    let scene = scene(CUBES);
    let found = fields(&scene, 0.15, &FieldPoints::Grid([24, 24, 24])).unwrap();
    let cell: f64 = found.grid.unwrap().spacing.iter().product();
    let total =
        |value: fn(&gyration_sim::fields::LocalFields) -> f64| cell * found.fields[2].iter().map(value).sum::<f64>();
    let mass: f64 = scene.built().model.bodies.iter().map(|body| body.solid.mass.mass).sum();
    // Two widths beyond the centres lie 0.954 of a bell on each side: most of it, not all.
    assert!((0.75..1.0).contains(&(total(|it| it.density) / mass)));
    // Momentum keeps what a velocity of 1 m/s gave to the first.
    assert!((0.75..1.0).contains(&(total(|it| it.momentum.y) / scene.built().model.bodies[0].solid.mass.mass)));
}

#[test]
fn recorded_pairs_are_those_of_the_replay() {
    let at = FieldPoints::At(vec![Vec3::new(0.15, 0.01, 0.0)]);
    let [with, without] = [with_pairs(CUBES), CUBES.to_owned()].map(|text| fields(&scene(&text), 0.1, &at).unwrap());
    assert_eq!(with, without);
    assert_ne!(with.fields[1][0].stress, gyration::tensor::Mat3::zeros());
}

#[test]
fn maps_that_nobody_waits_for_are_given_up() {
    let folder = tempfile::tempdir().unwrap();
    let recording = recorded(&folder, &scene(CUBES));
    let mut maps = FieldMaps::of(&recording).unwrap();
    let raised = Interruption::default().raised_by(Arc::new(AtomicBool::new(true)));
    assert!(matches!(raised.within(|| maps.map(0, 0.1)), Err(NoFields::Interrupted)));
    assert!(maps.map(0, 0.1).is_ok());
}

#[test]
fn the_box_of_a_grid_is_that_of_all_samples_whichever_are_read() {
    let folder = tempfile::tempdir().unwrap();
    // Up, and down again: the middle sample is the highest.
    let thrown = r#"
time = { end = 0.2, sample = 0.1 }
[[body]]
name = "ball"
shape = { sphere = { radius = 0.1 } }
mass = 2
velocity = [0, 0, 0.980665]
"#;
    let recording = recorded(&folder, &scene(thrown));
    let of = |every| FieldSurvey::of(&recording, 0.01, &FieldPoints::Usual, every).unwrap();
    let (all, ends) = (of(1), of(2));
    assert_eq!((all.times.len(), ends.times.len()), (3, 2));
    assert_eq!(all.grid, ends.grid);
    assert!(all.grid.unwrap().counts[2] > all.grid.unwrap().counts[0]);
}

#[test]
fn what_cannot_be_averaged_is_refused() {
    let text = format!("{CUBES}[[contact]]\nbetween = [\"a\", \"b\"]\nrepulsion = {{ alpha = 1e-9, nu = 6 }}\n");
    let at = FieldPoints::At(vec![Vec3::zeros()]);
    assert!(matches!(fields(&scene(&text), 0.1, &at), Err(NoFields::NoPairs)));
    assert!(fields(&scene(&with_pairs(&text)), 0.1, &at).is_ok());
    let remembers = "time = { end = 0.01, sample = 0.01 }\nfluid = { viscosity = 0.5, density = 900 }\n\
                     [[body]]\nname = \"a\"\n\
                     shape = { sphere = { radius = 0.03 } }\ndensity = 1000\ninclusion = { history = true }\n";
    assert!(matches!(fields(&scene(remembers), 0.1, &at), Err(NoFields::Remembers)));
    assert!(matches!(fields(&scene(CUBES), f64::INFINITY, &at), Err(NoFields::Width(_))));
    for width in [1e-200, 1e308] {
        assert!(matches!(fields(&scene(CUBES), width, &at), Err(NoFields::Extent { .. })), "{width}");
    }
    assert!(matches!(fields(&scene(CUBES), 0.1, &FieldPoints::Grid([1, 0, 1])), Err(NoFields::EmptyGrid)));
    let many = fields(&scene(CUBES), 0.1, &FieldPoints::Grid([1_000_000; 3]));
    assert!(matches!(many, Err(NoFields::Many { points, .. }) if points == 1e18));
}

/// A ball at each point of a cubic lattice of 0.5 m.
const CUBIC: &str = r#"
world = { gravity = [0, 0, 0] }
time = { end = 0.1, sample = 0.1 }
lattice = { cell = [[0.5, 0, 0], [0, 0.5, 0], [0, 0, 0.5]] }
[[body]]
name = "ball"
shape = { sphere = { radius = 0.1 } }
mass = 2
"#;

#[test]
fn a_ring_is_seen_with_widths_of_few_periods_and_is_uniform_there() {
    let folder = tempfile::tempdir().unwrap();
    let recording = recorded(&folder, &scene(CUBIC));
    let at = FieldPoints::At(vec![Vec3::zeros(), Vec3::new(0.25, 0.25, 0.25)]);
    let of = |width| FieldSurvey::of(&recording, width, &at, 1);
    let mut maps = FieldMaps::of(&recording).unwrap();
    for width in [7.55, 1e9] {
        assert!(matches!(of(width), Err(NoFields::Wide { most: 7.54, .. })), "{width}");
    }
    // A page waits less long.
    for width in [1.63, 1e9] {
        assert!(matches!(maps.map(0, width), Err(NoFields::Wide { most: 1.62, .. })), "{width}");
    }
    // Far off it is as near by.
    let far = FieldPoints::At(vec![Vec3::zeros(), Vec3::new(5e9, 0.0, -5e9)]);
    let found = FieldSurvey::of(&recording, 0.125, &far, 1).unwrap();
    assert_eq!(found.fields[0][0].density, found.fields[0][1].density);
    // 2 kg in each cell, wherever one looks: the first wave is left with e^(−2π² 1.62²/0.5²).
    for seen in &of(1.62).unwrap().fields[0] {
        assert!((seen.density / 16.0 - 1.0).abs() < 1e-12, "{}", seen.density);
    }
}
