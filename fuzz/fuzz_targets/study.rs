//! The reader of studies: TOML, with the scene that they name.
#![no_main]
#![forbid(unsafe_code)]

use libfuzzer_sys::fuzz_target;

#[path = "common/study.rs"]
mod study;

fuzz_target!(|input: &str| study::check(input));
