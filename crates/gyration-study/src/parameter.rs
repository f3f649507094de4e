//! What is varied: axes of the grid and random numbers, and what a run is given of each.
//!
//! The randomness of a run depends on the seed, its number and the name of the parameter. Of Latin hypercubes and Sobol
//! points it is the point of the grid that begins the stream, and the repetition that goes along it.

use crate::column::{Column, ColumnKind};
use crate::file::Sampling;
use crate::random::{RandomStream, Sobol, inverse_normal, permuted, unit};
use crate::value::Value;
use gyration_scene::OverrideValue;
use std::f64::consts::TAU;

/// Something that is varied.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Its name, which is that of its column.
    pub name: String,
    /// The dotted keys of the scene that are set.
    pub keys: Vec<String>,
    /// The SI unit of its numbers, where it is known.
    pub unit: Option<String>,
    /// How it varies.
    pub variation: Variation,
    /// Its columns.
    pub(crate) columns: Vec<Column>,
}

/// How a parameter varies.
#[derive(Debug, Clone, PartialEq)]
pub enum Variation {
    /// Along an axis of the grid.
    Axis {
        /// Which axis, from zero; parameters that vary together share it.
        axis: usize,
        /// Its values.
        steps: AxisValues,
    },
    /// At random.
    Random {
        /// How it is distributed.
        distribution: Distribution,
        /// Its first coordinate among those of all random parameters.
        first: usize,
    },
}

/// The values of an axis.
#[derive(Debug, Clone, PartialEq)]
pub enum AxisValues {
    /// As written: the value as TOML, and its cells.
    Listed(Vec<(String, Vec<Value>)>),
    /// So many numbers from one to another, with equal differences or equal ratios.
    Grid {
        /// The first.
        from: f64,
        /// The last.
        to: f64,
        /// How many.
        count: u64,
        /// Whether ratios are equal.
        is_logarithmic: bool,
    },
}

/// How a random parameter is distributed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Distribution {
    /// Each number between two as likely as any other.
    Uniform {
        /// The least.
        from: f64,
        /// The greatest.
        to: f64,
    },
    /// The logarithm is uniform.
    LogUniform {
        /// The least, above zero.
        from: f64,
        /// The greatest.
        to: f64,
    },
    /// The normal distribution.
    Normal {
        /// Its mean.
        mean: f64,
        /// Its standard deviation.
        deviation: f64,
    },
    /// Each attitude as likely as any other.
    Rotation,
    /// A vector, each direction as likely as any other.
    Direction {
        /// Its least length.
        from: f64,
        /// Its greatest length.
        to: f64,
    },
}

/// What decides the randomness of a study.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Dice {
    pub seed: u64,
    pub sampling: Sampling,
    pub repetitions: u64,
    pub sobol: Sobol,
}

/// The place of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct RunPlace {
    pub run: u64,
    pub point: u64,
    pub repetition: u64,
}

impl AxisValues {
    /// How many.
    pub fn count(&self) -> u64 {
        match self {
            Self::Listed(values) => values.len() as u64,
            Self::Grid { count, .. } => *count,
        }
    }

    /// A value, and its cells.
    fn at(&self, index: u64) -> (OverrideValue, Vec<Value>) {
        match self {
            Self::Listed(values) => {
                let (written, cells) = &values[index as usize];
                (OverrideValue::Written(written.clone()), cells.clone())
            }
            Self::Grid { from, to, count, is_logarithmic } => {
                let fraction = index as f64 / (*count).saturating_sub(1).max(1) as f64;
                let value = match (index, is_logarithmic) {
                    // The ends are what is written.
                    (0, _) => *from,
                    (last, _) if last + 1 == *count => *to,
                    (_, false) => from + (to - from) * fraction,
                    (_, true) => from * libm::exp(libm::log(to / from) * fraction),
                };
                (OverrideValue::Number(value), vec![Value::Number(value)])
            }
        }
    }
}

impl Distribution {
    /// How many coordinates in (0, 1) a value takes.
    pub fn dimensions(&self) -> usize {
        match self {
            Self::Uniform { .. } | Self::LogUniform { .. } | Self::Normal { .. } => 1,
            Self::Rotation => 3,
            Self::Direction { from, to } => 2 + usize::from(from != to),
        }
    }

    /// The numbers that belong to coordinates in (0, 1).
    pub fn numbers(&self, u: &[f64]) -> Vec<f64> {
        match *self {
            Self::Uniform { from, to } => vec![between(from, to, u[0])],
            Self::LogUniform { from, to } => vec![(from * libm::exp(libm::log(to / from) * u[0])).clamp(from, to)],
            Self::Normal { mean, deviation } => vec![mean + deviation * inverse_normal(u[0])],
            Self::Rotation => rotation([u[0], u[1], u[2]]).into(),
            Self::Direction { from, to } => {
                let length = if from == to { from } else { between(from, to, u[2]) };
                direction([u[0], u[1]]).map(|component| length * component).into()
            }
        }
    }

