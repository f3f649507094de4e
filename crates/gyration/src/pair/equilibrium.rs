//! The plane of least potential between two bodies, by Newton's method on L = log U.
//!
//! A step δ that changes gaps by the parts x of them, |x| ≤ η, leaves a gradient of second order, some ν η times the
//! one before, and changes the moments of a side by ½ ν(ν+1) ⟨x²⟩ beyond first order, where
//!
//!   s_i ⟨x²⟩_i ≤ 2/(ν−1) (squared Newton decrement)
//!
//! Where both are rounding the search ends: plane and forces are carried there in first order, and derivatives alone
//! need a look at the plane itself.

use super::expansion::{Expansion, Step};
use super::fault::PairFault;
use super::form::PairForm;
use super::gjk::{guessed, separate};
use super::laws::PairLaws;
use super::placed::Placed;
use super::plane::Guess;
use super::side::Half;
use crate::surface::Moments;

/// A Newton decrement that is rounding: the plane is known to fifteen digits of what its forces feel.
const CONVERGED: f64 = 3e-15;

/// By how much what a step leaves is told to be more than it is found to be: ν η bounds it for ν above 3, and is
/// exceeded up to fiftyfold where corners next to the plane weigh little (ν near 2).
const CAUTION: f64 = 64.0;

/// Below this squared decrement steps are whole, and a decrement that no longer falls is rounding.
const NEAR: f64 = 1e-10;

/// What sums of moments are rounded to.
const ROUNDING: f64 = 1e-13;

/// A squared decrement with which a plane is not found.
const LOST: f64 = 1e-8;

/// More steps, and more halvings of one, than planes take.
const MOST_STEPS: usize = 100;
const MOST_HALVINGS: usize = 60;

/// Where a search ends: next to the plane of least potential, with the step to it; none where digits tell no better
/// one.
#[derive(Debug, Clone)]
pub(super) struct Found {
    expansion: Expansion,
    left: Option<Step>,
}

/// Searches the plane of least potential.
///
/// # Errors
/// [`PairFault`] if nothing separates the bodies, or the plane is beyond the digits of a number.
pub(super) fn search(
    pair: &PairForm,
    halves: [&Half; 2],
    guess: Option<&Guess>,
    room: &mut [Moments],
) -> Result<Found, PairFault> {
    let laws = &*pair.laws;
    let guessed = guess.and_then(|guess| Expansion::about(laws, halves, guessed(halves, guess)?, room).ok());
    let mut expansion = match guessed {
        Some(expansion) => expansion,
        None => Expansion::about(laws, halves, separate(halves).map_err(PairFault::of_gap)?, room)?,
    };
    let mut before = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let step = expansion.step();
        if is_last(pair, halves, &expansion, &step) {
            return Ok(Found { expansion, left: Some(step) });
        }
        let falls = step.decrement >= NEAR || step.decrement <= 0.25 * before;
        before = step.decrement;
        if !falls {
            break;
        }
        let Some(next) = descend(laws, halves, &expansion, &step, room) else { break };
        let stays = next.plane == expansion.plane;
        expansion = next;
        // Digits tell no other plane.
        if stays {
            break;
        }
    }
    // A plane that is not in balance would push without a potential.
    if before < LOST { Ok(Found { expansion, left: None }) } else { Err(PairFault::NotFound { decrement: before }) }
}

/// Whether what a step leaves is rounding, of gaps known to ε R: a decrement of ν η times this one, and moments beyond
/// first order.
fn is_last(pair: &PairForm, halves: [&Half; 2], expansion: &Expansion, step: &Step) -> bool {
    if step.decrement >= NEAR {
        return false;
    }
    let (radii, exponent) = (pair.radii, pair.laws.repulsion.exponent);
    let gaps = halves.map(|half| half.smallest_gap(&expansion.plane).0);
    let rounding = CONVERGED.max(f64::EPSILON * (radii[0] / gaps[0]).min(radii[1] / gaps[1]));
    let left = CAUTION * exponent * expansion.stretch(halves, radii, gaps, step);
    step.decrement * left * left <= rounding * rounding
        && CAUTION * exponent * step.decrement <= rounding * expansion.least_part()
}

/// The expansion about a plane of less potential along a step; none if that is not to be had.
fn descend(
    laws: &PairLaws,
    halves: [&Half; 2],
    expansion: &Expansion,
    step: &Step,
    room: &mut [Moments],
) -> Option<Expansion> {
    let mut part = 1.0;
    for _ in 0..MOST_HALVINGS {
        if let Ok(next) = Expansion::about(laws, halves, expansion.moved(part, step), room)
            && (next.mean.energy <= expansion.mean.energy * (1.0 + ROUNDING) || step.decrement < NEAR)
        {
            return Some(next);
        }
        part *= 0.5;
    }
    None
}

impl Found {
    /// The plane in balance.
    pub fn placed(&self, halves: [&Half; 2]) -> Placed {
        match &self.left {
            Some(step) => self.expansion.placed_after(halves, step),
            None => self.expansion.placed(),
        }
    }

    /// log U about the plane in balance, of which derivatives are.
    pub fn confirmed(self, laws: &PairLaws, halves: [&Half; 2], room: &mut [Moments]) -> Expansion {
        let about = |step: &Step| Expansion::about(laws, halves, self.expansion.moved(1.0, step), room).ok();
        self.left.as_ref().and_then(about).unwrap_or(self.expansion)
    }
}
