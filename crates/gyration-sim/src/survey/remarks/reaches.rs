//! Reaches that are shorter than the gaps at which bodies turn back: the law is then another one.

use super::joined::Joined;
use super::trial::TrialPair;
use crate::format::significant;
use crate::survey::reach_change::ReachChange;
use gyration::model::Model;
use gyration::neighbours::Pair;
use gyration::pair::Reach;
use gyration::state::State;

/// In so many gaps, or d₀, a law falls to what may be left out.
const LEAST: f64 = 10.0;
/// Contacts that are told of.
const MOST_TOLD: usize = 12;
/// A gap that a reach found from it makes smaller by more than that part is another.
const MOST_CHANGE: f64 = 1e-2;
/// The same of slow bodies, which turn back farther out: of many there are always some.
const MOST_OF_SLOW: f64 = 0.1;
/// Pairs of a contact of which the fastest is looked at.
const MOST_PAIRS: usize = 10_000;

/// What must be told of the reaches of a model.
pub(super) fn warnings(model: &Model, start: &State) -> Vec<String> {
    let rules = 0..model.rules().all().len();
    let of_rule = |rule: usize| warning(model, start, rule).or_else(|| of_supports(model, start, rule));
    rules.filter_map(of_rule).take(MOST_TOLD).collect()
}

fn warning(model: &Model, start: &State, rule: usize) -> Option<String> {
    match model.rules().all()[rule].reach? {
        Reach::Length(reach) => of_a_length(model, start, rule, reach),
        Reach::Gaps { .. } => of_gaps(model, start, rule),
    }
}

/// A reach of supports with a shape, beside the gap at which the fastest body turns back.
fn of_supports(model: &Model, start: &State, rule: usize) -> Option<String> {
    let reach = model.rules().all()[rule].reach?;
    let pairs = model.pairs_with_supports().iter().filter(|pair| pair.rule == rule).take(MOST_PAIRS);
    let changes = pairs.filter_map(|pair| Some((pair, ReachChange::of(model, start, pair)?)));
    let (pair, change) = changes.min_by(|(_, one), (_, other)| other.part.total_cmp(&one.part))?;
    let who = Who(pair.parties.map(|party| model.party_name(party)));
    match reach {
        Reach::Length(reach) if reach < LEAST * change.gap => Some(who.is_short(reach, &turning_back(change.gap))),
        Reach::Length(_) => None,
        Reach::Gaps { .. } => (change.part > MOST_CHANGE).then(|| who.changes(pair, &change))?,
    }
}

/// The names of two that meet.
struct Who<'a>([&'a str; 2]);

/// Where two turn back, in words.
fn turning_back(gap: f64) -> String {
    format!("they turn back at a gap of about {} m", significant(gap, 2))
}

impl Who<'_> {
    /// Of a reach that is written.
    fn is_short(&self, reach: f64, least: &str) -> String {
        let ([one, other], reach) = (self.0, significant(reach, 3));
        format!(
            "the reach of {reach} m between \"{one}\" and \"{other}\" is short: {least}, and within ten times that a \
             reach makes another law of the repulsion"
        )
    }

    /// Of a reach that was found.
    fn changes(&self, pair: &Pair, change: &ReachChange) -> Option<String> {
        let part = match change.part.is_finite() {
            true => format!("smaller by {} of it", significant(change.part, 2)),
            false => "another".to_owned(),
        };
        let [one, other] = self.0;
        let (reach, gap) = (significant(pair.form.reach?, 3), significant(change.gap, 2));
        let exponent = pair.form.laws.repulsion.exponent;
        Some(format!(
            "the reach of {reach} m that was found for \"{one}\" and \"{other}\" makes the gap of about {gap} m at \
             which they turn back {part}: it has 25 gaps of the fastest two, of a repulsion of exponent {exponent}; \
             write a longer one, or leave it out"
        ))
    }
}

/// A reach that is written, beside the least gap that the fastest two of its bodies come to.
fn of_a_length(model: &Model, start: &State, rule: usize, reach: f64) -> Option<String> {
    let speed = |two: &Joined| two.apart(model, start).1.norm();
    let begins_within = |two: &Joined| {
        let radii: f64 = two.bodies.iter().filter_map(|body| model.bodies[*body].solid.radius()).sum();
        two.apart(model, start).0.norm() < reach + radii
    };
    // In a lattice those beside one another are in the way of all others.
    let is_dense = model.images().is_some_and(|_| Joined::of_rule(model, rule).any(|two| begins_within(&two)));
    let pairs = Joined::of_rule(model, rule).filter(|two| !is_dense || begins_within(two)).take(MOST_PAIRS);
    let fastest = pairs.max_by(|one, other| speed(one).total_cmp(&speed(other)))?;
    let pair = fastest.pairs(model).last()?;
    let trial = TrialPair::of(model, start, &fastest, &pair);
    let gap = trial.least_gap();
    let reference = pair.form.laws.repulsion.reference_gap;
    let least = match gap {
        Some(gap) if reach < LEAST * gap => turning_back(gap),
        // A d0 that is larger than the bodies is a unit, no gap.
        None if reach < LEAST * reference && reference < trial.size() => {
            format!("d0 is {} m", significant(reference, 3))
        }
        _ => return None,
    };
    Some(Who(fastest.bodies.map(|body| model.name(body))).is_short(reach, &least))
}

/// A reach that was found, for the fastest two of its bodies, and the slowest two that are on their way to each other:
/// it goes by the speed of the fastest, and by so many gaps, which are few where a repulsion falls slowly.
fn of_gaps(model: &Model, start: &State, rule: usize) -> Option<String> {
    let speed = |two: &Joined| two.apart(model, start).1.norm();
    let slower = |one: &Joined, other: &Joined| speed(one).total_cmp(&speed(other));
    let on_the_way = |two: &Joined| {
        let (place, velocity) = two.apart(model, start);
        let radii: f64 = two.bodies.iter().filter_map(|body| model.bodies[*body].solid.radius()).sum();
        place.dot(&velocity) < 0.0 && place.cross(&velocity).norm() < radii * velocity.norm()
    };
    let pairs = || Joined::of_rule(model, rule).take(MOST_PAIRS);
    let told = |two: Option<Joined>, most: f64| {
        let two = two?;
        let pair = two.pairs(model).last()?;
        let change = ReachChange::of(model, start, &pair).filter(|change| change.part > most)?;
        Who(two.bodies.map(|body| model.name(body))).changes(&pair, &change)
    };
    told(pairs().max_by(slower), MOST_CHANGE).or_else(|| told(pairs().filter(on_the_way).min_by(slower), MOST_OF_SLOW))
}
