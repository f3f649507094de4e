//! Friction whose matrix changes with the place of a body and with time.
//!
//!   (f; Dᵀ row by row) = −H(p₀, P, t) (ṗ₀; L row by row)
//!   ∂Q/∂q_k = that of H held + the load of ∂H/∂q_k
//!
//! H is a constant matrix times a formula, or a matrix of formulas. It must be symmetric and positive semi-definite
//! wherever the body goes, which [`OwnFriction::check`] tells: with H that feeds energy in the model is left.

use super::formula::Formula;
use super::resistance::{Frame, LinearResistance, Mat12, ResistanceError, mirrored};
use super::{COORDINATES, LoadSlopes, Loads};
use crate::kinematics::{Placement, Velocity};
use crate::tensor::Mat3;
use gyration_expression::{Scratch, Undefined};

/// A pivot below this part of the largest diagonal entry is rounding.
const DEFINITENESS_TOLERANCE: f64 = 1e-12;

/// An entry of a matrix of formulas.
#[derive(Debug, Clone, PartialEq)]
pub enum FrictionEntry {
    /// The same at all places and times.
    Constant(f64),
    /// A formula.
    Formula(Box<Formula>),
}

/// H of a place and a time.
#[derive(Debug, Clone, PartialEq)]
pub enum FrictionMatrix {
    /// A constant matrix times a formula.
    Scaled(Box<Mat12>, Formula),
    /// A formula an entry, row by row.
    Entries(Box<[[FrictionEntry; COORDINATES]; COORDINATES]>),
}

/// A friction that changes with the place of the body and with time.
#[derive(Debug, Clone, PartialEq)]
pub struct OwnFriction {
    matrix: FrictionMatrix,
    frame: Frame,
}

