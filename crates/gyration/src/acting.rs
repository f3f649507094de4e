//! What acts on a body: every load there is, and the entries of the ledger that it brings.
//!
//! Rates, Jacobian and diagnostics go through `Load::try_each` and know no other list. A further load is a file in
//! `load` with its physics and a variant here; the compiler then names what else it must answer (`dynamics::loads`).

use crate::body::Body;
use crate::contact::{Contact, LawKind};
use crate::fluid::{Fluid, Inclusion};
use crate::joint::JointEnd;
use crate::ledger::{Energy, Work};
use crate::load::{
    Applied, BodyForce, BondEnd, Couple, InteractionEnd, LinearResistance, Loads, MassFriction, OwnFriction, Party,
    PointForce, Potential, SelfGravity, SpringEnd,
};
use crate::neighbours::{Pair, PairRule};
use crate::pair::{PairLoads, PairSlopes};
use crate::solid_support::SolidSupport;
use crate::support::Support;
use crate::tensor::Vec3;

/// A pair as one of its bodies sees it.
pub type PairEnd<'a> = InteractionEnd<'a, Pair>;

/// A pair within reach at an instant, as one of its bodies sees it.
#[derive(Debug, Clone, Copy)]
pub struct PairAt<'a> {
    /// The pair, and which of its bodies this is.
    pub end: PairEnd<'a>,
    /// What it does to both.
    pub loads: &'a PairLoads,
    /// The derivatives of that; none at an instant of which they were not asked.
    pub slopes: Option<&'a PairSlopes>,
}

impl PairAt<'_> {
    /// Whether it does anything that a number can tell: below the energy at which it begins, it does not.
    pub fn acts(&self) -> bool {
        self.loads.stored != 0.0
    }

    /// (f | M) on the body.
    pub fn on_body(&self) -> &Loads {
        &self.loads.on[self.end.end]
    }

    /// The other party.
    pub fn other(&self) -> Party {
        self.end.other()
    }

    /// The index of the other body; none of a support.
    pub fn other_body(&self) -> Option<usize> {
        self.other().body()
    }

    /// n, from the other party to this body.
    pub fn normal(&self) -> Vec3 {
        // That of the pair points from the second body to the first.
        if self.end.end == 0 { self.loads.normal } else { -self.loads.normal }
    }
}

/// What is between a body and other parties.
pub(crate) struct Interacting<C, S, B, P, J> {
    /// Laws with supports.
    pub contacts: C,
    /// Springs, those to anchors first.
    pub springs: S,
    /// Bonds.
    pub bonds: B,
    /// Bodies and supports with a shape that it meets.
    pub pairs: P,
    /// Joints.
    pub joints: J,
}

/// A kind of load, as forces and moments are told by: each load is of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoadKind {
    /// All laws with supports, their friction included.
    Contact,
    /// All laws with other bodies, and with supports that have a shape.
    Pair,
    /// Springs and bonds, with their dashpots.
    Spring,
    /// The fluid, buoyancy included.
    Drag,
    /// Friction that is linear in the velocities of the body.
    Friction,
    /// Joints, gravity of its own, and what a scene or a controller writes: couples, potentials, body forces,
    /// gyroscopic loads.
    Load,
}

impl LoadKind {
    /// How many there are.
    pub const COUNT: usize = 6;
}

