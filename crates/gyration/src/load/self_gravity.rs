//! The gravity of a body on itself, a homogeneous ellipsoid at every instant.
//!
//!   V(P) = −(3/10) G m² ∫₀^∞ du/Δ,         Δ² = det(Q + u),   Q = P A² Pᵀ,   A = diag(a₁, a₂, a₃)
//!   M = −∂V/∂P = −(3/5) G m² K P A²,       K = ½ ∫ B du/Δ,   B = (Q + u)⁻¹
//!   δK = −½ ∫ (B δQ B + ½ B tr(B δQ)) du/Δ
//!
//! a_i semi-axes before it deforms, m its mass; the density ρ follows the volume, m = (4/3) π ρ √det Q, so that V is
//! −(8/15) π² G ρ² det Q ∫ du/Δ. Derivatives are those of B, which is diagonal in the principal axes of Q: no
//! difference of semi-axes is formed, and equal ones are no special case. Source: Chandrasekhar, *Ellipsoidal Figures
//! of Equilibrium* (1969), ch. 3.

use super::{LoadSlopes, Loads, unit};
use crate::ellipsoid_moments::EllipsoidMoments;
use crate::material::Spectrum;
use crate::simd::SimdMat3;
use crate::tensor::{Mat3, Vec3};

/// The gravity of a homogeneous ellipsoid on itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelfGravity {
    /// (3/5) G m² [J m].
    strength: f64,
    /// A [m].
    semi_axes: Mat3,
}

/// The ellipsoid at an instant.
struct Figure {
    /// P A [m].
    carried: Mat3,
    /// Its principal axes, a column each.
    axes: Mat3,
    /// The squares of its semi-axes [m²].
    squares: [f64; 3],
    moments: EllipsoidMoments,
}

impl SelfGravity {
    /// That of a mass m [kg] within semi-axes a_i [m] under the constant G [N m²/kg²].
    pub fn new(constant: f64, mass: f64, semi_axes: &Vec3) -> Self {
        Self { strength: 0.6 * constant * mass * mass, semi_axes: Mat3::from_diagonal(semi_axes) }
    }

    /// V [J] at P, det P > 0.
    pub fn energy(&self, gradient: &Mat3) -> f64 {
        let Figure { squares, moments, .. } = self.figure(gradient);
        let sum = squares[0] * moments.second[0] + squares[1] * moments.second[1] + squares[2] * moments.second[2];
        -self.strength * sum / volume(&squares)
    }

    /// M [N m] at P, det P > 0.
    pub fn moment(&self, gradient: &Mat3) -> Mat3 {
        let figure = self.figure(gradient);
        -self.strength * figure.potential() * figure.carried * self.semi_axes
    }

    fn figure(&self, gradient: &Mat3) -> Figure {
        let carried = gradient * self.semi_axes;
        let Spectrum { values: squares, axes, .. } = Spectrum::of(&SimdMat3::of(&carried.transpose()));
        Figure { carried, axes: axes.matrix(), squares, moments: EllipsoidMoments::of(squares) }
    }
}

/// a₁a₂a₃ [m³].
fn volume([a, b, c]: &[f64; 3]) -> f64 {
    (a * b * c).sqrt()
}

impl Figure {
    /// K [1/m³].
    fn potential(&self) -> Mat3 {
        self.axes * Mat3::from_diagonal(&self.moments.second.into()) * self.axes.transpose() / volume(&self.squares)
    }

    /// δK along δQ.
    fn potential_along(&self, change: &Mat3) -> Mat3 {
        let (seen, narrow) = (self.axes.tr_mul(change) * self.axes, &self.moments.narrow);
        let mut slope = Mat3::from_fn(|i, j| -narrow[i][j] * seen[(i, j)]);
        for (i, row) in narrow.iter().enumerate() {
            slope[(i, i)] -= 0.5 * (0..3).map(|p| row[p] * seen[(p, p)]).sum::<f64>();
        }
        self.axes * slope * self.axes.transpose() / volume(&self.squares)
    }
}

impl LoadSlopes {
    /// Adds the gravity of a body on itself.
    pub fn add_self_gravity(&mut self, gravity: &SelfGravity, gradient: &Mat3) {
        let SelfGravity { strength, semi_axes } = gravity;
        let figure = gravity.figure(gradient);
        let potential = figure.potential();
        self.loads.moment -= *strength * potential * figure.carried * semi_axes;
        for coordinate in 0..9 {
            let moved = unit(coordinate) * semi_axes;
            let turned = moved * figure.carried.transpose();
            let change = figure.potential_along(&(turned + turned.transpose()));
            let slope = (change * figure.carried + potential * moved) * semi_axes * -*strength;
            self.add_by_place(3 + coordinate, &Loads { force: Vec3::zeros(), moment: slope });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A gradient with these stretches, turned on both sides.
    fn gradient(stretches: [f64; 3]) -> Mat3 {
        let turn = |axis: Vec3| *nalgebra::Rotation3::new(axis).matrix();
        let (left, right) = (turn(Vec3::new(0.3, -0.8, 0.5)), turn(Vec3::new(-0.4, 0.2, 0.9)));
        left * Mat3::from_diagonal(&stretches.into()) * right
    }

    #[test]
    fn spheroids_have_the_energy_of_their_closed_form() {
        let gravity = SelfGravity::new(2.0, 3.0, &Vec3::repeat(0.5));
        let sphere = gravity.energy(&gradient([1.0; 3]));
        // Some hundred roundings of sums that do not cancel.
        assert!((sphere / (-0.6 * 2.0 * 9.0 / 0.5) - 1.0).abs() < 1e-14, "{sphere}");
        // ∫ du/Δ = 2 arcsin(e)/(a e), e² = 1 − c²/a².
        let (a, c) = (0.6_f64, 0.35_f64);
        let e = (1.0 - (c / a).powi(2)).sqrt();
        let expected = -0.3 * 2.0 * 9.0 * 2.0 * e.asin() / (a * e);
        let flat = gravity.energy(&gradient([1.2, 0.7, 1.2]));
        assert!((flat / expected - 1.0).abs() < 1e-14, "{flat} {expected}");
    }

    #[test]
    fn moment_and_slopes_are_derivatives_whatever_the_axes() {
        let gravity = SelfGravity::new(1.0, 1.0, &Vec3::new(1.0, 0.8, 0.8));
        let (step, equal) = (1e-5, [1.2, 1.5, 1.5]);
        for stretches in [equal, [1.2, 1.5, 1.5 + 1e-9], [0.7, 1.3, 2.0], [0.8, 1.0, 1.0]] {
            let p = gradient(stretches);
            let mut slopes = LoadSlopes::default();
            slopes.add_self_gravity(&gravity, &p);
            assert_eq!(slopes.loads.moment, gravity.moment(&p));
            for coordinate in 0..9 {
                let moved = [step, -step].map(|by| p + by * unit(coordinate));
                let [ahead, behind] = moved.map(|p| gravity.energy(&p));
                let force = -(ahead - behind) / (2.0 * step);
                // Central differences: step² and eps/step.
                assert!((force - gravity.moment(&p)[coordinate]).abs() < 1e-9, "{stretches:?}, {coordinate}");
                let [ahead, behind] = moved.map(|p| gravity.moment(&p));
                let along = slopes.along_place(&Vec3::zeros(), &unit(coordinate)).moment;
                assert!((along - (ahead - behind) / (2.0 * step)).norm() < 1e-9, "{stretches:?}, {coordinate}");
            }
        }
    }
}
