//! Measures of a body by their names: those of the columns of the CSV without the body, and two that have no column.
//!
//!   G_xz, P_zz, Pdot_xx; x, vx, fx, impulse_x; gap, pressure, peak_force; V_xx and Q_xx, of contraction velocity and
//!   drive

use crate::error::PlotError;
use crate::recorded::RecordedScene;

/// Letters before the underscore, and the array of matrices that they stand for.
const MATRICES: [(&str, &str); 5] = [
    ("G", "contraction"),
    ("P", "placement_gradient"),
    ("Pdot", "gradient_rate"),
    ("V", "contraction_velocity"),
    ("Q", "drive"),
];
/// Letters before the component, and the array of vectors.
const VECTORS: [(&str, &str); 4] =
    [("", "position"), ("v", "velocity"), ("f", "contact_force"), ("impulse_", "impulse")];
const SCALARS: [&str; 3] = ["gap", "pressure", "peak_force"];
const AXES: [char; 3] = ['x', 'y', 'z'];

/// A number that a recording has of each body at each sample.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyNumber {
    /// The name with its indices lowered.
    pub label: String,
    /// The unit; empty for a pure number.
    pub unit: String,
    /// Where it is recorded.
    pub array: &'static str,
    /// Numbers of a body in a row of the array.
    stride: usize,
    /// Which of them it is.
    offset: usize,
}

impl BodyNumber {
    /// The component of this name.
    ///
    /// # Errors
    /// [`PlotError::Measure`] if there is none, or if it is not recorded.
    pub fn named(recorded: &RecordedScene, name: &str) -> Result<Self, PlotError> {
        let with_unit = |found: Self| {
            let unit = recorded.recording.array(found.array).ok()?.units.as_str();
            Some(Self { unit: if unit == "1" { String::new() } else { unit.to_owned() }, ..found })
        };
        find(name).and_then(with_unit).ok_or_else(|| PlotError::Measure { name: name.to_owned() })
    }

    /// Entry k, row by row, of a matrix by the letters of its name.
    pub fn entry(recorded: &RecordedScene, letters: &str, k: usize) -> Result<Self, PlotError> {
        Self::named(recorded, &format!("{letters}_{}{}", AXES[k / 3], AXES[k % 3]))
    }

    /// Its value for a body, from a row of its array.
    pub fn of(&self, row: &[f64], body: usize) -> f64 {
        row[self.stride * body + self.offset]
    }

    /// Before its unit is known.
    fn of_array(array: &'static str, stride: usize, offset: usize, label: String) -> Self {
        Self { label, unit: String::new(), array, stride, offset }
    }
}

fn find(name: &str) -> Option<BodyNumber> {
    matrix(name).or_else(|| vector(name)).or_else(|| scalar(name))
}

fn axis(letter: char) -> Option<usize> {
    AXES.iter().position(|axis| *axis == letter)
}

fn matrix(name: &str) -> Option<BodyNumber> {
    let (letters, indices) = name.split_once('_')?;
    let (_, array) = MATRICES.iter().find(|(known, _)| *known == letters)?;
    let [row, col] = indices.chars().collect::<Vec<char>>()[..] else { return None };
    let label = format!("{letters}_{{{indices}}}");
    Some(BodyNumber::of_array(array, 9, 3 * axis(row)? + axis(col)?, label))
}

fn vector(name: &str) -> Option<BodyNumber> {
    let component = axis(name.chars().last()?)?;
    let (letters, array) = VECTORS.iter().find(|(known, _)| *known == &name[..name.len() - 1])?;
    let letters = letters.trim_end_matches('_');
    let label = if letters.is_empty() { name.to_owned() } else { format!("{letters}_{{{}}}", AXES[component]) };
    Some(BodyNumber::of_array(array, 3, component, label))
}

fn scalar(name: &str) -> Option<BodyNumber> {
    let array = SCALARS.into_iter().find(|known| *known == name)?;
    Some(BodyNumber::of_array(array, 1, 0, name.replace('_', " ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_columns() {
        let found = |name: &str| find(name).map(|it| (it.array, it.stride, it.offset, it.label));
        assert_eq!(found("G_xz"), Some(("contraction", 9, 2, "G_{xz}".to_owned())));
        assert_eq!(found("Pdot_zy"), Some(("gradient_rate", 9, 7, "Pdot_{zy}".to_owned())));
        assert_eq!(found("z"), Some(("position", 3, 2, "z".to_owned())));
        assert_eq!(found("vx"), Some(("velocity", 3, 0, "v_{x}".to_owned())));
        assert_eq!(found("impulse_y"), Some(("impulse", 3, 1, "impulse_{y}".to_owned())));
        assert_eq!(found("peak_force"), Some(("peak_force", 1, 0, "peak force".to_owned())));
        assert_eq!(found("gap"), Some(("gap", 1, 0, "gap".to_owned())));
        for name in ["", "G", "G_", "G_x", "G_xxx", "G_xw", "H_xx", "ux", "é", "G_é", "gaps"] {
            assert!(find(name).is_none(), "{name}");
        }
    }
}
