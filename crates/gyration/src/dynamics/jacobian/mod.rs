//! The exact Jacobian of the rates, block by block.
//!
//! All loads are differentiated in the coordinates q = (p₀ | P) common to every kind of body, Q = (f | M) beside them.
//! A kind brings two maps: A lifts a change of its numbers to δq and δq̇, B lowers δQ to a change of its rates,
//!
//!   block (i, j) = B_i ∂Q_i/∂(q_j, q̇_j) A_j        (`coupling`)
//!
//! and beside it what its own balance changes by at fixed loads (`rigid`, `affine`, `contractile`, `history`,
//! `affine_history`). The wrench of a contact or of the fluid on a rigid body depends on few numbers only; its
//! derivatives by them are exact to more digits than those by q, and go to the block directly.

mod affine;
mod affine_history;
mod contractile;
mod coupling;
mod history;
mod interactions;
mod rigid;

pub use coupling::{Coupling, Lift, Lower};
pub(super) use interactions::add_interactions;

use super::Scratch;
use super::affine_history::AffineHistory;
use super::contractile::ContractileMotion;
use super::history::RigidHistory;
use super::reaction::hold_block;
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt};
use crate::lattice::Cell;
use nalgebra::DMatrix;

/// The blocks of a Jacobian, to be written.
pub trait Blocks {
    /// Takes note of the pairs (i, j) of bodies of which j acts on i, some of them twice, before any block is asked
    /// for.
    fn arrange(&mut self, _pairs: &mut dyn Iterator<Item = (usize, usize)>) {}

    /// Block (row, column), or none where it is not wanted.
    fn block(&mut self, row: usize, column: usize) -> Option<&mut DMatrix<f64>>;

    /// The block to which is added what the image of a body in a cell does, as seen from that of the row: that of the
    /// body itself, since all images move alike, unless they are told apart.
    fn image_block(&mut self, row: usize, column: usize, _cell: Cell) -> Option<&mut DMatrix<f64>> {
        self.block(row, column)
    }
}

/// The blocks of the diagonal alone.
impl Blocks for [DMatrix<f64>] {
    fn block(&mut self, row: usize, column: usize) -> Option<&mut DMatrix<f64>> {
        if row == column { self.get_mut(row) } else { None }
    }
}

/// The derivatives of the rates of one body with inertia by its own numbers.
pub(super) fn body_jacobian(at: &BodyAt, scratch: &mut Scratch, matrix: &mut DMatrix<f64>) -> Result<(), Inadmissible> {
    free_jacobian(at, scratch, matrix)?;
    hold_block(at, scratch, matrix)
}

/// The same without the guide of the body.
fn free_jacobian(at: &BodyAt, scratch: &mut Scratch, matrix: &mut DMatrix<f64>) -> Result<(), Inadmissible> {
    match at.kind() {
        KindAt::Rigid(inertia, turn) => {
            let (slopes, others) = rigid::slopes(at, turn, scratch)?;
            matrix.fill(0.0);
            match RigidHistory::of(at, turn) {
                Some(sphere) => history::fill(matrix, inertia, &sphere, &slopes),
                None => slopes.fill(matrix, at.body, inertia, turn),
            }
            if let Some(others) = &others {
                Coupling::from(others).add_to(matrix, &Lower::free(at), &Lift::of(at));
            }
            Ok(())
        }
        KindAt::Affine(affine, gyration) => match AffineHistory::of(at, affine, gyration) {
            Some(sphere) => affine_history::fill(matrix, at, (affine, gyration), &sphere, scratch),
            None => affine::fill(matrix, at, affine, gyration, scratch),
        },
        KindAt::Contractile(contractile, gyration, decomposition) => {
            contractile::fill(matrix, at, &ContractileMotion { at, contractile, gyration, decomposition }, scratch)
        }
    }
}
