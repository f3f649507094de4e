//! Pairs of bodies that meet: the plane of each is found once at an instant, and both bodies have their part of it.

use super::contacts::deformation;
use super::{Scratch, Workspace};
use crate::extended::Numbers;
use crate::inadmissible::{Inadmissible, Quantity};
use crate::instant::{BodyAt, Instant};
use crate::load::Interactions;
use crate::model::{Model, PATIENCE};
use crate::neighbours::Pair;
use crate::pair::{Guess, PairFault, PairGap, PairLoads, PairScratch, PairSlopes, Side};
use crate::tensor::Vec3;

/// What the listed pairs of an instant do.
#[derive(Debug, Clone, Default)]
pub(crate) struct PairStates {
    /// What those do that act.
    acting: Vec<PairLoads>,
    /// By the number of the pair: its place among these; that of the next one if it is out of reach.
    places: Vec<usize>,
    /// The derivatives of those that act, where they are wanted, and their places in the same way.
    slopes: Vec<PairSlopes>,
    sloped: Vec<usize>,
    remembered: Remembered,
    pub room: PairScratch,
}

/// Where the planes of pairs were, from which they are looked for.
#[derive(Debug, Clone, Default)]
struct Remembered {
    /// When they were there [s].
    since: f64,
    /// Where they were; empty if that is not remembered.
    gaps: PairGaps,
    /// The list of pairs that was last asked for, if any was since, and the place of each among these; empty if they
    /// are the same.
    list: Option<Interactions<Pair>>,
    places: Vec<usize>,
}

/// The slabs between the bodies of the listed pairs at a state.
#[derive(Debug, Clone, Default)]
pub struct PairGaps {
    pairs: Interactions<Pair>,
    /// By the number of the pair.
    slabs: Vec<PairGap>,
    /// Whether all pairs are listed that there are.
    is_whole: bool,
}

impl PairStates {
    /// What a pair within reach does.
    pub fn loads(&self, number: usize) -> &PairLoads {
        &self.acting[self.places[number]]
    }

    /// The derivatives of what a pair within reach does.
    pub fn slopes(&self, number: usize) -> &PairSlopes {
        &self.slopes[self.sloped[number]]
    }

    fn clear_loads(&mut self) {
        self.acting.clear();
        self.places.clear();
    }

    /// Notes what the next pair does, if it is within reach.
    fn push(&mut self, loads: Option<PairLoads>) {
        self.places.push(self.acting.len());
        self.acting.extend(loads);
    }
}

impl Remembered {
    /// Where the plane of a listed pair is looked for first at a time.
    fn guess(&self, number: usize, time: f64) -> Option<Guess> {
        let place = if self.places.is_empty() { number } else { *self.places.get(number)? };
        self.gaps.slabs.get(place)?.guess(time - self.since)
    }

    /// Finds the pairs of a list among those that are remembered. What is remembered stays: a pair may leave the list
    /// and come back.
    fn find(&mut self, pairs: &Interactions<Pair>) {
        if self.list.as_ref().is_some_and(|list| list.are(pairs)) {
            return;
        }
        self.list = Some(pairs.clone());
        self.places.clear();
        if !self.gaps.pairs.are(pairs) {
            let known = self.gaps.pairs.all();
            let place = |pair: &Pair| known.binary_search_by_key(&pair.key(), Pair::key).unwrap_or(usize::MAX);
            self.places.extend(pairs.all().iter().map(place));
        }
    }
}

impl PairGaps {
    /// Each pair with its slab, which is infinite where the two are out of reach; in order of the pairs.
    pub fn iter(&self) -> impl Iterator<Item = (&Pair, &PairGap)> {
        self.pairs.all().iter().zip(&self.slabs)
    }

    /// The slabs of a body.
    pub fn of(&self, body: usize) -> impl Iterator<Item = &PairGap> {
        self.pairs.of(body).filter_map(|end| self.slabs.get(end.number))
    }

    /// Whether all pairs are listed that there are; those that are not are out of reach.
    pub fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// Forgets the slabs.
    pub fn clear(&mut self) {
        self.slabs.clear();
    }

    /// Begins anew for the pairs of an instant.
    fn begin(&mut self, instant: &Instant) {
        self.clear();
        self.is_whole = instant.near().is_whole();
        if !self.pairs.are(instant.near().pairs()) {
            self.pairs = instant.near().pairs().clone();
        }
    }
}

