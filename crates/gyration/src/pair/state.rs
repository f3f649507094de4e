//! A pair whose plane is found.

use super::areas::AreaMoments;
use super::equilibrium::search;
use super::exchange::PairGap;
use super::expansion::Expansion;
use super::fault::PairFault;
use super::form::PairForm;
use super::laws::ViscousLaw;
use super::mediator::{Mediator, Shares};
use super::placed::Placed;
use super::plane::{Guess, Plane};
use super::pulled::Pulled;
use super::side::{Half, SIGNS, Side, columns};
use super::tension::{Tensions, tensions};
use super::{Mat34, Vec4};
use crate::contact::AreaMeasure;
use crate::surface::{AxialMoments, Moments};
use crate::tensor::Vec3;

/// Room for the moments of a pair; made once, reused.
#[derive(Debug, Clone, Default)]
pub struct PairScratch {
    pub(super) moments: [Vec<Moments>; 2],
    pub(super) axial: [Vec<AxialMoments>; 2],
    pub(super) areas: AreaMoments,
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
pub(super) struct PairState<'a> {
    pub pair: &'a PairForm,
    pub halves: [Half<'a>; 2],
    pub placed: Placed,
    /// The foot of the repulsion on the plane, from A's centre [m].
    pub foot: Vec3,
    /// What areas that change bring to the moment, before it is weighted.
    pub tensions: Tensions,
    /// Adhesion, where there is any within reach.
    pub pulled: Option<Pulled>,
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

    /// Those of one side that place a plane.
    fn placing(&mut self, pair: &PairForm) -> &mut [Moments] {
        let [room, _] = self.take(pair.laws.placing.requests().len());
        room
    }
}

/// Both sides, of these shares w, their places from the centre of A; `deformed` if their areas are.
pub(super) fn halves<'a>(sides: [&'a Side; 2], shares: [f64; 2], deformed: bool) -> [Half<'a>; 2] {
    [0, 1].map(|i| {
        let side = sides[i];
        Half {
            side,
            sign: SIGNS[i],
            columns: columns(&side.from_first, &side.placement.gradient),
            root_share: shares[i].sqrt(),
            cofactor: side.deformation.as_ref().filter(|_| deformed).map(|deformation| &deformation.cofactor),
        }
    })
}

