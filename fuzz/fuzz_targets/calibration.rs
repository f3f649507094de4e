//! The reader of files of measurements.
#![no_main]
#![forbid(unsafe_code)]

use libfuzzer_sys::fuzz_target;

#[path = "common/calibration.rs"]
mod calibration;

fuzz_target!(|input: &str| calibration::check(input));
