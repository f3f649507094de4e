//! The rates of one body with inertia: what acts on it, and the balance of its kind.

use super::contractile::ContractileMotion;
use super::guided::Guided;
use super::history::RigidHistory;
use super::loads::Acting;
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
    /// Finds those of a body at an instant, in place.
    pub fn find(&mut self, at: &BodyAt, scratch: &mut Scratch) -> Result<(), Inadmissible> {
        match at.kind() {
            KindAt::Rigid(_, turn) => {
                let (wrench, powers) = rigid::wrench(at, turn, scratch)?;
                *self = Self::Rigid(wrench, powers);
                Ok(())
            }
            KindAt::Affine(..) | KindAt::Contractile(..) => {
                *self = Self::Deforming(Acting::default());
                match self {
                    Self::Deforming(acting) => acting.add_all(at, scratch),
                    Self::Rigid(..) => Ok(()),
                }
            }
        }
    }

    /// The rates of the body, written into its slots, and the powers of the works done on it.
    pub fn balanced(&mut self, at: &BodyAt, slots: &Slots, rates: &mut [f64]) -> &Powers {
        match (at.kind(), self) {
            (KindAt::Rigid(inertia, turn), Self::Rigid(wrench, done)) => {
                match RigidHistory::of(at, turn) {
                    None => rigid::fill(at, inertia, turn, wrench, slots, rates),
                    Some(history) => done[Work::Fluid] += history.fill(inertia, wrench, slots, rates),
                }
                if let Some(guided) = Guided::at(at) {
                    guided.hold(&mut rates[slots.velocities()]);
                }
                done
            }
            (KindAt::Affine(affine, gyration), Self::Deforming(acting)) => {
                affine::fill(at, affine, gyration, acting, slots, rates);
                &acting.powers
            }
            (KindAt::Contractile(contractile, gyration, decomposition), Self::Deforming(acting)) => {
                ContractileMotion { at, contractile, gyration, decomposition }.fill(acting, slots, rates);
                &acting.powers
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
    let mut loads = BodyLoads::default();
    loads.find(at, scratch)?;
    Ok(*loads.balanced(at, slots, rates))
}
