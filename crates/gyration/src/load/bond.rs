//! Bonds: what joins two bodies, springs between material points of them, and how a model keeps them.
//!
//! Both bodies compute the force from their own end; the differences of places and velocities are the same but for the
//! sign, digit by digit, and so are the forces. Their sum is zero to the last digit. Energy and dissipation belong to
//! the first end.

use super::bumper::Bumper;
use super::spring::{SpringLaw, SpringLoads};
use crate::kinematics::{Placement, Velocity};
use crate::tensor::Vec3;

/// What a bond does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BondLaw {
    /// A spring with a dashpot.
    Spring(SpringLaw),
    /// A push between centres that are near.
    Bumper(Bumper),
}

/// What joins material points of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bond {
    /// The indices of the two bodies, which differ.
    pub bodies: [usize; 2],
    /// A material point of each (from its centre of mass) [m].
    pub points: [Vec3; 2],
    /// What it does.
    pub law: BondLaw,
}

/// A bond as one of its bodies sees it.
#[derive(Debug, Clone, Copy)]
pub struct BondEnd<'a> {
    /// Its number in the model.
    pub number: usize,
    /// The bond.
    pub bond: &'a Bond,
    /// Which of its ends is the body's own, 0 or 1.
    pub end: usize,
}

/// The bonds of a model, found by body.
#[derive(Debug, Clone, Default)]
pub struct Bonds {
    all: Vec<Bond>,
    /// Where the ends of each body begin, and where the last end; empty without bonds.
    starts: Vec<usize>,
    /// The number of a bond and which of its ends it is, body by body.
    ends: Vec<(usize, usize)>,
}

impl BondLaw {
    /// Whether it does anything.
    pub fn acts(&self) -> bool {
        match self {
            Self::Spring(law) => law.stiffness > 0.0 || law.damping > 0.0,
            Self::Bumper(law) => law.stiffness > 0.0,
        }
    }

    /// k [N/m]: no force changes faster with the distance.
    pub fn stiffness(&self) -> f64 {
        match self {
            Self::Spring(law) => law.stiffness,
            // −F′ at l = 0.
            Self::Bumper(law) => 4.0 * law.stiffness,
        }
    }

    /// Whether it takes energy.
    pub fn dissipates(&self) -> bool {
        matches!(self, Self::Spring(law) if law.damping > 0.0)
    }

    /// The distance of the points from which on it does nothing [m]; none if there is none.
    pub fn reach(&self) -> Option<f64> {
        match self {
            Self::Spring(_) => None,
            Self::Bumper(law) => Some(law.reach),
        }
    }

    /// The stored energy [J] at a length l [m].
    fn energy(&self, length: f64) -> f64 {
        match self {
            Self::Spring(law) => law.energy(length),
            Self::Bumper(law) => law.energy(length),
        }
    }
}

impl Bond {
    /// Its length l [m] between bodies that are placed so.
    pub fn length(&self, placements: [&Placement; 2]) -> f64 {
        let [one, other] = [0, 1].map(|end| placements[end].place(&self.points[end]));
        (one - other).norm()
    }
}

impl BondEnd<'_> {
    /// Whether energy and dissipation are counted here.
    pub fn counts(&self) -> bool {
        self.end == 0
    }

    /// The other body.
    pub fn other(&self) -> usize {
        self.bond.bodies[1 - self.end]
    }

    /// The material point of the other body [m].
    pub fn other_point(&self) -> Vec3 {
        self.bond.points[1 - self.end]
    }

    /// Its length l [m], given where the own body is and the other.
    pub fn length(&self, own: &Placement, other: &Placement) -> f64 {
        self.bond.length(if self.end == 0 { [own, other] } else { [other, own] })
    }

    /// The stored energy [J], where it is counted.
    pub fn energy(&self, own: &Placement, other: &Placement) -> f64 {
        if self.counts() { self.bond.law.energy(self.length(own, other)) } else { 0.0 }
    }

    /// The force on the own body and its derivatives, or `None` where the direction is lost (l = 0 with l₀ > 0 or a
    /// dashpot).
    pub fn loads(&self, own: (&Placement, &Velocity), other: (&Placement, &Velocity)) -> Option<SpringLoads> {
        let (here, there) = (self.bond.points[self.end], self.other_point());
        let along = own.0.place(&here) - other.0.place(&there);
        let speed = own.1.at(&here) - other.1.at(&there);
        match self.bond.law {
            BondLaw::Spring(law) => law.loads(along, speed, here),
            BondLaw::Bumper(law) => law.loads(along),
        }
    }
}

impl Bonds {
    /// The bonds between so many bodies.
    ///
    /// # Panics
    /// If a bond joins a body to itself, or names one that does not exist, or if a bumper is off the centres.
    pub fn new(bodies: usize, all: Vec<Bond>) -> Self {
        if all.is_empty() {
            return Self::default();
        }
        let joins = |bond: &Bond| bond.bodies[0] != bond.bodies[1] && bond.bodies.iter().all(|body| *body < bodies);
        assert!(all.iter().all(joins), "a bond joins two of the {bodies} bodies");
        let central = |bond: &Bond| bond.law.reach().is_none() || bond.points == [Vec3::zeros(); 2];
        assert!(all.iter().all(central), "a bumper is between centres");
        let mut ends: Vec<(usize, usize)> = (0..all.len()).flat_map(|number| [(number, 0), (number, 1)]).collect();
        let body = |(number, end): &(usize, usize)| all[*number].bodies[*end];
        ends.sort_by_key(body);
        let starts = (0..=bodies).map(|index| ends.partition_point(|end| body(end) < index)).collect();
        Self { all, starts, ends }
    }

    /// All of them.
    pub fn all(&self) -> &[Bond] {
        &self.all
    }

    /// Those of a body, in order.
    pub fn of(&self, body: usize) -> impl Iterator<Item = BondEnd<'_>> {
        let ends = if body + 1 < self.starts.len() { self.starts[body]..self.starts[body + 1] } else { 0..0 };
        self.ends[ends].iter().map(|(number, end)| BondEnd { number: *number, bond: &self.all[*number], end: *end })
    }

    /// Those between some bodies, which ascend, numbered among these.
    #[must_use]
    pub fn among(&self, members: &[usize]) -> Self {
        let place = |body: usize| members.binary_search(&body).ok();
        let within = |end: BondEnd| {
            let [Some(one), Some(other)] = end.bond.bodies.map(place) else { return None };
            Some((end.number, Bond { bodies: [one, other], ..*end.bond }))
        };
        let counted = members.iter().flat_map(|body| self.of(*body)).filter(BondEnd::counts);
        let mut numbered: Vec<(usize, Bond)> = counted.filter_map(within).collect();
        numbered.sort_unstable_by_key(|(number, _)| *number);
        Self::new(members.len(), numbered.into_iter().map(|(_, bond)| bond).collect())
    }
}
