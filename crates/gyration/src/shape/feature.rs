//! The features of a surface by which it may touch a plane, and what a power law does there.
//!
//! A repulsion α (d/d₀)^−ν keeps a body from touching iff its potential diverges at contact. Around a point of contact
//! the area nearer than d grows as d^p with p = 0 (face), ½ (line of a cylinder), 1 (edge, smooth point), 3/2 (rim), 2
//! (vertex, apex), and ∫ d^(1−ν) d(d^p) diverges iff ν ≥ 1 + p. Source: `docs/theory-rigid.md`. Damping obeys the same
//! table in its exponent, adhesion in its repulsive one.

use std::fmt;

/// A feature of a surface, from the bluntest to the sharpest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Feature {
    /// A flat face that lies on the plane.
    FlatFace,
    /// A straight line of a cylinder or a cone that lies on the plane.
    Ruling,
    /// A point with two finite radii of curvature.
    SmoothPoint,
    /// A straight edge that lies on the plane.
    Edge,
    /// A curved edge that touches in one point.
    Rim,
    /// The tip of a cone.
    Apex,
    /// A corner of a polyhedron.
    Vertex,
}

impl Feature {
    /// The exponent ν from which the potential of a repulsion diverges when this feature touches a plane.
    pub fn critical_exponent(self) -> f64 {
        match self {
            Self::FlatFace => 1.0,
            Self::Ruling => 1.5,
            Self::SmoothPoint | Self::Edge => 2.0,
            Self::Rim => 2.5,
            Self::Apex | Self::Vertex => 3.0,
        }
    }

    /// The name of the feature in messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::FlatFace => "flat face",
            Self::Ruling => "ruling",
            Self::SmoothPoint => "smooth point",
            Self::Edge => "edge",
            Self::Rim => "rim",
            Self::Apex => "apex",
            Self::Vertex => "vertex",
        }
    }
}

impl fmt::Display for Feature {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}
