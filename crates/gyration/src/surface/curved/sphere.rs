//! Moments over a sphere.
//!
//! Archimedes: the area between two parallel planes is 2πR² du, u = s·c, c = m/|m|, whatever their position. With X = R
//! s and s = u c + √(1−u²) e(φ), the azimuth averages out, ⟨e⊗e⟩ = ½(I − c⊗c), and only
//!
//!   U_k = ∫_−1^1 κ(g₀ + R|m| u) u^k du,   k = 0 … 3
//!
//! is left: A₀ = 2πR² U₀, A₁ = 2πR³ U₁ c, A₂ = 2πR⁴ [U₂ c⊗c + ½(U₀ − U₂)(I − c⊗c)], and A₃ likewise with U₁, U₃. The
//! U_k are moments along a segment, u = 2x − 1, in closed form.

use std::f64::consts::TAU;

use crate::surface::{AxialMoments, GapField, MomentPlan, Moments};
use crate::tensor::{Mat3, Vec3};

/// A sphere about the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// R [m].
    pub radius: f64,
}

impl Sphere {
    /// 4πR² [m²].
    pub fn area(&self) -> f64 {
        2.0 * TAU * self.radius * self.radius
    }

    /// The point farthest along `direction`.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        self.radius * unit_or_z(direction)
    }

    /// The smallest and the largest gap g₀ ± R|m| [m] of a sphere about `center`.
    pub(crate) fn gaps(&self, center: &Vec3, field: &GapField) -> (f64, f64) {
        let reach = self.radius * field.direction.norm();
        let height = field.gap(center);
        if field.lack.is_none() {
            return (height - reach, height + reach);
        }
        let (_, [x, y, z]) = field.parts();
        let slope = (x * x + y * y + z * z).sqrt();
        let near = field.extended_gap(center) - slope * self.radius.into();
        (near.value(), height + reach)
    }

    /// Adds the moments of a sphere about `center` to those about the origin; every gap must be positive.
    pub(crate) fn add_moments(&self, center: &Vec3, field: &GapField, plan: &MomentPlan, out: &mut [Moments]) {
        let axis = unit_or_z(&field.direction);
        let (near, far) = self.gaps(center, field);
        for ((request, kernel), moments) in plan.requests().iter().zip(plan.lines()).zip(out) {
            let line = kernel.moments(&kernel.sample(near), &kernel.sample(far), request.order);
            let u = shifted(&line, -1.0, 2.0);
            let mut sum = axial(self.radius, &axis, request.order, &u);
            sum.shift(center, request.order);
            moments.add(&sum, request.order);
        }
    }

    /// Sets the moments of a sphere about the origin along its axis; every gap must be positive.
    pub(crate) fn axial_moments(&self, field: &GapField, plan: &MomentPlan, out: &mut [AxialMoments]) {
        self.moments_between(self.gaps(&Vec3::zeros(), field), plan, out);
    }

    /// The same, given the smallest and the largest gap [m]. With 1 − u² = 4x (1 − x), a_⊥ is no difference of U₀ and
    /// U₂, which next to a plane are nearly the same.
    pub(crate) fn moments_between(&self, (near, far): (f64, f64), plan: &MomentPlan, out: &mut [AxialMoments]) {
        let scale = TAU * self.radius * self.radius;
        let squared = scale * self.radius * self.radius;
        for ((request, kernel), moments) in plan.requests().iter().zip(plan.lines()).zip(out) {
            let line = kernel.moments(&kernel.sample(near), &kernel.sample(far), request.order.min(2));
            let [u0, u1, u2, _] = shifted(&line, -1.0, 2.0);
            let across = 4.0 * squared * (line[1] - line[2]);
            *moments =
                AxialMoments { zeroth: scale * u0, first: scale * self.radius * u1, along: squared * u2, across };
        }
    }
}

/// The moments of a density on a sphere that depends on the height u along `axis` only, from its moments U_k.
fn axial(radius: f64, axis: &Vec3, order: usize, u: &[f64; 4]) -> Moments {
    let scale = TAU * radius * radius;
    let mut out = Moments { zeroth: scale * u[0], ..Moments::default() };
    if order >= 1 {
        out.first = scale * radius * u[1] * axis;
    }
    if order >= 2 {
        let squared = scale * radius * radius;
        let across = 0.5 * squared * (u[0] - u[2]);
        out.second = Mat3::from_diagonal_element(across) + (squared * u[2] - across) * axis * axis.transpose();
    }
    if order >= 3 {
        // U₃ c⊗c⊗c + ½(U₁ − U₃) (c⊗(I − c⊗c) and its two permutations).
        let cubed = scale * radius * radius * radius;
        let across = 0.5 * cubed * (u[1] - u[3]);
        out.third.add_point(cubed * u[3] - 3.0 * across, axis);
        let (x, y, z) = (across * axis.x, across * axis.y, across * axis.z);
        for (sum, entry) in out.third.0.iter_mut().zip([3.0 * x, y, z, x, 0.0, x, 3.0 * y, z, y, 3.0 * z]) {
            *sum += entry;
        }
    }
    out
}

/// The unit vector along `v`; e_z where v vanishes, since then every direction serves.
pub(super) fn unit_or_z(v: &Vec3) -> Vec3 {
    v.try_normalize(0.0).unwrap_or_else(Vec3::z)
}

/// A right-handed frame whose third column is along `v`.
pub(super) fn frame_along(v: &Vec3) -> Mat3 {
    let z = unit_or_z(v);
    // The coordinate axis least along z gives a well-conditioned cross product.
    let helper = if z.x.abs() < 0.6 { Vec3::x() } else { Vec3::y() };
    let x = helper.cross(&z).normalize();
    Mat3::from_columns(&[x, z.cross(&x), z])
}

/// |span| ∫ (from + span x)^k κ dx over [0, 1] from the moments ∫ x^k κ dx, k = 0 … 3.
#[inline]
pub(super) fn shifted(line: &[f64], from: f64, span: f64) -> [f64; 4] {
    let (a, b, length) = (from, span, span.abs());
    [
        length * line[0],
        length * (a * line[0] + b * line[1]),
        length * (a * a * line[0] + b * (2.0 * a * line[1] + b * line[2])),
        length * (a * a * a * line[0] + b * (3.0 * a * a * line[1] + b * (3.0 * a * line[2] + b * line[3]))),
    ]
}
