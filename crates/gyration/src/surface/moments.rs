//! Moments of a power of the gap over a surface, and what is asked of them.

use crate::tensor::{Mat3, SymmetricThird, Vec3};

/// The function of the gap under the integral.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kernel {
    /// d^−ν, ν ≥ −1 (a potential has the exponent of its law less one).
    Power(f64),
    /// ln d.
    Log,
}

/// Which moments are wanted: all up to `order` (0 to 3) for one kernel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MomentRequest {
    /// The function of the gap.
    pub kernel: Kernel,
    /// The highest order wanted, 0 to 3; higher ones are left untouched.
    pub order: usize,
}

/// Moments of a kernel over a surface, about the origin of X.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moments {
    /// A₀ = ∫ κ dA.
    pub zeroth: f64,
    /// A₁ = ∫ κ X dA.
    pub first: Vec3,
    /// A₂ = ∫ κ X⊗X dA, symmetric.
    pub second: Mat3,
    /// A₃ = ∫ κ X⊗X⊗X dA, symmetric.
    pub third: SymmetricThird,
}

/// Moments of a kernel over a sphere about the origin, c = m/|m|: A₁ = a₁ c, A₂ = a_c c⊗c + a_⊥ (1 − c⊗c).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AxialMoments {
    /// A₀.
    pub zeroth: f64,
    /// a₁; without meaning where the order is below 1.
    pub first: f64,
    /// a_c; without meaning where the order is below 2.
    pub along: f64,
    /// a_⊥, likewise.
    pub across: f64,
}

impl Moments {
    /// Adds another surface's moments, up to `order`.
    pub(crate) fn add(&mut self, other: &Self, order: usize) {
        self.zeroth += other.zeroth;
        if order >= 1 {
            self.first += other.first;
        }
        if order >= 2 {
            self.second += other.second;
        }
        if order >= 3 {
            for (sum, entry) in self.third.0.iter_mut().zip(other.third.0) {
                *sum += entry;
            }
        }
    }

    /// Multiplies all of them by a number.
    pub(crate) fn scale(&mut self, by: f64) {
        self.zeroth *= by;
        self.first *= by;
        self.second *= by;
        self.third.0.iter_mut().for_each(|entry| *entry *= by);
    }
}
