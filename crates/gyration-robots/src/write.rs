//! A scene as text: at its head what was left out and what was chosen, then its sections.

use crate::plan::{EXPONENT, JointKind, Plan, PlannedBody, PlannedJoint, PlannedSupport};
use crate::pose::Pose;
use crate::report::Finding;
use crate::robot::{Part, PartShape, input_name};
use gyration::kinematics::Quaternion;
use gyration::tensor::{Mat3, Vec3};
use std::fmt::Write as _;
use std::path::Path;

/// Part of a length of one, or of the largest entry of a tensor, that is rounding.
const ROUNDING: f64 = 1e-15;

/// What stands at the head of a scene.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Head<'a> {
    pub file: &'a str,
    pub left_out: &'a [Finding],
    pub chosen: &'a [Finding],
}

/// The text of a scene that stands in a folder.
pub(crate) fn text(plan: &Plan, head: Head<'_>, folder: &Path) -> String {
    let mut text = heading(head);
    let mut line = |content: String| {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{content}");
    };
    line(format!("title = {}\n", quoted(&plan.title)));
    if let Some(gravity) = &plan.gravity {
        line(format!("[world]\ngravity = {}\n", vector(gravity)));
    }
    line("[time]\nend = 1.0\nsample = 0.01".to_owned());
    for plane in &plan.planes {
        line(format!("\n[[support]]\nname = \"{}\"", plane.name));
        line(format!("plane = {{ origin = {}, normal = {} }}", vector(&plane.origin), vector(&plane.normal)));
    }
    for support in &plan.supports {
        line(self::support(support, folder));
    }
    for body in &plan.bodies {
        line(self::body(body, folder));
    }
    for joint in &plan.joints {
        line(self::joint(joint));
    }
    text
}

fn heading(Head { file, left_out, chosen }: Head<'_>) -> String {
    let mut text = format!("# Made of {} by `gyration import`.\n", file.replace(char::is_control, "_"));
    let lists = [
        (left_out, "What the file says and this scene does not:", "The scene has all that the file says."),
        (chosen, "What this scene says and the file does not:", "The file has all that the scene says."),
    ];
    for (list, title, none) in lists {
        text += &format!("#\n# {}\n", if list.is_empty() { none } else { title });
        for finding in list {
            text += &format!("# - {finding}\n");
        }
    }
    text + "\n"
}

fn support(support: &PlannedSupport, folder: &Path) -> String {
    let PlannedSupport { name, shape, pose } = support;
    // A support stands at the centre of mass of its shape.
    let position = pose.place(&shape.solid().mass_properties(1.0).center);
    let mut text = format!("\n[[support]]\nname = \"{name}\"\nshape = {}\n", self::shape(shape, folder));
    text += &format!("position = {}", vector(&position));
    if let Some(orientation) = orientation(&pose.rotation) {
        text += &format!("\norientation = {orientation}");
    }
    text
}

fn body(body: &PlannedBody, folder: &Path) -> String {
    let mut text = format!("\n[[body]]\nname = \"{}\"\n", body.name);
    let mut center = body.mass.center;
    match &body.parts[..] {
        // A body without shape has no frame in which a centre could be told.
        [] => {}
        // The shape of one part alone has the frame of that part.
        [only] if orientation(&only.pose.rotation).is_none() => {
            center -= only.pose.position;
            text += &format!("shape = {}\n", shape(&only.shape, folder));
        }
        parts => {
            text += "shape = { union = { parts = [\n";
            for part in parts {
                text += &format!("    {},\n", self::part(part, folder));
            }
            text += "] } }\n";
        }
    }
    let tensor = tensor(&body.mass.euler_tensor);
    text += &format!("mass_properties = {{ mass = {:?}, ", body.mass.mass);
    if !body.parts.is_empty() {
        text += &format!("center = {}, ", vector(&center));
    }
    text += &format!("euler_tensor = {tensor} }}\nposition = {}", vector(&body.pose.position));
    if let Some(orientation) = orientation(&body.pose.rotation) {
        text += &format!("\norientation = {orientation}");
    }
    if let Some(normal) = &body.kept {
        text += &format!("\nkeep = {{ plane = {} }}", vector(normal));
    }
    text
}

fn part(part: &Part, folder: &Path) -> String {
    let Pose { position, rotation } = &part.pose;
    let turned = orientation(rotation).map(|orientation| format!(", orientation = {orientation}")).unwrap_or_default();
    format!("{{ shape = {}, offset = {}{turned} }}", shape(&part.shape, folder), vector(position))
}

