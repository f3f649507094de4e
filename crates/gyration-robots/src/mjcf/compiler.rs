//! How numbers and names of a file are to be read: `compiler`.

use super::why::why;
use crate::pose::{Pose, of_axes, turned, z_axis_to};
use crate::report::{Read, Report, elements, named};
use crate::tag::Tag;
use gyration::kinematics::Quaternion;
use gyration::tensor::Vec3;
use roxmltree::Node;
use std::path::{Path, PathBuf};

const ATTRIBUTES: [&str; 8] =
    ["angle", "coordinate", "eulerseq", "autolimits", "meshdir", "assetdir", "strippath", "inertiafromgeom"];
/// Attributes that turn a frame.
pub(super) const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// What `compiler` says.
#[derive(Debug, Clone)]
pub(super) struct Compiler {
    /// Radians per unit of an angle.
    pub unit: f64,
    /// Turns of `euler`, each x, y, z in turning axes or X, Y, Z in fixed ones.
    sequence: Vec<char>,
    /// Whether a range alone makes a limit.
    pub has_automatic_limits: bool,
    /// The folder of meshes.
    pub meshes: PathBuf,
    /// Whether folders in the names of meshes are left out.
    strips_paths: bool,
    /// Whether inertias come from geometry: always, never, or where none is written.
    pub from_geometry: Option<bool>,
}

impl Compiler {
    /// Of all `compiler` elements, the last first.
    pub fn read(root: Node<'_, '_>, folder: &Path, report: &mut Report) -> Self {
        let mut written: Vec<_> = elements(root).filter(|node| node.tag_name().name() == "compiler").collect();
        written.reverse();
        for node in &written {
            report.rest(*node, Read { attributes: &ATTRIBUTES, elements: &[], why });
        }
        let Some(last) = written.first() else { return Self::defaults(folder) };
        let tag = Tag::with(*last, written[1..].iter().copied());
        if tag.text("coordinate") == Some("global") {
            let fix = "save the model with local coordinates by the MuJoCo that wrote it";
            report.fault(*last, "coordinate = \"global\" is not read, nor is it by MuJoCo since 2.3.4", fix);
        }
        let sequence: Vec<char> = tag.text("eulerseq").unwrap_or("xyz").chars().collect();
        let is_sequence = sequence.len() == 3 && sequence.iter().all(|letter| "xyzXYZ".contains(*letter));
        if !is_sequence {
            report.fault(*last, "eulerseq is not three letters of xyzXYZ", "write eulerseq=\"xyz\"");
        }
        let defaults = Self::defaults(folder);
        Self {
            unit: if tag.text("angle") == Some("radian") { 1.0 } else { defaults.unit },
            sequence: if is_sequence { sequence } else { defaults.sequence },
            has_automatic_limits: tag.text("autolimits") != Some("false"),
            meshes: folder.join(tag.text("meshdir").or(tag.text("assetdir")).unwrap_or("")),
            strips_paths: tag.text("strippath") == Some("true"),
            from_geometry: match tag.text("inertiafromgeom") {
                Some("true") => Some(true),
                Some("false") => Some(false),
                _ => None,
            },
        }
    }

    fn defaults(folder: &Path) -> Self {
        Self {
            unit: std::f64::consts::PI / 180.0,
            sequence: "xyz".chars().collect(),
            has_automatic_limits: true,
            meshes: folder.to_owned(),
            strips_paths: false,
            from_geometry: None,
        }
    }

    /// The name of a mesh file as it is looked for.
    pub fn mesh_file<'a>(&self, written: &'a str) -> &'a str {
        if self.strips_paths { written.rsplit(['/', '\\']).next().unwrap_or(written) } else { written }
    }

    /// The frame of an element in that around it.
    pub fn pose(&self, tag: &Tag<'_, '_>, report: &mut Report) -> Pose {
        let position = tag.vector("pos", report).unwrap_or_default();
        Pose { position, rotation: self.rotation(tag, report) }
    }

    /// How an element is turned; the nearest layer that says it holds.
    pub fn rotation(&self, tag: &Tag<'_, '_>, report: &mut Report) -> Quaternion {
        for layer in tag.layers() {
            let mut written = ORIENTATIONS.into_iter().filter(|name| layer.has(name));
            let Some(name) = written.next() else { continue };
            if let Some(second) = written.next() {
                let message = format!("{} has both {name} and {second}", named(layer.node()));
                report.fault(layer.node(), message, "keep one of them");
            }
            return self.turn(name, &layer, report).unwrap_or(Quaternion::IDENTITY);
        }
        Quaternion::IDENTITY
    }

    fn turn(&self, name: &str, tag: &Tag<'_, '_>, report: &mut Report) -> Option<Quaternion> {
        let zero = |report: &mut Report| {
            report.fault(tag.node(), format!("{}: {name} is zero", named(tag.node())), "write a direction");
        };
        match name {
            "quat" => {
                let rotation = Quaternion(tag.numbers(name, report)?);
                if rotation.norm() > 0.0 {
                    return Some(rotation.normalized());
                }
                zero(report);
                None
            }
            "axisangle" => {
                let [x, y, z, angle] = tag.numbers(name, report)?;
                let axis = Vec3::new(x, y, z);
                if axis.norm() > 0.0 {
                    return Some(Quaternion::from_axis_angle(&axis, angle * self.unit));
                }
                zero(report);
                None
            }
            "xyaxes" => {
                let [a, b, c, d, e, f] = tag.numbers(name, report)?;
                let (x, second) = (Vec3::new(a, b, c), Vec3::new(d, e, f));
                let (x, across) = (x / x.norm(), second - x * (x.dot(&second) / x.norm_squared()));
                let y = across / across.norm();
                if x.iter().chain(&y).all(|entry| entry.is_finite()) {
                    return Some(of_axes(&x, &y, &x.cross(&y)));
                }
                let message = format!("{}: the axes of xyaxes have one direction, or none", named(tag.node()));
                report.fault(tag.node(), message, "write two directions across one another");
                None
            }
            "zaxis" => tag.direction(name, report).map(|direction| z_axis_to(&direction)),
            _ => {
                let angles: [f64; 3] = tag.numbers(name, report)?;
                let mut rotation = Quaternion::IDENTITY;
                for (letter, angle) in self.sequence.iter().zip(angles) {
                    let axis = match letter.to_ascii_lowercase() {
                        'x' => Vec3::x(),
                        'y' => Vec3::y(),
                        _ => Vec3::z(),
                    };
                    let turn = Quaternion::from_axis_angle(&axis, angle * self.unit);
                    rotation = if letter.is_lowercase() { turned(&rotation, &turn) } else { turned(&turn, &rotation) };
                }
                Some(rotation)
            }
        }
    }
}
