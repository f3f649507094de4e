//! What arguments name: scenes, files, folders; and how they are written again.

use crate::arguments::SceneArguments;
use crate::error::CliError;
use gyration_scene::Scene;
use std::fs;
use std::path::Path;

/// Opens the scene of the arguments.
pub fn open(arguments: &SceneArguments) -> Result<Scene, CliError> {
    Ok(Scene::open(&arguments.scene, &arguments.overrides)?)
}

/// Opens the scene of the arguments, ready to run: with the resistances that boundary elements tell.
pub fn ready(arguments: &SceneArguments) -> Result<Scene, CliError> {
    Ok(gyration_sim::open(&arguments.scene, &arguments.overrides)?)
}

/// The same, at rest: without the waves with which its run starts.
pub fn at_rest(arguments: &SceneArguments) -> Result<Scene, CliError> {
    Ok(gyration_sim::open_at_rest(&arguments.scene, &arguments.overrides)?)
}

/// The name of a file or directory without folder and ending.
pub fn stem(path: &Path) -> String {
    // `.` and `..` have no name of their own.
    let named = path.canonicalize().ok().filter(|_| path.file_name().is_none());
    let name = named.as_deref().unwrap_or(path).file_stem();
    name.map_or_else(|| "recording".to_owned(), |name| name.to_string_lossy().into_owned())
}

/// An argument as a shell reads it.
pub fn quoted(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./=,:+".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        text.to_owned()
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

/// The path from here, as the user would write it.
pub fn shown(path: &Path) -> String {
    let here = std::env::current_dir().and_then(fs::canonicalize);
    let full = fs::canonicalize(path);
    match (here, full) {
        (Ok(here), Ok(full)) => full.strip_prefix(here).unwrap_or(path).display().to_string(),
        _ => path.display().to_string(),
    }
}
