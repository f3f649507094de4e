//! Random contact laws in proportion to a body: everything is drawn without dimension and scaled.
//!
//! With weight W (or m V²/size without gravity), area A ≈ size², rest gap δ and speed V,
//!
//!   repulsion  α A (δ/d₀)^−ν = W,      damping  β V = x α at the gap δ,      adhesion  pull-off ≈ a part of W

use super::stream::Stream;
use serde_json::{Map, Value, json};

/// The scales of a body.
#[derive(Clone, Copy)]
pub struct Scales {
    /// Radius [m].
    pub size: f64,
    /// Speed [m/s].
    pub speed: f64,
    /// Weight, or what stands for it [N].
    pub weight: f64,
    /// Gap at which repulsion carries the weight of a flat face [m].
    pub rest_gap: f64,
}

/// A contact with this support; some laws are absent.
pub fn contact(stream: &mut Stream, support: &str, scales: &Scales) -> Value {
    let pressure = scales.weight / (scales.size * scales.size);
    let mut contact = Map::from_iter([("support".to_owned(), json!(support))]);
    let repels = stream.chance(0.9);
    if repels {
        let (nu, d0) = (exponent(stream), reference(stream, scales));
        let alpha = pressure * (scales.rest_gap / d0).powf(nu);
        contact.insert("repulsion".into(), json!({ "alpha": alpha, "nu": nu, "d0": d0 }));
    }
    for (name, probability) in [("damping", 0.6), ("friction", 0.5)] {
        if stream.chance(probability) {
            let (nu, d0) = (exponent(stream), reference(stream, scales));
            // βV/α of row 15: from hardly any loss to a body that sticks in the field.
            let number = stream.decade(-2.0, 1.0);
            let beta = number * pressure / scales.speed * (scales.rest_gap / d0).powf(nu);
            contact.insert(name.into(), json!({ "beta": beta, "nu": nu, "d0": d0 }));
        }
    }
    if !repels || stream.chance(0.2) {
        let attractive = stream.between(1.0, 8.0);
        let repulsive = attractive + stream.between(0.5, 4.0);
        let (beta, d0) = (pressure * stream.decade(-2.0, 1.0), scales.rest_gap * stream.decade(-0.5, 0.5));
        let law = json!({ "beta": beta, "nu_attractive": attractive, "nu_repulsive": repulsive, "d0": d0 });
        contact.insert("adhesion".into(), law);
    }
    Value::Object(contact)
}

/// An exponent from 1 to 12, whole every other time.
fn exponent(stream: &mut Stream) -> f64 {
    if stream.chance(0.5) { 1.0 + stream.index(12) as f64 } else { stream.between(1.0, 12.0) }
}

/// The reference gap: a metre as in the slides, or one near the gaps in the scene.
fn reference(stream: &mut Stream, scales: &Scales) -> f64 {
    if stream.chance(0.3) { 1.0 } else { scales.rest_gap * stream.decade(-1.0, 1.0) }
}
