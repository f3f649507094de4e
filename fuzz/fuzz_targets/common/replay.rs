//! The inputs that fuzzing has found worth keeping, for the tests that read them again.
//!
//! They stand in `fuzz/corpus`, a folder for each target; what is asked of a reader stands beside this file.

use std::path::{Path, PathBuf};

/// The inputs of a target and their paths, by name.
fn inputs(target: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(target);
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let path = |entry: std::io::Result<std::fs::DirEntry>| entry.unwrap_or_else(|error| panic!("{error}")).path();
    let mut paths: Vec<PathBuf> = entries.map(path).collect();
    paths.sort();
    assert!(paths.len() >= 10, "{}: only {} inputs", folder.display(), paths.len());
    let read = |path: PathBuf| match std::fs::read(&path) {
        Ok(bytes) => (path, bytes),
        Err(error) => panic!("{}: {error}", path.display()),
    };
    paths.into_iter().map(read).collect()
}

/// Reads every input of a target, and names the one that a panic comes from.
pub fn replay(target: &str, check: impl Fn(&[u8])) {
    for (path, bytes) in inputs(target) {
        println!("{}", path.display());
        check(&bytes);
    }
}

/// Reads every input of a target that takes texts; the fuzzer's own rule: what is no text is no input.
#[allow(dead_code, reason = "some crates have targets of bytes only")]
pub fn replay_texts(target: &str, check: impl Fn(&str)) {
    replay(target, |bytes| {
        if let Ok(text) = std::str::from_utf8(bytes) {
            check(text);
        }
    });
}
