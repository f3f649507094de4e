//! Formulas of the place of a body and of time, V(x, y, z, P_xx … P_zz, t), and their derivatives in q = (p₀ | P).
//!
//! x, y, z [m] are p₀, and P_ij is row i, column j of the placement gradient. Where a formula has no finite value or
//! derivative, the state is outside the model.

use super::COORDINATES;
use crate::kinematics::Placement;
use gyration_expression::{Expression, ParseError, Scratch, Undefined};
use nalgebra::{SMatrix, SVector};

/// The numbers that a formula of a place may have.
pub const PLACE_NAMES: [&str; 13] =
    ["x", "y", "z", "P_xx", "P_xy", "P_xz", "P_yx", "P_yy", "P_yz", "P_zx", "P_zy", "P_zz", "t"];

/// The index of t among them.
const TIME: usize = 12;

/// A formula of the place of a body and of time.
#[derive(Debug, Clone, PartialEq)]
pub struct Formula {
    expression: Expression,
    uses_time: bool,
}

/// Value, gradient and second derivatives of a formula in the coordinates q.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FormulaSlopes {
    pub(super) value: f64,
    pub(super) gradient: SVector<f64, COORDINATES>,
    pub(super) hessian: SMatrix<f64, COORDINATES, COORDINATES>,
}

impl Formula {
    /// Reads a formula.
    ///
    /// # Errors
    /// [`ParseError`] with the column.
    pub fn parse(text: &str, constants: &[(String, f64)]) -> Result<Self, ParseError> {
        let expression = Expression::parse(text, &PLACE_NAMES, constants)?.holding(&[TIME]);
        let uses_time = expression.uses(TIME);
        Ok(Self { expression, uses_time })
    }

    /// True if t stands in it.
    pub fn uses_time(&self) -> bool {
        self.uses_time
    }

    /// True if the place stands in it.
    pub fn uses_place(&self) -> bool {
        self.expression.free().len() > 0
    }

    /// Its value.
    ///
    /// # Errors
    /// [`Undefined`] where there is none.
    pub fn value(&self, placement: &Placement, time: f64, scratch: &mut Scratch) -> Result<f64, Undefined> {
        self.expression.value(&numbers(placement, time), scratch)
    }

    /// Value and ∂/∂q.
    pub(super) fn gradient(
        &self,
        placement: &Placement,
        time: f64,
        scratch: &mut Scratch,
    ) -> Result<(f64, SVector<f64, COORDINATES>), Undefined> {
        let mut slopes = [0.0; PLACE_NAMES.len()];
        let value = self.expression.gradient(&numbers(placement, time), scratch, &mut slopes)?;
        let mut gradient = SVector::zeros();
        self.expression.free().for_each(|variable| gradient[coordinate(variable)] = slopes[variable]);
        Ok((value, gradient))
    }

    /// Value, ∂/∂q and ∂²/∂q².
    pub(super) fn slopes(
        &self,
        placement: &Placement,
        time: f64,
        scratch: &mut Scratch,
    ) -> Result<FormulaSlopes, Undefined> {
        const SIZE: usize = PLACE_NAMES.len();
        let (mut slopes, mut bends) = ([0.0; SIZE], [0.0; SIZE * SIZE]);
        let value = self.expression.hessian(&numbers(placement, time), scratch, &mut slopes, &mut bends)?;
        let mut found = FormulaSlopes { value, gradient: SVector::zeros(), hessian: SMatrix::zeros() };
        for row in self.expression.free() {
            found.gradient[coordinate(row)] = slopes[row];
            for column in self.expression.free() {
                found.hessian[(coordinate(row), coordinate(column))] = bends[SIZE * row + column];
            }
        }
        Ok(found)
    }
}

/// The numbers of a place at a time, in the order of their names.
fn numbers(placement: &Placement, time: f64) -> [f64; PLACE_NAMES.len()] {
    let (p, g) = (&placement.position, &placement.gradient);
    std::array::from_fn(|variable| match variable {
        0..3 => p[variable],
        3..TIME => g[((variable - 3) / 3, (variable - 3) % 3)],
        _ => time,
    })
}

/// The place of a variable among the coordinates q, which have P column by column.
fn coordinate(variable: usize) -> usize {
    if variable < 3 { variable } else { 3 + (variable - 3) / 3 + 3 * ((variable - 3) % 3) }
}
