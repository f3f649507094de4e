//! The scene parser: TOML, or JSON if it begins with a brace, and overrides.
#![no_main]
#![forbid(unsafe_code)]

use libfuzzer_sys::fuzz_target;

#[path = "common/scene.rs"]
mod scene;

fuzz_target!(|input: &str| scene::check(input));
