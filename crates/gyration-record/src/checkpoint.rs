//! The checkpoint file: the caller's bytes and how much of the recording they belong to.
//!
//!   "GYRCKPT1" · rows · events · length · bytes · check,   numbers in little-endian u64
//!
//! check is the 64-bit FNV-1a hash of all before it (offset 14695981039346656037, prime 1099511628211). The file is
//! replaced as a whole; the hash tells damage of the disk, not of a crash.

use crate::error::RecordError;
use crate::fnv::{FNV_START, fnv_1a};
use std::path::Path;

const MAGIC: &[u8; 8] = b"GYRCKPT1";
const HEADER: usize = 32;

/// What a resumed run starts from.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Checkpoint {
    pub(crate) rows: usize,
    pub(crate) events: usize,
    pub(crate) state: Vec<u8>,
}

impl Checkpoint {
    /// The file's bytes.
    pub(crate) fn encode(rows: usize, events: usize, state: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(HEADER + state.len() + 8);
        bytes.extend(MAGIC);
        for number in [rows, events, state.len()] {
            bytes.extend((number as u64).to_le_bytes());
        }
        bytes.extend(state);
        bytes.extend(hash(&bytes).to_le_bytes());
        bytes
    }

    /// Reads the file's bytes; `path` is for the errors.
    pub(crate) fn decode(bytes: &[u8], path: &Path) -> Result<Self, RecordError> {
        let Some((body, check)) = bytes.split_last_chunk::<8>().filter(|(body, _)| body.len() >= HEADER) else {
            return Err(RecordError::corrupt(path, "the checkpoint is too short"));
        };
        if !body.starts_with(MAGIC) || hash(body) != u64::from_le_bytes(*check) {
            return Err(RecordError::corrupt(path, "the checkpoint does not match its check sum"));
        }
        let number = |at: usize| {
            let bytes = body[at..].first_chunk::<8>().copied().unwrap_or_default();
            usize::try_from(u64::from_le_bytes(bytes)).unwrap_or(usize::MAX)
        };
        if number(24) != body.len() - HEADER {
            return Err(RecordError::corrupt(path, "the checkpoint contradicts its length"));
        }
        Ok(Self { rows: number(8), events: number(16), state: body[HEADER..].to_vec() })
    }
}

fn hash(bytes: &[u8]) -> u64 {
    fnv_1a(FNV_START, bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_damaged_byte_is_told() {
        let bytes = Checkpoint::encode(7, 3, b"state");
        let path = Path::new("checkpoint");
        let read = Checkpoint::decode(&bytes, path).unwrap();
        assert_eq!(read, Checkpoint { rows: 7, events: 3, state: b"state".to_vec() });
        for at in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[at] ^= 0x10;
            assert!(Checkpoint::decode(&damaged, path).is_err(), "byte {at}");
            assert!(Checkpoint::decode(&bytes[..at], path).is_err(), "cut at {at}");
        }
    }
}
