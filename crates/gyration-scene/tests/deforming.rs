//! The resistance of a shape that deforms: what is interpolated against what is computed, at forms that are no nodes.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic as the tests themselves may")]

use gyration::fluid::{Resolution, largest_error};
use gyration::shape::{Cuboid, Shape};
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::deforming::DeformingSurface;

const TOLERANCE: f64 = 2e-2;

/// A symmetric matrix of determinant 1, of stretches up to about 1.5.
fn form(n: usize) -> Mat3 {
    let root = Mat3::from_fn(|i, j| 0.2 * (2.9 * n as f64 + 1.7 * (3 * i + j) as f64).sin());
    let form = Mat3::identity() + 0.5 * (root + root.transpose());
    form / form.determinant().cbrt()
}

fn largest(shape: &Shape) -> f64 {
    let surface = DeformingSurface::new(shape, 80);
    let table = surface.clone().table(Resolution { tolerance: TOLERANCE, spacing: None }).unwrap();
    let errors = (0..3).map(|n| {
        let exact = surface.resistance(&form(n)).unwrap().matrix;
        largest_error(&table.matrix(&form(n)).unwrap(), &exact)
    });
    let largest = errors.fold(0.0, f64::max);
    println!(
        "{shape:?}: largest error {largest:.1e} of a tolerance of {TOLERANCE:.0e}, {:?} nodes and simplices",
        table.size()
    );
    largest
}

#[test]
fn interpolated_resistances_of_a_box_are_within_the_tolerance() {
    assert!(largest(&Shape::Box(Cuboid { size: Vec3::new(2.0, 1.0, 1.5) })) < TOLERANCE);
}
