//! The triangles that show a shape: closed, outward, on the true surface, and as many as asked for.

#[allow(dead_code, reason = "what compares masses is not needed here")]
use std::collections::BTreeMap;

use crate::solids::{points, solids};
use gyration::shape::{Capsule, Cone, Cylinder, Shape, Torus, Triangulation};
use gyration::tensor::Vec3;

/// Needles, plates and rings that a spacing alone would not serve.
fn slender() -> Vec<Shape> {
    vec![
        Shape::Cylinder(Cylinder { radius: 0.3, height: 0.001 }),
        Shape::Cylinder(Cylinder { radius: 0.001, height: 1.0 }),
        Shape::Cone(Cone { radius: 1.0, height: 0.01 }),
        Shape::Cone(Cone { radius: 0.001, height: 1.0 }),
        Shape::Capsule(Capsule { radius: 0.3, height: 1e-6 }),
        Shape::Capsule(Capsule { radius: 0.001, height: 1.0 }),
        Shape::Torus(Torus { major_radius: 1.0, minor_radius: 0.999 }),
        Shape::Torus(Torus { major_radius: 1.0, minor_radius: 0.001 }),
    ]
}

fn is_exact(shape: &Shape) -> bool {
    matches!(shape, Shape::Box(_) | Shape::Polyhedron(_))
}

/// Every edge occurs once in each sense, and no triangle is without area.
fn assert_closed(surface: &Triangulation, what: &Shape) {
    let mut edges = BTreeMap::new();
    for triangle in &surface.triangles {
        let [a, b, c] = *triangle;
        for edge in [(a, b), (b, c), (c, a)] {
            *edges.entry(edge).or_insert(0) += 1;
        }
        let [a, b, c] = surface.corners(triangle);
        assert!((b - a).cross(&(c - a)).norm() > 0.0, "{what:?}: {triangle:?} has no area");
    }
    for (&(from, to), &count) in &edges {
        assert!(count == 1 && edges.get(&(to, from)) == Some(&1), "{what:?}: edge {from}–{to}");
    }
    let mut used: Vec<usize> = surface.triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    assert_eq!(used, (0..surface.points.len()).collect::<Vec<_>>(), "{what:?}: points without a triangle");
}

#[test]
fn surfaces_are_closed_and_have_about_as_many_triangles_as_asked_for() {
    for shape in solids(1.0).into_iter().chain(slender()) {
        let surface = shape.triangulation(1600);
        assert_closed(&surface, &shape);
        let (count, parts) = (surface.triangles.len(), if let Shape::Union(it) = &shape { it.parts.len() } else { 1 });
        println!("{count:5} triangles: {shape:?}");
        assert!(is_exact(&shape) || (900..=2100 * parts).contains(&count), "{shape:?}: {count} triangles");
    }
    assert_eq!(points().triangulation(1600), Triangulation::default());
}

#[test]
fn few_triangles_still_close() {
    for shape in solids(1.0).into_iter().chain(slender()) {
        for count in [0, 1, 50, 200] {
            assert_closed(&shape.triangulation(count), &shape);
        }
    }
}

#[test]
fn they_face_outward_and_enclose_the_volume() {
    for shape in solids(1.0) {
        let exact = shape.mass_properties(1.0);
        let deficit = |count: usize| 1.0 - shape.triangulation(count).volume() / exact.volume;
        let (coarse, fine) = (deficit(1600), deficit(25600));
        println!("{coarse:10.2e} {fine:10.2e} {shape:?}");
        if is_exact(&shape) {
            // Sums of a dozen products.
            assert!(coarse.abs() < 4e-16 && coarse == fine, "{shape:?}: {coarse:e}");
        } else {
            // A circle of 16 chords, the coarsest there is, covers 1 − (2π/16)²/6 = 0.974 of its area. Sixteen times
            // the triangles quarter every chord: a sixteenth of the error, where the least numbers did not refine it
            // before.
            assert!(coarse > 0.0 && coarse < 0.026, "{shape:?}: {coarse:e}");
            assert!(fine > 0.0 && fine < 0.15 * coarse, "{shape:?}: {coarse:e} to {fine:e}");
        }
    }
    for shape in slender() {
        let deficit = 1.0 - shape.triangulation(1600).volume() / shape.mass_properties(1.0).volume;
        println!("{deficit:10.2e} {shape:?}");
        assert!(deficit > 0.0 && deficit < 0.03, "{shape:?}: {deficit:e}");
    }
}

