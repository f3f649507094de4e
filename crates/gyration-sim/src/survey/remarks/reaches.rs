//! Reaches that are shorter than the gaps at which bodies turn back: the law is then another one.

use super::trial::TrialPair;
use crate::format::significant;
use gyration::model::Model;
use gyration::pair::Reach;
use gyration::state::State;

/// In so many gaps, or d₀, a law falls to what may be left out.
const LEAST: f64 = 10.0;
/// Contacts that are looked at.
const MOST_CONTACTS: usize = 12;
/// Pairs of a contact of which the fastest is looked at.
const MOST_PAIRS: usize = 10_000;

/// What must be told of the reaches of a model.
pub(super) fn warnings(model: &Model, start: &State) -> Vec<String> {
    let rules = (0..model.rules().all().len()).take(MOST_CONTACTS);
    rules.filter_map(|rule| warning(model, start, rule)).collect()
}

fn warning(model: &Model, start: &State, rule: usize) -> Option<String> {
    let velocity = |body: usize| start.motion(model, body).velocity.velocity;
    let speed = |[one, other]: &[usize; 2]| (velocity(*one) - velocity(*other)).norm();
    let rule_of_both = &model.rules().all()[rule];
    // One that is found from the gaps is no shorter.
    let Reach::Length(reach) = rule_of_both.reach? else { return None };
    let fastest = rule_of_both.pairs().take(MOST_PAIRS).max_by(|one, other| speed(one).total_cmp(&speed(other)))?;
    let pair = model.pairs_between(rule, fastest).last()?;
    let trial = TrialPair::of(model, start, &pair);
    let gap = trial.turning_gap();
    let reference = pair.form.laws.repulsion.reference_gap;
    let [one, other] = pair.bodies.map(|body| &model.bodies[body].name);
    let least = match gap {
        Some(gap) if reach < LEAST * gap => {
            format!("they turn back at a gap of about {} m", significant(gap, 2))
        }
        // A d0 that is larger than the bodies is a unit, no gap.
        None if reach < LEAST * reference && reference < trial.size() => {
            format!("d0 is {} m", significant(reference, 3))
        }
        _ => return None,
    };
    let reach = significant(reach, 3);
    Some(format!(
        "the reach of {reach} m between \"{one}\" and \"{other}\" is short: {least}, and within ten times that a reach \
         makes another law of the repulsion"
    ))
}
