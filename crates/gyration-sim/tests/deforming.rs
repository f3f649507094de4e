//! The resistance of a shape that deforms: what is interpolated against what is computed, at forms that are no nodes.

use gyration::fluid::{Resolution, largest_error};
use gyration::shape::{Cuboid, Shape};
use gyration::tensor::{Mat3, Vec3};
use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::resistance::DeformingSurface;
use gyration_sim::{
    Job, MemorySink, Outcome, Provenance, Reason, RecordingEnd, RunError, RunPlan, Simulation, Unwatched, complete,
};
use gyration_threads::Interruption;
use std::path::Path;
use std::time::Duration;

const TOLERANCE: f64 = 2e-2;

/// A symmetric matrix of determinant 1, of stretches up to about 1.5.
fn form(n: usize) -> Mat3 {
    let root = Mat3::from_fn(|i, j| 0.2 * (2.9 * n as f64 + 1.7 * (3 * i + j) as f64).sin());
    let form = Mat3::identity() + 0.5 * (root + root.transpose());
    form / form.determinant().cbrt()
}

fn largest(shape: &Shape) -> f64 {
    let surface = DeformingSurface::new(shape, 80);
    let table = surface.clone().table(Resolution { tolerance: TOLERANCE, spacing: None }).unwrap();
    let errors = (0..3).map(|n| {
        let exact = surface.resistance(&form(n)).unwrap().matrix;
        largest_error(&table.matrix(&form(n)).unwrap(), &exact)
    });
    let largest = errors.fold(0.0, f64::max);
    println!(
        "{shape:?}: largest error {largest:.1e} of a tolerance of {TOLERANCE:.0e}, {:?} nodes and simplices",
        table.size()
    );
    largest
}

#[test]
fn interpolated_resistances_of_a_box_are_within_the_tolerance() {
    assert!(largest(&Shape::Box(Cuboid { size: Vec3::new(2.0, 1.0, 1.5) })) < TOLERANCE);
}

/// A box and an ellipsoid that sink, the box as a body of this kind.
fn sinking(kind: &str) -> String {
    format!(
        r#"
        time = {{ end = 1e-3, sample = 1e-3 }}
        fluid = {{ viscosity = 1 }}
        [[body]]
        name = "box"
        shape = {{ box = {{ size = ["6 mm", "4 mm", "4 mm"] }} }}
        density = 2500
        {kind}
        inclusion = {{ inertia = false, triangles = 100 }}
        [[body]]
        name = "egg"
        shape = {{ ellipsoid = {{ semi_axes = ["6 mm", "4 mm", "4 mm"] }} }}
        density = 2500
        position = [0, 0, 1]
        inclusion = {{}}
        "#
    )
}

#[test]
fn resistances_by_boundary_elements_are_asked_for_when_a_scene_is_to_run() {
    for kind in ["", "affine = { material = { neo_hookean = { shear = 1e3 } } }"] {
        let scene = Scene::parse("sinking.toml", &sinking(kind), Path::new(""), &[]).unwrap();
        let asked: Vec<usize> = scene.unknown_forms().iter().map(|form| form.body).collect();
        assert_eq!(asked, [0]);
        let begin = |scene: &Scene| {
            let built = scene.built();
            let plan = RunPlan::from(built);
            let mut simulation = Simulation::new(&built.model, &built.state, plan)?;
            simulation.run(&mut MemorySink::default(), &mut Unwatched)
        };
        assert!(!matches!(begin(&scene), Ok(Outcome::Completed)), "it ran without its resistance");
        let whole = complete(scene).unwrap();
        assert!(whole.unknown_forms().is_empty());
        assert_eq!(begin(&whole).unwrap(), Outcome::Completed);
    }
}

/// Two tetrahedra that share a corner only: closed, and no surface that a flow can be computed around.
#[test]
fn surface_without_a_resistance_is_told_at_its_key() {
    let folder = tempfile::tempdir().unwrap();
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 4 0 0\nv 5 0 0\nv 4 1 0\nv 4 0 1\n";
    let faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 7 5 8\n";
    std::fs::write(folder.path().join("two.obj"), format!("{corners}{faces}")).unwrap();
    let text = sinking("").replace("box = { size = [\"6 mm\", \"4 mm\", \"4 mm\"] }", "mesh = { file = \"two.obj\" }");
    let errors = complete(Scene::parse("two.toml", &text, folder.path(), &[]).unwrap()).unwrap_err();
    let [error] = errors.as_slice() else { panic!("{errors}") };
    assert_eq!((error.file.as_str(), error.line, error.key.as_str()), ("two.toml", 6, "body.box.shape"));
    assert!(error.message.starts_with("boundary elements: "), "{errors}");
}

