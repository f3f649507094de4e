//! Pieces of scenes, and the check that an error stands at its mark.
// Each test takes what it needs.
#![allow(dead_code)]

use gyration_scene::{Scene, SceneErrors};
use std::path::Path;

pub const TIME: &str = "[time]\nend = 1\nsample = 0.1\n";
pub const TABLE: &str = "[[support]]\nname = \"table\"\nplane = {}\n";
pub const BALL: &str =
    "[[body]]\nname = \"ball\"\nshape = { sphere = { radius = 0.1 } }\nposition = [0, 0, 1]\nmass = 1\n";

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
