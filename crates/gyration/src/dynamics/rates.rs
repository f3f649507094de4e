//! The rates of the state: the function to read first.
//!
//!   m p̈₀ = m g + f                        f = ∫_∂D q dA
//!   P̈ J = M − V S                         M = ∫_∂D q ⊗ X dA            (affine)
//!   μ_γ Ġ G⁻¹ = Fᵀ S Gᵀ − det G φ I + Q   P = F G                       (contractile)
//!   I Ω̇ = τ − Ω × IΩ                      τ = ∫_∂D X × Rᵀq dA          (rigid, body axes)
//!
//! instant → loads → balance solved for the rates, body by body, and the powers whose integrals are the works of the
//! ledger. Joints exert the forces that keep their bodies together (`joints`). A body without inertia takes the
//! velocities at which all of this is in balance (`inertialess`). A pinned body takes everything about its pin, r = X_p
//! − X₀: τ_p = τ − r × Rᵀ(f + m g), M_p = M − (f + m g) ⊗ r. Source: `docs/theory-rigid.md`, `docs/theory-affine.md`,
//! `docs/theory-contractile.md`.

use super::body_rates::BodyLoads;
use super::jacobian::{Blocks, add_interactions, body_jacobian};
use super::powers::Powers;
use super::{Workspace, inertialess, joints};
use crate::extended::Numbers;
use crate::inadmissible::Inadmissible;
use crate::model::Model;
use crate::team::{Rooms, find_each};

/// The rates of all bodies and the powers of all works at time t.
///
/// `state` and `rates` are laid out as `Model::slots`, `powers` [W] as `Model::works`.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model: a gap or a spring's length not above zero.
pub fn rates(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    state: Numbers,
    rates: &mut [f64],
    powers: &mut [f64],
) -> Result<(), Inadmissible> {
    let Workspace { instants, scratch, rooms, loads } = workspace;
    let team = instants.team;
    let mut instant = instants.read(model, time, state)?;
    inertialess::solve(&mut instant, scratch)?;
    joints::solve(&mut instant, scratch)?;
    loads.resize(model.bodies.len(), BodyLoads::default());
    find_each(team, loads, Rooms { own: scratch, others: rooms }, |index, loads, room| {
        let at = instant.at(index);
        match at.body.has_inertia() {
            true => loads.find(&at, room),
            false => Ok(()),
        }
    })?;
    powers.fill(0.0);
    let mut add = |done: &Powers| {
        for (work, power) in model.works().iter().zip(powers.iter_mut()) {
            *power += done[*work];
        }
    };
    for (index, loads) in loads.iter_mut().enumerate() {
        let at = instant.at(index);
        match at.body.has_inertia() {
            true => add(loads.balanced(&at, model.slots(index), rates)),
            false => add(&inertialess::fill(&at, scratch, rates)?),
        }
    }
    Ok(())
}

/// ∂(rates)/∂(state), block (i, j) the rates of body i by the numbers of body j, as `Model::blocks`.
///
/// Blocks off the diagonal are added to; on the diagonal, what is always zero is taken to be zero already.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn jacobian(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    state: Numbers,
    blocks: &mut (impl Blocks + ?Sized),
) -> Result<(), Inadmissible> {
    let Workspace { instants, scratch, .. } = workspace;
    let mut instant = instants.differentiate(model, time, state)?;
    inertialess::solve(&mut instant, scratch)?;
    joints::solve(&mut instant, scratch)?;
    let mut equations = std::mem::take(&mut scratch.joints);
    let joins = inertialess::joins(&instant, scratch);
    let through = equations.joins(&instant, joins);
    blocks.arrange(&mut instant.joins().chain(joins.iter().copied()).chain(through.iter().copied()));
    scratch.joints = equations;
    for index in (0..model.bodies.len()).filter(|body| model.bodies[*body].has_inertia()) {
        let Some(matrix) = blocks.block(index, index) else { continue };
        let at = instant.at(index);
        body_jacobian(&at, scratch, matrix)?;
        add_interactions(&at, |(other, cell), coupling, lower, lift| {
            if let Some(matrix) = blocks.image_block(index, other, cell) {
                coupling.add_to(matrix, lower, lift);
            }
        });
    }
    inertialess::add_jacobian(&instant, scratch, blocks)?;
    joints::add_jacobian(&instant, scratch, blocks);
    Ok(())
}
