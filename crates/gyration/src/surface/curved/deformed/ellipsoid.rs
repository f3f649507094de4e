//! Moments over the deformed image of a sphere or an ellipsoid.
//!
//! X = A s, |s| = 1, A = diag(a, b, c), has the reference area vector cof(A) s dΩ and the current one v = B s dΩ, B = C
//! cof(A), C = cof(P) turned into the own frame. The squared element |B s|² = s·BᵀB s is a quadratic form as it is for
//! the undeformed ellipsoid, whose form is diagonal in the axes of A; here the axes are those of BᵀB. So the rule of
//! `features` is asked with the singular values of B and the lowest direction f = −Am/|Am| in the axes of BᵀB, and
//! `parallels` sums as ever.

use super::super::half_plane::AffineMap;
use super::super::rules::features::Features;
use super::super::rules::integrand::Integrand;
use super::super::rules::parallels::{AreaElement, ParallelSweep};
use super::super::rules::weight::{Deformed, Weighted, extra_digits};
use super::super::sphere::frame_along;
use super::super::{Ellipsoid, Sphere};
use crate::surface::MomentRequest;
use crate::tensor::{Mat3, Vec3};

impl Ellipsoid {
    /// Sums the moments of s in the frame (e₁, e₂, f); every gap must be positive.
    pub(crate) fn deformed_moments<const N: usize, const W: usize>(
        &self,
        deformed: &Deformed<N, W>,
        requests: &[MomentRequest],
        out: &mut Weighted<W>,
    ) -> AffineMap {
        let a = &self.semi_axes;
        let image = a.component_mul(&deformed.field.direction);
        let frame = frame_along(&-image);
        let reach = image.norm();
        let near = deformed.field.height - reach;
        let vectors = deformed.cofactor * Mat3::from_diagonal(&Vec3::new(a.y * a.z, a.z * a.x, a.x * a.y)) * frame;
        let (squares, axes) = principal_axes(&vectors.tr_mul(&vectors));
        let element = AreaElement::deformed(&vectors, &squares);
        let integrand = Integrand::new(requests);
        let cofactor = squares.map(|x| x.max(0.0).sqrt());
        // The lowest direction is the third of the frame.
        let lowest = axes.row(2).transpose();
        let features = Features::new(near, reach, &cofactor, &lowest, &integrand).sharpened(extra_digits::<N>());
        let (gap, element, integrand) = ((near, reach), &element, &integrand);
        for (out, factors) in out.iter_mut().zip(deformed.weights.factors) {
            let factors = &factors.map(|row| vectors.row(row).transpose());
            ParallelSweep { features: &features, element, gap, integrand, factors }.collect(requests, out);
        }
        AffineMap::frame(Mat3::from_diagonal(a) * frame)
    }
}

impl Sphere {
    /// The same for the ellipsoid with equal axes.
    pub(crate) fn deformed_moments<const N: usize, const W: usize>(
        &self,
        deformed: &Deformed<N, W>,
        requests: &[MomentRequest],
        out: &mut Weighted<W>,
    ) -> AffineMap {
        Ellipsoid { semi_axes: Vec3::repeat(self.radius) }.deformed_moments(deformed, requests, out)
    }
}

/// Eigenvalues and eigenvectors (columns) of a symmetric matrix, by Jacobi's rotations.
///
/// The rules need them to a few digits only; the last sweep leaves off-diagonal entries below 1e-6 of the largest
/// entry, which changes eigenvalues by the square of that.
pub(super) fn principal_axes(matrix: &Mat3) -> (Vec3, Mat3) {
    const MOST_SWEEPS: usize = 8;
    let (mut a, mut axes) = (*matrix, Mat3::identity());
    let negligible = 1e-6 * a.amax();
    for _ in 0..MOST_SWEEPS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[(p, q)].abs() <= negligible {
                continue;
            }
            let theta = 0.5 * (a[(q, q)] - a[(p, p)]) / a[(p, q)];
            let t = 1f64.copysign(theta) / (theta.abs() + libm::hypot(theta, 1.0));
            let c = 1.0 / libm::hypot(t, 1.0);
            let s = t * c;
            rotate(&mut a, p, q, (c, s));
            a.transpose_mut();
            rotate(&mut a, p, q, (c, s));
            rotate(&mut axes, p, q, (c, s));
        }
        if a.m12.abs().max(a.m13.abs()).max(a.m23.abs()) <= negligible {
            break;
        }
    }
    (a.diagonal(), axes)
}

/// Turns two columns.
fn rotate(a: &mut Mat3, p: usize, q: usize, (c, s): (f64, f64)) {
    for row in 0..3 {
        let (x, y) = (a[(row, p)], a[(row, q)]);
        (a[(row, p)], a[(row, q)]) = (c * x - s * y, s * x + c * y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_axes_diagonalise() {
        let matrices = [
            Mat3::identity(),
            Mat3::zeros(),
            Mat3::new(2.0, 1.0, -0.3, 1.0, 5.0, 0.7, -0.3, 0.7, 1.0),
            Mat3::new(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0),
            Mat3::new(1e8, 3.0, 1.0, 3.0, 1.0, 0.1, 1.0, 0.1, 1e-6),
        ];
        for matrix in matrices {
            let (values, axes) = principal_axes(&matrix);
            // Rotations round; the sweeps stop at 1e-6.
            assert!((axes.tr_mul(&axes) - Mat3::identity()).amax() < 1e-14);
            let back = axes * Mat3::from_diagonal(&values) * axes.transpose();
            assert!((back - matrix).amax() <= 3e-6 * matrix.amax(), "{matrix}");
        }
    }
}
