//! Mass properties of every shape: references by another route, and the relations that all shapes obey.
//!
//! References: sections integrated with mpmath at 30 digits; bodies of revolution as polyhedra, which converge at second order.

use std::f64::consts::TAU;

use gyration::mass::{MassError, MassProperties};
use gyration::shape::{
    Capsule, Cone, Cuboid, Cylinder, Ellipsoid, Feature, MassPoint, Part, Points, Polyhedron, PolyhedronError,
    SILHOUETTE_POINTS, Shape, ShapeError, Sphere, Torus, Union,
};
use gyration::surface::GapField;
use gyration::tensor::{Mat3, Vec3};
use nalgebra::Rotation3;
use proptest::prelude::*;

const DENSITY: f64 = 1200.0;

fn cuboid(x: f64, y: f64, z: f64) -> Shape {
    Shape::Box(Cuboid { size: Vec3::new(x, y, z) })
}

fn rotation() -> Mat3 {
    Rotation3::from_euler_angles(0.3, -0.7, 1.1).into_inner()
}

/// The corner tetrahedron with legs a along the axes.
fn corner_tetrahedron(a: f64) -> Polyhedron {
    let vertices = vec![Vec3::zeros(), Vec3::x() * a, Vec3::y() * a, Vec3::z() * a];
    Polyhedron { vertices, triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] }
}

fn union_of(scale: f64) -> Shape {
    let part =
        |shape, z: f64, density| Part { shape, offset: Vec3::new(0.1, 0.0, z) * scale, rotation: rotation(), density };
    Shape::Union(Union {
        parts: vec![
            part(Shape::Cone(Cone { radius: 0.3 * scale, height: 0.8 * scale }), 0.5, 3.0),
            part(Shape::Sphere(Sphere { radius: 0.4 * scale }), -0.6, 1.5),
            part(cuboid(0.1 * scale, 0.5 * scale, 0.3 * scale), 0.0, 0.5),
        ],
    })
}

/// One of each shape with a volume, all lengths multiplied by `scale`.
fn solids(scale: f64) -> Vec<Shape> {
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

fn points() -> Shape {
    let at = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, -1.0], [1.0, 1.0, 1.0]];
    let point = |(k, at): (usize, [f64; 3])| MassPoint { mass: 1.0 + k as f64, at: at.into() };
    Shape::Points(Points { points: at.into_iter().enumerate().map(point).collect() })
}

fn assert_close(name: &str, value: f64, expected: f64, tolerance: f64) {
    let error = (value - expected).abs();
    assert!(error <= tolerance * expected.abs().max(1e-300), "{name}: {value} instead of {expected}, off by {error:e}");
}

/// Largest difference of two bodies, relative to mass, size and m·size².
fn difference(a: &MassProperties, b: &MassProperties, size: f64) -> f64 {
    let tensors = (a.euler_tensor - b.euler_tensor).amax() / (b.mass * size * size);
    let centers = (a.center - b.center).norm() / size;
    tensors.max(centers).max((a.mass / b.mass - 1.0).abs())
}

#[test]
fn closed_forms_agree_with_integrated_sections() {
    // Shape, volume, height of the centre, ∫x² dV, ∫(z−z₀)² dV; the ellipsoid's ∫y² dV is checked by symmetry below.
    let references = [
        (1, 0.268082573106329023, 0.0, 0.00857864233940252874, 0.00857864233940252874),
        (2, 0.12566370614359173, 0.0, 0.00628318530717958648, 0.00100530964914873384),
        (3, 0.226194671058465113, 0.0, 0.00508938009881546505, 0.012063715789784806),
        (4, 0.0753982236861550377, -0.2, 0.00101787601976309301, 0.00180955736846772091),
        (5, 0.33929200658769767, 0.0, 0.00712513213834165106, 0.0423738017116191312),
        (6, 0.552697846461004083, 0.0, 0.143701440079861061, 0.00552697846461004083),
    ];
    let solids = solids(1.0);
    for (index, volume, height, xx, zz) in references {
        let (shape, mass) = (&solids[index], solids[index].mass_properties(DENSITY));
        let name = format!("{shape:?}");
        // A handful of products: a few units in the last place.
        let tolerance = 2e-15;
        assert_close(&name, mass.volume, volume, tolerance);
        assert_close(&name, mass.mass, DENSITY * volume, tolerance);
        assert!((mass.center - Vec3::z() * height).norm() <= 1e-16, "{name}: {}", mass.center);
        assert_close(&name, mass.euler_tensor[(0, 0)], DENSITY * xx, tolerance);
        assert_close(&name, mass.euler_tensor[(2, 2)], DENSITY * zz, tolerance);
        assert_eq!(mass.euler_tensor, Mat3::from_diagonal(&mass.euler_tensor.diagonal()), "{name}");
    }
    let ellipsoid = solids[2].mass_properties(1.0);
    assert_close("∫y² of the ellipsoid", ellipsoid.euler_tensor[(1, 1)], 0.00226194671058465113, 2e-15);
}

