//! Mass properties of every shape: references by another route, and the relations that all shapes obey.
//!
//! References: sections integrated with mpmath at 30 digits; bodies of revolution as polyhedra, which converge at
//! second order.

#![allow(clippy::excessive_precision, reason = "references keep the digits they were computed with")]

use crate::solids::{
    DENSITY, approximated, assert_close, corner_tetrahedron, cuboid, difference, points, rotation, solids, union_of,
};
use gyration::mass::{MassError, MassProperties};
use gyration::shape::{Cone, MassPoint, Points, Polyhedron, Shape, Sphere, Union, UnionPart};
use gyration::tensor::{Mat3, Vec3};
use proptest::prelude::*;

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
    let half = |x: f64, density| UnionPart {
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