    /// The value that these numbers are.
    fn setting(&self, numbers: &[f64]) -> OverrideValue {
        match self {
            Self::Rotation => OverrideValue::Table("quaternion", numbers.to_vec()),
            Self::Direction { .. } => OverrideValue::Array(numbers.to_vec()),
            _ => OverrideValue::Number(numbers[0]),
        }
    }

    /// What stands behind the name of each column.
    pub(crate) fn suffixes(&self) -> &'static [&'static str] {
        match self {
            Self::Rotation => &[".w", ".x", ".y", ".z"],
            Self::Direction { .. } => &[".x", ".y", ".z"],
            _ => &[""],
        }
    }
}

fn between(from: f64, to: f64, u: f64) -> f64 {
    // Rounding must not leave the interval.
    (from + (to - from) * u).clamp(from, to)
}

/// A quaternion [w, x, y, z], uniform over the rotations (Shoemake 1992).
fn rotation([a, b, c]: [f64; 3]) -> [f64; 4] {
    let (low, high) = ((1.0 - a).sqrt(), a.sqrt());
    let (sin, cos) = (libm::sin, libm::cos);
    [high * cos(TAU * c), low * sin(TAU * b), low * cos(TAU * b), high * sin(TAU * c)]
}

/// A unit vector, uniform over the sphere: its height is uniform (Archimedes).
fn direction([a, b]: [f64; 2]) -> [f64; 3] {
    let height = 2.0 * a - 1.0;
    let radius = (1.0 - height * height).max(0.0).sqrt();
    [radius * libm::cos(TAU * b), radius * libm::sin(TAU * b), height]
}

impl Parameter {
    /// The value of a run, and its cells; `indices` are those of the axes at its point.
    pub(crate) fn at(&self, dice: &Dice, place: RunPlace, indices: &[u64]) -> (OverrideValue, Vec<Value>) {
        match &self.variation {
            Variation::Axis { axis, steps } => steps.at(indices[*axis]),
            Variation::Random { distribution, first } => {
                let numbers = distribution.numbers(&self.coordinates(dice, place, distribution.dimensions(), *first));
                (distribution.setting(&numbers), numbers.into_iter().map(Value::Number).collect())
            }
        }
    }

    /// The coordinates in (0, 1) of a run.
    fn coordinates(&self, dice: &Dice, place: RunPlace, dimensions: usize, first: usize) -> Vec<f64> {
        let RunPlace { run, point, repetition } = place;
        let mut own = RandomStream::new(dice.seed, run, &self.name);
        // The stream that all repetitions of a point share has a name that no parameter can have.
        let mut shared = RandomStream::new(dice.seed, point, &format!("{}#point", self.name));
        let coordinate = |dimension: usize| match dice.sampling {
            Sampling::Random => own.uniform(),
            Sampling::LatinHypercube => {
                let part = permuted(repetition, dice.repetitions, shared.bits());
                ((part as f64 + own.uniform()) / dice.repetitions as f64).min(1.0 - f64::EPSILON / 2.0)
            }
            // A digital shift keeps every stratification of the points.
            Sampling::Sobol => unit(dice.sobol.digits(repetition, first + dimension) ^ shared.bits()),
        };
        (0..dimensions).map(coordinate).collect()
    }

    /// The kind of its values, if each is one number: its axis of the grid or its distribution, for a drawing.
    pub fn is_axis(&self) -> bool {
        matches!(self.variation, Variation::Axis { .. })
    }

    /// Its columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }
}

/// The columns of a parameter.
pub(crate) fn columns(name: &str, unit: Option<&str>, variation: &Variation) -> Vec<Column> {
    let numbers = |suffixes: &[&str]| {
        let column = |suffix: &&str| Column::new(format!("{name}{suffix}"), unit, ColumnKind::Number);
        suffixes.iter().map(column).collect()
    };
    match variation {
        Variation::Random { distribution, .. } => numbers(distribution.suffixes()),
        Variation::Axis { steps: AxisValues::Grid { .. }, .. } => numbers(&[""]),
        Variation::Axis { steps: AxisValues::Listed(values), .. } => match values.first() {
            Some((_, cells)) if matches!(cells[..], [Value::Text(_)]) => {
                vec![Column::new(name, None, ColumnKind::Text)]
            }
            Some((_, cells)) => match cells.len() {
                1 => numbers(&[""]),
                3 => numbers(&[".x", ".y", ".z"]),
                count => (0..count).map(|k| Column::new(format!("{name}.{k}"), unit, ColumnKind::Number)).collect(),
            },
            None => Vec::new(),
        },
    }
}
