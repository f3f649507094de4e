//! `[fluid]`: the viscous fluid around the bodies, and what a body in it says.

use super::{Rows, Signal};
use crate::quantity::{Density, GradientRate, NonNegative, Positive, Velocity, Viscosity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A viscous fluid that fills space; bodies with an `inclusion` feel it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fluid {
    /// Dynamic viscosity (Pa s).
    pub viscosity: Positive<Viscosity>,
    /// Density (kg/m³); 0: no buoyancy, no inertia of the fluid.
    #[serde(default)]
    pub density: NonNegative<Density>,
    /// Velocity of the undisturbed flow at the origin (m/s): three numbers, or in time.
    #[serde(default)]
    pub velocity: Flow<[Velocity; 3]>,
    /// Velocity gradient of the undisturbed flow (1/s), of trace zero: rows, or in time.
    #[serde(default)]
    pub velocity_gradient: Flow<Rows<GradientRate>>,
}

/// A value of the flow, steady or in time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "FlowOf{V}")]
#[serde(untagged)]
pub enum Flow<V> {
    /// The same at all times.
    Steady(V),
    /// In time.
    Changing(Signal<V>),
}

impl<V: Default> Default for Flow<V> {
    fn default() -> Self {
        Self::Steady(V::default())
    }
}

/// What makes a body feel the fluid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Inclusion {
    /// Whether the body has inertia; without, it moves at the velocities that the balance of forces gives.
    #[serde(default = "yes")]
    pub inertia: bool,
    /// Whether the fluid remembers the motion of a sphere, rigid or affine: added mass and history force. Needs a fluid
    /// density.
    #[serde(default)]
    pub history: bool,
    /// Whether the body feels others that say so through the fluid, and they feel it. Of rigid spheres.
    #[serde(default, skip_serializing_if = "is_false")]
    pub neighbours: bool,
    /// Whether the body feels the planes of the scene, which stand still, through a fluid at rest. Of rigid spheres.
    #[serde(default, skip_serializing_if = "is_false")]
    pub walls: bool,
    /// About how many triangles the surface is divided into, if it is that of no ellipsoid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 80, max = 10000))]
    pub triangles: Option<f64>,
    /// Of such a body, if it deforms: the largest relative error of its resistance between the forms for which it is
    /// computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// The distance of those forms in the logarithm of the stretch; found from the tolerance unless it is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacing: Option<f64>,
    /// The error of the history force that its sum of exponentials may have, relative to the force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1e-10, max = 0.1))]
    pub history_error: Option<f64>,
}

fn yes() -> bool {
    true
}

fn is_false(flag: &bool) -> bool {
    !flag
}
