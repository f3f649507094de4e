//! Springs and dashpots at material points: between two bodies, or from a body to an anchor in space, which may move as
//! prescribed.
//!
//!   F = −[k (l − l₀) + c l̇] e,   e = d/l,   l = |d|,   l̇ = e·ḋ,   d = x − y
//!
//! on the point x of the first body; −F acts on the point y of the second, or on the anchor y; in a lattice d = x − y −
//! R, R the place of the second's cell as seen from the first's. The potential is ½k(l − l₀)², the dissipation c l̇²,
//! which count as the first body's; who moves an anchor does the work F·ẏ. At l = 0 the direction e is lost: outside
//! the model unless the spring has neither rest length nor dashpot.

use super::Loads;
use super::interactions::{Interaction, InteractionEnd};
use crate::kinematics::{BodyMotion, Placement};
use crate::lattice::{Cell, HERE, Lattice};
use crate::party::Party;
use crate::support::SupportMotion;
use crate::tensor::{Mat3, Vec3};
use std::sync::Arc;

/// A spring with a dashpot in parallel, whatever its ends are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringLaw {
    /// k [N/m].
    pub stiffness: f64,
    /// l₀ [m].
    pub rest_length: f64,
    /// c [N s/m].
    pub damping: f64,
}

/// A place in space, and how it moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Anchor {
    /// Where it is before any motion [m].
    pub start: Vec3,
    /// How it is carried.
    pub motion: Arc<SupportMotion>,
}

/// Where an end of a spring is.
#[derive(Debug, Clone, PartialEq)]
pub enum Attachment {
    /// At a material point of a body.
    Body {
        /// The index of the body.
        index: usize,
        /// The point (from the centre of mass) [m].
        point: Vec3,
    },
    /// At a place in space.
    Anchor(Anchor),
}

/// A spring between two bodies, or from a body to an anchor.
#[derive(Debug, Clone, PartialEq)]
pub struct Spring {
    /// Where it begins, which is at a body, and where it ends.
    pub ends: [Attachment; 2],
    /// In which cell of a lattice it ends, as seen from that in which it begins.
    pub cell: Cell,
    /// What it does.
    pub law: SpringLaw,
}

/// A spring as one of its bodies sees it.
pub type SpringEnd<'a> = InteractionEnd<'a, Spring>;

/// The force of a spring on the point of its first body and what its derivatives need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringLoads {
    /// F [N].
    pub force: Vec3,
    /// ∂F/∂d [N/m].
    pub by_place: Mat3,
    /// ∂F/∂ḋ [N s/m].
    pub by_velocity: Mat3,
    /// −c l̇² [W].
    pub dashpot_power: f64,
    /// F·ẏ of an anchor [W].
    pub anchor_power: f64,
    /// l [m].
    pub length: f64,
}

impl SpringLaw {
    /// Whether it does anything.
    pub fn acts(&self) -> bool {
        self.stiffness > 0.0 || self.damping > 0.0
    }

    /// Whether it needs a direction, which is lost where it has no length.
    pub fn is_directed(&self) -> bool {
        self.rest_length > 0.0 || self.damping > 0.0
    }

    /// The stored energy ½k(l − l₀)² [J] at a length l [m].
    pub fn energy(&self, length: f64) -> f64 {
        0.5 * self.stiffness * (length - self.rest_length).powi(2)
    }

    /// Force and derivatives where the first end is d from the second and moves away with ḋ.
    ///
    /// # Errors
    /// The length [m], where the direction is lost.
    fn loads(&self, along: Vec3, speed: Vec3) -> Result<SpringLoads, f64> {
        let length = along.norm();
        if !self.is_directed() {
            let (force, by_place) = (-self.stiffness * along, Mat3::from_diagonal_element(-self.stiffness));
            return Ok(SpringLoads {
                force,
                by_place,
                by_velocity: Mat3::zeros(),
                dashpot_power: 0.0,
                anchor_power: 0.0,
                length,
            });
        }
        if length.is_nan() || length <= 0.0 {
            return Err(length);
        }
        let e = along / length;
        let rate = e.dot(&speed);
        let tension = self.stiffness * (length - self.rest_length) + self.damping * rate;
        let ee = e * e.transpose();
        // ∂e/∂d = (I − e⊗e)/l, and l̇ = e·ḋ turns with e as well.
        let turn = (Mat3::identity() - ee) / length;
        let by_place = -self.stiffness * ee - self.damping * e * (turn * speed).transpose() - tension * turn;
        let (by_velocity, dashpot_power) = (-self.damping * ee, -self.damping * rate * rate);
        Ok(SpringLoads { force: -tension * e, by_place, by_velocity, dashpot_power, anchor_power: 0.0, length })
    }
}

impl Anchor {
    /// One at rest.
    pub fn at_rest(place: Vec3) -> Self {
        Self { start: place, motion: Arc::default() }
    }

    /// The same, held where it is at a time [s].
    #[must_use]
    pub fn held_at(self, time: f64) -> Self {
        if self.motion.is_fixed() { self } else { Self { motion: Arc::new(self.motion.held_at(time)), ..self } }
    }

