//! The reader of PLY, text and binary.
#![no_main]
#![forbid(unsafe_code)]

use libfuzzer_sys::fuzz_target;

#[path = "common/mesh.rs"]
mod mesh;

fuzz_target!(|bytes: &[u8]| mesh::check("fuzz.ply", bytes));
