//! `[[body]]`: what moves.

use super::{
    Affine, Contractile, Copies, Entry, Inclusion, Keep, LinearFriction, Motion, OneOrMany, Orientation, Shape,
};
use crate::quantity::{
    AngularVelocity, AnyQuantity, Density, EulerMoment, GradientRate, Length, Mass, NonNegative, Positive,
    SpringDamping, Stiffness, Velocity,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A body and its initial state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Its name, `[A-Za-z0-9_-]+`; names its columns in a recording.
    pub name: String,
    /// Words by which contacts name many bodies; its own name is one of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub group: Option<OneOrMany<String>>,
    /// Many equal bodies in its place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub copies: Option<Box<Copies>>,
    /// Its reference shape; may be absent with `mass_properties`, the body then has no surface.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<Shape>,
    /// Density (kg/m³); or `mass`, or `mass_properties`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub density: Option<Positive<Density>>,
    /// Mass (kg), spread evenly over the shape.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass: Option<Positive<Mass>>,
    /// Mass, centre of mass and Euler tensor, whatever the shape.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_properties: Option<MassProperties>,
    /// It moves as a rigid body, as it does if no kind is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rigid: Option<Rigid>,
    // What few bodies have stands apart: ten thousand rigid ones are small.
    /// It deforms homogeneously.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub affine: Option<Box<Affine>>,
    /// It deforms homogeneously and contracts by itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contractile: Option<Box<Contractile>>,
    /// It is immersed in the fluid; any other body ignores it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inclusion: Option<Box<Inclusion>>,
    /// Initial position of the centre of mass (m).
    #[serde(default)]
    pub position: [Length; 3],
    /// Initial orientation; of a deformable body, instead of its gradient.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orientation: Option<Orientation>,
    /// Initial velocity of the centre of mass (m/s).
    #[serde(default)]
    pub velocity: [Velocity; 3],
    /// Initial angular velocity in spatial axes (rad/s); of a deformable body, instead of its gradient_rate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angular_velocity: Option<[AngularVelocity; 3]>,
    /// Initial placement gradient P of a deformable body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gradient: Option<[[f64; 3]; 3]>,
    /// Initial rate of the placement gradient of a deformable body (1/s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gradient_rate: Option<[[GradientRate; 3]; 3]>,
    /// A point of the body, relative to the centre of mass in the body's axes, that stays where it starts (m).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pin: Option<[Length; 3]>,
    /// What its motion is kept to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub keep: Option<Keep>,
    /// Springs between points of the body and points of space.
    #[serde(default)]
    pub spring: Vec<Spring>,
    /// Its own potential V (J), an expression of x, y, z (m, centre of mass), P_xx … P_zz and t (s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub potential: Option<Box<str>>,
    /// Its own force per volume b (N/m³; of points per mass, N/kg), three expressions of x, y, z (m, a point of space)
    /// and t (s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body_force: Option<Box<[Entry; 3]>>,
    /// Forces on material points.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub force: Vec<PointForce>,
    /// Friction linear in the velocity and the velocity gradient, of a body of any kind.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub linear_friction: Option<Box<LinearFriction>>,
    /// Numbers with names for the expressions of the body, before those of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub constants: Option<Box<BTreeMap<String, AnyQuantity>>>,
}

impl Body {
    /// What a body that deforms has beside a contraction, and the key of the table where it stands.
    pub(crate) fn deformable(&self) -> Option<(&'static str, &Affine)> {
        let contractile = || self.contractile.as_ref().map(|it| ("contractile", &it.affine));
        self.affine.as_deref().map(|affine| ("affine", affine)).or_else(contractile)
    }
}

/// A rigid body has no parameters of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rigid {}

/// Mass properties given outright.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MassProperties {
    /// Mass (kg).
    pub mass: Positive<Mass>,
    /// Centre of mass in the shape's frame (m).
    #[serde(default)]
    pub center: [Length; 3],
    /// Euler tensor ∫ρ X⊗X dV about the centre of mass (kg m²); the inertia matrix is tr(J) I − J.
    pub euler_tensor: [[EulerMoment; 3]; 3],
}

/// A force on a material point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointForce {
    /// Point of the body, relative to the centre of mass in the body's axes (m).
    #[serde(default)]
    pub point: [Length; 3],
    /// F in spatial axes (N), three expressions of x, y, z (m, where the point is) and t (s).
    pub value: [Entry; 3],
}

/// A spring and dashpot between a point of the body and a point of space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Spring {
    /// Point of the body, relative to the centre of mass in the body's axes (m).
    #[serde(default)]
    pub point: [Length; 3],
    /// Point of space (m), before any motion of it.
    pub anchor: [Length; 3],
    /// How the anchor moves, or a list of motions that add up; fixed if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub anchor_motion: Option<OneOrMany<Motion>>,
    /// Stiffness (N/m).
    pub stiffness: NonNegative<Stiffness>,
    /// Length without force (m).
    #[serde(default)]
    pub rest_length: NonNegative<Length>,
    /// Damping along the spring (N s/m).
    #[serde(default)]
    pub damping: NonNegative<SpringDamping>,
}
