//! The fields of a recording, sample by sample and point by point, in a form to print.

mod image;
mod layer;
mod maps;
mod source;
mod widths;

pub use layer::FieldLayer;
pub use maps::{FieldMap, FieldMaps};

use crate::fields::{Granules, LocalFields, Third, Weight};
use crate::format::significant;
use crate::replay::ReplayError;
use gyration::tensor::{Mat3, Vec3};
use gyration_record::Recording;
use gyration_threads::Interruption;
use serde::ser::{Serialize, SerializeStruct, Serializer};
use source::FieldSource;
use widths::{MOST_SEEN, Widths};

/// A grid reaches beyond the outermost centres by so many widths.
const MARGIN: f64 = 2.0;
/// Points of a grid along its longest side where none is given.
const USUAL_POINTS: usize = 16;

/// So many points over all samples are kept at most, some ten gigabytes.
const MOST_POINTS: f64 = 1e7;

/// Where fields are asked for.
#[derive(Debug, Clone, PartialEq)]
pub enum FieldPoints {
    /// At points \[m\].
    At(Vec<Vec3>),
    /// At so many along each axis, over the box of the centres of all samples and two widths beyond.
    Grid([usize; 3]),
    /// At 16 along the longest side of that box, equally close along the others.
    Usual,
}

/// A grid of points, x fastest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldGrid {
    /// How many points along each axis.
    pub counts: [usize; 3],
    /// The first \[m\].
    pub origin: Vec3,
    /// From one to the next \[m\]; the width of the weight along an axis of one point.
    pub spacing: Vec3,
}

/// The fields of a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldSurvey {
    /// b \[m\].
    pub width: f64,
    /// The times of the samples \[s\].
    pub times: Vec<f64>,
    /// The points \[m\].
    pub points: Vec<Vec3>,
    /// The grid on which they are, if they are on one.
    pub grid: Option<FieldGrid>,
    /// Of each sample, of each point.
    pub fields: Vec<Vec<LocalFields>>,
}

/// Why there are no fields.
#[derive(Debug, thiserror::Error)]
pub enum NoFields {
    /// No samples, or none that can be brought back.
    #[error(transparent)]
    Replay(#[from] ReplayError),
    /// Bodies meet, and what they do to one another was not recorded.
    #[error("bodies meet in the scene, and what they do to one another was not recorded")]
    NoPairs,
    /// What the fluid remembers is in no row, and forces go by it.
    #[error("the fluid remembers how a body moved (`history`), which is not recorded, and forces go by it")]
    Remembers,
    /// The width is no length.
    #[error("the width {0} m is not a finite length above zero")]
    Width(f64),
    /// The width is too far from the extent of the bodies for numbers to hold both.
    #[error(
        "the width {} m is out of proportion to the extent of the bodies: write one between {} and {} m",
        significant(*width, 3), significant(*least, 3), significant(*most, 3)
    )]
    Extent {
        /// The width \[m\].
        width: f64,
        /// The millionth of the extent \[m\].
        least: f64,
        /// The millionfold \[m\].
        most: f64,
    },
    /// The bodies follow one another without end, and too many of them are seen with the width.
    #[error(
        "with the width {} m each point sees more than {} bodies of a ring: write one of {} m or less",
        significant(*width, 3), seen, significant(*most, 3)
    )]
    Wide {
        /// The width \[m\].
        width: f64,
        /// The largest, to three digits \[m\].
        most: f64,
        /// How many a point may see.
        seen: f64,
    },
    /// More than are kept.
    #[error("{points:e} points in each of {samples} samples are more than ten million")]
    Many {
        /// Points.
        points: f64,
        /// Samples.
        samples: usize,
    },
    /// A grid without points.
    #[error("a grid has at least one point along each axis")]
    EmptyGrid,
    /// Nobody waits for them any longer.
    #[error("the averaging was given up")]
    Interrupted,
}

impl NoFields {
    /// What a scene must say for its runs to have them; none where it is not the scene that lacks it.
    pub fn in_scene(&self) -> Option<&'static str> {
        match self {
            Self::NoPairs => Some("write record = { pairs = true } in the scene, and run it anew"),
            Self::Remembers => Some("write history = false in the scene, and run it anew"),
            _ => None,
        }
    }
}

impl FieldSurvey {
    /// Of each `every`-th sample and the last, with weights of a width \[m\].
    ///
    /// # Errors
    /// [`NoFields`].
    pub fn of(recording: &Recording, width: f64, points: &FieldPoints, every: usize) -> Result<Self, NoFields> {
        // Before what takes long.
        widths::length(width)?;
        let mut source = FieldSource::open(recording)?;
        let corners = source.corners()?;
        let weight = Widths::of(&source.replay, &corners, MOST_SEEN).weight(width)?;
        let mut rows: Vec<usize> = (0..recording.rows()).step_by(every.max(1)).collect();
        rows.extend(recording.rows().checked_sub(1).filter(|last| last % every.max(1) > 0));
        let (grid, listed) = match points {
            FieldPoints::At(points) => (None, points.as_slice()),
            FieldPoints::Grid(counts) if counts.contains(&0) => return Err(NoFields::EmptyGrid),
            FieldPoints::Grid(counts) => (Some(FieldGrid::over(&corners, width, |_| *counts)), &[][..]),
            FieldPoints::Usual => (Some(FieldGrid::over(&corners, width, usual_counts)), &[][..]),
        };
        let asked = grid.as_ref().map_or(listed.len() as f64, FieldGrid::count);
        if asked * rows.len() as f64 > MOST_POINTS {
            return Err(NoFields::Many { points: asked, samples: rows.len() });
        }
        let points = grid.as_ref().map_or_else(|| listed.to_vec(), FieldGrid::points);
        let (mut times, mut fields) = (Vec::new(), Vec::new());
        for row in rows {
            let sample = source.sample(row)?;
            times.push(sample.time);
            fields.push(averaged(&sample, &points, &weight)?);
        }
        Ok(Self { width, times, points, grid, fields })
    }
}

