//! Shapes: the regions that bodies fill in their reference placement.
//!
//! A shape answers for its mass properties (exactly), its extent, its surface, its sharpest feature and its picture;
//! one file a shape. Frames have their origin at the centre of symmetry and their axis along z; cylinder, cone and
//! capsule at the middle of their height. The centre of mass of a cone, a polyhedron or a union is in general not the
//! origin.
//!
//! A shape knows no placement, no law and no file; hulls of points and meshes from files are made elsewhere.

mod capsule;
mod cone;
mod convex;
mod cuboid;
mod cylinder;
mod edges;
mod ellipsoid;
mod error;
mod feature;
mod geodesic;
mod outline;
mod points;
mod polyhedron;
mod sides;
mod sphere;
mod torus;
mod triangulation;
mod turned;
mod union;
mod volume_rule;
mod watertight;
mod wireframe;

pub use capsule::Capsule;
pub use cone::Cone;
pub use convex::NotConvex;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use edges::Edge;
pub use ellipsoid::Ellipsoid;
pub use error::{PolyhedronError, ShapeError};
pub use feature::Feature;
pub use outline::{Outline, SILHOUETTE_POINTS};
pub use points::{MassPoint, Points};
pub use polyhedron::Polyhedron;
pub use sphere::Sphere;
pub use torus::Torus;
pub use triangulation::Triangulation;
pub use union::{Union, UnionPart};
pub use volume_rule::{VolumeNode, VolumeRule};

use crate::mass::MassProperties;
use crate::surface::Surface;
use crate::tensor::Vec3;

/// A reference shape.
///
/// All methods but [`validate`](Shape::validate) take a shape that has passed it.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A box.
    Box(Cuboid),
    /// A sphere.
    Sphere(Sphere),
    /// An ellipsoid.
    Ellipsoid(Ellipsoid),
    /// A circular cylinder.
    Cylinder(Cylinder),
    /// A circular cone.
    Cone(Cone),
    /// A cylinder with half balls as ends.
    Capsule(Capsule),
    /// A ring.
    Torus(Torus),
    /// A volume bounded by triangles.
    Polyhedron(Polyhedron),
    /// Several shapes as one.
    Union(Union),
    /// Material points.
    Points(Points),
}

/// The box along the axes that just holds a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Smallest coordinates \[m\].
    pub min: Vec3,
    /// Largest coordinates \[m\].
    pub max: Vec3,
}

/// Does the same with the shape's struct, whichever it is.
macro_rules! each {
    ($shape:expr, $inner:ident => $result:expr) => {
        match $shape {
            Shape::Box($inner) => $result,
            Shape::Sphere($inner) => $result,
            Shape::Ellipsoid($inner) => $result,
            Shape::Cylinder($inner) => $result,
            Shape::Cone($inner) => $result,
            Shape::Capsule($inner) => $result,
            Shape::Torus($inner) => $result,
            Shape::Polyhedron($inner) => $result,
            Shape::Union($inner) => $result,
            Shape::Points($inner) => $result,
        }
    };
}

impl Shape {
    /// Checks the parameters.
    ///
    /// # Errors
    /// [`ShapeError`] names the first parameter that is wrong, its value and what it must be.
    pub fn validate(&self) -> Result<(), ShapeError> {
        each!(self, shape => Ok(shape.validate()?))
    }

    /// Exact mass properties in the shape's frame for a uniform density \[kg/m³\].
    ///
    /// A union and a set of points [bring their own mass](Shape::brings_mass); the argument then multiplies it.
    pub fn mass_properties(&self, density: f64) -> MassProperties {
        each!(self, shape => shape.mass_properties(density))
    }

    /// The semi-axes \[m\] of a sphere or an ellipsoid; none of any other shape.
    pub fn semi_axes(&self) -> Option<Vec3> {
        match self {
            Self::Sphere(Sphere { radius }) => Some(Vec3::repeat(*radius)),
            Self::Ellipsoid(Ellipsoid { semi_axes }) => Some(*semi_axes),
            _ => None,
        }
    }

    /// Whether masses or densities belong to the shape, so that the density of [`Shape::mass_properties`] is a factor.
    pub fn brings_mass(&self) -> bool {
        matches!(self, Self::Union(_) | Self::Points(_))
    }

    /// The support function h(n) = max X·n over the shape \[m\], n of any length; the lowest point along n is at
    /// −h(−n).
    pub fn extent(&self, direction: &Vec3) -> f64 {
        each!(self, shape => shape.extent(direction))
    }

    /// The box along the axes of the shape's frame that just holds it.
    pub fn bounds(&self) -> Bounds {
        let extent = |axis: usize, sign: f64| self.extent(&Vec3::ith(axis, sign));
        Bounds { min: Vec3::from_fn(|axis, _| -extent(axis, -1.0)), max: Vec3::from_fn(|axis, _| extent(axis, 1.0)) }
    }

    /// The largest side of the bounding box \[m\], the length that tolerances refer to.
    pub fn size(&self) -> f64 {
        let bounds = self.bounds();
        (bounds.max - bounds.min).max()
    }

    /// The surface that makes contact, in the shape's frame; none for a set of points.
    #[expect(clippy::useless_conversion, reason = "of a union or of points it is an Option already")]
    pub fn surface(&self) -> Option<Surface> {
        each!(self, shape => shape.surface().into())
    }

    /// The sharpest feature by which the shape may touch a plane; none if it has no surface.
    #[expect(clippy::useless_conversion, reason = "of a union or of points it is an Option already")]
    pub fn sharpest_feature(&self) -> Option<Feature> {
        each!(self, shape => shape.sharpest_feature().into())
    }

    /// A wireframe to draw, in the shape's frame.
    pub fn outline(&self) -> Outline {
        each!(self, shape => shape.outline())
    }

    /// The surface as about `count` triangles of like size, in the shape's frame: a thousand or two make a good
    /// picture.
    ///
    /// A box and a polyhedron are shown by their own triangles, however many, a union by those of its parts, `count` of
    /// each; points have none. A surface that would be coarse to the eye has a few more than asked for.
    pub fn triangulation(&self, count: usize) -> Triangulation {
        each!(self, shape => shape.triangulation(count))
    }

    /// The point of the true surface over a point of a triangle of [`Shape::triangulation`], in the shape's frame.
    ///
    /// `corners` of the triangle \[m\], `weights` of them, which add up to one; neighbours agree on their common side.
    /// Of flat faces, and of a union, whose parts answer for themselves, it is the point of the triangle.
    pub fn over(&self, corners: &[Vec3; 3], weights: &[f64; 3]) -> Vec3 {
        let flat = corners.iter().zip(weights).map(|(corner, weight)| corner * *weight).sum::<Vec3>();
        match self {
            Self::Sphere(sphere) => sphere.push_out(&flat),
            Self::Ellipsoid(ellipsoid) => ellipsoid.push_out(&flat),
            Self::Capsule(capsule) => capsule.push_out(&flat),
            Self::Torus(torus) => torus.push_out(&flat),
            Self::Cylinder(_) | Self::Cone(_) => turned::over_wall(corners, weights, &flat),
            Self::Box(_) | Self::Polyhedron(_) | Self::Union(_) | Self::Points(_) => flat,
        }
    }

    /// At most [`SILHOUETTE_POINTS`] points whose projected convex hull is the outline of the projected shape.
    pub fn silhouette_points(&self) -> Vec<Vec3> {
        each!(self, shape => shape.silhouette_points())
    }
}
