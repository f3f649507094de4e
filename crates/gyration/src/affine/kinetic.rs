//! Kinetic energies of the deformation in the place of ½ tr(Ṗ J Ṗᵀ), which do not change under P → A P:
//!
//!   W = P⁻¹ Ṗ,   Σ = ∂T/∂W,   Π = ∂T/∂Ṗ = P⁻ᵀ Σ,   K = P Πᵀ = P Σᵀ P⁻¹
//!   comoving     T = ½ tr(W J Wᵀ),              Σ = W J
//!   invariant    T = ½ (A tr W² + B (tr W)²),   Σ = A Wᵀ + B tr(W) I
//!
//! Under M̂ = M − V S the balance is that of Σ, and K changes by P M̂ᵀ alone:
//!
//!   Σ̇ = Wᵀ Σ − Σ Wᵀ + Pᵀ M̂,   P̈ = P (Ẇ + W²)
//!
//! The second one is the same under P → P A too, and indefinite: W symmetric has the sign of A, W skew the other. What
//! else a body is, incompressible, pinned, guided, in joints, asks for a constant Euler tensor and is kept apart by who
//! makes it. Source: Sławianowski, *The mechanics of the homogeneously-deformable body*, ZAMM 62 (1982).

use super::Gyration;
use crate::tensor::Mat3;

/// A kinetic energy that does not change under P → A P.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kinetic {
    /// ½ tr(W J Wᵀ).
    Comoving,
    /// ½ (A tr W² + B (tr W)²), A ≠ 0, A + 3B ≠ 0.
    Invariant {
        /// A [kg m²].
        square: f64,
        /// B [kg m²].
        trace: f64,
    },
}

impl Kinetic {
    /// Σ of W.
    fn momentum(&self, w: &Mat3, euler_tensor: &Mat3) -> Mat3 {
        match self {
            Self::Comoving => w * euler_tensor,
            Self::Invariant { square, trace } => {
                *square * w.transpose() + Mat3::from_diagonal_element(trace * w.trace())
            }
        }
    }

    /// W of Σ.
    fn velocity(&self, sigma: &Mat3, inverse: &Mat3) -> Mat3 {
        match self {
            Self::Comoving => sigma * inverse,
            Self::Invariant { square, trace } => {
                let spread = trace / (square + 3.0 * trace) * sigma.trace();
                (sigma.transpose() - Mat3::from_diagonal_element(spread)) / *square
            }
        }
    }

    /// Π of P and Ṗ, of which T is ½ Π·Ṗ [kg m²/s]; NaN where P cannot be inverted.
    pub(crate) fn canonical_momentum(&self, p: &Mat3, rate: &Mat3, euler_tensor: &Mat3) -> Mat3 {
        let inverse = p.try_inverse().unwrap_or(Mat3::from_element(f64::NAN));
        inverse.tr_mul(&self.momentum(&(inverse * rate), euler_tensor))
    }

    /// dK/dt of P̈ [N m].
    pub(crate) fn affine_momentum_rate(&self, at: &Gyration, acceleration: &Mat3, euler_tensor: &Mat3) -> Mat3 {
        let w = at.inverse * at.rate;
        let sigma = self.momentum(&w, euler_tensor).transpose();
        let grown = self.momentum(&(at.inverse * acceleration - w * w), euler_tensor).transpose();
        at.gradient * (grown + w * sigma - sigma * w) * at.inverse
    }
}

/// The balance at P, Ṗ and M̂, and its derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct KineticBalance<'a> {
    kinetic: Kinetic,
    at: &'a Gyration,
    /// J and J⁻¹.
    inertia: [&'a Mat3; 2],
    /// M̂.
    moment: Mat3,
    /// W.
    w: Mat3,
    /// Σ.
    sigma: Mat3,
    /// Ẇ + W².
    straight: Mat3,
}

impl<'a> KineticBalance<'a> {
    /// Of a body of this Euler tensor and its inverse.
    pub fn of(kinetic: Kinetic, at: &'a Gyration, inertia: [&'a Mat3; 2], moment: Mat3) -> Self {
        let w = at.inverse * at.rate;
        let sigma = kinetic.momentum(&w, inertia[0]);
        let turned = w.transpose() * sigma - sigma * w.transpose();
        let straight = kinetic.velocity(&(turned + at.gradient.tr_mul(&moment)), inertia[1]) + w * w;
        Self { kinetic, at, inertia, moment, w, sigma, straight }
    }

    /// P̈.
    pub fn acceleration(&self) -> Mat3 {
        self.at.gradient * self.straight
    }

    /// δP̈ along δP, δṖ and δM̂.
    pub fn along(&self, dp: &Mat3, drate: &Mat3, dmoment: &Mat3) -> Mat3 {
        let Self { kinetic, at, inertia: [euler_tensor, inverse], moment, w, sigma, straight } = self;
        let dw = at.inverse * (drate - dp * w);
        let dsigma = kinetic.momentum(&dw, euler_tensor);
        let turned = dw.transpose() * sigma + w.transpose() * dsigma - dsigma * w.transpose() - sigma * dw.transpose();
        let pulled = dp.tr_mul(moment) + at.gradient.tr_mul(dmoment);
        dp * straight + at.gradient * (kinetic.velocity(&(turned + pulled), inverse) + dw * w + w * dw)
    }
}
