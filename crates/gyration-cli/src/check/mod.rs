//! What can be said of a scene before it runs: mass, gaps, where bodies rest, how fast contact is, who may touch.
//!
//! Everything here is computed, nothing printed.

mod contraction;
mod kind;
mod laws;
mod mass;
mod modes;
mod rest;

use gyration::model::Model;
use gyration::state::State;
use serde::Serialize;

pub use kind::KindCheck;
pub use laws::LawCheck;
pub use mass::MassCheck;
pub use modes::{ModeCheck, RestState, ShapeCheck};
pub use rest::{Approach, Rest};

/// What can be said of a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SceneCheck {
    /// The bodies, in order.
    pub bodies: Vec<BodyCheck>,
}

/// What can be said of one body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BodyCheck {
    /// Its name.
    pub name: String,
    /// The largest side of its bounding box [m].
    pub size: f64,
    /// How it may deform, and what it is made of.
    pub kind: KindCheck,
    /// Mass properties.
    pub mass: MassCheck,
    /// Where a body that deforms rests, how much it is deformed there, and how it moves about that state.
    pub rest_state: Option<RestState>,
    /// Why a body that deforms has no rest state, in words.
    pub no_rest_state_because: Option<String>,
    /// What it has to do with each support; empty for mass points.
    pub supports: Vec<PairCheck>,
}

/// What can be said of a body and a support.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairCheck {
    /// Name of the support.
    pub support: String,
    /// Smallest distance at the start [m].
    pub initial_gap: f64,
    /// The part of the weight that presses on the support, −m g·n [N].
    pub weight: f64,
    /// The laws between the two; empty if they do not act on each other.
    pub laws: Vec<LawCheck>,
    /// Whether one of the laws forbids touching.
    pub forbids_touching: bool,
    /// Gaps at which the central laws carry the weight, ascending: with the orientation of the start, and with its P if the body
    /// deforms.
    pub rests: Vec<Rest>,
    /// Why no such gap is given, in words: something else holds the body too.
    pub no_rest_because: Option<&'static str>,
}

/// Looks at a scene in its first state.
pub fn check(model: &Model, start: &State) -> SceneCheck {
    SceneCheck { bodies: (0..model.bodies.len()).map(|index| check_body(model, start, index)).collect() }
}

fn check_body(model: &Model, start: &State, index: usize) -> BodyCheck {
    let body = &model.bodies[index];
    let pair = |support: usize| {
        let approach = Approach::new(model, start, index, support)?;
        let contacts = body.contacts.iter().filter(|contact| contact.support == support);
        let laws = contacts.flat_map(|contact| contact.laws());
        let laws: Vec<LawCheck> = laws.map(|law| LawCheck::of(law, &body.shape)).collect();
        Some(PairCheck {
            support: model.supports[support].name.clone(),
            initial_gap: approach.initial_gap,
            weight: approach.weight,
            forbids_touching: laws.iter().any(|law| law.forbids_touching == Some(true)),
            laws,
            rests: approach.rests(),
            no_rest_because: approach.no_rest_because,
        })
    };
    let (rest_state, no_rest_state_because) = match body.affine().map(|_| RestState::of(model, start, index)) {
        None => (None, None),
        Some(Ok(state)) => (Some(state), None),
        Some(Err(reason)) => (None, Some(reason)),
    };
    BodyCheck {
        name: body.name.clone(),
        size: body.size,
        kind: KindCheck::of(body),
        rest_state,
        no_rest_state_because,
        mass: MassCheck::of(&body.mass),
        supports: (0..model.supports.len()).filter_map(pair).collect(),
    }
}
