//! FNV-1a of 64 bits: a word for some bytes, that tells damage and difference, not intent.
//!
//! Source: Fowler, Noll, Vo, draft-eastlake-fnv.

/// The word of no bytes.
pub(crate) const FNV_START: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0100_0000_01b3;

/// The word after some more bytes.
pub(crate) fn fnv_1a(hash: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(hash, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(PRIME))
}

/// The word of these bytes.
pub fn word_of(bytes: &[u8]) -> u64 {
    fnv_1a(FNV_START, bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_those_of_the_source() {
        assert_eq!(fnv_1a(FNV_START, b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv_1a(FNV_START, b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv_1a(fnv_1a(FNV_START, b"foo"), b"bar"), 0x8594_4171_f739_67e8);
    }
}
