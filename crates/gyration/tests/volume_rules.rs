//! Rules over volumes: exact for polynomials up to their degree, whatever the shape.

use gyration::mass::MassProperties;
use gyration::shape::{
    Capsule, Cone, Cuboid, Cylinder, Ellipsoid, MassPoint, Points, Polyhedron, Shape, Sphere, Torus, Union, UnionPart,
    VolumeRule,
};
use gyration::tensor::{Mat3, Vec3};

/// One of each, a union and a tetrahedron off the origin among them.
fn shapes() -> Vec<Shape> {
    let corners = [[0.1, 0.2, 0.3], [1.1, 0.1, 0.2], [0.3, 0.9, 0.1], [0.2, 0.4, 1.4]].map(Vec3::from);
    let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    let tetrahedron = Shape::Polyhedron(Polyhedron { vertices: corners.to_vec(), triangles });
    let cone = Shape::Cone(Cone { radius: 0.4, height: 0.9 });
    let turn = *nalgebra::Rotation3::new(Vec3::new(0.3, -0.7, 0.4)).matrix();
    let part = |shape: &Shape, offset: Vec3, rotation: Mat3| UnionPart {
        shape: shape.clone(),
        offset,
        rotation,
        density: 1.0,
    };
    let parts = vec![
        part(&cone, Vec3::new(0.5, 0.1, -0.3), turn),
        part(&tetrahedron, Vec3::new(-0.4, 0.2, 0.1), Mat3::identity()),
    ];
    vec![
        Shape::Box(Cuboid { size: Vec3::new(0.8, 1.0, 0.6) }),
        Shape::Sphere(Sphere { radius: 0.5 }),
        Shape::Ellipsoid(Ellipsoid { semi_axes: Vec3::new(0.5, 0.3, 0.4) }),
        Shape::Cylinder(Cylinder { radius: 0.4, height: 0.9 }),
        cone,
        Shape::Capsule(Capsule { radius: 0.3, height: 0.7 }),
        Shape::Torus(Torus { major_radius: 0.6, minor_radius: 0.2 }),
        tetrahedron,
        Shape::Union(Union { parts }),
    ]
}

/// Volume, first and second moments about the origin.
fn second_moments(rule: &VolumeRule) -> (f64, Vec3, Mat3) {
    let first = |i: usize| rule.integrate(|x| x[i]);
    let second = |i: usize, j: usize| rule.integrate(|x| x[i] * x[j]);
    (rule.integrate(|_| 1.0), Vec3::from_fn(|i, _| first(i)), Mat3::from_fn(second))
}

#[test]
fn rules_of_degree_two_have_the_mass_properties_of_their_shapes() {
    for shape in shapes() {
        let MassProperties { center, volume, .. } = shape.mass_properties(1.0);
        let tensor = shape.mass_properties(1.0).about(&Vec3::zeros());
        let rule = VolumeRule::of(&shape, 2);
        for rule in [rule.condensed(&shape.bounds(), 2), rule] {
            let (zeroth, first, second) = second_moments(&rule);
            // Rounding of a hundred terms of one sign.
            assert!((zeroth - volume).abs() < 1e-14, "{shape:?}: {zeroth} {volume}");
            assert!((first - volume * center).amax() < 1e-14, "{shape:?}");
            assert!((second - tensor).amax() < 1e-14, "{shape:?}: {second} {tensor}");
        }
    }
}

#[test]
fn rules_are_exact_up_to_their_degree_and_not_beyond() {
    for shape in shapes() {
        let fine = VolumeRule::of(&shape, 20);
        for degree in 0..8 {
            let rule = VolumeRule::of(&shape, degree);
            let condensed = rule.condensed(&shape.bounds(), degree);
            let error = |rule: &VolumeRule, order: i32| {
                let mut worst: f64 = 0.0;
                for i in 0..=order {
                    for j in 0..=order - i {
                        let power = |x: &Vec3| x.x.powi(i) * x.y.powi(j) * x.z.powi(order - i - j);
                        worst = worst.max((rule.integrate(power) - fine.integrate(power)).abs());
                    }
                }
                worst
            };
            for order in 0..=degree as i32 {
                let errors = [error(&rule, order), error(&condensed, order)];
                assert!(errors[0] < 1e-13 && errors[1] < 1e-13, "{shape:?}, {degree}, {order}: {errors:?}");
            }
        }
        // A rule of degree two is none of eight: the test can fail.
        let coarse = VolumeRule::of(&shape, 2);
        let power = |x: &Vec3| x.x.powi(8) + x.y.powi(8) + x.z.powi(8);
        assert!((coarse.integrate(power) - fine.integrate(power)).abs() > 1e-9, "{shape:?}");
    }
}

#[test]
fn points_are_weighed_by_their_masses() {
    let at = |mass: f64, x: f64| MassPoint { mass, at: Vec3::new(x, 0.0, 1.0) };
    let rule = VolumeRule::of(&Shape::Points(Points { points: vec![at(2.0, 0.5), at(3.0, -1.0)] }), 3);
    assert_eq!(rule.integrate(|x| x.x * x.x), 3.5);
}
