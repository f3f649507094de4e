//! Whether the wheel and the tests share what is compiled.
//!
//! A dependency that has fewer features without the tests is compiled once more for the wheel, and with it all that
//! stands on it.

use crate::cargo::cargo;
use std::collections::BTreeSet;

/// The dependencies with their features, as cargo resolves them.
fn resolved(arguments: &[&str]) -> BTreeSet<String> {
    let format = ["tree", "--locked", "--offline", "--prefix", "none", "--format", "{p} {f}"];
    let output = cargo().args(format).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    // What was listed before is marked.
    text.lines().map(|line| line.trim_end_matches("(*)").trim_end().to_owned()).collect()
}

#[test]
fn the_wheel_has_no_dependency_with_other_features_than_the_tests() {
    let wheel = resolved(&["--package", "gyration-py", "--edges", "normal,build"]);
    let tests = resolved(&["--workspace"]);
    assert!(wheel.len() > 20, "{wheel:?}");
    let apart: Vec<&String> = wheel.difference(&tests).collect();
    assert!(apart.is_empty(), "crates/gyration-py/Cargo.toml could ask for the features of the tests: {apart:?}");
}
