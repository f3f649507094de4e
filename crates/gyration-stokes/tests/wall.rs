//! A sphere near a plane wall: Brenner's series towards it, Faxén's expansion along it, and what a growing sphere
//! feels.

use crate::reference::{self, Mat12};
use gyration_stokes::{ClosedSurface, StokesError, StokesOptions, WallPlane};
use std::f64::consts::PI;

const WALL: WallPlane = WallPlane { point: [0.0; 3], normal: [0.0, 0.0, 2.0] };

/// A unit sphere with its centre at a height over the wall z = 0.
fn sphere(height: f64, refinements: u32) -> Result<Mat12, StokesError> {
    let surface = ClosedSurface::icosphere(refinements)?.moved(|[x, y, z]| [x, y, z + height])?;
    let options = StokesOptions { centre: [0.0, 0.0, height], wall: Some(WALL), ..StokesOptions::default() };
    Ok(reference::matrix(&surface.resistance(&options)?.matrix))
}

/// Drag towards the wall over 6πR (Brenner 1961, Maude 1961), cosh α the height of the centre in radii.
fn brenner(height: f64) -> f64 {
    let alpha = height.acosh();
    let term = |n: i32| {
        let k = f64::from(n);
        let half = (k + 0.5) * alpha;
        let numerator = 2.0 * (2.0 * half).sinh() + (2.0 * k + 1.0) * (2.0 * alpha).sinh();
        let denominator = 4.0 * half.sinh().powi(2) - ((2.0 * k + 1.0) * alpha.sinh()).powi(2);
        k * (k + 1.0) / ((2.0 * k - 1.0) * (2.0 * k + 3.0)) * (numerator / denominator - 1.0)
    };
    4.0 / 3.0 * alpha.sinh() * (1..60).map(term).sum::<f64>()
}

#[test]
fn sphere_moves_towards_the_wall_as_brenner_computed() {
    // α, his table, and the remainder of 320 triangles, steeper in a narrow gap.
    for (alpha, table, tolerance) in [(3.0_f64, 1.1252, 1e-3), (2.0, 1.4129, 1e-3), (1.0, 3.0361, 3e-3)] {
        let height = alpha.cosh();
        let (drag, exact) = (sphere(height, 2).unwrap()[(2, 2)] / (6.0 * PI), brenner(height));
        println!("height {height:.4}: {drag:.5} for {exact:.5}, {:+.1e}", drag / exact - 1.0);
        assert!((exact - table).abs() < 6e-5);
        assert!((drag / exact - 1.0).abs() < tolerance);
    }
}

#[test]
fn sphere_moves_along_the_wall_as_faxen_expanded() {
    for (height, tolerance) in [(10.0, 3e-4), (4.0, 5e-4)] {
        let drag = sphere(height, 2).unwrap()[(0, 0)] / (6.0 * PI);
        let near: f64 = 1.0 / height;
        let series = 1.0 - 9.0 / 16.0 * near + near.powi(3) / 8.0 - 45.0 / 256.0 * near.powi(4) - near.powi(5) / 16.0;
        println!("height {height}: {drag:.5} for {:.5}", 1.0 / series);
        // His terms end at the fifth power; the mesh errs by 3e-5 of the drag.
        assert!((drag * series - 1.0).abs() < tolerance);
    }
}

#[test]
fn sphere_spins_near_the_wall_as_expanded() {
    let (height, refinements) = (2.0_f64, 2);
    let m = sphere(height, refinements).unwrap();
    let spin = |i: usize, j: usize| {
        m[(3 + 3 * i + j, 3 + 3 * i + j)] + m[(3 + 3 * j + i, 3 + 3 * j + i)] - 2.0 * m[(3 + 3 * i + j, 3 + 3 * j + i)]
    };
    // About an axis along the wall 8π(1 + 5/16 h³), across it 8π(1 + 1/8 h³); the next terms are of order h⁻⁶.
    for (torque, series) in
        [(spin(1, 2), 1.0 + 5.0 / 16.0 / height.powi(3)), (spin(0, 1), 1.0 + 0.125 / height.powi(3))]
    {
        println!("{:.5} for {series:.5}", torque / (8.0 * PI));
        assert!((torque / (8.0 * PI) / series - 1.0).abs() < 5e-3);
    }
}

#[test]
fn growing_sphere_is_pushed_off_the_wall_by_its_image() {
    // The image of a source of 4πR²Ṙ flows past the centre with 3R²Ṙ/4h² away from the wall.
    let height = 20.0_f64;
    let m = sphere(height, 2).unwrap();
    let force = -(m[(2, 3)] + m[(2, 7)] + m[(2, 11)]);
    let expected = 6.0 * PI * 0.75 / height.powi(2) * brenner(height);
    println!("{force:.6} for {expected:.6}");
    // Curvature of the image's flow: R²/h².
    assert!((force / expected - 1.0).abs() < 5e-3);
    // Drag on growth: 16π, of which the wall changes a part of order R³/h³.
    let growth: f64 = [3, 7, 11].iter().flat_map(|&i| [3, 7, 11].map(|j| m[(i, j)])).sum();
    assert!((growth / (16.0 * PI) - 1.0).abs() < 1e-3);
}

#[test]
fn wall_makes_every_motion_harder() {
    let (near, far) = (sphere(1.3, 1).unwrap(), sphere(1e6, 1).unwrap());
    let free = ClosedSurface::icosphere(1).unwrap().resistance(&StokesOptions::default()).unwrap();
    assert_eq!(near, near.transpose());
    // A flow that must vanish on the wall as well dissipates more (Helmholtz); expansion is another flow.
    let lower = (near - far).remove_columns_at(&[3, 7, 11]).remove_rows_at(&[3, 7, 11]);
    assert!(lower.symmetric_eigenvalues().min() > -1e-6);
    // Its image is two million radii away.
    assert!((far - reference::matrix(&free.matrix)).amax() < 1e-4);
}

#[test]
fn wall_that_is_crossed_or_too_near_is_refused() {
    assert!(matches!(sphere(0.9, 1), Err(StokesError::WallCrossed { .. })));
    assert!(matches!(sphere(1.01, 1), Err(StokesError::WallTooNear { .. })));
    let wall = Some(WallPlane { point: [0.0; 3], normal: [0.0; 3] });
    let error = ClosedSurface::icosphere(0)
        .unwrap()
        .resistance(&StokesOptions { wall, ..StokesOptions::default() })
        .unwrap_err();
    assert!(matches!(error, StokesError::BadOption { .. }), "{error}");
}
