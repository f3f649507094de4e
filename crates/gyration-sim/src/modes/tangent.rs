//! Coordinates of a system within its joints: those of the velocities that all equations allow.
//!
//!   z = N y,   A N = 0,   NᵀN = 1,   A = ∂Ċ/∂ż
//!
//! The mass along z is one, and so it is along y. The rates of the numbers have the forces of the joints in them, and
//! their exact Jacobian what these change by. About rest, where the forces along y vanish,
//!
//!   Nᵀ δz̈ = Nᵀ (δa + δAᵀ λ) = −(Nᵀ K N) δy − (Nᵀ C N) δẏ
//!
//! with the multipliers λ of rest: the curvature of the equations is a part of the stiffness.

use super::coordinates::Coordinates;
use crate::singular_values::SingularValues;
use gyration::dynamics::JointEquation;
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// Singular values of A below this part of the largest are those of equations that follow from others: along z the mass
/// is one, so that they are of one size.
const DEPENDENT: f64 = 1e-7;
/// A pattern of which the joints leave less than this is rounding.
const NOTHING: f64 = 1e-9;

/// N: the z of bodies without joints as they are, in order, then a basis of what the joints leave of the others.
#[derive(Debug, Clone)]
pub(super) struct JointTangent {
    basis: DMatrix<f64>,
    /// The z of bodies without joints.
    untouched: Vec<usize>,
}

impl JointTangent {
    /// Within the equations of a configuration, given the coordinates of each body and where its z stand; none without
    /// equations.
    pub fn of(equations: &[JointEquation], bodies: &[(&Coordinates, Range<usize>)]) -> Option<Self> {
        if equations.is_empty() {
            return None;
        }
        let count = bodies.last().map_or(0, |(_, z)| z.end);
        let mut slopes = DMatrix::<f64>::zeros(equations.len(), count);
        let mut is_joined = vec![false; bodies.len()];
        for (row, equation) in equations.iter().enumerate() {
            for (body, slope) in equation.ends.iter().flatten() {
                let (coordinates, z) = &bodies[*body];
                let along = coordinates.rates().tr_mul(&slope.rows(0, coordinates.rates().nrows()));
                let mut place = slopes.view_mut((row, z.start), (1, z.len()));
                place += along.transpose();
                is_joined[*body] = true;
            }
        }
        let of = |joined: bool| {
            let bodies = bodies.iter().zip(&is_joined).filter(move |(_, own)| **own == joined);
            bodies.flat_map(|((_, z), _)| z.clone()).collect::<Vec<usize>>()
        };
        let (untouched, joined) = (of(false), of(true));
        let left = null_space(&slopes.select_columns(&joined));
        let mut basis = DMatrix::zeros(count, untouched.len() + left.ncols());
        untouched.iter().enumerate().for_each(|(column, row)| basis[(*row, column)] = 1.0);
        for (own, row) in joined.iter().enumerate() {
            basis.view_mut((*row, untouched.len()), (1, left.ncols())).copy_from(&left.row(own));
        }
        Some(Self { basis, untouched })
    }

    /// How many y there are.
    pub fn count(&self) -> usize {
        self.basis.ncols()
    }

    /// N.
    pub fn basis(&self) -> &DMatrix<f64> {
        &self.basis
    }

    /// Where a z that no joint touches stands among the y.
    pub fn place(&self, z: usize) -> Option<usize> {
        self.untouched.binary_search(&z).ok()
    }

    /// y of what a motion has within the joints; nothing where that is rounding.
    pub fn along(&self, z: &DVector<f64>) -> DVector<f64> {
        let along = self.basis.tr_mul(z);
        if along.norm() > NOTHING * z.norm() { along } else { DVector::zeros(along.len()) }
    }
}

/// An orthonormal basis of what a matrix takes to zero.
fn null_space(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let size = matrix.ncols();
    let mut kept = DMatrix::identity(size, size);
    if let Some(found) = SingularValues::of(matrix) {
        for k in found.above(DEPENDENT * found.largest()) {
            let direction = found.right(k);
            kept -= direction * direction.transpose();
        }
    }
    let eigen = kept.symmetric_eigen();
    let columns: Vec<usize> = (0..size).filter(|k| eigen.eigenvalues[*k] > 0.5).collect();
    eigen.eigenvectors.select_columns(&columns)
}
