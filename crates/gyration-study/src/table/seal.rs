//! The checksum of a Parquet file: CRC-32C of the whole file, in its metadata, with zeros in its own place.

use gyration_files::check;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;

/// The key of the checksum among the metadata of a file.
pub(super) const KEY: &str = "gyration.checksum";
/// Bytes that end a file: the length of its metadata, and the word of the format.
const END: usize = 8;

/// Puts the checksum into a file that was written with zeros for it.
pub(super) fn close(path: &Path) -> io::Result<()> {
    place(&mut File::open(path)?)?.map_or(Ok(()), |at| check::seal_file(path, at))
}

/// Whether a file is what was written. Files of earlier versions have no checksum and pass.
pub(super) fn is_whole(file: &mut File) -> io::Result<bool> {
    place(file)?.map_or(Ok(true), |at| check::is_sealed_file(file, at))
}

/// Where the checksum of a file stands in it; none if it has none.
fn place(file: &mut File) -> io::Result<Option<u64>> {
    let length = file.metadata()?.len();
    let Some(before_end) = length.checked_sub(END as u64) else { return Ok(None) };
    let mut end = [0; END];
    file.seek(SeekFrom::Start(before_end))?;
    file.read_exact(&mut end)?;
    let [a, b, c, d, ..] = end;
    let metadata = u64::from(u32::from_le_bytes([a, b, c, d])).min(before_end);
    let mut bytes = Vec::new();
    file.seek(SeekFrom::Start(before_end - metadata))?;
    file.take(metadata).read_to_end(&mut bytes)?;
    // In Thrift's compact protocol: the key, the head of the next field of bytes, its length, eight digits.
    let marker = [KEY.as_bytes(), &[0x18, check::UNKNOWN.len() as u8]].concat();
    let found = bytes.windows(marker.len()).rposition(|window| window == marker);
    let at = found.map(|at| before_end - metadata + (at + marker.len()) as u64);
    Ok(at.filter(|at| at + check::UNKNOWN.len() as u64 <= length))
}
