//! Contacts of many bodies without a reach, or of those that deform, which have none: what that costs, and which reach
//! changes little.
//!
//! Proposed are 25 gaps g of the fastest two of its bodies, or twice as many until g changes by no more than a
//! hundredth of itself, δg/g = 5 U_c/(g F).

use super::joined::Joined;
use crate::format::significant;
use crate::survey::meetings::EVALUATIONS;
use gyration::model::Model;
use gyration::neighbours::{Pair, PairRule};
use gyration::pair::{Falling, Mass, PairForm, Reach};
use gyration::state::State;
use std::sync::Arc;

/// Contacts that are told of.
const MOST_TOLD: usize = 12;
/// Pairs of a contact from which on it costs that none is too far to be looked at.
const MANY_PAIRS: usize = 20;
/// Rigid bodies that share their steps with one that deforms from which on that is told.
const MANY_RIGID: usize = 20;
/// Bodies of the larger of both sets from which on it is told what that costs.
const MANY_BODIES: usize = 200;
/// Pairs of a contact of which the fastest is looked at.
const MOST_PAIRS: usize = 10_000;
/// A gap that a reach makes smaller by at most that part is the same.
const SMALL_CHANGE: f64 = 1e-2;
/// So many reaches are tried, each twice as long as the one before.
const MOST_TRIED: i32 = 12;
/// What a pair takes [s]: of balls in closed form, and where a plane is looked for.
const PER_PAIR: [f64; 2] = [5e-7, 5e-6];

/// What must be told of contacts of many bodies without a reach.
pub(super) fn notes(model: &Model, start: &State) -> Vec<String> {
    let rules = model.rules().all().iter().enumerate();
    let without = rules.filter(|(_, rule)| rule.reach.is_none() && model.images().is_none()).map(|(rule, _)| rule);
    let many = without.filter(|rule| Joined::of_rule(model, *rule).nth(MANY_PAIRS).is_some());
    many.filter_map(|rule| note(model, start, rule)).take(MOST_TOLD).collect()
}

/// What must be told of many rigid bodies that share their steps since others deform, with a reach or not.
pub(super) fn beside_deforming(model: &Model) -> Vec<String> {
    if model.images().is_some() {
        return Vec::new();
    }
    let note = |rule: &PairRule| {
        let deforms = |body: &usize| model.bodies[*body].affine().is_some();
        let bodies = || rule.bodies.iter().flat_map(|set| set.iter().copied());
        let soft = bodies().find(deforms)?;
        let mut rigid: Vec<usize> = bodies().filter(|body| !deforms(body)).collect();
        rigid.sort_unstable();
        rigid.dedup();
        (rigid.len() >= MANY_RIGID).then(|| {
            format!(
                "\"{}\" deforms and acts on all that it has a contact with, however far they are: {} rigid bodies \
                 share their steps for that",
                model.name(soft),
                rigid.len()
            )
        })
    };
    model.rules().all().iter().filter_map(note).take(MOST_TOLD).collect()
}

fn note(model: &Model, start: &State, rule: usize) -> Option<String> {
    let written = &model.rules().all()[rule];
    let [one, other] = Joined::of_rule(model, rule).next()?.bodies.map(|body| model.name(body));
    let count: usize = written.bodies.iter().map(|set| set.len()).max().unwrap_or(0);
    let contact = format!("the contact of \"{one}\" and \"{other}\" has no reach");
    let bodies = || written.bodies.iter().flat_map(|set| set.iter());
    let proposal = ReachProposal::of(model, start, rule);
    let proposed = match &proposal {
        Some(proposal) => proposal.told(),
        // `auto` goes by weight and speed.
        None if bodies().any(|body| !model.bodies[*body].has_inertia()) => {
            "a `reach` of some 25 of the gaps at which their forces balance the fluid's leaves out the rest".to_owned()
        }
        None => "a `reach` of some 25 of the gaps at which they turn back leaves out the rest".to_owned(),
    };
    if count <= MANY_BODIES {
        return Some(format!(
            "{contact}: each of its pairs acts however far apart, and all its bodies share their steps; {proposed}"
        ));
    }
    let are_balls = bodies().all(|body| model.bodies[*body].is_rigid_ball());
    let pairs = written.count();
    let seconds = (EVALUATIONS * pairs) as f64 * PER_PAIR[usize::from(!are_balls)];
    Some(format!(
        "{contact}: each of its {pairs} pairs acts however far apart, a step of all its bodies takes some {} s; \
         {proposed}",
        significant(seconds, 1)
    ))
}

/// A reach that may be given, and what it changes.
struct ReachProposal {
    /// [m].
    reach: f64,
    /// Whether it is that of `auto`.
    is_auto: bool,
    /// The gap at which the fastest two come to rest or turn back [m], and by what part of itself it gets smaller.
    gap: f64,
    change: f64,
}

impl ReachProposal {
    /// Of the fastest two bodies of a contact; none where neither gravity nor a speed brings bodies together, or none
    /// has inertia.
    fn of(model: &Model, start: &State, rule: usize) -> Option<Self> {
        let speed = |two: &Joined| two.apart(model, start).1.norm();
        let pairs = Joined::of_rule(model, rule).take(MOST_PAIRS);
        let fastest = pairs.max_by(|one, other| speed(one).total_cmp(&speed(other)))?;
        if fastest.bodies.iter().any(|body| !model.bodies[*body].has_inertia()) {
            return None;
        }
        let falling = Falling { gravity: model.gravity.norm(), speed: speed(&fastest) };
        let pair = fastest.pairs(model).last().filter(|_| falling.acts())?;
        let Pair { parts, form, .. } = &pair;
        let solids = fastest.bodies.map(|body| &model.bodies[body].solid);
        let surfaces = [0, 1].map(|end| solids[end].part(parts[end]));
        let masses = [0, 1].map(|end| Mass { surface: surfaces[end], mass: solids[end].mass.mass });
        let gap = falling.contact_gap(&form.laws, masses);
        let shortest = Reach::of_gaps(&falling, &form.laws, masses);
        let of = |reach: Reach| {
            let threshold = reach.threshold(&form.laws, masses);
            let radii = surfaces.map(gyration::surface::Surface::radius);
            let form = PairForm::of_radii(Arc::clone(&form.laws), Some(threshold), surfaces, radii);
            Some(Self { reach: threshold.reach, is_auto: false, gap, change: form.change_of_gap(gap, surfaces)? })
        };
        let auto =
            of(Reach::Gaps { falling, longest: shortest, is_common: true }).map(|it| Self { is_auto: true, ..it });
        let longer = (0..MOST_TRIED).filter_map(|doubled| of(Reach::Length(shortest * f64::from(1 << doubled))));
        auto.into_iter().chain(longer).find(|it| it.change <= SMALL_CHANGE && it.reach.is_finite())
    }

    fn told(&self) -> String {
        let (reach, gap) = (significant(self.reach, 2), significant(self.gap, 2));
        let written = if self.is_auto { format!("\"auto\"`, {reach} m,") } else { format!("\"{reach} m\"`") };
        format!(
            "`reach = {written} leaves out the rest, and makes the gap of about {gap} m at which the fastest two turn \
             back smaller by {} of it",
            significant(self.change, 1)
        )
    }
}
