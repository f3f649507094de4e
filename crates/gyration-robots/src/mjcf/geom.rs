//! Geometry: shapes by half their sizes, or from one point to another, with density or mass.

use super::Reader;
use super::why::why;
use crate::mesh::NamedMesh;
use crate::pose::{Pose, z_axis_to};
use crate::report::{Read, Report, named};
use crate::robot::{Part, PartShape};
use crate::tag::Tag;
use gyration::mass::MassProperties;
use gyration::shape::{Capsule, Cuboid, Cylinder, Ellipsoid, Sphere};
use gyration::tensor::Vec3;
use roxmltree::Node;

/// Those that are read; whether a geom collides stands in `contype` and `conaffinity`.
pub(super) const ATTRIBUTES: &[&str] = &[
    "name",
    "class",
    "type",
    "size",
    "pos",
    "quat",
    "axisangle",
    "xyaxes",
    "zaxis",
    "euler",
    "fromto",
    "density",
    "mass",
    "mesh",
];
/// Density where none is written \[kg/m³\].
const DENSITY: f64 = 1000.0;

/// A piece of geometry of a body.
#[derive(Debug)]
pub(super) struct Geom {
    pub name: Option<String>,
    pub line: usize,
    pub kind: GeomKind,
    /// In the frame of the body; none of a plane, or without mass.
    pub mass: Option<MassProperties>,
    /// Whether it is there to meet others.
    pub collides: bool,
}

/// A solid, or a plane in the frame of the body.
#[derive(Debug)]
pub(super) enum GeomKind {
    Solid(Part),
    Plane(Pose),
}

impl<'a, 'i> Reader<'a, 'i, '_> {
    /// A geom; lists it where a scene has nothing like it.
    pub(super) fn geom(&mut self, node: Node<'a, 'i>, frame: &Pose, childclass: Option<&'a str>) -> Option<Geom> {
        let tag = self.defaults.tag(node, childclass, self.report);
        self.report.rest(node, Read { attributes: ATTRIBUTES, elements: &[], why });
        let collides = ["contype", "conaffinity"].iter().any(|name| tag.text(name) != Some("0"));
        let (name, line) = (node.attribute("name").map(str::to_owned), self.report.line(node));
        let own = self.compiler.pose(&tag, self.report);
        let (shape, pose) = match tag.text("type").unwrap_or("sphere") {
            "plane" => {
                let kind = GeomKind::Plane(frame.then(&own));
                return Some(Geom { name, line, kind, mass: None, collides });
            }
            "mesh" => (self.mesh(&tag)?, own),
            "sphere" | "capsule" | "ellipsoid" | "cylinder" | "box" if tag.has("mesh") => {
                let why = "a primitive that MuJoCo fits to a mesh is not read: write its size";
                self.report.leave_out(node, named(node), why);
                return None;
            }
            kind @ ("sphere" | "capsule" | "ellipsoid" | "cylinder" | "box") => {
                primitive(kind, &tag, own, self.report)?
            }
            other => {
                let what = format!("{}: type = \"{other}\"", named(node));
                self.report.leave_out(node, what, why(other));
                return None;
            }
        };
        let pose = frame.then(&pose);
        let mass = self.mass(&tag, &shape, &pose);
        let kind = GeomKind::Solid(Part { line, shape, pose });
        Some(Geom { name, line, kind, mass, collides })
    }

    fn mesh(&mut self, tag: &Tag<'a, 'i>) -> Option<PartShape> {
        let node = tag.node();
        let Some(name) = tag.text("mesh") else {
            self.report.fault(node, format!("{} names no mesh", named(node)), "write mesh=\"…\"");
            return None;
        };
        let Some(asset) = self.meshes.get(name).cloned() else {
            let message = format!("{} names the mesh \"{name}\", which is no asset", named(node));
            self.report.fault(node, message, "write <mesh name=\"…\" file=\"…\"/> in <asset>");
            return None;
        };
        let scale = asset.numbers::<3>("scale", self.report).unwrap_or([1.0; 3]);
        let Some(file) = asset.text("file") else {
            let what = format!("{}: mesh \"{name}\"", named(node));
            self.report.leave_out(asset.node(), what, "it has no file: write its vertices into one");
            return None;
        };
        let (file, folder) = (self.compiler.mesh_file(file), self.compiler.meshes.clone());
        NamedMesh { file, folder: &folder, scale }.part(node, self.report)
    }

    /// The mass of a solid: as written, else by the density.
    fn mass(&mut self, tag: &Tag<'a, 'i>, shape: &PartShape, pose: &Pose) -> Option<MassProperties> {
        let given = tag.number("mass", self.report);
        let density = tag.number("density", self.report).unwrap_or(DENSITY);
        if let Some(wrong) = given.into_iter().chain([density]).find(|value| *value < 0.0) {
            let message = format!("{}: its mass or density is {wrong:?}", named(tag.node()));
            self.report.fault(tag.node(), message, "write a number ≥ 0");
            return None;
        }
        let properties = match given {
            Some(mass) => shape.solid().mass_properties(1.0).with_mass(mass),
            None => shape.solid().mass_properties(density),
        };
        let placed = properties.transformed(&pose.rotation.rotation(), &pose.position);
        (placed.mass > 0.0).then_some(placed)
    }
}

/// A shape of half sizes, and its frame.
fn primitive(kind: &str, tag: &Tag<'_, '_>, own: Pose, report: &mut Report) -> Option<(PartShape, Pose)> {
    let node = tag.node();
    let size = tag.list("size", report).unwrap_or_default();
    let mut pose = own;
    let mut half_sizes = size.clone();
    if let Some([a, b, c, d, e, f]) = tag.numbers("fromto", report) {
        let (from, to) = (Vec3::new(a, b, c), Vec3::new(d, e, f));
        let way = to - from;
        if kind == "sphere" || way.norm() == 0.0 {
            let message = format!("{}: fromto of a sphere, or without length", named(node));
            report.fault(node, message, "write two points of a capsule, cylinder, box or ellipsoid");
            return None;
        }
        pose = Pose { position: from + 0.5 * way, rotation: z_axis_to(&(way / way.norm())) };
        let half = 0.5 * way.norm();
        let across = size.first().copied().unwrap_or_default();
        half_sizes = match kind {
            "capsule" | "cylinder" => vec![across, half],
            _ => vec![across, across, half],
        };
    }
    let count = match kind {
        "sphere" => 1,
        "capsule" | "cylinder" => 2,
        _ => 3,
    };
    let Some(sizes) = half_sizes.get(..count) else {
        let message = format!("{}: a {kind} has {count} sizes, and {} are written", named(node), half_sizes.len());
        report.fault(node, message, "write size=\"…\" with as many numbers");
        return None;
    };
    if !tag.are_positive(sizes, report) {
        return None;
    }
    let shape = match *sizes {
        [radius] => PartShape::Sphere(Sphere { radius }),
        [radius, half] if kind == "capsule" => PartShape::Capsule(Capsule { radius, height: 2.0 * half }),
        [radius, half] => PartShape::Cylinder(Cylinder { radius, height: 2.0 * half }),
        [x, y, z, ..] if kind == "box" => PartShape::Box(Cuboid { size: 2.0 * Vec3::new(x, y, z) }),
        [x, y, z, ..] => PartShape::Ellipsoid(Ellipsoid { semi_axes: Vec3::new(x, y, z) }),
        [] => return None,
    };
    Some((shape, pose))
}
