//! Moments over an ellipsoid.
//!
//! X = A s, |s| = 1, A = diag(a, b, c), is the image of a sphere; dA = |B s| dΩ with the cofactor B = diag(bc, ca, ab). With
//! s = cos θ f + sin θ (cos φ e₁ + sin φ e₂), f = −Am/|Am| the lowest point, the gap
//!
//!   d = g₀ − |Am| cos θ
//!
//! does not depend on φ: κ is evaluated once for a parallel, and the rest, ∮ |B s| s⊗… dφ, is geometry. The trapezoidal
//! rule in φ converges like e^(−Nη), η the distance of the nearest zero of |B s|²; Gauss rules in θ are graded to the
//! zero of the gap and to the places where parallels touch the sharp features of the area element (`features`).

use std::f64::consts::PI;
use std::sync::OnceLock;

use super::super::{GapField, MomentRequest, Moments};
use super::features::Features;
use super::half_plane::Chart;
use super::integrand::Integrand;
use super::sphere::frame_along;
use crate::tensor::{Mat3, Vec3};

/// An ellipsoid about the origin, its axes along x, y, z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipsoid {
    /// Semi-axes [m].
    pub semi_axes: Vec3,
}

/// The e-folds of e^(−Nη) asked for; the zeros of |B s|² are branch points, whose error is 1e-3 of that.
const AZIMUTH_DIGITS: f64 = 20.0;

impl Ellipsoid {
    /// The area ∫ |B s| dΩ [m²].
    pub fn area(&self) -> f64 {
        let field = GapField { height: 1.0, direction: Vec3::zeros() };
        let request = MomentRequest { kernel: super::super::Kernel::Power(0.0), order: 0 };
        let mut out = [Moments::default()];
        self.moments(&field, &[request], &mut out);
        out[0].zeroth
    }

    /// The point farthest along `direction`: A² a/|A a|.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        let image = self.semi_axes.component_mul(direction);
        let length = image.norm();
        if length > 0.0 { self.semi_axes.component_mul(&image) / length } else { Vec3::new(0.0, 0.0, self.semi_axes.z) }
    }

    /// Sums the moments of s in the frame (e₁, e₂, f); every gap must be positive.
    pub(crate) fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> Chart {
        let image = self.semi_axes.component_mul(&field.direction);
        let frame = frame_along(&-image);
        let reach = image.norm();
        let near = field.height - reach;
        let a = &self.semi_axes;
        let cofactor = Vec3::new(a.y * a.z, a.z * a.x, a.x * a.y);
        let element = AreaElement::new(&cofactor, &frame);
        let integrand = Integrand::new(requests);
        let features = Features::new(near, near + 2.0 * reach, &cofactor, &frame.column(2).into(), &integrand);
        for (interval, points) in features.intervals() {
            for node in interval.nodes(points) {
                let half = (0.5 * node.at).sin();
                let gap = near + 2.0 * reach * half * half;
                // Parallels that count less need fewer digits.
                let digits = AZIMUTH_DIGITS - features.spared(node.at);
                let parallel = element.parallel(node.at, node.weight, digits, integrand.order);
                for ((value, request), moments) in integrand.at(gap).iter().zip(requests).zip(out.iter_mut()) {
                    parallel.add(*value, request.order, moments);
                }
            }
        }
        for moments in out {
            let second = &mut moments.second;
            (second.m21, second.m31, second.m32) = (second.m12, second.m13, second.m23);
        }
        Chart::frame(Mat3::from_diagonal(a) * frame)
    }
}

/// |B s|² as a quadratic form in the frame (e₁, e₂, f).
struct AreaElement {
    form: Mat3,
    /// The least |B s|, the least over f + (e₁, e₂), and the largest within (e₁, e₂), squared.
    least: f64,
    least_beyond: f64,
    most_across: f64,
}

impl AreaElement {
    fn new(cofactor: &Vec3, frame: &Mat3) -> Self {
        let squares = cofactor.component_mul(cofactor);
        let form = frame.transpose() * Mat3::from_diagonal(&squares) * frame;
        let f = frame.column(2);
        let (sum, difference) = (0.5 * (form.m11 + form.m22), 0.5 * (form.m11 - form.m22));
        Self {
            form,
            least: squares.min(),
            least_beyond: 1.0 / (f.x * f.x / squares.x + f.y * f.y / squares.y + f.z * f.z / squares.z),
            most_across: sum + difference.hypot(form.m12),
        }
    }

    /// A lower bound of η, the imaginary part of the azimuth at which |B s|² vanishes on the parallel.
    ///
    /// There B(cos θ f + sin θ cosh η e) and sin θ sinh η B e' have equal lengths; the first is at least
    /// |cos θ| √least_beyond and √least · |s|, the second at most sin θ sinh η √most_across.
    fn decay(&self, cos: f64, sin: f64) -> f64 {
        let beyond = cos * cos * self.least_beyond / (sin * sin * self.most_across);
        let excess = self.most_across - self.least;
        let least = if excess > 0.0 { self.least / (sin * sin * excess) } else { f64::INFINITY };
        beyond.max(least).sqrt().asinh()
    }

