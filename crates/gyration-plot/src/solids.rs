//! Supports with a shape as pictures have them: filled, at their true size, where their motion has carried them.

use crate::attributes::{MotionPicture, attribute, motion};
use crate::draw::Point;
use crate::error::PlotError;
use gyration::support::SupportMotion;
use gyration::tensor::{Mat3, Vec3};
use gyration_record::Recording;
use serde::Deserialize;

/// A point of a convex surface is no farther beyond a face than this part of the largest coordinate.
const ROUNDING: f64 = 1e-6;

/// A support with a shape, as it is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidSupportPicture {
    /// Points of its surface before any motion [m].
    points: Vec<Vec3>,
    /// Its triangles, by index; none of a convex one, whose outline is its hull.
    faces: Vec<[usize; 3]>,
    /// How it moves.
    pub motion: SupportMotion,
}

#[derive(Deserialize)]
struct Entry {
    surface: Option<usize>,
    position: [f64; 3],
    gradient: [f64; 9],
    motion: Option<MotionPicture>,
}

impl SolidSupportPicture {
    /// Those of a recording.
    ///
    /// # Errors
    /// [`PlotError::Attribute`] if what is said of them is not what it should be; those of reading.
    pub fn all(recording: &Recording) -> Result<Vec<Self>, PlotError> {
        if recording.attributes().get("solid_supports").is_none() {
            return Ok(Vec::new());
        }
        let entries: Vec<Entry> = attribute(recording, "solid_supports")?;
        entries.into_iter().map(|entry| Self::of(recording, entry)).collect()
    }

    fn of(recording: &Recording, entry: Entry) -> Result<Self, PlotError> {
        let (position, gradient) = (Vec3::from(entry.position), Mat3::from_row_slice(&entry.gradient));
        let mut this = Self { points: Vec::new(), faces: Vec::new(), motion: motion(entry.motion) };
        let Some(surface) = entry.surface else { return Ok(this) };
        let points = recording.read(&format!("surface_{surface}_points"))?.data;
        this.points = points.chunks_exact(3).map(|x| position + gradient * Vec3::from_column_slice(x)).collect();
        let corners = recording.read(&format!("surface_{surface}_triangles"))?.data;
        let faces = corners.chunks_exact(3).map(|corners| [0, 1, 2].map(|k| corners[k] as usize));
        let faces: Vec<[usize; 3]> = faces.filter(|face| face.iter().all(|k| *k < this.points.len())).collect();
        if !is_convex(&this.points, &faces) {
            this.faces = faces;
        }
        Ok(this)
    }

    /// The areas that it covers at a time, as they are projected.
    pub fn areas(
        &self,
        time: f64,
        project: impl Fn(&Vec3) -> Point,
        hull: impl Fn(Vec<Point>) -> Vec<Point>,
    ) -> Vec<Vec<Point>> {
        let carried = self.motion.carriage(time);
        let seen: Vec<Point> = self.points.iter().map(|point| project(&carried.place(point))).collect();
        if self.faces.is_empty() {
            return vec![hull(seen)];
        }
        self.faces.iter().map(|face| face.map(|k| seen[k]).to_vec()).collect()
    }
}

/// Whether all points are behind all faces.
fn is_convex(points: &[Vec3], faces: &[[usize; 3]]) -> bool {
    let largest = points.iter().map(Vec3::amax).fold(0.0, f64::max);
    faces.iter().all(|face| {
        let [a, b, c] = face.map(|k| points[k]);
        let Some(normal) = (b - a).cross(&(c - a)).try_normalize(0.0) else { return true };
        points.iter().all(|point| (point - a).dot(&normal) <= ROUNDING * largest)
    })
}
