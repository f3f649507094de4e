//! A volume bounded by triangles: convex hulls and meshes.
//!
//! The triangles are counter-clockwise seen from outside. Each forms with an inner point o a tetrahedron of signed
//! volume v = a·(b×c)/6 (vertices relative to o), and with s = a+b+c
//!
//!   ∫ dV = Σ v,   ∫ X dV = Σ v s/4,   ∫ X⊗X dV = Σ v (a⊗a + b⊗b + c⊗c + s⊗s)/20
//!
//! exactly. o is the mean of the vertices, so that a mesh far from its origin loses nothing.

use super::error::PolyhedronError;
use super::feature::Feature;
use super::outline::{Outline, extreme_points};
use super::triangulation::Triangulation;
use super::watertight::check_edges;
use super::wireframe::sharp_edges;
use crate::mass::MassProperties;
use crate::surface::Surface;
use crate::tensor::{Mat3, Vec3};

/// A closed surface of triangles.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Polyhedron {
    /// The vertices \[m\].
    pub vertices: Vec<Vec3>,
    /// Indices of vertices, counter-clockwise seen from outside.
    pub triangles: Vec<[usize; 3]>,
}

/// Mean thickness V/A, relative to size, below which a surface encloses nothing.
///
/// Coordinates round to 1e-16 of the size, which moves the volume by 1e-16 size·A.
const FLATNESS_TOLERANCE: f64 = 1e-12;

impl Polyhedron {
    /// Checks that the triangles bound a volume and face outward.
    ///
    /// # Errors
    /// [`PolyhedronError`]: the first of its situations, in their order.
    pub fn validate(&self) -> Result<(), PolyhedronError> {
        self.check_indices()?;
        check_edges(&self.vertices, &self.triangles)?;
        let (volume, area, size) = (self.moments().volume, self.area(), self.size());
        if volume.abs() <= FLATNESS_TOLERANCE * area * size {
            return Err(PolyhedronError::NoVolume { volume, size });
        }
        if volume < 0.0 {
            return Err(PolyhedronError::InsideOut { volume });
        }
        Ok(())
    }

    fn check_indices(&self) -> Result<(), PolyhedronError> {
        let (vertices, triangles) = (self.vertices.len(), self.triangles.len());
        for (vertex, point) in self.vertices.iter().enumerate() {
            if let Some(&value) = point.iter().find(|value| !value.is_finite()) {
                return Err(PolyhedronError::NotFinite { vertex, value });
            }
        }
        for (triangle, corners) in self.triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|&&index| index >= vertices) {
                return Err(PolyhedronError::NoSuchVertex { triangle, index, vertices });
            }
            let [a, b, c] = *corners;
            if a == b || b == c || c == a {
                return Err(PolyhedronError::RepeatedVertex { triangle });
            }
        }
        if vertices < 4 || triangles < 4 {
            return Err(PolyhedronError::TooFew { vertices, triangles });
        }
        Ok(())
    }

    /// The corners of a triangle \[m\].
    pub fn corners(&self, triangle: &[usize; 3]) -> [Vec3; 3] {
        triangle.map(|index| self.vertices[index])
    }

    /// The same surface with every triangle turned over.
    pub fn flipped(&self) -> Self {
        let triangles = self.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        Self { vertices: self.vertices.clone(), triangles }
    }

    /// Exact mass properties for a uniform density \[kg/m³\].
    pub fn mass_properties(&self, density: f64) -> MassProperties {
        let moments = self.moments();
        let center = moments.first / moments.volume;
        let euler_tensor = moments.second - moments.volume * center * center.transpose();
        MassProperties {
            mass: density * moments.volume,
            center: moments.origin + center,
            euler_tensor: euler_tensor * density,
            volume: moments.volume,
        }
    }

    fn moments(&self) -> VolumeMoments {
        let origin = mean(&self.vertices);
        let (mut volume, mut first, mut second) = (0.0, Vec3::zeros(), Mat3::zeros());
        for triangle in &self.triangles {
            let [a, b, c] = self.corners(triangle).map(|corner| corner - origin);
            let signed = a.dot(&b.cross(&c)) / 6.0;
            let sum = a + b + c;
            volume += signed;
            first += sum * (signed / 4.0);
            for point in [a, b, c, sum] {
                second += signed / 20.0 * point * point.transpose();
            }
        }
        VolumeMoments { origin, volume, first, second }
    }

    /// The area of the surface \[m²\].
    pub fn area(&self) -> f64 {
        let twice = |triangle: &[usize; 3]| {
            let [a, b, c] = self.corners(triangle);
            (b - a).cross(&(c - a)).norm()
        };
        0.5 * self.triangles.iter().map(twice).sum::<f64>()
    }

    /// The largest side of the bounding box \[m\].
    fn size(&self) -> f64 {
        let extent = |axis: Vec3| self.extent(&axis) + self.extent(&-axis);
        extent(Vec3::x()).max(extent(Vec3::y())).max(extent(Vec3::z()))
    }

    /// The support function h(n) = max X·n over the vertices \[m\].
    pub fn extent(&self, direction: &Vec3) -> f64 {
        self.vertices.iter().map(|vertex| vertex.dot(direction)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The triangles.
    ///
    /// # Panics
    /// If a triangle refers to no vertex or a coordinate is not finite; [`Polyhedron::validate`] refuses both.
    pub fn surface(&self) -> Surface {
        Surface::from_triangles(&self.vertices, &self.triangles)
            .unwrap_or_else(|fault| panic!("the polyhedron has not passed validate: {fault}"))
    }

    /// The sharpest feature: a vertex.
    pub fn sharpest_feature(&self) -> Feature {
        Feature::Vertex
    }

    /// The sharp edges, on at most 2000 points.
    pub fn outline(&self) -> Outline {
        sharp_edges(&self.vertices, &self.triangles)
    }

    /// The triangles, however many.
    pub fn triangulation(&self, _count: usize) -> Triangulation {
        Triangulation { points: self.vertices.clone(), triangles: self.triangles.clone() }
    }

    /// The vertices, thinned to those that are extreme in some direction if there are many.
    pub fn silhouette_points(&self) -> Vec<Vec3> {
        extreme_points(&self.vertices)
    }
}

/// ∫ dV, ∫ X dV and ∫ X⊗X dV about `origin`.
struct VolumeMoments {
    origin: Vec3,
    volume: f64,
    first: Vec3,
    second: Mat3,
}

fn mean(points: &[Vec3]) -> Vec3 {
    // Relative to the first point: a sum of large equal coordinates would round.
    let Some(first) = points.first() else {
        return Vec3::zeros();
    };
    first + points.iter().map(|point| point - first).sum::<Vec3>() / points.len() as f64
}
