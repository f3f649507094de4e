//! What acts on a body from outside all bodies, and what joints do between two.
//!
//!   (f | M) = m g + Σ of planes, supports with a shape, anchors, joints to space, fluid, what a body has of its own
//!
//! M is about the centre of mass. With the exchanges between bodies and the joints between bodies it is all that acts,
//! pins and guides aside. Source: `docs/fields.md`.

use super::Scratch;
use super::history_reaction::of_history;
use super::loads::Acting;
use crate::acting::Load;
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, Instant};
use crate::joint::JointEnd;
use crate::load::Loads;
use crate::party::Party;

/// What acts on a body from outside all bodies, weight included.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub(crate) fn outside_loads(at: &BodyAt, scratch: &mut Scratch) -> Result<Loads, Inadmissible> {
    let mut outside = Acting::default();
    at.try_each_load(|load| {
        let other = match load {
            Load::Pair(pair) => pair.other(),
            Load::Spring(end) => end.other(),
            Load::Bond(end) => end.other(),
            Load::Joint(end) => end.other(),
            Load::Contact(_)
            | Load::Couple(_)
            | Load::Applied(_)
            | Load::Resistance(_)
            | Load::Potential(_)
            | Load::BodyForce(_)
            | Load::PointForce(_)
            | Load::OwnFriction(_)
            | Load::MassFriction(_)
            | Load::SelfGravity(_)
            | Load::Fluid(..)
            | Load::Walls(_)
            | Load::Neighbours(_) => Party::Space,
        };
        if other.body().is_none() { outside.add(&load, at, scratch) } else { Ok(()) }
    })?;
    let mut loads = outside.total;
    loads += of_history(at, scratch)?;
    loads.force += at.body.solid.mass.mass * at.model.gravity;
    Ok(loads)
}

/// The joints between two bodies: who they are, and (f | M) on each about its centre of mass.
pub fn joint_exchanges(instant: &Instant) -> Vec<([usize; 2], [Loads; 2])> {
    let mut found = Vec::new();
    for index in 0..instant.model().bodies.len() {
        let at = instant.at(index);
        for end in instant.model().joints_of(index).filter(JointEnd::counts) {
            let Some(other) = end.other().body() else { continue };
            let loads = at.joint(&end);
            found.push(([index, other], [loads.on(0), loads.on(1)]));
        }
    }
    found
}
