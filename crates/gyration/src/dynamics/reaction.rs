//! What the guide of a body takes: the force that does it, and the derivatives with it.
//!
//!   r = Π_c (m g + f) − (m g + f),   R = (P̈ − A − λY) J,   τ_r = I Π_t α − I α
//!
//! with the symbols of `guided`. R and τ_r are orthogonal to all velocities that the guide allows: they do no work.
//! Source: `docs/theory-affine.md`.

use super::Scratch;
use super::affine::moment;
use super::contractile::ContractileMotion;
use super::guided::{Guided, GuidedStrain};
use super::loads::{Acting, acting};
use super::rigid;
use crate::affine::{AffineBody, Gyration};
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt, MotionAt};
use crate::load::Loads;
use crate::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::DMatrix;

/// Takes the block of a body with a guide, as it would be without, to that with it.
pub(super) fn hold_block(at: &BodyAt, scratch: &mut Scratch, block: &mut DMatrix<f64>) -> Result<(), Inadmissible> {
    let Some(guided) = Guided::at(at) else { return Ok(()) };
    let rows = guided.slots.velocities();
    for mut column in block.column_iter_mut() {
        guided.hold(&mut column.as_mut_slice()[rows.clone()]);
    }
    let Some(strain) = guided.strain.as_ref().filter(|strain| strain.keeps_volume()) else { return Ok(()) };
    let acceleration = free_acceleration(at, &acting(at, scratch)?.total);
    for (entry, column) in guided.slots.attitude().enumerate() {
        let change = strain.along((entry % 3, entry / 3), &acceleration);
        let mut column = block.column_mut(column);
        column.rows_mut(guided.slots.rate().start, 9).iter_mut().zip(&change).for_each(|(sum, part)| *sum += part);
    }
    Ok(())
}

/// A of a body that deforms under some loads \[1/s²\].
fn free_acceleration(at: &MotionAt, loads: &Loads) -> Mat3 {
    match at.kind() {
        KindAt::Rigid(..) => Mat3::zeros(),
        KindAt::Affine(affine, gyration) => affine.interior.balance(gyration, &moment(at, loads)).acceleration,
        KindAt::Contractile(contractile, gyration, decomposition) => {
            ContractileMotion { at, contractile, gyration, decomposition }.free_balance(loads).acceleration
        }
    }
}

/// The force \[N\] and the affine moment \[N m\] by which a guide keeps a body, about its centre or its pin; of a rigid
/// body M = ½ R [τ]×, τ the torque in its own axes. None of a body without a guide.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn reaction(at: &BodyAt, acting: &Acting, scratch: &mut Scratch) -> Result<Option<Loads>, Inadmissible> {
    let Some(guide) = at.body.guide.as_deref() else { return Ok(None) };
    let mass = at.body.solid.mass.mass;
    let moves = if at.body.has_inertia() { 1.0 } else { 0.0 };
    let load = mass * at.model.gravity + acting.total.force;
    let force = guide.center.filter(|_| at.body.pin.is_none()).map_or_else(Vec3::zeros, |center| center * load - load);
    let moment = match at.kind() {
        KindAt::Rigid(inertia, turn) => {
            let Some(guide) = &guide.turn else { return Ok(Some(Loads { force, moment: Mat3::zeros() })) };
            let (wrench, _) = rigid::wrench(at, turn, scratch)?;
            let torque = rigid::unbalanced(at, inertia, turn, &wrench);
            let held = inertia.tensor * guide.within(&(inertia.inverse * torque)) - torque;
            at.motion.placement.gradient * (0.5 * cross_matrix(&held))
        }
        KindAt::Affine(affine, gyration) => {
            let interior = &affine.interior;
            strain_reaction(at, (interior, gyration), &free_acceleration(at, &acting.total), moves)
        }
        KindAt::Contractile(contractile, gyration, _) => {
            let interior = &contractile.affine.interior;
            strain_reaction(at, (interior, gyration), &free_acceleration(at, &acting.total), moves)
        }
    };
    Ok(Some(Loads { force, moment }))
}

/// (P̈ − A − λY) J, `moves` being one of a body with inertia; one without does not accelerate, and its pressure takes
/// the rest.
fn strain_reaction(at: &MotionAt, (interior, gyration): (&AffineBody, &Gyration), free: &Mat3, moves: f64) -> Mat3 {
    let Some(strain) = GuidedStrain::at(at) else { return Mat3::zeros() };
    let (held, push) = strain.hold(free);
    let left = (1.0 - moves) * strain.taken(&held);
    (moves * held - free) * interior.euler_tensor - (push - left) * gyration.inverse.transpose()
}
