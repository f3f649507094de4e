//! What a shell may complete: scenes of the gallery, ready studies, paths.

use clap_complete::engine::{ArgValueCompleter, CompletionCandidate, PathCompleter, ValueCompleter};
use std::ffi::OsStr;

/// What completes a word.
pub(super) fn completer(candidates: fn(&OsStr) -> Vec<CompletionCandidate>) -> ArgValueCompleter {
    ArgValueCompleter::new(candidates)
}

/// Names of the gallery that begin so.
pub(super) fn names_of_scenes(begun: &OsStr) -> Vec<CompletionCandidate> {
    named(gyration_scene::gallery().iter().map(|(name, _)| *name), begun)
}

/// Names of the gallery and paths that begin so.
pub(super) fn scenes(begun: &OsStr) -> Vec<CompletionCandidate> {
    let mut all = names_of_scenes(begun);
    all.extend(PathCompleter::any().complete(begun));
    all
}

/// Names of ready studies and paths that begin so.
#[cfg(feature = "study")]
pub(super) fn studies(begun: &OsStr) -> Vec<CompletionCandidate> {
    let mut all = named(gyration_study::studies().iter().map(|(name, _)| *name), begun);
    all.extend(PathCompleter::any().complete(begun));
    all
}

/// Those of some names that begin so.
fn named<'a>(names: impl Iterator<Item = &'a str>, begun: &OsStr) -> Vec<CompletionCandidate> {
    let begun = begun.to_string_lossy();
    names.filter(|name| name.starts_with(&*begun)).map(CompletionCandidate::new).collect()
}