/// The fields of a sample at points.
///
/// # Errors
/// `Interrupted`.
fn averaged(sample: &Granules, points: &[Vec3], weight: &Weight) -> Result<Vec<LocalFields>, NoFields> {
    let at = |point| match Interruption::due() {
        Some(_) => Err(NoFields::Interrupted),
        None => Ok(sample.fields(point, weight)),
    };
    points.iter().map(at).collect()
}

/// Points along the sides of a box, 16 along the longest.
fn usual_counts(sides: &Vec3) -> [usize; 3] {
    let spacing = sides.max() / (USUAL_POINTS - 1) as f64;
    std::array::from_fn(|axis| (sides[axis] / spacing).round() as usize + 1)
}

impl FieldGrid {
    /// Over a box, which the places and a margin fill.
    fn over([low, high]: &[Vec3; 2], width: f64, counts: impl Fn(&Vec3) -> [usize; 3]) -> Self {
        let (low, high) = (low - Vec3::repeat(MARGIN * width), high + Vec3::repeat(MARGIN * width));
        let counts = counts(&(high - low));
        let spacing =
            |axis: usize| if counts[axis] > 1 { (high - low)[axis] / (counts[axis] - 1) as f64 } else { width };
        let origin = |axis: usize| if counts[axis] > 1 { low[axis] } else { 0.5 * (low + high)[axis] };
        Self { counts, origin: Vec3::from_fn(|axis, _| origin(axis)), spacing: Vec3::from_fn(|axis, _| spacing(axis)) }
    }

    /// The number of its points.
    fn count(&self) -> f64 {
        self.counts.iter().map(|count| *count as f64).product()
    }

    /// Its points, x fastest.
    fn points(&self) -> Vec<Vec3> {
        let [nx, ny, nz] = self.counts;
        let place = |at: [usize; 3]| self.origin + self.spacing.component_mul(&Vec3::from(at.map(|n| n as f64)));
        let points = (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])));
        points.map(place).collect()
    }
}

impl Serialize for FieldSurvey {
    /// As columns: `t`, `x`, and each field as [sample][point][…].
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut table = serializer.serialize_struct("fields", 18)?;
        table.serialize_field("width", &self.width)?;
        table.serialize_field("t", &self.times)?;
        table.serialize_field("x", &self.points.iter().map(vector).collect::<Vec<_>>())?;
        table.serialize_field("density", &self.column(|it| it.density))?;
        table.serialize_field("momentum", &self.column(|it| vector(&it.momentum)))?;
        table.serialize_field("affine_momentum", &self.column(|it| rows(&it.affine_momentum)))?;
        table.serialize_field("flux", &self.column(|it| third(&it.flux)))?;
        table.serialize_field("kinetic", &self.column(|it| rows(&it.kinetic)))?;
        table.serialize_field("micro_stress", &self.column(|it| rows(&it.micro_stress)))?;
        table.serialize_field("contact_stress", &self.column(|it| rows(&it.contact_stress)))?;
        table.serialize_field("hyperstress", &self.column(|it| third(&it.hyperstress)))?;
        table.serialize_field("external", &self.column(|it| rows(&it.external)))?;
        table.serialize_field("rate", &self.column(|it| rows(&it.rate)))?;
        table.serialize_field("stress", &self.column(|it| rows(&it.stress)))?;
        table.serialize_field("momentum_rate", &self.column(|it| vector(&it.momentum_rate)))?;
        table.serialize_field("power", &self.column(|it| it.power))?;
        table.serialize_field("residual", &self.column(|it| it.residual))?;
        table.serialize_field("momentum_residual", &self.column(|it| it.momentum_residual))?;
        table.end()
    }
}

impl FieldSurvey {
    fn column<T>(&self, value: impl Fn(&LocalFields) -> T) -> Vec<Vec<T>> {
        self.fields.iter().map(|sample| sample.iter().map(&value).collect()).collect()
    }
}

fn vector(vector: &Vec3) -> [f64; 3] {
    (*vector).into()
}

fn rows(matrix: &Mat3) -> [[f64; 3]; 3] {
    matrix.transpose().into()
}

/// The last index last.
fn third(third: &Third) -> [[[f64; 3]; 3]; 3] {
    std::array::from_fn(|a| std::array::from_fn(|b| std::array::from_fn(|c| third[c][(a, b)])))
}
