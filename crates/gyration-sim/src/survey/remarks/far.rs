//! Bodies so far from the origin that the digits of their places do not tell the gaps at which they start.
//!
//! A run keeps the distance of two bodies in twice the digits, wherever the origin is. What a scene gives has the
//! digits of one number, as have the places of pinned bodies at any time.

use super::joined::Joined;
use super::trial::TrialPair;
use crate::format::significant;
use gyration::model::Model;
use gyration::state::State;

/// What a place is known to, in parts of the distance from the origin.
const DIGIT: f64 = f64::EPSILON;
/// In so many tolerances an error of the energy is told: as of the ledger.
const MARGIN: f64 = 100.0;
/// Distances from the origin, in sizes, that are not looked at.
const NEAR: f64 = 1e3;
/// Pairs that are looked at.
const MOST_PAIRS: usize = 20;

/// What must be told of the pair that is farthest from the origin, to be run with this relative tolerance.
pub(super) fn warning(model: &Model, start: &State, rtol: f64) -> Option<String> {
    let place = |body: usize| start.motion(model, body).placement.position.norm();
    let far = |body: usize| place(body) > NEAR * model.bodies[body].size;
    if !(0..model.bodies.len()).any(|body| far(body) && model.meets_bodies(body)) {
        return None;
    }
    let joined = (0..model.rules().all().len()).flat_map(|rule| Joined::of_rule(model, rule));
    let far_ones = joined.filter(|two| two.bodies.iter().any(|body| far(*body)));
    let mut pairs = far_ones.flat_map(|two| two.pairs(model).map(move |pair| (two, pair))).take(MOST_PAIRS);
    pairs.find_map(|(two, pair)| {
        let distance = place(two.bodies[0]).max(place(two.bodies[1]));
        let trial = TrialPair::of(model, start, &two, &pair);
        let is_pinned = two.bodies.iter().any(|body| model.bodies[*body].pin.is_some());
        let gap = if is_pinned { trial.turning_gap()? } else { trial.gap()? };
        // A repulsion d^−ν turns the rounding of a gap into so much of its energy.
        let error = pair.form.laws.repulsion.exponent * DIGIT * distance / gap;
        if error <= MARGIN * rtol {
            return None;
        }
        let [one, other] = two.bodies.map(|body| model.name(body));
        let (distance, gap, digit) = (significant(distance, 3), significant(gap, 2), DIGIT * distance);
        Some(format!(
            "\"{one}\" and \"{other}\" are {distance} m from the origin, where places are known to {digit:.1e} m, and \
             the gap that matters is about {gap} m: move all bodies and supports nearer to the origin"
        ))
    })
}
