//! One equation of a joint: a product of two vectors that are linear in the coordinates of its two bodies.
//!
//!   C = w U·V − c,   U = Σ_i q_i û_i,   V = Σ_i q_i v̂_i
//!
//! q = (p₀ | P), 3×4, û and v̂ constant: the row (−1, −X) and (1, Y) is the way from a point X to a point Y, (0, a) a
//! direction. U may stand still in space. So all derivatives are exact, and C̈ is linear in q̈:
//!
//!   Ċ = w (U̇·V + U·V̇),   C̈ = w (Ü·V + 2 U̇·V̇ + U·V̈),   G_i = ∂C/∂q_i = w (V ⊗ û_i + U ⊗ v̂_i)
//!
//! Source: `docs/theory-rigid.md`.

use crate::load::{Mat12, add_blocks};
use crate::tensor::{Mat3, Vec3};
use nalgebra::{Matrix3x4, Vector4};
use std::ops::AddAssign;

/// q, its first and its second derivative in time, of one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet {
    /// q.
    pub place: Matrix3x4<f64>,
    /// q̇.
    pub rate: Matrix3x4<f64>,
    /// q̈.
    pub acceleration: Matrix3x4<f64>,
}

/// U.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Left {
    /// A direction of space.
    Fixed(Vec3),
    /// û of both bodies.
    Moving([Vector4<f64>; 2]),
}

/// So much of its size is rounding of a sum of some products.
const DIGITS: f64 = 2.0 * f64::EPSILON;

/// One equation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    left: Left,
    /// v̂ of both bodies.
    right: [Vector4<f64>; 2],
    /// w.
    weight: f64,
    /// c.
    offset: f64,
}

/// U or V with its derivatives in time.
#[derive(Debug, Clone, Copy)]
struct VectorJet([Vec3; 3]);

impl Jet {
    /// Of space.
    pub fn space() -> Self {
        let mut still = Self::zeros();
        still.place.fixed_view_mut::<3, 3>(0, 1).copy_from(&Mat3::identity());
        still
    }

    /// Nothing.
    pub fn zeros() -> Self {
        Self { place: Matrix3x4::zeros(), rate: Matrix3x4::zeros(), acceleration: Matrix3x4::zeros() }
    }
}

/// The way to a point X, on the coordinates of its body.
pub(super) fn point(x: &Vec3) -> Vector4<f64> {
    Vector4::new(1.0, x.x, x.y, x.z)
}

/// A direction a, on the coordinates of its body.
pub(super) fn direction(a: &Vec3) -> Vector4<f64> {
    Vector4::new(0.0, a.x, a.y, a.z)
}

impl AddAssign for Jet {
    fn add_assign(&mut self, other: Self) {
        self.place += other.place;
        self.rate += other.rate;
        self.acceleration += other.acceleration;
    }
}

impl Row {
    /// The way between two points X and Y has no part along a direction of space \[m\].
    pub(super) fn meet([x, y]: &[Vec3; 2], along: Vec3) -> Self {
        Self { left: Left::Fixed(along), right: [-point(x), point(y)], weight: 1.0, offset: 0.0 }
    }

    /// Two points X and Y stay at a distance l: (|Δ|² − l²)/2l \[m\].
    pub(super) fn distance([x, y]: &[Vec3; 2], length: f64) -> Self {
        let way = [-point(x), point(y)];
        Self { left: Left::Moving(way), right: way, weight: 0.5 / length, offset: 0.5 * length }
    }

    /// The way between two points X and Y stays across a direction b of the first body \[m\].
    pub(super) fn across([x, y]: &[Vec3; 2], b: &Vec3) -> Self {
        let left = Left::Moving([direction(b), Vector4::zeros()]);
        Self { left, right: [-point(x), point(y)], weight: 1.0, offset: 0.0 }
    }

    /// A direction a of the first body stays perpendicular to a direction b of the second.
    pub(super) fn perpendicular(a: &Vec3, b: &Vec3) -> Self {
        let left = Left::Moving([direction(a), Vector4::zeros()]);
        Self { left, right: [Vector4::zeros(), direction(b)], weight: 1.0, offset: 0.0 }
    }

    fn left(&self, of: &[Jet; 2]) -> VectorJet {
        match &self.left {
            Left::Fixed(direction) => VectorJet([*direction, Vec3::zeros(), Vec3::zeros()]),
            Left::Moving(vectors) => VectorJet::of(vectors, of),
        }
    }

    /// Whether C is of directions, and no length.
    pub fn is_of_directions(&self) -> bool {
        // The way between two points has both of their places in it.
        self.right.iter().all(|vector| vector[0] == 0.0)
    }

