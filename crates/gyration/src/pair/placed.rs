//! The plane in balance, and where its force begins.

use super::Vec4;
use super::plane::Plane;
use crate::tensor::Vec3;

/// The plane in balance, and what is exchanged there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed {
    pub plane: Plane,
    /// Two directions across n.
    pub tangents: [Vec3; 2],
    /// U [J].
    pub energy: f64,
    /// a.
    pub first: [Vec4; 2],
    /// λ.
    pub weights: [f64; 2],
    /// δ log χ′ by δ log U.
    pub switching: f64,
}

/// The switching function, four times differentiable: χ(U) = U (1 − U_c/U)₊⁵ in the place of U.
///
///   χ′ = (1 − x)⁴ (1 + 4x),   χ″ = 20 x² (1 − x)³/U,   x = U_c/U
#[derive(Debug, Clone, Copy)]
pub(super) struct Switch {
    /// χ/U.
    pub value: f64,
    /// χ′.
    pub slope: f64,
    /// δ log χ′ by δ log U.
    pub bend: f64,
}

impl Switch {
    /// At an energy, given that at which the pair begins [J].
    pub fn at(threshold: f64, energy: f64) -> Self {
        let part = (threshold / energy).min(1.0);
        let left = 1.0 - part;
        Self {
            value: left.powi(5),
            slope: left.powi(4) * (1.0 + 4.0 * part),
            bend: if left > 0.0 { 20.0 * part * part / (left * (1.0 + 4.0 * part)) } else { 0.0 },
        }
    }
}

impl Placed {
    /// Lets the pair begin at an energy U_c [J].
    pub fn switch(&mut self, threshold: f64) {
        let switch = Switch::at(threshold, self.energy);
        self.energy *= switch.value;
        self.weights = self.weights.map(|weight| switch.slope * weight);
        self.switching = switch.bend;
    }

    /// N [N]: what the repulsion presses both together with.
    pub fn push(&self) -> f64 {
        self.weights[0] * self.first[0][0]
    }

    /// Whether they do nothing to each other.
    pub fn is_out_of_reach(&self) -> bool {
        self.weights == [0.0; 2]
    }
}
