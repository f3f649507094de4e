//! The rates of one body with inertia: what acts on it, and the balance of its kind.

use super::contractile::ContractileMotion;
use super::guided::Guided;
use super::history::RigidHistory;
use super::loads::{Acting, acting};
use super::powers::Powers;
use super::{Scratch, affine, rigid};
use crate::body::Slots;
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt};
use crate::ledger::Work;
use crate::load::Wrench;

/// What acts on a body with inertia, as its balance is told of it.
#[derive(Debug, Clone, Copy)]
pub(crate) enum BodyLoads {
    Rigid(Wrench, Powers),
    Deforming(Acting),
}

impl Default for BodyLoads {
    fn default() -> Self {
        Self::Rigid(Wrench::default(), Powers::default())
    }
}

impl BodyLoads {
    /// Of a body at an instant.
    pub fn of(at: &BodyAt, scratch: &mut Scratch) -> Result<Self, Inadmissible> {
        Ok(match at.kind() {
            KindAt::Rigid(_, turn) => {
                let (wrench, powers) = rigid::wrench(at, turn, scratch)?;
                Self::Rigid(wrench, powers)
            }
            KindAt::Affine(..) | KindAt::Contractile(..) => Self::Deforming(acting(at, scratch)?),
        })
    }

    /// The rates of the body, written into its slots, and the powers of the works done on it.
    pub fn balanced(self, at: &BodyAt, slots: &Slots, rates: &mut [f64]) -> Powers {
        match (at.kind(), self) {
            (KindAt::Rigid(inertia, turn), Self::Rigid(wrench, mut done)) => {
                match RigidHistory::of(at, turn) {
                    None => rigid::fill(at, inertia, turn, &wrench, slots, rates),
                    Some(history) => done[Work::Fluid] += history.fill(inertia, &wrench, slots, rates),
                }
                if let Some(guided) = Guided::at(at) {
                    guided.hold(&mut rates[slots.velocities()]);
                }
                done
            }
            (KindAt::Affine(affine, gyration), Self::Deforming(mut acting)) => {
                affine::fill(at, affine, gyration, &mut acting, slots, rates);
                acting.powers
            }
            (KindAt::Contractile(contractile, gyration, decomposition), Self::Deforming(mut acting)) => {
                ContractileMotion { at, contractile, gyration, decomposition }.fill(&mut acting, slots, rates);
                acting.powers
            }
            _ => unreachable!("loads are balanced by the body that they act on"),
        }
    }
}

/// The rates of one body, written into its slots, and the powers of the works done on it.
pub(crate) fn body_rates(
    at: &BodyAt,
    slots: &Slots,
    scratch: &mut Scratch,
    rates: &mut [f64],
) -> Result<Powers, Inadmissible> {
    Ok(BodyLoads::of(at, scratch)?.balanced(at, slots, rates))
}
