//! A set of material points: mass without volume and without a surface.
//!
//!   m = Σ m_k,   X₀ = Σ m_k X_k / m,   J = Σ m_k (X_k−X₀)⊗(X_k−X₀)

use super::error::{ShapeError, finite, positive};
use super::feature::Feature;
use super::outline::{Outline, extreme_points};
use super::triangulation::Triangulation;
use crate::mass::MassProperties;
use crate::surface::Surface;
use crate::tensor::{Mat3, Vec3};

/// Material points fixed to each other; no contact.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Points {
    /// The points, at least one.
    pub points: Vec<MassPoint>,
}

/// A material point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassPoint {
    /// m_k \[kg\].
    pub mass: f64,
    /// X_k, where it stands in the shape's frame \[m\].
    pub at: Vec3,
}

impl Points {
    /// Checks that there are points, their masses > 0 and their places finite.
    ///
    /// # Errors
    /// [`ShapeError::Empty`], or [`ShapeError::Member`] with the first point that is wrong.
    pub fn validate(&self) -> Result<(), ShapeError> {
        if self.points.is_empty() {
            return Err(ShapeError::Empty { shape: "set of points", parameter: "points" });
        }
        self.points.iter().enumerate().try_for_each(|(index, point)| {
            let checked = positive("point", "mass", point.mass).and(finite("point", "at", point.at.as_slice()));
            checked.map_err(|source| ShapeError::Member {
                shape: "set of points",
                member: "point",
                index,
                source: Box::new(source),
            })
        })
    }

    /// Mass properties, with every point's mass multiplied by `factor`.
    pub fn mass_properties(&self, factor: f64) -> MassProperties {
        let one = |point: &MassPoint| MassProperties {
            mass: point.mass,
            center: point.at,
            euler_tensor: Mat3::zeros(),
            volume: 0.0,
        };
        MassProperties::sum(self.points.iter().map(one)).scaled(factor)
    }

    /// The support function h(n) = max X_k·n \[m\].
    pub fn extent(&self, direction: &Vec3) -> f64 {
        self.points.iter().map(|point| point.at.dot(direction)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// None: points do not touch.
    pub fn surface(&self) -> Option<Surface> {
        None
    }

    /// None: points do not touch.
    pub fn sharpest_feature(&self) -> Option<Feature> {
        None
    }

    /// The points, without lines.
    pub fn outline(&self) -> Outline {
        Outline { points: self.points.iter().map(|point| point.at).collect(), polylines: Vec::new() }
    }

    /// None: points have no surface.
    pub fn triangulation(&self, _count: usize) -> Triangulation {
        Triangulation::default()
    }

    /// The points, thinned to the outermost if there are many.
    pub fn silhouette_points(&self) -> Vec<Vec3> {
        extreme_points(&self.outline().points)
    }
}
