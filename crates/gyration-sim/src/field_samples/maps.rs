//! Maps of a recording: its fields over one layer through the bodies, sample by sample.

use super::layer::FieldLayer;
use super::source::FieldSource;
use super::widths::{MOST_ON_PAGE, Widths};
use super::{FieldGrid, NoFields, averaged};
use crate::fields::FIELD_SCALARS;
use gyration::tensor::Vec3;
use gyration_record::Recording;

/// Points of a map lie half a width apart: between them the Gaussian is as good as straight.
const SPACING: f64 = 0.5;
/// No map has more points along a side.
const MOST_POINTS: f64 = 96.0;
/// A side that is longer by no more than this part of the shortest is as short.
const AS_SHORT: f64 = 0.1;
/// Distances of nearest neighbours to a width, where none is given.
const USUAL_DISTANCES: f64 = 2.0;
/// Bodies whose nearest neighbours are looked for.
const ASKED: usize = 400;

/// The maps of a recording: fields of any of its samples over one layer through the bodies of all.
#[derive(Debug)]
pub struct FieldMaps {
    source: FieldSource,
    /// The corners of the box of all centres \[m\].
    corners: [Vec3; 2],
    widths: Widths,
    usual_width: f64,
}

/// The fields of a sample over a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldMap {
    /// The time \[s\].
    pub time: f64,
    /// The points, one along the axis that leads out of the layer.
    pub grid: FieldGrid,
    /// The axes of the layer, the one fastest among points first.
    pub along: [usize; 2],
    /// Of each of [`FIELD_SCALARS`] the value at each point; not a number where there is none.
    pub values: Vec<Vec<f64>>,
}

impl FieldMaps {
    /// Of the samples that a recording has now.
    ///
    /// # Errors
    /// [`NoFields`].
    pub fn of(recording: &Recording) -> Result<Self, NoFields> {
        let source = FieldSource::open(recording)?;
        let corners = source.corners()?;
        let first = source.first_places()?;
        let sizes = source.replay.model().bodies.iter().map(|body| body.size).fold(0.0, f64::max);
        let widths = Widths::of(&source.replay, &corners, MOST_ON_PAGE);
        let usual_width = mean_distance(&first).map_or(sizes, |distance| USUAL_DISTANCES * distance);
        Ok(Self { source, corners, widths, usual_width: usual_width.min(widths.widest()) })
    }

    /// Twice the mean distance of nearest neighbours in the first sample, images aside; the size of the largest body
    /// where there are none; in a ring no more than can be had \[m\].
    pub fn usual_width(&self) -> f64 {
        self.usual_width
    }

    /// The fields of a sample, with weights of a width \[m\]: in the middle of the box of all centres and two widths
    /// beyond, over its two longest sides.
    ///
    /// # Errors
    /// [`NoFields`].
    pub fn map(&mut self, row: usize, width: f64) -> Result<FieldMap, NoFields> {
        let sample = self.source.sample(row)?;
        let weight = self.widths.weight(width)?;
        let grid = FieldGrid::over(&self.corners, width, |sides| counts(sides, width));
        let (_, along) = FieldLayer::axes(&grid.counts);
        let points = grid.points();
        let fields = averaged(&sample, &points, &weight)?;
        let values = FIELD_SCALARS.iter().map(|scalar| scalar.values(&fields)).collect();
        Ok(FieldMap { time: sample.time, grid, along, values })
    }
}

/// Points along the sides of a box, one along the shortest: of sides as short along y, which leads towards who looks,
/// then along z.
fn counts(sides: &Vec3, width: f64) -> [usize; 3] {
    let shortest = sides.min();
    let through = [1, 2, 0].into_iter().find(|axis| sides[*axis] <= (1.0 + AS_SHORT) * shortest).unwrap_or(2);
    let spacing = (SPACING * width).max(sides.max() / (MOST_POINTS - 1.0));
    let along = |axis: usize| ((sides[axis] / spacing).round() as usize + 1).max(2);
    std::array::from_fn(|axis| if axis == through { 1 } else { along(axis) })
}

/// The mean distance of bodies from the nearest other one, of some bodies where there are many \[m\]; none where all
/// are in one place.
fn mean_distance(places: &[Vec3]) -> Option<f64> {
    let asked = || places.iter().enumerate().step_by(places.len().div_ceil(ASKED).max(1));
    let nearest = |(body, place): (usize, &Vec3)| {
        let others = places.iter().enumerate().filter(|(other, _)| *other != body);
        others.map(|(_, other)| (other - place).norm()).fold(f64::INFINITY, f64::min)
    };
    let mean = asked().map(nearest).sum::<f64>() / asked().count() as f64;
    (mean > 0.0 && mean.is_finite()).then_some(mean)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_has_points_half_a_width_apart_as_long_as_there_are_few() {
        assert_eq!(counts(&Vec3::new(4.0, 0.8, 2.0), 0.2), [41, 1, 21]);
        // As long as wide: the map faces who looks. A chain is seen on a strip.
        assert_eq!(counts(&Vec3::new(1.0, 1.05, 1.0), 0.2), [11, 1, 11]);
        assert_eq!(counts(&Vec3::new(100.0, 0.8, 0.8), 0.2), [96, 1, 2]);
        assert_eq!(counts(&Vec3::new(2.0, 2.0, 0.8), 0.2), [21, 21, 1]);
    }

    #[test]
    fn neighbours_are_as_far_apart_as_they_are() {
        let places: Vec<Vec3> = (0..1000).map(|n| Vec3::x() * f64::from(n) * 0.3).collect();
        assert!((mean_distance(&places).unwrap() - 0.3).abs() < 1e-12);
        assert_eq!([mean_distance(&places[..1]), mean_distance(&[places[0]; 3])], [None, None]);
        assert_eq!(mean_distance(&[]), None);
    }
}
