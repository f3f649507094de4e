//! Rules of integration over the volume of a shape: points and weights, exact for polynomials up to a degree.
//!
//!   ∫ b dV ≈ Σ w_q b(X_q)
//!
//! Coordinates are those of the shape: a box has Gauss' rules along its sides; balls, cylinders, cones and rings have
//! Gauss' rules along radius and axis and equal weights around; a polyhedron is the signed sum of tetrahedra from its
//! middle, each with collapsed coordinates. Of a set of points the rule is the points with their masses, [kg].
//!
//! Many points are condensed: [`VolumeRule::condensed`] has the same integrals of polynomials on a lattice of the
//! bounding box: w_q = W_q Σ_j m_j φ_j(X_q), with Gauss' weights W, Legendre's orthonormal φ_j and the moments m_j = ∫
//! φ_j dV. Some weights are then negative, and some points lie outside the shape: for polynomials alone.

use super::{Bounds, Capsule, Cone, Cylinder, Polyhedron, Shape, Torus, UnionPart};
use crate::surface::gauss_legendre;
use crate::tensor::Vec3;
use std::f64::consts::TAU;

/// Points and weights, [m³] of a volume, [kg] of a set of points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct VolumeRule {
    /// The points with their weights.
    pub nodes: Vec<VolumeNode>,
}

/// A point of a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VolumeNode {
    /// X_q [m].
    pub at: Vec3,
    /// w_q.
    pub weight: f64,
}

/// Gauss' rule on [from, to], exact up to a degree.
fn line(from: f64, to: f64, degree: usize) -> impl Iterator<Item = (f64, f64)> + Clone {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    gauss_legendre(degree / 2 + 1).iter().map(move |node| (middle + half * node.at, half * node.weight))
}

/// Angles of equal weights, exact for trigonometric polynomials up to a degree: (cos, sin, weight).
fn around(degree: usize) -> impl Iterator<Item = (f64, f64, f64)> + Clone {
    let count = degree + 1;
    (0..count).map(move |k| {
        let (sine, cosine) = libm::sincos(TAU * (k as f64 + 0.5) / count as f64);
        (cosine, sine, TAU / count as f64)
    })
}

impl VolumeRule {
    /// The rule of a shape in its frame, exact up to a degree.
    pub fn of(shape: &Shape, degree: usize) -> Self {
        let mut rule = Self::default();
        match shape {
            Shape::Box(cuboid) => rule.add_box(&(0.5 * cuboid.size), degree),
            Shape::Sphere(sphere) => rule.add_ball(&Vec3::repeat(sphere.radius), (-1.0, 1.0), 0.0, degree),
            Shape::Ellipsoid(ellipsoid) => rule.add_ball(&ellipsoid.semi_axes, (-1.0, 1.0), 0.0, degree),
            Shape::Cylinder(Cylinder { radius, height }) => rule.add_cylinder(*radius, *height, degree),
            Shape::Cone(cone) => rule.add_cone(cone, degree),
            Shape::Capsule(Capsule { radius, height }) => {
                rule.add_cylinder(*radius, *height, degree);
                let axes = Vec3::repeat(*radius);
                rule.add_ball(&axes, (0.0, 1.0), 0.5 * height, degree);
                rule.add_ball(&axes, (-1.0, 0.0), -0.5 * height, degree);
            }
            Shape::Torus(torus) => rule.add_torus(torus, degree),
            Shape::Polyhedron(polyhedron) => rule.add_polyhedron(polyhedron, degree),
            Shape::Union(union) => union.parts.iter().for_each(|part| rule.add_part(part, degree)),
            Shape::Points(points) => {
                rule.nodes = points.points.iter().map(|one| VolumeNode { at: one.at, weight: one.mass }).collect();
            }
        }
        rule
    }

    /// The rule moved by an offset.
    #[must_use]
    pub fn translated(mut self, offset: &Vec3) -> Self {
        self.nodes.iter_mut().for_each(|node| node.at += offset);
        self
    }

    /// The integral of a function.
    pub fn integrate(&self, function: impl Fn(&Vec3) -> f64) -> f64 {
        self.nodes.iter().map(|node| node.weight * function(&node.at)).sum()
    }

    /// A rule on a lattice of a box, with the same integrals of polynomials up to a degree.
    pub fn condensed(&self, bounds: &Bounds, degree: usize) -> Self {
        let (middle, half) = (0.5 * (bounds.min + bounds.max), 0.5 * (bounds.max - bounds.min));
        // A direction without extent has one layer.
        let scale = half.map(|half| if half > 0.0 { half } else { 1.0 });
        let seen = |at: &Vec3| (at - middle).component_div(&scale);
        let exponents: Vec<[usize; 3]> = (0..=degree)
            .flat_map(|i| (0..=degree - i).flat_map(move |j| (0..=degree - i - j).map(move |k| [i, j, k])))
            .collect();
        let product = |tables: &[Vec<f64>; 3], [i, j, k]: &[usize; 3]| tables[0][*i] * tables[1][*j] * tables[2][*k];
        let tables = |at: &Vec3| [at.x, at.y, at.z].map(|x| legendre(x, degree));
        let mut moments = vec![0.0; exponents.len()];
        for node in &self.nodes {
            let tables = tables(&seen(&node.at));
            for (moment, exponents) in moments.iter_mut().zip(&exponents) {
                *moment += node.weight * product(&tables, exponents);
            }
        }
        let lattice = gauss_legendre(degree + 1);
        let mut nodes = Vec::with_capacity(lattice.len().pow(3));
        for x in lattice {
            for y in lattice {
                for z in lattice {
                    let at = Vec3::new(x.at, y.at, z.at);
                    let tables = tables(&at);
                    let terms =
                        moments.iter().zip(&exponents).map(|(moment, exponents)| moment * product(&tables, exponents));
                    let weight = x.weight * y.weight * z.weight * terms.sum::<f64>();
                    nodes.push(VolumeNode { at: middle + scale.component_mul(&at), weight });
                }
            }
        }
        Self { nodes }
    }

