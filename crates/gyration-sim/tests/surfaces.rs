//! The surfaces in a recording: what a reader finds of them, and what they cost.

use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::{Job, Provenance, Unwatched};
use std::path::Path;

/// Bodies that share a shape, one of its own, and points; mid-flight.
const SCENE: &str = r#"
title = "Three surfaces"
[time]
end = 0.01
sample = 0.01
[[body]]
name = "left"
shape = { cone = { radius = 0.1, height = 0.2 } }
density = 1000.0
[[body]]
name = "right"
shape = { cone = { radius = 0.1, height = 0.2 } }
density = 2000.0
position = [1, 0, 0]
[[body]]
name = "crate"
shape = { box = { size = [0.1, 0.2, 0.3] } }
density = 1000.0
position = [2, 0, 0]
[[body]]
name = "grains"
shape = { points = [{ mass = 1.0, at = [0, 0, 0] }, { mass = 1.0, at = [1, 0, 0] }, { mass = 1.0, at = [0, 1, 0] }] }
position = [3, 0, 0]
[[body]]
name = "loaded"
shape = { box = { size = [0.1, 0.2, 0.3] } }
mass_properties = { mass = 1.0, center = [0, 0, 0.01], euler_tensor = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }
position = [5, 0, 0]
"#;

fn recorded(folder: &Path) -> Recording {
    let scene = Scene::parse("surfaces.toml", SCENE, Path::new(""), &[]).unwrap();
    let provenance = Provenance { version: "0".into(), commit: None };
    let path = folder.join("surfaces.gyr");
    Job::of(&scene, &provenance).record(&path, &mut Unwatched).unwrap();
    Recording::open(&path).unwrap()
}

#[test]
fn each_distinct_surface_is_recorded_once_and_named_by_its_bodies() {
    let folder = tempfile::tempdir().unwrap();
    let recording = recorded(folder.path());
    let surfaces: Vec<_> =
        recording.attributes()["bodies"].as_array().unwrap().iter().map(|body| &body["surface"]).collect();
    assert_eq!(serde_json::json!(surfaces), serde_json::json!([0, 0, 1, null, 2]));
    let (points, triangles) =
        (recording.array("surface_0_points").unwrap(), recording.array("surface_0_triangles").unwrap());
    assert_eq!(points.dims, ["surface_0_point", "row"]);
    assert_eq!(triangles.dims, ["surface_0_triangle", "corner"]);
    assert_eq!((points.units.as_str(), triangles.units.as_str()), ("m", "1"));
    let corners = recording.read("surface_0_triangles").unwrap().data;
    let count = points.shape[0] as f64;
    assert!(corners.iter().all(|&corner| corner >= 0.0 && corner < count && corner.fract() == 0.0));
    assert_eq!(recording.read("surface_1_points").unwrap().shape, [8, 3]);
    assert_eq!(recording.read("surface_1_triangles").unwrap().shape, [12, 3]);
    assert!(recording.array("surface_3_points").is_err());
}

#[test]
fn surfaces_are_relative_to_the_centre_of_mass() {
    let folder = tempfile::tempdir().unwrap();
    let recording = recorded(folder.path());
    // The centre of mass of a cone stands a quarter of its height above the base; that of the loaded box is given.
    for (surface, bottom, top) in [(0, -0.05, 0.15), (1, -0.15, 0.15), (2, -0.16, 0.14)] {
        let points = recording.read(&format!("surface_{surface}_points")).unwrap().data;
        let heights = || points.iter().copied().skip(2).step_by(3);
        let (lowest, highest) = (heights().fold(1.0, f64::min), heights().fold(-1.0, f64::max));
        assert!((lowest - bottom).abs() < 1e-15 && (highest - top).abs() < 1e-15, "{lowest} {highest}");
    }
}
