//! Pairs of bodies that meet: the plane of each is found once at an instant, and both bodies have their part of it.

use super::contacts::deformation;
use super::{Scratch, Workspace};
use crate::extended::Numbers;
use crate::inadmissible::{Inadmissible, Quantity};
use crate::instant::{BodyAt, Instant, KindAt};
use crate::model::{Model, PATIENCE};
use crate::pair::{Guess, Pair, PairFault, PairGap, PairLoads, PairScratch, PairSlopes, Side};
use crate::tensor::Vec3;
use std::num::NonZeroU32;

/// What all pairs of a model do at an instant.
#[derive(Debug, Clone, Default)]
pub(crate) struct PairStates {
    /// What those do that act, and those of which more than the gap is known.
    acting: Vec<PairLoads>,
    /// By the number of the pair: its place among these, or none, and its gap [m], infinite where that is not known.
    places: Vec<Option<NonZeroU32>>,
    gaps: Vec<f64>,
    /// What a pair does that does nothing.
    nothing: PairLoads,
    /// By the number of the pair, where derivatives are wanted; none out of reach.
    pub slopes: Vec<Option<PairSlopes>>,
    /// Where the planes were at a time, from which they are looked for; empty if that is not remembered.
    remembered: (f64, Vec<PairGap>),
    room: PairScratch,
}

impl PairStates {
    /// What a pair does.
    pub fn loads(&self, number: usize) -> &PairLoads {
        match self.places[number] {
            Some(place) => &self.acting[place.get() as usize - 1],
            None => &self.nothing,
        }
    }

    /// The gap of a pair [m]; infinite where it is out of reach, unless gaps were asked for.
    pub fn gap(&self, number: usize) -> f64 {
        self.gaps[number]
    }

    fn clear_loads(&mut self) {
        self.nothing.gap = f64::INFINITY;
        self.acting.clear();
        self.places.clear();
        self.gaps.clear();
    }

    /// Notes what the next pair does.
    fn push(&mut self, loads: PairLoads) {
        self.gaps.push(loads.gap);
        self.acting.push(loads);
        self.places.push(u32::try_from(self.acting.len()).ok().and_then(NonZeroU32::new));
    }

    /// Notes that the next pair does nothing, at this gap [m].
    fn push_nothing(&mut self, gap: f64) {
        self.gaps.push(gap);
        self.places.push(None);
    }

    /// Where a plane is looked for first at a time.
    fn guess(&self, number: usize, time: f64) -> Option<Guess> {
        let (since, slabs) = &self.remembered;
        slabs.get(number)?.guess(time - since)
    }
}

/// Hands each pair to `each`, with its bodies, and where its plane is looked for first.
fn for_each(
    model: &Model,
    instant: &Instant,
    states: &mut PairStates,
    mut each: impl FnMut(&mut PairStates, &Pair, &[BodyAt; 2], Option<&Guess>) -> Result<(), PairFault>,
) -> Result<(), Inadmissible> {
    for (number, pair) in model.pairs().iter().enumerate() {
        let guess = states.guess(number, instant.time());
        let bodies = pair.bodies.map(|body| instant.at(model, body));
        if (number + 1).is_multiple_of(PATIENCE) && model.is_given_up() {
            return Err(bodies[0].outside(Quantity::Interruption, f64::NAN));
        }
        let outside = |fault| outside(&bodies[0], number, fault);
        each(states, pair, &bodies, guess.as_ref()).map_err(outside)?;
    }
    Ok(())
}

/// Finds what all pairs do to their bodies; of those that are so far apart that it is nothing, the gaps only where
/// `everywhere` asks for them.
pub(super) fn find_planes(
    model: &Model,
    instant: &Instant,
    scratch: &mut Scratch,
    everywhere: bool,
) -> Result<(), Inadmissible> {
    scratch.pairs.clear_loads();
    for_each(model, instant, &mut scratch.pairs, |states, pair, bodies, guess| {
        let far = is_far(pair, bodies);
        if far && !everywhere {
            states.push_nothing(f64::INFINITY);
            return Ok(());
        }
        let [one, other] = bodies;
        let balls = || pair.apart(&one.from(other), &other.motion.placement.position);
        if let Some(apart) = far.then(balls).flatten() {
            states.push_nothing(apart.gap);
            return Ok(());
        }
        let loads = with_sides(pair, bodies, |sides| {
            let found = PairLoads::integrate(pair, sides, guess, &mut states.room);
            found.or_else(|fault| if far { PairLoads::nothing(pair, sides) } else { Err(fault) })
        })?;
        if far {
            states.push_nothing(loads.gap);
        } else {
            states.push(loads);
        }
        Ok(())
    })
}