fn joint(joint: &PlannedJoint) -> String {
    let [first, second] = &joint.between;
    let (kind, has_axis) = match joint.kind {
        JointKind::Hinge => ("hinge", true),
        JointKind::Slider => ("slider", true),
        JointKind::Ball => ("ball", false),
        JointKind::Weld => ("weld", false),
    };
    let mut text = format!("\n[[joint]]\nname = \"{}\"\nbetween = [\"{first}\", \"{second}\"]\n", joint.name);
    text += &format!("kind = \"{kind}\"\npoints = [{}, {}]", vector(&joint.points[0]), vector(&joint.points[1]));
    if has_axis {
        text += &format!("\naxis = {}", vector(&joint.axis));
    }
    if let Some(([low, high], stop)) = &joint.limits {
        let (strength, distance) = (stop.strength, stop.distance);
        text += &format!("\nlimits = [{low:?}, {high:?}]\n");
        text += &format!("stop = {{ repulsion = {{ alpha = {strength:?}, nu = {EXPONENT}, d0 = {distance:?} }} }}");
    }
    if !joint.drive.terms.is_empty() {
        let key = if joint.kind == JointKind::Hinge { "torque" } else { "force" };
        let constants = (1..=joint.drive.inputs).map(|number| format!("{} = 0", input_name(number)));
        let constants: Vec<String> = constants.collect();
        let constants = match constants.is_empty() {
            true => String::new(),
            false => format!(", constants = {{ {} }}", constants.join(", ")),
        };
        text += &format!("\ndrive = {{ {key} = \"{}\"{constants} }}", joint.drive.terms.join(" + "));
    }
    text
}

fn shape(shape: &PartShape, folder: &Path) -> String {
    match shape {
        PartShape::Box(it) => format!("{{ box = {{ size = {} }} }}", vector(&it.size)),
        PartShape::Sphere(it) => format!("{{ sphere = {{ radius = {:?} }} }}", it.radius),
        PartShape::Ellipsoid(it) => format!("{{ ellipsoid = {{ semi_axes = {} }} }}", vector(&it.semi_axes)),
        PartShape::Cylinder(it) => {
            format!("{{ cylinder = {{ radius = {:?}, height = {:?} }} }}", it.radius, it.height)
        }
        PartShape::Capsule(it) => format!("{{ capsule = {{ radius = {:?}, height = {:?} }} }}", it.radius, it.height),
        PartShape::Mesh(path, scale, _) => {
            let file = quoted(&as_seen_from(folder, path));
            format!("{{ mesh = {{ file = {file}, scale = {scale:?} }} }}")
        }
    }
}

/// A path relative to a folder around it, else from the root.
fn as_seen_from(folder: &Path, path: &Path) -> String {
    let whole = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let (folder, path) = (whole(folder), whole(path));
    path.strip_prefix(&folder).unwrap_or(&path).to_string_lossy().into_owned()
}

/// A text as TOML writes it.
fn quoted(text: &str) -> String {
    let mut written = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => written.extend(['\\', letter]),
            letter if letter.is_control() => {
                // Writing to a string does not fail.
                let _ = write!(written, "\\u{:04x}", u32::from(letter));
            }
            letter => written.push(letter),
        }
    }
    written + "\""
}

/// A number without what is rounding beside `size`.
fn number(value: f64, size: f64) -> String {
    if value.abs() <= ROUNDING * size { "0.0".to_owned() } else { format!("{value:?}") }
}

fn vector(vector: &Vec3) -> String {
    let size = vector.amax();
    let [x, y, z] = [vector.x, vector.y, vector.z].map(|entry| number(entry, size));
    format!("[{x}, {y}, {z}]")
}

fn tensor(tensor: &Mat3) -> String {
    let row = |row: usize| {
        let [x, y, z] = [0, 1, 2].map(|column| number(tensor[(row, column)], tensor.trace()));
        format!("[{x}, {y}, {z}]")
    };
    format!("[{}, {}, {}]", row(0), row(1), row(2))
}

/// How something is turned; none of what is not.
fn orientation(rotation: &Quaternion) -> Option<String> {
    let [w, x, y, z] = rotation.0;
    // Two quaternions are one rotation: that with w ≥ 0.
    let sign = if w < 0.0 { -1.0 } else { 1.0 };
    if [x, y, z].iter().all(|entry| entry.abs() <= ROUNDING) {
        return None;
    }
    let [w, x, y, z] = [w, x, y, z].map(|entry| number(sign * entry, 1.0));
    Some(format!("{{ quaternion = [{w}, {x}, {y}, {z}] }}"))
}
