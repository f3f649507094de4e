//! The balance of an affine body about its centre of mass, or about its pin:
//!
//!   P̈ J = M − V S,   S = ∂φ/∂P + τ P⁻ᵀ − π P⁻ᵀ
//!
//! V reference volume, J Euler tensor, M affine moment of the loads, φ energy of the material, τ viscous Kirchhoff
//! stress, π the pressure of an incompressible body (`constraint`). Everything here is a function of P, Ṗ and M:
//! no state, no time, no contact. Source: `physics.md` §2, §4.

mod anisotropic;
mod constraint;
mod viscosity;

pub use anisotropic::AnisotropicFriction;
pub use constraint::Correction;
pub use viscosity::Viscosity;

use crate::mass::MassProperties;
use crate::material::{Material, Tangent};
use crate::tensor::Mat3;
use constraint::{Constraint, ConstraintSlopes};

/// What makes a body affine: its inertia and what it is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct AffineBody {
    /// V \[m³\].
    pub volume: f64,
    /// J about the centre of mass or the pin \[kg m²\].
    pub euler_tensor: Mat3,
    /// J⁻¹.
    pub inverse: Mat3,
    /// None: free and compressible, without elasticity.
    pub material: Option<Material>,
    /// Internal friction.
    pub viscosity: Viscosity,
    /// More of it, with directions of its own.
    pub anisotropic: Option<AnisotropicFriction>,
}

/// The Euler tensor cannot be inverted: the mass lies in a plane, and the stretch across it has no meaning.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the Euler tensor is singular (principal values from {smallest:e} to {largest:e} kg m²): all mass lies in one \
     plane, and stretching the body across it would cost nothing; give it some thickness, or make it rigid"
)]
pub struct SingularEulerTensor {
    /// Smallest principal value \[kg m²\].
    pub smallest: f64,
    /// Largest principal value \[kg m²\].
    pub largest: f64,
}

/// Principal values whose ratio is below this cannot be told from zero after the rounding of their integrals.
const SINGULAR_RATIO: f64 = 1e-13;

/// What follows from P, Ṗ and M.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AffineBalance {
    /// P̈ [1/s²].
    pub acceleration: Mat3,
    /// S without the pressure [Pa].
    pub stress: Mat3,
    /// π [Pa]; none if the volume may change.
    pub pressure: Option<f64>,
    /// V φ [J].
    pub energy: f64,
    /// V τ·L ≥ 0, what internal friction turns into heat [W].
    pub dissipation: f64,
}

/// The derivative of the balance at P, Ṗ, M.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AffineSlopes<'a> {
    body: &'a AffineBody,
    gradient: Mat3,
    gyration: Gyration,
    tangent: Option<Tangent>,
    kirchhoff: Mat3,
    constraint: Option<ConstraintSlopes>,
}

/// P⁻¹ and L = Ṗ P⁻¹.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gyration {
    pub inverse: Mat3,
    pub gradient: Mat3,
}

impl Gyration {
    /// None where P cannot be inverted.
    fn of(p: &Mat3, rate: &Mat3) -> Option<Self> {
        let inverse = p.try_inverse()?;
        Some(Self { inverse, gradient: rate * inverse })
    }

    /// The changes of P⁻¹ and L: dP⁻¹ = −P⁻¹ dP P⁻¹, dL = (dṖ − L dP) P⁻¹.
    fn change(&self, dp: &Mat3, drate: &Mat3) -> Self {
        let inverse = -self.inverse * (dp * self.inverse);
        Self { inverse, gradient: (drate - self.gradient * dp) * self.inverse }
    }
}

impl AffineBody {
    /// The body of this mass about its centre, or about a pin at r from it: J_p = J + m r⊗r.
    ///
    /// # Errors
    /// [`SingularEulerTensor`] if the mass lies in a plane.
    pub fn new(
        mass: &MassProperties,
        arm: Option<&crate::tensor::Vec3>,
        material: Option<Material>,
        viscosity: Viscosity,
    ) -> Result<Self, SingularEulerTensor> {
        let shift = arm.map_or(Mat3::zeros(), |r| mass.mass * r * r.transpose());
        let euler_tensor = mass.euler_tensor + shift;
        let principal = euler_tensor.symmetric_eigenvalues();
        let (smallest, largest) = (principal.min(), principal.max());
        // Scaled, so that the determinant neither under- nor overflows for a grain or a mountain.
        match (euler_tensor / largest).try_inverse() {
            Some(inverse) if smallest > SINGULAR_RATIO * largest => Ok(Self {
                volume: mass.volume,
                euler_tensor,
                inverse: inverse / largest,
                material,
                viscosity,
                anisotropic: None,
            }),
            _ => Err(SingularEulerTensor { smallest, largest }),
        }
    }

