//! The two of a pair at an instant: a body, and a body or a support with a shape.

use super::motions::MotionAt;
use crate::body::{Solid, least_distance};
use crate::contact::Deformation;
use crate::kinematics::BodyMotion;
use crate::lattice::Cell;
use crate::solid_support::SolidSupport;
use crate::tensor::{Mat3, Vec3};

/// One of the two of a pair, at a time.
#[derive(Debug, Clone, Copy)]
pub(crate) enum PartyAt<'a> {
    Body(MotionAt<'a>),
    Support(&'a SolidSupport, &'a BodyMotion),
}

impl<'a> PartyAt<'a> {
    /// Shape and surface.
    pub fn solid(&self) -> &'a Solid {
        match self {
            Self::Body(at) => &at.body.solid,
            Self::Support(support, _) => &support.solid,
        }
    }

    /// p₀, P, ṗ₀, Ṗ.
    pub fn motion(&self) -> &'a BodyMotion {
        match self {
            Self::Body(at) => at.motion,
            Self::Support(_, motion) => motion,
        }
    }

    /// P⁻¹.
    pub fn inverse(&self) -> Mat3 {
        match self {
            Self::Body(at) => at.inverse(),
            Self::Support(_, motion) => motion.placement.gradient.transpose(),
        }
    }

    /// How it takes its surface along; none of what is rigid.
    pub fn deformation(&self) -> Option<Deformation> {
        match self {
            Self::Body(at) => at.deformation(),
            Self::Support(..) => None,
        }
    }

    /// Whether it does not deform.
    pub fn is_rigid(&self) -> bool {
        match self {
            Self::Body(at) => at.gyration().is_none(),
            Self::Support(..) => true,
        }
    }

    /// Whether its velocities are known before its balance.
    pub fn has_inertia(&self) -> bool {
        match self {
            Self::Body(at) => at.body.has_inertia(),
            Self::Support(..) => true,
        }
    }

    /// The gap [m] to what is so far away that cannot be told from zero.
    pub fn least_distance(&self, distance: f64) -> f64 {
        match self {
            Self::Body(at) => at.body.least_distance(distance),
            Self::Support(support, _) => least_distance(support.size, distance),
        }
    }

    /// The place of the second from that of the first, where it is in a cell as seen from that of the first [m].
    #[inline]
    pub fn apart([one, other]: &[Self; 2], cell: Cell) -> Vec3 {
        match (one, other) {
            (Self::Body(one), Self::Body(other)) => one.apart(other, cell),
            (Self::Body(one), Self::Support(_, motion)) => -one.place_from(&motion.placement.position),
            (Self::Support(_, motion), other) => other.motion().placement.position - motion.placement.position,
        }
    }
}
