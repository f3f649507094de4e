//! The exact Jacobian of the rates, block by block.
//!
//! An affine body's loads are differentiated in the coordinates (p₀ | P) (`affine_slopes`). The wrench on a rigid body depends on few numbers, and its derivatives by them follow from the same moments with
//! exponent ν + 1 (`contact`); they are carried over to the state here, once:
//!
//!   m p̈₀ = m g + f           I Ω̇ = τ − Ω × IΩ,   δ(Ω × IΩ) = ([Ω]× I − [IΩ]×) δΩ
//!
//! Columns of the quaternion come from those of δθ by δθ = 2 vec(q⁻¹ ∘ δq).

mod affine_slopes;
mod contractile_slopes;
mod memory_slopes;
mod rigid_slopes;

use crate::body::{Body, BodyKind, RigidInertia};
use crate::contact::{ContactWrench, Meeting, RigidMotion};
use crate::inadmissible::Inadmissible;
use crate::model::Model;
use crate::rates::{
    AffineMotion, ContractileMotion, RigidImmersion, RigidMemory, Workspace, for_each_contact, settled_slopes,
    spring_loads,
};
use crate::state::{BodyMotion, Turn};
use crate::tensor::{Mat3, cross_matrix};
use nalgebra::{DMatrix, SMatrix};
use rigid_slopes::RigidSlopes;

/// ∂(rates)/∂(state) of every body, one square matrix a block of `Model::blocks`.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn jacobian(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    bodies: &[f64],
    blocks: &mut [DMatrix<f64>],
) -> Result<(), Inadmissible> {
    for (index, (body, matrix)) in model.bodies.iter().zip(blocks).enumerate() {
        let block = &bodies[model.blocks()[index].clone()];
        match body.has_inertia() {
            true => body_jacobian(model, workspace, time, (index, block), matrix)?,
            false => settled_slopes(model, workspace, time, (index, block), matrix)?,
        }
    }
    Ok(())
}

/// The derivatives of the rates of one body by its places, velocities and contraction.
///
/// What is always zero in the matrix is taken to be zero already.
pub(crate) fn body_jacobian(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    (index, block): (usize, &[f64]),
    matrix: &mut DMatrix<f64>,
) -> Result<(), Inadmissible> {
    let body = &model.bodies[index];
    match &body.kind {
        BodyKind::Rigid(inertia) => {
            let turn = Turn::unpack(body, block);
            let slopes = rigid_slopes(model, workspace, time, index, (&turn.motion(body, block), &turn))?;
            matrix.fill(0.0);
            match body.pin {
                None => match RigidMemory::of(model, time, index, (&turn.motion(body, block), &turn, block)) {
                    None => fill_free(matrix, body, inertia, &turn, &slopes),
                    Some(memory) => memory_slopes::fill(matrix, inertia, &memory, &slopes),
                },
                Some(_) => fill_pinned(matrix, (body, inertia), &turn, &slopes),
            }
        }
        BodyKind::Affine(affine) => {
            let motion = BodyMotion::unpack(body, block);
            let moving = AffineMotion::new(index, affine, &motion)?;
            affine_slopes::fill(matrix, model, workspace, time, &moving)?;
        }
        BodyKind::Contractile(contractile) => {
            let motion = BodyMotion::unpack(body, block);
            let moving = ContractileMotion::new(index, contractile, (&motion, time, block))?;
            contractile_slopes::fill(matrix, model, workspace, &moving)?;
        }
    }
    Ok(())
}

/// The wrench on a rigid body and its derivatives, about the pin if it has one.
fn rigid_slopes(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    index: usize,
    (motion, turn): (&BodyMotion, &Turn),
) -> Result<RigidSlopes, Inadmissible> {
    let body = &model.bodies[index];
    let mut slopes = RigidSlopes::default();
    for_each_contact(model, time, index, motion, |contact, meeting| {
        let Meeting { surface, field, .. } = meeting;
        let relative = RigidMotion::new(&meeting.motion, &motion.placement.gradient, turn.spin);
        let wrench = ContactWrench::integrate(contact, surface, field, &relative, &mut workspace.contact)?;
        slopes.add_contact(&wrench, &relative);
        Ok(())
    })?;
    spring_loads(index, body, motion, |spring| slopes.add_spring(spring, motion, &turn.spin))?;
    if let Some(applied) = model.applied(index) {
        slopes.add_applied(applied, &motion.placement.gradient);
    }
    if let Some(immersed) = RigidImmersion::of(model, time, index, (motion, turn)) {
        slopes.add_fluid(&immersed);
    }
    if let Some(pin) = &body.pin {
        slopes.tie_to_pin(&pin.point, &(body.mass.mass * model.gravity), (motion, turn));
    }
    Ok(slopes)
}

/// Writes a matrix into a block at a row and a column.
fn write<const ROWS: usize, const COLUMNS: usize>(
    block: &mut DMatrix<f64>,
    at: (usize, usize),
    part: &SMatrix<f64, ROWS, COLUMNS>,
) {
    block.fixed_view_mut::<ROWS, COLUMNS>(at.0, at.1).copy_from(part);
}

/// ∂(Ω × IΩ)/∂Ω.
fn gyroscopic(body: &Body, inertia: &RigidInertia, turn: &Turn) -> Mat3 {
    if !body.has_inertia() {
        return Mat3::zeros();
    }
    cross_matrix(&turn.spin) * inertia.tensor - cross_matrix(&(inertia.tensor * turn.spin))
}

/// The block of a free body: p₀, q, ṗ₀, Ω from 0, 3, 7, 10.
fn fill_free(block: &mut DMatrix<f64>, body: &Body, inertia: &RigidInertia, turn: &Turn, slopes: &RigidSlopes) {
    let turns = turn.quaternion.turn_by_component();
    let mobility = 1.0 / body.mass.mass;
    write(block, (0, 7), &Mat3::identity());
    write(block, (3, 3), &turn.quaternion.rate_by_component(&turn.spin));
    write(block, (3, 10), &turn.quaternion.rate_by_spin());
    write(block, (7, 0), &(slopes.by_place.force * mobility));
    write(block, (7, 3), &(slopes.by_turn.force * mobility * turns));
    write(block, (7, 7), &(slopes.by_velocity.force * mobility));
    write(block, (7, 10), &(slopes.by_spin.force * mobility));
    write(block, (10, 0), &(inertia.inverse * slopes.by_place.torque));
    write(block, (10, 3), &(inertia.inverse * slopes.by_turn.torque * turns));
    write(block, (10, 7), &(inertia.inverse * slopes.by_velocity.torque));
    write(block, (10, 10), &(inertia.inverse * (slopes.by_spin.torque - gyroscopic(body, inertia, turn))));
}

/// The block of a pinned body: q, Ω from 0, 4.
fn fill_pinned(block: &mut DMatrix<f64>, (body, inertia): (&Body, &RigidInertia), turn: &Turn, slopes: &RigidSlopes) {
    let turns = turn.quaternion.turn_by_component();
    write(block, (0, 0), &turn.quaternion.rate_by_component(&turn.spin));
    write(block, (0, 4), &turn.quaternion.rate_by_spin());
    write(block, (4, 0), &(inertia.inverse * slopes.by_turn.torque * turns));
    write(block, (4, 4), &(inertia.inverse * (slopes.by_spin.torque - gyroscopic(body, inertia, turn))));
}
