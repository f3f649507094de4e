//! NPZ: a zip of `.npy` files that `numpy.load` opens, an array each, and the attributes as JSON text in `attributes`.
//!
//! Stored without compression and without dates, so that equal recordings give equal files. Sizes are 64-bit where an
//! array needs it. Source: `numpy.lib.format`, version 1.0.

use crate::array::{ArrayInfo, DataType};
use crate::error::RecordError;
use crate::recording::Recording;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;
use zip::result::ZipError;
use zip::write::{SimpleFileOptions, ZipWriter};

/// Bytes of an entry from which on the zip needs 64-bit sizes; well below the limit of 4 GiB.
const LARGE: usize = 1 << 31;

/// Writes the recording to an NPZ file, replacing it.
///
/// # Errors
/// Those of reading; `Io` with the file's path.
pub fn npz(recording: &Recording, path: &Path) -> Result<(), RecordError> {
    let file = File::create(path).map_err(RecordError::io("create", path))?;
    let mut zip = ZipWriter::new(BufWriter::new(file));
    for array in recording.arrays() {
        if array.data_type == DataType::String {
            let labels = recording.labels(&array.name)?.unwrap_or_default();
            put_texts(&mut zip, path, &array.name, &array.shape, &labels)?;
        } else {
            put_numbers(&mut zip, path, array, recording)?;
        }
    }
    let attributes = serde_json::Value::Object(recording.attributes().clone()).to_string();
    put_texts(&mut zip, path, "attributes", &[], &[attributes])?;
    let mut file = zip.finish().map_err(failed(path))?;
    file.flush().map_err(RecordError::io("write", path))
}

type Zip = ZipWriter<BufWriter<File>>;

fn put_numbers(zip: &mut Zip, path: &Path, array: &ArrayInfo, recording: &Recording) -> Result<(), RecordError> {
    let kind = if array.data_type == DataType::Int32 { "<i4" } else { "<f8" };
    let size = array.shape.iter().product::<usize>() * array.data_type.size();
    start(zip, path, &array.name, kind, &array.shape, size)?;
    let (rows, step) = match (array.shape.first(), array.chunk.first()) {
        (Some(rows), Some(step)) => (*rows, *step),
        _ => (1, 1),
    };
    for from in (0..rows).step_by(step) {
        let bytes = recording.read_bytes(array, from..rows.min(from + step))?;
        zip.write_all(&bytes).map_err(RecordError::io("write", path))?;
    }
    Ok(())
}

/// Texts as NumPy keeps them: UTF-32, all as long as the longest.
fn put_texts(zip: &mut Zip, path: &Path, name: &str, shape: &[usize], texts: &[String]) -> Result<(), RecordError> {
    let width = texts.iter().map(|text| text.chars().count()).max().unwrap_or(0).max(1);
    start(zip, path, name, &format!("<U{width}"), shape, 4 * width * texts.len())?;
    let padded = texts.iter().flat_map(|text| text.chars().chain(std::iter::repeat('\0')).take(width));
    let bytes = padded.flat_map(|c| u32::from(c).to_le_bytes()).collect::<Vec<_>>();
    zip.write_all(&bytes).map_err(RecordError::io("write", path))
}

/// Begins an entry and writes its `.npy` header, padded so that the numbers begin at a multiple of 64.
fn start(zip: &mut Zip, path: &Path, name: &str, kind: &str, shape: &[usize], size: usize) -> Result<(), RecordError> {
    let options = SimpleFileOptions::default()
        .compression_method(zip::CompressionMethod::Stored)
        .last_modified_time(zip::DateTime::default())
        .large_file(size >= LARGE);
    zip.start_file(format!("{name}.npy"), options).map_err(failed(path))?;
    let sizes = shape.iter().map(|size| format!("{size},")).collect::<String>();
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({sizes}), }}");
    const PREFIX: usize = 10;
    let padding = 64 - (PREFIX + header.len() + 1) % 64;
    let length = header.len() + padding + 1;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    // A shape of thousands of dimensions alone would not fit.
    bytes.extend(u16::try_from(length).unwrap_or(u16::MAX).to_le_bytes());
    bytes.extend(header.bytes().chain(std::iter::repeat_n(b' ', padding)).chain([b'\n']));
    zip.write_all(&bytes).map_err(RecordError::io("write", path))
}

fn failed(path: &Path) -> impl FnOnce(ZipError) -> RecordError {
    let path = path.to_path_buf();
    move |error| RecordError::io("write", &path)(io::Error::from(error))
}
