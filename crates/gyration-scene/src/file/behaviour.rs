//! `[[contact]] from`: what is seen of a contact, from which its laws follow.

use crate::quantity::{Angle, Length, NonNegative, Positive, Pressure, Velocity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a contact does, instead of the strengths and exponents of its laws.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Behaviour {
    /// Gap (m) at which the body that presses hardest lies on a level plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest_gap: Option<Positive<Length>>,
    /// Exponent ν of the laws; 6 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nu: Option<Positive<f64>>,
    /// A layer that is as stiff as the repulsion at the gap of rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub layer: Option<Layer>,
    /// Speed after an impact over that before it, above 0 and at most 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<Positive<f64>>,
    /// Speed of approach (m/s) that has this restitution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_speed: Option<Positive<Velocity>>,
    /// Slope θ (rad) at which a block begins to slide: Coulomb's bound is tan θ.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction_angle: Option<NonNegative<Angle>>,
    /// Speed (m/s) below which friction creeps and above which it slides: the bound over the strength of friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sliding_speed: Option<Positive<Velocity>>,
}

/// ν where nothing says it: it stops every shape.
pub(crate) const EXPONENT: f64 = 6.0;

impl Behaviour {
    /// The same with the exponent that it has where none is written.
    pub(crate) fn with_exponent(self) -> Self {
        let is_free = self.rest_gap.is_some() != self.layer.is_some();
        Self { nu: self.nu.or(is_free.then_some(Positive(EXPONENT))), ..self }
    }
}

/// A thin elastic layer between wide faces.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Layer {
    /// Young's modulus E (Pa).
    pub youngs_modulus: Positive<Pressure>,
    /// Poisson's ratio ν, above −1 and below ½.
    pub poissons_ratio: f64,
    /// Thickness h (m).
    pub thickness: Positive<Length>,
}
