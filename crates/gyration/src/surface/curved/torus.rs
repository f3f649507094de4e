//! Moments over a torus.
//!
//! Y = (ρ cos φ, ρ sin φ, r e_z), ρ = R + r e_ρ, e = (e_ρ, e_z) a unit vector around the tube, dA = r ρ dθ dφ. In the
//! half-plane at φ the gap is a(φ) − b(φ) cos θ, θ from the side of the tube that faces the plane:
//!
//!   a = g₀ − μ R cos φ,   b = r √(m_z² + μ² cos²φ).
//!
//! The integral around the tube is singular only where a² = b², a quadratic in cos φ whose two roots both exceed 1: the
//! outer rule is graded to the smaller one. For integer ν the integral around the tube has a closed form
//! (`closed_circle`), taken for as many half-planes at once as a register holds; for other kernels it is a rule that is
//! graded to its own a and b. Requires r ≤ R.

use std::f64::consts::PI;

use pulp::{Simd, WithSimd};

use super::cylinder::circle_support;
use super::half_plane::{AffineMap, TiltedGap};
use super::rules::closed_circle::ClosedCircle;
use super::rules::integrand::{GROUP, Integrand, LANES};
use super::rules::ring::{Demand, RingChunk, RingNode, Rings, nodes};
use super::rules::rulings::rows_of;
use super::sphere::unit_or_z;
use super::tube::{COMPONENTS, UP_TO, collect, half_plane, turned};
use crate::simd::{F64s, Row, WIDTH, dispatch, fold};
use crate::surface::{GapField, MomentRequest, Moments};
use crate::tensor::Vec3;

/// A torus about the z axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    /// R, from the axis to the middle of the tube [m].
    pub major_radius: f64,
    /// r ≤ R, of the tube [m].
    pub minor_radius: f64,
}

impl Torus {
    /// 4π²Rr [m²].
    pub fn area(&self) -> f64 {
        4.0 * PI * PI * self.major_radius * self.minor_radius
    }

    /// The point farthest along `direction`.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        circle_support(self.major_radius, 0.0, direction) + self.minor_radius * unit_or_z(direction)
    }

    /// Sums the moments in the frame of [`TiltedGap`]; every gap must be positive.
    pub(crate) fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> AffineMap {
        let gap = TiltedGap::new(field);
        let integrand = Integrand::new(requests);
        let (near, far) = self.outer_gaps(&gap);
        let smallest =
            gap.height - self.major_radius * gap.across - self.minor_radius * libm::hypot(gap.along, gap.across);
        let (sharpest, mildest, degree) = (integrand.sharpest, integrand.mildest - 0.5, integrand.order);
        let half_planes = HalfPlanes {
            torus: self,
            gap: &gap,
            ring: Rings::new(&Demand { sharpest, mildest, degree }).chunks(near, far),
            cut: integrand.cut(smallest, 1.0),
        };
        let (mut open, mut places, mut count) = ([requests[0]; GROUP], [0; GROUP], 0);
        for (place, (request, out)) in requests.iter().zip(out.iter_mut()).enumerate() {
            match ClosedCircle::of(request.kernel) {
                Some(circle) => {
                    let sums = dispatch(ClosedSweep { half_planes: &half_planes, circle, order: request.order });
                    *out = collect(&sums);
                }
                None => {
                    (open[count], places[count]) = (*request, place);
                    count += 1;
                }
            }
        }
        if count > 0 {
            let sums = dispatch(RuleSweep::new(&half_planes, &open[..count]));
            for (sums, place) in sums.iter().zip(&places[..count]) {
                out[*place] = collect(sums);
            }
        }
        AffineMap::frame(gap.frame)
    }

    /// R and r.
    fn radii(&self) -> (f64, f64) {
        (self.major_radius, self.minor_radius)
    }

    /// Gaps in the ratio (c − 1)/(c + 1), c the smaller root cos φ of a² = b².
    pub(super) fn outer_gaps(&self, gap: &TiltedGap) -> (f64, f64) {
        let (g, r, m) = (gap.height, self.minor_radius, gap.along);
        let surplus = self.major_radius * self.major_radius - r * r;
        let root = (g * g + surplus * m * m).max(0.0).sqrt();
        let c = (g * g - r * r * m * m) / (gap.across * (g * self.major_radius + r * root));
        // A horizontal torus has c = ∞: nothing varies around the axis.
        if c < 1e15 { ((c - 1.0).max(1e-14), c + 1.0) } else { (1.0, 1.0) }
    }
}

/// The half-planes of a torus at the azimuths of a ring.
struct HalfPlanes<'a> {
    torus: &'a Torus,
    gap: &'a TiltedGap,
    ring: &'static [RingChunk],
    /// The gap beyond which half-planes are negligible.
    cut: f64,
}

/// The circles around the tube in closed form: compiled for each instruction set.
struct ClosedSweep<'a> {
    half_planes: &'a HalfPlanes<'a>,
    circle: &'a ClosedCircle,
    order: usize,
}

impl WithSimd for ClosedSweep<'_> {
    type Output = [f64; COMPONENTS];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        match self.order {
            0 => self.sums::<S, 0>(simd),
            1 => self.sums::<S, 1>(simd),
            2 => self.sums::<S, 2>(simd),
            _ => self.sums::<S, 3>(simd),
        }
    }
}