/// Hands the listed pairs to `each`, with their bodies and where their planes are looked for first; those out of reach
/// without either.
fn for_each(
    model: &Model,
    instant: &Instant,
    states: &mut PairStates,
    mut each: impl FnMut(&mut PairStates, Option<Looked>) -> Result<(), PairFault>,
) -> Result<(), Inadmissible> {
    states.remembered.find(instant.near().pairs());
    for (number, pair) in instant.near().pairs().all().iter().enumerate() {
        let bodies = pair.bodies.map(|body| instant.at(model, body));
        if (number + 1).is_multiple_of(PATIENCE) && model.is_given_up() {
            return Err(bodies[0].outside(Quantity::Interruption, f64::NAN));
        }
        let guess = states.remembered.guess(number, instant.time());
        let looked = instant.is_within_reach(number).then_some(Looked { pair, bodies: &bodies, guess: guess.as_ref() });
        each(states, looked).map_err(|fault| outside(&bodies[0], pair, fault))?;
    }
    Ok(())
}

/// A pair within reach, and where its plane is looked for first.
struct Looked<'a> {
    pair: &'a Pair,
    bodies: &'a [BodyAt<'a>; 2],
    guess: Option<&'a Guess>,
}

/// Finds what all pairs do to their bodies.
pub(super) fn find_planes(model: &Model, instant: &Instant, scratch: &mut Scratch) -> Result<(), Inadmissible> {
    scratch.pairs.clear_loads();
    for_each(model, instant, &mut scratch.pairs, |states, looked| {
        let room = &mut states.room;
        let integrate = |Looked { pair, bodies, guess }| {
            with_sides(pair, bodies, |sides| PairLoads::integrate(&pair.form, sides, guess, room))
        };
        let loads = looked.map(integrate).transpose()?;
        states.push(loads);
        Ok(())
    })
}

/// The same with derivatives.
pub(super) fn differentiate(model: &Model, instant: &Instant, scratch: &mut Scratch) -> Result<(), Inadmissible> {
    scratch.pairs.slopes.clear();
    scratch.pairs.sloped.clear();
    for_each(model, instant, &mut scratch.pairs, |states, looked| {
        let room = &mut states.room;
        let integrate = |Looked { pair, bodies, guess }| {
            with_sides(pair, bodies, |sides| PairSlopes::integrate(&pair.form, sides, guess, room))
        };
        let slopes = looked.map(integrate).transpose()?;
        states.sloped.push(states.slopes.len());
        states.slopes.extend(slopes);
        Ok(())
    })
}

impl Workspace {
    /// The slab between the bodies of each listed pair; infinite where they are out of reach.
    ///
    /// # Errors
    /// [`Inadmissible`] if no plane separates two of them.
    pub fn pair_gaps(
        &mut self,
        model: &Model,
        (time, state): (f64, Numbers),
        gaps: &mut PairGaps,
    ) -> Result<(), Inadmissible> {
        gaps.clear();
        if model.rules().is_empty() {
            gaps.is_whole = true;
            return Ok(());
        }
        let Self { instant, scratch } = self;
        instant.read(model, time, state)?;
        gaps.begin(instant);
        for_each(model, instant, &mut scratch.pairs, |states, looked| {
            let gap = |Looked { pair, bodies, guess }| {
                with_sides(pair, bodies, |sides| pair.form.gap(sides, guess, &mut states.room))
            };
            gaps.slabs.push(looked.map(gap).transpose()?.unwrap_or(PairGap::FAR));
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
        gaps: &mut PairGaps,
    ) -> Result<(), Inadmissible> {
        self.scratch.pairs.remembered.gaps.clear();
        self.pair_gaps(model, (time, state), gaps)?;
        let remembered = &mut self.scratch.pairs.remembered;
        remembered.since = time;
        remembered.gaps.clone_from(gaps);
        // They are found among these at the next instant.
        remembered.list = None;
        Ok(())
    }
}

/// A state outside the model, for what became of a plane.
pub(super) fn outside(at: &BodyAt, pair: &Pair, fault: PairFault) -> Inadmissible {
    let (other, rule) = (pair.bodies[1], pair.rule);
    match fault {
        PairFault::Overlap { gap } => at.outside(Quantity::PairGap { other, rule }, gap),
        PairFault::NotFound { decrement } => at.outside(Quantity::PairPlane { other, rule }, decrement),
        PairFault::Singular(_) => at.outside(Quantity::PairPlane { other, rule }, f64::NAN),
    }
}

pub(super) fn with_sides<T>(pair: &Pair, bodies: &[BodyAt; 2], each: impl FnOnce([&Side; 2]) -> T) -> T {
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
