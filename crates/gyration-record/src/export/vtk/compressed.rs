//! Numbers as VTK keeps them in a file: blocks compressed with zlib, behind a header with their lengths.
//!
//! ```text
//! number of blocks, bytes of a block, bytes of the last if it is shorter, bytes of each when compressed     u64
//! the blocks
//! ```

/// Bytes of a block before compression.
const BLOCK: usize = 1 << 20;
/// The fastest level that matches repeats: numbers that are equal over a body vanish, others shrink little at any
/// level.
const LEVEL: u8 = 1;

/// Numbers ready to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CompressedNumbers {
    kind: NumberKind,
    bytes: Vec<u8>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NumberKind {
    Float64,
    Int32,
}

impl CompressedNumbers {
    /// Of real numbers.
    pub fn floats(numbers: impl IntoIterator<Item = f64>) -> Self {
        let bytes: Vec<u8> = numbers.into_iter().flat_map(f64::to_le_bytes).collect();
        Self { kind: NumberKind::Float64, bytes: compressed(&bytes) }
    }

    /// Of whole numbers.
    pub fn integers(numbers: impl IntoIterator<Item = i32>) -> Self {
        let bytes: Vec<u8> = numbers.into_iter().flat_map(i32::to_le_bytes).collect();
        Self { kind: NumberKind::Int32, bytes: compressed(&bytes) }
    }

    pub(super) fn kind(&self) -> NumberKind {
        self.kind
    }

    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }
}

fn compressed(bytes: &[u8]) -> Vec<u8> {
    let blocks: Vec<Vec<u8>> =
        bytes.chunks(BLOCK).map(|block| miniz_oxide::deflate::compress_to_vec_zlib(block, LEVEL)).collect();
    let header = [blocks.len(), BLOCK, bytes.len() % BLOCK].into_iter().chain(blocks.iter().map(Vec::len));
    let header = header.flat_map(|number| (number as u64).to_le_bytes());
    header.chain(blocks.iter().flatten().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bytes before compression, as a reader would find them.
    fn decompressed(compressed: &CompressedNumbers) -> Vec<u8> {
        let (header, _) = compressed.bytes().as_chunks::<8>();
        let number = |k: usize| u64::from_le_bytes(header[k]) as usize;
        let (blocks, size, last) = (number(0), number(1), number(2));
        let mut at = 8 * (3 + blocks);
        let mut bytes = Vec::new();
        for block in 0..blocks {
            let end = at + number(3 + block);
            let part = miniz_oxide::inflate::decompress_to_vec_zlib(&compressed.bytes()[at..end]).unwrap_or_default();
            assert_eq!(part.len(), if block + 1 == blocks && last > 0 { last } else { size });
            bytes.extend(part);
            at = end;
        }
        assert_eq!(at, compressed.bytes().len());
        bytes
    }

    #[test]
    fn numbers_survive_whatever_the_length_of_the_last_block() {
        for count in [0, 1, 1000, BLOCK / 8, BLOCK / 8 + 1, 3 * BLOCK / 8] {
            let numbers: Vec<f64> = (0..count).map(|k| (k as f64).sqrt()).collect();
            let expected: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
            assert!(decompressed(&CompressedNumbers::floats(numbers)) == expected, "{count}");
        }
        assert_eq!(decompressed(&CompressedNumbers::integers([1, -1])), [1, 0, 0, 0, 255, 255, 255, 255]);
    }
}
