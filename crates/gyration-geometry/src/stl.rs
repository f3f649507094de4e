//! STL, text and binary: triangles with their corners spelled out.
//!
//! Binary: 80 bytes of any content, a little-endian u32 count, then 50 bytes a triangle (normal, three corners as f32,
//! two bytes). A file of exactly that length is binary even if it starts with "solid", as some do. Normals are ignored:
//! the order of the corners says which side is out.

use gyration::shape::Polyhedron;
use gyration::tensor::Vec3;

use crate::fault::{FileFault, FilePlace, Trouble, coordinate, finite};

/// Bytes before the first triangle.
const HEADER: usize = 84;
/// Bytes of a triangle.
const TRIANGLE: usize = 50;

/// Reads an STL file; every triangle has its own three vertices.
pub(crate) fn read(bytes: &[u8]) -> Result<Polyhedron, FileFault> {
    let announced = bytes.get(80..HEADER).map(|word| u32_at(word, 0));
    let is_exactly_binary = announced.is_some_and(|count| bytes.len() == HEADER + TRIANGLE * count as usize);
    let looks_like_text = bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    if looks_like_text && !is_exactly_binary && !bytes.contains(&0) {
        return read_text(&String::from_utf8_lossy(bytes));
    }
    match announced {
        Some(count) => read_binary(&bytes[HEADER..], count),
        None => Err(Trouble::Truncated { expected: "the header of 84 bytes" }.at(FilePlace::Byte(bytes.len()))),
    }
}

fn read_binary(body: &[u8], count: u32) -> Result<Polyhedron, FileFault> {
    if body.len() / TRIANGLE < count as usize {
        let trouble = Trouble::Announced { announced: count.into(), what: "triangles".into(), bytes: body.len() };
        return Err(trouble.at(FilePlace::Byte(80)));
    }
    let mut corners = Vec::with_capacity(3 * count as usize);
    for (index, record) in body.chunks_exact(TRIANGLE).take(count as usize).enumerate() {
        for corner in 0..3 {
            let offset = 12 + 12 * corner;
            let place = FilePlace::Byte(HEADER + index * TRIANGLE + offset);
            let value = |axis: usize| finite(f32::from_bits(u32_at(record, offset + 4 * axis)).into(), place);
            corners.push(Vec3::new(value(0)?, value(1)?, value(2)?));
        }
    }
    Ok(triangles_of(corners))
}

fn u32_at(bytes: &[u8], offset: usize) -> u32 {
    u32::from_le_bytes([bytes[offset], bytes[offset + 1], bytes[offset + 2], bytes[offset + 3]])
}

fn read_text(text: &str) -> Result<Polyhedron, FileFault> {
    let mut corners = Vec::new();
    let mut is_inside_solid = false;
    let mut last_line = 0;
    for (index, line) in text.lines().enumerate() {
        let place = FilePlace::Line(index + 1);
        let mut words = line.split_whitespace();
        match words.next().map(str::to_ascii_lowercase).as_deref() {
            None | Some("facet" | "outer" | "endfacet") => {}
            Some("solid") => is_inside_solid = true,
            Some("endsolid") => is_inside_solid = false,
            Some("vertex") => {
                let mut value = || coordinate(words.next(), place);
                corners.push(Vec3::new(value()?, value()?, value()?));
            }
            Some("endloop") if corners.len() % 3 == 0 => {}
            Some("endloop") => return Err(Trouble::unexpected("three vertices in a loop", line.trim()).at(place)),
            Some(_) => return Err(Trouble::unexpected("a line of an STL file", line.trim()).at(place)),
        }
        last_line = index + 1;
    }
    if is_inside_solid {
        return Err(Trouble::Truncated { expected: "`endsolid`" }.at(FilePlace::Line(last_line)));
    }
    Ok(triangles_of(corners))
}

fn triangles_of(corners: Vec<Vec3>) -> Polyhedron {
    let triangles = (0..corners.len() / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    Polyhedron { vertices: corners, triangles }
}
