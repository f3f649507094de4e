//! Shapes of modes: δp₀ and δP, so scaled that of all material points at half the body's size from its centre the
//! fastest moves by one.

use gyration::kinematics::Placement;
use gyration::tensor::{Mat3, Vec3};
use nalgebra::{Complex, ComplexField, DVector};

/// How a body moves: δp = δp₀ + δP X.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModeShape {
    /// δp₀, in units of the fastest point's displacement.
    pub translation: Vec3,
    /// δP [1/m], in the same units.
    pub gradient: Mat3,
}

impl ModeShape {
    /// The largest |δp₀ + δP X| of points at the distance `radius` [m].
    ///
    /// X ← radius · Gᵀ(t + G X)/|…| never lowers it, G = δP; from the axes of GᵀG it gets to the largest.
    pub fn largest_displacement(&self, radius: f64) -> f64 {
        let Self { translation, gradient } = self;
        let axes = (gradient.transpose() * gradient).symmetric_eigen().eigenvectors;
        let starts = axes.column_iter().flat_map(|axis| [axis.into_owned(), -axis]);
        let climb = |start: Vec3| {
            let mut point = radius * start;
            for _ in 0..100 {
                let uphill = gradient.tr_mul(&(translation + gradient * point));
                let Some(direction) = uphill.try_normalize(0.0) else { break };
                point = radius * direction;
            }
            (translation + gradient * point).norm()
        };
        starts.map(climb).fold(0.0, f64::max)
    }

    pub(super) fn times(&self, factor: f64) -> Self {
        Self { translation: factor * self.translation, gradient: factor * self.gradient }
    }

    /// The entry of the largest size: of δp₀ if the centre moves as fast as the rest, else of δP.
    pub(super) fn leading(&self, radius: f64) -> f64 {
        let largest = |entries: &[f64]| {
            let most = entries.iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
            // The first of several that are as large: rounding does not choose.
            entries.iter().copied().find(|entry| entry.abs() >= (1.0 - 1e-6) * most).unwrap_or(0.0)
        };
        let center = self.translation.norm() >= 0.5 * radius * self.gradient.norm();
        if center { largest(self.translation.as_slice()) } else { largest(self.gradient.as_slice()) }
    }
}

/// The phase at which a motion is largest, and a quarter of a period before.
///
/// ψ e^{iφ} = a + ib with a·b = 0, |a| ≥ |b|: 2φ = −arg(ψ·ψ).
pub(super) fn in_step(shape: &DVector<Complex<f64>>) -> (DVector<f64>, DVector<f64>) {
    let square: Complex<f64> = shape.iter().map(|entry| entry * entry).sum();
    let (sine, cosine) = libm::sincos(-0.5 * square.argument());
    let turned = shape * Complex::new(cosine, sine);
    (turned.map(|entry| entry.re), turned.map(|entry| entry.im))
}

/// Of a placement, the velocity gradient that a change of P is: δP P⁻¹.
pub(super) fn spread(shape: &ModeShape, placement: &Placement) -> Mat3 {
    placement.gradient.try_inverse().map_or(shape.gradient, |inverse| shape.gradient * inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn largest_displacement_is_that_of_the_fastest_point() {
        let shape = ModeShape {
            translation: Vec3::new(0.3, -0.2, 0.5),
            gradient: Mat3::new(1.0, 0.4, -0.2, 0.1, -0.7, 0.3, 0.5, -0.6, 0.9),
        };
        let radius = 0.7;
        let found = shape.largest_displacement(radius);
        // A grid of 1° misses the largest by the square of that at most.
        let mut sampled: f64 = 0.0;
        for (theta, phi) in (0..180).flat_map(|theta| (0..360).map(move |phi| (theta, phi))) {
            let (theta, phi) = (f64::from(theta).to_radians(), f64::from(phi).to_radians());
            let point = Vec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
            sampled = sampled.max((shape.translation + shape.gradient * point * radius).norm());
        }
        assert!(found >= sampled && found - sampled < 2e-4 * found, "{found} {sampled}");
    }

    #[test]
    fn a_motion_in_step_has_no_part_in_quadrature() {
        let phase = Complex::from_polar(2.0, 1.1);
        let shape = DVector::from_vec(vec![3.0, -1.0, 0.5]).map(|entry| phase * entry);
        let (real, imaginary) = in_step(&shape);
        // One rounding of each entry.
        assert!(imaginary.norm() < 1e-14 && (real.norm() - 2.0 * 10.25f64.sqrt()).abs() < 1e-14);
    }
}
