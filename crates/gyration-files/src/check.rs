//! Checksums of files: whether bytes are those that were written.
//!
//! The sum is CRC-32C (Castagnoli), which Zarr's codec `crc32c` appends to a chunk in little-endian order. A file that
//! has no place for it behind its content carries it in itself: eight hexadecimal digits behind a marker, and the sum
//! is that of the whole file with zeros in their place. A sum tells damage, not intent: whoever changes a file can
//! write another one.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

/// Bytes of a sum behind a content.
pub const SUM: usize = 4;
/// What stands in the place of the sum while it is computed.
pub const UNKNOWN: &str = "00000000";
/// Bytes of a long file that are in memory at a time.
const PORTION: usize = 1 << 16;

/// The sum of some bytes.
pub fn sum(bytes: &[u8]) -> u32 {
    crc32c::crc32c(bytes)
}

/// Appends the sum of what is there.
pub fn append_sum(bytes: &mut Vec<u8>) {
    bytes.extend(sum(bytes).to_le_bytes());
}

/// The content before an appended sum; none if the sum is that of another content.
pub fn content(bytes: &[u8]) -> Option<&[u8]> {
    let (content, found) = bytes.split_last_chunk::<SUM>()?;
    (sum(content) == u32::from_le_bytes(*found)).then_some(content)
}

/// Puts the sum of a text in its place: over the eight digits behind the first `marker`, if there is one.
pub fn seal(text: &mut [u8], marker: &str) {
    let Some(at) = place(text, marker) else { return };
    text[at..at + UNKNOWN.len()].copy_from_slice(UNKNOWN.as_bytes());
    let sum = format!("{:08x}", sum(text));
    text[at..at + sum.len()].copy_from_slice(sum.as_bytes());
}

/// Whether the sum behind the first `marker` of a text is its own; none if there is no marker.
pub fn is_sealed(text: &[u8], marker: &str) -> Option<bool> {
    let at = place(text, marker)?;
    let (before, rest) = text.split_at(at);
    let (found, behind) = rest.split_at(UNKNOWN.len());
    let sum = [UNKNOWN.as_bytes(), behind].iter().fold(sum(before), |sum, part| crc32c::crc32c_append(sum, part));
    Some(found == format!("{sum:08x}").as_bytes())
}

fn place(text: &[u8], marker: &str) -> Option<usize> {
    let at = text.windows(marker.len()).position(|window| window == marker.as_bytes())? + marker.len();
    (at + UNKNOWN.len() <= text.len()).then_some(at)
}

/// Puts the sum of a long file in its place, at `at`.
///
/// # Errors
/// Those of the system.
pub fn seal_file(path: &Path, at: u64) -> io::Result<()> {
    let mut file = OpenOptions::new().read(true).write(true).open(path)?;
    let sum = format!("{:08x}", file_sum(&mut file, at)?);
    file.seek(SeekFrom::Start(at))?;
    file.write_all(sum.as_bytes())
}

/// Whether the sum at `at` of a long file is its own. The file is left at its beginning.
///
/// # Errors
/// Those of the system.
pub fn is_sealed_file(file: &mut File, at: u64) -> io::Result<bool> {
    let mut found = [0; UNKNOWN.len()];
    file.seek(SeekFrom::Start(at))?;
    file.read_exact(&mut found)?;
    let sum = file_sum(file, at)?;
    file.seek(SeekFrom::Start(0))?;
    Ok(found == format!("{sum:08x}").as_bytes())
}

/// The sum of a file with zeros in the place at `at`.
fn file_sum(file: &mut File, at: u64) -> io::Result<u32> {
    file.seek(SeekFrom::Start(0))?;
    let mut portion = vec![0; PORTION];
    let mut sum = portion_sum(0, (&*file).take(at), &mut portion)?;
    sum = crc32c::crc32c_append(sum, UNKNOWN.as_bytes());
    file.seek(SeekFrom::Start(at + UNKNOWN.len() as u64))?;
    portion_sum(sum, file, &mut portion)
}

fn portion_sum(mut sum: u32, mut from: impl Read, portion: &mut [u8]) -> io::Result<u32> {
    loop {
        match from.read(portion)? {
            0 => return Ok(sum),
            length => sum = crc32c::crc32c_append(sum, &portion[..length]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_is_that_of_castagnoli() {
        // RFC 3720, B.4: 32 bytes of zeros, of ones, and 0 to 31.
        assert_eq!(sum(&[0; 32]), 0x8a91_36aa);
        assert_eq!(sum(&[0xff; 32]), 0x62a8_ab43);
        assert_eq!(sum(&(0..32).collect::<Vec<u8>>()), 0x46dd_794e);
    }

    #[test]
    fn any_flip_of_a_content_is_told() {
        let mut bytes = b"some numbers".to_vec();
        append_sum(&mut bytes);
        assert_eq!(content(&bytes), Some(&b"some numbers"[..]));
        for bit in 0..8 * bytes.len() {
            bytes[bit / 8] ^= 1 << (bit % 8);
            assert_eq!(content(&bytes), None, "bit {bit}");
            bytes[bit / 8] ^= 1 << (bit % 8);
        }
        assert_eq!(content(b"abc"), None);
    }

    #[test]
    fn any_flip_of_a_sealed_text_or_file_is_told() {
        const MARKER: &str = "\"check\": \"";
        let mut text = b"{\"check\": \"00000000\", \"more\": 7}".to_vec();
        seal(&mut text, MARKER);
        assert_eq!(is_sealed(&text, MARKER), Some(true));
        let path = tempfile::NamedTempFile::new().unwrap().into_temp_path();
        let at = MARKER.len() as u64 + 1;
        std::fs::write(&path, &text).unwrap();
        seal_file(&path, at).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), text, "sealed twice, and both ways, it is the same");
        for bit in 0..8 * text.len() {
            text[bit / 8] ^= 1 << (bit % 8);
            // A marker that is damaged is none; whoever reads the text misses it.
            let told = if (1..=MARKER.len()).contains(&(bit / 8)) { None } else { Some(false) };
            assert_eq!(is_sealed(&text, MARKER), told, "bit {bit}");
            std::fs::write(&path, &text).unwrap();
            assert!(!is_sealed_file(&mut File::open(&path).unwrap(), at).unwrap(), "bit {bit}");
            text[bit / 8] ^= 1 << (bit % 8);
        }
    }
}
