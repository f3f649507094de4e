//! A smooth primitive somewhere in a body: X = offset + Q Y.
//!
//! Moments are computed in the primitive's frame, where the gap is g₀' + m'·Y with g₀' = g₀ + m·offset, m' = Qᵀm, and
//! taken back by `Moments::transformed`, the only place where tensors change frame. Support points give the smallest
//! gap, and the fastest point by an ascent: the speed |v + A X| is convex in X, so that replacing X by the support
//! point along its gradient Aᵀ(v + A X) never lowers it.

use super::half_plane::AffineMap;
use super::rules::integrand::GROUP;
use super::rules::weight::{AREA, Deformed, Weighted, Weights};
use super::{ConeWall, CylinderWall, Disk, Ellipsoid, Hemisphere, Sphere, Torus};
use crate::surface::oriented::{FOURTH, PAIRS};
use crate::surface::{GapClosed, GapField, Kernel, MomentPlan, MomentRequest, Moments, OrientedMoments};
use crate::tensor::{Mat3, Vec3};

/// The smooth surfaces that contact knows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Primitive {
    /// A whole sphere.
    Sphere(Sphere),
    /// The upper half of a sphere.
    Hemisphere(Hemisphere),
    /// A whole ellipsoid.
    Ellipsoid(Ellipsoid),
    /// The wall of a cylinder.
    CylinderWall(CylinderWall),
    /// A flat disk, one side of it.
    Disk(Disk),
    /// The wall of a cone.
    ConeWall(ConeWall),
    /// A torus.
    Torus(Torus),
}

/// A primitive with its place in the body: X = offset + rotation · Y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// The surface in its own frame.
    pub primitive: Primitive,
    /// The place of its origin [m].
    pub offset: Vec3,
    /// Q, from its frame to the body's.
    pub rotation: Mat3,
}

impl Patch {
    /// The primitive in its own frame.
    pub fn new(primitive: Primitive) -> Self {
        Self { primitive, offset: Vec3::zeros(), rotation: Mat3::identity() }
    }

    /// The same patch after X ↦ rotation · X + offset.
    pub fn transformed(&self, rotation: &Mat3, offset: &Vec3) -> Self {
        Self { offset: rotation * self.offset + offset, rotation: rotation * self.rotation, ..*self }
    }

    /// The same patch moved along z.
    pub fn lifted(&self, by: f64) -> Self {
        self.transformed(&Mat3::identity(), &Vec3::new(0.0, 0.0, by))
    }

    /// The normal of a flat one, up to its sign.
    pub(crate) fn flat_normal(&self) -> Option<Vec3> {
        match &self.primitive {
            Primitive::Disk(_) => Some(self.rotation.column(2).into_owned()),
            Primitive::Sphere(_)
            | Primitive::Hemisphere(_)
            | Primitive::Ellipsoid(_)
            | Primitive::CylinderWall(_)
            | Primitive::ConeWall(_)
            | Primitive::Torus(_) => None,
        }
    }

    /// Area [m²].
    pub fn area(&self) -> f64 {
        match &self.primitive {
            Primitive::Sphere(p) => p.area(),
            Primitive::Hemisphere(p) => p.area(),
            Primitive::Ellipsoid(p) => p.area(),
            Primitive::CylinderWall(p) => p.area(),
            Primitive::Disk(p) => p.area(),
            Primitive::ConeWall(p) => p.area(),
            Primitive::Torus(p) => p.area(),
        }
    }

    /// The radius [m] of a sphere about the origin of X; none of any other patch.
    pub fn ball(&self) -> Option<f64> {
        match &self.primitive {
            Primitive::Sphere(sphere) if self.offset == Vec3::zeros() => Some(sphere.radius),
            _ => None,
        }
    }

