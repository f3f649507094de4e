//! Events of a run: apex, closest approach, lift-off.
//!
//! | event            | function that changes sign                                | sense |
//! |------------------|-----------------------------------------------------------|-------|
//! | apex             | ṗ₀·(−g/|g|), upward speed of the centre of mass           | + → − |
//! | closest approach | rate of the smallest gap, n·(ṗ(X_c) − support's velocity) | − → + |
//! | lift-off         | |contact force| − 1 % of the weight (or of m v²/size)      | + → − |
//!
//! An event is found by a change of sign between the quarters of a step, or finer parts where a body turns far, and
//! located on the dense output; a lift-off between its ends, and within where a body that nothing else pulls at is
//! pushed at both. Speeds below 1e-6 of the body's speed scale are taken for rest: a body that has settled gives no
//! events, and one that passes through rest keeps the sign that it had before. Two events of one kind within such a
//! part of a step cancel and go unseen; so does a touch within one step, which the error control resolves into several
//! steps unless its force does not matter. A body without inertia is carried, not thrown: it has no events. A pinned
//! body has no apex: its centre goes round the pin.

use gyration::dynamics::nearest;
use gyration::instant::PairGaps;
use gyration::model::Model;
use gyration::state::BodyMotion;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

/// The kinds of event, by code.
pub const EVENT_KINDS: [&str; 3] = ["apex", "closest_approach", "lift_off"];

/// Speeds below this fraction of the speed scale are rest.
const REST: f64 = 1e-6;

/// The contact force below which a body has left its supports, as a fraction of its weight.
const LEFT: f64 = 0.01;

/// Something that happened to a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// When [s].
    pub time: f64,
    /// Index into [`EVENT_KINDS`].
    pub kind: usize,
    /// Index of the body.
    pub body: usize,
}

impl Event {
    /// The order in which events are handed on: of time, body and kind.
    pub(crate) fn in_order(&self, other: &Self) -> Ordering {
        self.time.total_cmp(&other.time).then((self.body, self.kind).cmp(&(other.body, other.kind)))
    }
}

/// An event that is not handed on yet, with what a run keeps of it besides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundEvent {
    /// What happened.
    pub event: Event,
    /// Of a closest approach the gap to what the body has a contact with [m]; infinite of another event.
    pub gap: f64,
}

/// The three functions of one body at one instant, each scaled so that |f| < 1 is rest or nothing.
pub type Signals = [f64; 3];

/// The place of the apex among the kinds.
pub const APEX: usize = 0;
/// The place of the closest approach: the one that has a gap.
pub const CLOSEST_APPROACH: usize = 1;
/// The place of the lift-off: the one that needs a force.
pub const LIFT_OFF: usize = 2;

/// Whether a signal stands out from rest.
pub fn is_significant(signal: f64) -> bool {
    signal.abs() > 1.0
}

/// Whether the signal of this kind passed its event between two significant values.
pub fn happened(kind: usize, before: f64, after: f64) -> bool {
    before * after < 0.0 && rises(kind) == (after > 0.0)
}

/// Whether the signal of this kind rises through zero at its event.
pub fn rises(kind: usize) -> bool {
    kind == CLOSEST_APPROACH
}

/// The upward speed of the centre; NaN without gravity and for a pinned body.
pub fn apex(model: &Model, body: usize, motion: &BodyMotion, speed: f64) -> f64 {
    let gravity = model.gravity.norm();
    let body = &model.bodies[body];
    if gravity == 0.0 || body.pin.is_some() || !body.has_inertia() {
        return f64::NAN;
    }
    -motion.velocity.velocity.dot(&model.gravity) / (gravity * speed * REST)
}

/// The rate of the smallest gap to supports and to bodies that it acts on, given those to other bodies, where they are
/// known; NaN without surface, or with nothing to come near to.
pub fn approach(
    model: &Model,
    time: f64,
    body: usize,
    (motion, gaps): (&BodyMotion, Option<&PairGaps>),
    speed: f64,
) -> f64 {
    if !model.bodies[body].has_inertia() {
        return f64::NAN;
    }
    let support = nearest(model, time, body, motion).map(|nearest| (nearest.gap, nearest.speed));
    let bodies = gaps.into_iter().flat_map(|gaps| gaps.acting_on(model, body)).map(|slab| (slab.gap, slab.rate));
    let near = support.into_iter().chain(bodies).filter(|(gap, _)| *gap < f64::INFINITY);
    near.min_by(|one, other| one.0.total_cmp(&other.0)).map_or(f64::NAN, |(_, rate)| rate / (speed * REST))
}

/// The size of the contact force [N]; NaN without contacts.
pub fn lift_off(model: &Model, body: usize, force: f64, speed: f64) -> f64 {
    let this = &model.bodies[body];
    if !model.has_contact(body) || !this.has_inertia() {
        return f64::NAN;
    }
    // Any crossing counts: the force has no rest level to be filtered against.
    (force / parting_force(model, body, speed) - 1.0) / f64::EPSILON
}

/// The contact force below which a body has left what it touched, given its speed scale [N].
pub fn parting_force(model: &Model, body: usize, speed: f64) -> f64 {
    let (this, gravity) = (&model.bodies[body], model.gravity.norm());
    LEFT * this.solid.mass.mass * if gravity > 0.0 { gravity } else { speed * speed / this.size }
}
