//! Surfaces of revolution about z as triangles of about equal size.
//!
//! A profile (radius, height) runs counter-clockwise around the half-section, from the lower pole to the upper one or
//! once around. Points stand on it a spacing s apart, and as far on the ring that each of them makes: a ring of radius
//! r has about 2πr/s of them, so that flat ends have no slivers; neighbouring rings are joined whatever their counts. s
//! is the smallest that keeps within the number of triangles asked for, unless the least numbers below take more.

use std::f64::consts::{PI, TAU};
use std::iter::successors;

use super::outline::{CIRCLE_POINTS, circle};
use super::triangulation::Triangulation;
use crate::tensor::Vec3;

/// Steps of half a turn of a profile, at least: a tube then has 16 sides.
const HALF_TURN: f64 = 8.0;
/// Points on the rings of a slanting wall, at least: its facets then meet at less than 15°.
const WALL_POINTS: usize = 24;
/// Points on any ring that is no pole, at least.
const FEWEST_POINTS: usize = 6;
/// By how much the spacing grows from trial to trial.
const GROWTH: f64 = 1.03;
/// How often at most: up to 10⁵ times the spacing of equilateral triangles, for needles and thin rings.
const TRIALS: usize = 400;

/// A stretch of a profile, in (radius, height) \[m\].
#[derive(Debug, Clone, Copy)]
pub(super) enum ProfileStretch {
    /// A straight line.
    Line {
        /// Where it begins.
        from: [f64; 2],
        /// Where it ends.
        to: [f64; 2],
    },
    /// A part of a circle, counter-clockwise.
    Arc {
        /// Its centre.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
        /// Where it begins and ends, from the direction of growing radius \[rad\].
        angles: [f64; 2],
    },
}

/// A circle of points about z; of radius 0 a pole.
#[derive(Debug, Clone, Copy)]
struct Ring {
    radius: f64,
    height: f64,
    points: usize,
}

impl ProfileStretch {
    fn length(&self) -> f64 {
        match *self {
            Self::Line { from, to } => libm::hypot(to[0] - from[0], to[1] - from[1]),
            Self::Arc { radius, angles, .. } => radius * (angles[1] - angles[0]),
        }
    }

    /// The place at a fraction of the length. Ends are met exactly: neighbours share them.
    fn at(&self, fraction: f64) -> [f64; 2] {
        match *self {
            Self::Line { to, .. } if fraction == 1.0 => to,
            Self::Line { from, to } => [0, 1].map(|k| from[k] + (to[k] - from[k]) * fraction),
            Self::Arc { center, radius, angles } => {
                let (sine, cosine) = libm::sincos(angles[0] + (angles[1] - angles[0]) * fraction);
                // An arc that ends at a pole does so exactly.
                let across = if cosine.abs() < 4.0 * f64::EPSILON { 0.0 } else { cosine };
                [center[0] + radius * across, center[1] + radius * sine]
            }
        }
    }

    fn steps(&self, spacing: f64) -> usize {
        let steps = (self.length() / spacing).round();
        let least = match *self {
            Self::Line { .. } => 1.0,
            Self::Arc { angles, .. } => (HALF_TURN * (angles[1] - angles[0]) / PI).ceil(),
        };
        steps.max(least) as usize
    }

    /// Points on its rings, at least.
    fn fewest_points(&self) -> usize {
        match self {
            Self::Line { from, to } if from[1] != to[1] => WALL_POINTS,
            _ => FEWEST_POINTS,
        }
    }
}

/// The surface that a profile makes, in about `count` triangles.
pub(super) fn turned(profile: &[ProfileStretch], count: usize) -> Triangulation {
    let area = profile.iter().map(|stretch| TAU * stretch.length() * stretch.at(0.5)[0]).sum::<f64>();
    // The side of `count` equilateral triangles of the same area, and a little less, since counts are rounded.
    let first = 0.95 * (4.0 * area / (3.0_f64.sqrt() * count as f64)).sqrt();
    let trials = successors(Some(first), |spacing| Some(spacing * GROWTH)).take(TRIALS);
    let mut found = Vec::new();
    for spacing in trials {
        found = rings(profile, spacing);
        if triangles(&found) <= count {
            break;
        }
    }
    joined(&found)
}