impl ClosedSweep<'_> {
    #[inline(always)]
    fn sums<S: Simd, const ORDER: usize>(&self, simd: S) -> [f64; COMPONENTS] {
        let HalfPlanes { torus, gap, ring, cut } = *self.half_planes;
        let r = torus.minor_radius;
        let mut sums = [[0.0; WIDTH]; COMPONENTS];
        let (zero, one) = (F64s::splat(simd, 0.0), F64s::splat(simd, 1.0));
        for pair in ring.chunks(WIDTH / LANES) {
            if self.half_planes.near(pair[0].cos[0]) > cut {
                break;
            }
            let [weight, cos, _, sin_squared] = rows_of(pair);
            for register in 0..WIDTH / S::F64_LANES {
                let load = |row: &Row| F64s::<S>::load(simd, row, register);
                let (weight, cos, sin_squared) = (load(&weight), load(&cos), load(&sin_squared));
                let lateral = cos * gap.across;
                let steepness = (lateral * lateral + gap.along * gap.along).sqrt();
                let middle = gap.height - lateral * torus.major_radius;
                let (near, far) = (middle - steepness * r, middle + steepness * r);
                // The side of the tube that faces the plane, in the half-plane (ρ, z).
                let slopes = zero.less_than(steepness);
                let inverse = slopes.select(one / steepness, zero);
                let facing = (slopes.select(lateral * inverse, one), inverse * -gap.along);
                let cosines = self.circle.cosines(near, far, ORDER + 1);
                let sums_of_one = half_plane(torus.radii(), &cosines, facing, ORDER);
                let turned = turned(&sums_of_one, weight, cos, sin_squared, ORDER);
                for place in 0..UP_TO[ORDER] {
                    turned[place].add_to(&mut sums[place], register);
                }
            }
        }
        let mut folded = [0.0; COMPONENTS];
        for (sum, row) in folded.iter_mut().zip(&sums) {
            *sum = fold(row);
        }
        folded
    }
}

impl HalfPlanes<'_> {
    /// The smallest gap in the half-plane at this azimuth.
    fn near(&self, cos: f64) -> f64 {
        let lateral = self.gap.across * cos;
        let steepness = (lateral * lateral + self.gap.along * self.gap.along).sqrt();
        self.gap.height - self.torus.major_radius * lateral - self.torus.minor_radius * steepness
    }
}

/// The circles around the tube by a rule, for all kernels together: compiled for each instruction set.
struct RuleSweep<'a> {
    half_planes: &'a HalfPlanes<'a>,
    rings: Rings,
    /// The gap beyond which a circle is negligible, by its smallest gap.
    cut_ratio: f64,
    integrand: Integrand,
    requests: &'a [MomentRequest],
}

impl<'a> RuleSweep<'a> {
    fn new(half_planes: &'a HalfPlanes<'a>, requests: &'a [MomentRequest]) -> Self {
        let integrand = Integrand::new(requests);
        let Integrand { sharpest, mildest, order, .. } = integrand;
        let rings = Rings::new(&Demand { sharpest, mildest, degree: order + 1 });
        Self { half_planes, rings, cut_ratio: integrand.cut_ratio(0.5), integrand, requests }
    }

    /// ∫ κ cosᵏθ dθ around the tube for gaps near + reach (1 − cos θ).
    #[inline(always)]
    fn cosines(&self, near: f64, reach: f64) -> [[f64; 5]; GROUP] {
        let mut sums = [[[0.0; LANES]; 5]; GROUP];
        for chunk in self.rings.chunks(near, near + 2.0 * reach) {
            let gaps = chunk.versine.map(|versine| near + reach * versine);
            if gaps[0] > near * self.cut_ratio {
                break;
            }
            let values = self.integrand.at_each(&gaps);
            for (value, sums) in values.iter().zip(&mut sums).take(self.integrand.count()) {
                for lane in 0..LANES {
                    let mut term = chunk.weight[lane] * value[lane];
                    for sum in sums.iter_mut() {
                        sum[lane] += term;
                        term *= chunk.cos[lane];
                    }
                }
            }
        }
        sums.map(|sums| sums.map(|lanes| lanes.iter().sum()))
    }
}

impl WithSimd for RuleSweep<'_> {
    type Output = [[f64; COMPONENTS]; GROUP];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let HalfPlanes { torus, gap, ring, cut } = *self.half_planes;
        let mut sums = [[0.0; COMPONENTS]; GROUP];
        for RingNode { weight, cos, sin_squared, .. } in nodes(ring) {
            let lateral = gap.across * cos;
            let steepness = libm::hypot(gap.along, lateral);
            let near = gap.height - torus.major_radius * lateral - torus.minor_radius * steepness;
            if near > cut {
                break;
            }
            let facing = if steepness > 0.0 { (lateral / steepness, -gap.along / steepness) } else { (1.0, 0.0) };
            let cosines = self.cosines(near, torus.minor_radius * steepness);
            for ((sums, cosines), request) in sums.iter_mut().zip(&cosines).zip(self.requests) {
                let sums_of_one = half_plane(torus.radii(), cosines, facing, request.order);
                let turned = turned(&sums_of_one, weight, cos, sin_squared, request.order);
                for (sum, term) in sums.iter_mut().zip(turned).take(UP_TO[request.order.min(3)]) {
                    *sum += term;
                }
            }
        }
        sums
    }
}
