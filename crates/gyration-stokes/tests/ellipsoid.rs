//! Ellipsoids against the closed form: accuracy, and what the estimate of the error is worth.

use crate::reference;
use gyration_stokes::{ClosedSurface, Faces, StokesError, StokesOptions, StokesResistance};

const SHAPES: [[f64; 3]; 4] = [[2.0, 1.0, 1.0], [1.0, 0.5, 0.2], [5.0, 1.0, 1.0], [1.3, 0.8, 1.0]];

fn measured(axes: [f64; 3], refinements: u32, faces: Faces) -> Result<(StokesResistance, f64), StokesError> {
    let resistance = ClosedSurface::ellipsoid(axes, refinements)?
        .resistance(&StokesOptions { faces, ..StokesOptions::default() })?;
    let error = reference::largest_error(&reference::matrix(&resistance.matrix), &reference::ellipsoid(axes));
    Ok((resistance, error))
}

#[test]
fn closed_form_of_the_reference_is_that_of_the_sphere_and_symmetric() {
    use std::f64::consts::PI;
    let sphere = reference::ellipsoid([2.0; 3]);
    // The integrals converge to rounding.
    assert!((sphere[(0, 0)] / (12.0 * PI) - 1.0).abs() < 1e-12);
    assert!(((sphere[(4, 4)] - sphere[(4, 6)]) / (32.0 * PI) - 1.0).abs() < 1e-12);
    let triaxial = reference::ellipsoid([1.0, 0.5, 0.2]);
    assert!((triaxial - triaxial.transpose()).amax() < 1e-12 * triaxial.amax());
}

#[test]
fn ellipsoids_of_320_triangles_are_right_within_their_estimates() {
    for axes in SHAPES {
        let (resistance, error) = measured(axes, 2, Faces::Curved).unwrap();
        println!("{axes:?}: error {error:.2e}, estimate {:.2e}", resistance.error);
        assert!(error < 1e-2, "{axes:?}");
        assert!(error < resistance.error && resistance.error < 6.0 * error, "{axes:?}");
    }
}

#[test]
fn flat_triangles_give_less_than_the_ellipsoid() {
    for axes in SHAPES {
        let (resistance, error) = measured(axes, 2, Faces::Flat).unwrap();
        println!("{axes:?}: error {error:.2e}");
        // l²/8R of a sphere of 320 triangles, three times over for torques; affine for those stretched.
        assert!((0.03..0.04).contains(&error), "{axes:?}: {error}");
        let exact = reference::ellipsoid(axes);
        // Bodies inside a body have the smaller drag (Hill and Power 1956).
        assert!((0..3).all(|i| resistance.matrix[i][i] < exact[(i, i)]));
    }
}

#[test]
fn inflation_to_the_true_volume_removes_most_of_the_loss() {
    let axes = [2.0, 1.0, 1.0];
    let volume = 4.0 / 3.0 * std::f64::consts::PI * axes.iter().product::<f64>();
    let surface = ClosedSurface::ellipsoid(axes, 2).unwrap().inflated([0.0; 3], volume).unwrap();
    assert!((surface.volume() / volume - 1.0).abs() < 1e-14);
    let options = StokesOptions { faces: Faces::Flat, ..StokesOptions::default() };
    let matrix = reference::matrix(&surface.resistance(&options).unwrap().matrix);
    let error = reference::largest_error(&matrix, &reference::ellipsoid(axes));
    println!("inflated: error {error:.2e}");
    assert!(error < 0.01);
}
