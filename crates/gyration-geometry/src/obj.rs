//! Wavefront OBJ: the lines `v x y z` and `f i j k …`; all others are ignored.
//!
//! A line that ends in a backslash goes on in the next. An index counts from 1, or from the end if negative; what
//! follows a slash (texture, normal) is ignored. Groups and objects of a file form one surface.

use gyration::shape::Polyhedron;
use gyration::tensor::Vec3;
use std::borrow::Cow;

use crate::fault::{FileFault, FilePlace, Trouble, coordinate};
use crate::polygon::add_polygon;

/// Reads an OBJ file.
pub(crate) fn read(bytes: &[u8]) -> Result<Polyhedron, FileFault> {
    let mut mesh = Polyhedron::default();
    let mut corners = Vec::new();
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    while let Some((index, line)) = lines.next() {
        let place = FilePlace::Line(index + 1);
        let mut line = Cow::Borrowed(line);
        // Of those that are read one that ends in a backslash goes on in the next.
        let is_read = matches!(line.split_whitespace().next(), Some("v" | "f"));
        while is_read && let Some(begun) = line.trim_end().strip_suffix('\\') {
            let rest = lines.next().map_or("", |(_, rest)| rest);
            line = Cow::Owned(format!("{begun} {rest}"));
        }
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let mut value = || coordinate(words.next(), place);
                mesh.vertices.push(Vec3::new(value()?, value()?, value()?));
            }
            Some("f") => {
                corners.clear();
                for word in words.take_while(|word| !word.starts_with('#')) {
                    corners.push(vertex_index(word, mesh.vertices.len(), place)?);
                }
                add_polygon(&corners, &mesh.vertices, &mut mesh.triangles, place)?;
            }
            _ => {}
        }
    }
    Ok(mesh)
}

/// The vertex, from 0, that a corner such as `3`, `-1` or `3/1/2` stands for.
fn vertex_index(word: &str, count: usize, place: FilePlace) -> Result<usize, FileFault> {
    let number = word.split('/').next().unwrap_or(word);
    let index: i64 = number.parse().map_err(|_| Trouble::unexpected("a vertex number", word).at(place))?;
    let from_zero = if index > 0 { index - 1 } else { index.saturating_add(count as i64) };
    match usize::try_from(from_zero) {
        Ok(vertex) if index != 0 && vertex < count => Ok(vertex),
        _ => Err(Trouble::NoSuchVertex { index: index as f64, count }.at(place)),
    }
}
