//! The quantities that are recorded of joints: names, units, columns, values.

use gyration::dynamics::{JointObservation, Scratch, observe_joint};
use gyration::instant::Instant;
use gyration::joint::{Joint, JointKind};
use gyration::model::Model;
use gyration_record::{ArraySpec, Dimension};

/// A quantity recorded of every joint.
struct JointField {
    name: &'static str,
    units: &'static str,
    description: &'static str,
    /// Suffixes of the CSV columns.
    suffixes: &'static [&'static str],
    /// The joints that it is of; NaN of any other, which has no column.
    applies: fn(JointKind) -> bool,
    values: fn(&JointObservation) -> [f64; 3],
}

const FIELDS: [JointField; 4] = [
    JointField {
        name: "joint_force",
        units: "N",
        description: "force of the joint on the first of its two",
        suffixes: &["fx", "fy", "fz"],
        applies: |_| true,
        values: |seen| seen.force.into(),
    },
    JointField {
        name: "joint_moment",
        units: "N m",
        description: "torque of the joint on the first of its two, about its point there",
        suffixes: &["mx", "my", "mz"],
        applies: |_| true,
        values: |seen| seen.torque.into(),
    },
    JointField {
        name: "joint_angle",
        units: "rad",
        description: "angle of the second about the axis of a hinge; NaN for any other joint",
        suffixes: &["angle"],
        applies: |kind| kind == JointKind::Hinge,
        values: |seen| [seen.angle.unwrap_or(f64::NAN); 3],
    },
    JointField {
        name: "joint_distance",
        units: "m",
        description: "distance of the points, or of the second along the axis of a slider; NaN for any other joint",
        suffixes: &["distance"],
        applies: |kind| matches!(kind, JointKind::Distance | JointKind::Slider),
        values: |seen| [seen.distance.unwrap_or(f64::NAN); 3],
    },
];

impl JointField {
    fn columns(&self, joint: &Joint) -> impl Iterator<Item = String> {
        let (name, applies) = (joint.name.clone(), (self.applies)(joint.kind));
        let column = move |suffix: &&str| if applies { format!("joint.{name}.{suffix}") } else { String::new() };
        self.suffixes.iter().map(column)
    }
}

/// The arrays of the joints of a model; none without any.
pub(super) fn arrays(model: &Model) -> Vec<ArraySpec> {
    let array = |field: &JointField| {
        let mut dims = vec![Dimension::new("joint", model.joints().len())];
        if field.suffixes.len() == 3 {
            dims.push(Dimension::new("row", 3));
        }
        let columns = model.joints().iter().flat_map(|joint| field.columns(joint)).collect();
        let [name, units, description] = [field.name, field.units, field.description].map(String::from);
        ArraySpec { name, dims, units, description, columns }
    };
    if model.joints().is_empty() { Vec::new() } else { FIELDS.iter().map(array).collect() }
}

/// Their columns in the order of the CSV: joint by joint.
pub(super) fn columns(model: &Model) -> impl Iterator<Item = String> {
    let of_joint = |joint| FIELDS.iter().flat_map(move |field| field.columns(joint));
    model.joints().iter().flat_map(of_joint).filter(|column| !column.is_empty())
}

/// Appends their numbers to a row.
pub(super) fn fill(instant: &Instant, scratch: &Scratch, seen: &mut Vec<JointObservation>, row: &mut Vec<f64>) {
    let count = instant.model().joints().len();
    seen.clear();
    seen.extend((0..count).map(|number| observe_joint(instant, scratch, number)));
    for field in FIELDS.iter().filter(|_| count > 0) {
        for seen in &*seen {
            row.extend_from_slice(&(field.values)(seen)[..field.suffixes.len()]);
        }
    }
}
