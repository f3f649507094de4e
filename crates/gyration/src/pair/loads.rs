//! What two bodies that meet do to each other.
//!
//!   (f | M)_i = σ_i λ_i n⊗a_i + damping + friction
//!
//! The plane is in balance, so that the wrenches of the two are opposite; computed apart they differ by rounding, which
//! near contact is more than that of the forces. B therefore takes exactly what A leaves, about a point of the plane.

use super::laws::{PairLaws, ViscousLaw};
use super::mediator::{Mediator, Shares};
use super::plane::{Placed, place};
use super::side::{Half, Side, columns};
use super::{Mat34, SIGNS};
use crate::contact::{AreaMeasure, LawKind};
use crate::load::Loads;
use crate::surface::{GapClosed, Moments};
use crate::tensor::{Mat3, Vec3, axial, cross_matrix};

/// Room for the moments of a pair; made once, reused.
#[derive(Debug, Clone, Default)]
pub struct PairScratch {
    pub(super) moments: [Vec<Moments>; 2],
}

/// What a pair of bodies does to both.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PairLoads {
    /// (f, M) on A and on B.
    pub on: [Loads; 2],
    /// U [J].
    pub energy: f64,
    /// The powers [W] of the laws on both bodies.
    pub powers: [f64; LawKind::COUNT],
    /// The width of the slab between the bodies along the normal [m].
    pub gap: f64,
    /// n, from B to A.
    pub normal: Vec3,
    /// Where the force of the repulsion passes through the plane [m].
    pub point: Vec3,
}

/// Which moments of viscous laws are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ViscousMoments {
    /// Those of d^−ν′.
    Values,
    /// Beside them those of d^−(ν′+1).
    Slopes,
}

/// A pair whose plane is found.
pub(super) struct Met<'a> {
    pub laws: &'a PairLaws,
    pub halves: [Half<'a>; 2],
    pub placed: Placed,
    /// The foot of the repulsion on the plane, from A's centre [m].
    pub foot: Vec3,
}

impl PairScratch {
    /// So many moments of each side, growing if this is the first use.
    pub(super) fn take(&mut self, count: usize) -> [&mut [Moments]; 2] {
        self.moments.each_mut().map(|moments| {
            if moments.len() < count {
                moments.resize(count, Moments::default());
            }
            &mut moments[..count]
        })
    }
}

impl<'a> Met<'a> {
    /// Places the plane.
    pub fn new(laws: &'a PairLaws, sides: [&Side<'a>; 2], scratch: &mut PairScratch) -> Result<Self, GapClosed> {
        let lengths = sides.map(|side| side.surface.area().sqrt());
        let origin = sides[0].placement.position;
        let halves = [0, 1].map(|i| {
            let side = sides[i];
            let share = lengths[1 - i] / (lengths[0] + lengths[1]);
            let deformed = laws.measure != AreaMeasure::ReferenceArea;
            Half {
                side: *side,
                sign: SIGNS[i],
                columns: columns(&(side.placement.position - origin), &side.placement.gradient),
                root_share: share.sqrt(),
                cofactor: side.deformation.filter(|_| deformed).map(|deformation| deformation.cofactor),
            }
        });
        let [room, _] = scratch.take(laws.placing.requests().len());
        let placed = place(laws, halves.each_ref(), room)?;
        let first = &placed.potentials[0].first;
        let center = halves[0].columns * first / first[0];
        let plane = &placed.plane;
        let foot = center - (center.dot(&plane.normal) - plane.offset) * plane.normal;
        Ok(Self { laws, halves, placed, foot })
    }

    /// (f | M) of the repulsion on a side.
    pub fn repulsion(&self, side: usize) -> Mat34 {
        let Placed { plane, weights, potentials, .. } = &self.placed;
        SIGNS[side] * weights[side] * plane.normal * potentials[side].first.transpose()
    }

    /// Hands damping and friction to `each`, with the moments of both sides from which they are.
    pub fn each_mediator(
        &self,
        moments: ViscousMoments,
        scratch: &mut PairScratch,
        mut each: impl FnMut(&ViscousLaw, &Shares, &Mediator, [&[Moments]; 2]),
    ) -> Result<(), GapClosed> {
        if self.laws.viscous.is_empty() {
            return Ok(());
        }
        let plan = match moments {
            ViscousMoments::Values => &self.laws.resisting,
            ViscousMoments::Slopes => &self.laws.resisting_slopes,
        };
        let shares = Shares::new(self.laws, &self.placed);
        let [above, below] = scratch.take(plan.requests().len());
        self.halves[0].moments(&self.placed.plane, plan, above)?;
        self.halves[1].moments(&self.placed.plane, plan, below)?;
        let rooms = [&*above, &*below];
        for law in &self.laws.viscous {
            let place = match moments {
                ViscousMoments::Values => law.value,
                ViscousMoments::Slopes => law.slopes[0],
            };
            let (halves, moments) = (self.halves.each_ref(), rooms.map(|room| &room[place]));
            let mediator = Mediator::new(law, halves, (&self.placed, &shares), &self.foot, moments)?;
            each(law, &shares, &mediator, rooms);
        }
        Ok(())
    }

    /// The loads that (f | M) of both sides are, B's opposite to A's.
    pub fn opposite(&self, on: [Mat34; 2]) -> [Loads; 2] {
        let [above, below] = on.map(|on| Loads {
            force: on.column(0).into(),
            moment: on.fixed_columns::<3>(1).into_owned(),
        });
        let about_foot = |half: &Half, loads: &Loads| {
            let arm = half.columns.column(0) - self.foot;
            let own: Mat3 = loads.moment * half.side.placement.gradient.transpose();
            arm.cross(&loads.force) + axial(&own)
        };
        let force = -above.force;
        let taken = Loads { force, moment: below.moment };
        let left = about_foot(&self.halves[0], &above) + about_foot(&self.halves[1], &taken);
        let back = 0.5 * cross_matrix(&left) * self.halves[1].side.inverse.transpose();
        [above, Loads { force, moment: below.moment - back }]
    }
}

impl PairLoads {
    /// Places the plane between two bodies, and integrates the laws over both.
    ///
    /// # Errors
    /// [`GapClosed`] if no plane separates them.
    pub fn integrate(laws: &PairLaws, sides: [&Side; 2], scratch: &mut PairScratch) -> Result<Self, GapClosed> {
        let met = Met::new(laws, sides, scratch)?;
        let mut on = [met.repulsion(0), met.repulsion(1)];
        let mut powers = [0.0; LawKind::COUNT];
        let rates = met.halves.each_ref().map(Half::rates);
        powers[LawKind::Repulsion as usize] = on[0].dot(&rates[0]) + on[1].dot(&rates[1]);
        met.each_mediator(ViscousMoments::Values, scratch, |_, _, mediator, _| {
            powers[mediator.kind as usize] += mediator.power();
            on[0] += mediator.loads(0);
            on[1] += mediator.loads(1);
        })?;
        let plane = &met.placed.plane;
        Ok(Self {
            on: met.opposite(on),
            energy: met.placed.energy,
            powers,
            gap: met.halves.iter().map(|half| half.smallest_gap(plane).0).sum(),
            normal: plane.normal,
            point: sides[0].placement.position + met.foot,
        })
    }
}
