//! `[[contact]]`: the laws by which bodies and supports touch, per unit area, powers of the gap d.

use super::Behaviour;
use crate::quantity::{Length, NonNegative, Positive, Pressure, SurfaceDamping, WORDS};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// The laws between a support and a body, or all bodies; or between any two of many.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Contact {
    /// Name of the support; or `between`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support: Option<String>,
    /// Name of the body; every body with a surface if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// Names of bodies, groups or supports: every pair of two different ones, each pair once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between: Option<[String; 2]>,
    /// The distance at which a pair of bodies begins to feel each other, smoothly (m), or "auto": 25 contact gaps of
    /// each pair; without it they always do.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reach: Option<Reach>,
    /// What the contact does, from which laws follow that are not written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<Behaviour>,
    /// The area that tractions are per; it makes no difference to a rigid body.
    #[serde(default)]
    pub measure: Measure,
    /// Repulsion α (d/d₀)^−ν along the normal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub repulsion: Option<Repulsion>,
    /// Damping −β (d/d₀)^−ν of the normal velocity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<Damping>,
    /// Friction −β (d/d₀)^−ν of the tangential velocity, which may have Coulomb's bound.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
    /// Adhesion −β ((d/d₀)^−νa − (d/d₀)^−νr) along the normal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adhesion: Option<Adhesion>,
}

/// Where a pair of bodies begins to feel each other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Reach {
    /// Where the gaps of the pair say.
    Auto(Auto),
    /// At a distance.
    Length(Positive<Length>),
}

/// The word for what the program finds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Auto {
    /// `"auto"`.
    Auto,
}

impl JsonSchema for Reach {
    fn schema_name() -> Cow<'static, str> {
        "Reach".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = Length::json_schema(generator);
        schema.insert("exclusiveMinimum".to_owned(), 0.into());
        schema.insert(WORDS.to_owned(), vec!["auto"].into());
        schema
    }
}

/// The area that tractions are per.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Per deformed area.
    #[default]
    DeformedArea,
    /// Per reference area; derives from a potential.
    ReferenceArea,
    /// Per deformed area, with the tangential tractions that make it derive from a potential.
    DeformedAreaPotential,
}

/// Repulsion α (d/d₀)^−ν.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Repulsion {
    /// Strength α (Pa).
    pub alpha: NonNegative<Pressure>,
    /// Exponent ν > 0.
    pub nu: Positive<f64>,
    /// Reference gap d₀ (m).
    #[serde(default = "one_metre")]
    pub d0: Positive<Length>,
}

/// Damping β (d/d₀)^−ν, on both sides or hardly on what recedes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Damping {
    /// Strength β (Pa s/m).
    pub beta: NonNegative<SurfaceDamping>,
    /// Exponent ν > 0.
    pub nu: Positive<f64>,
    /// Reference gap d₀ (m).
    #[serde(default = "one_metre")]
    pub d0: Positive<Length>,
    /// Whether what recedes is held back by the speed α/(200 β) at most.
    #[serde(default, skip_serializing_if = "is_false")]
    pub one_sided: bool,
}

/// Friction β (d/d₀)^−ν, all of which a bound keeps below μ times the force of the repulsion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Friction {
    /// Strength β (Pa s/m).
    pub beta: NonNegative<SurfaceDamping>,
    /// Exponent ν > 0.
    pub nu: Positive<f64>,
    /// Reference gap d₀ (m).
    #[serde(default = "one_metre")]
    pub d0: Positive<Length>,
    /// Coulomb's bound μ; without it friction is viscous at any speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mu: Option<NonNegative<f64>>,
}

/// Adhesion −β ((d/d₀)^−νa − (d/d₀)^−νr): attracts beyond d₀, repels within.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Adhesion {
    /// Strength β (Pa).
    pub beta: NonNegative<Pressure>,
    /// Exponent of the attraction, νa > 0.
    pub nu_attractive: Positive<f64>,
    /// Exponent of the repulsion, νr > νa.
    pub nu_repulsive: Positive<f64>,
    /// Reference gap d₀ (m), at which the law vanishes.
    #[serde(default = "one_metre")]
    pub d0: Positive<Length>,
}

/// What is left out where it is not asked for.
fn is_false(flag: &bool) -> bool {
    !flag
}

/// With d₀ = 1 m the strength is the traction at a gap of a metre.
fn one_metre() -> Positive<Length> {
    Positive(Length(1.0))
}
