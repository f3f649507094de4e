//! `gyration scenes`: the gallery.

use crate::arguments::Scenes;
use crate::error::{CliError, code};
use crate::output;
use gyration_scene::{gallery, gallery_scene, gallery_title};
use serde_json::{Value, json};

/// Lists the gallery, or prints one scene as it stands.
pub fn execute(arguments: &Scenes) -> Result<u8, CliError> {
    match &arguments.name {
        None if arguments.json => output::print(&format!("{:#}\n", in_json()))?,
        None => output::print(&list())?,
        Some(name) => output::print(gallery_scene(name)?)?,
    }
    Ok(code::DONE)
}

/// Name and title of each scene.
fn in_json() -> Value {
    let scene = |(name, text): &(&str, &str)| json!({ "name": name, "title": gallery_title(text).unwrap_or_default() });
    gallery().iter().map(scene).collect()
}

/// Name and title of each scene, a line each.
fn list() -> String {
    let titles = gallery().iter().map(|(name, text)| (name, gallery_title(text).unwrap_or_default()));
    let width = gallery().iter().map(|(name, _)| name.len()).max().unwrap_or_default();
    let lines: String = titles.map(|(name, title)| format!("{name:<width$}  {title}\n")).collect();
    lines + "\n`gyration run NAME` runs one, `gyration scenes NAME` prints its file, with what to look at.\n"
}