/// A box that is drawn out, so that it enters one form after the other; its own surface for each caller.
fn drawn_out(length: f64) -> Scene {
    let text = format!(
        r#"
        time = {{ end = 0.6, sample = 0.05 }}
        solver.rtol = 1e-4
        fluid = {{ viscosity = 1, velocity_gradient = [[1, 0, 0], [0, -0.5, 0], [0, 0, -0.5]] }}
        [[body]]
        name = "box"
        shape = {{ box = {{ size = [{length}, 1, 1] }} }}
        density = 1
        affine = {{ material = {{ neo_hookean = {{ shear = 1 }} }}, }}
        inclusion = {{ inertia = false, triangles = 80, spacing = 0.25, tolerance = 0.3 }}
        "#
    );
    complete(Scene::parse("drawn.toml", &text, Path::new(""), &[]).unwrap()).unwrap()
}

#[test]
fn run_that_is_given_up_within_a_matrix_goes_on_to_the_same_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let provenance = Provenance { version: "1".into(), commit: None };
    let (patient, impatient) = (folder.path().join("patient.gyr"), folder.path().join("impatient.gyr"));
    let scene = drawn_out(1.3);
    let RecordingEnd::Ran(whole) = Job::of(&scene, &provenance).record(&patient, &mut Unwatched).unwrap() else {
        panic!("it had ended before it began")
    };
    assert_eq!(whole.outcome, Outcome::Completed);

    // The matrices are known by now; those of another box are not, and take the same time.
    let (scene, mut given_up) = (drawn_out(1.3 * (1.0 + 1e-9)), 0);
    let mut job = Job::of(&scene, &provenance);
    let mut begun = false;
    for attempt in 1.. {
        job.max_wall_time = Some(Duration::from_millis(attempt));
        let ended = if begun { job.resume(&impatient, &mut Unwatched) } else { job.record(&impatient, &mut Unwatched) };
        begun = impatient.exists();
        match ended {
            Err(RunError::Interrupted(stop)) => assert_eq!(stop.reason, Reason::WallTime),
            Ok(RecordingEnd::Ran(summary)) if summary.outcome == Outcome::Completed => break,
            Ok(RecordingEnd::Ran(summary)) => assert!(!summary.outcome.is_final(), "{}", summary.in_words),
            other => panic!("{other:?}"),
        }
        given_up += 1;
    }
    println!("{given_up} times given up");
    assert!(given_up > 3, "only {given_up} times given up");

    let straight = folder.path().join("straight.gyr");
    Job::of(&scene, &provenance).record(&straight, &mut Unwatched).unwrap();
    let [impatient, straight] = [impatient, straight].map(|path| Recording::open(&path).unwrap());
    for array in straight.arrays() {
        let [one, other] = [&impatient, &straight].map(|recording| recording.read(&array.name).ok());
        // What is not known is no number, which equals nothing.
        assert!(format!("{one:?}") == format!("{other:?}"), "{}", array.name);
    }
    assert_eq!(impatient.attributes(), straight.attributes());
}

#[test]
fn matrices_and_runs_that_nobody_waits_for_are_not_begun() {
    let scene = drawn_out(1.7);
    let built = scene.built();
    let at_once = Interruption::default().after(Some(Duration::ZERO));
    let begun = at_once.within(|| Simulation::new(&built.model, &built.state, RunPlan::from(built)).err());
    assert!(matches!(begun, Some(RunError::Interrupted(stop)) if stop.reason == Reason::WallTime));
    let text = sinking("").replace("\"4 mm\"]", "\"4.1 mm\"]");
    let scene = Scene::parse("sinking.toml", &text, Path::new(""), &[]).unwrap();
    let errors = at_once.within(|| complete(scene)).unwrap_err();
    assert!(errors.is_interrupted() && errors.to_string().contains("max_wall_time"), "{errors}");
}
