//! A body: the solid that it is, and its kind.
//!
//! Everything is relative to the centre of mass. A rigid body has the configuration (p₀, P = R) and the velocity (ṗ₀,
//! Ω), an affine body (p₀, P) and (ṗ₀, Ṗ), a contractile one G besides; `layout` says where these stand in the state. A
//! pinned body has no position of its own; a body in a fluid that has no inertia has no velocities in its state.

mod guide;
mod layout;
mod solid;

pub use guide::{Guide, TurnGuide};
pub use layout::{Slots, matrix, vector};
pub use solid::Solid;

use crate::affine::{AffineBody, Kinetic};
use crate::contractile::{self, Contraction, Decomposition, Restored};
use crate::fluid::{History, Inclusion};
use crate::kinematics::Placement;
use crate::ledger::{Energy, Work};
use crate::load::{Couple, LinearResistance, OwnForces};
use crate::mass::MassProperties;
use crate::surface::{GapField, Surface};
use crate::tensor::{Mat3, Vec3};
use std::sync::Arc;

/// A body of the model; equal bodies may share one, since the model has their names.
#[derive(Debug, Clone)]
pub struct Body {
    /// How it may deform.
    pub kind: BodyKind,
    /// Its shape, mass and surface, which equal bodies share.
    pub solid: Arc<Solid>,
    /// The material point that stays fixed in space, if any.
    pub pin: Option<Pin>,
    /// What its motion is kept to, if anything.
    pub guide: Option<Box<Guide>>,
    /// What makes it feel the fluid, if it is immersed.
    pub inclusion: Option<Inclusion>,
    /// Forces of its own, as formulas of its place and of time.
    pub own: OwnForces,
    /// Characteristic length [m]: the largest side of the bounding box.
    pub size: f64,
}

/// A material point fixed in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pin {
    /// X_p (from the centre of mass) [m].
    pub point: Vec3,
    /// Where it stays [m].
    pub anchor: Vec3,
}

/// How a body may deform.
#[derive(Debug, Clone, PartialEq)]
pub enum BodyKind {
    /// P is a rotation.
    Rigid(RigidInertia),
    /// P is free, or of determinant one.
    Affine(Box<Affine>),
    /// P = F G, and G does what the body does by itself.
    Contractile(Box<Contractile>),
}

impl BodyKind {
    /// The works that the body does by itself.
    pub fn works(&self) -> Vec<Work> {
        let (affine, contraction) = match self {
            Self::Rigid(_) => return Vec::new(),
            Self::Affine(affine) => (&**affine, None),
            Self::Contractile(contractile) => (&contractile.affine, Some(&contractile.contraction)),
        };
        let entries = [
            (Work::Viscosity, affine.interior.dissipates()),
            (Work::Contraction, contraction.is_some_and(|contraction| contraction.viscosity > 0.0)),
            (Work::Drive, contraction.is_some()),
            (Work::Constraint, affine.interior.is_incompressible()),
        ];
        entries.into_iter().filter_map(|(work, applies)| applies.then_some(work)).collect()
    }

    /// Where its own energy is stored, beside kinetic and gravity.
    pub fn energy(&self) -> Option<Energy> {
        let affine = match self {
            Self::Rigid(_) => return None,
            Self::Affine(affine) => affine,
            Self::Contractile(contractile) => &contractile.affine,
        };
        affine.interior.material.is_some().then_some(Energy::Elastic)
    }
}

/// What an affine body has beside the loads that any body may have.
#[derive(Debug, Clone, PartialEq)]
pub struct Affine {
    /// Inertia, material, internal friction: all that P̈ depends on beside the loads.
    pub interior: AffineBody,
    /// An affine moment that acts on it.
    pub couple: Option<Couple>,
    /// Friction and gyroscopic loads, linear in (ṗ₀, L).
    pub resistances: Vec<LinearResistance>,
}

impl From<AffineBody> for Affine {
    fn from(interior: AffineBody) -> Self {
        Self { interior, couple: None, resistances: Vec::new() }
    }
}

/// What makes a body contractile.
#[derive(Debug, Clone, PartialEq)]
pub struct Contractile {
    /// What it has in common with an affine body; the material is that of F, det F = 1 if it is incompressible.
    pub affine: Affine,
    /// How it contracts.
    pub contraction: Contraction,
    /// Internal friction that acts on L, as a body of its own.
    pub(crate) medium: Option<AffineBody>,
}

impl Contractile {
    /// A body that contracts.
    pub fn new(affine: Affine, contraction: Contraction) -> Self {
        let medium = affine.interior.medium();
        Self { affine, contraction, medium }
    }

