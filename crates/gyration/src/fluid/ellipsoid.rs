//! Force and stress of slow flow on an ellipsoid that moves and deforms by homogeneous deformations, and their
//! derivatives.
//!
//! With Q = P A² Pᵀ, A the reference semi-axes, U and L the velocity and the gradient of the ellipsoid against those of
//! the flow,
//!
//!   f = −16πη K⁻¹ (U − U∞),      K = tr W I + W,   W = ∫₀^∞ Q B ds/Δ,   B = (Q + s)⁻¹,   Δ² = det(Q + s)
//!   T N − 𝓜:T = η (L∞ − L + θ N),  N:T = 0,  θ = tr L,   σ = T + 2η sym L − 2ηθ I
//!   N = (V/2) ∫ B ds/Δ,   𝓜:T = (V/4) ∫ s [B (B:T) + B (T + Tᵀ) B] ds/Δ,   V = √det Q
//!
//! and the traction on the surface is σ n with the same σ everywhere. Tensors are in the principal axes, where B is
//! diagonal and everything follows from `ellipsoid_moments`. Derivatives by Q are those of B, δB = −B δQ B, so that
//! equal axes are no special case. Source: `docs/theory-fluid.md`, written without axes.

use crate::ellipsoid_moments::EllipsoidMoments;
use crate::material::Spectrum;
use crate::simd::SimdMat3;
use crate::tensor::{Mat3, Vec3};
use std::f64::consts::PI;

/// An ellipsoid in a fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FluidEllipsoid {
    /// Its principal axes, a column each.
    pub axes: Mat3,
    /// a_i² \[m²\].
    pub squares: [f64; 3],
    viscosity: f64,
    moments: EllipsoidMoments,
    /// Of T N − 𝓜:T.
    inverse: Inverse,
}

/// The inverse of T ↦ T N − 𝓜:T on what is off the diagonal, pair by pair, and of the differences on it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Inverse {
    /// (T_ij, T_ji) from (D_ij, D_ji): for each pair the entries on the diagonal and the one beside.
    pairs: [[f64; 3]; 3],
    /// (m₁₂, m₂₀, m₀₁)/d, d = m₀₁ m₀₂ + m₀₁ m₁₂ + m₀₂ m₁₂: what the differences of the T_i are made of.
    differences: [f64; 3],
}

/// The pairs of different axes.
const PAIRS: [(usize, usize); 3] = [(0, 1), (1, 2), (2, 0)];

impl Inverse {
    fn of(fourth: &[[f64; 3]; 3]) -> Self {
        let pairs = PAIRS.map(|(i, j)| {
            let (m, k) = (fourth[i][j], 3 - i - j);
            // L_j − m_ij and L_i − m_ij, as sums of what is positive.
            let (own, other) = (3.0 * fourth[j][j] + fourth[j][k], 3.0 * fourth[i][i] + fourth[i][k]);
            // m² is smaller than either part of the product: m_ij² ≤ m_ii m_jj.
            let inverse = 1.0 / (own * other - m * m);
            [other * inverse, own * inverse, m * inverse]
        });
        // Σ_k m_ik (T_i − T_k) = D_i with Σ D_i = 0: (T_j − T_i) d = m_ik D_j − m_jk D_i.
        let [p, q, r] = [fourth[0][1], fourth[0][2], fourth[1][2]];
        let inverse = 1.0 / (p * q + p * r + q * r);
        Self { pairs, differences: [r * inverse, q * inverse, p * inverse] }
    }
}

/// What of the relation between stress and rates changes with the form along one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FormSlope {
    /// δK.
    resistance: Mat3,
    /// δN.
    second: Mat3,
    /// ½ tr(Q⁻¹δQ), by which V grows.
    growth: f64,
    /// δQ.
    change: Mat3,
}

impl FluidEllipsoid {
    /// The image of an ellipsoid of semi-axes A under P: `carried` = P A \[m\], det > 0, in a fluid of viscosity η > 0
    /// \[Pa s\].
    pub fn of(carried: &Mat3, viscosity: f64) -> Self {
        let spectrum = Spectrum::of(&SimdMat3::of(&carried.transpose()));
        Self::along(spectrum.axes.matrix(), spectrum.values, viscosity)
    }

