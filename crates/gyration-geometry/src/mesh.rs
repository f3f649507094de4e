//! Mesh files: one entry for all formats, welding, and the checks that make a surface a body.
//!
//! A mesh must be closed, oriented and face outward. Where the indices of a file do not close it (STL has none),
//! vertices with equal coordinates become one; nothing else is repaired, because a guess would silently change mass and
//! contact.

use std::collections::HashMap;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use gyration::shape::{Polyhedron, PolyhedronError};
use gyration_files::in_words;

use crate::fault::FileFault;
use crate::{obj, ply, stl};

/// Largest mesh file that is read \[bytes\]: ten million triangles of binary STL.
pub const MAX_MESH_BYTES: u64 = 512 << 20;

/// A mesh file that gives no body.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file cannot be read.
    #[error("cannot read the mesh {}: {}", path.display(), in_words(source))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The file is larger than [`MAX_MESH_BYTES`].
    #[error("the mesh {} has {bytes} bytes, more than the {MAX_MESH_BYTES} that are read: simplify it", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its size.
        bytes: u64,
    },
    /// The ending of the name is not one of the formats.
    #[error("the mesh {} has none of the endings .stl, .obj and .ply", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The scale is zero, negative or not finite.
    #[error("scale of the mesh {} is {value}: it must be finite and > 0", path.display())]
    Scale {
        /// The file.
        path: PathBuf,
        /// The scale.
        value: f64,
    },
    /// The file is not as its format says.
    #[error("mesh {}, {fault}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What is wrong, and where.
        fault: FileFault,
    },
    /// There is no triangle with three different corners.
    #[error("the mesh {} has no triangles with three different corners: export a closed surface", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// The triangles do not bound a volume.
    #[error("mesh {}: {fault}", path.display())]
    NotABody {
        /// The file.
        path: PathBuf,
        /// What is wrong, and where; coordinates are scaled.
        fault: PolyhedronError,
    },
}

/// Reads a closed surface from an STL, OBJ or PLY file; the format goes by the ending of the name.
///
/// `scale` multiplies the coordinates, 1e-3 for a file in millimetres.
///
/// # Errors
/// [`MeshError`]: a file that cannot be read or is not as its format says (with the line or the byte), and triangles
/// that are not closed, not oriented, inward or without a volume (with the first edges concerned).
pub fn read_mesh(path: &Path, scale: f64) -> Result<Polyhedron, MeshError> {
    check_scale(path, scale)?;
    let parse = parser(path)?;
    let bytes = read_bytes(path)?;
    let mesh = parse(&bytes).map_err(|fault| MeshError::Malformed { path: path.to_path_buf(), fault })?;
    drop(bytes);
    body(path, mesh, scale)
}

/// Reads a closed surface from the content of an STL, OBJ or PLY file.
///
/// As [`read_mesh`]; `path` tells the format by its ending and stands in messages, nothing is read from there.
///
/// # Errors
/// [`MeshError`] as [`read_mesh`], `Unreadable` and `TooLarge` apart.
pub fn parse_mesh(path: &Path, bytes: &[u8], scale: f64) -> Result<Polyhedron, MeshError> {
    check_scale(path, scale)?;
    let parse = parser(path)?;
    let mesh = parse(bytes).map_err(|fault| MeshError::Malformed { path: path.to_path_buf(), fault })?;
    body(path, mesh, scale)
}

fn check_scale(path: &Path, scale: f64) -> Result<(), MeshError> {
    if scale > 0.0 && scale.is_finite() {
        return Ok(());
    }
    Err(MeshError::Scale { path: path.to_path_buf(), value: scale })
}

/// What reads the triangles of a format.
type Parser = fn(&[u8]) -> Result<Polyhedron, FileFault>;

/// The parser that the ending of a name asks for.
fn parser(path: &Path) -> Result<Parser, MeshError> {
    let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
    match ending.to_str() {
        Some("stl") => Ok(stl::read),
        Some("obj") => Ok(obj::read),
        Some("ply") => Ok(ply::read),
        _ => Err(MeshError::UnknownFormat { path: path.to_path_buf() }),
    }
}

/// The triangles of a file as a body: scaled, closed, checked.
fn body(path: &Path, mesh: Polyhedron, scale: f64) -> Result<Polyhedron, MeshError> {
    let mesh = without_collapsed(scaled(mesh, scale));
    if mesh.triangles.is_empty() {
        return Err(MeshError::Empty { path: path.to_path_buf() });
    }
    closed(mesh).map_err(|fault| MeshError::NotABody { path: path.to_path_buf(), fault })
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, MeshError> {
    let read = || -> io::Result<(u64, Vec<u8>)> {
        let file = gyration_files::open(path)?;
        let size = file.metadata()?.len();
        let mut bytes = Vec::new();
        if size <= MAX_MESH_BYTES {
            // One byte more than allowed shows a file that grew or has no size of its own.
            file.take(MAX_MESH_BYTES + 1).read_to_end(&mut bytes)?;
        }
        Ok((size.max(bytes.len() as u64), bytes))
    };
    let (size, bytes) = read().map_err(|source| MeshError::Unreadable { path: path.to_path_buf(), source })?;
    if size > MAX_MESH_BYTES {
        return Err(MeshError::TooLarge { path: path.to_path_buf(), bytes: size });
    }
    Ok(bytes)
}

fn scaled(mut mesh: Polyhedron, scale: f64) -> Polyhedron {
    mesh.vertices.iter_mut().for_each(|vertex| *vertex *= scale);
    mesh
}

/// The surface, welded if its indices alone do not close it; checked.
fn closed(mesh: Polyhedron) -> Result<Polyhedron, PolyhedronError> {
    let indexed = without_unused(&mesh);
    match indexed.validate() {
        Ok(()) => Ok(indexed),
        Err(PolyhedronError::Open { .. }) => {
            let welded = without_unused(&without_collapsed(welded(indexed)));
            welded.validate().map(|()| welded)
        }
        Err(fault) => Err(fault),
    }
}

/// Makes vertices with equal coordinates one.
fn welded(mut mesh: Polyhedron) -> Polyhedron {
    let mut first_at: HashMap<[u64; 3], usize> = HashMap::with_capacity(mesh.vertices.len());
    let mut representative = Vec::with_capacity(mesh.vertices.len());
    for (index, vertex) in mesh.vertices.iter().enumerate() {
        // Adding zero makes −0 and 0 equal in bits too.
        let key = [vertex.x, vertex.y, vertex.z].map(|coordinate| (coordinate + 0.0).to_bits());
        representative.push(*first_at.entry(key).or_insert(index));
    }
    for triangle in &mut mesh.triangles {
        *triangle = triangle.map(|index| representative[index]);
    }
    mesh
}

/// Leaves out triangles that name a vertex twice; their neighbours then share an edge.
fn without_collapsed(mut mesh: Polyhedron) -> Polyhedron {
    mesh.triangles.retain(|[a, b, c]| a != b && b != c && c != a);
    mesh
}

/// Leaves out vertices of no triangle.
fn without_unused(mesh: &Polyhedron) -> Polyhedron {
    let mut new_index = vec![None; mesh.vertices.len()];
    let mut vertices = Vec::new();
    let mut renumbered = |old: usize| {
        *new_index[old].get_or_insert_with(|| {
            vertices.push(mesh.vertices[old]);
            vertices.len() - 1
        })
    };
    let triangles = mesh.triangles.iter().map(|triangle| triangle.map(&mut renumbered)).collect();
    Polyhedron { vertices, triangles }
}
