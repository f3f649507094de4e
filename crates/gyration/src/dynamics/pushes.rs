//! The forces on a body one by one: what is there where they cancel.
//!
//! Speed scales and the verdict on the ledger go by these, never by a net force: of a body that is pressed from all
//! sides that is rounding.

use super::Scratch;
use super::contacts::meet;
use super::loads::undefined;
use crate::acting::Load;
use crate::contact::ContactLoads;
use crate::inadmissible::{FormulaOf, Inadmissible};
use crate::instant::BodyAt;
use crate::pair::PairLoads;

/// One of the forces on a body that come from a support, a spring, a bond, another body or a field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// |f| [N].
    pub force: f64,
    /// The length on which it depends [m]: the gap of a contact, the length of a spring or bond, the size of a body in
    /// a field.
    pub gap: f64,
    /// What its energy is rounded to [J], where that is more than the last digit; each pair has it once.
    ///
    /// U of a pair of bodies is Σ^(−2(ν−1)) of a gap that is a difference: (8(ν−1) + ν size/gap) ε U.
    pub rounding: f64,
}

/// Hands the forces of contacts, springs, pairs, a potential and a force per volume on a body to `each`.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn each_push(at: &BodyAt, scratch: &mut Scratch, mut each: impl FnMut(Push)) -> Result<(), Inadmissible> {
    at.try_each_load(|load| {
        match load {
            Load::Contact(contact) => {
                let push = meet(at, contact, |it| {
                    let loads = ContactLoads::integrate(&contact.law_set, it, &mut scratch.contact)?;
                    let gap = it.surface.smallest_gap(&it.field).0;
                    Ok(Push { force: loads.total().force.norm(), gap, rounding: 0.0 })
                })?;
                push.into_iter().for_each(&mut each);
            }
            Load::Spring(end) => {
                let spring = at.spring(&end);
                each(Push { force: spring.force.norm(), gap: spring.length, rounding: 0.0 });
            }
            Load::Bond(end) => {
                let bond = at.bond(&end);
                let gap = if bond.length > 0.0 { bond.length } else { at.body.size };
                each(Push { force: bond.on[end.end].force.norm(), gap, rounding: 0.0 });
            }
            // A pair that does nothing may be left out before its plane is found.
            Load::Pair(pair) if !pair.acts() => {}
            Load::Pair(pair) => {
                let PairLoads { gap, stored, .. } = pair.loads;
                let exponent = pair.end.interaction.form.laws.repulsion.exponent;
                let digits = 8.0 * (exponent - 1.0) + exponent * at.body.size / gap;
                let rounding = if pair.end.counts() { digits * f64::EPSILON * stored } else { 0.0 };
                each(Push { force: pair.on_body().force.norm(), gap: *gap, rounding });
            }
            Load::Potential(potential) => {
                let loads = potential.loads(&at.motion.placement, at.time, &mut scratch.formulas);
                let force = loads.map_err(undefined(at, FormulaOf::Potential))?.force.norm();
                each(Push { force, gap: at.body.size, rounding: 0.0 });
            }
            Load::BodyForce(body_force) => {
                let loads = body_force.loads(&at.motion.placement, at.time, &mut scratch.formulas);
                let force = loads.map_err(undefined(at, FormulaOf::BodyForce))?.force.norm();
                each(Push { force, gap: at.body.size, rounding: 0.0 });
            }
            Load::PointForce(point_force) => {
                let loads = point_force.loads(&at.motion.placement, at.time, &mut scratch.formulas);
                let force = loads.map_err(undefined(at, FormulaOf::PointForce))?.force.norm();
                each(Push { force, gap: at.body.size, rounding: 0.0 });
            }
            // Its force does no work.
            Load::Joint(_)
            | Load::Couple(_)
            | Load::Applied(_)
            | Load::Resistance(_)
            | Load::OwnFriction(_)
            | Load::MassFriction(_)
            | Load::SelfGravity(_)
            | Load::Fluid(..)
            | Load::Walls(_)
            | Load::Neighbours(_) => {}
        }
        Ok(())
    })
}
