//! Eigenvalues of small systems with known answers: pairs, exact zeros, free motions that circle.

use super::super::canonical;
use super::*;

fn pairs(k: &DMatrix<f64>, c: &DMatrix<f64>) -> Vec<EigenMotion> {
    solve((k, c), &FirstOrder::none(k.nrows()), &canonical::basis(k, &[])).unwrap_or_else(|error| panic!("{error}"))
}

/// |λ² ξ + λ C ξ + K ξ| relative to the sizes of the three.
fn residual(pair: &EigenMotion, k: &DMatrix<f64>, c: &DMatrix<f64>) -> f64 {
    let complex = |matrix: &DMatrix<f64>| matrix.map(|entry| C64::new(entry, 0.0));
    let (value, shape) = (pair.eigenvalues[0], &pair.shape);
    let parts = [shape * (value * value), complex(c) * shape * value, complex(k) * shape];
    let size: f64 = parts.iter().map(|part| part.norm()).sum();
    parts.into_iter().reduce(|sum, part| sum + part).map_or(0.0, |sum| sum.norm()) / size
}

#[test]
fn coupled_pairs_solve_the_quadratic_problem() {
    // Neither matrix is symmetric, and their directions differ.
    let k = DMatrix::from_row_slice(3, 3, &[40.0, 3.0, 0.0, -3.0, 90.0, 5.0, 1.0, 5.0, 40.0]);
    let c = DMatrix::from_row_slice(3, 3, &[0.5, 0.2, -0.3, 0.2, 1.0, 0.1, 0.3, 0.1, 0.2]);
    let found = pairs(&k, &c);
    assert_eq!(found.len(), 3);
    for pair in &found {
        let residual = residual(pair, &k, &c);
        println!("{} residual {residual:.1e}", pair.eigenvalues[0]);
        // Rounding of a Schur form of order six.
        assert!(residual < 1e-12 && pair.motion == ModeBehaviour::Oscillates);
    }
}

#[test]
fn free_coordinates_keep_their_exact_zeros() {
    // A free coordinate that friction couples to another, as a ball that rolls: c (1, −a)⊗(1, −a).
    let along = DVector::from_vec(vec![1.0, -0.6, 0.0]);
    let c = 7.0 * &along * along.transpose();
    let mut k = DMatrix::zeros(3, 3);
    k[(2, 2)] = 1e8;
    let mut found = pairs(&k, &c);
    found.sort_by(|a, b| a.eigenvalues[1].re.total_cmp(&b.eigenvalues[1].re));
    let free: Vec<&EigenMotion> = found.iter().filter(|pair| pair.motion == ModeBehaviour::Free).collect();
    let [sliding, rolling] = free[..] else { panic!("{found:?}") };
    assert_eq!(rolling.eigenvalues, [C64::new(0.0, 0.0); 2].to_vec());
    // Rounding beside a stiffness of 1e8.
    assert!((sliding.eigenvalues[1].re + 7.0 * 1.36).abs() < 1e-12, "{}", sliding.eigenvalues[1]);
    let ratio = rolling.shape[1] / rolling.shape[0];
    assert!((ratio - C64::new(1.0 / 0.6, 0.0)).norm() < 1e-9, "{ratio}");
}

/// A charge in a magnetic field, coupled to strains that creep: one pair ±iω and one free displacement of the plane,
/// and all strains with rates of their own. Symptom: the displacement was missing, or strains were called free.
#[test]
fn free_coordinates_that_turn_into_one_another_are_one_oscillation_and_one_free_motion() {
    let field = DMatrix::from_row_slice(2, 2, &[0.0, -2.0, 2.0, 0.0]);
    let found = pairs(&DMatrix::zeros(2, 2), &field);
    let behaviours: Vec<ModeBehaviour> = found.iter().map(|pair| pair.motion).collect();
    assert_eq!(behaviours, [ModeBehaviour::Oscillates, ModeBehaviour::Free]);
    assert!((found[0].eigenvalues[0] - C64::new(0.0, 2.0)).norm() < 1e-15);
    assert_eq!(found[1].eigenvalues, vec![C64::new(0.0, 0.0); 2]);
    assert!((found[1].shape.norm() - 1.0).abs() < 1e-15);
    let (mut k, mut c) = (DMatrix::zeros(4, 4), DMatrix::zeros(4, 4));
    c.view_mut((0, 0), (2, 2)).copy_from(&field);
    (k[(2, 2)], k[(3, 3)]) = (100.0, 300.0);
    (c[(2, 2)], c[(3, 3)]) = (50.0, 80.0);
    for (i, j) in [(0, 2), (1, 3), (0, 3)] {
        (c[(i, j)], c[(j, i)]) = (0.01, -0.01);
    }
    let found = pairs(&k, &c);
    let count = |motion: ModeBehaviour| found.iter().filter(|pair| pair.motion == motion).count();
    let counts = [ModeBehaviour::Oscillates, ModeBehaviour::Free, ModeBehaviour::Creeps].map(count);
    assert_eq!(counts, [1, 1, 2], "{found:?}");
    let creeping = found.iter().filter(|pair| pair.motion == ModeBehaviour::Creeps);
    let products: Vec<f64> = creeping.map(|pair| (pair.eigenvalues[0] * pair.eigenvalues[1]).re).collect();
    // λ₁ λ₂ = k, but for the square of the coupling.
    assert!(products.iter().any(|it| (it - 100.0).abs() < 1e-3), "{products:?}");
    assert!(products.iter().any(|it| (it - 300.0).abs() < 1e-3), "{products:?}");
}

#[test]
fn slow_creep_beside_fast_decay_keeps_its_digits() {
    let (k, c) = (DMatrix::from_element(1, 1, 1e-4), DMatrix::from_element(1, 1, 1e6));
    let [pair] = &pairs(&k, &c)[..] else { panic!("one pair") };
    assert_eq!(pair.motion, ModeBehaviour::Creeps);
    assert!((pair.eigenvalues[0].re / -1e-10 - 1.0).abs() < 1e-15, "{}", pair.eigenvalues[0]);
}
