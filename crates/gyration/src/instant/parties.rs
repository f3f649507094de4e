//! The two of a pair at an instant: a body, and a body or a support with a shape.

use super::motions::{MotionAt, Motions};
use crate::body::{Solid, least_distance};
use crate::contact::Deformation;
use crate::kinematics::BodyMotion;
use crate::lattice::Cell;
use crate::model::Model;
use crate::neighbours::Pair;
use crate::party::Party;
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

impl Motions {
    /// The two of a pair of the model from whose state this was read.
    #[inline]
    pub fn parties<'a>(&'a self, model: &'a Model, pair: &Pair) -> [PartyAt<'a>; 2] {
        pair.parties.map(|party| match party {
            Party::Body(index) => PartyAt::Body(self.at(model, index)),
            Party::SolidSupport(index) => PartyAt::Support(&model.solid_supports[index], &self.supports[index]),
            Party::Support(_) | Party::Space => unreachable!("a pair is of bodies and supports with a shape"),
        })
    }

    /// Finds which listed pairs are within reach: the others do nothing.
    pub(super) fn find_reached(&mut self, model: &Model) {
        let (mut within, mut reached) = (std::mem::take(&mut self.within), std::mem::take(&mut self.reached));
        within.clear();
        reached.clear();
        within.extend(self.near().pairs().all().iter().enumerate().map(|(number, pair)| {
            let parties = self.parties(model, pair);
            let cutoff = pair.form.cutoff().filter(|_| parties.iter().all(PartyAt::is_rigid));
            cutoff.is_none_or(|cutoff| PartyAt::apart(&parties, pair.cell).norm() < cutoff).then(|| {
                reached.push(number);
                reached.len() - 1
            })
        }));
        (self.within, self.reached) = (within, reached);
    }
}

impl<'a> MotionAt<'a> {
    /// The two of a pair at the same time.
    pub(crate) fn parties_of(&self, pair: &Pair) -> [PartyAt<'a>; 2] {
        self.motions.parties(self.model, pair)
    }
}