#[test]
fn tetrahedron_has_its_textbook_moments() {
    // ∫x² dV = 1/60 and ∫xy dV = 1/120 about the corner, the centroid at ¼: 1/160 and −1/480 about it.
    let mass = corner_tetrahedron(1.0).mass_properties(1.0);
    let expected = Mat3::from_diagonal_element(1.0 / 160.0 + 1.0 / 480.0) - Mat3::repeat(1.0 / 480.0);
    assert_close("volume", mass.volume, 1.0 / 6.0, 1e-15);
    assert!((mass.center - Vec3::repeat(0.25)).norm() < 1e-16, "{}", mass.center);
    assert!((mass.euler_tensor - expected).amax() < 1e-17, "{}", mass.euler_tensor);
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
fn approximated(shape: &Shape, n: usize) -> Polyhedron {
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

#[test]
fn polyhedra_inscribed_in_curved_shapes_converge_to_them_at_second_order() {
    for shape in &solids(1.0)[1..7] {
        let exact = shape.mass_properties(DENSITY);
        let error = |n: usize| difference(&approximated(shape, n).mass_properties(DENSITY), &exact, shape.size());
        let errors = [error(16), error(32), error(64)];
        let orders = [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()];
        println!("{shape:?}: errors {:.2e} {:.2e} {:.2e}, orders {orders:.4?}", errors[0], errors[1], errors[2]);
        // Chords inscribed in circles: c₂/n² + c₄/n⁴, whose second term is below 1 % at n = 32.
        assert!((orders[1] - 2.0).abs() < 0.01, "{shape:?}: {orders:?}");
    }
}

#[test]
fn mass_grows_with_the_cube_and_euler_tensor_with_the_fifth_power_of_scale() {
    for (unit, scaled) in solids(1.0).iter().zip(solids(1e-3)) {
        let (unit_mass, mass) = (unit.mass_properties(DENSITY), scaled.mass_properties(DENSITY));
        let expected = MassProperties {
            mass: unit_mass.mass * 1e-9,
            center: unit_mass.center * 1e-3,
            euler_tensor: unit_mass.euler_tensor * 1e-15,
            volume: unit_mass.volume * 1e-9,
        };
        let error = difference(&mass, &expected, scaled.size());
        assert!(error < 1e-15, "{scaled:?}: {error:e}");
        assert_close("volume", mass.volume, expected.volume, 2e-15);
    }
}

#[test]
fn mass_is_linear_in_density() {
    for shape in solids(1.0).into_iter().chain([points()]) {
        let (one, many) = (shape.mass_properties(1.0), shape.mass_properties(7.5));
        assert!(difference(&many, &one.scaled(7.5), shape.size()) < 1e-15, "{shape:?}");
        assert!(difference(&one.with_mass(3.0), &one.scaled(3.0 / one.mass), shape.size()) < 1e-15, "{shape:?}");
        assert_eq!(many.volume, one.volume);
    }
}

#[test]
fn turning_and_shifting_vertices_turns_and_shifts_mass_properties() {
    let offset = Vec3::new(0.4, -1.0, 2.0);
    for shape in &solids(1.0)[1..7] {
        let mesh = approximated(shape, 8);
        let moved =
            Polyhedron { vertices: mesh.vertices.iter().map(|x| rotation() * x + offset).collect(), ..mesh.clone() };
        let expected = mesh.mass_properties(DENSITY).transformed(&rotation(), &offset);
        let error = difference(&moved.mass_properties(DENSITY), &expected, shape.size());
        // Coordinates of up to 3 m round to 4e-16 m.
        assert!(error < 1e-14, "{shape:?}: {error:e}");
    }
}

#[test]
fn mesh_far_from_its_origin_loses_nothing() {
    // 2³⁰ m away the coordinates of this cube are still exact, while X·X would cancel from 1e18 to 1/12.
    let offset = Vec3::new(1.0, -1.0, 0.5) * 2_f64.powi(30);
    let near = Polyhedron { vertices: corner_tetrahedron(1.0).vertices, ..corner_tetrahedron(1.0) };
    let far = Polyhedron { vertices: near.vertices.iter().map(|x| x + offset).collect(), ..near.clone() };
    let (near, far) = (near.mass_properties(1.0), far.mass_properties(1.0));
    assert!((near.euler_tensor - far.euler_tensor).amax() < 1e-15, "{}", far.euler_tensor - near.euler_tensor);
    assert_close("volume", far.volume, near.volume, 1e-15);
}

#[test]
fn halves_of_a_box_add_up_to_it() {
    let half = |x: f64, density| Part {
        shape: cuboid(0.5, 0.4, 0.3),
        offset: Vec3::x() * x,
        rotation: Mat3::identity(),
        density,
    };
    let whole = cuboid(1.0, 0.4, 0.3).mass_properties(DENSITY);
    let union = Shape::Union(Union { parts: vec![half(-0.25, DENSITY), half(0.25, DENSITY)] });
    assert!(difference(&union.mass_properties(1.0), &whole, 1.0) < 1e-15);
    // Densities 1 and 3: the centre moves by a quarter of the distance.
    let uneven = Shape::Union(Union { parts: vec![half(-0.25, 1.0), half(0.25, 3.0)] }).mass_properties(1.0);
    assert!((uneven.center - Vec3::x() * 0.125).norm() < 1e-16, "{}", uneven.center);
}

#[test]
fn euler_tensor_about_a_point_is_the_second_moment_there() {
    // The corner tetrahedron about its corner: ∫x² dV = 1/60, ∫xy dV = 1/120.
    let mass = corner_tetrahedron(1.0).mass_properties(1.0);
    let expected = Mat3::from_diagonal_element(1.0 / 120.0) + Mat3::repeat(1.0 / 120.0);
    assert!((mass.about(&Vec3::zeros()) - expected).amax() < 1e-17, "{}", mass.about(&Vec3::zeros()));
}

#[test]
fn inertia_of_a_sphere_is_two_fifths() {
    let mass = Shape::Sphere(Sphere { radius: 0.1 }).mass_properties(DENSITY);
    let expected = Mat3::identity() * (0.4 * mass.mass * 0.01);
    assert!((mass.inertia() - expected).amax() < 1e-15 * expected.amax(), "{}", mass.inertia());
}

#[test]
fn points_sum_to_their_moments() {
    let two = |mass: f64, at: f64| MassPoint { mass, at: Vec3::z() * at };
    let dumbbell = Points { points: vec![two(1.0, 0.0), two(3.0, 1.0)] }.mass_properties(1.0);
    assert_eq!((dumbbell.mass, dumbbell.center.z, dumbbell.volume), (4.0, 0.75, 0.0));
    assert!((dumbbell.euler_tensor[(2, 2)] - 0.75).abs() < 1e-16, "reduced mass times distance squared");
    assert_eq!(dumbbell.rank(), 1);
    assert_eq!(points().mass_properties(1.0).rank(), 3);
    assert_eq!(Points { points: vec![two(1.0, 5.0)] }.mass_properties(1.0).rank(), 0);
}

#[test]
fn principal_axes_rebuild_the_tensor() {
    let mass = union_of(1.0).mass_properties(1.0);
    let principal = mass.principal();
    let rebuilt = principal.axes * Mat3::from_diagonal(&principal.values) * principal.axes.transpose();
    // An iterative eigensolver: a few dozen roundings.
    assert!((rebuilt - mass.euler_tensor).amax() < 1e-14 * mass.euler_tensor.amax());
    assert!((principal.axes.determinant() - 1.0).abs() < 1e-14);
    assert!(principal.values[0] <= principal.values[1] && principal.values[1] <= principal.values[2]);
}

#[test]
fn impossible_mass_properties_are_named() {
    let good = cuboid(1.0, 2.0, 3.0).mass_properties(1.0);
    assert_eq!(good.validate(), Ok(()));
    for value in [0.0, -1.0, f64::INFINITY] {
        assert_eq!(MassProperties { mass: value, ..good }.validate(), Err(MassError::MassNotPositive { value }));
    }
    let volume = MassProperties { volume: -1.0, ..good };
    assert_eq!(volume.validate(), Err(MassError::VolumeNegative { value: -1.0 }));
    let center = MassProperties { center: Vec3::new(0.0, f64::INFINITY, 0.0), ..good };
    assert!(matches!(center.validate(), Err(MassError::NotFinite { quantity: "center of mass", .. })));
    let mut skewed = good;
    skewed.euler_tensor[(0, 2)] = 0.1;
    let expected = MassError::NotSymmetric { row: 0, column: 2, value: 0.1, mirrored: 0.0 };
    assert_eq!(skewed.validate(), Err(expected));
    // The Euler tensor of inertia diag(1, 1, 3): no mass can have 3 > 1 + 1.
    let tensor = Mat3::from_diagonal(&Vec3::new(1.5, 1.5, -0.5));
    let Err(MassError::NotPositive { value }) = (MassProperties { euler_tensor: tensor, ..good }).validate() else {
        panic!("a negative principal value passed");
    };
    assert!((value + 0.5).abs() < 1e-15, "{value}");
}

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
    let good = Part { shape: cuboid(1.0, 1.0, 1.0), offset: Vec3::zeros(), rotation: rotation(), density: 1.0 };
    let error = |part: Part| match Shape::Union(Union { parts: vec![good.clone(), part] }).validate() {
        Err(ShapeError::Member { index: 1, source, .. }) => *source,
        other => panic!("{other:?}"),
    };
    let mirrored = error(Part { rotation: -rotation(), ..good.clone() });
    assert!(matches!(mirrored, ShapeError::NotARotation { determinant, .. } if determinant < 0.0), "{mirrored}");
    assert!(matches!(error(Part { rotation: rotation() * 1.001, ..good.clone() }), ShapeError::NotARotation { .. }));
    assert!(matches!(error(Part { density: -1.0, ..good.clone() }), ShapeError::NotPositive { .. }));
    assert!(matches!(error(Part { offset: Vec3::repeat(f64::NAN), ..good.clone() }), ShapeError::NotFinite { .. }));
    assert!(matches!(error(Part { shape: cuboid(0.0, 1.0, 1.0), ..good.clone() }), ShapeError::NotPositive { .. }));
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
            let (gap, _) = surface.smallest_gap(&GapField { height: 5.0, direction });
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
    let lying = Part {
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
    let length = |outline: &gyration::shape::Outline| -> f64 {
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

proptest! {
    #[test]
    fn affine_images_of_a_polyhedron_have_the_images_of_its_moments(
        entries in prop::array::uniform9(-1.0..1.0_f64), shift in prop::array::uniform3(-10.0..10.0_f64),
    ) {
        let map = Mat3::from_row_slice(&entries) + Mat3::identity() * 2.0;
        let determinant = map.determinant();
        prop_assume!(determinant > 0.1);
        let mesh = approximated(&Shape::Cone(Cone { radius: 0.3, height: 0.8 }), 4);
        let image = Polyhedron { vertices: mesh.vertices.iter().map(|x| map * x + Vec3::from(shift)).collect(), ..mesh.clone() };
        let (before, after) = (mesh.mass_properties(1.0), image.mass_properties(1.0));
        let expected = MassProperties {
            mass: before.mass * determinant,
            center: map * before.center + Vec3::from(shift),
            euler_tensor: map * before.euler_tensor * map.transpose() * determinant,
            volume: before.volume * determinant,
        };
        // Coordinates of 10 m round to 2e-15 m in a body of at least 0.03 m.
        prop_assert!(difference(&after, &expected, 1.0) < 1e-11, "{:e}", difference(&after, &expected, 1.0));
    }

    #[test]
    fn combining_bodies_does_not_depend_on_the_origin(
        offset in prop::array::uniform3(-3.0..3.0_f64), arm in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let (cone, cube) = (Cone { radius: 0.3, height: 0.8 }.mass_properties(2.0), cuboid(1.0, 0.5, 0.2).mass_properties(1.0));
        let moved = |body: MassProperties, by: Vec3| body.transformed(&Mat3::identity(), &by);
        let (arm, offset) = (Vec3::from(arm), Vec3::from(offset));
        let sum = moved(cone.combined(&moved(cube, arm)), offset);
        let other = moved(moved(cube, arm), offset).combined(&moved(cone, offset));
        prop_assert!(difference(&other, &sum, 1.0) < 1e-13);
        // About any point the tensors simply add.
        let about = cone.about(&offset) + moved(cube, arm).about(&offset);
        prop_assert!((cone.combined(&moved(cube, arm)).about(&offset) - about).amax() < 1e-13 * about.amax().max(1.0));
    }
}
