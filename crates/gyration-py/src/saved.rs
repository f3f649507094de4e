//! States of simulations as bytes, and simulations as files.
//!
//! ```text
//! state   gyration state VERSION SCENE WORD ⏎ checkpoint
//! file    scene as JSON ⏎ state
//! ```
//!
//! SCENE is a word of the resolved scene, WORD one of the checkpoint: a state of another scene, and damage, are told.

use crate::errors;
use crate::scene::{Scene, SceneParts};
use gyration_files::in_words;
use gyration_record::{word_of, write_file};
use gyration_sim::SteppedRun;
use pyo3::prelude::*;
use std::path::Path;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The line before a checkpoint.
fn head(scene: u64, checkpoint: &[u8]) -> String {
    format!("gyration state {VERSION} {scene:016x} {:016x}\n", word_of(checkpoint))
}

/// A word of a scene: another one has another.
pub fn scene_word(scene: &Scene) -> u64 {
    word_of(scene.inner.resolved().to_string().as_bytes())
}

/// The state of a simulation of a scene with this word.
pub fn state_of(stepper: &SteppedRun, scene: u64) -> Vec<u8> {
    let checkpoint = stepper.checkpoint();
    [head(scene, &checkpoint).into_bytes(), checkpoint].concat()
}

/// The checkpoint in a state of a simulation of a scene with this word.
pub fn checkpoint_of(state: &[u8], scene: u64) -> PyResult<&[u8]> {
    let refused = |problem: &str, fix: &str| Err(errors::arguments(format!("{problem}\n  fix: {fix}")));
    let end = state.iter().position(|byte| *byte == b'\n').map_or(0, |place| place + 1);
    let (line, checkpoint) = state.split_at(end);
    let line = String::from_utf8_lossy(line);
    let words: Vec<&str> = line.split_whitespace().collect();
    let &["gyration", "state", version, of, _] = words.as_slice() else {
        return refused("these bytes are no state of a simulation", "give what `state` of a simulation was");
    };
    if version != VERSION {
        let problem = format!("the state is one of version {version}, and this is {VERSION}");
        return refused(&problem, "simulate it anew, or install that version");
    }
    if of != format!("{scene:016x}") {
        let fix =
            "make the simulation of the scene that the state is of, or give positions and velocities by set_state";
        return refused("the state is one of another scene", fix);
    }
    match line == head(scene, checkpoint) {
        true => Ok(checkpoint),
        false => refused("the state is damaged", "simulate it anew"),
    }
}

/// Writes a scene and a state of it into a file.
pub fn save(path: &Path, scene: &Scene, state: &[u8]) -> PyResult<()> {
    let scene = serde_json::to_string(&scene.parts()).map_err(|error| errors::arguments(error.to_string()))?;
    write_file(path, &[scene.as_bytes(), b"\n", state].concat()).map_err(errors::record)
}

/// Reads what [`save`] wrote: the scene, and the state.
pub fn read(py: Python<'_>, path: &Path) -> PyResult<(Scene, Vec<u8>)> {
    let read = std::fs::read(path).map_err(|error| errors::unreadable(path, &in_words(&error)))?;
    let (scene, state) = read.split_at(read.iter().position(|byte| *byte == b'\n').unwrap_or(0));
    let parts: SceneParts = serde_json::from_slice(scene)
        .map_err(|_| errors::unreadable(path, "it is no simulation that was saved by Simulation.save"))?;
    let (file, text, base, overrides) = parts;
    Ok((Scene::parse(py, file, &text, base, &overrides)?.complete(py)?, state[1..].to_vec()))
}
