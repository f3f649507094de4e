//! What any two parties do to each other at an instant: contacts, springs and bonds, each once.
//!
//!   N = P Mᵀ   of the loads (f | M) of one on the other, about the centre of mass of whom they act on
//!
//! All laws between the same two, and all parts of them, are one contact: forces, moments and powers add up; gap,
//! normal and foot are those of the plane with the smallest gap. Of two bodies the one that the model has first is the
//! first. What acts on one body alone (anchors, joints, body forces) is no exchange.

use super::Scratch;
use super::contacts::meet;
use crate::acting::{Load, PairAt};
use crate::contact::{Contact, ContactLoads, LawKind, repulsion_center};
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, Instant};
use crate::kinematics::Placement;
use crate::lattice::{Cell, HERE, opposite};
use crate::load::{BondEnd, Interaction, Loads, SpringEnd};
use crate::party::Party;
use crate::tensor::{Mat3, Vec3};

/// What makes two parties act on each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExchangeKind {
    /// Contact laws.
    Contact,
    /// A spring, with its dashpot.
    Spring,
    /// A bond.
    Bond,
}

impl ExchangeKind {
    /// What they are called, in their order.
    pub const NAMES: [&'static str; 3] = ["contact", "spring", "bond"];
}

/// What two parties do to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exchange {
    /// A body, and a body or a support.
    pub parties: [Party; 2],
    /// The cell of the second as seen from that of the first.
    pub cell: Cell,
    /// What makes them act.
    pub kind: ExchangeKind,
    /// The smallest gap [m]; none of a spring or a bond.
    pub gap: Option<f64>,
    /// n, towards the first; none of a spring or a bond.
    pub normal: Option<Vec3>,
    /// Where the repulsion passes through the plane, or where a spring or bond holds the first body [m], in space; none
    /// where nothing repels.
    pub point: Option<Vec3>,
    /// f on the first [N]; on the second it is −f.
    pub force: Vec3,
    /// N on each [J]; none on a support.
    pub moments: [Option<Mat3>; 2],
    /// The powers of damping and friction on both [W]; none of a spring or a bond.
    pub powers: Option<[f64; 2]>,
}

/// What the parties of an instant do to each other, as far as they are within reach: by first, second, cell and kind.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn exchanges(instant: &Instant, scratch: &mut Scratch, out: &mut Vec<Exchange>) -> Result<(), Inadmissible> {
    out.clear();
    for index in 0..instant.model().bodies.len() {
        let at = instant.at(index);
        at.try_each_load(|load| {
            let found = match load {
                Load::Contact(contact) => of_contact(&at, contact, scratch)?,
                Load::Pair(pair) if pair.end.counts() && pair.acts() => Some(of_pair(instant, index, &pair)),
                Load::Spring(end) if end.counts() => of_spring(instant, &at, &end),
                Load::Bond(end) if end.counts() => Some(of_bond(instant, &at, &end)),
                Load::Spring(_)
                | Load::Bond(_)
                | Load::Pair(_)
                | Load::Joint(_)
                | Load::Couple(_)
                | Load::Applied(_)
                | Load::Resistance(_)
                | Load::Potential(_)
                | Load::BodyForce(_)
                | Load::PointForce(_)
                | Load::OwnFriction(_)
                | Load::MassFriction(_)
                | Load::SelfGravity(_)
                | Load::Fluid(..)
                | Load::Walls(_)
                | Load::Neighbours(_) => None,
            };
            out.extend(found.map(|found| found.ordered(instant)));
            Ok(())
        })?;
    }
    out.sort_by_key(Exchange::key);
    out.dedup_by(|next, kept| {
        let is_same = next.kind == ExchangeKind::Contact && next.key() == kept.key();
        if is_same {
            kept.add(next);
        }
        is_same
    });
    Ok(())
}

/// The laws of a body with a plane.
fn of_contact(at: &BodyAt, contact: &Contact, scratch: &mut Scratch) -> Result<Option<Exchange>, Inadmissible> {
    let model = at.model;
    let placement = &at.motion.placement;
    meet(at, contact, |meeting| {
        let loads = ContactLoads::integrate(&contact.law_set, meeting, &mut scratch.contact)?;
        let center = repulsion_center(&contact.law_set, meeting, &mut scratch.contact)?;
        let normal = meeting.motion.normal;
        let foot = center.map(|center| placement.place(&center) - meeting.field.gap(&center) * normal);
        let total = loads.total();
        Ok(Exchange {
            parties: contact.parties(),
            cell: HERE,
            kind: ExchangeKind::Contact,
            gap: Some(meeting.surface.smallest_gap(&meeting.field).0),
            normal: Some(normal),
            point: foot.map(|foot| model.in_space(at.index, &foot)),
            force: total.force,
            moments: [Some(affine_moment(placement, &total)), None],
            powers: Some([LawKind::Damping, LawKind::Friction].map(|law| loads.relative_power(law))),
        })
    })
}

