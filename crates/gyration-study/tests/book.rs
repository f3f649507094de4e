//! Blocks of TOML in the pages of the book: scenes, studies and calibrations that are whole, and parts of them.
//!
//! A whole file is read as the program reads it. Parts are marked behind the language: `toml part`, `toml part of
//! body`, `toml part of contact`, `toml part of study`. They are read with what they need around them: what a part
//! alone cannot tell may be missing, but no key is unknown and no value of a wrong kind.

use gyration_scene::{ErrorKind, Scene, SceneError};
use gyration_study::Study;
use gyration_study::calibration::Calibration;
use std::fs;
use std::path::{Path, PathBuf};

/// A study in which a part can stand.
const STUDY: &str = "scene = \"dice\"\n[keep]\nface = { face = \"die\" }\n\
    [parameter.damping]\nkey = \"contact.0.damping.beta\"\nvalues = [1e3, 1e4]\n\
    [parameter.height]\nkey = \"body.die.position.2\"\nvalues = [0.1, 0.2]\n";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The blocks of TOML of the pages: where, what stands behind the language, the text.
fn blocks() -> Vec<(String, String, String)> {
    let entries = fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let pages = entries.filter(|path| path.extension().is_some_and(|end| end == "md"));
    let mut blocks = Vec::new();
    for page in pages.chain([root().join("README.md")]) {
        let text = fs::read_to_string(&page).unwrap();
        for (place, fence) in text.match_indices("```toml") {
            let (mark, rest) = text[place + fence.len()..].split_once('\n').unwrap();
            let line = text[..place].lines().count();
            let name = page.file_name().unwrap().to_string_lossy();
            blocks.push((
                format!("{name}:{line}"),
                mark.trim().to_owned(),
                rest.split("```").next().unwrap().to_owned(),
            ));
        }
    }
    blocks
}

/// Reads a whole file.
fn whole(text: &str) -> Result<(), String> {
    let has = |key: &str| text.lines().any(|line| line.starts_with(key));
    if has("[fit.") {
        let base = root().join("docs/examples/calibrate");
        Calibration::parse("data.toml", text, &base).map(drop).map_err(|error| error.to_string())
    } else if has("scene = ") {
        Study::parse("study.toml", text, &root().join("scenes"), &[]).map(drop).map_err(|error| error.to_string())
    } else {
        Scene::parse("scene.toml", text, &root(), &[]).map(drop).map_err(|error| error.to_string())
    }
}

/// Reads a part of a scene that begins with a header of its own or stands behind `header`.
fn part(header: &str, text: &str) -> Result<(), String> {
    let Err(errors) = Scene::parse("scene.toml", &format!("{header}{text}"), &root(), &[]) else { return Ok(()) };
    let is_missing =
        |error: &SceneError| error.message.ends_with("is missing") || error.message.starts_with("there is no ");
    let is_wrong =
        |error: &&SceneError| matches!(error.fault, ErrorKind::Syntax | ErrorKind::Structure) && !is_missing(error);
    let wrong: Vec<String> = errors.into_iter().filter(is_wrong).map(ToString::to_string).collect();
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("\n")) }
}

#[test]
fn blocks_of_the_pages_are_read() {
    let blocks = blocks();
    assert!(blocks.len() > 15, "{} blocks were found", blocks.len());
    let mut wrong = Vec::new();
    for (place, mark, text) in blocks {
        let read = match mark.as_str() {
            "" => whole(&text),
            "part" => part("", &text),
            "part of body" => part("[[body]]\n", &text),
            "part of contact" => part("[[contact]]\n", &text),
            "part of study" => whole(&format!("{STUDY}{text}")),
            other => Err(format!("the mark `{other}` is not known")),
        };
        wrong.extend(read.err().map(|reason| format!("{place}: {reason}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn a_part_with_an_unknown_key_is_told() {
    assert!(part("[[contact]]\n", "repulsion = { alpha = 1, nu = 6, d0 = 1e-3 }\n").is_ok());
    assert!(part("[[contact]]\n", "repulsion = { alpa = 1, nu = 6, d0 = 1e-3 }\n").is_err());
}
