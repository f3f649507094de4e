//! Bodies that meet: from the scene over the survey to the first steps of the run.
#![no_main]
#![forbid(unsafe_code)]

use libfuzzer_sys::fuzz_target;

#[path = "common/pairs.rs"]
mod pairs;

fuzz_target!(|bytes: &[u8]| pairs::check(bytes));