    /// τ \[Pa\], the viscous part of the Kirchhoff stress.
    fn viscous_stress(&self, p: &Mat3, l: &Mat3) -> Mat3 {
        let isotropic = self.viscosity.kirchhoff_stress(p, l);
        self.anisotropic.map_or(isotropic, |friction| isotropic + friction.kirchhoff_stress(p, l))
    }

    /// Whether it has internal friction.
    pub fn dissipates(&self) -> bool {
        self.viscosity != Viscosity::default() || self.anisotropic.is_some()
    }

    /// Whether det P = 1 is a constraint.
    pub fn is_incompressible(&self) -> bool {
        self.material.as_ref().is_some_and(Material::is_incompressible)
    }

    /// V φ \[J\].
    pub fn energy(&self, p: &Mat3) -> f64 {
        self.volume * self.material.as_ref().map_or(0.0, |material| material.response(p).energy)
    }

    /// Solves the balance for P̈ and, of an incompressible body, the pressure. None where P cannot be inverted.
    ///
    /// P (3×3), Ṗ (3×3) [1/s], M (3×3) [N m].
    pub fn balance(&self, p: &Mat3, rate: &Mat3, moment: &Mat3) -> Option<AffineBalance> {
        let gyration = Gyration::of(p, rate)?;
        let response = self.material.as_ref().map(|material| material.response(p));
        let elastic = response.map_or(Mat3::zeros(), |response| response.stress);
        let kirchhoff = self.viscous_stress(p, &gyration.gradient);
        let stress = elastic + kirchhoff * gyration.inverse.transpose();
        let free = moment - self.volume * stress;
        let constraint = self.is_incompressible().then(|| Constraint::solve(self, &gyration, &free));
        let driven = free + constraint.map_or(Mat3::zeros(), |constraint| constraint.reaction(self, &gyration));
        Some(AffineBalance {
            acceleration: driven * self.inverse,
            stress,
            pressure: constraint.map(|constraint| constraint.pressure),
            energy: self.volume * response.map_or(0.0, |response| response.energy),
            dissipation: self.volume * kirchhoff.dot(&gyration.gradient),
        })
    }

    /// The derivative of the balance. None where P cannot be inverted.
    pub fn slopes(&self, p: &Mat3, rate: &Mat3, moment: &Mat3) -> Option<AffineSlopes<'_>> {
        let gyration = Gyration::of(p, rate)?;
        let tangent = self.material.as_ref().map(|material| material.tangent(p));
        let kirchhoff = self.viscous_stress(p, &gyration.gradient);
        let constraint = if self.is_incompressible() {
            let free = moment - self.volume * self.balance(p, rate, moment)?.stress;
            Some(ConstraintSlopes::new(self, &gyration, &free))
        } else {
            None
        };
        Some(AffineSlopes { body: self, gradient: *p, gyration, tangent, kirchhoff, constraint })
    }

    /// Puts an incompressible body back to det P = 1 and tr L = 0; leaves any other as it is.
    pub fn project(&self, p: &Mat3, rate: &Mat3) -> Correction {
        if self.is_incompressible() { constraint::project(self, p, rate) } else { Correction::none(p, rate) }
    }
}

impl AffineSlopes<'_> {
    /// The changes of P̈ and of the pressure (0 without one) with those of P, Ṗ and M.
    pub fn apply(&self, dp: &Mat3, drate: &Mat3, dmoment: &Mat3) -> (Mat3, f64) {
        let Self { body, gradient, gyration, tangent, kirchhoff, constraint } = self;
        let change = gyration.change(dp, drate);
        let elastic = tangent.map_or(Mat3::zeros(), |tangent| tangent.apply(dp));
        let mut dkirchhoff = body.viscosity.change(gradient, gyration, &change, dp);
        if let Some(friction) = &body.anisotropic {
            dkirchhoff += friction.change(gradient, gyration, &change, dp);
        }
        let viscous = dkirchhoff * gyration.inverse.transpose() + kirchhoff * change.inverse.transpose();
        let free = dmoment - body.volume * (elastic + viscous);
        let (reaction, pressure) =
            constraint.map_or((Mat3::zeros(), 0.0), |constraint| constraint.apply(body, gyration, &change, &free));
        ((free + reaction) * body.inverse, pressure)
    }
}
