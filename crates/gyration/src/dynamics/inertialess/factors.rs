//! The factors of the balance: of one body on the stack, of several that feel one another block by block.

use super::volume::KeptVolume;
use crate::body::Slots;
use gyration_blocks::{Analysis, BlockLu, BlockMatrix, Components, Pattern, Real};
use nalgebra::{Const, DMatrix, LU, SMatrix, SVector};
use std::ops::Range;

/// The most velocities that a body has, with λ.
pub(super) const UNKNOWNS: usize = 13;

type Matrix = SMatrix<f64, UNKNOWNS, UNKNOWNS>;

/// The matrix of the balance of one body, by its own velocities; behind them stands the constraint, if it has one.
///
///   ( A_v   −Y )
///   ( P⁻ᵀ·   0 )
///
/// With a guide ΠA_v, whose image is that of Π, and its velocities are in it too: (1 − Π)v = 0 stands in the same rows.
#[derive(Debug, Clone)]
pub(super) struct Bordered {
    matrix: Matrix,
    /// By what the constraint is weighed, so that pivots compare like with like.
    weight: f64,
}

impl Bordered {
    /// Of a body, given the Jacobian that it has with inertia.
    pub fn new(
        slots: &Slots,
        jacobian: &DMatrix<f64>,
        kept: Option<&KeptVolume>,
        within: Option<&DMatrix<f64>>,
    ) -> Self {
        let (at, count) = (slots.velocities().start, slots.velocities().len());
        let mut matrix = Matrix::identity();
        matrix.view_mut((0, 0), (count, count)).copy_from(&jacobian.view((at, at), (count, count)));
        if let Some(within) = within {
            let mut own = matrix.view_mut((0, 0), (count, count));
            let size = own.amax();
            own += (within - DMatrix::identity(count, count)) * size;
        }
        let Some(kept) = kept else { return Self { matrix, weight: 1.0 } };
        let first = count - 9;
        let size = matrix.view((0, 0), (count, count)).amax();
        let weight = size / kept.inverse.amax();
        let push = size / kept.direction.amax();
        matrix[(count, count)] = 0.0;
        let across = kept.inverse.transpose();
        for k in 0..9 {
            matrix[(first + k, count)] = -push * kept.direction[k];
            matrix[(count, first + k)] = weight * across[k];
        }
        Self { matrix, weight }
    }

    /// Writes the right-hand side of given accelerations and a growth θ of the volume [1/s].
    pub fn side(&self, accelerations: &[f64], growth: f64, side: &mut [f64]) {
        for (out, acceleration) in side.iter_mut().zip(accelerations) {
            *out = -acceleration;
        }
        if let Some(last) = side.get_mut(accelerations.len()) {
            *last = self.weight * growth;
        }
    }
}

/// The factors of the balance of some bodies.
#[expect(clippy::large_enum_variant, reason = "on the stack while one balance is solved")]
pub(super) enum Factors<'a> {
    One(LU<f64, Const<UNKNOWNS>, Const<UNKNOWNS>>),
    Several(&'a mut Together),
}

impl Factors<'_> {
    /// Of one body.
    pub fn of_one(bordered: &Bordered) -> Self {
        Self::One(bordered.matrix.lu())
    }

    /// Solves in place; none if nothing resists the motion.
    #[must_use]
    pub fn solve(&mut self, side: &mut [f64]) -> Option<()> {
        match self {
            Self::One(factors) => {
                let mut whole = SVector::<f64, UNKNOWNS>::zeros();
                whole.as_mut_slice()[..side.len()].copy_from_slice(side);
                let solved = factors.solve(&whole)?;
                side.copy_from_slice(&solved.as_slice()[..side.len()]);
                Some(())
            }
            Self::Several(together) => {
                together.factors.solve(&together.analysis, &mut [side]);
                side.iter().all(|number| number.is_finite()).then_some(())
            }
        }
    }
}

/// The matrix of bodies that feel one another's velocities, and its factors.
#[derive(Debug, Clone)]
pub(super) struct Together {
    matrix: BlockMatrix,
    pattern: Pattern,
    analysis: Analysis,
    factors: BlockLu<Real>,
}

impl Together {
    /// Room for bodies of so many unknowns, of which these pairs feel each other.
    pub fn new(ranges: &[Range<usize>], pairs: impl IntoIterator<Item = (usize, usize)>) -> Self {
        let pattern = Pattern::new(ranges.len(), pairs);
        let mut matrix = BlockMatrix::new(ranges);
        matrix.arrange(&pattern);
        let all: Vec<usize> = Components::joined(ranges.len(), []).iter().flatten().copied().collect();
        let analysis = Analysis::of(&all, ranges, &matrix);
        let factors = BlockLu::new(&analysis);
        Self { matrix, pattern, analysis, factors }
    }

    /// Begins a matrix with zeros beside its diagonal; what is factorized is its negative.
    pub fn begin(&mut self) {
        self.matrix.arrange(&self.pattern);
    }

    /// Sets a block of the diagonal.
    pub fn set(&mut self, body: usize, bordered: &Bordered) {
        let block = &mut self.matrix.diagonal_mut()[body];
        let size = block.shape();
        block.copy_from(&bordered.matrix.view((0, 0), size));
        block.neg_mut();
    }

    /// The block of two bodies, to be subtracted from; none where neither feels the other.
    pub fn block(&mut self, row: usize, column: usize) -> Option<&mut DMatrix<f64>> {
        self.matrix.block_mut(row, column)
    }

    /// Factorizes; none if nothing resists the motion.
    #[must_use]
    pub fn factorize(&mut self) -> Option<Factors<'_>> {
        self.factors.factorize(&self.analysis, 0.0, &self.matrix).ok()?;
        Some(self.factorized())
    }

    /// The factors that were found last.
    pub fn factorized(&mut self) -> Factors<'_> {
        Factors::Several(self)
    }
}