    fn add(&mut self, at: Vec3, weight: f64) {
        self.nodes.push(VolumeNode { at, weight });
    }

    fn add_box(&mut self, half: &Vec3, degree: usize) {
        for (x, wx) in line(-half.x, half.x, degree) {
            for (y, wy) in line(-half.y, half.y, degree) {
                for (z, wz) in line(-half.z, half.z, degree) {
                    self.add(Vec3::new(x, y, z), wx * wy * wz);
                }
            }
        }
    }

    /// The part of an ellipsoid between two heights, in parts of its third semi-axis: r² dr du dφ.
    fn add_ball(&mut self, semi_axes: &Vec3, (low, high): (f64, f64), center: f64, degree: usize) {
        for (r, wr) in line(0.0, 1.0, degree + 2) {
            for (u, wu) in line(low, high, degree) {
                let across = r * (1.0 - u * u).max(0.0).sqrt();
                for (cosine, sine, wa) in around(degree) {
                    let unit = Vec3::new(across * cosine, across * sine, r * u);
                    let at = unit.component_mul(semi_axes) + Vec3::z() * center;
                    self.add(at, wr * wu * wa * r * r * semi_axes.product());
                }
            }
        }
    }

    /// r dr dφ dz.
    fn add_cylinder(&mut self, radius: f64, height: f64, degree: usize) {
        for (z, wz) in line(-0.5 * height, 0.5 * height, degree) {
            self.add_disk(radius, z, wz, degree);
        }
    }

    fn add_disk(&mut self, radius: f64, z: f64, weight: f64, degree: usize) {
        for (r, wr) in line(0.0, radius, degree + 1) {
            for (cosine, sine, wa) in around(degree) {
                self.add(Vec3::new(r * cosine, r * sine, z), weight * wr * wa * r);
            }
        }
    }

    /// Disks that shrink from the base to the apex.
    fn add_cone(&mut self, cone: &Cone, degree: usize) {
        for (s, ws) in line(0.0, 1.0, degree + 2) {
            self.add_disk(s * cone.radius, cone.height * (0.5 - s), ws * cone.height, degree);
        }
    }

    /// (R + ρ cos ψ) ρ dρ dψ dφ.
    fn add_torus(&mut self, torus: &Torus, degree: usize) {
        for (r, wr) in line(0.0, torus.minor_radius, degree + 2) {
            for (along, up, wt) in around(degree + 1) {
                let out = torus.major_radius + r * along;
                for (cosine, sine, wa) in around(degree) {
                    self.add(Vec3::new(out * cosine, out * sine, r * up), wr * wt * wa * out * r);
                }
            }
        }
    }

    /// X = o + s (a + u (b − a) + u v (c − b)), dV = a·(b×c) s² u ds du dv.
    fn add_polyhedron(&mut self, polyhedron: &Polyhedron, degree: usize) {
        let count = polyhedron.vertices.len().max(1) as f64;
        let origin = polyhedron.vertices.iter().map(|vertex| vertex / count).sum::<Vec3>();
        for triangle in &polyhedron.triangles {
            let [a, b, c] = polyhedron.corners(triangle).map(|corner| corner - origin);
            let volume = a.dot(&b.cross(&c));
            for (s, ws) in line(0.0, 1.0, degree + 2) {
                for (u, wu) in line(0.0, 1.0, degree + 1) {
                    for (v, wv) in line(0.0, 1.0, degree) {
                        let at = origin + s * (a + u * (b - a) + u * v * (c - b));
                        self.add(at, volume * ws * wu * wv * s * s * u);
                    }
                }
            }
        }
    }

    /// A part of a union; points have no volume.
    fn add_part(&mut self, part: &UnionPart, degree: usize) {
        if matches!(part.shape, Shape::Points(_)) {
            return;
        }
        for VolumeNode { at, weight } in Self::of(&part.shape, degree).nodes {
            self.add(part.rotation * at + part.offset, weight);
        }
    }
}

/// Legendre's polynomials up to a degree, orthonormal on [−1, 1].
fn legendre(x: f64, degree: usize) -> Vec<f64> {
    let mut values = vec![1.0, x];
    for k in 2..=degree {
        let order = k as f64;
        values.push(((2.0 * order - 1.0) * x * values[k - 1] - (order - 1.0) * values[k - 2]) / order);
    }
    values.truncate(degree + 1);
    for (k, value) in values.iter_mut().enumerate() {
        *value *= (k as f64 + 0.5).sqrt();
    }
    values
}
