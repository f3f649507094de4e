//! The two frames of the singular value decomposition of P, and how fast they turn.
//!
//!   P = L D Rᵀ,   L, R rotations, D = diag(d₁, d₂, d₃):   [spin]× = L̇ Lᵀ,   [vorticity]× = Ṙ Rᵀ
//!
//! With A = Lᵀ Ṗ R, χ = Lᵀ L̇ and ϑ = Rᵀ Ṙ, both skew, A = χ D + Ḋ − D ϑ:
//!
//!   χ_ij = (A_ij d_j + A_ji d_i)/(d_j² − d_i²),   ϑ_ij = (A_ij d_i + A_ji d_j)/(d_j² − d_i²)
//!
//! L turns in space with the principal axes of the body, R in the reference placement with the matter that they hold: a
//! body that turns as a rigid one has no vorticity, one whose figure stands no spin, and there the matter circulates
//! against Ṙ Rᵀ. Where two d_i meet neither frame is determined. Source: Chandrasekhar, *Ellipsoidal Figures of
//! Equilibrium* (1969), ch. 4 (Riemann).

use crate::material::Spectrum;
use crate::simd::SimdMat3;
use crate::tensor::{Mat3, Vec3, axial};

/// Squared stretches that differ by less than this part of their sum are one: axes have fewer than half of their digits
/// there.
const MEETING: f64 = 1e-8;

/// Spin in the axes of space, vorticity in those of the reference placement [rad/s]; NaN where two stretches meet.
pub(super) fn spin_and_vorticity(p: &Mat3, rate: &Mat3) -> [Vec3; 2] {
    let Spectrum { values, axes, carried } = Spectrum::of(&SimdMat3::of(p));
    let stretches = values.map(f64::sqrt);
    let right = axes.matrix();
    let left = carried.matrix() * Mat3::from_diagonal(&stretches.map(|stretch| 1.0 / stretch).into());
    let seen = left.tr_mul(rate) * right;
    let (mut spin, mut vorticity) = (Mat3::zeros(), Mat3::zeros());
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        let apart = values[j] - values[i];
        if apart.is_nan() || apart.abs() <= MEETING * (values[i] + values[j]) {
            return [Vec3::repeat(f64::NAN); 2];
        }
        spin[(i, j)] = (seen[(i, j)] * stretches[j] + seen[(j, i)] * stretches[i]) / apart;
        vorticity[(i, j)] = (seen[(i, j)] * stretches[i] + seen[(j, i)] * stretches[j]) / apart;
    }
    // One entry of each pair: `axial` takes the difference of both.
    [(spin, left), (vorticity, right)].map(|(turn, frame)| axial(&(frame * turn * frame.transpose())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tensor::cross_matrix;

    fn turn(vector: Vec3) -> Mat3 {
        *nalgebra::Rotation3::new(vector).matrix()
    }

    /// P = e^{[ω]t} L D Rᵀ e^{−[ϑ]t} turns L with ω and R with ϑ.
    #[test]
    fn frames_turn_as_they_are_told_to() {
        let (left, right) = (turn(Vec3::new(0.4, -0.3, 0.9)), turn(Vec3::new(-0.7, 1.2, 0.1)));
        let (omega, theta) = (Vec3::new(0.3, -0.8, 0.5), Vec3::new(1.1, 0.2, -0.6));
        let stretch = Mat3::from_diagonal(&[1.3, 0.7, 0.9].into());
        let p = left * stretch * right.transpose();
        let stretching = left * Mat3::from_diagonal(&[0.2, -0.4, 0.7].into()) * right.transpose();
        let rate = cross_matrix(&omega) * p - p * cross_matrix(&theta) + stretching;
        let [spin, vorticity] = spin_and_vorticity(&p, &rate);
        // Rounding over the difference of squared stretches, 0.3.
        assert!((spin - omega).norm() < 1e-13 && (vorticity - theta).norm() < 1e-13, "{spin} {vorticity}");
    }

    #[test]
    fn frames_of_equal_stretches_are_not_determined() {
        let p = turn(Vec3::new(0.4, -0.3, 0.9)) * Mat3::from_diagonal(&[1.2, 0.8, 1.2].into());
        let [spin, vorticity] = spin_and_vorticity(&p, &Mat3::identity());
        assert!(spin.iter().chain(&vorticity).all(|number| number.is_nan()));
    }
}
