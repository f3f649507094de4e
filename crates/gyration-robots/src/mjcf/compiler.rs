//! How numbers and names of a file are to be read: `compiler`.

use super::why::why;
use crate::pose::{Pose, of_axes, turned, unit, z_axis_to};
use crate::report::{Read, Report, elements, named};
use crate::tag::Tag;
use gyration::kinematics::Quaternion;
use gyration::tensor::Vec3;
use roxmltree::Node;
use std::path::{Path, PathBuf};

const ATTRIBUTES: [&str; 8] =
    ["angle", "coordinate", "eulerseq", "autolimits", "meshdir", "assetdir", "strippath", "inertiafromgeom"];
/// Sine of the angle between two axes that is rounding.
const ROUNDING: f64 = 1e-15;
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
        if tag.keyword("coordinate", &["local", "global"], report) == Some("global") {
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
            unit: match tag.keyword("angle", &["degree", "radian"], report) {
                Some("radian") => 1.0,
                _ => defaults.unit,
            },
            sequence: if is_sequence { sequence } else { defaults.sequence },
            has_automatic_limits: tag.keyword("autolimits", &["true", "false"], report) != Some("false"),
            meshes: folder.join(tag.text("meshdir").or(tag.text("assetdir")).unwrap_or("")),
            strips_paths: tag.keyword("strippath", &["true", "false"], report) == Some("true"),
            from_geometry: match tag.keyword("inertiafromgeom", &["true", "false", "auto"], report) {
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

    /// The two ends of a range that limits, as the attribute `limited` or the compiler says; lists one that does not.
    pub fn limits(&self, tag: &Tag<'_, '_>, [range, limited]: [&str; 2], report: &mut Report) -> Option<[f64; 2]> {
        let is_limited = match tag.keyword(limited, &["true", "false", "auto"], report) {
            Some("true") => true,
            Some("false") => false,
            _ => self.has_automatic_limits,
        };
        let [low, high] = tag.numbers(range, report)?;
        if is_limited && low < high {
            return Some([low, high]);
        }
        let what = format!("{}: {range} = \"{low:?} {high:?}\"", named(tag.node()));
        let why = if is_limited {
            "there is nothing between its ends"
        } else {
            "it limits nothing: `autolimits`, or the attribute that would switch it on, is false"
        };
        report.leave_out(tag.node(), what, why);
        None
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
        match name {
            "quat" => {
                let along = Quaternion::along(tag.numbers(name, report)?);
                if along.is_none() {
                    tag.note_zero(name, report);
                }
                along
            }
            "axisangle" => {
                let [x, y, z, angle] = tag.numbers(name, report)?;
                let axis = unit(&Vec3::new(x, y, z));
                if axis.is_none() {
                    tag.note_zero(name, report);
                }
                axis.map(|axis| Quaternion::from_axis_angle(&axis, angle * self.unit))
            }
            "xyaxes" => {
                let [a, b, c, d, e, f] = tag.numbers(name, report)?;
                if let (Some(x), Some(second)) = (unit(&Vec3::new(a, b, c)), unit(&Vec3::new(d, e, f))) {
                    let across = second - x * x.dot(&second);
                    if across.norm() > ROUNDING {
                        let y = across.normalize();
                        return Some(of_axes(&x, &y, &x.cross(&y)));
                    }
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
