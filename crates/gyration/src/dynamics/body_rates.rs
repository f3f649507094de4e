//! The rates of one body with inertia: what acts on it, and the balance of its kind.

use super::contractile::ContractileMotion;
use super::guided::Guided;
use super::history::RigidHistory;
use super::loads::acting;
use super::powers::Powers;
use super::{Scratch, affine, rigid};
use crate::body::Slots;
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt};
use crate::ledger::Work;

/// The rates of one body, written into its slots, and the powers of the works done on it.
pub(crate) fn body_rates(
    at: &BodyAt,
    slots: &Slots,
    scratch: &mut Scratch,
    rates: &mut [f64],
) -> Result<Powers, Inadmissible> {
    match at.kind() {
        KindAt::Rigid(inertia, turn) => {
            let (wrench, mut done) = rigid::wrench(at, turn, scratch)?;
            match RigidHistory::of(at, turn) {
                None => rigid::fill(at, inertia, turn, &wrench, slots, rates),
                Some(history) => done[Work::Fluid] += history.fill(inertia, &wrench, slots, rates),
            }
            if let Some(guided) = Guided::at(at) {
                guided.hold(&mut rates[slots.velocities()]);
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
