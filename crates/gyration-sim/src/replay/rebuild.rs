//! The scene of a recording from its attributes.
//!
//! `resolved` is a scene in JSON with every default in its place, so that later defaults do not matter; `scene`, with
//! `overrides`, serves where it is missing or not understood. What was built must have the files and bodies that were
//! recorded: a table or a mesh may have changed behind its name.

use super::error::ReplayError;
use crate::resistance::complete;
use crate::scene_files::changed_files;
use gyration::body::Body;
use gyration::model::Model;
use gyration_record::{Attributes, Recording};
use gyration_scene::{FileSum, Scene, SceneErrors};
use serde_json::Value;
use std::path::Path;

/// Relative difference of masses, centres and Euler tensors that rounding explains: sums over the triangles of a mesh.
const ROUNDING: f64 = 1e-9;

/// The scene of a recording, ready to run.
///
/// Files that it names are looked for beside the recording, then in the current folder; those with other numbers than
/// when the run was made are not taken.
///
/// # Errors
/// `NoScene`, `Scene` (a mesh or a table may have moved), `OtherFiles` (or have changed), `OtherBody`.
pub fn scene(recording: &Recording) -> Result<Scene, ReplayError> {
    let beside = recording.path().parent().unwrap_or(Path::new(""));
    let mut failures = Vec::new();
    for (name, text, overrides) in texts(recording.attributes()) {
        for base in [beside, Path::new("")] {
            match recorded_scene(recording, Scene::parse(&name, &text, base, &overrides)) {
                Ok(scene) => return Ok(scene),
                Err(failure) => failures.push(failure),
            }
        }
    }
    // A file that has changed says more than one that is not there.
    let telling = failures.into_iter().min_by_key(|failure| matches!(failure, ReplayError::Scene { .. }));
    Err(telling.unwrap_or_else(|| ReplayError::NoScene { path: recording.path().to_path_buf() }))
}

/// A scene made ready to run, if it leads to what was recorded.
fn recorded_scene(recording: &Recording, parsed: Result<Scene, SceneErrors>) -> Result<Scene, ReplayError> {
    let path = || recording.path().to_path_buf();
    let failed = |errors| ReplayError::Scene { path: path(), errors: Box::new(errors) };
    let scene = parsed.map_err(failed)?;
    let place = |one: &FileSum| format!("{} (`{}`)", scene.base().join(&one.file).display(), one.key);
    let changed: Vec<String> = changed_files(recording.attributes(), &scene).iter().map(place).collect();
    if !changed.is_empty() {
        return Err(ReplayError::OtherFiles { path: path(), files: changed.join(", ") });
    }
    let scene = complete(scene).map_err(failed)?;
    check(recording, &scene.built().model)?;
    Ok(scene)
}

/// The texts that may be the scene, with their names and overrides, the best first.
fn texts(attributes: &Attributes) -> Vec<(String, String, Vec<String>)> {
    let name = attributes.get("scene_name").and_then(Value::as_str).unwrap_or("scene");
    let overrides = attributes.get("overrides").and_then(Value::as_array).into_iter().flatten();
    let overrides = overrides.filter_map(Value::as_str).map(String::from).collect();
    let resolved = attributes.get("resolved").filter(|resolved| resolved.is_object());
    let resolved = resolved.map(|it| (format!("{name}.json"), it.to_string(), Vec::new()));
    let written = attributes.get("scene").and_then(Value::as_str);
    let written = written.map(|it| (format!("{name}.toml"), it.to_owned(), overrides));
    resolved.into_iter().chain(written).collect()
}

/// Whether the bodies are those that were recorded.
fn check(recording: &Recording, model: &Model) -> Result<(), ReplayError> {
    let recorded = recording.attributes().get("bodies").and_then(Value::as_array).cloned().unwrap_or_default();
    for (k, recorded) in recorded.iter().enumerate() {
        let difference = match model.bodies.get(k) {
            None => Some("it is not there"),
            Some(body) => difference(model.name(k), body, recorded),
        };
        if let Some(quantity) = difference {
            let body = recorded.get("name").and_then(Value::as_str).unwrap_or_default().to_owned();
            return Err(ReplayError::OtherBody { path: recording.path().to_path_buf(), body, quantity });
        }
    }
    Ok(())
}

/// What differs between a body and its description.
fn difference(name: &str, body: &Body, recorded: &Value) -> Option<&'static str> {
    let numbers = |key: &str| -> Vec<f64> {
        let value = recorded.get(key);
        let list = value.and_then(Value::as_array).cloned().unwrap_or_else(|| value.cloned().into_iter().collect());
        list.iter().filter_map(Value::as_f64).collect()
    };
    let differ = |key: &str, values: &[f64], scale: f64| {
        let recorded = numbers(key);
        let far = |(a, b): (&f64, &f64)| (a - b).abs() > ROUNDING * scale;
        !recorded.is_empty() && (recorded.len() != values.len() || recorded.iter().zip(values).any(far))
    };
    let mass = &body.solid.mass;
    if recorded.get("name").and_then(Value::as_str).is_some_and(|recorded| recorded != name) {
        Some("the name")
    } else if differ("mass", &[mass.mass], mass.mass) {
        Some("the mass")
    } else if differ("center", mass.center.as_slice(), body.size + mass.center.norm()) {
        Some("the centre of mass")
    } else if differ("euler_tensor", mass.euler_tensor.as_slice(), mass.euler_tensor.norm()) {
        Some("the Euler tensor")
    } else {
        None
    }
}
