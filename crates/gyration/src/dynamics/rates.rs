//! The rates of the state: the function to read first.
//!
//!   m p̈₀ = m g + f                        f = ∫_∂D q dA
//!   P̈ J = M − V S                         M = ∫_∂D q ⊗ X dA            (affine)
//!   μ_γ Ġ G⁻¹ = Fᵀ S Gᵀ − det G φ I + Q   P = F G                       (contractile)
//!   I Ω̇ = τ − Ω × IΩ                      τ = ∫_∂D X × Rᵀq dA          (rigid, body axes)
//!
//! instant → loads → balance solved for the rates, body by body, and the powers whose integrals are the works of the
//! ledger. A body without inertia takes the velocities at which all of this is in balance (`inertialess`). A pinned body
//! takes everything about its pin, r = X_p − X₀: τ_p = τ − r × Rᵀ(f + m g), M_p = M − (f + m g) ⊗ r. Source:
//! `physics.md` §2.

use super::powers::Powers;
use super::rigid::wrench;
use super::{ContractileMotion, RigidHistory, Scratch, Workspace, acting, affine, inertialess, rigid};
use crate::body::Slots;
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt};
use crate::ledger::Work;
use crate::model::Model;

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
    state: &[f64],
    rates: &mut [f64],
    powers: &mut [f64],
) -> Result<(), Inadmissible> {
    let Workspace { instant, scratch } = workspace;
    instant.read(model, time, state)?;
    powers.fill(0.0);
    for index in 0..model.bodies.len() {
        let done = match model.bodies[index].has_inertia() {
            true => body_rates(&instant.at(model, index), model.slots(index), scratch, rates)?,
            false => inertialess::fill(model, instant, scratch, index, rates)?,
        };
        for (work, power) in model.works().iter().zip(powers.iter_mut()) {
            *power += done[*work];
        }
    }
    Ok(())
}

/// The rates of one body, written into its slots, and the powers of the works done on it.
pub(crate) fn body_rates(
    at: &BodyAt,
    slots: &Slots,
    scratch: &mut Scratch,
    rates: &mut [f64],
) -> Result<Powers, Inadmissible> {
    match at.kind() {
        KindAt::Rigid(inertia, turn) => {
            let (wrench, mut done) = wrench(at, turn, scratch)?;
            match RigidHistory::of(at, turn) {
                None => rigid::fill(at, inertia, turn, &wrench, slots, rates),
                Some(history) => done[Work::Fluid] += history.fill(inertia, &wrench, slots, rates),
            }
            Ok(done)
        }
        KindAt::Affine(affine, gyration) => {
            let mut acting = acting(at, scratch)?;
            affine::fill(at, affine, gyration, &mut acting, slots, rates);
            Ok(acting.powers)
        }
        KindAt::Contractile(contractile, gyration, decomposition) => {
            let mut acting = acting(at, scratch)?;
            ContractileMotion { at, contractile, gyration, decomposition }.fill(&mut acting, slots, rates);
            Ok(acting.powers)
        }
    }
}
