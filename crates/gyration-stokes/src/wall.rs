//! A plane wall without slip: Blake's images of Stokeslets and of the uniform source.
//!
//! Heights above the wall are counted along its normal e; h is that of the source point y, Y = y − 2h e its mirror
//! image, R = x − Y, R₃ = e·R, Q = I − 2 e eᵀ. Beside G the wall adds
//!
//!   −(I/R + RRᵀ/R³) + 2h [−x₃ (I/R³ − 3RRᵀ/R⁵) + (e Rᵀ − R eᵀ)/R³] Q
//!
//! to the velocity; to the flow v of a unit source in the body and to the work of its pressure on the body
//!
//!   v(y): −(1/4π) ∮ (n/R − 2h (R₃/R³) Q n) dA,      Π = (1/π) ∮∮ (e·n)(e·n′)/R dA dA
//!
//! which follow from the pressure of the former by reciprocity, and from Φ = 1/(2πR) in u = ∇Φ − e ∂₃Φ + x₃ ∇∂₃Φ, p =
//! 2∂₃²Φ. Source: Blake, *Proc. Camb. Phil. Soc.* 70 (1971) 303; Blake and Chwang, *J. Engng Math.* 8 (1974) 23.

use crate::error::StokesError;
use crate::pair::Block;
use crate::panel::FlatPanel;
use crate::vector::{Mat3, Vec3};
use std::f64::consts::PI;

/// A plane wall that bounds the fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPlane {
    /// A point of it [length].
    pub point: [f64; 3],
    /// Its normal into the fluid, of any length.
    pub normal: [f64; 3],
}

/// The wall with what the images need.
#[derive(Debug, Clone)]
pub(crate) struct WallImages {
    point: Vec3,
    normal: Vec3,
    mirror: Mat3,
}

/// What the images add for a pair of triangles.
#[derive(Debug, Clone)]
pub(crate) struct Image {
    /// To the block, in the units of [`crate::pair`].
    pub block: Block,
    /// ∫ φ_i v dA at the corners of the first triangle, the body's surface being the second.
    pub here: [Vec3; 3],
    /// The same with the triangles exchanged.
    pub there: [Vec3; 3],
    /// The share in Π of one order of the two.
    pub pressure: f64,
}

/// Longest side of a triangle over its gap to the wall: above, linear tractions cannot follow the pressure in the gap.
const WIDEST: f64 = 4.0;

/// A part of a triangle and the image of another part are far apart beyond this times the sum of their radii.
const FAR: f64 = 2.0;
/// Halvings of a pair; a triangle as wide as allowed needs three to be far from its image.
const HALVINGS: u32 = 4;

/// A part of a triangle with the barycentric coordinates of its corners.
#[derive(Debug, Clone, Copy)]
struct SubTriangle {
    corners: [Vec3; 3],
    weights: [Vec3; 3],
}

impl WallImages {
    /// The wall, for a body of these triangles.
    ///
    /// # Errors
    /// A normal without direction; a triangle that touches the wall, crosses it or is too large for its gap.
    pub fn new(plane: &WallPlane, panels: &[FlatPanel]) -> Result<Self, StokesError> {
        let (point, normal) = (Vec3::from(plane.point), Vec3::from(plane.normal));
        let length = normal.norm();
        let value = length + point.sum();
        if !(value.is_finite() && length > 0.0) {
            return Err(StokesError::BadOption {
                what: "normal of the wall",
                must_be: "finite and not zero",
                value: length,
            });
        }
        let normal = normal / length;
        let wall = Self { point, normal, mirror: Mat3::identity() - 2.0 * normal * normal.transpose() };
        for (triangle, panel) in panels.iter().enumerate() {
            let [a, b, c] = panel.corners;
            let gap = panel.corners.map(|p| wall.height(&p)).into_iter().fold(f64::INFINITY, f64::min);
            let size = (b - a).norm().max((c - b).norm()).max((a - c).norm());
            if gap.is_nan() || gap <= 0.0 {
                return Err(StokesError::WallCrossed { triangle, gap });
            }
            if size > WIDEST * gap {
                return Err(StokesError::WallTooNear { triangle, size, gap, needed: WIDEST * gap });
            }
        }
        Ok(wall)
    }

    fn height(&self, p: &Vec3) -> f64 {
        self.normal.dot(&(p - self.point))
    }

    fn image(&self, p: &Vec3) -> Vec3 {
        p - 2.0 * self.height(p) * self.normal
    }

    /// What the wall adds to G(x, y), from R = x − Y and the heights of x and y.
    fn stokeslet(&self, r: &Vec3, x_height: f64, y_height: f64) -> Mat3 {
        let squared = r.norm_squared();
        let inverse = 1.0 / squared.sqrt();
        let (cubed, e) = (inverse / squared, &self.normal);
        let doublet = (Mat3::identity() - r * r.transpose() * (3.0 / squared)) * (-x_height * cubed)
            + (e * r.transpose() - r * e.transpose()) * cubed;
        -(Mat3::identity() * inverse + r * r.transpose() * cubed) + 2.0 * y_height * doublet * self.mirror
    }

