//! Shapes, with the files of meshes read and hulls made; what is wrong is noted at its key.

use super::orientation::orientation;
use crate::check::Reporter;
use crate::file;
use crate::file_sum::sum_of;
use crate::key::Key;
use crate::quantity::si;
use gyration::shape::{
    Capsule, Cone, Cuboid, Cylinder, Ellipsoid, MassPoint, Points, Polyhedron, Shape, ShapeError, Sphere, Torus, Union,
    UnionPart,
};
use gyration::tensor::Vec3;
use gyration_files::Files;
use gyration_geometry::{MeshError, hull, parse_mesh, read_mesh};

/// Where shapes come from and where complaints go.
pub(super) struct ShapeBuilder<'a, 'b> {
    /// The files that the scene names.
    pub(super) files: &'a Files,
    pub(super) reporter: &'a mut Reporter<'b>,
}

impl ShapeBuilder<'_, '_> {
    /// The shape at a key. Parts of unions without a density get that of the body, if there is one.
    pub(super) fn shape(&mut self, shape: &file::Shape, key: &Key, density: Option<f64>) -> Option<Shape> {
        let made = match shape {
            file::Shape::Box(it) => Shape::Box(Cuboid { size: it.size.map(|edge| edge.value()).into() }),
            file::Shape::Sphere(it) => Shape::Sphere(Sphere { radius: it.radius.value() }),
            file::Shape::Ellipsoid(it) => {
                Shape::Ellipsoid(Ellipsoid { semi_axes: it.semi_axes.map(|axis| axis.value()).into() })
            }
            file::Shape::Cylinder(it) => {
                Shape::Cylinder(Cylinder { radius: it.radius.value(), height: it.height.value() })
            }
            file::Shape::Cone(it) => Shape::Cone(Cone { radius: it.radius.value(), height: it.height.value() }),
            file::Shape::Capsule(it) => {
                Shape::Capsule(Capsule { radius: it.radius.value(), height: it.height.value() })
            }
            file::Shape::Torus(it) => {
                Shape::Torus(Torus { major_radius: it.major_radius.value(), minor_radius: it.minor_radius.value() })
            }
            file::Shape::Polyhedron(it) => Shape::Polyhedron(self.hull(it, &key.key("polyhedron"))?),
            file::Shape::Mesh(it) => Shape::Polyhedron(self.mesh(it, &key.key("mesh"))?),
            file::Shape::Union(it) => Shape::Union(self.union(it, &key.key("union"), density)?),
            file::Shape::Points(it) => Shape::Points(self.points(it, &key.key("points"))?),
        };
        match made.validate() {
            Ok(()) => Some(made),
            Err(error) => {
                let (place, help) = match error {
                    ShapeError::TorusWithoutHole { .. } => {
                        (key.key("torus").key("minor_radius"), "the tube must leave a hole")
                    }
                    _ => (key.clone(), "change the parameters of the shape"),
                };
                self.reporter.note(&place, error.to_string(), help);
                None
            }
        }
    }

    fn hull(&mut self, polyhedron: &file::Polyhedron, key: &Key) -> Option<Polyhedron> {
        let points: Vec<Vec3> = polyhedron.vertices.iter().map(si).collect();
        let made = hull(&points);
        made.map_err(|error| {
            self.reporter.note(&key.key("vertices"), error.to_string(), "give points that span a volume")
        })
        .ok()
    }

    fn mesh(&mut self, mesh: &file::Mesh, key: &Key) -> Option<Polyhedron> {
        let (path, scale) = (self.files.path(&mesh.file), mesh.scale.value());
        let read = match self.files.given(&mesh.file) {
            None => read_mesh(&path, scale),
            Some(Ok(bytes)) => parse_mesh(&path, bytes, scale),
            Some(Err(source)) => Err(MeshError::Unreadable { path, source }),
        };
        let read = read.map_err(|error| {
            let help = match error {
                MeshError::Unreadable { .. } => self.files.help(),
                _ => "mend the file, or choose another",
            };
            self.reporter.note(&key.key("file"), error.to_string(), help);
        });
        let read = read.ok()?;
        let corners = read.triangles.iter().flatten().map(|corner| *corner as f64);
        let numbers = read.vertices.iter().flatten().copied().chain(corners);
        self.reporter.read(&key.key("file"), &mesh.file, sum_of(numbers));
        Some(read)
    }

    fn points(&mut self, points: &[file::PointMass], key: &Key) -> Option<Points> {
        if points.is_empty() {
            self.reporter.note(key, "there are no points", "write points = [{ mass = …, at = [x, y, z] }, …]");
            return None;
        }
        let made = points.iter().map(|point| MassPoint { mass: point.mass.value(), at: si(&point.at) });
        Some(Points { points: made.collect() })
    }

    fn union(&mut self, union: &file::Union, key: &Key, density: Option<f64>) -> Option<Union> {
        let parts = key.key("parts");
        let place = |(index, part)| self.part(part, &parts.index(index), density);
        // Every part is looked at, before the first that failed ends it.
        let made: Vec<Option<UnionPart>> = union.parts.iter().enumerate().map(place).collect();
        Some(Union { parts: made.into_iter().collect::<Option<_>>()? })
    }

    fn part(&mut self, part: &file::Part, key: &Key, inherited: Option<f64>) -> Option<UnionPart> {
        let density = part.density.map(|density| density.value()).or(inherited);
        let turned = orientation(&part.orientation, &key.key("orientation"), self.reporter);
        let shape = self.shape(&part.shape, &key.key("shape"), density);
        let weight = match part.shape {
            // They bring their masses; what the union holds for them is a factor.
            file::Shape::Union(_) | file::Shape::Points(_) => Some(1.0),
            _ => density,
        };
        if weight.is_none() {
            let help = "give the part a `density`, or a body, or neither any part and a body its `mass`";
            self.reporter.note(&key.key("density"), "the part has no density", help);
        }
        Some(UnionPart { shape: shape?, offset: si(&part.offset), rotation: turned?.rotation(), density: weight? })
    }
}
