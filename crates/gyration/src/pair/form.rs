//! What two parts of bodies do to each other, whichever bodies they belong to: equal bodies share it.

use super::balls::{Balls, PlacedBalls};
use super::exchange::PairGap;
use super::fault::PairFault;
use super::laws::{PairLaws, shares};
use super::reach::Threshold;
use super::side::Side;
use crate::contact::{Action, Term};
use crate::surface::Surface;
use std::sync::Arc;

/// The part of a range at whose end a pair is out of it already, lest the last digit of a distance decides: χ, of fifth
/// order there, is below any digit of U.
pub const EDGE: f64 = 1e-9;

/// The least slab, of what is not two balls, that digits tell, and the least part of one that is on one side of the
/// plane, as parts of the size of the smaller body. Gaps are known to some 1e-16 of the size: so small a part to 1e-5,
/// its traction, which goes with a power of it, to 1e-4. What that leaves of the energy is told by the ledger.
const LEAST_SLAB: f64 = 1e-8;
const LEAST_PART: f64 = 1e-11;
/// The same of two balls, whose gap comes from two places alone.
const LEAST_BALLS: f64 = 1e-12;

/// What two convex bodies, or parts of bodies, A and B, do to each other.
#[derive(Debug, Clone, PartialEq)]
pub struct PairForm {
    /// What acts between them.
    pub laws: Arc<PairLaws>,
    /// The distance that is said [m]; none if it acts everywhere.
    pub reach: Option<f64>,
    /// From this distance on nothing acts [m].
    pub range: Option<f64>,
    /// U_c [J]: below it nothing acts.
    pub(super) threshold: f64,
    /// The radius of each about its centre of mass, in the reference shape [m].
    pub(super) radii: [f64; 2],
    /// w.
    pub(super) shares: [f64; 2],
    /// What both are, if they are balls about their centres of mass.
    pub(super) balls: Option<Balls>,
}

impl PairForm {
    /// Of two parts of bodies, given their surfaces.
    pub fn new(laws: Arc<PairLaws>, reach: Option<f64>, surfaces: [&Surface; 2]) -> Self {
        let threshold = reach.map(|reach| Threshold::at(&laws, reach, surfaces));
        Self::of_radii(laws, threshold, surfaces, surfaces.map(Surface::radius))
    }

    /// The same, given where its force begins and the radii of both about their centres of mass [m], which are those of
    /// their surfaces.
    pub fn of_radii(
        laws: Arc<PairLaws>,
        threshold: Option<Threshold>,
        surfaces: [&Surface; 2],
        radii: [f64; 2],
    ) -> Self {
        let (reach, range) = (threshold.map(|begins| begins.reach), threshold.map(|begins| begins.range));
        let threshold = threshold.map_or(0.0, |begins| begins.energy);
        let balls = match surfaces.map(Surface::ball) {
            [Some(one), Some(other)] => Some(Balls::new(&laws, [one, other])),
            _ => None,
        };
        let shares = shares(surfaces.map(Surface::area));
        Self { laws, reach, range, threshold, radii, shares, balls }
    }

    /// The radius of each about its centre of mass, in the reference shape [m].
    pub fn radii(&self) -> [f64; 2] {
        self.radii
    }

    /// By what part of itself its reach makes a gap [m] smaller at which the two come to rest or turn back; none
    /// without a reach.
    ///
    ///   δg/g = 5 U_c/(g F)
    pub fn change_of_gap(&self, gap: f64, surfaces: [&Surface; 2]) -> Option<f64> {
        self.reach?;
        let steep = match &self.balls {
            Some(balls) => gap * balls.at(gap).ok()?.1,
            None => (self.laws.repulsion.exponent - 1.0) * self.laws.most(gap, surfaces.map(Surface::area)),
        };
        Some(5.0 * self.threshold / steep)
    }

    /// What two such surfaces may do to each other at a gap [m] while they pass one another with a speed [m/s]: a bound
    /// of the work over the gap of all their laws [J], Σ c d^(1−ν) S, viscous ones times the speed.
    pub fn most_work(&self, gap: f64, speed: f64, surfaces: [&Surface; 2]) -> f64 {
        let [one, other] = surfaces.map(Surface::area);
        let terms = self.laws.laws().iter().flat_map(|law| law.terms().into_iter().flatten());
        let traction = |term: Term| {
            let factor = if matches!(term.action, Action::Central) { 1.0 } else { speed };
            term.coefficient.abs() * factor * libm::pow(gap, 1.0 - term.exponent)
        };
        one.min(other) * terms.map(traction).sum::<f64>()
    }

    /// The slab between two rigid balls whose centres have a distance [m]; none of other shapes.
    pub fn gap_of_balls(&self, distance: f64) -> Option<f64> {
        self.balls.is_some().then(|| distance - self.radii[0] - self.radii[1])
    }

    /// How near the plane has come to one of two bodies [m], the smaller of which has this size, if that is so near
    /// that digits do not tell it from touch.
    pub fn touch(&self, slab: &PairGap, size: f64) -> Option<f64> {
        let part = slab.gap * slab.share.min(1.0 - slab.share);
        let touches = match self.balls.is_some() {
            true => slab.gap < LEAST_BALLS * size,
            false => slab.gap < LEAST_SLAB * size || part < LEAST_PART * size,
        };
        touches.then_some(part)
    }

    /// The plane between two rigid balls; none of other bodies.
    pub(super) fn balls(&self, sides: [&Side; 2]) -> Option<Result<PlacedBalls<'_>, PairFault>> {
        self.balls.as_ref()?.place(sides)
    }

    /// The distance of the centres from which on two rigid bodies do nothing to each other [m]; none if there is none.
    pub fn cutoff(&self) -> Option<f64> {
        self.range.map(|range| cutoff(range, self.radii))
    }
}

/// The distance of the centres from which on two rigid bodies of these radii do nothing to each other [m].
pub fn cutoff(range: f64, radii: [f64; 2]) -> f64 {
    range * (1.0 - EDGE) + radii[0] + radii[1]
}

/// The distance of the centres at which these are as far apart as the half of their range at least [m].
pub fn half_cutoff(range: f64, radii: [f64; 2]) -> f64 {
    range + radii[0] + radii[1] - 0.5 * range
}
