//! What a mesh reader owes whatever bytes it gets: a body that is sound, or an error in words.

use gyration_geometry::parse_mesh;
use std::path::Path;

/// Reads the bytes as the file of this name.
pub fn check(name: &str, bytes: &[u8]) {
    match parse_mesh(Path::new(name), bytes, 1.0) {
        Ok(mesh) => {
            assert_eq!(mesh.validate(), Ok(()));
            // Two bytes a value at least, in a text; three indices a triangle, of which a fan shares two.
            assert!(mesh.vertices.len() <= bytes.len() && mesh.triangles.len() <= bytes.len());
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
