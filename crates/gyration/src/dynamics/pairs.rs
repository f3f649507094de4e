//! Pairs of bodies that meet: the plane of each is found once at an instant, and both bodies have their part of it.

use super::contacts::deformation;
use super::{Scratch, Workspace};
use crate::extended::Numbers;
use crate::inadmissible::{Inadmissible, Quantity};
use crate::instant::{BodyAt, Instant, KindAt};
use crate::load::JointEnd;
use crate::model::Model;
use crate::pair::{Pair, PairGap, PairLoads, PairScratch, PairSlopes, Side};
use crate::surface::GapClosed;

/// A pair as one of its bodies sees it.
pub type PairEnd<'a> = JointEnd<'a, Pair>;

/// What all pairs of a model do at an instant.
#[derive(Debug, Clone, Default)]
pub(crate) struct Met {
    /// By the number of the pair.
    pub loads: Vec<PairLoads>,
    /// The same, where derivatives are wanted; none out of reach.
    pub slopes: Vec<Option<PairSlopes>>,
    room: PairScratch,
}

/// Finds what all pairs do to their bodies; of those that are so far apart that it is nothing, the gaps only where
/// `everywhere` asks for them.
pub(super) fn meet(
    model: &Model,
    instant: &Instant,
    scratch: &mut Scratch,
    everywhere: bool,
) -> Result<(), Inadmissible> {
    let Met { loads, room, .. } = &mut scratch.met;
    loads.clear();
    for (number, pair) in model.pairs().iter().enumerate() {
        let bodies = pair.bodies.map(|body| instant.at(model, body));
        let found = match !everywhere && is_far(pair, &bodies) {
            true => Ok(PairLoads::default()),
            false => with_sides(pair, &bodies, |sides| PairLoads::integrate(pair, sides, room)),
        };
        loads.push(found.map_err(|closed| outside(&bodies, number, closed))?);
    }
    Ok(())
}

/// The same with derivatives.
pub(super) fn differentiate(model: &Model, instant: &Instant, scratch: &mut Scratch) -> Result<(), Inadmissible> {
    let Met { slopes, room, .. } = &mut scratch.met;
    slopes.clear();
    for (number, pair) in model.pairs().iter().enumerate() {
        let bodies = pair.bodies.map(|body| instant.at(model, body));
        let found = match is_far(pair, &bodies) {
            true => Ok(None),
            false => with_sides(pair, &bodies, |sides| PairSlopes::integrate(pair, sides, room)).map(Some),
        };
        slopes.push(found.map_err(|closed| outside(&bodies, number, closed))?);
    }
    Ok(())
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
        for (number, pair) in model.pairs().iter().enumerate() {
            let bodies = pair.bodies.map(|body| instant.at(model, body));
            let found = match is_far(pair, &bodies) {
                true => Ok(PairGap::FAR),
                false => with_sides(pair, &bodies, |sides| pair.gap(sides, &mut scratch.met.room)),
            };
            gaps.push(found.map_err(|closed| outside(&bodies, number, closed))?);
        }
        Ok(())
    }
}

/// Whether two rigid bodies are farther apart than their pair reaches.
fn is_far(pair: &Pair, [one, other]: &[BodyAt; 2]) -> bool {
    let rigid = |at: &BodyAt| matches!(at.kind(), KindAt::Rigid(..));
    let Some(span) = pair.span().filter(|_| rigid(one) && rigid(other)) else { return false };
    (one.motion.placement.position - other.motion.placement.position).norm() >= span
}

fn with_sides<T>(pair: &Pair, bodies: &[BodyAt; 2], each: impl FnOnce([&Side; 2]) -> T) -> T {
    let [one, other] = [0, 1].map(|end| {
        let at = &bodies[end];
        let apart = bodies[0].motion.placement.position - bodies[1].motion.placement.position;
        Side {
            surface: at.body.solid.part(pair.parts[end]),
            placement: &at.motion.placement,
            velocity: &at.motion.velocity,
            inverse: at.inverse(),
            deformation: deformation(at),
            least_gap: at.body.least_distance(apart.norm()),
        }
    });
    each([&one, &other])
}

fn outside([one, _]: &[BodyAt; 2], number: usize, closed: GapClosed) -> Inadmissible {
    one.outside(Quantity::PairGap { pair: number }, closed.gap)
}
