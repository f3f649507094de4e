//! The rows of a run in one word, by which two runs are told apart, whoever has made them.

use crate::array::ArrayInfo;
use crate::error::RecordError;
use crate::recording::Recording;
use std::fmt;
use std::ops::Range;

/// FNV-1a of no bytes.
pub(crate) const FNV_START: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0100_0000_01b3;
/// Numbers that are in memory at a time.
const PORTION: usize = 1 << 16;

/// FNV-1a of 64 bits over the rows: of each the time, then the numbers of all arrays that grow with it, in order, as
/// little-endian float64.
///
/// Source: Fowler, Noll, Vo, draft-eastlake-fnv. It tells a difference, not who made it.
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

/// FNV-1a of 64 bits, gone on with some bytes.
pub(crate) fn fnv_1a(hash: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(hash, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(PRIME))
}

impl fmt::Display for RowHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_fnv_1a() {
        assert_eq!(RowHash::default().to_string(), "cbf29ce484222325");
        // The bytes "foobar" have 85944171f73967e8; this is eight bytes, of the number whose bytes are "foobar\0\0".
        let mut hash = RowHash::default();
        hash.add(&[f64::from_le_bytes(*b"foobar\0\0")]);
        let by_hand = (0..2).fold(0x8594_4171_f739_67e8_u64, |hash, _| hash.wrapping_mul(PRIME));
        assert_eq!(hash, RowHash(by_hand));
    }
}
