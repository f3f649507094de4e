//! `gyration scenes`: the gallery.

use crate::arguments::Scenes;
use crate::error::{CliError, code};
use crate::output;
use gyration_scene::{Scene, gallery, gallery_scene};
use std::fmt::Write as _;

/// Width of the lines of a description [letters].
const WIDTH: usize = 88;

/// Lists the gallery, or prints one scene as it stands.
pub fn execute(arguments: &Scenes) -> Result<u8, CliError> {
    match &arguments.name {
        None => output::print(&list())?,
        Some(name) => output::print(gallery_scene(name)?)?,
    }
    Ok(code::DONE)
}

/// Name and title of each scene, and the sentences at the head of its file.
fn list() -> String {
    let mut list = String::new();
    for (name, text) in gallery() {
        let title = Scene::open(name, &[]).ok().and_then(|scene| scene.file().title.clone()).unwrap_or_default();
        // Writing to a string does not fail.
        let _ = writeln!(list, "{name:<12} {title}");
        let head = head(text);
        // A head that begins with the title goes on after it.
        let told = head.strip_prefix(&title).map_or(head.as_str(), |rest| rest.trim_start_matches(['.', ' ']));
        for line in wrapped(told) {
            let _ = writeln!(list, "{:<12} {line}", "");
        }
    }
    list + "\n`gyration run NAME` runs one, `gyration scenes NAME` prints its file.\n"
}

/// The comment at the beginning of a file.
fn head(text: &str) -> String {
    let comment = text.lines().map_while(|line| line.strip_prefix('#'));
    comment.map(str::trim).collect::<Vec<_>>().join(" ")
}

fn wrapped(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.len() + 1 + word.len() <= WIDTH => *line += &format!(" {word}"),
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