/// A load on a body.
#[derive(Debug, Clone, Copy)]
pub enum Load<'a> {
    /// The laws with a support.
    Contact(&'a Contact),
    /// A spring, to another body or to an anchor.
    Spring(SpringEnd<'a>),
    /// A bond to another body.
    Bond(BondEnd<'a>),
    /// Another body, or a support with a shape, that it meets.
    Pair(PairAt<'a>),
    /// A joint, to another body or to space.
    Joint(JointEnd<'a>),
    /// An affine moment.
    Couple(&'a Couple),
    /// What a controller applies.
    Applied(&'a Applied),
    /// Friction or a gyroscopic load, linear in the velocities.
    Resistance(&'a LinearResistance),
    /// A potential of the body alone.
    Potential(&'a Potential),
    /// A force per volume.
    BodyForce(&'a BodyForce),
    /// A force on a material point.
    PointForce(&'a PointForce),
    /// Friction that changes with the place of the body and with time.
    OwnFriction(&'a OwnFriction),
    /// Friction in proportion to the mass.
    MassFriction(&'a MassFriction),
    /// The gravity of the body on itself.
    SelfGravity(&'a SelfGravity),
    /// The fluid around an inclusion.
    Fluid(&'a Fluid, &'a Inclusion),
    /// What planes change of that, for a sphere of this radius [m].
    Walls(f64),
    /// What others in the fluid change of that, for the sphere of this place among them.
    Neighbours(usize),
}

impl<'a> Load<'a> {
    /// Hands the loads on a body to `each`, in the order in which they are summed; stops at the first error.
    #[inline]
    pub(crate) fn try_each<E>(
        body: &'a Body,
        interactions: Interacting<
            impl Iterator<Item = &'a Contact>,
            impl Iterator<Item = SpringEnd<'a>>,
            impl Iterator<Item = BondEnd<'a>>,
            impl Iterator<Item = PairAt<'a>>,
            impl Iterator<Item = JointEnd<'a>>,
        >,
        fluid: Option<&'a Fluid>,
        applied: Option<&'a Applied>,
        mut each: impl FnMut(Self) -> Result<(), E>,
    ) -> Result<(), E> {
        let Interacting { contacts, springs, bonds, pairs, joints } = interactions;
        for contact in contacts {
            each(Self::Contact(contact))?;
        }
        for spring in springs {
            each(Self::Spring(spring))?;
        }
        for bond in bonds {
            each(Self::Bond(bond))?;
        }
        for pair in pairs {
            each(Self::Pair(pair))?;
        }
        for joint in joints {
            each(Self::Joint(joint))?;
        }
        let affine = body.affine();
        if let Some(couple) = affine.and_then(|affine| affine.couple.as_ref()) {
            each(Self::Couple(couple))?;
        }
        if let Some(applied) = applied {
            each(Self::Applied(applied))?;
        }
        for resistance in affine.map_or(&[][..], |affine| &affine.resistances) {
            each(Self::Resistance(resistance))?;
        }
        if let Some(potential) = &body.own.potential {
            each(Self::Potential(potential))?;
        }
        if let Some(body_force) = &body.own.body_force {
            each(Self::BodyForce(body_force))?;
        }
        for point_force in &body.own.point_forces {
            each(Self::PointForce(point_force))?;
        }
        if let Some(resistance) = &body.own.resistance {
            each(Self::Resistance(resistance))?;
        }
        for friction in &body.own.frictions {
            each(Self::OwnFriction(friction))?;
        }
        if let Some(absorption) = &body.own.absorption {
            each(Self::MassFriction(absorption))?;
        }
        if let Some(gravity) = &body.own.self_gravity {
            each(Self::SelfGravity(gravity))?;
        }
        if let (Some(fluid), Some(inclusion)) = (fluid, &body.inclusion) {
            each(Self::Fluid(fluid, inclusion))?;
            if let Some(radius) = inclusion.walls {
                each(Self::Walls(radius))?;
            }
        }
        Ok(())
    }

    /// Whether it has a force beside those of the contacts.
    pub fn pulls(&self) -> bool {
        match self {
            Self::Contact(_) | Self::Pair(_) | Self::Couple(_) | Self::SelfGravity(_) => false,
            Self::Spring(_)
            | Self::Bond(_)
            | Self::Joint(_)
            | Self::Applied(_)
            | Self::Resistance(_)
            | Self::Potential(_)
            | Self::BodyForce(_)
            | Self::PointForce(_)
            | Self::OwnFriction(_)
            | Self::MassFriction(_)
            | Self::Fluid(..)
            | Self::Walls(_)
            | Self::Neighbours(_) => true,
        }
    }

    /// The kind that its force and its moment are told under.
    pub fn kind(&self) -> LoadKind {
        match self {
            Self::Contact(_) => LoadKind::Contact,
            // One with a support that has a shape is one with a support.
            Self::Pair(pair) if pair.other().body().is_none() => LoadKind::Contact,
            Self::Pair(_) => LoadKind::Pair,
            Self::Spring(_) | Self::Bond(_) => LoadKind::Spring,
            Self::Fluid(..) | Self::Walls(_) | Self::Neighbours(_) => LoadKind::Drag,
            Self::Resistance(resistance) if resistance.dissipates() => LoadKind::Friction,
            Self::OwnFriction(_) | Self::MassFriction(_) => LoadKind::Friction,
            Self::Joint(_)
            | Self::Couple(_)
            | Self::Applied(_)
            | Self::Resistance(_)
            | Self::Potential(_)
            | Self::BodyForce(_)
            | Self::PointForce(_)
            | Self::SelfGravity(_) => LoadKind::Load,
        }
    }

    /// The works that it may do.
    pub fn works(&self, supports: &[Support]) -> Vec<Work> {
        match self {
            Self::Contact(contact) => {
                let moves = !supports[contact.support].motion.is_fixed();
                contact
                    .law_set
                    .laws()
                    .iter()
                    .map(|law| law.kind().work())
                    .chain(moves.then_some(Work::Support))
                    .collect()
            }
            Self::Pair(pair) => pair.end.interaction.form.laws.laws().iter().map(|law| law.kind().work()).collect(),
            Self::Spring(end) => {
                let moves = end.interaction.anchor().is_some_and(|anchor| !anchor.motion.is_fixed());
                let dashpot = (end.interaction.law.damping > 0.0).then_some(Work::Load);
                dashpot.into_iter().chain(moves.then_some(Work::Support)).collect()
            }
            Self::Bond(end) if end.interaction.works() => vec![Work::Load],
            // What the error of a step leaves: its force does no work.
            Self::Joint(end) => {
                let moves = !end.interaction.anchor.motion.is_fixed();
                let driven = end.interaction.motor.works().then_some(Work::Load);
                [Work::Constraint].into_iter().chain(driven).chain(moves.then_some(Work::Support)).collect()
            }
            Self::Couple(_) | Self::Applied(_) | Self::BodyForce(_) | Self::PointForce(_) => vec![Work::Load],
            Self::OwnFriction(_) | Self::MassFriction(_) => vec![Work::Viscosity],
            Self::Resistance(resistance) if resistance.dissipates() => vec![Work::Viscosity],
            Self::Fluid(..) | Self::Walls(_) | Self::Neighbours(_) => vec![Work::Fluid],
            Self::Potential(potential) if !potential.is_energy() => vec![Work::Load],
            Self::Bond(_) | Self::Resistance(_) | Self::Potential(_) | Self::SelfGravity(_) => Vec::new(),
        }
    }

    /// Where its energy is stored, if it has one.
    pub fn energy(&self) -> Option<Energy> {
        match self {
            Self::Contact(contact) => {
                let central = contact.law_set.laws().iter().any(|law| law.kind().is_central());
                central.then_some(Energy::Contact)
            }
            Self::Pair(_) => Some(PAIR_ENERGY),
            Self::Spring(_) | Self::SelfGravity(_) => Some(Energy::Load),
            Self::Bond(end) => end.interaction.is_energy().then_some(Energy::Load),
            Self::Potential(potential) => potential.is_energy().then_some(Energy::Load),
            Self::Joint(end) => end.interaction.motor.stop.map(|_| Energy::Load),
            Self::Couple(_)
            | Self::Applied(_)
            | Self::Resistance(_)
            | Self::BodyForce(_)
            | Self::PointForce(_)
            | Self::OwnFriction(_)
            | Self::MassFriction(_)
            | Self::Fluid(..)
            | Self::Walls(_)
            | Self::Neighbours(_) => None,
        }
    }
}

/// The works that pairs may do by a rule.
pub(crate) fn pair_works(rule: &PairRule, supports: &[SolidSupport]) -> impl Iterator<Item = Work> {
    let moves = rule.supports.iter().any(|support| !supports[*support].motion.is_fixed());
    rule.laws.laws().iter().map(|law| law.kind().work()).chain(moves.then_some(Work::Support))
}

/// Where the energy of a pair is stored.
pub(crate) const PAIR_ENERGY: Energy = Energy::Contact;

impl LawKind {
    /// The work that a law of this kind does.
    pub fn work(self) -> Work {
        match self {
            Self::Repulsion => Work::Repulsion,
            Self::Damping => Work::Damping,
            Self::Friction => Work::Friction,
            Self::Adhesion => Work::Adhesion,
        }
    }

    /// Whether it pushes or pulls along the normal whatever the velocity, and so may have a potential.
    pub fn is_central(self) -> bool {
        matches!(self, Self::Repulsion | Self::Adhesion)
    }
}
