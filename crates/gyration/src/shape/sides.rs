//! The side on which a shape lies lowest.
//!
//! Lying on the side of outward unit normal s, the centre c of mass is at the height h(s) − s·c over the plane, h the
//! support function. Of a convex shape the least of these heights over all s belongs to a face, to a ruling of a curved
//! wall, or to an axis of symmetry. Of a union the sides of its parts and the axes of its inertia are looked at.

use super::{Cone, Polyhedron, Shape, Union};
use crate::tensor::Vec3;

impl Shape {
    /// The unit normal s, out of the shape, of the side on which its centre of mass \[m\] lies lowest.
    pub fn lowest_side(&self, center: &Vec3) -> Vec3 {
        let height = |side: &Vec3| self.extent(side) - side.dot(center);
        if let Self::Polyhedron(polyhedron) = self {
            return polyhedron.lowest_face(center);
        }
        let lowest = self.sides().into_iter().min_by(|one, other| height(one).total_cmp(&height(other)));
        lowest.unwrap_or_else(|| -Vec3::z())
    }

    /// Unit normals among which that of the lowest side is.
    fn sides(&self) -> Vec<Vec3> {
        match self {
            Self::Cone(Cone { radius, height }) => {
                vec![-Vec3::z(), Vec3::new(*height, 0.0, *radius).normalize()]
            }
            Self::Polyhedron(polyhedron) => polyhedron.faces().map(|(normal, _)| normal).collect(),
            Self::Union(union) => union.sides(),
            _ => [Vec3::z(), Vec3::y(), Vec3::x()].into_iter().flat_map(|axis| [-axis, axis]).collect(),
        }
    }
}

impl Polyhedron {
    /// The unit normals of its triangles, each with a point of it.
    fn faces(&self) -> impl Iterator<Item = (Vec3, Vec3)> {
        self.triangles.iter().filter_map(|triangle| {
            let [a, b, c] = self.corners(triangle);
            Some(((b - a).cross(&(c - a)).try_normalize(0.0)?, a))
        })
    }

    /// That of the side on which this point lies lowest.
    fn lowest_face(&self, center: &Vec3) -> Vec3 {
        let mut faces: Vec<(f64, Vec3)> =
            self.faces().map(|(normal, point)| (normal.dot(&(point - center)), normal)).collect();
        faces.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        // No point lies lower over a side than over the plane of the face alone.
        let mut lowest = (f64::INFINITY, -Vec3::z());
        for (distance, normal) in faces {
            if distance >= lowest.0 {
                break;
            }
            let height = self.extent(&normal) - normal.dot(center);
            if height < lowest.0 {
                lowest = (height, normal);
            }
        }
        lowest.1
    }
}

impl Union {
    fn sides(&self) -> Vec<Vec3> {
        let of_parts =
            self.parts.iter().flat_map(|part| part.shape.sides().into_iter().map(move |side| part.rotation * side));
        let axes = self.mass_properties(1.0).euler_tensor.symmetric_eigen().eigenvectors;
        of_parts.chain(axes.column_iter().flat_map(|axis| [axis.into(), -axis])).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Cuboid, Cylinder, Ellipsoid, Sphere, UnionPart};
    use super::*;
    use crate::tensor::Mat3;

    fn part(shape: Shape, offset: Vec3) -> UnionPart {
        UnionPart { shape, offset, rotation: Mat3::identity(), density: 1.0 }
    }

    fn height(shape: &Shape) -> f64 {
        let center = shape.mass_properties(1.0).center;
        let side = shape.lowest_side(&center);
        shape.extent(&side) - side.dot(&center)
    }

    #[test]
    fn bodies_lie_as_low_as_they_can() {
        let cuboid = Shape::Box(Cuboid { size: Vec3::new(3.0, 1.0, 2.0) });
        let coin = Shape::Cylinder(Cylinder { radius: 1.0, height: 0.1 });
        let rod = Shape::Cylinder(Cylinder { radius: 0.1, height: 1.0 });
        let egg = Shape::Ellipsoid(Ellipsoid { semi_axes: Vec3::new(1.0, 0.5, 2.0) });
        let ball = || Shape::Sphere(Sphere { radius: 0.3 });
        let dumbbell = Shape::Union(Union { parts: vec![part(ball(), Vec3::x()), part(ball(), -Vec3::x())] });
        for (shape, lowest) in [(cuboid, 0.5), (coin, 0.05), (rod, 0.1), (egg, 0.5), (ball(), 0.3), (dumbbell, 0.3)] {
            assert!((height(&shape) - lowest).abs() < 1e-14, "{shape:?}: {}", height(&shape));
        }
    }

    #[test]
    fn a_cone_lies_on_its_base_or_on_its_wall() {
        // The centre is a quarter of the height over the base, and (3/4) h sin ψ over a wall of half angle ψ.
        let squat = Shape::Cone(Cone { radius: 1.0, height: 0.5 });
        assert!((height(&squat) - 0.125).abs() < 1e-14);
        let slender = Shape::Cone(Cone { radius: 0.1, height: 2.0 });
        let sine = 0.1 / f64::hypot(0.1, 2.0);
        assert!((height(&slender) - 1.5 * sine).abs() < 1e-14);
    }

    #[test]
    fn a_polyhedron_lies_on_the_face_nearest_to_its_centre() {
        // A tetrahedron whose long face is the nearest.
        let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 1.0]].map(Vec3::from);
        let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let shape = Shape::Polyhedron(Polyhedron { vertices: corners.to_vec(), triangles });
        // Its centre is the mean of the corners; the slanted face x/4 + y/4 + z = 1 is ¼/√(1/8 + 1) off.
        assert!((height(&shape) - 0.25 / 1.125_f64.sqrt()).abs() < 1e-14);
    }
}