    /// One with its axes along those of the frame.
    pub fn new(semi_axes: [f64; 3], viscosity: f64) -> Self {
        Self::along(Mat3::identity(), semi_axes.map(|axis| axis * axis), viscosity)
    }

    fn along(axes: Mat3, squares: [f64; 3], viscosity: f64) -> Self {
        let moments = EllipsoidMoments::of(squares);
        Self { axes, squares, viscosity, moments, inverse: Inverse::of(&moments.fourth) }
    }

    /// The ratio of the longest to the shortest semi-axis.
    pub fn slenderness(&self) -> f64 {
        let [a, b, c] = self.squares;
        (a.max(b).max(c) / a.min(b).min(c)).sqrt()
    }

    /// A tensor in the principal axes.
    pub fn seen(&self, tensor: &Mat3) -> Mat3 {
        self.axes.tr_mul(tensor) * self.axes
    }

    /// A tensor in the axes of space from one in the principal axes.
    pub fn shown(&self, tensor: &Mat3) -> Mat3 {
        self.axes * tensor * self.axes.transpose()
    }

    /// W_i.
    fn weight(&self, i: usize) -> f64 {
        2.0 * self.moments.second[i] * self.squares[i] / self.volume()
    }

    /// V = a₁a₂a₃.
    fn volume(&self) -> f64 {
        let [a, b, c] = self.squares;
        (a * b * c).sqrt()
    }

    /// f/(−16πη): K⁻¹ times a velocity, both in the principal axes.
    fn mobility(&self, velocity: &Vec3) -> Vec3 {
        let weights = [self.weight(0), self.weight(1), self.weight(2)];
        let all = weights[0] + weights[1] + weights[2];
        Vec3::new(velocity[0] / (all + weights[0]), velocity[1] / (all + weights[1]), velocity[2] / (all + weights[2]))
    }

    /// Force of the fluid \[N\] at a velocity relative to it \[m/s\], both in the principal axes.
    pub fn force(&self, velocity: &Vec3) -> Vec3 {
        -16.0 * PI * self.viscosity * self.mobility(velocity)
    }

    /// T and the stress σ of the fluid \[Pa\], in the principal axes.
    ///
    /// `gradient` L of the ellipsoid and `flow` L∞ of the fluid \[1/s\], tr L∞ = 0.
    pub fn stress(&self, gradient: &Mat3, flow: &Mat3) -> Stress {
        let expansion = gradient.trace();
        let second = Mat3::from_diagonal(&self.moments.second.into());
        let driving = (flow - gradient + second * expansion) * self.viscosity;
        let extra = self.solve(&driving, 0.0);
        Stress { extra, total: extra + self.straining(gradient) }
    }

    /// 2η sym L − 2ηθ I.
    fn straining(&self, gradient: &Mat3) -> Mat3 {
        let growth = 2.0 * self.viscosity * gradient.trace();
        (gradient + gradient.transpose()) * self.viscosity - Mat3::from_diagonal_element(growth)
    }

    /// δσ along a change of L \[1/s\].
    pub fn along_gradient(&self, gradient: &Mat3) -> Mat3 {
        self.stress(gradient, &Mat3::zeros()).total
    }

    /// What changes with Q along δQ \[m²\], in the principal axes.
    pub fn along_form(&self, change: &Mat3) -> FormSlope {
        let (volume, EllipsoidMoments { second, narrow, fourth, .. }) = (self.volume(), &self.moments);
        let growth = 0.5 * (0..3).map(|i| change[(i, i)] / self.squares[i]).sum::<f64>();
        // δW_ij = (4/V) m_ij δQ_ij − δ_ij (a_i²/V) Σ_p n_ip δQ_pp.
        let mut weight = Mat3::zeros();
        let mut moment = Mat3::zeros();
        for i in 0..3 {
            for j in 0..3 {
                weight[(i, j)] = 4.0 / volume * fourth[i][j] * change[(i, j)];
                moment[(i, j)] = -narrow[i][j] * change[(i, j)];
            }
            let swept: f64 = (0..3).map(|p| narrow[i][p] * change[(p, p)]).sum();
            weight[(i, i)] -= self.squares[i] / volume * swept;
            moment[(i, i)] += growth * second[i] - 0.5 * swept;
        }
        let resistance = weight + Mat3::from_diagonal_element(weight.trace());
        FormSlope { resistance, second: moment, growth, change: *change }
    }