    /// What the images add for two triangles, or for a triangle and itself.
    pub fn between(&self, one: &FlatPanel, other: &FlatPanel) -> Image {
        let mut image =
            Image { block: [[0.0; 9]; 9], here: [Vec3::zeros(); 3], there: [Vec3::zeros(); 3], pressure: 0.0 };
        let normals = (one.normal(), other.normal());
        self.add((SubTriangle::of(one), SubTriangle::of(other)), normals, HALVINGS, &mut image);
        image.pressure *= normals.0.dot(&self.normal) * normals.1.dot(&self.normal) / PI;
        image
    }

    fn add(&self, (one, other): (SubTriangle, SubTriangle), normals: (Vec3, Vec3), halvings: u32, image: &mut Image) {
        let distance = (one.centroid() - self.image(&other.centroid())).norm();
        if halvings > 0 && distance < FAR * (one.radius() + other.radius()) {
            for part in one.quarters() {
                for facing in other.quarters() {
                    self.add((part, facing), normals, halvings - 1, image);
                }
            }
            return;
        }
        let factor = one.area() * other.area() / 9.0;
        for (x, phi) in one.points() {
            for (y, other_phi) in other.points() {
                self.add_point((x, y), (phi * factor, other_phi), normals, image);
            }
        }
    }

    fn add_point(
        &self,
        (x, y): (Vec3, Vec3),
        (phi, other_phi): (Vec3, Vec3),
        normals: (Vec3, Vec3),
        image: &mut Image,
    ) {
        let (x_height, y_height) = (self.height(&x), self.height(&y));
        let r = x - self.image(&y);
        let g = self.stokeslet(&r, x_height, y_height);
        for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
            let weight = phi[i] * other_phi[j];
            for (a, b) in (0..9).map(|k| (k / 3, k % 3)) {
                image.block[3 * i + a][3 * j + b] += weight * g[(a, b)];
            }
        }
        let inverse = 1.0 / r.norm();
        let fall = (x_height + y_height) * inverse.powi(3);
        let flow = |n: &Vec3, height: f64| (n * inverse - self.mirror * n * (2.0 * height * fall)) / (-4.0 * PI);
        let (here, there) = (flow(&normals.1, x_height), flow(&normals.0, y_height));
        let total = phi.sum();
        for k in 0..3 {
            image.here[k] += here * phi[k];
            image.there[k] += there * (other_phi[k] * total);
        }
        image.pressure += total * inverse;
    }
}

impl SubTriangle {
    fn of(panel: &FlatPanel) -> Self {
        Self { corners: panel.corners, weights: [Vec3::x(), Vec3::y(), Vec3::z()] }
    }

    fn centroid(&self) -> Vec3 {
        self.corners.iter().sum::<Vec3>() / 3.0
    }

    fn radius(&self) -> f64 {
        let centroid = self.centroid();
        self.corners.iter().map(|p| (p - centroid).norm()).fold(0.0, f64::max)
    }

    fn area(&self) -> f64 {
        let [a, b, c] = self.corners;
        0.5 * (b - a).cross(&(c - a)).norm()
    }

    /// The points of the rule of degree 2, with the shape functions there.
    fn points(&self) -> [(Vec3, Vec3); 3] {
        let (place, weight) = (self.centroid(), self.weights.iter().sum::<Vec3>() / 3.0);
        [0, 1, 2].map(|k| (0.5 * (self.corners[k] + place), 0.5 * (self.weights[k] + weight)))
    }

    fn quarters(&self) -> [Self; 4] {
        let cut = |[a, b, c]: [Vec3; 3]| {
            let (ab, bc, ca) = (0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a));
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        let (corners, weights) = (cut(self.corners), cut(self.weights));
        std::array::from_fn(|k| Self { corners: corners[k], weights: weights[k] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall() -> WallImages {
        let plane = WallPlane { point: [0.1, -0.2, 0.3], normal: [0.5, -1.0, 2.0] };
        WallImages::new(&plane, &[]).unwrap()
    }

    fn free(r: &Vec3) -> Mat3 {
        Mat3::identity() / r.norm() + r * r.transpose() / r.norm().powi(3)
    }

    fn above(wall: &WallImages, height: f64, along: [f64; 2]) -> Vec3 {
        let e = wall.normal;
        let (u, v) = (e.cross(&Vec3::x()).normalize(), e.cross(&e.cross(&Vec3::x())).normalize());
        wall.point + e * height + u * along[0] + v * along[1]
    }

    #[test]
    fn fluid_does_not_slip_on_the_wall() {
        let wall = wall();
        let y = above(&wall, 0.7, [0.3, -0.1]);
        for along in [[0.0, 0.0], [1.0, 0.4], [-0.5, 3.0]] {
            let x = above(&wall, 0.0, along);
            let g = free(&(x - y)) + wall.stokeslet(&(x - wall.image(&y)), 0.0, 0.7);
            assert!(g.amax() < 1e-14, "{g}");
        }
    }

    #[test]
    fn images_are_reciprocal() {
        let wall = wall();
        let (x, y) = (above(&wall, 0.7, [0.3, -0.1]), above(&wall, 0.2, [-0.4, 0.6]));
        let there = wall.stokeslet(&(x - wall.image(&y)), 0.7, 0.2);
        let back = wall.stokeslet(&(y - wall.image(&x)), 0.2, 0.7);
        assert!((there - back.transpose()).amax() < 1e-13);
    }
}
