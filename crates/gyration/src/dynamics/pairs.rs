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
    /// When the planes were looked at from which they are looked for [s], and where they were; empty if that is not
    /// remembered.
    remembered: (f64, PairGaps),
    room: PairScratch,
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

    /// Where a plane is looked for first at a time.
    fn guess(&self, number: usize, time: f64) -> Option<Guess> {
        let (since, gaps) = &self.remembered;
        gaps.slabs.get(number)?.guess(time - since)
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

    /// Goes over to the pairs of an instant, those that were not listed being out of reach.
    fn carry_to(&mut self, instant: &Instant) {
        let pairs = instant.near().pairs();
        if self.slabs.is_empty() || self.pairs.are(pairs) {
            return;
        }
        let before = self.pairs.all();
        let slab =
            |pair: &Pair| before.binary_search_by_key(&pair.key(), Pair::key).ok().map(|place| self.slabs[place]);
        self.slabs = pairs.all().iter().map(|pair| slab(pair).unwrap_or(PairGap::FAR)).collect();
        self.pairs = pairs.clone();
        self.is_whole = instant.near().is_whole();
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
    states.remembered.1.carry_to(instant);
    for (number, pair) in instant.near().pairs().all().iter().enumerate() {
        let bodies = pair.bodies.map(|body| instant.at(model, body));
        if (number + 1).is_multiple_of(PATIENCE) && model.is_given_up() {
            return Err(bodies[0].outside(Quantity::Interruption, f64::NAN));
        }
        let guess = states.guess(number, instant.time());
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
        self.scratch.pairs.remembered.1.clear();
        self.pair_gaps(model, (time, state), gaps)?;
        let (since, remembered) = &mut self.scratch.pairs.remembered;
        *since = time;
        remembered.clone_from(gaps);
        Ok(())
    }
}

/// What a slab is wider than: the distance of the centres less so many radii of both. With d_i ≤ g_i + 2r_i on both
/// surfaces, Φ ≤ (g + 2r_A + 2r_B) Σ w_i S_i^−p; a plane across the distance D ≥ |Δ| − r_A − r_B has D times that sum.
const WIDEST: f64 = 3.0;

/// The smallest slab between a body and another that it meets, however far [m]; infinite if it meets none.
///
/// # Errors
/// [`Inadmissible`] if no plane separates two bodies.
pub(super) fn smallest_gap(at: &BodyAt, scratch: &mut Scratch) -> Result<f64, Inadmissible> {
    let near = at.near();
    let (mut smallest, mut far) = (f64::INFINITY, None);
    let width = |pair: &Pair| {
        let [one, other] = pair.bodies.map(|body| at.beside(body));
        one.from(&other).norm() - WIDEST * pair.form.radii().iter().sum::<f64>()
    };
    let mut nearest = f64::INFINITY;
    for end in near.pairs().of(at.index) {
        if at.is_within_reach(&end) {
            smallest = smallest.min(scratch.pairs.loads(end.number).gap);
            continue;
        }
        let least = width(end.interaction);
        if least < nearest {
            (nearest, far) = (least, Some(end.number));
        }
    }
    let look = |pair: &Pair, scratch: &mut Scratch| far_gap(at, pair, scratch);
    if let Some(number) = far.filter(|_| nearest < smallest) {
        smallest = smallest.min(look(&near.pairs().all()[number], scratch)?);
    }
    for end in near.pairs().of(at.index) {
        let is_seen = at.is_within_reach(&end) || Some(end.number) == far;
        if !is_seen && width(end.interaction) < smallest {
            smallest = smallest.min(look(end.interaction, scratch)?);
        }
    }
    let rules = at.model.rules();
    if near.is_whole() || rules.of(at.index).is_empty() {
        return Ok(smallest);
    }
    let radii = near.largest_radius() + at.body.solid.radius().unwrap_or(0.0);
    for (distance, other) in near.outward(&at.motion.placement.position) {
        if distance - WIDEST * radii > smallest {
            break;
        }
        for rule in rules.of(at.index) {
            let Some(bodies) = rules.all()[*rule].between(at.index, other) else { continue };
            for pair in near.unlisted(*rule, bodies, &at.model.bodies) {
                if width(&pair) < smallest {
                    smallest = smallest.min(look(&pair, scratch)?);
                }
            }
        }
    }
    Ok(smallest)
}

/// The slab between two bodies that are out of reach [m].
fn far_gap(at: &BodyAt, pair: &Pair, scratch: &mut Scratch) -> Result<f64, Inadmissible> {
    let bodies = pair.bodies.map(|body| at.beside(body));
    let [one, other] = &bodies;
    if let Some(gap) = pair.form.gap_of_balls(one.from(other).norm()) {
        return Ok(gap);
    }
    let found = with_sides(pair, &bodies, |sides| {
        // A plane of least potential may be beyond the digits of a number.
        let found = PairLoads::integrate(&pair.form, sides, None, &mut scratch.pairs.room);
        found.or_else(|_| PairLoads::nothing(&pair.form, sides))
    });
    found.map(|loads| loads.gap).map_err(|fault| outside(one, pair, fault))
}

/// A state outside the model, for what became of a plane.
fn outside(at: &BodyAt, pair: &Pair, fault: PairFault) -> Inadmissible {
    let (other, rule) = (pair.bodies[1], pair.rule);
    match fault {
        PairFault::Overlap { gap } => at.outside(Quantity::PairGap { other, rule }, gap),
        PairFault::NotFound { decrement } => at.outside(Quantity::PairPlane { other, rule }, decrement),
        PairFault::Singular(_) => at.outside(Quantity::PairPlane { other, rule }, f64::NAN),
    }
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
