//! An array of a recording as it stands: its name, its dimensions, what its numbers are and how they are stored.

use crate::error::RecordError;
use crate::layout::ArraySpec;
use gyration_files::check;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// How the numbers of an array are stored, by Zarr's names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum DataType {
    Float64,
    Int32,
    String,
}

impl DataType {
    /// Bytes of one element; texts have no fixed size.
    pub(crate) fn size(self) -> usize {
        match self {
            DataType::Float64 => 8,
            DataType::Int32 => 4,
            DataType::String => 0,
        }
    }

    /// The value of an element that was never written.
    pub(crate) fn fill(self) -> Value {
        match self {
            DataType::Float64 => "NaN".into(),
            DataType::Int32 => (-1).into(),
            DataType::String => "".into(),
        }
    }

    /// The bytes of that value.
    pub(crate) fn fill_bytes(self) -> Vec<u8> {
        match self {
            DataType::Float64 => f64::NAN.to_le_bytes().to_vec(),
            DataType::Int32 => (-1_i32).to_le_bytes().to_vec(),
            DataType::String => Vec::new(),
        }
    }
}

/// An array of a recording as it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct ArrayInfo {
    /// Name.
    pub name: String,
    /// Names of the dimensions; of a growing array the first is `time`, `event`, `entry` or `boundary`.
    pub dims: Vec<String>,
    /// Sizes of the dimensions.
    pub shape: Vec<usize>,
    /// Unit; empty for labels and codes.
    pub units: String,
    /// One line that says what it is.
    pub description: String,
    /// Names of the values 0, 1, … of an array of codes.
    pub meanings: Vec<String>,
    pub(crate) chunk: Vec<usize>,
    pub(crate) data_type: DataType,
    /// Whether a checksum stands behind each chunk; recordings of earlier versions have none.
    pub(crate) is_checked: bool,
}

impl ArrayInfo {
    /// Numbers in a row: the product of the sizes but the first.
    pub fn row_len(&self) -> usize {
        self.shape.iter().skip(1).product()
    }

    /// The file of the chunk that stands at `index` along the first dimension.
    pub(crate) fn chunk_key(&self, index: usize) -> String {
        let rest = self.shape.iter().skip(1).map(|_| ".0");
        let first = if self.shape.is_empty() { String::new() } else { format!(".{index}") };
        format!("c{first}{}", rest.collect::<String>())
    }

    /// Where that file is, in the folder of a recording.
    pub(crate) fn chunk_path(&self, folder: &Path, index: usize) -> PathBuf {
        folder.join(&self.name).join(self.chunk_key(index))
    }

    /// Whether the array grows along this dimension.
    pub(crate) fn grows_with(&self, dim: &str) -> bool {
        self.dims.first().is_some_and(|first| first == dim)
    }

    /// The bytes of a chunk as they go to the disk: its elements and, behind them, their checksum.
    pub(crate) fn encode(&self, elements: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(elements.len() + check::SUM);
        bytes.extend(elements);
        if self.is_checked {
            check::append_sum(&mut bytes);
        }
        bytes
    }

    /// The elements of a chunk that was read from `path`.
    ///
    /// # Errors
    /// `Corrupt` if they are not those that were written.
    pub(crate) fn decode(&self, mut bytes: Vec<u8>, path: &Path) -> Result<Vec<u8>, RecordError> {
        if self.is_checked {
            let content = check::content(&bytes).map(<[u8]>::len);
            bytes.truncate(content.ok_or_else(|| RecordError::mismatch(path))?);
        }
        Ok(bytes)
    }

    pub(crate) fn of(spec: &ArraySpec, grows: Option<(&str, usize)>) -> Self {
        let sizes = || spec.dims.iter().map(|dim| dim.size);
        Self {
            name: spec.name.clone(),
            dims: grows
                .iter()
                .map(|(dim, _)| dim.to_string())
                .chain(spec.dims.iter().map(|d| d.name.clone()))
                .collect(),
            shape: grows.iter().map(|_| 0).chain(sizes()).collect(),
            chunk: grows.iter().map(|(_, rows)| *rows).chain(sizes()).collect(),
            units: spec.units.clone(),
            description: spec.description.clone(),
            meanings: Vec::new(),
            data_type: DataType::Float64,
            is_checked: true,
        }
    }

    pub(crate) fn growing(name: &str, dim: &str, rows: usize, units: &str, description: &str) -> Self {
        let [name, units, description] = [name, units, description].map(String::from);
        Self::of(&ArraySpec { name, units, description, ..ArraySpec::default() }, Some((dim, rows)))
    }

    pub(crate) fn labels(dim: &str, count: usize) -> Self {
        let (names, sizes) = (vec![dim.to_string()], vec![count]);
        Self {
            dims: names,
            shape: sizes.clone(),
            chunk: sizes,
            data_type: DataType::String,
            ..Self::of(&ArraySpec { name: dim.to_string(), ..ArraySpec::default() }, None)
        }
    }
}
