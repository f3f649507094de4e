//! Loads that are linear in the velocity of the centre and the velocity gradient: general friction, and gyroscopic
//! loads.
//!
//! With x = (ṗ₀; L row by row), L = Ṗ P⁻¹, and a constant 12×12 matrix H,
//!
//!   (f; Dᵀ row by row) = −H x,   M = Dᵀ P⁻ᵀ,   power f·ṗ₀ + M·Ṗ = −x·H x
//!
//! Friction is a symmetric positive semi-definite H (Onsager), which never feeds energy in; a skew one works nothing.
//! In the frame of the body, x and (f; Dᵀ) are components along axes that turn with it: with P = R U, U symmetric, v′ =
//! Rᵀv, L′ = RᵀLR. Source: Sławianowski (1975), 4.6–4.9; `docs/theory-affine.md`.

use super::Loads;
use crate::kinematics::Velocity;
use crate::tensor::{Mat3, Polar, Vec3, cross_matrix};
use nalgebra::{SMatrix, SVector};

/// A 12×12 matrix on (velocity; L row by row).
pub type Mat12 = SMatrix<f64, 12, 12>;
type Vec12 = SVector<f64, 12>;

/// In which axes a resistance is constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Frame {
    /// Axes fixed in space.
    #[default]
    Space,
    /// Axes that turn with the body.
    Body,
}

/// A load −H (ṗ₀; L).
#[derive(Debug, Clone, PartialEq)]
pub struct LinearResistance {
    matrix: Mat12,
    frame: Frame,
    dissipates: bool,
}

/// A matrix that is no friction, or not gyroscopic.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ResistanceError {
    /// An entry is infinite or not a number.
    #[error("entry ({row}, {column}) is not finite (counted from 0)")]
    NotFinite {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
    },
    /// H ≠ Hᵀ.
    #[error(
        "the matrix is not symmetric: entry ({row}, {column}) is {value} and ({column}, {row}) is {mirrored} (counted \
            from 0)"
    )]
    NotSymmetric {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
        /// The entry.
        value: f64,
        /// Its mirror image.
        mirrored: f64,
    },
    /// H ≠ −Hᵀ.
    #[error(
        "the matrix is not skew: entry ({row}, {column}) is {value} and ({column}, {row}) is {mirrored} (counted from \
            0)"
    )]
    NotSkew {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
        /// The entry.
        value: f64,
        /// Its mirror image.
        mirrored: f64,
    },
    /// H has a negative eigenvalue.
    #[error("the matrix has the negative eigenvalue {eigenvalue}: such a friction would feed energy in")]
    NotSemiDefinite {
        /// The smallest eigenvalue.
        eigenvalue: f64,
    },
}

/// Asymmetry that is rounding, relative to the largest entry.
const SYMMETRY_TOLERANCE: f64 = 1e-9;
/// A negative eigenvalue that is rounding, relative to the largest one.
const DEFINITENESS_TOLERANCE: f64 = 1e-12;

/// Refuses a matrix that is not symmetric (`sense` = 1) or not skew (−1); returns its exact (skew-)symmetric part.
pub(crate) fn mirrored<const N: usize>(
    matrix: &SMatrix<f64, N, N>,
    sense: f64,
) -> Result<SMatrix<f64, N, N>, ResistanceError> {
    let tolerance = SYMMETRY_TOLERANCE * matrix.amax();
    for row in 0..N {
        for column in 0..N {
            let (value, mirrored) = (matrix[(row, column)], matrix[(column, row)]);
            if !value.is_finite() {
                return Err(ResistanceError::NotFinite { row, column });
            }
            if (value - sense * mirrored).abs() > tolerance {
                return Err(match sense > 0.0 {
                    true => ResistanceError::NotSymmetric { row, column, value, mirrored },
                    false => ResistanceError::NotSkew { row, column, value, mirrored },
                });
            }
        }
    }
    Ok(0.5 * (matrix + sense * matrix.transpose()))
}

