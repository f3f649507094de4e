//! What the material of a body does: its elastic gradient and stress, internal friction, and Eshelby's stress.
//!
//!   F = P G⁻¹,   S_e = g (∂φ/∂F) G⁻ᵀ,   S = S_e + τ P⁻ᵀ − π P⁻ᵀ,   τ = μ sym(Ḟ F⁻¹) + τ_L,   g = det G
//!   A = Fᵀ (S − τ_L P⁻ᵀ) Gᵀ − g φ I
//!
//! τ_L is the friction of the medium in which a body deforms (`internal_friction`); it takes no part in the law of
//! contraction μ_γ V_G = A + Q. Of a body that does not drive itself G = I. Source: `docs/theory-contractile.md`.

use super::interior::Interior;
use crate::affine::{AffineBody, Gyration};
use crate::contractile::Decomposition;
use crate::instant::{BodyAt, KindAt};
use crate::tensor::Mat3;

/// What the material of a body does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elasticity {
    /// F; of a rigid body its rotation.
    pub elastic_gradient: Mat3,
    /// S_e, first Piola stress without friction and pressure [Pa]; NaN of a rigid body.
    pub elastic_stress: Mat3,
    /// A [Pa]; NaN of a rigid body.
    pub eshelby: Mat3,
    /// τ, Kirchhoff stress of internal friction [Pa]; zero of a rigid body.
    pub(super) friction: Mat3,
}

impl Elasticity {
    /// Of a body whose balance is solved.
    pub(super) fn of(at: &BodyAt, interior: &Interior) -> Self {
        match at.kind() {
            KindAt::Rigid(..) => Self::of_rigid(&at.motion.placement.gradient),
            KindAt::Affine(affine, gyration) => {
                Self::new(&affine.interior, gyration, &uncontracted(gyration), interior)
            }
            KindAt::Contractile(contractile, gyration, decomposition) => {
                Self::new(&contractile.affine.interior, gyration, decomposition, interior)
            }
        }
    }

    fn of_rigid(rotation: &Mat3) -> Self {
        let nothing = Mat3::from_element(f64::NAN);
        Self { elastic_gradient: *rotation, elastic_stress: nothing, eshelby: nothing, friction: Mat3::zeros() }
    }

    fn new(body: &AffineBody, at: &Gyration, parts: &Decomposition, interior: &Interior) -> Self {
        let Decomposition { contraction, inverse, volume_ratio, elastic } = parts;
        let response = body.material.as_ref().map(|material| material.response(elastic));
        let (energy, slope) = response.map_or((0.0, Mat3::zeros()), |response| (response.energy, response.stress));
        // F⁻¹ = G P⁻¹.
        let back = contraction * at.inverse;
        let straining = at.velocity_gradient - elastic * interior.contraction_velocity * back;
        let medium = body.medium_friction(at);
        let own_stress = interior.stress - medium * at.inverse.transpose();
        let eshelby = elastic.transpose() * own_stress * contraction.transpose();
        Self {
            elastic_gradient: *elastic,
            elastic_stress: *volume_ratio * slope * inverse.transpose(),
            eshelby: eshelby - Mat3::from_diagonal_element(volume_ratio * energy),
            friction: 0.5 * body.viscosity.kirchhoff * (straining + straining.transpose()) + medium,
        }
    }
}

/// G = I.
fn uncontracted(at: &Gyration) -> Decomposition {
    let identity = Mat3::identity();
    Decomposition { contraction: identity, inverse: identity, volume_ratio: 1.0, elastic: at.gradient }
}
