//! `gyration import`: a scene of a robot's file, with a list of what is not in it.

use crate::arguments::ImportArguments;
use crate::error::{CliError, code};
use crate::input::{quoted, shown, stem};
use crate::output;
use gyration_robots::{Import, Options, import};
use gyration_scene::Scene;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Writes the scene, opens it, and says what was left out and what was chosen.
pub fn execute(arguments: &ImportArguments) -> Result<u8, CliError> {
    let file = &arguments.file;
    let path = arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{}.toml", stem(file))));
    let is_stdout = path.as_os_str() == "-";
    let folder = if is_stdout { Path::new("") } else { path.parent().unwrap_or(Path::new("")) };
    let made = import(file, Options { folder, is_base_fixed: arguments.fixed_base })?;
    if is_stdout {
        output::print(&made.scene)?;
    } else {
        output::write_scene(
            &path,
            &made.scene,
            arguments.force,
            "choose another name by -o, or replace it by --force",
        )?;
    }
    if !arguments.quiet {
        output::say(&told(&made));
    }
    // What a scene refuses of a robot is told with the lines of the scene.
    Scene::parse(&path.to_string_lossy(), &made.scene, folder, &[]).map_err(gyration_scene::LoadError::Content)?;
    if !is_stdout && !arguments.quiet {
        output::say(&format!("{}: `gyration view {}` shows it", shown(&path), quoted(&path.to_string_lossy())));
    }
    Ok(code::DONE)
}

/// Both lists, a line each.
fn told(Import { left_out, chosen, .. }: &Import) -> String {
    let mut text = String::new();
    for (title, list) in [("left out", left_out), ("chosen", chosen)] {
        for finding in list {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{title}: {finding}");
        }
    }
    let _ = write!(text, "{} left out, {} chosen", left_out.len(), chosen.len());
    text
}
