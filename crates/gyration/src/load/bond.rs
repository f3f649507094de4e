//! Bonds: springs between material points of two bodies.
//!
//! Both bodies compute the force from their own end; the differences of places and velocities are the same but for the
//! sign, digit by digit, and so are the forces. Their sum is zero to the last digit. Energy and dissipation belong to
//! the first end.

use super::interactions::{Interaction, InteractionEnd};
use super::spring::{SpringLaw, SpringLoads};
use crate::kinematics::{Placement, Velocity};
use crate::tensor::Vec3;

/// A spring between material points of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bond {
    /// The indices of the two bodies, which differ.
    pub bodies: [usize; 2],
    /// A material point of each (from its centre of mass) [m].
    pub points: [Vec3; 2],
    /// What it does.
    pub law: SpringLaw,
}

/// A bond as one of its bodies sees it.
pub type BondEnd<'a> = InteractionEnd<'a, Bond>;

impl Interaction for Bond {
    fn bodies(&self) -> [usize; 2] {
        self.bodies
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
    /// The material point of the other body [m].
    pub fn other_point(&self) -> Vec3 {
        self.interaction.points[1 - self.end]
    }

    /// Its length l [m], given where the own body is and the other.
    pub fn length(&self, own: &Placement, other: &Placement) -> f64 {
        self.interaction.length(if self.end == 0 { [own, other] } else { [other, own] })
    }

    /// The stored energy [J], where it is counted.
    pub fn energy(&self, own: &Placement, other: &Placement) -> f64 {
        if self.counts() { self.interaction.law.energy(self.length(own, other)) } else { 0.0 }
    }

    /// The force on the own body and its derivatives, or `None` where the direction is lost (l = 0 with l₀ > 0 or a
    /// dashpot).
    pub fn loads(&self, own: (&Placement, &Velocity), other: (&Placement, &Velocity)) -> Option<SpringLoads> {
        let (here, there) = (self.interaction.points[self.end], self.other_point());
        let along = own.0.place(&here) - other.0.place(&there);
        let speed = own.1.at(&here) - other.1.at(&there);
        self.interaction.law.loads(along, speed, here)
    }
}
