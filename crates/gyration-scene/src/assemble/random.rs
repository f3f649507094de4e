//! Random places of copies, none nearer than a gap to another.
//!
//! Copies come one by one. The centre of each is drawn uniformly in the box until its bounding sphere, wider by the
//! gap, is clear of the spheres of those before it, and of the surfaces of what they have contacts with (random
//! sequential addition). A sphere holds its body however this is turned, so that rotations are drawn apart:
//!
//!   q = (√(1−a) sin 2πb, √(1−a) cos 2πb, √a sin 2πc, √a cos 2πc)
//!
//! is uniform for a, b, c uniform in [0, 1) (Shoemake 1992). Numbers come from ChaCha with 8 rounds, by the seed alone.

use super::start::stretch;
use crate::file::RandomCopies;
use crate::places::CopyPlace;
use crate::quantity::si;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use gyration::body::Solid;
use gyration::kinematics::{Placement, Quaternion};
use gyration::neighbours::{Bounds, BoxTree};
use gyration::pair::Overlap;
use gyration::shape::{Shape, Sphere};
use gyration::support::Support;
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3};
use std::f64::consts::TAU;

/// How often a place is drawn for a copy.
const MOST_DRAWS: usize = 10_000;

/// What copies must keep clear of.
#[derive(Debug, Default)]
pub(super) struct Around<'a> {
    planes: Vec<&'a Support>,
    solids: Vec<(&'a Solid, Placement)>,
    /// The boxes of the solids, by their places among these.
    boxes: BoxTree,
}

impl<'a> Around<'a> {
    /// Adds a plane, of which they must be above.
    pub(super) fn plane(&mut self, plane: &'a Support) {
        self.planes.push(plane);
    }

    /// Adds a solid that has a surface.
    pub(super) fn solid(&mut self, solid: &'a Solid, placement: Placement) {
        let Some(radius) = solid.radius() else { return };
        let bounds = Bounds::about(&placement.position, stretch(&placement.gradient) * radius);
        self.boxes.insert(bounds, self.solids.len());
        self.solids.push((solid, placement));
    }

    /// Whether a ball of this radius \[m\] at a place is clear of all.
    fn is_clear_of(&self, ball: &Surface, center: &Vec3, radius: f64) -> bool {
        if self.planes.iter().any(|plane| plane.gap(center, 0.0) <= radius) {
            return false;
        }
        let here = Placement { position: *center, gradient: Mat3::identity() };
        self.boxes.touching(&Bounds::about(center, radius)).all(|index| {
            let (solid, placement) = &self.solids[index];
            let parts = (0..solid.count_parts()).map(|part| solid.part(part));
            parts.into_iter().all(|part| Overlap::check([ball, part], [&here, placement]).is_ok())
        })
    }
}

/// What places are drawn for.
pub(super) struct RandomPlaces<'a> {
    pub(super) written: &'a RandomCopies,
    /// Of the bounding sphere of a copy \[m\].
    pub(super) radius: f64,
    /// The position of the body as it is written \[m\].
    pub(super) position: Vec3,
    pub(super) around: &'a Around<'a>,
}

impl RandomPlaces<'_> {
    /// The places.
    ///
    /// # Errors
    /// How many copies have found one, where no draw brings another.
    pub(super) fn draw(&self) -> Result<Vec<CopyPlace>, usize> {
        let Self { written, radius, position, around } = self;
        let (count, gap) = (written.count.0 as usize, written.gap.value());
        let mut numbers = Uniform(ChaCha8Rng::seed_from_u64(written.seed.0 as u64));
        let [low, high]: [Vec3; 2] = written.bounds.each_ref().map(si);
        let (apart, clear) = (2.0 * radius + gap, radius + gap);
        // What has no surface has no contacts either.
        let ball = if clear > 0.0 { Shape::Sphere(Sphere { radius: clear }).surface() } else { None };
        let mut centers: Vec<Vec3> = Vec::with_capacity(count);
        let mut tree = BoxTree::default();
        let mut places = Vec::with_capacity(count);
        for number in 0..count {
            let is_free = |displacement: &Vec3| {
                let center = position + displacement;
                let bounds = Bounds::about(&center, apart);
                tree.touching(&bounds).all(|other| (centers[other] - center).norm() > apart)
                    && ball.as_ref().is_none_or(|ball| around.is_clear_of(ball, &center, clear))
            };
            let mut draws = (0..MOST_DRAWS).map(|_| low + (high - low).component_mul(&numbers.vector()));
            let displacement = draws.find(is_free).ok_or(number)?;
            let center = position + displacement;
            tree.insert(Bounds::about(&center, 0.0), number);
            centers.push(center);
            let turn = written.turn.then(|| numbers.rotation());
            places.push(CopyPlace { displacement, turn, ..CopyPlace::default() });
        }
        Ok(places)
    }
}

/// Numbers uniform in [0, 1).
struct Uniform(ChaCha8Rng);

impl Uniform {
    fn number(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * 0.5_f64.powi(53)
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::from([0; 3].map(|_| self.number()))
    }

    fn rotation(&mut self) -> Quaternion {
        let [a, b, c] = self.vector().into();
        let ((sin_b, cos_b), (sin_c, cos_c)) = (libm::sincos(TAU * b), libm::sincos(TAU * c));
        let (first, second) = ((1.0 - a).sqrt(), a.sqrt());
        Quaternion([first * sin_b, first * cos_b, second * sin_c, second * cos_c])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rotation_is_as_likely() {
        let mut numbers = Uniform(ChaCha8Rng::seed_from_u64(3));
        const COUNT: usize = 20_000;
        let mut mean = Mat3::zeros();
        let mut squares = Mat3::zeros();
        for _ in 0..COUNT {
            let q = numbers.rotation();
            assert!((q.norm() - 1.0).abs() < 1e-15);
            let rotation = q.rotation();
            mean += rotation / COUNT as f64;
            squares += rotation.component_mul(&rotation) / COUNT as f64;
        }
        // Of a uniform rotation ⟨R_ij⟩ = 0, ⟨R_ij²⟩ = 1/3 with variances 1/3 and 4/45: five deviations of the means.
        let (first, second) = (5.0 * (1.0 / 3.0 / COUNT as f64).sqrt(), 5.0 * (4.0 / 45.0 / COUNT as f64).sqrt());
        println!("largest mean {:.4} of {first:.4}", mean.amax());
        assert!(mean.amax() < first, "{mean}");
        assert!((squares - Mat3::repeat(1.0 / 3.0)).amax() < second, "{squares}");
    }
}
