//! The rows of a run in one word, by which two runs are told apart, whoever has made them.

use crate::array::ArrayInfo;
use crate::error::RecordError;
use crate::fnv::{FNV_START, fnv_1a};
use crate::recording::Recording;
use std::fmt;
use std::ops::Range;

/// Numbers that are in memory at a time.
const PORTION: usize = 1 << 16;

/// FNV-1a of 64 bits over the rows: of each the time, then the numbers of all arrays that grow with it, in order, as
/// little-endian float64. It tells a difference, not who made it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RowHash(u64);

impl Default for RowHash {
    fn default() -> Self {
        Self(FNV_START)
    }
}

impl RowHash {
    /// Goes on with some numbers of a row.
    pub fn add(&mut self, numbers: &[f64]) {
        self.0 = numbers.iter().fold(self.0, |hash, number| fnv_1a(hash, &number.to_le_bytes()));
    }

    /// Goes on with a row.
    pub fn add_row(&mut self, time: f64, row: &[f64]) {
        self.add(&[time]);
        self.add(row);
    }

    /// Of the first rows of a recording.
    ///
    /// # Errors
    /// Those of reading.
    pub fn of_recording(recording: &Recording, rows: usize) -> Result<Self, RecordError> {
        let names: Vec<&str> = recording.growing().map(|array| &*array.name).collect();
        let width: usize = recording.growing().map(ArrayInfo::row_len).sum();
        let portion = (PORTION / (width + 1)).max(1);
        let mut hash = Self::default();
        for first in (0..rows).step_by(portion) {
            let range: Range<usize> = first..rows.min(first + portion);
            let times = recording.read_rows("time", range.clone())?.data;
            let read = |name: &&str| Ok(recording.read_rows(name, range.clone())?.data);
            let arrays = names.iter().map(read).collect::<Result<Vec<_>, RecordError>>()?;
            for (row, time) in times.iter().enumerate() {
                hash.add(&[*time]);
                for array in &arrays {
                    let stride = array.len() / times.len();
                    hash.add(&array[row * stride..(row + 1) * stride]);
                }
            }
        }
        Ok(hash)
    }
}

impl fmt::Display for RowHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}