/// The same with derivatives.
pub(super) fn differentiate(model: &Model, instant: &Instant, scratch: &mut Scratch) -> Result<(), Inadmissible> {
    scratch.pairs.slopes.clear();
    for_each(model, instant, &mut scratch.pairs, |states, pair, bodies, guess| {
        let integrate = |sides: [&Side; 2]| PairSlopes::integrate(pair, sides, guess, &mut states.room);
        states.slopes.push(if is_far(pair, bodies) { None } else { Some(with_sides(pair, bodies, integrate)?) });
        Ok(())
    })
}

impl Workspace {
    /// The slab between the bodies of each pair, by its number; infinite where they are out of reach.
    ///
    /// # Errors
    /// [`Inadmissible`] if no plane separates two of them.
    pub fn pair_gaps(
        &mut self,
        model: &Model,
        (time, state): (f64, Numbers),
        gaps: &mut Vec<PairGap>,
    ) -> Result<(), Inadmissible> {
        gaps.clear();
        if model.pairs().is_empty() {
            return Ok(());
        }
        let Self { instant, scratch } = self;
        instant.read(model, time, state)?;
        for_each(model, instant, &mut scratch.pairs, |states, pair, bodies, guess| {
            let gap = |sides: [&Side; 2]| pair.gap(sides, guess, &mut states.room);
            gaps.push(if is_far(pair, bodies) { PairGap::FAR } else { with_sides(pair, bodies, gap)? });
            Ok(())
        })
    }

    /// The same as if nothing were known, and from then on planes are looked for where they are then: what follows is
    /// the same for whoever comes to this state.
    ///
    /// # Errors
    /// [`Inadmissible`] if no plane separates two of them; nothing is remembered then.
    pub fn remember_pairs(
        &mut self,
        model: &Model,
        (time, state): (f64, Numbers),
        gaps: &mut Vec<PairGap>,
    ) -> Result<(), Inadmissible> {
        self.scratch.pairs.remembered.1.clear();
        self.pair_gaps(model, (time, state), gaps)?;
        let (since, slabs) = &mut self.scratch.pairs.remembered;
        *since = time;
        slabs.extend_from_slice(gaps);
        Ok(())
    }
}

/// A state outside the model, for what became of a plane.
fn outside(at: &BodyAt, pair: usize, fault: PairFault) -> Inadmissible {
    match fault {
        PairFault::Overlap { gap } => at.outside(Quantity::PairGap { pair }, gap),
        PairFault::NotFound { decrement } => at.outside(Quantity::PairPlane { pair }, decrement),
        PairFault::Singular(_) => at.outside(Quantity::PairPlane { pair }, f64::NAN),
    }
}

/// Whether two rigid bodies are farther apart than their pair reaches.
fn is_far(pair: &Pair, [one, other]: &[BodyAt; 2]) -> bool {
    let rigid = |at: &BodyAt| matches!(at.kind(), KindAt::Rigid(..));
    let Some(cutoff) = pair.cutoff().filter(|_| rigid(one) && rigid(other)) else { return false };
    one.from(other).norm() >= cutoff
}

fn with_sides<T>(pair: &Pair, bodies: &[BodyAt; 2], each: impl FnOnce([&Side; 2]) -> T) -> T {
    let apart = bodies[1].from(&bodies[0]);
    let [one, other] = [0, 1].map(|end| {
        let at = &bodies[end];
        Side {
            surface: at.body.solid.part(pair.parts[end]),
            placement: &at.motion.placement,
            from_first: if end == 0 { Vec3::zeros() } else { apart },
            velocity: &at.motion.velocity,
            inverse: at.inverse(),
            deformation: deformation(at),
            least_gap: at.body.least_distance(apart.norm()),
        }
    });
    each([&one, &other])
}
