//! PLY, text and binary of both byte orders.
//!
//! Of the elements only `vertex` (x, y, z) and `face` (vertex_indices or vertex_index) matter; the others are skipped.
//! A number of elements is believed only if the file is long enough for it.

use gyration::shape::Polyhedron;
use gyration::tensor::Vec3;

use crate::fault::{FileFault, FilePlace, Trouble, finite};
use crate::ply_header::{Element, Encoding, PlyHeader, Scalar, read_header};
use crate::polygon::add_polygon;

/// Reads a PLY file.
pub(crate) fn read(bytes: &[u8]) -> Result<Polyhedron, FileFault> {
    let header = read_header(bytes)?;
    let mut values = PlyValues::after(&header, bytes);
    let mut mesh = Polyhedron::default();
    for element in &header.elements {
        check_count(element, header.encoding, values.rest())?;
        match element.name.as_str() {
            "vertex" => read_vertices(element, &mut values, &mut mesh)?,
            "face" => read_faces(element, &mut values, &mut mesh)?,
            _ => (0..element.count).try_for_each(|_| values.skip(element))?,
        }
    }
    Ok(mesh)
}

/// Refuses an element that cannot be in the file, before anything is allocated or read for it.
fn check_count(element: &Element, encoding: Encoding, rest: usize) -> Result<(), FileFault> {
    let place = FilePlace::Line(element.line);
    if element.properties.is_empty() {
        return Err(Trouble::unexpected("properties of the element", &element.name).at(place));
    }
    // The last value of a text needs no separator.
    let bytes = rest + usize::from(encoding == Encoding::Text);
    if element.count > (bytes / element.min_bytes(encoding)) as u64 {
        let what = format!("elements `{}`", element.name);
        return Err(Trouble::Announced { announced: element.count, what, bytes: rest }.at(place));
    }
    Ok(())
}

fn read_vertices(element: &Element, values: &mut PlyValues<'_>, mesh: &mut Polyhedron) -> Result<(), FileFault> {
    let scalar = |name: &str| element.properties.iter().position(|p| p.name == name && p.count.is_none());
    let [Some(x), Some(y), Some(z)] = ["x", "y", "z"].map(scalar) else {
        return Err(Trouble::unexpected("the properties x, y and z", &element.name).at(FilePlace::Line(element.line)));
    };
    let mut record = vec![0.0; element.properties.len()];
    for _ in 0..element.count {
        for (index, property) in element.properties.iter().enumerate() {
            match property.count {
                Some(count) => values.skip_list(count, property.value)?,
                None => record[index] = values.next(property.value)?,
            }
            if [x, y, z].contains(&index) {
                finite(record[index], values.last)?;
            }
        }
        mesh.vertices.push(Vec3::new(record[x], record[y], record[z]));
    }
    Ok(())
}

fn read_faces(element: &Element, values: &mut PlyValues<'_>, mesh: &mut Polyhedron) -> Result<(), FileFault> {
    let is_corners = |name: &str| matches!(name, "vertex_indices" | "vertex_index");
    if !element.properties.iter().any(|property| property.count.is_some() && is_corners(&property.name)) {
        return Err(Trouble::unexpected("a list vertex_indices", &element.name).at(FilePlace::Line(element.line)));
    }
    let mut corners = Vec::new();
    for _ in 0..element.count {
        for property in &element.properties {
            match property.count {
                Some(count) if is_corners(&property.name) => {
                    read_corners(values, [count, property.value], mesh.vertices.len(), &mut corners)?;
                    add_polygon(&corners, &mesh.vertices, &mut mesh.triangles, values.last)?;
                }
                Some(count) => values.skip_list(count, property.value)?,
                None => values.next(property.value).map(drop)?,
            }
        }
    }
    Ok(())
}

fn read_corners(
    values: &mut PlyValues<'_>,
    [count, kind]: [Scalar; 2],
    vertices: usize,
    corners: &mut Vec<usize>,
) -> Result<(), FileFault> {
    corners.clear();
    for _ in 0..values.length(count)? {
        let index = values.next(kind)?;
        if !(index >= 0.0 && index < vertices as f64 && index.fract() == 0.0) {
            return Err(Trouble::NoSuchVertex { index, count: vertices }.at(values.last));
        }
        corners.push(index as usize);
    }
    Ok(())
}

