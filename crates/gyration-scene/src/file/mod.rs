//! The types of the file: what can be written in a scene, section by section, with the defaults.
//!
//! The JSON Schema comes from them, and so does the check of a scene's structure. They are not the mechanics' types;
//! `build` makes those. Enumerations are externally tagged: `shape = { sphere = { radius = 0.1 } }`. Written back to
//! JSON, with every default in its place, they are the resolved form of a scene, which is again a scene.

mod affine;
mod behaviour;
mod body;
mod bond;
mod contact;
mod contractile;
mod copies;
mod fluid;
mod joint;
mod keep;
mod lattice;
mod material;
mod orientation;
mod record;
mod shape;
mod signal;
mod solver;
mod spring;
mod support;
mod time;
mod world;

pub use affine::{
    Affine, Couple, Entry, Frame, Gyroscopic, InternalFriction, InvariantKinetic, Kinetic, LinearFriction,
};
pub(crate) use behaviour::EXPONENT;
pub use behaviour::{Behaviour, Layer};
pub use body::{Body, MassProperties, PointForce, Rigid, Spring};
pub use bond::{Bond, BondDamping};
pub use contact::{Adhesion, Contact, Damping, Friction, Measure, Reach, Repulsion};
pub use contractile::{Contractile, Feedback, FeltMeasure, OneOrMany, Spin};
pub use copies::{Copies, CopyCount, CopyGrid, RandomCopies};
pub use fluid::{Flow, Fluid, Inclusion};
pub use joint::{DriveLaw, Joint, JointDrive, JointStop, JointWord, StopDamping, StopRepulsion};
pub use keep::Keep;
pub use lattice::{
    AbsorbingEnds, BranchNumber, CellCount, CellOffset, Lattice, LatticeWave, RandomWaves, Relaxed, Seed,
};
pub use material::{
    Fung, Hencky, Material, MooneyRivlin, NeoHookean, NeoHookeanLog, Ogden, Orthogonality, StVenantKirchhoff,
};
pub use orientation::{AxisAngle, Orientation};
pub use record::{Record, Recorded};
pub use shape::{
    Box, Capsule, Cone, Cylinder, Ellipsoid, Mesh, Part, PointMass, Polyhedron, Shape, Sphere, Torus, Union,
};
pub use signal::{Constant, Interpolation, Ramp, Rows, Signal, Table, Wave};
pub use solver::{Method, Solver};
pub use spring::SpringBetween;
pub use support::{Motion, Oscillation, Plane, Rotation, Support};
pub use time::{StopAtRest, Time};
pub use world::{SelfGravity, World};

use crate::quantity::AnyQuantity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A scene of Gyration: bodies that move by homogeneous deformations, and what they touch.
///
/// Plain numbers are in SI units; a string with a unit, "2 cm", "30 kPa", "15 deg", is accepted wherever a dimension is
/// known, and checked against it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// What the scene shows, in a line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Gravity.
    #[serde(default)]
    pub world: World,
    /// How long, and how often a sample is recorded.
    pub time: Time,
    /// Tolerances and method of the solver.
    #[serde(default)]
    pub solver: Solver,
    /// Further quantities that a recording shall hold; none if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub record: Option<Record>,
    /// The supports that bodies can touch.
    #[serde(default)]
    pub support: Vec<Support>,
    /// The laws by which bodies and supports touch.
    #[serde(default)]
    pub contact: Vec<Contact>,
    /// The bodies.
    #[schemars(length(min = 1))]
    pub body: Vec<Body>,
    /// Springs between points of two bodies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub spring: Vec<SpringBetween>,
    /// Bonds between points of two bodies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bond: Vec<Bond>,
    /// Joints between two bodies, or a body and space.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joint: Vec<Joint>,
    /// The lattice of whose cells each holds these bodies; none if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lattice: Option<Lattice>,
    /// A viscous fluid around the bodies; none if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fluid: Option<Fluid>,
    /// Numbers with names, for every expression of the scene.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub constants: BTreeMap<String, AnyQuantity>,
}
