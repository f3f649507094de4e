//! Contractions that begin at a rate, and turn the body that has them.

use crate::format::vector;
use gyration::contractile::ContractionSource;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::{axial, turning};

/// The part of a spin beyond which it is one.
const ROUNDING: f64 = 1e-9;

/// What must be told of bodies that start with an angular momentum which comes of their contraction alone.
pub(super) fn notes(model: &Model, start: &State) -> Vec<String> {
    (0..model.bodies.len()).filter_map(|body| note(model, start, body)).collect()
}

fn note(model: &Model, start: &State, index: usize) -> Option<String> {
    let body = &model.bodies[index];
    let ContractionSource::Prescribed(signal) = &body.contraction()?.source else { return None };
    let motion = start.motion(model, index);
    let (p, rate) = (&motion.placement.gradient, &motion.velocity.gradient_rate);
    let contraction = signal.jet(start.time);
    // Whatever else is written of its motion is meant.
    let of_contraction = p * contraction.value.try_inverse()? * contraction.rate;
    let size = rate.norm();
    if body.pin.is_some() || size == 0.0 || (rate - of_contraction).norm() > ROUNDING * size {
        return None;
    }
    let inertia = body.solid.mass.euler_tensor;
    let momentum = -axial(&(p * inertia * rate.transpose()));
    let turn = turning(&(p * inertia * p.transpose())).try_inverse()? * momentum;
    (turn.norm() > ROUNDING * size).then(|| {
        format!(
            "\"{}\" starts with the angular momentum {} kg m²/s, since its contraction begins at a rate: with \
             {} rad/s added to its `angular_velocity` it starts with none",
            model.name(index),
            vector(&momentum.into()),
            vector(&(-turn).into()),
        )
    })
}