    /// Where it is at a time [s], and how it moves there.
    pub fn at(&self, time: f64) -> (Vec3, Vec3) {
        if self.motion.is_fixed() {
            return (self.start, Vec3::zeros());
        }
        let carried = self.motion.carriage(time);
        let place = carried.place(&self.start);
        (place, carried.velocity_at(&place))
    }
}

impl Spring {
    /// The same to an anchor that is held where it is at a time [s].
    #[must_use]
    pub fn held_at(self, time: f64) -> Self {
        let held = |end| match end {
            Attachment::Anchor(anchor) => Attachment::Anchor(anchor.held_at(time)),
            body @ Attachment::Body { .. } => body,
        };
        Self { ends: self.ends.map(held), ..self }
    }
}

impl Interaction for Spring {
    fn parties(&self) -> [Party; 2] {
        self.ends.each_ref().map(|end| match end {
            Attachment::Body { index, .. } => Party::Body(*index),
            Attachment::Anchor(_) => Party::Space,
        })
    }

    fn cell(&self) -> Cell {
        self.cell
    }
}

impl Attachment {
    /// The material point of a body (from its centre of mass), or where an anchor is before any motion [m].
    pub fn point(&self) -> Vec3 {
        match self {
            Self::Body { point, .. } => *point,
            Self::Anchor(anchor) => anchor.start,
        }
    }

    /// The same of a body that has another index.
    fn of_party(&self, party: Party) -> Self {
        match (self, party) {
            (Self::Body { point, .. }, Party::Body(index)) => Self::Body { index, point: *point },
            _ => self.clone(),
        }
    }
}

impl Spring {
    /// Between material points of two bodies.
    pub fn between(bodies: [usize; 2], points: [Vec3; 2], law: SpringLaw) -> Self {
        Self { ends: [0, 1].map(|end| Attachment::Body { index: bodies[end], point: points[end] }), cell: HERE, law }
    }

    /// The same to the second body's image in another cell.
    #[must_use]
    pub fn across(self, cell: Cell) -> Self {
        Self { cell, ..self }
    }

    /// From a material point of a body to a place in space.
    pub fn to_anchor(body: usize, point: Vec3, anchor: Vec3, law: SpringLaw) -> Self {
        Self::to(body, point, Anchor::at_rest(anchor), law)
    }

    /// From a material point of a body to an anchor.
    pub fn to(body: usize, point: Vec3, anchor: Anchor, law: SpringLaw) -> Self {
        Self { ends: [Attachment::Body { index: body, point }, Attachment::Anchor(anchor)], cell: HERE, law }
    }

    /// Its anchor; none between two bodies.
    pub fn anchor(&self) -> Option<&Anchor> {
        self.ends.iter().find_map(|end| match end {
            Attachment::Body { .. } => None,
            Attachment::Anchor(anchor) => Some(anchor),
        })
    }

    /// The same spring between parties that have other indices.
    pub(crate) fn of_parties(&self, parties: [Party; 2]) -> Self {
        Self { ends: [0, 1].map(|end| self.ends[end].of_party(parties[end])), ..self.clone() }
    }

    /// Its two bodies; none where one end is an anchor.
    pub fn bodies(&self) -> Option<[usize; 2]> {
        let [one, other] = self.parties().map(Party::body);
        Some([one?, other?])
    }

    /// Its length l [m] at the start, given where its bodies are in their cells.
    pub fn length(&self, lattice: &Lattice, placement: impl Fn(usize) -> Placement) -> f64 {
        let [one, other] = self.ends.each_ref().map(|end| match end {
            Attachment::Body { index, point } => placement(*index).place(point),
            Attachment::Anchor(anchor) => anchor.at(0.0).0,
        });
        (one - other - lattice.place(self.cell)).norm()
    }

    /// Force and derivatives at a time [s], given how its bodies move in their cells.
    ///
    /// # Errors
    /// The length [m], where the direction is lost (l = 0 with l₀ > 0 or a dashpot).
    pub fn loads<'a>(
        &self,
        lattice: &Lattice,
        time: f64,
        motion: impl Fn(usize) -> &'a BodyMotion,
    ) -> Result<SpringLoads, f64> {
        let [one, other] = self.ends.each_ref().map(|end| match end {
            Attachment::Body { index, point } => {
                let BodyMotion { placement, velocity } = motion(*index);
                (placement.place(point), velocity.at(point))
            }
            Attachment::Anchor(anchor) => anchor.at(time),
        });
        let loads = self.law.loads(one.0 - other.0 - lattice.place(self.cell), one.1 - other.1)?;
        let anchor_power = if self.anchor().is_some() { loads.force.dot(&other.1) } else { 0.0 };
        Ok(SpringLoads { anchor_power, ..loads })
    }
}

impl SpringEnd<'_> {
    /// f and M on the body, given the force on the first end.
    pub fn loads(&self, spring: &SpringLoads) -> Loads {
        let force = if self.end == 0 { spring.force } else { -spring.force };
        Loads::at_point(force, &self.point())
    }

    /// The material point of the body [m].
    pub fn point(&self) -> Vec3 {
        self.interaction.ends[self.end].point()
    }

    /// The material point of the other body [m], or where the anchor is.
    pub fn other_point(&self) -> Vec3 {
        self.interaction.ends[1 - self.end].point()
    }
}
