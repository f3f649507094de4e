//! `shape`: the reference shape of a body, in its own frame. Axes of revolution are along z.

use super::Orientation;
use crate::quantity::{Density, Length, Mass, Positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The reference shape of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// A box about its centre.
    Box(Box),
    /// A sphere.
    Sphere(Sphere),
    /// An ellipsoid.
    Ellipsoid(Ellipsoid),
    /// A cylinder about its centre.
    Cylinder(Cylinder),
    /// A cone, apex up.
    Cone(Cone),
    /// A cylinder between two half-spheres.
    Capsule(Capsule),
    /// A torus.
    Torus(Torus),
    /// The convex hull of points.
    Polyhedron(Polyhedron),
    /// A closed triangulated surface from a file.
    Mesh(Mesh),
    /// Several shapes in one body: volumes add, the whole surface of each part radiates.
    Union(Union),
    /// Material points without a surface.
    Points(Vec<PointMass>),
}

impl Shape {
    /// Whether it has densities or masses of its own, in any part.
    pub fn weighs(&self) -> bool {
        match self {
            Self::Points(_) => true,
            Self::Union(union) => union.parts.iter().any(Part::weighs),
            _ => false,
        }
    }
}

impl Part {
    /// Whether it has densities or masses of its own.
    pub fn weighs(&self) -> bool {
        self.density.is_some() || self.shape.weighs()
    }
}

/// A box.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Box {
    /// Lengths of its edges (m).
    pub size: [Positive<Length>; 3],
}

/// A sphere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    /// Radius (m).
    pub radius: Positive<Length>,
}

/// An ellipsoid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ellipsoid {
    /// Semi-axes along x, y, z (m).
    pub semi_axes: [Positive<Length>; 3],
}

/// A cylinder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// Radius (m).
    pub radius: Positive<Length>,
    /// Height (m).
    pub height: Positive<Length>,
}

/// A cone, apex up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cone {
    /// Radius of the base (m).
    pub radius: Positive<Length>,
    /// Height (m).
    pub height: Positive<Length>,
}

/// A capsule.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Capsule {
    /// Radius (m).
    pub radius: Positive<Length>,
    /// Height of the cylinder's part (m).
    pub height: Positive<Length>,
}

/// A torus.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Torus {
    /// Distance from the axis to the centre of the tube (m).
    pub major_radius: Positive<Length>,
    /// Radius of the tube (m), less than the major radius.
    pub minor_radius: Positive<Length>,
}

/// The convex hull of points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Polyhedron {
    /// The points (m); those inside of the hull make no difference.
    #[schemars(length(min = 4))]
    pub vertices: Vec<[Length; 3]>,
}

/// A closed triangulated surface, outward oriented.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// STL, OBJ or PLY; the path is relative to the scene.
    pub file: String,
    /// Metres per unit of the file.
    #[serde(default = "unscaled")]
    pub scale: Positive<f64>,
}

fn unscaled() -> Positive<f64> {
    Positive(1.0)
}

/// Several shapes in one body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Union {
    /// The parts.
    #[schemars(length(min = 1))]
    pub parts: Vec<Part>,
}

/// A part of a union.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Its shape.
    pub shape: Shape,
    /// Where its own origin lies in the union's frame (m).
    #[serde(default)]
    pub offset: [Length; 3],
    /// How it is turned in the union's frame.
    #[serde(default)]
    pub orientation: Orientation,
    /// Its density (kg/m³); the body's if absent. Under a given mass densities are relative weights.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub density: Option<Positive<Density>>,
}

/// A material point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointMass {
    /// Mass (kg).
    pub mass: Positive<Mass>,
    /// Position (m).
    pub at: [Length; 3],
}
