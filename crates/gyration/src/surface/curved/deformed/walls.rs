//! Moments over the deformed walls of cylinders and cones.
//!
//! The normal is the same all along a ruling, N = n_r (cos φ e_x + sin φ e_y) + n_z e_z, so that a weight w(C N)
//! depends on the azimuth only and the integrals along rulings are those of the undeformed wall. It is not even in φ:
//! with w± = ½ (w(φ) ± w(−φ)), w₊ weights what is even in y (the sums of `rulings` as ever), w₋ sin φ what is odd in
//! it,
//!
//!   ∫ κ w y x^i z^j … ← Σ w₋ sin φ · T L_j,   T = 1, cos φ, cos²φ, sin²φ.

use super::super::half_plane::{AffineMap, TiltedGap};
use super::super::rules::integrand::Integrand;
use super::super::rules::own_ring::{Dips, OwnRing, WEIGHT_DIGITS};
use super::super::rules::parallels::AreaElement;
use super::super::rules::ring::Demand;
use super::super::rules::rulings::{OtherEnd, Rulings};
use super::super::rules::weight::{Deformed, Weighted, extra_digits};
use super::super::rules::weighted_rulings::WallWeights;
use super::super::{ConeWall, CylinderWall};
use super::ellipsoid::principal_axes;
use crate::surface::MomentRequest;
use crate::tensor::{Mat3, Vec3};

/// A wall about e_z above a plane.
struct DeformedWall {
    /// C in the frame of [`TiltedGap`].
    vectors: Mat3,
    /// n_r and n_z.
    normal: (f64, f64),
    near: f64,
    reach: f64,
    /// The gap of the base from which on rulings are negligible.
    cut: f64,
}

impl DeformedWall {
    /// The rule around the axis for weights with N factors.
    fn ring<const N: usize>(&self, integrand: &Integrand) -> OwnRing {
        let (radial, axial) = self.normal;
        let demand = Demand { sharpest: integrand.sharpest, mildest: integrand.mildest, degree: integrand.order + 1 };
        let (squares, _) = principal_axes(&self.vectors.tr_mul(&self.vectors));
        let element = AreaElement::deformed(&self.vectors, &squares);
        let dips = Dips {
            distance: element.decay(axial * axial, radial * radial),
            mildness: if self.cut.is_finite() { (integrand.mildest - 1.5).max(0.0) } else { 0.0 },
            digits: WEIGHT_DIGITS + extra_digits::<N>(),
        };
        OwnRing::new((self.near, self.near + 2.0 * self.reach), &demand, &dips)
    }

    /// The sums over the rulings in this ring.
    fn rulings<'a>(&self, ring: &'a OwnRing, other_end: OtherEnd) -> Rulings<'a> {
        Rulings { ring: ring.chunks(), near: self.near, reach: self.reach, cut: self.cut, other_end }
    }

    /// v = z + cos φ x + sin φ y.
    fn area_vectors(&self) -> [Vec3; 3] {
        let (radial, axial) = self.normal;
        let column = |k: usize, scale: f64| scale * self.vectors.column(k);
        [column(0, radial), column(1, radial), column(2, axial)]
    }
}

impl CylinderWall {
    /// Sums the moments in the frame of [`TiltedGap`]; every gap must be positive.
    pub(crate) fn deformed_moments<const N: usize, const W: usize>(
        &self,
        deformed: &Deformed<N, W>,
        requests: &[MomentRequest],
        out: &mut Weighted<W>,
    ) -> AffineMap {
        let gap = TiltedGap::new(&deformed.field);
        let integrand = Integrand::new(requests);
        let near_z = -0.5f64.copysign(gap.along) * self.height;
        let reach = self.radius * gap.across;
        let near = gap.height + gap.along * near_z - reach;
        let cut = integrand.cut(near, 1.5);
        let wall = DeformedWall { vectors: deformed.cofactor * gap.frame, normal: (1.0, 0.0), near, reach, cut };
        let ring = wall.ring::<N>(&integrand);
        let rulings = wall.rulings(&ring, OtherEnd::Above(gap.along.abs() * self.height));
        let weights = WallWeights { vectors: wall.area_vectors(), weights: &deformed.weights };
        for (place, request) in requests.iter().enumerate() {
            for (out, [even, odd]) in out.iter_mut().zip(&rulings.weighted_sums(request, &weights)) {
                self.collect(even, near_z, &mut out[place]);
                self.collect_odd(odd, near_z, &mut out[place]);
            }
        }
        AffineMap::frame(gap.frame)
    }
}

impl ConeWall {
    /// Sums the moments about the apex in the frame of [`TiltedGap`]; every gap must be positive.
    pub(crate) fn deformed_moments<const N: usize, const W: usize>(
        &self,
        deformed: &Deformed<N, W>,
        requests: &[MomentRequest],
        out: &mut Weighted<W>,
    ) -> AffineMap {
        let gap = TiltedGap::new(&deformed.field);
        let integrand = Integrand::new(requests);
        let reach = self.radius * gap.across;
        let apex = gap.height + 0.5 * gap.along * self.height;
        let near = gap.height - 0.5 * gap.along * self.height - reach;
        let cut = integrand.cut(near, 1.5);
        let cut = if cut < apex { cut } else { f64::INFINITY };
        let slant = libm::hypot(self.radius, self.height);
        let normal = (self.height / slant, self.radius / slant);
        let wall = DeformedWall { vectors: deformed.cofactor * gap.frame, normal, near, reach, cut };
        let ring = wall.ring::<N>(&integrand);
        let rulings = wall.rulings(&ring, OtherEnd::Common(apex));
        let weights = WallWeights { vectors: wall.area_vectors(), weights: &deformed.weights };
        for (place, request) in requests.iter().enumerate() {
            for (out, [even, odd]) in out.iter_mut().zip(&rulings.weighted_sums(request, &weights)) {
                self.collect(even, &mut out[place]);
                self.collect_odd(odd, &mut out[place]);
            }
        }
        AffineMap { linear: gap.frame, offset: Vec3::new(0.0, 0.0, 0.5 * self.height) }
    }
}
