//! What every shape answers besides its mass: faults, extent, surface, sharpest feature, picture.

use std::f64::consts::TAU;

use crate::solids::{
    DENSITY, approximated, assert_close, corner_tetrahedron, cuboid, difference, points, rotation, solids,
};
use gyration::shape::{
    Capsule, Cone, Cuboid, Cylinder, Ellipsoid, Feature, MassPoint, Outline, Points, Polyhedron, PolyhedronError,
    SILHOUETTE_POINTS, Shape, ShapeError, Sphere, Torus, Union, UnionPart,
};
use gyration::surface::GapField;
use gyration::tensor::Vec3;
use nalgebra::Rotation3;

#[test]
fn valid_shapes_pass_and_have_possible_mass_properties() {
    for shape in solids(1.0).into_iter().chain([points()]) {
        assert_eq!(shape.validate(), Ok(()), "{shape:?}");
        assert_eq!(shape.mass_properties(DENSITY).validate(), Ok(()), "{shape:?}");
        assert_eq!(shape.brings_mass(), matches!(shape, Shape::Union(_) | Shape::Points(_)));
    }
}

#[test]
fn wrong_parameters_are_named() {
    let wrong = [
        (cuboid(1.0, -1.0, 1.0), "size of the box is -1: it must be finite and > 0"),
        (Shape::Sphere(Sphere { radius: f64::NAN }), "radius of the sphere is NaN"),
        (Shape::Ellipsoid(Ellipsoid { semi_axes: Vec3::new(1.0, 1.0, 0.0) }), "semi_axes of the ellipsoid is 0"),
        (Shape::Cylinder(Cylinder { radius: 1.0, height: f64::INFINITY }), "height of the cylinder is inf"),
        (Shape::Cone(Cone { radius: 0.0, height: 1.0 }), "radius of the cone is 0"),
        (Shape::Capsule(Capsule { radius: 1.0, height: -2.0 }), "height of the capsule is -2"),
        (Shape::Torus(Torus { major_radius: 1.0, minor_radius: 1.0 }), "major_radius must be the larger"),
        (Shape::Union(Union::default()), "the union is empty"),
        (Shape::Points(Points::default()), "the set of points is empty"),
        (Shape::Points(Points { points: vec![MassPoint { mass: 0.0, at: Vec3::zeros() }] }), "point 0"),
    ];
    for (shape, message) in wrong {
        let error = shape.validate().unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn wrong_parts_are_named() {
    let good = UnionPart { shape: cuboid(1.0, 1.0, 1.0), offset: Vec3::zeros(), rotation: rotation(), density: 1.0 };
    let error = |part: UnionPart| match Shape::Union(Union { parts: vec![good.clone(), part] }).validate() {
        Err(ShapeError::Member { index: 1, source, .. }) => *source,
        other => panic!("{other:?}"),
    };
    let mirrored = error(UnionPart { rotation: -rotation(), ..good.clone() });
    assert!(matches!(mirrored, ShapeError::NotARotation { determinant, .. } if determinant < 0.0), "{mirrored}");
    assert!(matches!(
        error(UnionPart { rotation: rotation() * 1.001, ..good.clone() }),
        ShapeError::NotARotation { .. }
    ));
    assert!(matches!(error(UnionPart { density: -1.0, ..good.clone() }), ShapeError::NotPositive { .. }));
    assert!(matches!(
        error(UnionPart { offset: Vec3::repeat(f64::NAN), ..good.clone() }),
        ShapeError::NotFinite { .. }
    ));
    assert!(matches!(
        error(UnionPart { shape: cuboid(0.0, 1.0, 1.0), ..good.clone() }),
        ShapeError::NotPositive { .. }
    ));
}

#[test]
fn wrong_polyhedra_are_named() {
    let good = corner_tetrahedron(1.0);
    let with = |change: &dyn Fn(&mut Polyhedron)| {
        let mut changed = good.clone();
        change(&mut changed);
        changed.validate().unwrap_err()
    };
    assert!(matches!(with(&|it| it.vertices[2].x = f64::NAN), PolyhedronError::NotFinite { vertex: 2, .. }));
    assert!(matches!(with(&|it| it.triangles[1][0] = 4), PolyhedronError::NoSuchVertex { triangle: 1, index: 4, .. }));
    assert!(matches!(with(&|it| it.triangles[3] = [1, 2, 1]), PolyhedronError::RepeatedVertex { triangle: 3 }));
    assert!(matches!(with(&|it| it.triangles.truncate(3)), PolyhedronError::TooFew { triangles: 3, .. }));
    assert!(matches!(with(&|it| it.triangles[0] = [1, 3, 2]), PolyhedronError::Open { count: 2, .. }));
    assert!(matches!(with(&|it| it.triangles[0].swap(0, 1)), PolyhedronError::Misoriented { count: 3, .. }));
    assert!(matches!(with(&|it| it.vertices[3].z = 0.0), PolyhedronError::NoVolume { .. }));
    assert!(matches!(with(&|it| *it = it.flipped()), PolyhedronError::InsideOut { .. }));
    let doubled = with(&|it| it.triangles.extend_from_slice(&good.triangles));
    assert!(matches!(doubled, PolyhedronError::NonManifold { count: 6, .. }), "{doubled}");
}

#[test]
fn sharpest_features_and_their_exponents_are_those_of_the_theory() {
    let expected = [
        (Feature::Vertex, 3.0),
        (Feature::SmoothPoint, 2.0),
        (Feature::SmoothPoint, 2.0),
        (Feature::Rim, 2.5),
        (Feature::Apex, 3.0),
        (Feature::SmoothPoint, 2.0),
        (Feature::SmoothPoint, 2.0),
        (Feature::Vertex, 3.0),
        (Feature::Vertex, 3.0),
    ];
    for (shape, (feature, exponent)) in solids(1.0).iter().zip(expected) {
        assert_eq!(shape.sharpest_feature().map(Feature::critical_exponent), Some(exponent), "{shape:?}");
        assert_eq!(shape.sharpest_feature(), Some(feature), "{shape:?}");
    }
    assert_eq!(points().sharpest_feature(), None);
    assert!(points().surface().is_none());
}

/// Directions of all kinds: axes, diagonals and some without any symmetry.
fn directions() -> Vec<Vec3> {
    let mut directions = Vec::new();
    for k in 0..27 {
        directions.push(Vec3::new((k % 3) as f64 - 1.0, (k / 3 % 3) as f64 - 1.0, (k / 9) as f64 - 1.0));
    }
    directions.retain(|direction| direction.norm() > 0.0);
    directions
        .extend((1..40).map(|k| Rotation3::new(Vec3::new(0.7, 0.2, 0.4) * f64::from(k)) * Vec3::new(0.36, 0.48, 0.8)));
    directions
}

#[test]
fn extent_is_the_lowest_point_of_the_surface() {
    for shape in solids(1.0) {
        let surface = shape.surface().unwrap();
        for direction in directions() {
            let (gap, _) = surface.smallest_gap(&GapField::new(5.0, direction));
            let expected = 5.0 - shape.extent(&-direction);
            // A gap of 5 m rounds to 1e-15 m, twice.
            assert!((gap - expected).abs() < 4e-15, "{shape:?} {direction}: {gap} {expected}");
        }
    }
}

#[test]
fn bounds_hold_the_shape_tightly() {
    let bounds = Shape::Cone(Cone { radius: 0.3, height: 0.8 }).bounds();
    assert_eq!((bounds.min, bounds.max), (Vec3::new(-0.3, -0.3, -0.4), Vec3::new(0.3, 0.3, 0.4)));
    let torus = Shape::Torus(Torus { major_radius: 0.7, minor_radius: 0.2 });
    assert_close("size of the torus", torus.size(), 1.8, 1e-15);
    let cylinder = Shape::Cylinder(Cylinder { radius: 0.3, height: 0.8 });
    let lying = UnionPart {
        shape: cylinder,
        offset: Vec3::x(),
        rotation: Rotation3::from_axis_angle(&Vec3::y_axis(), TAU / 4.0).into_inner(),
        density: 1.0,
    };
    let bounds = Shape::Union(Union { parts: vec![lying] }).bounds();
    assert!((bounds.min - Vec3::new(0.6, -0.3, -0.3)).norm() < 1e-15, "{}", bounds.min);
    assert!((bounds.max - Vec3::new(1.4, 0.3, 0.3)).norm() < 1e-15, "{}", bounds.max);
}

#[test]
fn pictures_stay_within_the_shape_and_reach_its_silhouette() {
    for shape in solids(1.0).into_iter().chain([points()]) {
        let (outline, silhouette) = (shape.outline(), shape.silhouette_points());
        assert!(silhouette.len() <= SILHOUETTE_POINTS && outline.points.len() <= 2000, "{shape:?}");
        assert!(outline.polylines.iter().flatten().all(|&index| index < outline.points.len()), "{shape:?}");
        assert!(outline.polylines.iter().all(|line| line.len() > 1), "{shape:?}");
        for direction in directions() {
            let (extent, unit) = (shape.extent(&direction), direction.norm());
            let farthest = |points: &[Vec3]| points.iter().map(|point| point.dot(&direction)).fold(f64::MIN, f64::max);
            let rounding = 1e-15 * unit;
            assert!(farthest(&outline.points) <= extent + rounding, "{shape:?} {direction}");
            let short = extent - farthest(&silhouette);
            // 400 points on a sphere leave gaps of 0.1 rad, which cut 0.1²/2 of the radius off.
            assert!(short >= -rounding && short <= 0.01 * shape.size() * unit, "{shape:?} {direction}: {short}");
        }
    }
}

#[test]
fn box_outline_has_twelve_edges_also_as_a_mesh() {
    let cuboid = Cuboid { size: Vec3::new(1.0, 2.0, 3.0) };
    let length = |outline: &Outline| -> f64 {
        let of_line = |line: &Vec<usize>| (outline.points[line[0]] - outline.points[line[1]]).norm();
        outline.polylines.iter().map(of_line).sum()
    };
    assert_eq!((cuboid.outline().polylines.len(), length(&cuboid.outline())), (12, 24.0));
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mesh = Polyhedron { vertices: cuboid.silhouette_points(), triangles };
    assert_eq!(mesh.validate(), Ok(()));
    assert_eq!((mesh.outline().polylines.len(), length(&mesh.outline())), (12, 24.0));
    assert!(difference(&mesh.mass_properties(DENSITY), &cuboid.mass_properties(DENSITY), 3.0) < 1e-15);
}

#[test]
fn outline_of_a_large_mesh_is_thinned() {
    let torus = Shape::Torus(Torus { major_radius: 0.7, minor_radius: 0.2 });
    let outline = approximated(&torus, 100).outline();
    assert!(!outline.polylines.is_empty(), "a smooth mesh is not invisible");
    assert!(outline.points.len() <= 2000, "{}", outline.points.len());
}
