//! A sphere against its closed forms: 6πR, 8πR³, 3V a strain, 4 Ṙ/R an area, and the traction of each.

use crate::reference;
use gyration_stokes::{ClosedSurface, Faces, StokesOptions};
use std::f64::consts::PI;

const VOLUME: f64 = 4.0 / 3.0 * PI;

fn close(measured: f64, exact: f64, tolerance: f64) {
    println!("{measured:.6} for {exact:.6}: {:.1e}", measured / exact - 1.0);
    assert!((measured / exact - 1.0).abs() < tolerance, "{measured} instead of {exact}");
}

#[test]
fn sphere_resists_translation_spin_strain_and_expansion_as_it_must() {
    let m = ClosedSurface::icosphere(2).unwrap().resistance(&StokesOptions::default()).unwrap().matrix;
    // The remainder after the first order in the rise, which is l²/8R = 0.011: some squares of it.
    let tolerance = 1e-3;
    close(m[0][0], 6.0 * PI, tolerance);
    // L = ω× about z: L₁₂ = −L₂₁ = −1.
    close(m[4][4] + m[6][6] - m[4][6] - m[6][4], 8.0 * PI, tolerance);
    // E = x y + y x, E:E = 2; E = x x − y y.
    close(m[4][4] + m[6][6] + m[4][6] + m[6][4], 3.0 * VOLUME * 2.0, tolerance);
    close(m[3][3] + m[7][7] - m[3][7] - m[7][3], 3.0 * VOLUME * 2.0, tolerance);
    // L = I: −4 a unit area, whose moment has the trace −4·3V.
    let expansion: f64 = [3, 7, 11].iter().flat_map(|&i| [3, 7, 11].map(|j| m[i][j])).sum();
    close(expansion, 4.0 * 3.0 * VOLUME, tolerance);
    // Nothing couples velocity and gradient, or expansion and strain.
    let mixed: f64 = [3, 7, 11].iter().map(|&i| m[i][3] - m[i][7]).sum();
    assert!(mixed.abs() < 1e-3 && m[0][3].abs() < 1e-3 && m[0][8].abs() < 1e-3);
}

#[test]
fn tractions_of_a_sphere_are_uniform_under_translation_and_expansion() {
    let surface = ClosedSurface::icosphere(2).unwrap();
    let resistance = surface.resistance(&StokesOptions::default()).unwrap();
    let mut motion = [0.0; 12];
    motion[2] = 1.0;
    // −3/2R along the motion; nodal values of linear elements err by some squares of the mesh size of 0.3.
    let worst = |tractions: Vec<[[f64; 3]; 3]>, exact: &dyn Fn([f64; 3]) -> [f64; 3]| {
        let corners = surface.triangles();
        let points = surface.points();
        let mut worst = 0.0_f64;
        for (t, at) in tractions.iter().zip(&corners) {
            for (t, &corner) in t.iter().zip(at) {
                let exact = exact(points[corner as usize]);
                (0..3).for_each(|a| worst = worst.max((t[a] - exact[a]).abs()));
            }
        }
        println!("largest error of a traction {worst:.1e}");
        worst
    };
    assert!(worst(resistance.tractions(&motion), &|_| [0.0, 0.0, -1.5]) < 0.1);
    let mut motion = [0.0; 12];
    [3, 7, 11].into_iter().for_each(|k| motion[k] = 1.0);
    assert!(worst(resistance.tractions(&motion), &|p| p.map(|x| -4.0 * x)) < 0.15);
}

#[test]
fn loss_of_flat_triangles_falls_with_the_square_of_the_mesh_size() {
    let exact = reference::ellipsoid([1.0; 3]);
    let error = |refinements| {
        let options = StokesOptions { faces: Faces::Flat, ..StokesOptions::default() };
        let matrix = ClosedSurface::icosphere(refinements).unwrap().resistance(&options).unwrap().matrix;
        reference::largest_error(&reference::matrix(&matrix), &exact)
    };
    let order = (error(1) / error(2)).log2();
    println!("order {order:.3}");
    assert!((order - 2.0).abs() < 0.15, "{order}");
}