/// The laws of two bodies, or of a body and a solid support, or of parts of them.
fn of_pair(instant: &Instant, index: usize, pair: &PairAt) -> Exchange {
    let (loads, interaction) = (pair.loads, pair.end.interaction);
    Exchange {
        parties: interaction.parties(),
        cell: interaction.cell(),
        kind: ExchangeKind::Contact,
        gap: Some(loads.gap),
        normal: Some(loads.normal),
        point: Some(instant.model().in_space(index, &loads.point)),
        force: loads.on[0].force,
        moments: [0, 1].map(|end| of_party(instant, interaction.parties()[end], &loads.on[end])),
        powers: Some([LawKind::Damping, LawKind::Friction].map(|law| loads.powers[law as usize])),
    }
}

/// A spring between two bodies; none to an anchor.
fn of_spring(instant: &Instant, at: &BodyAt, end: &SpringEnd) -> Option<Exchange> {
    let (parties, spring) = (end.interaction.parties(), at.spring(end));
    end.other().body()?;
    let on = [0, 1].map(|own| SpringEnd { end: own, ..*end }.loads(spring));
    let held = at.motion.placement.place(&end.point());
    Some(Exchange::of_link(ExchangeKind::Spring, instant, parties, end.interaction.cell, held, on))
}

/// A bond.
fn of_bond(instant: &Instant, at: &BodyAt, end: &BondEnd) -> Exchange {
    let bond = end.interaction;
    let held = at.motion.placement.place(&bond.points[0]);
    Exchange::of_link(ExchangeKind::Bond, instant, bond.parties(), bond.cell, held, at.bond(end).on)
}

/// N = P Mᵀ on a party; none on what is no body.
fn of_party(instant: &Instant, party: Party, loads: &Loads) -> Option<Mat3> {
    party.body().map(|body| affine_moment(&instant.at(body).motion.placement, loads))
}

fn affine_moment(placement: &Placement, loads: &Loads) -> Mat3 {
    placement.gradient * loads.moment.transpose()
}

impl Exchange {
    /// What joins two bodies at points of them, of which the first is held at a place of its cell [m].
    fn of_link(
        kind: ExchangeKind,
        instant: &Instant,
        parties: [Party; 2],
        cell: Cell,
        held: Vec3,
        on: [Loads; 2],
    ) -> Self {
        let first = parties[0].body().unwrap_or_default();
        Self {
            parties,
            cell,
            kind,
            gap: None,
            normal: None,
            point: Some(instant.model().in_space(first, &held)),
            force: on[0].force,
            moments: [0, 1].map(|end| of_party(instant, parties[end], &on[end])),
            powers: None,
        }
    }

    /// What tells one from another, and in which order they stand.
    fn key(&self) -> ([Party; 2], Cell, ExchangeKind) {
        (self.parties, self.cell, self.kind)
    }

    /// The same contact with the body first that the model has first; what holds two at points keeps its order.
    fn ordered(self, instant: &Instant) -> Self {
        let Some(second) = self.parties[1].body().filter(|_| self.kind == ExchangeKind::Contact) else { return self };
        let is_ordered = (self.parties[0], self.cell) <= (self.parties[1], opposite(self.cell));
        let Some(first) = self.parties[0].body().filter(|_| !is_ordered) else { return self };
        let model = instant.model();
        let [one, other] = self.moments;
        let seen_from_second = |point| {
            let place = model.in_cell(first, &point) - model.lattice.place(self.cell);
            model.in_space(second, &place)
        };
        Self {
            parties: [Party::Body(second), Party::Body(first)],
            cell: opposite(self.cell),
            normal: self.normal.map(|normal| -normal),
            point: self.point.map(seen_from_second),
            force: -self.force,
            moments: [other, one],
            ..self
        }
    }

    /// Adds another contact of the same two.
    fn add(&mut self, other: &Self) {
        if other.gap < self.gap {
            (self.gap, self.normal, self.point) = (other.gap, other.normal, other.point);
        }
        self.force += other.force;
        for (moment, added) in self.moments.iter_mut().zip(&other.moments) {
            *moment = moment.zip(*added).map(|(moment, added)| moment + added);
        }
        self.powers = self.powers.zip(other.powers).map(|([a, b], [c, d])| [a + c, b + d]);
    }
}