/// The values behind the header, one after the other.
struct PlyValues<'a> {
    encoding: Encoding,
    bytes: &'a [u8],
    offset: usize,
    line: usize,
    /// Where the value read last stands.
    last: FilePlace,
}

impl<'a> PlyValues<'a> {
    fn after(header: &PlyHeader, bytes: &'a [u8]) -> Self {
        let (offset, line) = (header.bytes, header.lines + 1);
        Self { encoding: header.encoding, bytes, offset, line, last: FilePlace::Line(line) }
    }

    fn rest(&self) -> usize {
        self.bytes.len() - self.offset
    }

    fn next(&mut self, kind: Scalar) -> Result<f64, FileFault> {
        match self.encoding {
            Encoding::Text => self.next_of_text(),
            Encoding::LittleEndian => self.next_of_bytes(kind, false),
            Encoding::BigEndian => self.next_of_bytes(kind, true),
        }
    }

    fn next_of_bytes(&mut self, kind: Scalar, is_big_endian: bool) -> Result<f64, FileFault> {
        self.last = FilePlace::Byte(self.offset);
        let size = kind.size();
        let Some(raw) = self.bytes.get(self.offset..self.offset + size) else {
            return Err(Trouble::Truncated { expected: "a value" }.at(self.last));
        };
        self.offset += size;
        let mut wide = [0; 8];
        wide[..size].copy_from_slice(raw);
        if is_big_endian {
            wide[..size].reverse();
        }
        Ok(decoded(u64::from_le_bytes(wide), kind))
    }

    fn next_of_text(&mut self) -> Result<f64, FileFault> {
        let is_space = |byte: &u8| byte.is_ascii_whitespace();
        let rest = &self.bytes[self.offset..];
        let start = rest.iter().position(|byte| !is_space(byte)).unwrap_or(rest.len());
        let length = rest[start..].iter().position(is_space).unwrap_or(rest.len() - start);
        self.line += rest[..start].iter().filter(|&&byte| byte == b'\n').count();
        self.offset += start + length;
        self.last = FilePlace::Line(self.line);
        let word = String::from_utf8_lossy(&rest[start..start + length]);
        if word.is_empty() {
            return Err(Trouble::Truncated { expected: "a value" }.at(self.last));
        }
        word.parse().map_err(|_| Trouble::unexpected("a number", &word).at(self.last))
    }

    /// The number of values in a list.
    fn length(&mut self, kind: Scalar) -> Result<u64, FileFault> {
        let length = self.next(kind)?;
        if length >= 0.0 && length.fract() == 0.0 {
            return Ok(length as u64);
        }
        Err(Trouble::unexpected("the length of a list", &length.to_string()).at(self.last))
    }

    fn skip_list(&mut self, count: Scalar, value: Scalar) -> Result<(), FileFault> {
        (0..self.length(count)?).try_for_each(|_| self.next(value).map(drop))
    }

    fn skip(&mut self, element: &Element) -> Result<(), FileFault> {
        element.properties.iter().try_for_each(|property| match property.count {
            Some(count) => self.skip_list(count, property.value),
            None => self.next(property.value).map(drop),
        })
    }
}

/// The number that the low bytes of `bits` stand for.
fn decoded(bits: u64, kind: Scalar) -> f64 {
    match kind {
        Scalar::I8 => f64::from(bits as u8 as i8),
        Scalar::U8 => f64::from(bits as u8),
        Scalar::I16 => f64::from(bits as u16 as i16),
        Scalar::U16 => f64::from(bits as u16),
        Scalar::I32 => f64::from(bits as u32 as i32),
        Scalar::U32 => f64::from(bits as u32),
        Scalar::F32 => f64::from(f32::from_bits(bits as u32)),
        Scalar::F64 => f64::from_bits(bits),
    }
}
