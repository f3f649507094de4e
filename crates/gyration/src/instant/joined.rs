//! The two parties of a joint at an instant, as its equations see them, and what its motor does.

use super::motions::{MotionAt, Motions};
use crate::inadmissible::{FormulaOf, Inadmissible, Quantity};
use crate::joint::{Jet, Joint, JointLoads, MotorFault, MotorSlopes};
use crate::load::Interaction;
use crate::model::Model;
use gyration_expression::Scratch;

/// q and q̇ of a body, whose velocities do not change; p₀ is zero.
pub(crate) fn jet(at: &MotionAt) -> Jet {
    let (placement, velocity) = (&at.motion.placement, &at.motion.velocity);
    let mut jet = Jet::zeros();
    jet.place.fixed_view_mut::<3, 3>(0, 1).copy_from(&placement.gradient);
    jet.rate.set_column(0, &velocity.velocity);
    jet.rate.fixed_view_mut::<3, 3>(0, 1).copy_from(&velocity.gradient_rate);
    jet
}

/// What the second party of a joint adds to the jet of its body, whose p₀ is zero: p₀ from that of the first \[m\], and
/// of what is no body all of it.
pub(crate) fn second<'a>(joint: &Joint, at: impl Fn(usize) -> MotionAt<'a>) -> Jet {
    let [one, other] = joint.parties().map(|party| party.body().map(&at));
    let Some(one) = one else { return Jet::space() };
    let (mut jet, place) = match other {
        Some(other) => (Jet::zeros(), other.from(&one)),
        None => (joint.prescribed(one.time), one.place_from_center(&joint.anchor.at(one.time).0)),
    };
    jet.place.set_column(0, &place);
    jet
}

/// What the motor of a joint does, and its derivatives where they are wanted.
///
/// # Errors
/// [`Inadmissible`] at a limit, or where its drive is undefined.
pub(super) fn driven(
    model: &Model,
    motions: &Motions,
    number: usize,
    with_slopes: bool,
    scratch: &mut Scratch,
) -> Result<(JointLoads, Option<MotorSlopes>), Inadmissible> {
    let joint = &model.joints()[number];
    if !joint.motor.acts() {
        return Ok((JointLoads::default(), None));
    }
    let at = |body: usize| motions.at(model, body);
    let mut jets = joint.parties().map(|party| party.body().map_or_else(Jet::zeros, |body| jet(&at(body))));
    jets[1] += second(joint, at);
    let loads = joint.drive(&jets, motions.time(), scratch).map_err(|fault| {
        let body = joint.parties()[0].body().unwrap_or_default();
        match fault {
            MotorFault::Limit(value) => Inadmissible { body, quantity: Quantity::JointLimit { joint: number }, value },
            MotorFault::Undefined(undefined) => {
                let of = FormulaOf::Joint(number);
                Inadmissible { body, quantity: Quantity::Formula { of, undefined }, value: undefined.argument }
            }
        }
    })?;
    let slopes = if with_slopes { joint.motor_slopes(&jets, &loads.motor) } else { None };
    Ok((loads, slopes))
}
