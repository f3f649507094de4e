//! Contacts between bodies, groups, reaches and springs, behind a sound scene, up to the start of the run.
#![no_main]
#![forbid(unsafe_code)]

use libfuzzer_sys::fuzz_target;

#[path = "common/meeting.rs"]
mod meeting;

fuzz_target!(|input: &str| meeting::check(input));
