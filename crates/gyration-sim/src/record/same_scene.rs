//! Whether a recording is of a scene, and in what it is of another one.
//!
//! Compared are the resolved scene without what may differ between a run and its resumption, the bodies that it led to,
//! and the files that it names, which may have changed behind their names.

use super::{Job, differences};
use crate::ports::RunError;
use crate::scene_files::changed_files;
use gyration::kinematics::BodyMotion;
use gyration_files::check;
use gyration_record::Attributes;
use gyration_scene::file::Copies;
use gyration_scene::{Built, Scene};
use serde_json::{Value, json};
use std::path::Path;

/// The attribute of recordings without checksums of files in which the start of all bodies stands.
const PLACES: &str = "places";
/// The keys of `solver` that may differ between a run and its resumption.
const MAY_DIFFER: [&str; 2] = ["max_wall_time", "threads"];

impl Job<'_> {
    /// Whether a recording is of this scene, whatever its `solver.max_wall_time` and `solver.threads`.
    pub fn is_recorded_in(&self, recording: &Attributes) -> bool {
        comparable(&self.all_attributes()) == comparable(recording)
            && changed_files(recording, self.scene).is_empty()
            && recording.get(PLACES).is_none_or(|sum| sum_of_places(self.scene).as_ref() == Some(sum))
    }

    /// The refusal to go on with the recording of another scene: in what it differs, and what to do.
    pub(super) fn other_scene(&self, path: &Path, recorded: &Attributes) -> RunError {
        let [there, here] = [recorded, &self.all_attributes()].map(comparable);
        let resolved = |scene: Option<(Value, Value)>| scene.map_or(Value::Null, |(resolved, _)| resolved);
        let keys = differences(&resolved(there), &resolved(here));
        let (what, fix) = if keys.is_empty() { self.other_files(recorded) } else { (keys, self.repeated(recorded)) };
        RunError::OtherScene { path: path.to_path_buf(), what: what.join("\n  "), fix }
    }

    /// The files by which equal keys lead to another scene, and what to do.
    fn other_files(&self, recorded: &Attributes) -> (Vec<String>, String) {
        let changed = changed_files(recorded, self.scene);
        let mut what: Vec<String> = changed
            .iter()
            .map(|changed| format!("{}: the file {} has changed since the run was made", changed.key, changed.file))
            .collect();
        if what.is_empty() {
            what.push("the bodies themselves: a file that they are made of has changed, or the program".to_owned());
        }
        let back = if what.len() == 1 { "put the file back as it was" } else { "put the files back as they were" };
        (what, back.to_owned())
    }

    /// The overrides with which a recording goes on.
    fn repeated(&self, recorded: &Attributes) -> String {
        let overrides = recorded.get("overrides").and_then(Value::as_array).into_iter().flatten();
        let there = binding(overrides.filter_map(Value::as_str));
        let own = self.scene.overrides();
        let here = binding(own.iter().map(String::as_str));
        match there.is_empty() {
            _ if there == here => "put the scene back as it was".to_owned(),
            true => "it was made without --set".to_owned(),
            false => format!("repeat{there}"),
        }
    }
}

/// The overrides that a resumption must repeat.
fn binding<'a>(overrides: impl Iterator<Item = &'a str>) -> String {
    let may_differ = |text: &&str| {
        let key = text.split('=').next().unwrap_or_default().trim();
        MAY_DIFFER.iter().any(|name| key.strip_prefix("solver.") == Some(name))
    };
    overrides.filter(|text| !may_differ(text)).map(|text| format!(" --set '{text}'")).collect()
}

/// The resolved scene without what may differ between a run and its resumption, and the bodies that it led to.
fn comparable(attributes: &Attributes) -> Option<(Value, Value)> {
    let mut resolved = attributes.get("resolved")?.clone();
    if let Some(solver) = resolved.get_mut("solver").and_then(Value::as_object_mut) {
        for name in MAY_DIFFER {
            solver.remove(name);
        }
    }
    let outlines = attributes.get("outlines").unwrap_or(&Value::Null);
    Some((resolved, [attributes.get("bodies")?, outlines].into_iter().cloned().collect()))
}

/// A checksum of how all bodies start, of a scene with a table of places.
fn sum_of_places(scene: &Scene) -> Option<Value> {
    let mut copies = scene.file().body.iter().flat_map(|body| &body.copies);
    copies.find(|copies| matches!(***copies, Copies::Places(_)))?;
    let Built { model, state, .. } = scene.built();
    let mut bytes = Vec::new();
    for body in 0..model.bodies.len() {
        let BodyMotion { placement, velocity } = state.motion(model, body);
        let (centers, tensors) =
            ([placement.position, velocity.velocity], [placement.gradient, velocity.gradient_rate]);
        let numbers = centers.iter().flatten().chain(tensors.iter().flatten());
        bytes.extend(numbers.flat_map(|number| number.to_le_bytes()));
    }
    Some(json!(format!("{:08x}", check::sum(&bytes))))
}