impl<'a> PairState<'a> {
    /// Places the plane.
    ///
    /// # Errors
    /// [`PairFault`] if no plane separates the bodies.
    pub fn new(
        pair: &'a PairForm,
        sides: [&'a Side; 2],
        guess: Option<&Guess>,
        scratch: &mut PairScratch,
    ) -> Result<Self, PairFault> {
        if pair.laws.pull.is_some() {
            return Self::adhering(pair, sides, guess, scratch).map(|(state, _)| state);
        }
        let halves = pair.halves(sides);
        let room = scratch.placing(pair);
        let placed = search(pair, halves.each_ref(), guess, room)?.placed(halves.each_ref());
        Self::at(pair, halves, placed, scratch)
    }

    /// Places the plane, and expands log U about it.
    ///
    /// # Errors
    /// As there.
    pub fn expanded(
        pair: &'a PairForm,
        sides: [&'a Side; 2],
        guess: Option<&Guess>,
        scratch: &mut PairScratch,
    ) -> Result<(Self, Expansion), PairFault> {
        let halves = pair.halves(sides);
        let room = scratch.placing(pair);
        let expansion = search(pair, halves.each_ref(), guess, room)?.confirmed(&pair.laws, halves.each_ref(), room);
        let placed = expansion.placed();
        Ok((Self::at(pair, halves, placed, scratch)?, expansion))
    }

    /// The same with adhesion, which needs the expansion.
    ///
    /// # Errors
    /// As there.
    pub fn adhering(
        pair: &'a PairForm,
        sides: [&'a Side; 2],
        guess: Option<&Guess>,
        scratch: &mut PairScratch,
    ) -> Result<(Self, Expansion), PairFault> {
        let (mut state, expansion) = Self::expanded(pair, sides, guess, scratch)?;
        if let Some(pull) = pair.laws.pull.as_ref().filter(|_| !state.placed.is_out_of_reach()) {
            let room = scratch.take(pull.values.requests().len());
            state.pulled = Some(Pulled::new(pull, state.halves.each_ref(), &expansion, room)?);
        }
        Ok((state, expansion))
    }

    /// At a plane in balance.
    fn at(
        pair: &'a PairForm,
        halves: [Half<'a>; 2],
        mut placed: Placed,
        scratch: &mut PairScratch,
    ) -> Result<Self, PairFault> {
        placed.switch(pair.threshold);
        let first = &placed.first[0];
        let center = halves[0].columns * first / first[0];
        let plane = &placed.plane;
        let foot = center - (center.dot(&plane.normal) - plane.offset) * plane.normal;
        let tensions = tensions(&pair.laws, halves.each_ref(), plane, &mut scratch.areas)?;
        Ok(Self { pair, halves, placed, foot, tensions, pulled: None })
    }

    /// (f | M) of the repulsion on a side.
    pub fn repulsion(&self, side: usize) -> Mat34 {
        let Placed { plane, weights, first, .. } = &self.placed;
        let pressed = self.halves[side].sign * weights[side] * plane.normal * first[side].transpose();
        self.tensions[side].map_or(pressed, |tension| pressed + weights[side] * tension)
    }

    /// Hands damping and friction to `each`, with the moments of both sides from which they are.
    pub fn each_mediator(
        &self,
        moments: ViscousMoments,
        scratch: &mut PairScratch,
        mut each: impl FnMut(&ViscousLaw, &Shares, &Mediator, [&[Moments]; 2]),
    ) -> Result<(), PairFault> {
        let laws = &self.pair.laws;
        if laws.viscous.is_empty() || self.placed.is_out_of_reach() {
            return Ok(());
        }
        let plan = match moments {
            ViscousMoments::Values => &laws.resisting,
            ViscousMoments::Slopes => &laws.resisting_slopes,
        };
        let shares = Shares::of_weights(laws, self.placed.weights);
        let [above, below] = scratch.take(plan.requests().len());
        self.halves[0].moments(&self.placed.plane, plan, above)?;
        self.halves[1].moments(&self.placed.plane, plan, below)?;
        let rooms = [&*above, &*below];
        for law in &laws.viscous {
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
}

impl PairForm {
    /// Both sides, in the measure of the pair.
    pub(super) fn halves<'a>(&self, sides: [&'a Side; 2]) -> [Half<'a>; 2] {
        halves(sides, self.shares, self.laws.measure != AreaMeasure::ReferenceArea)
    }

    /// Whether two rigid bodies do nothing to each other, which the slab along a guess of their normal tells: one as
    /// wide as the reach has no more potential than U_c, and the plane of least potential has less.
    pub fn is_out_of_reach(&self, sides: [&Side; 2], guess: &Guess) -> bool {
        let is_rigid = sides.iter().all(|side| side.deformation.is_none());
        let Some(range) = self.range.filter(|_| is_rigid && self.balls.is_none()) else { return false };
        let across = Plane { normal: guess.normal, offset: 0.0 };
        let gaps = self.halves(sides).each_ref().map(|half| half.smallest_gap(&across).0);
        gaps[0] + gaps[1] >= range
    }

    /// The slab between two bodies along the normal of their plane.
    ///
    /// # Errors
    /// [`PairFault`] if no plane separates them.
    pub fn gap(
        &self,
        sides: [&Side; 2],
        guess: Option<&Guess>,
        scratch: &mut PairScratch,
    ) -> Result<PairGap, PairFault> {
        if let Some(balls) = self.balls(sides) {
            return balls.map(|balls| balls.gap(sides));
        }
        let (state, expansion) = PairState::expanded(self, sides, guess, scratch)?;
        let halves = state.halves.each_ref();
        let rates = halves.map(Half::rates);
        let areas = scratch.areas.placing(&self.laws, halves, &state.placed.plane)?;
        let change = expansion.along(halves, rates.each_ref(), state.placed.switch.bend, &areas);
        let (mut gaps, mut rates) = ([0.0; 2], [0.0; 2]);
        for (i, half) in halves.into_iter().enumerate() {
            let (gap, point) = half.smallest_gap(&state.placed.plane);
            gaps[i] = gap;
            rates[i] = change.heights[i].dot(&Vec4::new(1.0, point.x, point.y, point.z));
        }
        let (gap, rate) = (gaps[0] + gaps[1], rates[0] + rates[1]);
        let share = gaps[0] / gap;
        let sharing = (rates[0] - share * rate) / gap;
        Ok(PairGap { gap, rate, normal: state.placed.plane.normal, turning: change.normal, share, sharing })
    }
}