    /// The moments of the parallel at θ with the measure weight · sin θ dφ.
    fn parallel(&self, theta: f64, weight: f64, digits: f64, order: usize) -> Parallel {
        let (sin, cos) = theta.sin_cos();
        let points = digits.max(3.0) / self.decay(cos, sin).min(10.0) + order as f64 + 1.0;
        let circle = half_circle(points);
        let q = &self.form;
        let constant = cos * cos * q.m33 + 0.5 * sin * sin * (q.m11 + q.m22);
        let (x, y) = (2.0 * cos * sin * q.m13, 2.0 * cos * sin * q.m23);
        let (c2, s2) = (sin * sin * (q.m11 - q.m22), 2.0 * sin * sin * q.m12);
        let mut sums = [0.0; 10];
        for &(c, s) in circle {
            let (cc, cs) = (c * c, c * s);
            let ss = 1.0 - cc;
            // φ and φ + π differ in the odd harmonics only.
            let (even, odd) = (constant + c2 * (cc - 0.5) + s2 * cs, x * c + y * s);
            let (here, opposite) = ((even + odd).max(0.0).sqrt(), (even - odd).max(0.0).sqrt());
            let (w, v) = (here + opposite, here - opposite);
            let (vc, vs) = (v * c, v * s);
            let terms = [w, vc, vs, w * cc, w * cs, w * ss, vc * cc, vs * cc, vc * ss, vs * ss];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += term;
            }
        }
        Parallel::new(&sums, weight * sin * PI / circle.len() as f64, cos, sin)
    }
}

/// Half of the points (cos φ, sin φ) that divide the circle evenly, at least `points` of them in all, up to the largest table.
fn half_circle(points: f64) -> &'static [(f64, f64)] {
    /// The k-th table divides the circle into k times as many parts, up to `FINE`; then they double.
    const UNIT: usize = 8;
    const FINE: usize = 32;
    const TABLES: usize = FINE + 5;
    static CIRCLES: [OnceLock<Vec<(f64, f64)>>; TABLES] = [const { OnceLock::new() }; TABLES];
    let units = (points / UNIT as f64).ceil().clamp(1.0, 1e6);
    let index = if units <= FINE as f64 {
        units as usize - 1
    } else {
        (FINE - 1 + (units / FINE as f64).log2().ceil() as usize).min(TABLES - 1)
    };
    CIRCLES[index].get_or_init(|| {
        let units = if index < FINE { index + 1 } else { FINE << (index + 1 - FINE) };
        let count = units * UNIT;
        (0..count / 2).map(|j| (2.0 * PI * (j as f64 + 0.5) / count as f64).sin_cos()).map(|(s, c)| (c, s)).collect()
    })
}

/// Moments of s over one parallel, weight included.
struct Parallel {
    zeroth: f64,
    first: Vec3,
    /// xx, xy, xz, yy, yz, zz.
    second: [f64; 6],
    /// In the order of `SymmetricThird`.
    third: [f64; 10],
}

impl Parallel {
    /// From the sums of 1, c, s, cc, cs, ss, ccc, ccs, ssc, sss around the circle.
    fn new(sums: &[f64; 10], weight: f64, z: f64, r: f64) -> Self {
        let (w1, w2, w3) = (weight * r, weight * r * r, weight * r * r * r);
        let [x, y] = [w1 * sums[1], w1 * sums[2]];
        let [xx, xy, yy] = [w2 * sums[3], w2 * sums[4], w2 * sums[5]];
        let zeroth = weight * sums[0];
        Self {
            zeroth,
            first: Vec3::new(x, y, z * zeroth),
            second: [xx, xy, z * x, yy, z * y, z * z * zeroth],
            third: [
                w3 * sums[6],
                w3 * sums[7],
                z * xx,
                w3 * sums[8],
                z * xy,
                z * z * x,
                w3 * sums[9],
                z * yy,
                z * z * y,
                z * z * z * zeroth,
            ],
        }
    }

    #[inline]
    fn add(&self, value: f64, order: usize, out: &mut Moments) {
        out.zeroth += value * self.zeroth;
        if order == 0 {
            return;
        }
        out.first += value * self.first;
        if order == 1 {
            return;
        }
        let [xx, xy, xz, yy, yz, zz] = self.second;
        let second = &mut out.second;
        second.m11 += value * xx;
        second.m12 += value * xy;
        second.m13 += value * xz;
        second.m22 += value * yy;
        second.m23 += value * yz;
        second.m33 += value * zz;
        if order == 2 {
            return;
        }
        for (sum, entry) in out.third.0.iter_mut().zip(self.third) {
            *sum += value * entry;
        }
    }
}
