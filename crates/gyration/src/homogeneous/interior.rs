//! The balance of P at one instant, solved for what stands in it.

use crate::body::{Body, Slots};
use crate::dynamics::{ContractileMotion, Scratch, affine_balance, body_rates, moment};
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt};
use crate::load::Loads;
use crate::tensor::{Mat3, Vec3, cross_matrix};

/// What the balance of P is made of, about the centre of mass or the pin.
pub(super) struct Interior {
    /// J.
    pub euler_tensor: Mat3,
    /// M, of the weight too about a pin.
    pub moment: Mat3,
    /// P̈; zero without inertia.
    pub acceleration: Mat3,
    /// S.
    pub stress: Mat3,
    /// V_G; zero of a body that does not drive itself.
    pub contraction_velocity: Mat3,
}

impl Interior {
    /// Of a body under some loads, M about its centre of mass, and the moment of a guide.
    pub fn of(at: &BodyAt, (loads, guided): (&Loads, &Mat3), scratch: &mut Scratch) -> Result<Self, Inadmissible> {
        let mut contraction_velocity = Mat3::zeros();
        let moment = moment(at, loads);
        // P̈ takes nothing of a body without inertia.
        let inertial = |acceleration| if at.body.has_inertia() { acceleration } else { Mat3::zeros() };
        let (euler_tensor, acceleration, stress) = match at.kind() {
            KindAt::Affine(affine, gyration) => {
                let balance = affine_balance(at, affine, gyration, loads);
                (affine.interior.euler_tensor, inertial(balance.acceleration), balance.stress)
            }
            KindAt::Contractile(contractile, gyration, decomposition) => {
                let balance = ContractileMotion { at, contractile, gyration, decomposition }.balance(loads);
                contraction_velocity = balance.contraction_velocity;
                (contractile.affine.interior.euler_tensor, inertial(balance.acceleration), balance.stress)
            }
            KindAt::Rigid(_, turn) => {
                let acceleration = inertial(rigid_acceleration(at, &turn.spin, scratch)?);
                let euler_tensor = euler_tensor(at.body);
                (
                    euler_tensor,
                    acceleration,
                    (moment + guided - acceleration * euler_tensor) / at.body.solid.mass.volume,
                )
            }
        };
        Ok(Self { euler_tensor, moment, acceleration, stress, contraction_velocity })
    }
}

/// J about the pin, if there is one.
fn euler_tensor(body: &Body) -> Mat3 {
    let own = body.solid.mass.euler_tensor;
    body.pin.as_ref().map_or(own, |pin| own + body.solid.mass.mass * pin.point * pin.point.transpose())
}

/// P̈ = R ([Ω̇]× + [Ω]×²).
fn rigid_acceleration(at: &BodyAt, spin: &Vec3, scratch: &mut Scratch) -> Result<Mat3, Inadmissible> {
    let slots = Slots::with_inertia(at.body, 0);
    let mut rates = scratch.take_numbers(slots.block().len());
    let done = body_rates(at, &slots, scratch, &mut rates);
    let turning = cross_matrix(&Vec3::from_column_slice(&rates[slots.rate()]));
    scratch.give_back(rates);
    done?;
    let spin = cross_matrix(spin);
    Ok(at.motion.placement.gradient * (turning + spin * spin))
}
