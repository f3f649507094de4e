//! Overrides of a scene, as of `--set`.
#![no_main]
#![forbid(unsafe_code)]

use libfuzzer_sys::fuzz_target;

#[path = "common/set.rs"]
mod set;

fuzz_target!(|input: &str| set::check(input));
