//! The refusal to go on with the table of another study: in what it is another one, and how the table was made.

use crate::error::StudyError;
use crate::read::RULES;
use crate::study::Study;
use gyration_scene::Template;
use gyration_scene::input::InputFile;
use gyration_sim::differences;
use serde_json::{Value as Json, json};
use std::path::Path;

/// Keys of a study that its table does not depend on; the text of its scene is compared instead of the path.
const ELSEWHERE: [&str; 3] = ["title", "plot", "scene"];

/// The refusal of a table with this manifest.
pub(super) fn other_study(folder: &Path, manifest: &Json, study: &Study) -> StudyError {
    let text = |pointer: &str| manifest.pointer(pointer).and_then(Json::as_str).unwrap_or_default();
    let overrides = manifest.pointer("/study/overrides").and_then(Json::as_array).into_iter().flatten();
    let overrides: Vec<String> = overrides.filter_map(Json::as_str).map(str::to_owned).collect();
    let there = tree(text("/study/text"), &overrides, written(text("/scene/text"), study));
    let here = tree(study.source().text.as_str(), &study.source().overrides, Some(study.template().written()));
    let what = match (there, here) {
        (Some(there), Some(here)) => differences(&there, &here),
        _ => Vec::new(),
    };
    let what = match what.is_empty() {
        true => "a file that it is made of has changed, or the program".to_owned(),
        false => what.join("\n  "),
    };
    let set: String = overrides.iter().map(|text| format!(" --set '{text}'")).collect();
    let fix = if set.is_empty() { "it was made without --set".to_owned() } else { format!("repeat{set}") };
    StudyError::OtherStudy { path: folder.to_owned(), what: format!("another study:\n  {what}"), fix }
}

/// A study as it is written, with what its overrides set and with its scene; none if it cannot be read any more.
fn tree(text: &str, overrides: &[String], scene: Option<Json>) -> Option<Json> {
    let mut tree = InputFile::parse(name_of(text), text, &RULES, overrides).ok()?.value(&[])?;
    let keys = tree.as_object_mut()?;
    ELSEWHERE.iter().for_each(|key| drop(keys.remove(*key)));
    keys.insert("scene".into(), scene.unwrap_or(json!(null)));
    Some(tree)
}

/// What the scene of a table says; paths in it do not count here.
fn written(text: &str, study: &Study) -> Option<Json> {
    Template::parse(name_of(text), text, study.template().base()).ok().map(|scene| scene.written())
}

/// A name with the ending of its format.
fn name_of(text: &str) -> &'static str {
    if text.trim_start().starts_with('{') { "there.json" } else { "there.toml" }
}
