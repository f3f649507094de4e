//! Reaches that cut off a part of an adhesion: it falls more slowly than the repulsion by which a reach is chosen.

use super::joined::Joined;
use super::trial::TrialPair;
use crate::format::significant;
use gyration::model::Model;
use gyration::state::State;

/// A part of the energy of adhesion that is another when it is left out.
const MOST: f64 = 1e-2;
/// Contacts that are looked at.
const MOST_CONTACTS: usize = 12;

/// What must be told of the reaches of bodies that adhere, for the first two of each contact.
pub(super) fn warnings(model: &Model, start: &State) -> Vec<String> {
    (0..model.rules().all().len()).take(MOST_CONTACTS).filter_map(|rule| warning(model, start, rule)).collect()
}

fn warning(model: &Model, start: &State, rule: usize) -> Option<String> {
    model.rules().all()[rule].reach.filter(|_| model.rules().all()[rule].laws.held_gap().is_some())?;
    let two = Joined::of_rule(model, rule).next()?;
    let pair = two.pairs(model).next()?;
    let (reach, range) = (pair.form.reach?, pair.form.range?);
    let part = TrialPair::of(model, start, &two, &pair).held_beyond(range).filter(|part| *part > MOST)?;
    let [one, other] = pair.parties.map(|party| model.party_name(party));
    let nearer = if range < reach { format!(", {} m for two balls,", significant(range, 3)) } else { String::new() };
    let (reach, part) = (significant(reach, 3), significant(part, 2));
    Some(format!(
        "at the reach of {reach} m{nearer} \"{one}\" and \"{other}\" would still have {part} of the energy by which \
         they hold each other, which is left out beyond: write a longer one, or leave it out"
    ))
}
