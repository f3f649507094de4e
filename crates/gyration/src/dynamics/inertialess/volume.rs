//! What keeps the volume of an incompressible body without inertia, in the place of an equation of motion.

use super::super::contractile::ContractileMotion;
use crate::affine::StrainGuide;
use crate::body::Slots;
use crate::contractile::ContractionCommand;
use crate::instant::{KindAt, MotionAt};
use crate::tensor::Mat3;

/// The constraint tr(Ṗ P⁻¹) = θ, and the direction Y = P⁻ᵀJ⁻¹ of the acceleration that its pressure gives.
#[derive(Debug, Clone)]
pub(super) struct KeptVolume {
    /// P⁻¹.
    pub inverse: Mat3,
    /// J⁻¹.
    mobility: Mat3,
    /// Y, or ΠY of a body with a guide.
    pub direction: Mat3,
    /// Π, if it has one.
    guide: Option<Box<StrainGuide>>,
    /// θ [1/s].
    pub growth: f64,
}

impl KeptVolume {
    /// None where the volume is free, or where the law of contraction gives the pressure.
    pub fn of(at: &MotionAt) -> Option<Self> {
        let (affine, gyration, growth) = match at.kind() {
            KindAt::Rigid(..) => return None,
            KindAt::Affine(affine, gyration) => (affine, gyration, 0.0),
            KindAt::Contractile(contractile, gyration, decomposition) => {
                if contractile.contraction.gives_pressure() {
                    return None;
                }
                let moving = ContractileMotion { at, contractile, gyration, decomposition };
                let growth = if let ContractionCommand::Velocity(velocity, _) = moving.command() {
                    velocity.trace()
                } else {
                    0.0
                };
                (&contractile.affine, gyration, growth)
            }
        };
        if !affine.interior.is_incompressible() {
            return None;
        }
        let (inverse, mobility) = (gyration.inverse, affine.interior.inverse);
        let (direction, guide) = (affine.interior.way(&inverse), affine.interior.guide.clone());
        Some(Self { inverse, mobility, direction, guide, growth })
    }

    /// The change of λ Y and of θ − tr(Ṗ P⁻¹) with one of the numbers of a body, which stand as with inertia, at a Ṗ
    /// that is kept; none but with those of P.
    ///
    ///   λ δY = −λ P⁻ᵀ δPᵀ P⁻ᵀ J⁻¹,   δ(θ − tr(Ṗ P⁻¹)) = tr(Ṗ P⁻¹ δP P⁻¹)
    pub fn along(
        &self,
        slots: &Slots,
        column: usize,
        rate: &Mat3,
        acceleration: impl Fn() -> Mat3,
    ) -> Option<(Mat3, f64)> {
        if !slots.attitude().contains(&column) {
            return None;
        }
        let entry = column - slots.attitude().start;
        let (row, place) = (entry % 3, entry / 3);
        // δP = e_j ⊗ e_B: δ(P⁻ᵀ) = −P⁻ᵀ δPᵀ P⁻ᵀ.
        let turned = -(self.inverse.row(place).transpose() * self.inverse.column(row).transpose());
        let mut change = self.multiplier(&acceleration()) * turned * self.mobility;
        if let Some(guide) = &self.guide {
            change = guide.within(&change);
        }
        Some((change, -rate.dot(&turned)))
    }

    /// λ of the accelerations P̈ at balance.
    fn multiplier(&self, acceleration: &Mat3) -> f64 {
        let across = self.inverse.transpose();
        acceleration.dot(&across) / self.direction.dot(&across)
    }
}
