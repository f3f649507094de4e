//! Meshes that a file names: where they are, and whether they are closed surfaces that a body can have.

use crate::report::{Report, named};
use crate::robot::PartShape;
use gyration::shape::Shape;
use gyration_geometry::read_mesh;
use roxmltree::Node;
use std::path::{Path, PathBuf};

/// A mesh file as it is named, relative to a folder, with metres per unit along each axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NamedMesh<'a> {
    pub file: &'a str,
    pub folder: &'a Path,
    pub scale: [f64; 3],
}

impl NamedMesh<'_> {
    /// The surface; lists it with the reason where a scene cannot have it.
    pub fn part(&self, node: Node<'_, '_>, report: &mut Report) -> Option<PartShape> {
        let what = format!("{}: mesh \"{}\"", named(node), self.file);
        let [x, y, z] = self.scale;
        if x != y || y != z || x <= 0.0 {
            let why = format!("its scale is {x:?}, {y:?}, {z:?}, and a scene scales by one number > 0");
            report.leave_out(node, what, why);
            return None;
        }
        let Some(path) = found(self.file, self.folder) else {
            report.leave_out(node, what, "there is no such file in the package, as seen from the folder of the file");
            return None;
        };
        match read_mesh(&path, x) {
            Ok(surface) if Shape::Polyhedron(surface.clone()).validate().is_ok() => {
                Some(PartShape::Mesh(path, x, surface))
            }
            Ok(_) => {
                report.leave_out(node, what, "it bounds no volume");
                None
            }
            Err(why) => {
                report.leave_out(node, what, why.to_string());
                None
            }
        }
    }
}

/// Where a file is: of a package beside or around the folder, else relative to the folder.
fn found(file: &str, folder: &Path) -> Option<PathBuf> {
    if let Some(path) = file.strip_prefix("file://") {
        return Some(PathBuf::from(path));
    }
    let Some(within) = file.strip_prefix("package://").or_else(|| file.strip_prefix("model://")) else {
        return Some(folder.join(file));
    };
    let (package, rest) = within.split_once('/')?;
    // A relative path has no folders around it.
    let folder = std::path::absolute(folder).ok()?;
    let candidates = folder.ancestors().flat_map(|outer| {
        let is_package = outer.file_name().is_some_and(|name| name == package);
        [is_package.then(|| outer.join(rest)), Some(outer.join(package).join(rest))]
    });
    candidates.flatten().find(|path| path.is_file())
}