/// Why a matrix of formulas is no friction at a place.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum FrictionFault {
    /// It has no value.
    #[error("{0}")]
    Undefined(#[from] Undefined),
    /// It is not symmetric.
    #[error("{0}")]
    NotSymmetric(#[from] ResistanceError),
    /// It is not positive semi-definite.
    #[error("the matrix is not positive semi-definite: the pivot of row {row} is {pivot:e} (counted from 0)")]
    Indefinite {
        /// The row where Cholesky's elimination ends.
        row: usize,
        /// Its pivot there, or what stands beside a pivot that is zero.
        pivot: f64,
    },
}

impl OwnFriction {
    /// True if t stands in it.
    pub fn uses_time(&self) -> bool {
        match &self.matrix {
            FrictionMatrix::Scaled(_, formula) => formula.uses_time(),
            FrictionMatrix::Entries(rows) => rows.iter().flatten().any(|entry| match entry {
                FrictionEntry::Constant(_) => false,
                FrictionEntry::Formula(formula) => formula.uses_time(),
            }),
        }
    }

    /// A friction of this matrix in these axes.
    pub fn new(matrix: FrictionMatrix, frame: Frame) -> Self {
        Self { matrix, frame }
    }

    /// H at a place.
    fn at(&self, place: &Placement, time: f64, scratch: &mut Scratch) -> Result<Mat12, Undefined> {
        match &self.matrix {
            FrictionMatrix::Scaled(matrix, scale) => Ok(**matrix * scale.value(place, time, scratch)?),
            FrictionMatrix::Entries(entries) => {
                let mut matrix = Mat12::zeros();
                for (row, entries) in entries.iter().enumerate() {
                    for (column, entry) in entries.iter().enumerate() {
                        matrix[(row, column)] = match entry {
                            FrictionEntry::Constant(value) => *value,
                            FrictionEntry::Formula(formula) => formula.value(place, time, scratch)?,
                        };
                    }
                }
                Ok(matrix)
            }
        }
    }

    /// f and M at a place, with P⁻¹ given.
    ///
    /// # Errors
    /// [`Undefined`] where H has no finite value.
    pub fn loads(
        &self,
        (place, time): (&Placement, f64),
        inverse: &Mat3,
        velocity: &Velocity,
        scratch: &mut Scratch,
    ) -> Result<Loads, Undefined> {
        let held = LinearResistance::of_matrix(self.at(place, time, scratch)?, self.frame);
        Ok(held.loads(&place.gradient, inverse, velocity))
    }

    /// Tests that it is a friction at a place.
    ///
    /// # Errors
    /// [`FrictionFault`] where it has no value, is not symmetric, or has a negative pivot.
    pub fn check(&self, place: &Placement, time: f64, scratch: &mut Scratch) -> Result<(), FrictionFault> {
        let mut matrix = mirrored(&self.at(place, time, scratch)?, 1.0)?;
        // Cholesky with the largest pivot first: what is left of a semi-definite matrix behind its rank is zero.
        let largest = matrix.diagonal().amax();
        let mut left: [bool; COORDINATES] = [true; COORDINATES];
        for _ in 0..COORDINATES {
            let open = (0..COORDINATES).filter(|row| left[*row]);
            let chosen = open.clone().max_by(|a, b| matrix[(*a, *a)].total_cmp(&matrix[(*b, *b)]));
            let Some(row) = chosen else { break };
            let rounding = DEFINITENESS_TOLERANCE * largest;
            let pivot = matrix[(row, row)];
            if pivot <= rounding {
                let worst = open
                    .flat_map(|a| (0..COORDINATES).filter(|b| left[*b]).map(move |b| (a, b)))
                    .map(|(a, b)| (a, if a == b { -matrix[(a, b)] } else { matrix[(a, b)].abs() }))
                    .max_by(|a, b| a.1.total_cmp(&b.1));
                return match worst {
                    Some((row, excess)) if excess > rounding || largest == 0.0 && excess > 0.0 => {
                        Err(FrictionFault::Indefinite { row, pivot: -excess })
                    }
                    _ => Ok(()),
                };
            }
            left[row] = false;
            for a in (0..COORDINATES).filter(|a| left[*a]) {
                let part = matrix[(a, row)] / pivot;
                for b in (0..COORDINATES).filter(|b| left[*b]) {
                    matrix[(a, b)] -= part * matrix[(row, b)];
                }
            }
        }
        Ok(())
    }
}

impl LoadSlopes {
    /// Adds a friction that changes with the place.
    ///
    /// # Errors
    /// [`Undefined`] where H has no first derivative.
    pub fn add_own_friction(
        &mut self,
        friction: &OwnFriction,
        (place, time): (&Placement, f64),
        inverse: &Mat3,
        velocity: &Velocity,
        scratch: &mut Scratch,
    ) -> Result<(), Undefined> {
        let held = |matrix: Mat12| LinearResistance::of_matrix(matrix, friction.frame);
        let loads = |matrix: Mat12| held(matrix).loads(&place.gradient, inverse, velocity);
        match &friction.matrix {
            FrictionMatrix::Scaled(matrix, scale) => {
                let (value, gradient) = scale.gradient(place, time, scratch)?;
                self.add_resistance(&held(**matrix * value), (place, inverse, velocity));
                let plain = loads(**matrix);
                for (coordinate, slope) in gradient.iter().enumerate().filter(|(_, slope)| **slope != 0.0) {
                    self.add_by_place(coordinate, &plain.scaled(*slope));
                }
            }
            FrictionMatrix::Entries(entries) => {
                let mut slopes = [Mat12::zeros(); COORDINATES];
                for (row, entries) in entries.iter().enumerate() {
                    for (column, entry) in entries.iter().enumerate() {
                        let FrictionEntry::Formula(formula) = entry else { continue };
                        let (_, gradient) = formula.gradient(place, time, scratch)?;
                        for (coordinate, slope) in gradient.iter().enumerate() {
                            slopes[coordinate][(row, column)] = *slope;
                        }
                    }
                }
                self.add_resistance(&held(friction.at(place, time, scratch)?), (place, inverse, velocity));
                for (coordinate, slope) in slopes.into_iter().enumerate().filter(|(_, slope)| *slope != Mat12::zeros())
                {
                    self.add_by_place(coordinate, &loads(slope));
                }
            }
        }
        Ok(())
    }
}