/// The point of the wall, or of the end, of a cylinder or cone over a point `flat` of a triangle.
///
/// Its height and azimuth are those of `flat`; its distance from the axis is the mean of the corners': exact on a
/// straight wall, and a chord of a rim becomes an arc of it.
pub(super) fn over_wall(corners: &[Vec3; 3], weights: &[f64; 3], flat: &Vec3) -> Vec3 {
    let radius: f64 = corners.iter().zip(weights).map(|(corner, weight)| weight * corner.xy().norm()).sum();
    let inside = flat.xy().norm();
    // On the axis there is nothing to stretch.
    let stretch = if inside > 0.0 { radius / inside } else { 1.0 };
    Vec3::new(flat.x * stretch, flat.y * stretch, flat.z)
}

/// The rings of a profile, one a point; the last is left out where it is the first again.
fn rings(profile: &[ProfileStretch], spacing: f64) -> Vec<Ring> {
    let widest = profile.iter().flat_map(|stretch| [0.0, 0.5, 1.0].map(|fraction| stretch.at(fraction)[0]));
    // The widest ring is round to the eye.
    let around = spacing.min(TAU * widest.fold(0.0, f64::max) / CIRCLE_POINTS as f64);
    let mut rings: Vec<Ring> = Vec::new();
    for stretch in profile {
        let (steps, fewest) = (stretch.steps(spacing), stretch.fewest_points());
        for step in 0..=steps {
            let [radius, height] = stretch.at(step as f64 / steps as f64);
            let points = match radius {
                0.0 => 1,
                radius => ((TAU * radius / around).round() as usize).max(fewest),
            };
            match rings.last_mut() {
                // Where two stretches meet the finer one counts.
                Some(last) if step == 0 => last.points = last.points.max(points),
                _ => rings.push(Ring { radius, height, points }),
            }
        }
    }
    rings
}

/// How many triangles join the rings.
fn triangles(rings: &[Ring]) -> usize {
    rings.windows(2).map(|pair| sides(&pair[0]) + sides(&pair[1])).sum()
}

/// The chords of a ring; a pole has none.
fn sides(ring: &Ring) -> usize {
    if ring.points == 1 { 0 } else { ring.points }
}

/// Joins neighbouring rings; a profile without poles is closed, and its last ring is its first.
fn joined(rings: &[Ring]) -> Triangulation {
    let mut surface = Triangulation::default();
    let closed = rings.first().is_some_and(|ring| ring.points > 1);
    let distinct = rings.len() - usize::from(closed);
    let mut first = Vec::with_capacity(rings.len());
    for ring in &rings[..distinct] {
        first.push(surface.points.len());
        surface.points.extend(circle(ring.points, ring.radius, ring.height));
    }
    first.extend(closed.then_some(0));
    for (k, pair) in rings.windows(2).enumerate() {
        join(&mut surface.triangles, [first[k], first[k + 1]], [pair[0].points, pair[1].points]);
    }
    surface
}

/// The triangles between two rings, by the angle of the middle of the next chord of each.
fn join(triangles: &mut Vec<[usize; 3]>, first: [usize; 2], points: [usize; 2]) {
    let [lower, upper] = [0, 1].map(|ring| move |k: usize| first[ring] + k % points[ring]);
    let chords = points.map(|count| if count == 1 { 0 } else { count });
    let (mut i, mut j) = (0, 0);
    while i < chords[0] || j < chords[1] {
        let along_lower = j == chords[1] || (i < chords[0] && (2 * i + 1) * chords[1] <= (2 * j + 1) * chords[0]);
        if along_lower {
            triangles.push([lower(i), lower(i + 1), upper(j)]);
            i += 1;
        } else {
            triangles.push([lower(i), upper(j + 1), upper(j)]);
            j += 1;
        }
    }
}
