//! The exact Jacobian of the rates, block by block.
//!
//! All loads are differentiated in the coordinates q = (p₀ | P) common to every kind of body, Q = (f | M) beside them. A
//! kind brings two maps: A lifts a change of its numbers to δq and δq̇, B lowers δQ to a change of its rates,
//!
//!   block (i, j) = B_i ∂Q_i/∂(q_j, q̇_j) A_j        (`coupling`)
//!
//! and beside it what its own balance changes by at fixed loads (`rigid`, `affine`, `contractile`, `history`). The wrench
//! of a contact or of the fluid on a rigid body depends on few numbers only; its derivatives by them are exact to more
//! digits than those by q, and go to the block directly.

mod affine;
mod contractile;
mod coupling;
mod history;
mod rigid;

pub use coupling::{Coupling, Lift, Lower};

use super::{ContractileMotion, Scratch, Workspace, inertialess};
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt};
use crate::model::Model;
use nalgebra::DMatrix;

/// ∂(rates)/∂(state) of every body, one square matrix a block of `Model::blocks`.
///
/// What is always zero in a matrix is taken to be zero already.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn jacobian(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    state: &[f64],
    blocks: &mut [DMatrix<f64>],
) -> Result<(), Inadmissible> {
    let Workspace { instant, scratch } = workspace;
    instant.read(model, time, state)?;
    for (index, matrix) in blocks.iter_mut().enumerate() {
        match model.bodies[index].has_inertia() {
            true => body_jacobian(&instant.at(model, index), scratch, matrix)?,
            false => inertialess::fill_jacobian(model, instant, scratch, index, matrix)?,
        }
    }
    Ok(())
}

/// The derivatives of the rates of one body with inertia by its own numbers.
pub(super) fn body_jacobian(at: &BodyAt, scratch: &mut Scratch, matrix: &mut DMatrix<f64>) -> Result<(), Inadmissible> {
    match at.kind() {
        KindAt::Rigid(inertia, turn) => rigid::fill(matrix, at, inertia, turn, scratch),
        KindAt::Affine(affine, gyration) => affine::fill(matrix, at, affine, gyration, scratch),
        KindAt::Contractile(contractile, gyration, decomposition) => {
            contractile::fill(matrix, &ContractileMotion { at, contractile, gyration, decomposition }, scratch)
        }
    }
}
