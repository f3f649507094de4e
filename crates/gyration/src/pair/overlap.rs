//! Two convex bodies that reach each other: how far, and which way apart.

use super::met::halves;
use super::separate::separate;
use super::side::Side;
use crate::kinematics::{Placement, Velocity};
use crate::surface::{GapField, Surface};
use crate::tensor::{Mat3, Vec3};
use std::f64::consts::PI;

/// Two bodies that no plane separates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// A way for A that separates them.
    pub normal: Vec3,
    /// How far along it [m]; of many ways tried, the shortest.
    pub depth: f64,
}

/// How many ways apart are tried.
const WAYS: usize = 2000;

/// A distance that cannot be told from zero, relative to the size and the distance of the centres.
const RESOLUTION: f64 = 64.0 * f64::EPSILON;

impl Overlap {
    /// Whether two convex bodies are apart.
    ///
    /// # Errors
    /// How they overlap.
    pub fn check(surfaces: [&Surface; 2], placements: [&Placement; 2]) -> Result<(), Self> {
        let velocity = Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
        let between = placements[0].position - placements[1].position;
        // |P X| is the speed of X under the gradient rate P.
        let size = [0, 1].map(|i| surfaces[i].fastest_point(&Vec3::zeros(), &placements[i].gradient));
        if between.norm() > size[0] + size[1] {
            return Ok(());
        }
        let [one, other] = [0, 1].map(|i| Side {
            surface: surfaces[i],
            placement: placements[i],
            from_first: placements[i].position - placements[0].position,
            velocity: &velocity,
            inverse: Mat3::identity(),
            deformation: None,
            least_gap: RESOLUTION * (size[i] + between.norm()),
        });
        let halves = halves([&one, &other], false);
        if separate(halves.each_ref()).is_ok() {
            return Ok(());
        }
        let depth = |normal: &Vec3| {
            let lowest = |i: usize, sign: f64| {
                let Placement { position, gradient } = placements[i];
                let height = sign * (position - placements[1].position).dot(normal);
                surfaces[i].smallest_gap(&GapField::new(height, sign * gradient.tr_mul(normal))).0
            };
            -(lowest(0, 1.0) + lowest(1, -1.0))
        };
        // Points of a spiral, as evenly as may be, and the line of the centres.
        let turn = PI * (3.0 - 5.0_f64.sqrt());
        let spiral = (0..WAYS).map(|k| {
            let z = 1.0 - (2 * k + 1) as f64 / WAYS as f64;
            let (sin, cos) = libm::sincos(turn * k as f64);
            let radius = (1.0 - z * z).sqrt();
            Vec3::new(radius * cos, radius * sin, z)
        });
        let axes = [Vec3::x(), -Vec3::x(), Vec3::y(), -Vec3::y(), Vec3::z(), -Vec3::z()];
        let ways = between.try_normalize(0.0).into_iter().chain(axes).chain(spiral);
        let found = ways.map(|normal| Self { normal, depth: depth(&normal) });
        let shortest = found.min_by(|one, other| one.depth.total_cmp(&other.depth));
        match shortest {
            // One of them separates the two.
            Some(found) if found.depth < -halves.iter().map(|half| half.side.least_gap).sum::<f64>() => Ok(()),
            found => Err(found.unwrap_or(Self { normal: Vec3::z(), depth: f64::NAN })),
        }
    }
}
