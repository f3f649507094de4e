//! The force of the central laws on each body, its weight, and the gaps at which they balance.
//!
//! Of bodies and supports, or pairs of bodies, that are alike the first is drawn, with how many there are of them.

use super::sources::Groups;
use super::{GapRange, by_sign, chart};
use crate::chart::ticks::length_in_words;
use crate::chart::{Chart, DOTTED, Series};
use crate::draw::{Point, color};
use gyration::body::Solid;
use gyration::model::Model;
use gyration::neighbours::Pair;
use gyration::state::State;
use gyration_sim::survey::{Approach, Encounter, RestGap};
use serde_json::Value;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// Curves with marks for their weights and gaps of rest.
const MOST_MARKED: usize = 7;
/// Curves that are drawn.
const MOST_CURVES: usize = 40;
/// Pairs of bodies of a contact among which those that are alike are looked for.
const MOST_SORTED: usize = 100_000;

/// A force over a distance.
pub struct ForceCurve<'a> {
    name: String,
    of: Meeting<'a>,
}

/// Who approaches whom.
enum Meeting<'a> {
    /// A body its support.
    Support { approach: Box<Approach<'a>>, rests: Vec<RestGap> },
    /// A body another one, or a support with a shape.
    Bodies(Box<Encounter<'a>>),
}

impl<'a> ForceCurve<'a> {
    /// Of all bodies that a model lets meet something, and how many have no curve.
    pub fn all(model: &'a Model, start: &State, resolved: &Value) -> (Vec<Self>, usize) {
        let (mut curves, mut left_out) = (Vec::new(), 0);
        let several = model.supports.len() > 1;
        for (body, support) in
            (0..model.bodies.len()).flat_map(|body| (0..model.supports.len()).map(move |k| (body, k)))
        {
            if curves.len() == MOST_CURVES {
                let has = model.contacts_of(body).any(|contact| contact.support == support);
                left_out += usize::from(has);
                continue;
            }
            if let Some(approach) = Approach::new(model, start, body, support).filter(Approach::acts) {
                let on = if several { format!(" on {}", model.supports[support].name) } else { String::new() };
                let rests = approach.rests();
                let name = format!("{}{on}", model.name(body));
                curves.push(Self { name, of: Meeting::Support { approach: Box::new(approach), rests } });
            }
        }
        let groups = Groups::of(model, resolved);
        let sorts = sorts(model);
        left_out += sorts.iter().map(|(_, parts)| parts.len()).sum::<usize>().saturating_sub(MOST_CURVES);
        let sorts = sorts.iter().flat_map(|(bodies, parts)| parts.iter().map(move |first| (first, bodies)));
        for (first, bodies) in sorts.take(MOST_CURVES) {
            if let Some(encounter) = Encounter::new(model, start, first) {
                let name = groups.name(model, bodies.len(), bodies.iter().copied());
                curves.push(Self { name, of: Meeting::Bodies(Box::new(encounter)) });
            }
        }
        for pair in unlike(model) {
            if curves.len() >= MOST_CURVES {
                left_out += 1;
            } else if let Some(encounter) = Encounter::new(model, start, pair) {
                let [one, other] = pair.parties.map(|party| model.party_name(party));
                curves.push(Self { name: format!("{one} on {other}"), of: Meeting::Bodies(Box::new(encounter)) });
            }
        }
        (curves, left_out)
    }

    /// The gaps at which a support carries the weight.
    pub fn rests(&self) -> &[RestGap] {
        match &self.of {
            Meeting::Support { rests, .. } => rests,
            Meeting::Bodies(_) => &[],
        }
    }

    /// The largest side of the bodies [m].
    pub fn size(&self) -> f64 {
        match &self.of {
            Meeting::Support { approach, .. } => approach.size(),
            Meeting::Bodies(encounter) => encounter.size,
        }
    }

    /// Distance [m] and force [N].
    fn at(&self, gap: f64) -> Point {
        match &self.of {
            Meeting::Support { approach, .. } => [gap, approach.force(gap).unwrap_or(f64::NAN)],
            Meeting::Bodies(encounter) => encounter.at(gap).unwrap_or([gap, f64::NAN]),
        }
    }

    /// The weight as a level line, named once, and each gap of rest as an upright one below it.
    fn marks(&self, hue: usize, gaps: &GapRange) -> Vec<Series> {
        let Meeting::Support { approach, rests } = &self.of else { return Vec::new() };
        let weight = approach.weight;
        let mut marks = Vec::new();
        if weight > 0.0 {
            marks.push(Series::level(if hue == 0 { "weight" } else { "" }, weight, &gaps.axis));
        }
        for rest in rests {
            let points = vec![[rest.gap, f64::MIN_POSITIVE], [rest.gap, weight.abs()]];
            let kind = if rest.stable { "" } else { " (unstable)" };
            let mut mark = Series::solid(format!("rest gap {}{kind}", length_in_words(rest.gap)), points, hue);
            mark.stroke.width = 0.9;
            if !rest.stable {
                mark.stroke.color = color::GREY;
            }
            marks.push(mark.dashed(DOTTED));
        }
        marks
    }
}

/// The pairs of bodies that are alike, equal bodies that meet by one rule, each sort with the pairs of parts of its
/// first two; of very many pairs of bodies of a contact some.
fn sorts(model: &Model) -> Vec<(Vec<[usize; 2]>, Vec<Pair>)> {
    let mut places: HashMap<(usize, [*const Solid; 2]), usize> = HashMap::new();
    let mut sorts: Vec<(Vec<[usize; 2]>, Vec<Pair>)> = Vec::new();
    let rules = model.rules().all().iter().enumerate();
    let pairs = rules.flat_map(|(rule, set)| set.pairs().take(MOST_SORTED).map(move |bodies| (rule, bodies)));
    for (rule, bodies) in pairs {
        let solids = bodies.map(|body| Arc::as_ptr(&model.bodies[body].solid));
        let place = *places.entry((rule, solids)).or_insert(sorts.len());
        match sorts.get_mut(place) {
            Some((alike, _)) => alike.push(bodies),
            None => sorts.push((vec![bodies], model.pairs_between(rule, bodies).collect())),
        }
    }
    sorts
}

/// The pairs with supports that have a shape, one of those that are alike: parts of equal bodies with those of a
/// support.
fn unlike(model: &Model) -> impl Iterator<Item = &Pair> {
    let mut known = HashSet::new();
    model.pairs_with_supports().iter().filter(move |pair| {
        let solids = pair.parties.map(|party| model.solid_of(party).map(std::ptr::from_ref));
        known.insert((pair.rule, solids, pair.parts))
    })
}

/// The forces of all curves; each is named, those of bodies with one force under one name.
pub fn force_chart(curves: &[ForceCurve], left_out: usize, gaps: &GapRange) -> Option<Chart> {
    let mut sorts: Vec<(Vec<Point>, Vec<&ForceCurve>)> = Vec::new();
    for curve in curves {
        let points: Vec<Point> = gaps.sampled().map(|gap| curve.at(gap)).collect();
        match sorts.iter_mut().find(|(known, _)| curves.len() > MOST_MARKED && agree(known, &points)) {
            Some((_, sort)) => sort.push(curve),
            None => sorts.push((points, vec![curve])),
        }
    }
    let mut series = Vec::new();
    for (index, (points, sort)) in sorts.into_iter().enumerate() {
        let more = sort.len() - 1;
        let name = if more > 0 { format!("{} and {more} alike", sort[0].name) } else { sort[0].name.clone() };
        series.extend(by_sign(name, points, index));
    }
    let title = "Force of the central laws on a body at its first orientation";
    let mut chart = chart([title, "force", "N"], gaps, series)?;
    if curves.iter().any(|curve| matches!(curve.of, Meeting::Bodies(_))) {
        chart.remarks.extend(["between solids: distance".to_owned(), "is the slab between them".to_owned()]);
    }
    if left_out > 0 {
        chart.remarks.push(format!("{} of {} forces drawn", curves.len(), curves.len() + left_out));
    }
    if curves.len() <= MOST_MARKED {
        // Marks do not decide the range; weights outside of it are not drawn.
        let (low, high) = (chart.y.low, chart.y.high);
        let marks = curves.iter().enumerate().flat_map(|(index, curve)| curve.marks(index, gaps));
        chart.series.extend(marks.filter(|mark| (low..=high).contains(&mark.points[1][1])));
    }
    Some(chart)
}

/// Whether two forces are the same to the eye.
fn agree(one: &[Point], other: &[Point]) -> bool {
    one.iter()
        .zip(other)
        .all(|(a, b)| a[1] == b[1] || (a[1] - b[1]).abs() <= 1e-3 * a[1].abs() || (a[1].is_nan() && b[1].is_nan()))
}
