//! Moments over a sphere.
//!
//! Archimedes: the area between two parallel planes is 2πR² du, u = s·c, c = m/|m|, whatever their position. With
//! X = R s and s = u c + √(1−u²) e(φ), the azimuth averages out, ⟨e⊗e⟩ = ½(I − c⊗c), and only
//!
//!   U_k = ∫_−1^1 κ(g₀ + R|m| u) u^k du,   k = 0 … 3
//!
//! is left:  A₀ = 2πR² U₀,  A₁ = 2πR³ U₁ c,  A₂ = 2πR⁴ [U₂ c⊗c + ½(U₀ − U₂)(I − c⊗c)], and A₃ likewise with U₁, U₃.

use std::f64::consts::PI;

use super::super::rule::gauss_legendre;
use super::super::{GapField, Kernel, MomentRequest, Moments};
use super::integrand::Integrand;
use crate::tensor::{Mat3, SymmetricThird, Vec3};

/// A sphere about the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// R [m].
    pub radius: f64,
}

impl Sphere {
    /// 4πR² [m²].
    pub fn area(&self) -> f64 {
        4.0 * PI * self.radius * self.radius
    }

    /// The point farthest along `direction`.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        self.radius * unit_or_z(direction)
    }

    /// Adds the moments about the centre; every gap on the sphere must be positive.
    pub(crate) fn add_moments(
        &self,
        field: &GapField,
        requests: &[MomentRequest],
        out: &mut [Moments],
    ) {
        let axis = unit_or_z(&field.direction);
        let reach = self.radius * field.direction.norm();
        for (request, moments) in requests.iter().zip(out) {
            let heights = height_moments(request, field.height - reach, field.height + reach);
            add_axial(self.radius, &axis, request.order, &heights, moments);
        }
    }
}

/// The unit vector along `v`; e_z where v vanishes, since then every direction serves.
fn unit_or_z(v: &Vec3) -> Vec3 {
    v.try_normalize(0.0).unwrap_or_else(Vec3::z)
}

/// U_k = ∫ κ u^k du over [−1, 1], k = 0 … 3, where the gap runs from `low` to `high`.
///
/// Gauss points are uniform in the logarithm of the gap, over the range in which d^(1−ν) falls by 1e-17.
fn height_moments(request: &MomentRequest, low: f64, high: f64) -> [f64; 4] {
    /// Decades of d^(1−ν) kept, as a natural logarithm: e^−39 ≈ 1e-17.
    const KEPT: f64 = 39.0;
    let rise = high - low;
    let full = (rise / low).ln_1p();
    let decay = match request.kernel {
        Kernel::Power(nu) => nu - 1.0,
        Kernel::Log => 0.0,
    };
    let range = if decay * full > KEPT {
        KEPT / decay
    } else {
        full
    };
    let integrand = Integrand::new(std::slice::from_ref(request));
    let mut sums = [0.0; 4];
    // 40 points integrate e^(−39 x) on [0, 1] to round-off; they also cover the growth for ν < 1.
    for node in gauss_legendre(40) {
        let x = 0.5 * range * (1.0 + node.at);
        let gap = low * x.exp();
        // du/dx = 2 d/rise; where the gap hardly varies, rise/d is replaced by its limit full.
        let from_low = if rise > 0.0 {
            2.0 * low * x.exp_m1() / rise
        } else {
            1.0 + node.at
        };
        let slope = if rise > 0.0 {
            2.0 * gap / rise * 0.5 * range
        } else {
            1.0
        };
        let mut term = node.weight * slope * integrand.at(gap)[0];
        for sum in &mut sums {
            *sum += term;
            term *= from_low - 1.0;
        }
    }
    sums
}

/// Adds the moments of an axially symmetric density on a sphere, from its moments U_k along the axis.
fn add_axial(radius: f64, axis: &Vec3, order: usize, u: &[f64; 4], out: &mut Moments) {
    let scale = 2.0 * PI * radius * radius;
    out.zeroth += scale * u[0];
    if order >= 1 {
        out.first += scale * radius * u[1] * axis;
    }
    if order >= 2 {
        let across = 0.5 * (u[0] - u[2]);
        let tensor =
            Mat3::from_diagonal_element(across) + (u[2] - across) * axis * axis.transpose();
        out.second += scale * radius * radius * tensor;
    }
    if order >= 3 {
        let cubed = scale * radius * radius * radius;
        let across = 0.5 * (u[1] - u[3]);
        let mut tensor = SymmetricThird::default();
        tensor.add_point(cubed * (u[3] - 3.0 * across), axis);
        add_isotropic(cubed * across, axis, &mut tensor);
        for (sum, entry) in out.third.0.iter_mut().zip(tensor.0) {
            *sum += entry;
        }
    }
}

/// Adds w (a_i δ_jk + a_j δ_ik + a_k δ_ij).
fn add_isotropic(w: f64, a: &Vec3, out: &mut SymmetricThird) {
    let (x, y, z) = (w * a.x, w * a.y, w * a.z);
    for (sum, entry) in out
        .0
        .iter_mut()
        .zip([3.0 * x, y, z, x, 0.0, x, 3.0 * y, z, y, 3.0 * z])
    {
        *sum += entry;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn force_on_a_sphere_is_the_closed_form() {
        // verification.md, row 11: 2πRα[d^(1−ν) − (d+2R)^(1−ν)]/(ν−1); the rule is good to round-off.
        for (radius, gap, nu) in [
            (0.1, 0.03, 6.0),
            (0.02, 1e-6, 4.5),
            (1.0, 30.0, 2.0),
            (0.5, 1e-3, 12.0),
        ] {
            let field = GapField {
                height: gap + radius,
                direction: Vec3::new(0.6, 0.0, 0.8),
            };
            let mut out = [Moments::default()];
            let request = MomentRequest {
                kernel: Kernel::Power(nu),
                order: 0,
            };
            Sphere { radius }.add_moments(&field, &[request], &mut out);
            let power = |d: f64| d.powf(1.0 - nu);
            let exact = 2.0 * PI * radius * (power(gap) - power(gap + 2.0 * radius)) / (nu - 1.0);
            // The gap itself is known to 1e-16 (R + gap)/gap.
            let tolerance = 1e-13 + 2e-16 * nu * (radius + gap) / gap;
            assert!(
                (out[0].zeroth / exact - 1.0).abs() < tolerance,
                "{} against {exact}",
                out[0].zeroth
            );
        }
    }
}
