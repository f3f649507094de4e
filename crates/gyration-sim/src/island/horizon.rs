//! How far a step may go before a support could come within reach.
//!
//! A stepper sees forces only where it looks; a field of short range could be jumped over within a long step of free
//! flight. So a step ends before the first contact that a bound on the motion allows:
//!
//!   d(X, t) ≥ (g₀ + t c₀) + (m + t c)·X − ½ a t²,   c₀ = n·w₀, c = Ṗᵀn, a = max(0, −p̈₀·n)
//!
//! for a body that turns by less than a radian, and for any turn as long as the sphere around the body stays clear. p̈₀
//! is the acceleration at hand: g in free flight, none where a support carries the body, whose field the stepper then
//! sees. Of a body that deforms, a has |P̈ᵀn| r besides, and the sphere grows with |P|. A step also ends where a couple
//! or a drive has a kink, and takes a quarter of a drive's fastest period at most. An oscillating support counts as its
//! foremost place, and is followed in eighths of its period where it may meet the body. A body at rest, or one that
//! leaves, is not held up. Two bodies that meet approach planes between them (`pair_approach`); those that are out of
//! reach of each other come halfway into it, and those that pass one another are looked at where they are nearest
//! (`passing`). Steps are cut by this and never lengthened.

use crate::island::approach::{Approach, may_meet};
use crate::island::carried::SeenFromSupport;
use crate::island::pair_approach::PairApproach;
use crate::island::passing::until_nearest;
use crate::island::plane_approach::{PlaneApproach, first_root};
use crate::island::step_end::StepEnd;
use gyration::Party;
use gyration::body::Solid;
use gyration::instant::PairGaps;
use gyration::lattice::HERE;
use gyration::load::Spring;
use gyration::model::Model;
use gyration::neighbours::BodyPair;
use gyration::pair::{cutoff, half_cutoff};
use gyration::signal::Signal;

/// The part of an oscillating support's period that a step near it may take.
const PERIOD_PART: f64 = 0.125;
/// The part of a drive's fastest period that a step may take: no wave is jumped over.
const DRIVE_PART: f64 = 0.25;
/// So many usual steps are looked at first.
const AHEAD: f64 = 4.0;
/// The longest step [s] from this instant, at most `longest`; `radii` of the bodies about their centres [m], `usual` a
/// step as long as is expected.
pub(crate) fn horizon(
    model: &Model,
    time: f64,
    (ends, gaps): (&[StepEnd], Option<&PairGaps>),
    radii: &[f64],
    (usual, longest): (f64, f64),
) -> f64 {
    let mut step = next_kink(model, time).map_or(longest, |kink| longest.min(kink - time));
    for frequency in model.signals().map(Signal::highest_frequency).filter(|frequency| *frequency > 0.0) {
        step = step.min(DRIVE_PART / frequency);
    }
    let anchors = model.springs().iter().filter_map(Spring::anchor);
    let anchors = anchors.chain(model.joints().iter().map(|joint| &joint.anchor));
    for frequency in anchors.map(|anchor| anchor.motion.highest_frequency()).filter(|frequency| *frequency > 0.0) {
        step = step.min(PERIOD_PART / frequency);
    }
    for (index, ((body, end), radius)) in model.bodies.iter().zip(ends).zip(radii).enumerate() {
        let Some(surface) = &body.solid.surface else { continue };
        for contact in model.contacts_of(index) {
            let support = &model.supports[contact.support];
            let seen = SeenFromSupport::of_plane(support, time, end);
            let end = seen.as_ref().map_or(end, |seen| &seen.body);
            let mut approach = PlaneApproach::of(model, contact.support, time, end, surface, *radius);
            if let Some(seen) = &seen {
                approach.acceleration += seen.bend;
                step = step.min(seen.longest);
            }
            let frequency = support.motion.highest_frequency();
            step = step.min(if frequency > 0.0 {
                let near = surface.smallest_gap(&approach.field).0 < body.size;
                let resolved = PERIOD_PART / frequency;
                if near { resolved } else { approach.time(step).max(resolved) }
            } else {
                approach.time(step)
            });
        }
    }
    // Of pairs whose planes were not found nothing is known: the next step is likely to stop the run.
    let is_whole = gaps.is_some_and(PairGaps::is_whole);
    for (pair, slab) in gaps.into_iter().flat_map(PairGaps::iter) {
        let seen = match pair.parties {
            [Party::Body(body), Party::SolidSupport(support)] => {
                let support = &model.solid_supports[support];
                let frequency = support.motion.highest_frequency();
                if frequency > 0.0 && slab.gap < model.bodies[body].size {
                    step = step.min(PERIOD_PART / frequency);
                }
                let seen = SeenFromSupport::of(support, time, &ends[body]);
                step = step.min(seen.0.longest);
                Some(seen)
            }
            _ => None,
        };
        let image;
        let both = match (&seen, pair.bodies()) {
            (Some((SeenFromSupport { body, .. }, support)), _) => [body, support],
            (None, Some([one, other])) => {
                image = (pair.cell != HERE).then(|| ends[other].shifted_by(&model.lattice.place(pair.cell)));
                [&ends[one], image.as_ref().unwrap_or(&ends[other])]
            }
            (None, None) => continue,
        };
        let bend = seen.map_or(0.0, |(seen, _)| seen.bend);
        match (slab.gap < f64::INFINITY, pair.form.range) {
            // All pairs with supports are listed.
            (false, Some(range)) if is_whole || seen.is_some() => {
                let approach = Approach::of(both[0], both[1]).bent_more(bend);
                step = step.min(before_meeting(&approach, (range, pair.form.radii()), step));
            }
            (false, Some(_)) => {}
            _ => {
                let approach = PairApproach::of(model, pair, (both, bend), radii, &slab.normal);
                step = step.min(approach.time(usual, step));
                step = step.min(until_nearest(model, pair, both, slab.gap, step));
            }
        }
    }
    if !is_whole {
        // Who may meet within a usual step is soon found; only where nobody does, all time to go is looked at.
        let soon = if usual > 0.0 { step.min(AHEAD * usual) } else { step };
        let first = before_any_meeting(model, ends, soon, step);
        let is_all = first <= soon || soon == step;
        step = step.min(if is_all { first } else { before_any_meeting(model, ends, step, step) });
    }
    step
}