    /// P, Ṗ and G as they have to be at a time \[s\]: [`Contraction::restore`].
    pub fn restore(&self, time: f64, parts: (&Mat3, &Mat3, &Mat3)) -> Restored {
        self.contraction.restore(&self.affine.interior, time, parts)
    }

    /// V g φ(F) + ½ tr(Ṗ J Ṗᵀ) of P, Ṗ and G \[J\]; not a number where det G ≤ 0.
    pub fn energy(&self, (p, rate, contraction): (&Mat3, &Mat3, &Mat3)) -> f64 {
        let interior = &self.affine.interior;
        let elastic = Decomposition::of(p, contraction).map_or(f64::NAN, |at| contractile::energy(interior, &at));
        elastic + 0.5 * (rate * interior.euler_tensor).dot(rate)
    }
}

/// The constant inertia tensor of a rigid body in its own axes, about the centre of mass or the pin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidInertia {
    /// I = tr(J) 1 − J [kg m²].
    pub tensor: Mat3,
    /// I⁻¹.
    pub inverse: Mat3,
}

/// The inertia tensor cannot be inverted: the mass lies on a line through the centre (or the pin).
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the inertia tensor is singular (smallest principal moment {smallest:e} kg m², largest {largest:e}): \
     all mass lies on one line, and the spin about it has no meaning; give the body some width"
)]
pub struct SingularInertia {
    /// Smallest principal moment [kg m²].
    pub smallest: f64,
    /// Largest principal moment [kg m²].
    pub largest: f64,
}

const NO_INERTIA: Mat3 = Mat3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);

/// Principal moments whose ratio is below this cannot be told from zero after the rounding of their integrals.
const SINGULAR_RATIO: f64 = 1e-13;

impl RigidInertia {
    /// That of a mass point, which does not turn: I⁻¹ is zero on what has no inertia.
    pub const POINT: Self = Self { tensor: NO_INERTIA, inverse: NO_INERTIA };

    /// The inertia about the centre of mass, or about the pin: J_p = J + m r⊗r, r = X_p.
    ///
    /// # Errors
    /// [`SingularInertia`] where a rotation would cost nothing.
    pub fn new(mass: &MassProperties, pin: Option<&Pin>) -> Result<Self, SingularInertia> {
        let arm = pin.map_or(Vec3::zeros(), |pin| pin.point);
        let euler = mass.euler_tensor + mass.mass * arm * arm.transpose();
        let tensor = Mat3::from_diagonal_element(euler.trace()) - euler;
        let principal = tensor.symmetric_eigenvalues();
        let (smallest, largest) = (principal.min(), principal.max());
        // Scaled, so that the determinant neither under- nor overflows for a grain or a mountain.
        match (tensor / largest).try_inverse() {
            Some(inverse) if smallest > SINGULAR_RATIO * largest => Ok(Self { tensor, inverse: inverse / largest }),
            _ => Err(SingularInertia { smallest, largest }),
        }
    }
}

/// A gap below this fraction of the lengths from which it is computed cannot be told from zero: rounding alone would
/// change the forces by more than any tolerance.
const RESOLUTION: f64 = 64.0 * f64::EPSILON;

/// The same of a gap that is computed to twice the digits.
const EXTENDED_RESOLUTION: f64 = RESOLUTION * RESOLUTION;

/// From so many sizes on the distance from the origin counts among the lengths whose difference a gap is.
const FAR: f64 = 1e3;

/// The gap, relative to size and height, below which it is computed to twice the digits: eleven of sixteen are left.
pub const NEAR: f64 = 1e-5;

/// The gap [m] that cannot be told from zero between what is of a size and what is so far away [m].
pub(crate) fn least_distance(size: f64, distance: f64) -> f64 {
    RESOLUTION * (size + distance)
}

impl Body {
    /// Whether another of the same solid is equal, so that one may stand for both; a pinned one has a place of its own.
    pub fn can_stand_for(&self, other: &Self) -> bool {
        let Self { solid, kind, size, pin, guide, inclusion, own } = self;
        Arc::ptr_eq(solid, &other.solid)
            && *kind == other.kind
            && pin.is_none()
            && other.pin.is_none()
            && guide.is_none()
            && other.guide.is_none()
            && *inclusion == other.inclusion
            && *size == other.size
            && *own == other.own
    }

    /// Whether it is one ball about its centre of mass that does not deform.
    pub fn is_rigid_ball(&self) -> bool {
        matches!(self.kind, BodyKind::Rigid(_)) && self.solid.is_ball()
    }

    /// Whether a smallest gap [m] to a support is above zero by more than its own rounding.
    pub fn is_apart(&self, gap: f64, field: &GapField) -> bool {
        gap.is_finite() && gap > self.least_gap(field)
    }