    /// C; lengths in metres.
    pub fn value(&self, of: &[Jet; 2]) -> f64 {
        let (VectorJet([u, ..]), VectorJet([v, ..])) = (self.left(of), VectorJet::of(&self.right, of));
        self.weight * u.dot(&v) - self.offset
    }

    /// Ċ.
    pub fn rate(&self, of: &[Jet; 2]) -> f64 {
        let (VectorJet([u, du, _]), VectorJet([v, dv, _])) = (self.left(of), VectorJet::of(&self.right, of));
        self.weight * (du.dot(&v) + u.dot(&dv))
    }

    /// C̈.
    pub fn second_rate(&self, of: &[Jet; 2]) -> f64 {
        let (VectorJet([u, du, ddu]), VectorJet([v, dv, ddv])) = (self.left(of), VectorJet::of(&self.right, of));
        self.weight * (ddu.dot(&v) + 2.0 * du.dot(&dv) + u.dot(&ddv))
    }

    /// The change of C̈ with a change of q, q̇ and q̈ of one of the two.
    pub fn change(&self, of: &[Jet; 2], end: usize, change: &Jet) -> f64 {
        let (VectorJet([u, du, ddu]), VectorJet([v, dv, ddv])) = (self.left(of), VectorJet::of(&self.right, of));
        let VectorJet([a, da, dda]) = match &self.left {
            Left::Fixed(_) => VectorJet([Vec3::zeros(); 3]),
            Left::Moving(vectors) => VectorJet::of_one(&vectors[end], change),
        };
        let VectorJet([b, db, ddb]) = VectorJet::of_one(&self.right[end], change);
        let of_left = dda.dot(&v) + 2.0 * da.dot(&dv) + a.dot(&ddv);
        let of_right = ddu.dot(&b) + 2.0 * du.dot(&db) + u.dot(&ddb);
        self.weight * (of_left + of_right)
    }

    /// |C| below which it is rounding: vectors are known to the last digit of their longest part.
    pub fn rounding(&self, of: &[Jet; 2]) -> f64 {
        let [(u, _), (v, _)] = self.sizes(of);
        DIGITS * self.weight * u * v
    }

    /// |Ċ| below which it is rounding.
    pub fn rounding_of_rate(&self, of: &[Jet; 2]) -> f64 {
        let [(u, du), (v, dv)] = self.sizes(of);
        DIGITS * self.weight * (u * dv + du * v)
    }

    /// The sizes of what U and V are summed of, and of their rates; places are differences, which are exact.
    fn sizes(&self, of: &[Jet; 2]) -> [(f64, f64); 2] {
        let size = |vectors: &[Vector4<f64>; 2]| {
            let mut sizes = (0.0, 0.0);
            for (vector, jet) in vectors.iter().zip(of) {
                for (entry, k) in vector.iter().zip(0..) {
                    sizes.0 += entry.abs() * jet.place.column(k).norm();
                    sizes.1 += entry.abs() * jet.rate.column(k).norm();
                }
            }
            sizes
        };
        let left = match &self.left {
            Left::Fixed(direction) => (direction.norm(), 0.0),
            Left::Moving(vectors) => size(vectors),
        };
        [left, size(&self.right)]
    }

    /// G of one of the two, as (f | M) of a multiplier one.
    pub fn gradient(&self, of: &[Jet; 2], end: usize) -> Matrix3x4<f64> {
        let VectorJet([u, ..]) = self.left(of);
        let by_right = u * self.right[end].transpose();
        let Left::Moving(vectors) = &self.left else { return self.weight * by_right };
        let VectorJet([v, ..]) = VectorJet::of(&self.right, of);
        self.weight * (by_right + v * vectors[end].transpose())
    }

    /// Adds λ ∂G_i/∂q_j.
    pub fn add_slope(&self, multiplier: f64, [i, j]: [usize; 2], slope: &mut Mat12) {
        let Left::Moving(left) = &self.left else { return };
        let weight = self.weight * multiplier;
        let part = |a: usize, b: usize| weight * (left[i][a] * self.right[j][b] + self.right[i][a] * left[j][b]);
        add_blocks(slope, &Mat3::identity(), part);
    }
}

impl VectorJet {
    fn of(vectors: &[Vector4<f64>; 2], [one, other]: &[Jet; 2]) -> Self {
        let (Self(first), Self(second)) = (Self::of_one(&vectors[0], one), Self::of_one(&vectors[1], other));
        Self([first[0] + second[0], first[1] + second[1], first[2] + second[2]])
    }

    fn of_one(vector: &Vector4<f64>, jet: &Jet) -> Self {
        Self([jet.place * vector, jet.rate * vector, jet.acceleration * vector])
    }
}
