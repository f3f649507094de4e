//! The balance of an affine body about its centre of mass, or about its pin:
//!
//!   P̈ J = M − V S,   S = ∂φ/∂P + τ P⁻ᵀ − π P⁻ᵀ
//!
//! V reference volume, J Euler tensor, M affine moment of the loads, φ energy of the material, τ viscous Kirchhoff
//! stress, π the pressure of an incompressible body (`constraint`). Everything here is a function of P, Ṗ and M: no
//! state, no time, no contact. Derivatives are in `slopes`, other kinetic energies in `kinetic`, the inertia of a fluid
//! in `added`. Source: `docs/theory-affine.md`.

mod added;
mod anisotropic;
mod constraint;
mod elastic;
mod guide;
mod gyration;
mod kinetic;
mod mobility;
mod reaction;
mod slopes;
mod solution;
mod terms;
mod viscosity;

pub use added::AddedInertia;
pub(crate) use added::{Accelerated, AddedBalance};
pub use anisotropic::AnisotropicFriction;
pub(crate) use constraint::Constraint;
pub use constraint::Correction;
pub use guide::StrainGuide;
pub use gyration::Gyration;
pub use kinetic::Kinetic;
pub use slopes::AffineSlopes;
pub(crate) use terms::Entry;
pub use viscosity::Viscosity;

use crate::mass::MassProperties;
use crate::material::Material;
use crate::simd::{F64x4, SimdMat3, WithF64x4, dispatch_f64x4};
use crate::tensor::Mat3;
use kinetic::KineticBalance;
use mobility::Mobility;
use solution::Solution;

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
    /// The gradients that it is kept to, if it is.
    pub guide: Option<Box<StrainGuide>>,
    /// Its kinetic energy, if that is not ½ tr(Ṗ J Ṗᵀ); of a body that is incompressible, pinned, kept or remembered by
    /// a fluid it is.
    pub kinetic: Option<Kinetic>,
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
    /// S [Pa].
    pub stress: Mat3,
    /// π [Pa]; none if the volume may change.
    pub pressure: Option<f64>,
    /// V τ·L ≥ 0, what internal friction turns into heat [W].
    pub dissipation: f64,
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
            Some(inverse) if smallest > SINGULAR_RATIO * largest => {
                let inverse = inverse / largest;
                Ok(Self {
                    volume: mass.volume,
                    euler_tensor,
                    inverse,
                    material,
                    viscosity,
                    anisotropic: None,
                    guide: None,
                    kinetic: None,
                })
            }
            _ => Err(SingularEulerTensor { smallest, largest }),
        }
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

    /// B J⁻¹.
    #[inline(always)]
    pub(crate) fn per_inertia<F: F64x4>(&self, moment: &SimdMat3<F>) -> SimdMat3<F> {
        Mobility::of(&self.inverse).of_moment(moment)
    }

    /// S_e Pᵀ.
    #[inline(always)]
    fn elastic_stress<F: F64x4>(&self, at: &Gyration, registers: F) -> Option<SimdMat3<F>> {
        let p = || SimdMat3::of(&at.gradient).with(registers);
        self.material.as_ref().map(|material| material.kirchhoff_stress_at(&p(), at.volume_ratio))
    }

    /// Y = P⁻ᵀ J⁻¹, as far as the body may go that way, of an inverse P⁻¹.
    pub(crate) fn way(&self, inverse: &Mat3) -> Mat3 {
        let way = inverse.transpose() * self.inverse;
        self.guide.as_ref().map_or(way, |guide| guide.within(&way))
    }

    /// Solves the balance for P̈ and, of an incompressible body, the pressure; `moment` is M [N m].
    pub fn balance(&self, at: &Gyration, moment: &Mat3) -> AffineBalance {
        let mut balance = dispatch_f64x4(Balance { body: self, at, moment });
        if let Some(kinetic) = self.kinetic {
            let free = moment - balance.stress * self.volume;
            balance.acceleration = KineticBalance::of(kinetic, at, self.inertia(), free).acceleration();
        }
        balance
    }

    /// J and J⁻¹.
    fn inertia(&self) -> [&Mat3; 2] {
        [&self.euler_tensor, &self.inverse]
    }

    /// Puts an incompressible body back to det P = 1 and tr L = 0; leaves any other as it is.
    pub fn project(&self, p: &Mat3, rate: &Mat3) -> Correction {
        if self.is_incompressible() { constraint::project(self, p, rate) } else { Correction::none(p, rate) }
    }

    /// Puts P and Ṗ to det P = `volume` and tr L = `growth` [1/s], whatever the material.
    pub(crate) fn project_to(&self, p: &Mat3, rate: &Mat3, volume: f64, growth: f64) -> Correction {
        constraint::project_to(self, (p, rate), volume, growth)
    }

    /// τ of the internal friction that acts on L whatever the body does by itself: Newtonian and anisotropic [Pa]; none
    /// without it.
    #[inline(always)]
    pub(crate) fn medium_stress<F: F64x4>(&self, at: &Gyration, l: &SimdMat3<F>) -> Option<SimdMat3<F>> {
        let mut stress = None;
        if let Some(newtonian) = self.viscosity.newtonian() {
            stress = Some(newtonian.stress_at(at.volume_ratio, l));
        }
        if let Some(friction) = &self.anisotropic {
            let own = SimdMat3::of(&friction.kirchhoff_stress(at)).with(l.0[0].0);
            stress = Some(if let Some(stress) = stress { stress + own } else { own });
        }
        stress
    }

    /// The same as a matrix; zero without such friction.
    pub(crate) fn medium_friction(&self, at: &Gyration) -> Mat3 {
        let stress = self.medium_stress(at, &SimdMat3::of(&at.velocity_gradient));
        stress.map_or(Mat3::zeros(), |stress| stress.matrix())
    }

    /// A body of the same inertia with that friction alone; none without it.
    pub(crate) fn medium(&self) -> Option<Self> {
        let viscosity = self.viscosity.newtonian();
        (viscosity.is_some() || self.anisotropic.is_some()).then(|| Self {
            material: None,
            viscosity: viscosity.unwrap_or_default(),
            ..self.clone()
        })
    }
}

/// The balance to be solved.
struct Balance<'a> {
    body: &'a AffineBody,
    at: &'a Gyration,
    moment: &'a Mat3,
}

impl WithF64x4 for Balance<'_> {
    type Output = AffineBalance;

    #[inline(always)]
    fn run<F: F64x4>(self, zeros: F) -> AffineBalance {
        let Self { body, at, moment } = self;
        let elastic = body.elastic_stress(at, zeros);
        Solution::new(body, at, elastic, &SimdMat3::of(moment).with(zeros)).balance(body)
    }
}
