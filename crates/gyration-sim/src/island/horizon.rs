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
//! leaves, is not held up. Two bodies that meet approach a plane between them, with the normal of their own; those that
//! are out of reach of each other come halfway into it. Steps are cut by this and never lengthened.

use crate::island::approach::{Approach, may_meet};
use crate::island::carried::SeenFromSupport;
use crate::island::step_end::StepEnd;
use gyration::Party;
use gyration::body::Solid;
use gyration::contact::RelativeMotion;
use gyration::instant::PairGaps;
use gyration::kinematics::Placement;
use gyration::load::Spring;
use gyration::model::Model;
use gyration::neighbours::{BodyPair, Pair};
use gyration::pair::{cutoff, half_cutoff};
use gyration::signal::Signal;
use gyration::support::{MotionPart, Support};
use gyration::surface::{GapField, Surface};
use gyration::tensor::Vec3;

/// The part of the time to contact that a step may take: what the bound leaves out is left to the error control.
const PART: f64 = 0.8;
/// The turn of a body over which its motion is taken for linear [rad].
const TURN: f64 = 1.0;
/// The part of an oscillating support's period that a step near it may take.
const PERIOD_PART: f64 = 0.125;
/// The part of a drive's fastest period that a step may take: no wave is jumped over.
const DRIVE_PART: f64 = 0.25;
/// So many usual steps are looked at first.
const AHEAD: f64 = 4.0;
/// The time to contact is found to this fraction of itself.
const PRECISION: f64 = 0.05;

