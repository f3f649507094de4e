//! One of each shape, and what tests compare them with.

use std::f64::consts::TAU;

use gyration::mass::MassProperties;
use gyration::shape::{
    Capsule, Cone, Cuboid, Cylinder, Ellipsoid, MassPoint, Points, Polyhedron, Shape, Sphere, Torus, Union, UnionPart,
};
use gyration::tensor::{Mat3, Vec3};
use nalgebra::Rotation3;

/// A density [kg/m³].
pub const DENSITY: f64 = 1200.0;

/// A box of the given edges.
pub fn cuboid(x: f64, y: f64, z: f64) -> Shape {
    Shape::Box(Cuboid { size: Vec3::new(x, y, z) })
}

/// A rotation without any symmetry.
pub fn rotation() -> Mat3 {
    Rotation3::from_euler_angles(0.3, -0.7, 1.1).into_inner()
}

/// The corner tetrahedron with legs a along the axes.
pub fn corner_tetrahedron(a: f64) -> Polyhedron {
    let vertices = vec![Vec3::zeros(), Vec3::x() * a, Vec3::y() * a, Vec3::z() * a];
    Polyhedron { vertices, triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] }
}

/// Three parts of different densities.
pub fn union_of(scale: f64) -> Shape {
    let part = |shape, z: f64, density| UnionPart {
        shape,
        offset: Vec3::new(0.1, 0.0, z) * scale,
        rotation: rotation(),
        density,
    };
    Shape::Union(Union {
        parts: vec![
            part(Shape::Cone(Cone { radius: 0.3 * scale, height: 0.8 * scale }), 0.5, 3.0),
            part(Shape::Sphere(Sphere { radius: 0.4 * scale }), -0.6, 1.5),
            part(cuboid(0.1 * scale, 0.5 * scale, 0.3 * scale), 0.0, 0.5),
        ],
    })
}

/// One of each shape with a volume, all lengths multiplied by `scale`.
pub fn solids(scale: f64) -> Vec<Shape> {
    vec![
        cuboid(0.1 * scale, 0.5 * scale, 0.3 * scale),
        Shape::Sphere(Sphere { radius: 0.4 * scale }),
        Shape::Ellipsoid(Ellipsoid { semi_axes: Vec3::new(0.5, 0.3, 0.2) * scale }),
        Shape::Cylinder(Cylinder { radius: 0.3 * scale, height: 0.8 * scale }),
        Shape::Cone(Cone { radius: 0.3 * scale, height: 0.8 * scale }),
        Shape::Capsule(Capsule { radius: 0.3 * scale, height: 0.8 * scale }),
        Shape::Torus(Torus { major_radius: 0.7 * scale, minor_radius: 0.2 * scale }),
        Shape::Polyhedron(corner_tetrahedron(0.6 * scale)),
        union_of(scale),
    ]
}

/// Four points that span a volume.
pub fn points() -> Shape {
    let at = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, -1.0], [1.0, 1.0, 1.0]];
    let point = |(k, at): (usize, [f64; 3])| MassPoint { mass: 1.0 + k as f64, at: at.into() };
    Shape::Points(Points { points: at.into_iter().enumerate().map(point).collect() })
}

/// Asserts a relative error.
pub fn assert_close(name: &str, value: f64, expected: f64, tolerance: f64) {
    let error = (value - expected).abs();
    assert!(error <= tolerance * expected.abs().max(1e-300), "{name}: {value} instead of {expected}, off by {error:e}");
}

/// Largest difference of two bodies, relative to mass, size and m·size².
pub fn difference(a: &MassProperties, b: &MassProperties, size: f64) -> f64 {
    let tensors = (a.euler_tensor - b.euler_tensor).amax() / (b.mass * size * size);
    let centers = (a.center - b.center).norm() / size;
    tensors.max(centers).max((a.mass / b.mass - 1.0).abs())
}

/// A closed curve (radius, z) turned about the z axis in `count` steps; equal radii 0 close the surface at the axis.
fn turned(profile: &[[f64; 2]], count: usize) -> Polyhedron {
    let mut mesh = Polyhedron::default();
    let vertex = |k: usize, j: usize| k * count + j % count;
    for &[radius, z] in profile {
        let angle = |j: usize| TAU * j as f64 / count as f64;
        mesh.vertices.extend((0..count).map(|j| Vec3::new(radius * angle(j).cos(), radius * angle(j).sin(), z)));
    }
    for k in 0..profile.len() {
        let next = (k + 1) % profile.len();
        for j in 0..count {
            mesh.triangles.push([vertex(k, j), vertex(k, j + 1), vertex(next, j + 1)]);
            mesh.triangles.push([vertex(k, j), vertex(next, j + 1), vertex(next, j)]);
        }
    }
    mesh
}

/// Half a circle of radius r about (0, z), from −90° to 90°, in `count` chords.
fn arc(radius: f64, z: f64, from: f64, to: f64, count: usize) -> Vec<[f64; 2]> {
    let point = |k: usize| {
        let (sine, cosine) = (TAU * (from + (to - from) * k as f64 / count as f64)).sin_cos();
        [radius * cosine.max(0.0), z + radius * sine]
    };
    (0..=count).map(point).collect()
}

/// The shape as a polyhedron of about 2n chords around.
pub fn approximated(shape: &Shape, n: usize) -> Polyhedron {
    let profile = match shape {
        Shape::Sphere(it) => arc(it.radius, 0.0, -0.25, 0.25, n),
        Shape::Ellipsoid(_) => arc(1.0, 0.0, -0.25, 0.25, n),
        Shape::Cylinder(it) => {
            let top = 0.5 * it.height;
            vec![[0.0, -top], [it.radius, -top], [it.radius, top], [0.0, top]]
        }
        Shape::Cone(it) => vec![[0.0, -0.5 * it.height], [it.radius, -0.5 * it.height], [0.0, 0.5 * it.height]],
        Shape::Capsule(it) => {
            let half = 0.5 * it.height;
            [arc(it.radius, -half, -0.25, 0.0, n), arc(it.radius, half, 0.0, 0.25, n)].concat()
        }
        Shape::Torus(it) => {
            let tube = (0..2 * n).map(|k| TAU * k as f64 / (2 * n) as f64);
            tube.map(|t| [it.major_radius + it.minor_radius * t.cos(), it.minor_radius * t.sin()]).collect()
        }
        other => panic!("{other:?} is not curved"),
    };
    let mut mesh = turned(&profile, 2 * n);
    if let Shape::Ellipsoid(it) = shape {
        mesh.vertices.iter_mut().for_each(|vertex| vertex.component_mul_assign(&it.semi_axes));
    }
    mesh
}
