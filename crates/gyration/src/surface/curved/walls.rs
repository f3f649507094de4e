//! Moments over the deformed walls of cylinders and cones.
//!
//! The normal is the same all along a ruling, N = n_r (cos φ e_x + sin φ e_y) + n_z e_z, so that a weight w(C N) depends on
//! the azimuth only and the integrals along rulings are those of the undeformed wall. It is not even in φ: with
//! w± = ½ (w(φ) ± w(−φ)), w₊ weights what is even in y (the sums of `rulings` as ever), w₋ sin φ what is odd in it,
//!
//!   ∫ κ w y x^i z^j … ← Σ w₋ sin φ · T L_j,   T = 1, cos φ, cos²φ, sin²φ.

use super::super::{MomentRequest, Moments};
use super::half_plane::{Chart, TiltedGap};
use super::image::principal_axes;
use super::integrand::Integrand;
use super::own_ring::{Dips, OwnRing, WEIGHT_DIGITS};
use super::parallels::AreaElement;
use super::ring::{Demand, RingChunk};
use super::rulings::{OtherEnd, Rulings};
use super::weight::{Deformed, Product};
use super::{ConeWall, CylinderWall};
use crate::tensor::{Mat3, Vec3};

/// A wall about e_z above a plane.
struct Wall<'a, const N: usize> {
    weight: &'a Product<N>,
    /// C in the frame of [`TiltedGap`].
    vectors: Mat3,
    /// n_r and n_z.
    normal: (f64, f64),
    near: f64,
    reach: f64,
    /// The gap of the base from which on rulings are negligible.
    cut: f64,
}

impl<const N: usize> Wall<'_, N> {
    /// The rules of what is even and what is odd in the azimuth.
    fn rings(&self, integrand: &Integrand) -> [OwnRing; 2] {
        let (radial, axial) = self.normal;
        let demand = Demand { sharpest: integrand.sharpest, mildest: integrand.mildest, degree: integrand.order + N };
        let (squares, _) = principal_axes(&self.vectors.tr_mul(&self.vectors));
        let element = AreaElement::deformed(&self.vectors, &squares);
        let dips = Dips {
            distance: element.decay(axial * axial, radial * radial),
            mildness: if self.cut.is_finite() { (integrand.mildest - 1.5).max(0.0) } else { 0.0 },
            digits: WEIGHT_DIGITS + Product::<N>::EXTRA_DIGITS,
        };
        let ring = OwnRing::new((self.near, self.near + 2.0 * self.reach), &demand, &dips);
        let [x, y, z] = [radial, radial, axial];
        let (x, y, z): (Vec3, Vec3, Vec3) =
            (x * self.vectors.column(0), y * self.vectors.column(1), z * self.vectors.column(2));
        let both = |cos: f64, sin: f64| {
            let (even, odd) = (z + cos * x, sin * y);
            (self.weight.of(&(even + odd)), self.weight.of(&(even - odd)))
        };
        let even = ring.weighted(|cos, sin| {
            let (plus, minus) = both(cos, sin);
            0.5 * (plus + minus)
        });
        let odd = ring.weighted(|cos, sin| {
            let (plus, minus) = both(cos, sin);
            0.5 * sin * (plus - minus)
        });
        [even, odd]
    }

    fn rulings<'a>(&self, ring: &'a [RingChunk], other_end: OtherEnd) -> Rulings<'a> {
        Rulings { ring, near: self.near, reach: self.reach, cut: self.cut, other_end }
    }
}

impl CylinderWall {
    /// Sums the moments in the frame of [`TiltedGap`]; every gap must be positive.
    pub(crate) fn deformed_moments<const N: usize>(
        &self,
        deformed: &Deformed<N>,
        requests: &[MomentRequest],
        out: &mut [Moments],
    ) -> Chart {
        let gap = TiltedGap::new(&deformed.field);
        let integrand = Integrand::new(requests);
        let near_z = -0.5f64.copysign(gap.along) * self.height;
        let other_end = OtherEnd::Above(gap.along.abs() * self.height);
        let reach = self.radius * gap.across;
        let near = gap.height + gap.along * near_z - reach;
        let cut = integrand.cut(near, 1.5);
        let (vectors, weight) = (deformed.cofactor * gap.frame, &deformed.weight);
        let wall = Wall { weight, vectors, normal: (1.0, 0.0), near, reach, cut };
        let [even, odd] = wall.rings(&integrand);
        let (even, odd) = (wall.rulings(even.chunks(), other_end), wall.rulings(odd.chunks(), other_end));
        for (request, moments) in requests.iter().zip(out) {
            self.collect(&even.sums(request), near_z, moments);
            if request.order > 0 {
                let lower = MomentRequest { order: request.order - 1, ..*request };
                self.collect_odd(&odd.sums(&lower), near_z, moments);
            }
        }
        Chart::frame(gap.frame)
    }
}

impl ConeWall {
    /// Sums the moments about the apex in the frame of [`TiltedGap`]; every gap must be positive.
    pub(crate) fn deformed_moments<const N: usize>(
        &self,
        deformed: &Deformed<N>,
        requests: &[MomentRequest],
        out: &mut [Moments],
    ) -> Chart {
        let gap = TiltedGap::new(&deformed.field);
        let integrand = Integrand::new(requests);
        let reach = self.radius * gap.across;
        let apex = gap.height + 0.5 * gap.along * self.height;
        let near = gap.height - 0.5 * gap.along * self.height - reach;
        let cut = integrand.cut(near, 1.5);
        let cut = if cut < apex { cut } else { f64::INFINITY };
        let slant = self.radius.hypot(self.height);
        let normal = (self.height / slant, self.radius / slant);
        let (vectors, weight) = (deformed.cofactor * gap.frame, &deformed.weight);
        let wall = Wall { weight, vectors, normal, near, reach, cut };
        let [even, odd] = wall.rings(&integrand);
        let other_end = OtherEnd::Common(apex);
        let (even, odd) = (wall.rulings(even.chunks(), other_end), wall.rulings(odd.chunks(), other_end));
        for (request, moments) in requests.iter().zip(out) {
            self.collect(&even.sums(request), moments);
            if request.order > 0 {
                self.collect_odd(&odd.sums(request), moments);
            }
        }
        Chart { linear: gap.frame, offset: Vec3::new(0.0, 0.0, 0.5 * self.height) }
    }
}