    /// The point X of the patch that is farthest along `direction`.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        let own = || self.rotation.tr_mul(direction);
        let point = match &self.primitive {
            // A sphere has no attitude.
            Primitive::Sphere(p) => return self.offset + p.support(direction),
            Primitive::Hemisphere(p) => p.support(&own()),
            Primitive::Ellipsoid(p) => p.support(&own()),
            Primitive::CylinderWall(p) => p.support(&own()),
            Primitive::Disk(p) => p.support(&own()),
            Primitive::ConeWall(p) => p.support(&own()),
            Primitive::Torus(p) => p.support(&own()),
        };
        self.offset + self.rotation * point
    }

    /// Adds the moments about the origin of X; every gap on the patch must be positive.
    pub(crate) fn add_moments(&self, field: &GapField, plan: &MomentPlan, out: &mut [Moments]) {
        if let Primitive::Sphere(sphere) = &self.primitive {
            // A sphere has no attitude, and is so cheap that a change of frame would double its cost.
            return sphere.add_moments(&self.offset, field, plan, out);
        }
        let own = GapField::new(field.gap(&self.offset), self.rotation.tr_mul(&field.direction));
        let lines = plan.lines().chunks(GROUP).zip(plan.widening_lines().chunks(GROUP));
        for ((requests, out), (lines, widening)) in plan.requests().chunks(GROUP).zip(out.chunks_mut(GROUP)).zip(lines)
        {
            let mut sums = [Moments::default(); GROUP];
            let sums = &mut sums[..requests.len()];
            let map = match &self.primitive {
                Primitive::Sphere(_) => unreachable!("a sphere has been added"),
                Primitive::Hemisphere(p) => p.moments(&own, requests, lines, sums),
                Primitive::Ellipsoid(p) => p.moments(&own, requests, sums),
                Primitive::CylinderWall(p) => p.moments(&own, requests, lines, sums),
                Primitive::Disk(p) => p.moments(&own, requests, sums),
                Primitive::ConeWall(p) => p.moments(&own, requests, widening, sums),
                Primitive::Torus(p) => p.moments(&own, requests, sums),
            };
            let (linear, offset) = self.map_to_body(&map);
            for ((sum, request), moments) in sums.iter().zip(requests).zip(out) {
                moments.add(&sum.transformed(&linear, &offset, request.order), request.order);
            }
        }
    }

    /// Adds the moments per deformed area; arguments as for `Surface::deformed_moments`.
    pub(crate) fn add_deformed(
        &self,
        field: &GapField,
        cofactor: &Mat3,
        requests: &[MomentRequest],
        out: &mut [Moments],
    ) {
        for (requests, out) in requests.chunks(GROUP).zip(out.chunks_mut(GROUP)) {
            let [sums] = self.weighted(field, cofactor, AREA, requests);
            for ((out, sum), request) in out.iter_mut().zip(&sums).zip(requests) {
                out.add(sum, request.order);
            }
        }
    }

    /// Adds the moments weighted with products of the current normal; arguments as for `Surface::oriented_moments`.
    pub(crate) fn add_oriented(
        &self,
        field: &GapField,
        cofactor: &Mat3,
        requests: &[MomentRequest],
        out: &mut [OrientedMoments],
    ) {
        for (requests, out) in requests.chunks(GROUP).zip(out.chunks_mut(GROUP)) {
            self.add_group(field, cofactor, requests, out);
        }
    }

    /// Adds the oriented moments of at most [`GROUP`] requests.
    fn add_group(&self, field: &GapField, cofactor: &Mat3, requests: &[MomentRequest], out: &mut [OrientedMoments]) {
        for (pair, sums) in self.weighted(field, cofactor, Weights { factors: PAIRS }, requests).iter().enumerate() {
            for ((out, sum), request) in out.iter_mut().zip(sums).zip(requests) {
                out.pairs[pair].add(sum, request.order);
            }
        }
        // Only requests of order 0 have a fourth power.
        let mut scalars = [MomentRequest { kernel: Kernel::Log, order: 0 }; GROUP];
        let mut count = 0;
        for request in requests.iter().filter(|request| request.order == 0) {
            scalars[count] = *request;
            count += 1;
        }
        if count == 0 {
            return;
        }
        let weights = Weights { factors: FOURTH };
        for (place, sums) in self.weighted(field, cofactor, weights, &scalars[..count]).iter().enumerate() {
            let places = out.iter_mut().zip(requests).filter(|(_, request)| request.order == 0);
            for ((out, _), sum) in places.zip(sums) {
                out.fourth[place] += sum.zeroth;
            }
        }
    }

    /// The moments of at most [`GROUP`] requests with each of the weights, about the origin of X; every gap on the
    /// patch must be positive.
    fn weighted<const N: usize, const W: usize>(
        &self,
        field: &GapField,
        cofactor: &Mat3,
        weights: Weights<N, W>,
        requests: &[MomentRequest],
    ) -> Weighted<W> {
        let height = field.gap(&self.offset);
        let own = GapField::new(height, self.rotation.tr_mul(&field.direction));
        // Takes the reference normal in the own frame to the current area vector.
        let deformed = Deformed { field: own, cofactor: cofactor * self.rotation, weights };
        let mut sums = [[Moments::default(); GROUP]; W];
        let map = match &self.primitive {
            Primitive::Sphere(p) => p.deformed_moments(&deformed, requests, &mut sums),
            Primitive::Hemisphere(p) => p.deformed_moments(&deformed, requests, &mut sums),
            Primitive::Ellipsoid(p) => p.deformed_moments(&deformed, requests, &mut sums),
            Primitive::CylinderWall(p) => p.deformed_moments(&deformed, requests, &mut sums),
            Primitive::Disk(p) => p.deformed_moments(&deformed, requests, &mut sums),
            Primitive::ConeWall(p) => p.deformed_moments(&deformed, requests, &mut sums),
            Primitive::Torus(p) => p.deformed_moments(&deformed, requests, &mut sums),
        };
        let (linear, offset) = self.map_to_body(&map);
        for (sum, request) in sums.iter_mut().flat_map(|sums| sums.iter_mut().zip(requests)) {
            *sum = sum.transformed(&linear, &offset, request.order);
        }
        sums
    }

    /// The linear part and the offset of a primitive's map, on to the body's frame.
    fn map_to_body(&self, map: &AffineMap) -> (Mat3, Vec3) {
        (self.rotation * map.linear, self.offset + self.rotation * map.offset)
    }

    /// Whether its moments keep the digits of a gap far below its size.
    pub(crate) fn keeps_digits(&self) -> bool {
        matches!(self.primitive, Primitive::Sphere(_))
    }

    /// The smallest gap [m] on the patch.
    pub(crate) fn smallest_gap(&self, field: &GapField) -> f64 {
        match &self.primitive {
            Primitive::Sphere(sphere) => sphere.gaps(&self.offset, field).0,
            _ => field.gap(&self.support(&-field.direction)),
        }
    }

    /// Refuses a field whose smallest gap on the patch is not a positive finite number beyond rounding.
    pub(crate) fn check_gap(&self, field: &GapField) -> Result<(), GapClosed> {
        let gap = self.smallest_gap(field);
        let fall = gap - field.height;
        // A gap within the rounding of its two terms has no known sign.
        let digits = if self.keeps_digits() && field.lack.is_some() { f64::EPSILON } else { 1.0 };
        let rounding = 16.0 * f64::EPSILON * digits * (field.height.abs() + fall.abs());
        if gap.is_finite() && gap > rounding { Ok(()) } else { Err(GapClosed { gap }) }
    }

    /// The largest |v + A X| over the patch, by ascents from seven starts.
    pub(crate) fn fastest_point(&self, v: &Vec3, a: &Mat3) -> f64 {
        let starts = [Vec3::x(), Vec3::y(), Vec3::z()].into_iter().flat_map(|axis| [axis, -axis]);
        let ascents = std::iter::once(a.tr_mul(v)).chain(starts).map(|start| self.ascend(v, a, &start));
        ascents.fold(0.0, f64::max)
    }

    /// One ascent of |v + A X| from the support point along `start`.
    fn ascend(&self, v: &Vec3, a: &Mat3, start: &Vec3) -> f64 {
        /// Steps after which an ascent stops; a flat maximum is by then known well, its place is not needed.
        const MOST_STEPS: usize = 60;
        let mut velocity = v + a * self.support(start);
        for _ in 0..MOST_STEPS {
            let next = v + a * self.support(&a.tr_mul(&velocity));
            let gain = next.norm_squared() - velocity.norm_squared();
            if gain <= 1e-14 * next.norm_squared() {
                break;
            }
            velocity = next;
        }
        velocity.norm()
    }
}
