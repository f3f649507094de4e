//! Checksums of the files that a scene names: whether a scene that is opened again found the same in them.
//!
//! A sum is of the numbers that were read, tables and meshes alike: remarks, names of columns and the layout of a file
//! do not count. Files are found by name, and their content is nowhere else in the resolved form.

use gyration_files::check;
use serde::{Deserialize, Serialize};

/// A file that a scene names, with a checksum of what was found in it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct FileSum {
    /// The dotted key at which the scene names it.
    pub key: String,
    /// Its name there.
    pub file: String,
    /// CRC-32C of its numbers as little-endian f64, eight hexadecimal digits.
    pub sum: String,
}

/// The checksum of the numbers of a file.
pub(crate) fn sum_of(numbers: impl Iterator<Item = f64>) -> String {
    let bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
    format!("{:08x}", check::sum(&bytes))
}