    /// δf along a change of form, at a velocity relative to the fluid.
    pub fn force_along(&self, slope: &FormSlope, velocity: &Vec3) -> Vec3 {
        -self.force(&(slope.resistance * self.mobility(velocity)))
    }

    /// δσ along a change of form, L and L∞ kept.
    pub fn stress_along(&self, slope: &FormSlope, stress: &Stress, gradient: &Mat3) -> Mat3 {
        let extra = &stress.extra;
        let driving = slope.second * (self.viscosity * gradient.trace()) - extra * slope.second;
        self.solve(&(driving + self.fourth_along(slope, extra)), -slope.second.dot(extra))
    }

    /// δ𝓜:T, entry by entry of δQ: few are not zero.
    fn fourth_along(&self, slope: &FormSlope, t: &Mat3) -> Mat3 {
        let (d, EllipsoidMoments { fourth, sixth, .. }) = (&slope.change, &self.moments);
        let s = t + t.transpose();
        let traces = |m: &[f64; 3]| m[0] * t[(0, 0)] + m[1] * t[(1, 1)] + m[2] * t[(2, 2)];
        let mut change = Mat3::zeros();
        for (k, l) in (0..9).map(|entry| (entry % 3, entry / 3)).filter(|entry| d[*entry] != 0.0) {
            let mut along = Mat3::zeros();
            for i in 0..3 {
                // δB (T + Tᵀ) B and B (T + Tᵀ) δB.
                along[(k, i)] += 2.0 * sixth[k][l][i] * s[(l, i)];
                along[(i, l)] += 2.0 * sixth[i][k][l] * s[(i, k)];
                // B (δB:T).
                along[(i, i)] += 2.0 * sixth[i][k][l] * t[(k, l)];
            }
            // δB (B:T).
            along[(k, l)] += 2.0 * traces(&sixth[k][l]);
            if k == l {
                // The change of 1/Δ.
                for i in 0..3 {
                    (0..3).for_each(|j| along[(i, j)] += sixth[k][i][j] * s[(i, j)]);
                    along[(i, i)] += traces(&sixth[k][i]);
                }
            }
            change -= 0.5 * d[(k, l)] * along;
        }
        if slope.growth != 0.0 {
            for i in 0..3 {
                (0..3).for_each(|j| change[(i, j)] += slope.growth * fourth[i][j] * s[(i, j)]);
                change[(i, i)] += slope.growth * traces(&fourth[i]);
            }
        }
        change
    }

    /// The T of T N − 𝓜:T = D, N:T = c, for a D of trace zero.
    fn solve(&self, driving: &Mat3, contracted: f64) -> Mat3 {
        let Inverse { pairs, differences: [a, b, c] } = &self.inverse;
        let second = &self.moments.second;
        let mut t = Mat3::zeros();
        for ((i, j), [one, other, beside]) in PAIRS.into_iter().zip(pairs) {
            let (ij, ji) = (driving[(i, j)], driving[(j, i)]);
            t[(i, j)] = one * ij + beside * ji;
            t[(j, i)] = other * ji + beside * ij;
        }
        // Each difference for itself: on a needle, whose two short axes are nearly equal, T₂ − T₁ is 10⁻⁸ of the others
        // and their difference would be noise. So is each T_i but for the weights L_i.
        let d = [driving[(0, 0)], driving[(1, 1)], driving[(2, 2)]];
        let differences = [c * d[2] - b * d[1], a * d[0] - c * d[2], b * d[1] - a * d[0]];
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            // T_i = c + L_j (T_i − T_j) + L_k (T_i − T_k).
            t[(i, i)] = contracted + (second[k] * differences[j] - second[j] * differences[k]);
        }
        t
    }
}

/// The stress of the fluid on an ellipsoid, in its principal axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stress {
    /// T \[Pa\].
    pub extra: Mat3,
    /// σ \[Pa\].
    pub total: Mat3,
}