/// The longest step [s] after which any two bodies that are out of reach, and may come within it in a time [s], may be
/// at another distance within it, at most `longest`: of all pairs, since which of them are listed must leave no trace.
fn before_any_meeting(model: &Model, ends: &[StepEnd], within: f64, longest: f64) -> f64 {
    debug_assert!(model.images().is_none(), "the pairs of a lattice are all listed");
    let mut step = longest;
    for BodyPair { rule, bodies } in may_meet(model, ends, within) {
        let solids = bodies.map(|body| &*model.bodies[body].solid);
        for parts in Solid::parts_of(solids) {
            let Some(range) = model.rules().all()[rule].range_between(solids, parts) else { continue };
            let radii = [0, 1].map(|end| solids[end].part_radius(parts[end]));
            let approach = Approach::of(&ends[bodies[0]], &ends[bodies[1]]);
            step = step.min(before_meeting(&approach, (range, radii), step));
        }
    }
    step
}

/// The longest step [s] after which two bodies of these radii that are out of a reach may be at another distance within
/// it, at most `longest`.
fn before_meeting(approach: &Approach, (range, radii): (f64, [f64; 2]), longest: f64) -> f64 {
    let within = half_cutoff(range, radii);
    if approach.distance(0.0) <= cutoff(range, radii) {
        return longest;
    }
    let nearest = approach.nearest(longest);
    let left = |time: f64| approach.distance(time) - within;
    if left(nearest) <= 0.0 {
        return first_root(nearest, left);
    }
    // The acceleration alone may bring them nearer still.
    approach.bent(approach.straight(nearest) - within).min(longest)
}

/// The first time after this one at which a couple, a drive or the flow has a kink [s].
pub(crate) fn next_kink(model: &Model, time: f64) -> Option<f64> {
    let couples = model.bodies.iter().filter_map(|body| body.affine()?.couple.as_ref()?.next_kink(time));
    couples.chain(model.signals().filter_map(|signal| signal.next_kink(time))).min_by(f64::total_cmp)
}
