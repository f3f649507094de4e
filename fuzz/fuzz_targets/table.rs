//! The readers of CSV tables: tensors and vectors in time, and measurements.
#![no_main]
#![forbid(unsafe_code)]

use libfuzzer_sys::fuzz_target;
use std::path::PathBuf;
use std::sync::LazyLock;

#[path = "common/measurements.rs"]
mod measurements;
#[path = "common/scratch.rs"]
mod scratch;
#[path = "common/table.rs"]
mod table;

static FOLDER: LazyLock<PathBuf> = LazyLock::new(scratch::folder);

fuzz_target!(|bytes: &[u8]| {
    table::check(&FOLDER, bytes);
    measurements::check(&FOLDER, bytes);
});