    /// The gap [m] below which its difference of two lengths leaves too few digits: size and height, and the place
    /// where that is far from the origin.
    pub(crate) fn near_gap(&self, field: &GapField, position: &Vec3) -> f64 {
        let distance = position.amax();
        let far = if distance > FAR * self.size { distance } else { 0.0 };
        NEAR * (self.size + field.height.abs() + far)
    }

    /// Whether small gaps of its surface are known to twice the digits.
    pub fn keeps_digits(&self, surface: &Surface) -> bool {
        // A volume is put back to what it has to be with the digits of one number.
        let kept = match &self.kind {
            BodyKind::Rigid(_) => surface.keeps_digits(),
            BodyKind::Affine(affine) => surface.patches.is_empty() && !affine.interior.is_incompressible(),
            BodyKind::Contractile(_) => false,
        };
        // So is a motion that is kept to a plane or an axis.
        kept && self.has_inertia() && self.guide.is_none()
    }

    /// The length \[m\] of which its height over a plane has the digits, its centre at a place: its own, and its way
    /// from the start along a guide. With inertia its place is known to twice the digits, so that its distance from the
    /// origin takes none of a gap.
    pub fn height_scale(&self, position: &Vec3) -> f64 {
        let way = match &self.guide {
            _ if !self.has_inertia() => position.norm(),
            Some(guide) if guide.center.is_some() => (position - guide.position).norm(),
            _ => 0.0,
        };
        self.size + way
    }

    /// The gap [m] to a body whose centre is so far away that cannot be told from zero.
    pub(crate) fn least_distance(&self, distance: f64) -> f64 {
        least_distance(self.size, distance)
    }

    /// The gap [m] that cannot be told from zero.
    pub(crate) fn least_gap(&self, field: &GapField) -> f64 {
        let resolution = if field.lack.is_some() { EXTENDED_RESOLUTION } else { RESOLUTION };
        resolution * (self.size + field.height.abs())
    }

    /// What a body that deforms has beside a rigid one.
    pub fn affine(&self) -> Option<&Affine> {
        match &self.kind {
            BodyKind::Affine(affine) => Some(affine),
            BodyKind::Contractile(contractile) => Some(&contractile.affine),
            BodyKind::Rigid(_) => None,
        }
    }

    /// How it contracts, if it does.
    pub fn contraction(&self) -> Option<&Contraction> {
        match &self.kind {
            BodyKind::Contractile(contractile) => Some(&contractile.contraction),
            BodyKind::Rigid(_) | BodyKind::Affine(_) => None,
        }
    }

    /// The radius of a sphere about its centre in which it lies at a placement [m]; zero without a surface.
    pub fn radius_at(&self, placement: &Placement) -> f64 {
        let radius = self.solid.radius().unwrap_or(0.0);
        match &self.kind {
            BodyKind::Rigid(_) => radius,
            BodyKind::Affine(_) | BodyKind::Contractile(_) => placement.stretch_bound() * radius,
        }
    }

    /// Whether it is a mass point, which has a place and does not turn.
    pub fn is_point(&self) -> bool {
        matches!(&self.kind, BodyKind::Rigid(inertia) if *inertia == RigidInertia::POINT)
    }

    /// Whether it has inertia; without, its velocities are no state but follow from the balance.
    pub fn has_inertia(&self) -> bool {
        self.inclusion.as_ref().is_none_or(|inclusion| inclusion.inertia)
    }

    /// The history force on it.
    pub fn history(&self) -> Option<&History> {
        self.inclusion.as_ref()?.history.as_ref()
    }

    /// Its kinetic energy, if that is not ½ tr(Ṗ J Ṗᵀ).
    pub(crate) fn kinetic(&self) -> Option<&Kinetic> {
        self.affine()?.interior.kinetic.as_ref()
    }

    /// ∂T/∂Ṗ of its motion about the centre of mass, Ṗ J unless its kinetic energy is another \[kg m²/s\].
    pub fn canonical_momentum(&self, p: &Mat3, rate: &Mat3) -> Mat3 {
        let euler_tensor = &self.solid.mass.euler_tensor;
        match self.kinetic() {
            None => rate * euler_tensor,
            Some(kinetic) => kinetic.canonical_momentum(p, rate, euler_tensor),
        }
    }

    /// K = P (∂T/∂Ṗ)ᵀ about the centre of mass \[kg m²/s\].
    pub fn affine_momentum(&self, p: &Mat3, rate: &Mat3) -> Mat3 {
        match self.kinetic() {
            None => p * self.solid.mass.euler_tensor * rate.transpose(),
            Some(_) => p * self.canonical_momentum(p, rate).transpose(),
        }
    }

    /// How many numbers its state has.
    pub fn dimension(&self) -> usize {
        Slots::of(self, 0).block().len()
    }
}