#[test]
fn points_lie_on_the_surface_and_reach_all_around() {
    for shape in solids(1.0) {
        let surface = shape.triangulation(1600);
        for k in 0..60 {
            let direction = Vec3::new(f64::from(k % 5) - 2.0, f64::from(k % 3) - 1.0, f64::from(k % 4) - 1.5);
            let (extent, unit) = (shape.extent(&direction), direction.norm());
            let farthest = surface.points.iter().map(|point| point.dot(&direction)).fold(f64::MIN, f64::max);
            assert!(farthest <= extent + 1e-15 * unit, "{shape:?}: outside by {:e}", farthest - extent);
            // Half a chord of 1/16 turn leaves 1 − cos(π/16) = 0.02 of a radius, which is less than half the size.
            assert!(extent - farthest < 0.01 * shape.size() * unit, "{shape:?}: short by {:e}", extent - farthest);
        }
    }
}

#[test]
fn subdivision_changes_nothing_but_the_number_of_triangles() {
    for shape in solids(1.0) {
        let coarse = shape.triangulation(100);
        let fine = coarse.subdivided(3);
        assert_closed(&fine, &shape);
        assert_eq!(fine.triangles.len(), 9 * coarse.triangles.len());
        // Some thousand terms of either sign.
        assert!((fine.volume() / coarse.volume() - 1.0).abs() < 1e-13, "{shape:?}");
    }
}

#[test]
fn points_over_a_triangle_lie_on_the_true_surface() {
    for shape in solids(1.0).into_iter().filter(|shape| !matches!(shape, Shape::Union(_))) {
        let surface = shape.triangulation(400);
        let mut deepest = 0.0_f64;
        let mut fine = 0.0;
        for triangle in &surface.triangles {
            let corners = surface.corners(triangle);
            // Divided in 8² sideways triangles each: the enclosed volume about the centre of the coarse surface.
            let at = |i: usize, j: usize| {
                let weights = [(8 - i - j) as f64 / 8.0, i as f64 / 8.0, j as f64 / 8.0];
                shape.over(&corners, &weights)
            };
            let signed = |a: Vec3, b: Vec3, c: Vec3| a.dot(&b.cross(&c)) / 6.0;
            for (i, j) in (0..8).flat_map(|i| (0..8 - i).map(move |j| (i, j))) {
                fine += signed(at(i, j), at(i + 1, j), at(i, j + 1));
                if i + j < 7 {
                    fine += signed(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                }
            }
            deepest = deepest.max((at(3, 3) - (corners[0] / 4.0 + (corners[1] + corners[2]) * 0.375)).norm());
        }
        let exact = shape.mass_properties(1.0).volume;
        let coarse = 1.0 - surface.volume() / exact;
        println!("{:.1e} → {:.1e}, bulge {deepest:.1e}: {shape:?}", coarse, 1.0 - fine / exact);
        // An eighth of the chords: a 64th of the deficit; sums of some thousand terms.
        assert!((1.0 - fine / exact).abs() <= 0.03 * coarse.abs() + 1e-13, "{shape:?}");
        assert!(is_exact(&shape) || deepest > 0.0);
    }
}

#[test]
fn a_triangulation_scales_with_its_shape() {
    for (small, large) in solids(1e-3).into_iter().zip(solids(1e3)) {
        let (small, large) = (small.triangulation(1600), large.triangulation(1600));
        assert_eq!(small.triangles, large.triangles);
        for (a, b) in small.points.iter().zip(&large.points) {
            assert!((a * 1e6 - b).norm() < 1e-12 * 1e3, "{a} {b}");
        }
    }
}
