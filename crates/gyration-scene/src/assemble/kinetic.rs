//! `kinetic`: another kinetic energy of a body that deforms, and what cannot go with it.
//!
//! A volume that is kept, a pin, a guide and joints take the mass of a body for constant; so do bands of a lattice.

use super::context::SceneContext;
use crate::check::{Placed, Reporter};
use crate::file::{self, Body};
use crate::key::Key;
use gyration::affine::Kinetic;

/// The part of a number within which a sum of numbers that are written with ten digits is zero.
const ROUNDING: f64 = 1e-9;

/// The kinetic energy of a body that deforms, none if it is ½ tr(Ṗ J Ṗᵀ); notes what it cannot be. Outside none where
/// something is wrong.
pub(super) fn kinetic(
    placed: &Placed<Body>,
    is_incompressible: bool,
    context: &SceneContext,
    reporter: &mut Reporter<'_>,
) -> Option<Option<Kinetic>> {
    let Placed { key, value, .. } = placed;
    let Some((kind, affine)) = value.deformable() else { return Some(None) };
    let Some(written) = affine.kinetic else { return Some(None) };
    let key = key.key(kind).key("kinetic");
    let has_inertia = value.inclusion.as_ref().is_none_or(|inclusion| inclusion.inertia);
    let has_history = value.inclusion.as_ref().is_some_and(|inclusion| inclusion.history);
    let faults = [
        (value.contractile.is_some(), "a body that drives itself", "make the body `affine`"),
        (is_incompressible, "a volume that is kept", "give the material a `bulk` modulus, or leave `kinetic` out"),
        (value.pin.is_some(), "a pin", "leave out one of `pin` and `kinetic`"),
        (value.keep.is_some(), "a guide", "leave out one of `keep` and `kinetic`"),
        (!has_inertia, "a body without inertia", "write `inertia = true`, or leave `kinetic` out"),
        (has_history, "a history of the flow", "leave out one of `history` and `kinetic`"),
        (context.has_lattice, "a lattice", "leave out one of `lattice` and `kinetic`"),
    ];
    let mut fits = true;
    for (_, what, help) in faults.into_iter().filter(|(applies, ..)| *applies) {
        reporter.note(&key, format!("{what} asks for the kinetic energy ½ tr(Ṗ J Ṗᵀ)"), help);
        fits = false;
    }
    let kinetic = match written {
        file::Kinetic::Comoving => Some(Kinetic::Comoving),
        file::Kinetic::Invariant(file::InvariantKinetic { square, trace }) => {
            invariant([square.0, trace.0], &key.key("invariant"), reporter)
        }
    };
    kinetic.filter(|_| fits).map(Some)
}

/// The energy ½ (A tr W² + B (tr W)²); notes one without which some velocities have no momentum.
fn invariant([square, trace]: [f64; 2], key: &Key, reporter: &mut Reporter<'_>) -> Option<Kinetic> {
    let whole = square + 3.0 * trace;
    if square == 0.0 {
        let message = "with A = 0 a velocity that keeps the volume has no momentum";
        reporter.note(&key.key("A"), message, "write another number");
    } else if whole.abs() <= ROUNDING * square.abs() {
        let message = "with A + 3 B = 0 a change of volume has no momentum";
        reporter.note(&key.key("B"), message, "write another number");
    } else {
        return Some(Kinetic::Invariant { square, trace });
    }
    None
}
