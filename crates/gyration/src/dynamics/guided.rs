//! What the guide of a body makes of its accelerations.
//!
//!   p̈₀ = Π_c a,   Ω̇ = Π_t α,   P̈ = H A = Π A + λ ΠY,   λ = c·(A − ΠA)/(c·ΠY)
//!
//! a, α, A are the accelerations without the guide. λ is what the pressure of an incompressible body grows by, so that
//! tr(P̈ P⁻¹) = c·P̈ stays what it has to be: c = P⁻ᵀ, Y = P⁻ᵀJ⁻¹. H is linear, and serves changes of A as well; its
//! own change along δP is that of c and Y,
//!
//!   δH A = λ Πδ(Y) + ΠY (δc·(A − P̈) − λ c·Πδ(Y))/(c·ΠY)
//!
//! Source: `docs/theory-affine.md`.

use crate::affine::{AffineBody, Gyration, StrainGuide};
use crate::body::{Guide, Slots};
use crate::instant::{KindAt, MotionAt};
use crate::tensor::{Mat3, Vec3};

/// How a body that deforms is kept to its gradients at an instant.
#[derive(Debug)]
pub(super) struct GuidedStrain<'a> {
    strain: &'a StrainGuide,
    volume: Option<GuidedVolume>,
}

/// What keeps tr(P̈ P⁻¹).
#[derive(Debug)]
struct GuidedVolume {
    /// P⁻¹.
    inverse: Mat3,
    /// J⁻¹.
    mobility: Mat3,
    /// ΠY.
    way: Mat3,
    /// 1/(c·ΠY).
    compliance: f64,
}

impl<'a> GuidedStrain<'a> {
    /// Of a body whose pressure keeps the second derivative of det P, or has no such pressure; none without a guide.
    pub fn of(interior: &'a AffineBody, gyration: &Gyration, keeps_volume: bool) -> Option<Self> {
        let strain = interior.guide.as_deref()?;
        let volume = keeps_volume.then(|| {
            let (inverse, way) = (gyration.inverse, interior.way(&gyration.inverse));
            let compliance = 1.0 / way.dot(&inverse.transpose());
            GuidedVolume { inverse, mobility: interior.inverse, way, compliance }
        });
        Some(Self { strain, volume })
    }

    /// Of a body at an instant; none of one that is rigid or has no guide.
    pub fn at(at: &MotionAt<'a>) -> Option<Self> {
        match at.kind() {
            KindAt::Rigid(..) => None,
            KindAt::Affine(affine, gyration) => {
                Self::of(&affine.interior, gyration, affine.interior.is_incompressible())
            }
            KindAt::Contractile(contractile, gyration, _) => {
                let interior = &contractile.affine.interior;
                let keeps_volume = interior.is_incompressible() && !contractile.contraction.gives_pressure();
                Self::of(interior, gyration, keeps_volume)
            }
        }
    }

    /// H A, and λ.
    pub fn hold(&self, acceleration: &Mat3) -> (Mat3, f64) {
        let within = self.strain.within(acceleration);
        let Some(GuidedVolume { inverse, way, compliance, .. }) = &self.volume else { return (within, 0.0) };
        let push = (acceleration - within).dot(&inverse.transpose()) * compliance;
        (within + way * push, push)
    }

    /// Whether the pressure of the body has to keep tr(P̈ P⁻¹).
    pub fn keeps_volume(&self) -> bool {
        self.volume.is_some()
    }

    /// What a pressure takes back of the P̈ of a body without inertia, as a multiple of Y.
    pub fn taken(&self, acceleration: &Mat3) -> f64 {
        let Some(GuidedVolume { inverse, compliance, .. }) = &self.volume else { return 0.0 };
        acceleration.dot(&inverse.transpose()) * compliance
    }

    /// δH A along δP_jB, given A.
    pub fn along(&self, (j, b): (usize, usize), acceleration: &Mat3) -> Mat3 {
        let Some(GuidedVolume { inverse, mobility, way, compliance }) = &self.volume else { return Mat3::zeros() };
        let (held, push) = self.hold(acceleration);
        // δP = e_j ⊗ e_B: δ(P⁻ᵀ) = −P⁻ᵀ δPᵀ P⁻ᵀ.
        let turned = -(inverse.row(b).transpose() * inverse.column(j).transpose());
        let change = push * self.strain.within(&(turned * mobility));
        let missing = turned.dot(&(acceleration - held)) - change.dot(&inverse.transpose());
        change + way * (missing * compliance)
    }
}

/// The guide of a body at an instant, for changes of its accelerations.
#[derive(Debug)]
pub(super) struct Guided<'a> {
    guide: &'a Guide,
    /// How it deforms, if it does.
    pub strain: Option<GuidedStrain<'a>>,
    /// Where its numbers stand with inertia, from 0.
    pub slots: Slots,
}

impl<'a> Guided<'a> {
    /// None of a body without a guide.
    pub fn at(at: &MotionAt<'a>) -> Option<Self> {
        let guide = at.body.guide.as_deref()?;
        Some(Self { guide, strain: GuidedStrain::at(at), slots: Slots::with_inertia(at.body, 0) })
    }

    /// H of changes of the rates of (velocity, rate).
    pub fn hold(&self, changes: &mut [f64]) {
        let (linear, own) = changes.split_at_mut(self.slots.velocity().len());
        if let (Some(center), false) = (&self.guide.center, linear.is_empty()) {
            linear.copy_from_slice((center * Vec3::from_column_slice(linear)).as_slice());
        }
        if let Some(strain) = &self.strain {
            own.copy_from_slice(strain.hold(&Mat3::from_column_slice(own)).0.as_slice());
        } else if let Some(turn) = &self.guide.turn {
            own.copy_from_slice(turn.within(&Vec3::from_column_slice(own)).as_slice());
        }
    }
}
