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

/// Reads inputs of a target with bytes changed, put in, taken out, and parts of other inputs put in their place: what
/// an ordinary compiler can do of the fuzzer's work, without looking at what is covered. `GYRATION_MUTATIONS` says how
/// many.
#[allow(dead_code, reason = "some crates replay only")]
pub fn mutate(target: &str, check: impl Fn(&[u8])) {
    let count = std::env::var("GYRATION_MUTATIONS").map_or(2000, |number| number.parse().unwrap_or(0));
    let inputs: Vec<Vec<u8>> = inputs(target).into_iter().map(|(_, bytes)| bytes).collect();
    let mut state = 1_u64;
    let mut below = |count: usize| {
        // Multiplication by a constant of Knuth's, the upper bits.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % count.max(1)
    };
    let last = std::env::temp_dir().join(format!("gyration-{target}-{}", std::process::id()));
    for _ in 0..count {
        let mut bytes = inputs[below(inputs.len())].clone();
        for _ in 0..1 + below(6) {
            let place = below(bytes.len() + 1);
            match below(5) {
                0 if place < bytes.len() => bytes[place] ^= 1 << below(8),
                1 if place < bytes.len() => bytes[place] = [0, 1, 0x7f, 0x80, 0xff][below(5)],
                2 => bytes.insert(place, below(256) as u8),
                3 => drop(bytes.drain(place..(place + below(16)).min(bytes.len()))),
                _ => {
                    let other = &inputs[below(inputs.len())];
                    let from = below(other.len() + 1);
                    let until = (from + below(64)).min(other.len());
                    bytes.splice(place..place, other[from..until].iter().copied());
                }
            }
        }
        // What a panic or a run without end leaves to look at.
        std::fs::write(&last, &bytes).unwrap_or_else(|error| panic!("{}: {error}", last.display()));
        check(&bytes);
    }
    let _ = std::fs::remove_file(&last);
}
