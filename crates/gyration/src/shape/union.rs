//! Several shapes as one rigid whole, each with its own density.
//!
//! Part k stands at X = R_k Y + a_k, Y in its own frame. Volumes add, also where parts overlap, and each part's whole
//! surface radiates. Masses, centres and Euler tensors add by the parallel-axis rule.

use super::Shape;
use super::error::{ShapeError, finite, positive};
use super::feature::Feature;
use super::outline::{Outline, extreme_points};
use super::triangulation::Triangulation;
use crate::mass::MassProperties;
use crate::surface::Surface;
use crate::tensor::{Mat3, Vec3};

/// Largest |RᵀR − 1| of a rotation matrix given in decimals.
const ROTATION_TOLERANCE: f64 = 1e-9;

/// Shapes fixed to each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Union {
    /// The parts, at least one.
    pub parts: Vec<UnionPart>,
}

/// A shape within a union.
#[derive(Debug, Clone, PartialEq)]
pub struct UnionPart {
    /// The shape in its own frame.
    pub shape: Shape,
    /// a, where its frame's origin stands in the union's frame \[m\].
    pub offset: Vec3,
    /// R, which turns its frame's axes to where they point in the union's frame.
    pub rotation: Mat3,
    /// ρ \[kg/m³\]; for a shape that brings its own mass, a factor.
    pub density: f64,
}

impl Union {
    /// Checks every part: its shape, offset, rotation and density.
    ///
    /// # Errors
    /// [`ShapeError::Empty`], or [`ShapeError::Member`] with the first part that is wrong.
    pub fn validate(&self) -> Result<(), ShapeError> {
        if self.parts.is_empty() {
            return Err(ShapeError::Empty { shape: "union", parameter: "parts" });
        }
        self.parts.iter().enumerate().try_for_each(|(index, part)| {
            part.validate().map_err(|source| ShapeError::Member {
                shape: "union",
                member: "part",
                index,
                source: Box::new(source),
            })
        })
    }

    /// Mass properties, with every part's own density multiplied by `factor`.
    pub fn mass_properties(&self, factor: f64) -> MassProperties {
        MassProperties::sum(self.parts.iter().map(UnionPart::mass_properties)).scaled(factor)
    }

    /// The support function h(n) = max over the parts of a_k·n + h_k(R_kᵀn) \[m\].
    pub fn extent(&self, direction: &Vec3) -> f64 {
        self.parts.iter().map(|part| part.extent(direction)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The surfaces of all parts, also where one covers another; none if all are points.
    pub fn surface(&self) -> Option<Surface> {
        let of_part = |part: &UnionPart| Some(part.shape.surface()?.transformed(&part.rotation, &part.offset));
        let mut surfaces: Vec<Surface> = self.parts.iter().filter_map(of_part).collect();
        // In pairs: one after the other, the first of n parts would be copied n times.
        while surfaces.len() > 1 {
            let merged = |pair: &[Surface]| match pair {
                [one, other] => one.merged(other),
                _ => pair[0].clone(),
            };
            surfaces = surfaces.chunks(2).map(merged).collect();
        }
        surfaces.pop()
    }

    /// The sharpest feature of all parts.
    pub fn sharpest_feature(&self) -> Option<Feature> {
        self.parts.iter().filter_map(|part| part.shape.sharpest_feature()).max()
    }

    /// The outlines of all parts.
    pub fn outline(&self) -> Outline {
        let mut outline = Outline::default();
        for part in &self.parts {
            outline.add_transformed(&part.shape.outline(), &part.rotation, &part.offset);
        }
        outline
    }

    /// The surfaces of all parts, also where one covers another, in about `count` triangles each.
    pub fn triangulation(&self, count: usize) -> Triangulation {
        let mut all = Triangulation::default();
        for part in &self.parts {
            all.add_transformed(&part.shape.triangulation(count), &part.rotation, &part.offset);
        }
        all
    }

    /// Points of all parts; their hull is that of the whole, so draw the parts one by one where gaps between them
    /// matter.
    pub fn silhouette_points(&self) -> Vec<Vec3> {
        let points: Vec<Vec3> = self.parts.iter().flat_map(UnionPart::silhouette_points).collect();
        extreme_points(&points)
    }
}

impl UnionPart {
    /// Mass properties in the union's frame.
    pub fn mass_properties(&self) -> MassProperties {
        self.shape.mass_properties(self.density).transformed(&self.rotation, &self.offset)
    }

    /// The support function in the union's frame \[m\].
    pub fn extent(&self, direction: &Vec3) -> f64 {
        self.offset.dot(direction) + self.shape.extent(&self.rotation.tr_mul(direction))
    }

    /// Points whose projected hull is the part's outline, in the union's frame.
    pub fn silhouette_points(&self) -> Vec<Vec3> {
        self.shape.silhouette_points().iter().map(|point| self.rotation * point + self.offset).collect()
    }

    fn validate(&self) -> Result<(), ShapeError> {
        self.shape.validate()?;
        finite("part", "offset", self.offset.as_slice())?;
        finite("part", "rotation", self.rotation.as_slice())?;
        let defect = (self.rotation.tr_mul(&self.rotation) - Mat3::identity()).amax();
        let determinant = self.rotation.determinant();
        if defect > ROTATION_TOLERANCE || determinant < 0.0 {
            return Err(ShapeError::NotARotation { defect, determinant });
        }
        positive("part", "density", self.density)
    }
}
