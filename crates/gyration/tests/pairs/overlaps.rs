//! Bodies that reach each other: how deep, and the way apart, against closed forms.

use gyration::body::Solid;
use gyration::kinematics::Placement;
use gyration::pair::Overlap;
use gyration::shape::{Cuboid, Cylinder, Shape, Union, UnionPart};
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3};
use nalgebra::Rotation3;

fn at(position: Vec3, turn: &Mat3) -> Placement {
    Placement { position, gradient: *turn }
}

fn turned() -> Mat3 {
    Rotation3::from_scaled_axis(Vec3::new(1.0, 2.0, 3.0).normalize() * 0.7).into_inner()
}

fn overlap(surfaces: [&Surface; 2], placements: [&Placement; 2]) -> Overlap {
    Overlap::check(surfaces, placements).unwrap_err()
}

/// Symptom: the best of two thousand directions told 5.6e-3 m of faces that overlap by 1e-6 m, 3.5° off their normal.
#[test]
fn faces_that_overlap_are_told_with_their_depth_and_normal() {
    let turn = turned();
    let cube = Surface::cuboid(&Vec3::repeat(0.1));
    for depth in [1e-9, 1e-6, 1e-3] {
        // Shifted sideways by 4 and 3 cm: the face of one is over part of the other's.
        let position = turn * Vec3::new(0.04, 0.03, 0.1 - depth);
        let found = overlap([&cube, &cube], [&at(position, &turn), &at(Vec3::zeros(), &turn)]);
        assert!((found.depth / depth - 1.0).abs() < 1e-3 && !found.touches(), "{} for {depth}", found.depth);
        assert!((found.normal - turn * Vec3::z()).norm() < 1e-9, "{}", found.normal);
    }
}

/// Two cubes edge on edge, crossed: the way apart is the product of the edges.
#[test]
fn edges_that_cross_are_told_with_the_way_across_both() {
    let half = std::f64::consts::FRAC_PI_4;
    let ridge = Rotation3::from_axis_angle(&Vec3::x_axis(), half).into_inner();
    let crossed = Rotation3::from_axis_angle(&Vec3::z_axis(), 0.9).into_inner() * ridge;
    let cube = Surface::cuboid(&Vec3::repeat(0.1));
    let reach = 0.1 * std::f64::consts::SQRT_2;
    for depth in [1e-6, 1e-3] {
        let position = Vec3::new(0.003, -0.002, reach - depth);
        let found = overlap([&cube, &cube], [&at(position, &crossed), &at(Vec3::zeros(), &ridge)]);
        assert!((found.depth / depth - 1.0).abs() < 1e-3, "{} for {depth}", found.depth);
        assert!((found.normal - Vec3::z()).norm() < 1e-8, "{}", found.normal);
    }
}

#[test]
fn round_bodies_are_told_with_their_depth() {
    let turn = turned();
    let (ball, cube) = (Surface::sphere(0.05), Surface::cuboid(&Vec3::repeat(0.1)));
    let (egg, rod) = (Surface::ellipsoid(&Vec3::new(0.05, 0.04, 0.06)), Surface::cylinder(0.05, 0.1));
    let still = at(Vec3::zeros(), &turn);
    let way = turn * Vec3::z();
    for depth in [1e-6, 1e-4, 1e-2] {
        let rows = [
            ("ball on ball", [&ball, &ball], way * (0.1 - depth)),
            ("ball on face", [&ball, &cube], turn * Vec3::new(0.02, 0.01, 0.1 - depth)),
            ("egg on face", [&egg, &cube], turn * Vec3::new(0.02, 0.01, 0.11 - depth)),
            ("end on face", [&rod, &cube], turn * Vec3::new(0.02, 0.01, 0.1 - depth)),
            ("ball on end", [&ball, &rod], turn * Vec3::new(0.01, 0.01, 0.1 - depth)),
        ];
        for (name, surfaces, position) in rows {
            let found = overlap(surfaces, [&at(position, &turn), &still]);
            assert!((found.depth / depth - 1.0).abs() < 5e-3, "{name}: {} for {depth}", found.depth);
            assert!((found.normal - way).norm() < 0.1 * (depth / 0.05).sqrt() + 1e-9, "{name}: {}", found.normal);
        }
    }
}

/// Symptom: bodies in touch were told to overlap by −0.000000e0 m.
#[test]
fn bodies_that_touch_are_told_to_touch() {
    let turn = turned();
    let (ball, cube) = (Surface::sphere(0.05), Surface::cuboid(&Vec3::repeat(0.1)));
    let rows = [([&ball, &ball], 0.1), ([&ball, &cube], 0.1), ([&cube, &cube], 0.1)];
    for (surfaces, distance) in rows {
        for turn in [Mat3::identity(), turn] {
            let position = turn * Vec3::new(0.0, 0.0, distance);
            let found = overlap(surfaces, [&at(position, &turn), &at(Vec3::zeros(), &turn)]);
            assert!(found.touches() && found.depth.abs() < 1e-14, "{found:?}");
            let apart = turn * Vec3::new(0.0, 0.0, distance + 1e-12);
            assert!(Overlap::check(surfaces, [&at(apart, &turn), &at(Vec3::zeros(), &turn)]).is_ok());
        }
    }
}

/// Symptom: the way out of the first part that was reached led into the next one.
#[test]
fn the_way_out_of_a_union_is_one_out_of_all_its_parts() {
    let solid = |shape: Shape| Solid::new(shape.clone(), shape.mass_properties(1.0));
    let part = |x: f64, height: f64| UnionPart {
        shape: Shape::Box(Cuboid { size: Vec3::new(0.1, 0.1, height) }),
        offset: Vec3::new(x, 0.0, 0.5 * height),
        rotation: Mat3::identity(),
        density: 1.0,
    };
    let stairs = solid(Shape::Union(Union { parts: vec![part(-0.1, 0.1), part(0.0, 0.16), part(0.1, 0.05)] }));
    let rod = solid(Shape::Cylinder(Cylinder { radius: 0.03, height: 0.2 }));
    let still = at(stairs.mass.center, &Mat3::identity());
    // In the first step alone, whose shortest way out is into the second.
    let upright = at(Vec3::new(-0.081, 0.0, 0.1), &Mat3::identity());
    let found = Solid::overlap([&rod, &stairs], [&upright, &still]).unwrap();
    // Out to the other side: 3 + 6.9 cm.
    assert!((found.depth - 0.099).abs() < 1e-4 && found.normal.x < -0.99, "{found:?}");
    let moved = at(upright.position + found.normal * (found.depth * 1.001), &Mat3::identity());
    assert!(Solid::overlap([&rod, &stairs], [&moved, &still]).is_none(), "{found:?}");
    let mut ways = 0;
    for k in 0..200 {
        let place = |j: usize| (libm::fmod(0.618_033_988_75 * ((j + 1) * (k + 1)) as f64, 1.0) - 0.5) * 0.4;
        let turn = Rotation3::from_scaled_axis(Vec3::new(place(3), place(4), place(5)) * 8.0).into_inner();
        let mut start = at(Vec3::new(place(0), 0.5 * place(1), 0.1 + 0.5 * place(2)), &turn);
        let Some(found) = Solid::overlap([&rod, &stairs], [&start, &still]) else { continue };
        ways += 1;
        start.position += found.normal * (found.depth * 1.001 + 1e-9);
        let left = Solid::overlap([&rod, &stairs], [&start, &still]);
        assert!(left.is_none(), "{k}: {found:?}, then {left:?}");
    }
    assert!(ways > 30, "{ways}");
}