/// Refuses the smallest of some eigenvalues if it is negative beyond rounding.
pub(crate) fn semi_definite(eigenvalues: &[f64]) -> Result<(), ResistanceError> {
    let (least, most) = eigenvalues
        .iter()
        .fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), value| (least.min(*value), most.max(value.abs())));
    if least < -DEFINITENESS_TOLERANCE * most {
        return Err(ResistanceError::NotSemiDefinite { eigenvalue: least });
    }
    Ok(())
}

impl LinearResistance {
    /// Friction.
    ///
    /// # Errors
    /// [`ResistanceError`] if H is not symmetric and positive semi-definite, naming the offending entry or eigenvalue.
    pub fn friction(matrix: &Mat12, frame: Frame) -> Result<Self, ResistanceError> {
        let matrix = mirrored(matrix, 1.0)?;
        semi_definite(
            nalgebra::DMatrix::from_column_slice(12, 12, matrix.as_slice()).symmetric_eigenvalues().as_slice(),
        )?;
        Ok(Self { matrix, frame, dissipates: true })
    }

    /// A gyroscopic (magnetic) load, which works nothing.
    ///
    /// # Errors
    /// [`ResistanceError`] if H is not skew.
    pub fn gyroscopic(matrix: &Mat12, frame: Frame) -> Result<Self, ResistanceError> {
        Ok(Self { matrix: mirrored(matrix, -1.0)?, frame, dissipates: false })
    }

    /// A friction of a matrix that is not checked.
    pub(super) fn of_matrix(matrix: Mat12, frame: Frame) -> Self {
        Self { matrix, frame, dissipates: true }
    }

    /// Whether it takes energy.
    pub fn dissipates(&self) -> bool {
        self.dissipates
    }

    /// f and M at P, with P⁻¹ given.
    pub fn loads(&self, gradient: &Mat3, inverse: &Mat3, velocity: &Velocity) -> Loads {
        let axes = self.axes(&Polar::of(gradient));
        let l = velocity.gradient_rate * inverse;
        let (force, couple) = self.act(&axes, &velocity.velocity, &l);
        Loads { force, moment: couple * inverse.transpose() }
    }

    /// The change of f and M with those of P and of the velocity.
    pub fn along(&self, at: (&Mat3, &Mat3, &Velocity), dp: &Mat3, dvelocity: &Velocity) -> Loads {
        let (gradient, inverse, velocity) = at;
        let l = velocity.gradient_rate * inverse;
        let spread = dp * inverse;
        let polar = Polar::of(gradient);
        let axes = self.axes(&polar);
        let (force, couple) = self.act(&axes, &velocity.velocity, &l);
        let (mut dforce, mut dcouple) =
            self.act(&axes, &dvelocity.velocity, &(dvelocity.gradient_rate * inverse - l * spread));
        if self.frame == Frame::Body {
            // The loads turn with the axes, and the velocity seen from them turns back.
            let turn = cross_matrix(&(polar.rotation * polar.turn(dp)));
            let (back, back_couple) = self.act(&axes, &(turn * velocity.velocity), &(turn * l - l * turn));
            dforce += turn * force - back;
            dcouple += turn * couple - couple * turn - back_couple;
        }
        Loads { force: dforce, moment: (dcouple - couple * spread.transpose()) * inverse.transpose() }
    }

    fn axes(&self, polar: &Polar) -> Mat3 {
        match self.frame {
            Frame::Space => Mat3::identity(),
            Frame::Body => polar.rotation,
        }
    }

    /// f and Dᵀ for a velocity and an L, in axes R.
    fn act(&self, axes: &Mat3, velocity: &Vec3, l: &Mat3) -> (Vec3, Mat3) {
        let (v, l) = (axes.tr_mul(velocity), axes.tr_mul(l) * axes);
        // The columns of the transpose are the rows of L.
        let x = Vec12::from_iterator(v.iter().chain(l.transpose().iter()).copied());
        let y = -(self.matrix * x);
        let couple = Mat3::from_row_iterator(y.iter().skip(3).copied());
        (axes * Vec3::new(y[0], y[1], y[2]), axes * couple * axes.transpose())
    }
}
