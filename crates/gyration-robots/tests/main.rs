//! Everything that is proved of this crate from outside.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod faults;
mod left_out;
mod mjcf;
mod motion;
mod poses;
mod urdf;

use gyration_robots::{Faults, Import, Options, import_text};
use gyration_scene::Scene;
use std::path::Path;

/// A scene in the current folder.
fn here() -> Options<'static> {
    Options { folder: Path::new(""), is_base_fixed: false }
}

/// What comes of a text.
fn tried(text: &str) -> Result<Import, Faults> {
    import_text("robot.xml", text, Path::new(""), here())
}

/// What comes of a text without faults.
fn imported(text: &str) -> Import {
    tried(text).unwrap_or_else(|faults| panic!("{faults}"))
}

/// The scene of a text without faults, which must be one.
fn opened(import: &Import) -> Scene {
    let scene = Scene::parse("scene.toml", &import.scene, Path::new(""), &[]);
    scene.unwrap_or_else(|errors| panic!("{errors}\n{}", import.scene))
}

/// The faults of a text, each without its fix.
fn refused(text: &str) -> Vec<String> {
    let faults = tried(text).unwrap_err();
    faults.as_slice().iter().map(|fault| format!("{}: {}", fault.line, fault.message)).collect()
}