/// The motion of a body towards a plane that stands still or moves with constant velocity.
struct PlaneApproach<'a> {
    surface: &'a Surface,
    field: GapField,
    /// c₀ and c.
    rate: GapField,
    /// a [m/s²].
    acceleration: f64,
    /// Radius about the centre of mass [m].
    radius: f64,
    /// How fast it may grow [m/s].
    growth: f64,
    /// |Ω|, or the rate |Ṗ|/|P| at which the body changes its form [1/s].
    spin: f64,
}

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
    for frequency in signals(model).map(Signal::highest_frequency).filter(|frequency| *frequency > 0.0) {
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
        let both = match (&seen, pair.bodies()) {
            (Some((SeenFromSupport { body, .. }, support)), _) => [body, support],
            (None, Some(bodies)) => bodies.map(|body| &ends[body]),
            (None, None) => continue,
        };
        let bend = seen.map_or(0.0, |(seen, _)| seen.bend);
        match (slab.gap < f64::INFINITY, pair.form.reach) {
            // All pairs with supports are listed.
            (false, Some(reach)) if is_whole || seen.is_some() => {
                let approach = Approach::of(both[0], both[1]).bent_more(bend);
                step = step.min(before_meeting(&approach, (reach, pair.form.radii()), step));
            }
            (false, Some(_)) => {}
            _ => step = step.min(BodyApproach::of(model, pair, (both, bend), radii, &slab.normal).time(step)),
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
    let mut step = longest;
    for BodyPair { rule, bodies } in may_meet(model, ends, within) {
        let solids = bodies.map(|body| &*model.bodies[body].solid);
        for parts in Solid::parts_of(solids) {
            let Some(reach) = model.rules().all()[rule].reach_between(solids, parts) else { continue };
            let radii = [0, 1].map(|end| solids[end].part_radius(parts[end]));
            let approach = Approach::of(&ends[bodies[0]], &ends[bodies[1]]);
            step = step.min(before_meeting(&approach, (reach, radii), step));
        }
    }
    step
}

/// The longest step [s] after which two bodies of these radii that are out of a reach may be at another distance within
/// it, at most `longest`.
fn before_meeting(approach: &Approach, (reach, radii): (f64, [f64; 2]), longest: f64) -> f64 {
    let within = half_cutoff(reach, radii);
    if approach.distance(0.0) <= cutoff(reach, radii) {
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

/// What drives bodies and joints, and the flow around them.
fn signals(model: &Model) -> impl Iterator<Item = &Signal> {
    let drives = model.bodies.iter().filter_map(|body| Some(body.contraction()?.signal()));
    let drives = drives.chain(model.joints().iter().filter_map(|joint| joint.motor.signal()));
    drives.chain(model.fluid.iter().flat_map(|fluid| fluid.signals()))
}

/// The first time after this one at which a couple, a drive or the flow has a kink [s].
pub(crate) fn next_kink(model: &Model, time: f64) -> Option<f64> {
    let couples = model.bodies.iter().filter_map(|body| body.affine()?.couple.as_ref()?.next_kink(time));
    couples.chain(signals(model).filter_map(|signal| signal.next_kink(time))).min_by(f64::total_cmp)
}

/// How far an oscillating support comes forward from its origin along its normal [m].
fn reach(support: &Support) -> f64 {
    let forward = |part: &MotionPart| match part {
        MotionPart::Oscillation { direction, amplitude, .. } => (amplitude * direction.dot(&support.normal)).abs(),
        MotionPart::Velocity(_) | MotionPart::Rotation { .. } => 0.0,
    };
    support.motion.parts().iter().map(forward).sum()
}

/// How far a support is displaced by its constant velocities [m], and these [m/s].
fn drift(support: &Support, time: f64) -> (Vec3, Vec3) {
    let velocity = |part: &MotionPart| match part {
        MotionPart::Velocity(velocity) => *velocity,
        MotionPart::Oscillation { .. } | MotionPart::Rotation { .. } => Vec3::zeros(),
    };
    let velocity: Vec3 = support.motion.parts().iter().map(velocity).sum();
    (velocity * time, velocity)
}

impl<'a> PlaneApproach<'a> {
    fn of(model: &Model, index: usize, time: f64, end: &StepEnd, surface: &'a Surface, radius: f64) -> Self {
        let (support, motion) = (&model.supports[index], &end.motion);
        let mut field = support.gap_field(&motion.placement, time);
        if support.motion.turns() {
            // As seen from the support.
            let normal = support.at(time).normal;
            return Self::along(
                &normal,
                (end, &end.acceleration),
                (surface, radius),
                (field, motion.velocity.velocity),
            );
        }
        let mut velocity = RelativeMotion::to(support, motion, time).velocity;
        if support.motion.oscillates() {
            let (way, speed) = drift(support, time);
            field.height = (motion.placement.position - support.origin - way).dot(&support.normal) - reach(support);
            velocity = motion.velocity.velocity - speed;
        }
        Self::along(&support.normal, (end, &end.acceleration), (surface, radius), (field, velocity))
    }

    /// Towards a plane with this normal, given the gaps, and velocity and acceleration of the centre relative to it.
    fn along(
        normal: &Vec3,
        (end, acceleration): (&StepEnd, &Vec3),
        (surface, radius): (&'a Surface, f64),
        (field, velocity): (GapField, Vec3),
    ) -> Self {
        let motion = &end.motion;
        let rate = GapField::new(normal.dot(&velocity), motion.velocity.gradient_rate.tr_mul(normal));
        let stretching = end.stretching.map_or(0.0, |stretching| stretching.tr_mul(normal).norm() * radius);
        let acceleration = (-acceleration.dot(normal)).max(0.0) + stretching;
        let gradient = &motion.placement.gradient;
        // No point is farther from the centre than |P| times its distance in the reference shape.
        let (radius, growth, spin) = match end.stretching {
            None => (radius, 0.0, motion.angular_velocity().norm()),
            Some(_) => {
                let (size, rate) = (gradient.norm(), motion.velocity.gradient_rate.norm());
                (radius * size, radius * rate, rate / size)
            }
        };
        Self { surface, field, rate, acceleration, radius, growth, spin }
    }

    /// The longest step [s] that this approach allows, at most `longest`.
    fn time(&self, longest: f64) -> f64 {
        let clear = PART * first_root(longest, |t| self.sphere_gap(t));
        if clear >= longest {
            return longest;
        }
        let straight = PART * first_root(longest / PART, |t| self.smallest_gap(t));
        clear.max(straight.min(TURN / self.spin)).min(longest)
    }

    /// A bound on the gap of the sphere around the body [m].
    fn sphere_gap(&self, t: f64) -> f64 {
        self.field.height + t * (self.rate.height - self.growth) - self.radius - 0.5 * self.acceleration * t * t
    }

    /// A bound on the gap of the body while it turns little [m].
    fn smallest_gap(&self, t: f64) -> f64 {
        let height = self.field.height + t * self.rate.height;
        let direction = self.field.direction + t * self.rate.direction;
        self.surface.smallest_gap(&GapField::new(height, direction)).0 - 0.5 * self.acceleration * t * t
    }
}

/// The motion of two bodies towards each other: each to a plane between them that stands still.
struct BodyApproach<'a> {
    halves: [PlaneApproach<'a>; 2],
    centers: Approach,
}

impl<'a> BodyApproach<'a> {
    /// The second may accelerate towards the first by `bend` besides [m/s²].
    fn of(model: &'a Model, pair: &Pair, (ends, bend): ([&StepEnd; 2], f64), radii: &[f64], normal: &Vec3) -> Self {
        // A sees all of the acceleration, as if B had none.
        let accelerations = [ends[0].acceleration - ends[1].acceleration, Vec3::zeros()];
        let mut halves = [0, 1].map(|side| {
            let (end, party) = (ends[side], pair.parties[side]);
            let normal = if side == 0 { *normal } else { -normal };
            let Placement { position, gradient } = &end.motion.placement;
            // The gaps of both count in sum: the plane may pass anywhere.
            let field = GapField::new(position.dot(&normal), gradient.tr_mul(&normal));
            let solid = model.solid_of(party).unwrap_or_else(|| unreachable!("a pair is between solids"));
            let radius = party.body().map_or_else(|| solid.radius().unwrap_or(0.0), |body| radii[body]);
            PlaneApproach::along(
                &normal,
                (end, &accelerations[side]),
                (solid.part(pair.parts[side]), radius),
                (field, end.motion.velocity.velocity),
            )
        });
        halves[0].acceleration += bend;
        Self { halves, centers: Approach::of(ends[0], ends[1]).bent_more(bend) }
    }

    /// The longest step [s] that this approach allows, at most `longest`.
    fn time(&self, longest: f64) -> f64 {
        let [one, other] = &self.halves;
        let clear = PART * self.clear(longest);
        if clear >= longest {
            return longest;
        }
        let straight = PART * first_root(longest / PART, |t| one.smallest_gap(t) + other.smallest_gap(t));
        clear.max(straight.min(TURN / one.spin.max(other.spin))).min(longest)
    }

    /// The time for which the spheres around the two stay apart [s], at most a part more than `longest`.
    fn clear(&self, longest: f64) -> f64 {
        let within = longest / PART;
        let apart = |t: f64| {
            let radii: f64 = self.halves.iter().map(|half| half.radius + t * half.growth).sum();
            self.centers.distance(t) - radii
        };
        let nearest = self.centers.nearest(within);
        if apart(nearest) <= 0.0 {
            return first_root(nearest, apart);
        }
        if apart(within) > 0.0 { within } else { nearest }
    }
}

/// A time just before the root in (0, longest] of a concave function; `longest` if there is none, 0 if it starts below.
fn first_root(longest: f64, function: impl Fn(f64) -> f64) -> f64 {
    let (mut left, mut right) = (0.0, longest);
    if function(0.0) <= 0.0 {
        return 0.0;
    }
    if function(longest) > 0.0 {
        return longest;
    }
    while right - left > PRECISION * right {
        let middle = 0.5 * (left + right);
        if function(middle) > 0.0 {
            left = middle
        } else {
            right = middle
        }
        if right < f64::MIN_POSITIVE {
            break;
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_root_is_approached_from_the_safe_side() {
        for root in [1e-6, 0.3, 0.9999] {
            let found = first_root(1.0, |t| root - t);
            assert!(found <= root && found >= root * (1.0 - 2.0 * PRECISION), "{found} for {root}");
        }
        assert_eq!(first_root(1.0, |t| 2.0 - t), 1.0);
        assert_eq!(first_root(1.0, |_| -1.0), 0.0);
    }
}
