//! Pieces of scenes, and the check that an error stands at its mark.

// Each test takes what it needs.
#![allow(dead_code)]

use gyration::state::BodyMotion;
use gyration_scene::{Scene, SceneErrors};
use std::path::Path;

/// A block of 12 kg, 1 m by 2 m by 3 m, for a second.
pub const BLOCK: &str =
    "[time]\nend = 1\nsample = 0.1\n[[body]]\nname = \"b\"\nshape = { box = { size = [1, 2, 3] } }\nmass = 12\n";

pub const TIME: &str = "[time]\nend = 1\nsample = 0.1\n";
pub const TABLE: &str = "[[support]]\nname = \"table\"\nplane = {}\n";
pub const BALL: &str =
    "[[body]]\nname = \"ball\"\nshape = { sphere = { radius = 0.1 } }\nposition = [0, 0, 1]\nmass = 1\n";

/// The scene of a block with these lines.
#[track_caller]
pub fn block(lines: &str) -> Scene {
    let text = format!("{BLOCK}{lines}\n");
    Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

/// How the first body starts.
pub fn start(scene: &Scene) -> BodyMotion {
    scene.built().state.motion(&scene.built().model, 0)
}

/// The resolved form is a scene that resolves to itself and starts alike.
#[track_caller]
pub fn assert_resolves_to_itself(scene: &Scene) {
    let resolved = scene.resolved();
    let again = Scene::parse("again.json", &resolved.to_string(), Path::new(""), &[]);
    let again = again.unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(again.resolved(), resolved);
    assert_eq!(again.built().state, scene.built().state);
}

pub fn errors(name: &str, text: &str, overrides: &[String]) -> SceneErrors {
    match Scene::parse(name, text, Path::new("/nowhere"), overrides) {
        Ok(_) => panic!("no error in\n{text}"),
        Err(errors) => errors,
    }
}

/// One error, at the mark, with this key, this part of the message and this part of the fix.
#[track_caller]
pub fn assert_error(marked: &str, key: &str, message: &str, help: &str) {
    let Some(at) = marked.find('§') else { panic!("no mark in {marked}") };
    let line = marked[..at].matches('\n').count() + 1;
    let column = marked[..at].chars().rev().take_while(|c| *c != '\n').count() + 1;
    let found = errors("scene.toml", &marked.replace('§', ""), &[]);
    assert_eq!(found.count(), 1, "{found}");
    let error = &found.as_slice()[0];
    assert_eq!((error.file.as_str(), error.line, error.column), ("scene.toml", line, column), "{error}");
    assert_eq!(error.key, key, "{error}");
    assert!(error.message.contains(message), "{error}\n  does not say: {message}");
    assert!(error.help.contains(help), "{error}\n  does not advise: {help}");
}

/// A row about a body: the lines after `mass = 1` of a body without a shape.
pub type Row = (&'static str, &'static str, &'static str, &'static str);
