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
    /// How it begins.
    pub switch: Switch,
}

/// The switching function, four times differentiable: χ(U) = U (1 − U_c/U)₊⁵ in the place of U.
///
///   χ′ = (1 − x)⁴ (1 + 4x),   χ″ = 20 x² (1 − x)³/U,   x = U_c/U
///
/// What else has a potential W between the two, S(U) W takes its place, S = (1 − x)₊⁵: it pulls by S times its own
/// force and W S′/χ′ times that of χ(U), S′ = 5 x (1 − x)⁴/U.
#[derive(Debug, Clone, Copy)]
pub(super) struct Switch {
    /// S = χ/U.
    pub value: f64,
    /// χ′.
    pub slope: f64,
    /// δ log χ′ by δ log U.
    pub bend: f64,
    /// S′U, δS by δ log U.
    pub rise: f64,
    /// S′/χ′ [1/J].
    pub lift: f64,
    /// δ log (S′/χ′) by δ log U.
    pub lifting: f64,
}

impl Switch {
    /// Of a pair that acts everywhere.
    pub const NONE: Self = Self { value: 1.0, slope: 1.0, bend: 0.0, rise: 0.0, lift: 0.0, lifting: 0.0 };

    /// At an energy, given that at which the pair begins [J].
    pub fn at(threshold: f64, energy: f64) -> Self {
        let part = (threshold / energy).min(1.0);
        let left = 1.0 - part;
        let steep = 1.0 + 4.0 * part;
        Self {
            value: left.powi(5),
            slope: left.powi(4) * steep,
            bend: if left > 0.0 { 20.0 * part * part / (left * steep) } else { 0.0 },
            rise: 5.0 * part * left.powi(4),
            lift: 5.0 * part / (steep * energy),
            lifting: -(2.0 + 4.0 * part) / steep,
        }
    }
}

impl Placed {
    /// Lets the pair begin at an energy U_c [J].
    pub fn switch(&mut self, threshold: f64) {
        let switch = Switch::at(threshold, self.energy);
        self.energy *= switch.value;
        self.weights = self.weights.map(|weight| switch.slope * weight);
        self.switch = switch;
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
