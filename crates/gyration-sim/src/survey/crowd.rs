//! Many bodies of a survey in words: each sort once, and between which bounds its bodies differ.
//!
//! Bodies are of one sort if the same words tell what they are and what the laws forbid. Gaps, at the start and at
//! rest, depend on place and orientation.

use super::bodies::{BodySurvey, PairSurvey};
use super::rest::RestGap;
use super::words::{short, write_body, write_laws, write_rest_state, write_solid};
use std::collections::HashMap;
use std::fmt::Write as _;

/// A number that a gap of rest may have.
type OfRest = fn(&RestGap) -> Option<f64>;

/// Sorts of bodies that are told.
const MOST_SORTS: usize = 8;
/// Bodies that are told one by one; of more there is a summary.
pub(super) const MOST_BODIES: usize = 100;

// Writing to a string does not fail: the results of writeln! are dropped in this file.

/// The bodies of each sort, in the order of the first ones, as many as are told.
pub(super) fn sorts(bodies: &[BodySurvey]) -> Vec<Vec<usize>> {
    let mut sorts: Vec<Vec<usize>> = Vec::new();
    let mut known = HashMap::new();
    for (index, body) in bodies.iter().enumerate() {
        let place = *known.entry(common_words(body)).or_insert(sorts.len());
        match sorts.get_mut(place) {
            Some(sort) => sort.push(index),
            None => sorts.push(vec![index]),
        }
    }
    sorts.truncate(MOST_SORTS);
    sorts
}

/// What is told of all bodies of a sort.
fn common_words(body: &BodySurvey) -> String {
    let mut text = String::new();
    write_solid(&mut text, body);
    for pair in &body.supports {
        let _ = writeln!(text, "  on {}:", pair.support);
        write_laws(&mut text, pair);
    }
    text
}

/// All bodies of a crowd.
pub(super) fn write_crowd(text: &mut String, bodies: &[BodySurvey]) {
    let mut told = 0;
    for sort in sorts(bodies) {
        text.push('\n');
        told += sort.len();
        match sort[..] {
            [only] => write_body(text, &bodies[only]),
            _ => write_sort(text, &sort.iter().map(|index| &bodies[*index]).collect::<Vec<_>>()),
        }
    }
    if told < bodies.len() {
        let _ = writeln!(text, "\n{} bodies more, of other sorts: all with --json", bodies.len() - told);
    }
}

/// Bodies of one sort.
fn write_sort(text: &mut String, bodies: &[&BodySurvey]) {
    let [first, .., last] = bodies else { return };
    let _ = writeln!(text, "{} bodies alike, {} to {}", bodies.len(), first.name, last.name);
    write_solid(text, first);
    for (place, pair) in first.supports.iter().enumerate() {
        let pairs: Vec<&PairSurvey> = bodies.iter().filter_map(|body| body.supports.get(place)).collect();
        let gaps = between(pairs.iter().map(|pair| pair.initial_gap));
        let _ = writeln!(text, "  on {}: gap {gaps} m at the start", pair.support);
        write_laws(text, pair);
        write_rests(text, &pairs, first.kind.material.is_some());
    }
    if first.rest_state.is_some() || first.no_rest_state_because.is_some() {
        let _ = writeln!(text, "  of {}:", first.name);
        write_rest_state(text, first);
    }
}

/// Between which bounds bodies rest, those that do.
fn write_rests(text: &mut String, pairs: &[&PairSurvey], deforms: bool) {
    let resting = pairs.iter().filter(|pair| pair.rests.iter().any(|rest| rest.stable)).count();
    let asked = pairs.iter().filter(|pair| pair.no_rest_because.is_none() && !pair.laws.is_empty()).count();
    if resting < asked {
        let _ = writeln!(text, "    {} of them have no gap at which they rest", asked - resting);
    }
    if resting == 0 {
        return;
    }
    let stable = || pairs.iter().flat_map(|pair| &pair.rests).filter(|rest| rest.stable);
    let range = |of: OfRest| Some(stable().filter_map(of)).filter(|it| it.clone().count() > 0);
    let if_so = if deforms { "if they kept their shapes" } else { "in the orientations of the start" };
    let verb = if stable().any(|rest| rest.descent.is_some()) { "go down the slope" } else { "rest" };
    let _ = writeln!(text, "    {verb} at gaps of {} m {if_so}", between(stable().map(|rest| rest.gap)));
    let lines: [(&str, OfRest, &str); 9] = [
        ("sliding steadily at", |rest| rest.descent?.speed(), " m/s"),
        ("stiffness", |rest| Some(rest.stiffness), " N/m"),
        ("period", |rest| rest.period, " s"),
        ("damping ratio", |rest| rest.damping_ratio, ""),
        ("decays in", |rest| rest.damping_time, " s"),
        ("sliding decays in", |rest| rest.friction_time, " s"),
        ("friction is as strong as the weight at", |rest| Some(rest.slip?.weight_speed), " m/s"),
        ("friction holds up to", |rest| rest.slip?.bound, " of what presses"),
        ("slow rolling decays in", |rest| rest.slip?.rolling_time, " s"),
    ];
    for (name, of, unit) in lines {
        if let Some(values) = range(of) {
            let _ = writeln!(text, "      {name} {}{unit}", between(values));
        }
    }
}

/// The least and the largest of some numbers, or the one that all are.
fn between(values: impl Iterator<Item = f64>) -> String {
    let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), value| (a.min(value), b.max(value)));
    let (least, most) = (short(least), short(most));
    if least == most { least } else { format!("{least} to {most}") }
}
