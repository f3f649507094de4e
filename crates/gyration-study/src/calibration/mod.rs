//! Numbers of a scene from measurements: α, β, ν of contact laws from what people can measure.
//!
//!   min Σ_i ((y_i − m_i(p))/σ_i)²
//!
//! m_i are computed with the simulator itself (`predict`): a rebound by a run to its apex, a gap from the exact rest
//! state, the speed on a slope and the force of pull-off from the balance of forces, a frequency from the bands of a
//! lattice. Their derivatives come from the sensitivities of the run or those of bands, or from differences of what has
//! neither. The least squares are in `fit` and `least_squares`; what is known of the numbers afterwards is in
//! `uncertainty`.

mod check;
mod columns;
mod csv;
mod curve;
mod dispersion;
pub(crate) mod file;
mod fit;
mod least_squares;
mod nearby;
mod number;
mod predict;
mod pull_off;
mod read;
mod rebound;
mod scale;
mod scene;
mod sliding;
mod suspect;
mod text;
mod uncertainty;

pub use curve::{Curve, CurvePoint};
pub use suspect::Suspect;
pub use uncertainty::{Fitted, FittedNumber, Residual, Undetermined};

use gyration_scene::{LoadError, Override, Template};
use scale::Scale;

/// The JSON Schema of a file of measurements.
pub fn schema() -> serde_json::Value {
    gyration_scene::written_schema(include_str!("../../schema/calibration.json"))
}

/// Measurements, and the scene whose numbers they tell.
#[derive(Debug, Clone)]
pub struct Calibration {
    title: Option<String>,
    name: String,
    template: Template,
    settings: Vec<Override>,
    numbers: Vec<FreeNumber>,
    experiments: Vec<Experiment>,
}

/// A number to find.
#[derive(Debug, Clone, PartialEq)]
struct FreeNumber {
    name: String,
    keys: Vec<String>,
    start: f64,
    scale: Scale,
}

/// What was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExperimentKind {
    /// Dropped; the rebound was measured.
    Drop,
    /// Laid down; the gap was measured.
    Gap,
    /// Put on a slope; the speed was measured.
    Slope,
    /// Put on a plane that is tilted until it slides; the angle was measured.
    Begins,
    /// Torn off; the force was measured.
    PullOff,
    /// Waves ran through a lattice; their frequencies were measured.
    Dispersion,
}

/// A wave whose frequency was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredWave {
    /// κ.
    pub kappa: [f64; 3],
    /// The branch, from 0 by ascending frequency.
    pub branch: usize,
}

/// A table of measurements.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    /// What was done.
    pub kind: ExperimentKind,
    /// Which of its kind, from zero.
    pub index: usize,
    /// The body; empty of waves.
    pub body: String,
    settings: Vec<Override>,
    /// The key of the condition, where it is a number of the scene.
    pub key: Option<String>,
    /// The condition of each row: height, angle, |κ|, or the number at the key.
    pub conditions: Vec<f64>,
    /// The wave of each row, where waves were measured.
    pub waves: Vec<MeasuredWave>,
    /// What was measured in each row.
    pub measured: Vec<f64>,
    /// The standard deviation of each.
    pub deviations: Vec<f64>,
}

/// Why no numbers were found.
#[derive(Debug, thiserror::Error)]
pub enum CalibrationError {
    /// The file, or what it refers to.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// A measurement that the start of the search cannot explain at all.
    #[error(
        "{place}: nothing can be measured where the search begins: {reason}\n  fix: give the numbers under [fit] a \
            `start` at which it can, or mend the scene"
    )]
    Start {
        /// Which table and row.
        place: String,
        /// Why.
        reason: String,
    },
    /// The search was given up.
    #[error("the search was given up {why}, {reached}\n  fix: {fix}")]
    Interrupted {
        /// After how long, or by whom.
        why: &'static str,
        /// The least χ² that it had found, and the measurement that was farthest off there.
        reached: String,
        /// What to do.
        fix: &'static str,
    },
    /// The search came to no end.
    #[error(
        "the search found no least squares: {0}\n  fix: start it nearer, fit fewer numbers, or look for a measurement \
            that cannot be"
    )]
    Search(String),
}

impl ExperimentKind {
    /// A kind of each section of the file.
    const SECTIONS: [Self; 5] = [Self::Drop, Self::Gap, Self::Slope, Self::PullOff, Self::Dispersion];

    /// The word of its section in the file.
    pub fn word(self) -> &'static str {
        match self {
            Self::Drop => "drop",
            Self::Gap => "gap",
            Self::Slope | Self::Begins => "slope",
            Self::PullOff => "pull_off",
            Self::Dispersion => "dispersion",
        }
    }

    /// Name and unit of its condition, where that is no number of the scene.
    pub fn condition(self) -> Option<(&'static str, &'static str)> {
        match self {
            Self::Drop => Some(("height", "m")),
            Self::Slope => Some(("angle", "rad")),
            Self::Dispersion => Some(("|κ|", "")),
            Self::Begins | Self::Gap | Self::PullOff => None,
        }
    }

    /// The unit in which people read its condition, and how many of it are one SI unit.
    pub fn shown(self) -> Option<(&'static str, f64)> {
        match self {
            Self::Slope => Some(("deg", 1f64.to_degrees())),
            _ => self.condition().map(|(_, unit)| (unit, 1.0)),
        }
    }

    /// Name and unit of what is measured.
    pub fn measured(self) -> (&'static str, &'static str) {
        match self {
            Self::Drop => ("rebound", "m"),
            Self::Gap => ("gap", "m"),
            Self::Slope => ("speed", "m/s"),
            Self::Begins => ("angle", "rad"),
            Self::PullOff => ("force", "N"),
            Self::Dispersion => ("omega", "rad/s"),
        }
    }
}

impl Experiment {
    /// Where it stands in the file.
    pub fn place(&self) -> String {
        format!("{}.{}", self.kind.word(), self.index)
    }

    /// What it is of: the body, or a lattice.
    pub fn subject(&self) -> &str {
        if self.kind == ExperimentKind::Dispersion { "lattice" } else { &self.body }
    }
}

impl Calibration {
    /// What the file calls itself, or the name of the scene.
    pub fn title(&self) -> &str {
        self.title.as_deref().unwrap_or(&self.name)
    }

    /// The tables of measurements.
    pub fn experiments(&self) -> &[Experiment] {
        &self.experiments
    }

    /// The overrides of a search at some point of it, in the order of the numbers.
    fn overrides(&self, values: &[f64]) -> Vec<Override> {
        let set = |(number, value): (&FreeNumber, &f64)| -> Vec<Override> {
            number.keys.iter().map(|key| Override::new(key, *value)).collect()
        };
        self.settings.iter().cloned().chain(self.numbers.iter().zip(values).flat_map(set)).collect()
    }
}
