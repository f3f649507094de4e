//! The binary form of glTF 2.0: a JSON document and a block of numbers, which accessors in the document describe.
//!
//! ```text
//! "glTF", 2, length of the file                      little-endian u32
//! length, "JSON", the document, padded with spaces
//! length, "BIN\0", the numbers, padded with zeros
//! ```
//!
//! Source: Khronos Group, *glTF 2.0 Specification*, 3.6 and 4.4.

use serde_json::{Value, json};
use std::io::{self, Write};

/// Kinds of numbers, by the codes of the format.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
/// What a view of vertices and one of indices is for.
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The numbers so far, and the accessors to them.
#[derive(Debug, Default)]
pub(super) struct Numbers {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Numbers {
    /// Vectors at the vertices of a mesh; returns their accessor.
    pub fn vertices(&mut self, vectors: &[[f32; 3]]) -> usize {
        self.floats(vectors, Some(ARRAY_BUFFER))
    }

    /// Numbers or vectors at the keys of an animation; returns their accessor.
    pub fn keys<const N: usize>(&mut self, vectors: &[[f32; N]]) -> usize {
        self.floats(vectors, None)
    }

    /// Indices of vertices; returns their accessor.
    pub fn indices(&mut self, indices: &[u32]) -> usize {
        let view = self.view(indices.iter().flat_map(|index| index.to_le_bytes()), Some(ELEMENT_ARRAY_BUFFER));
        self.accessor(json!({
            "bufferView": view, "componentType": UNSIGNED_INT, "count": indices.len(), "type": "SCALAR",
        }))
    }

    fn floats<const N: usize>(&mut self, vectors: &[[f32; N]], target: Option<u32>) -> usize {
        let view = self.view(vectors.iter().flatten().flat_map(|number| number.to_le_bytes()), target);
        let extreme = |choose: fn(f32, f32) -> f32, start: f32| -> Vec<f32> {
            // Which zero is the least is the processor's to say; adding zero turns −0 into 0.
            (0..N).map(|k| vectors.iter().map(|vector| vector[k]).fold(start, choose) + 0.0).collect()
        };
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        self.accessor(json!({
            "bufferView": view,
            "componentType": FLOAT,
            "count": vectors.len(),
            "type": kind,
            "min": extreme(f32::min, f32::INFINITY),
            "max": extreme(f32::max, f32::NEG_INFINITY),
        }))
    }

    fn view(&mut self, bytes: impl Iterator<Item = u8>, target: Option<u32>) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.views.push(view);
        self.views.len() - 1
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Writes the file: the document, with what it says of the numbers added, and the numbers.
    ///
    /// # Errors
    /// Those of writing; `FileTooLarge` beyond 4 GiB.
    pub fn write(self, mut document: Value, out: &mut impl Write) -> io::Result<()> {
        document["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        document["bufferViews"] = self.views.into();
        document["accessors"] = self.accessors.into();
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let length = |bytes: usize| match u32::try_from(bytes) {
            Ok(length) => Ok(length.to_le_bytes()),
            Err(_) => Err(io::Error::from(io::ErrorKind::FileTooLarge)),
        };
        // The numbers are of four bytes each.
        let chunks = [(b"JSON", &text), (b"BIN\0", &self.bytes)];
        let total = 12 + chunks.iter().map(|(_, chunk)| 8 + chunk.len()).sum::<usize>();
        out.write_all(b"glTF")?;
        out.write_all(&2_u32.to_le_bytes())?;
        out.write_all(&length(total)?)?;
        for (kind, chunk) in chunks {
            out.write_all(&length(chunk.len())?)?;
            out.write_all(kind)?;
            out.write_all(chunk)?;
        }
        Ok(())
    }
}
