//! What one body brings to the local balances of momentum and of affine momentum, all about its centre of mass.
//!
//!   m p̈₀ = Σ f,   dK/dt = Ṗ J Ṗᵀ + P J P̈ᵀ = Ṗ J Ṗᵀ − V (S Pᵀ)ᵀ + Σ N,   K = P J Ṗᵀ
//!
//! Σ goes over what other bodies do and what acts from outside: weight, planes, supports with a shape, anchors, pins,
//! guides, fluid, and what is written for the body. S of a rigid body is what keeps its form: V (S Pᵀ)ᵀ is then the
//! symmetric part of Σ N − P J P̈ᵀ, and the skew part is left to the balance. Without inertia m and J are zero. Source:
//! Sławianowski (1975), 3.5; `docs/fields.md`.

use super::interior::Interior;
use super::momentum_changes;
use crate::body::Slots;
use crate::dynamics::{Scratch, acting, body_rates, of_history, outside_loads, reaction};
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt};
use crate::tensor::{Mat3, Vec3};

/// What one body brings to the local balances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyBalance {
    /// m; zero without inertia [kg].
    pub mass: f64,
    /// p̈₀ [m/s²].
    pub acceleration: Vec3,
    /// K = P J Ṗᵀ [kg m²/s].
    pub affine_momentum: Mat3,
    /// Ṗ J Ṗᵀ; zero of a kinetic energy of the co-moving rates [J].
    pub kinetic_tensor: Mat3,
    /// What else dK/dt is: P J P̈ᵀ, or all of it [J].
    pub accelerated: Mat3,
    /// V (S Pᵀ)ᵀ [J].
    pub tension: Mat3,
    /// The force from outside all bodies [N].
    pub force: Vec3,
    /// N from outside all bodies [J].
    pub moment: Mat3,
}

impl BodyBalance {
    /// Of a body at an instant.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn of(at: &BodyAt, scratch: &mut Scratch) -> Result<Self, Inadmissible> {
        let (solid, motion) = (&at.body.solid, at.motion);
        let (p, rate) = (&motion.placement.gradient, &motion.velocity.gradient_rate);
        let acting = acting(at, scratch)?;
        let mut loads = acting.total;
        loads += of_history(at, scratch)?;
        let guide = reaction(at, &acting, scratch)?.unwrap_or_default();
        let interior = Interior::of(at, (&loads, &guide.moment), scratch)?;
        let (mass, euler_tensor) = match at.body.has_inertia() {
            true => (solid.mass.mass, solid.mass.euler_tensor),
            false => (0.0, Mat3::zeros()),
        };
        let acceleration = match &at.body.pin {
            Some(pin) => -(interior.acceleration * pin.point),
            None if at.body.has_inertia() => center_acceleration(at, scratch)?,
            None => Vec3::zeros(),
        };
        let weight = solid.mass.mass * at.model.gravity;
        // A pin takes what is left of the balance of momentum, and N = P (f ⊗ r)ᵀ of it.
        let held = at.body.pin.as_ref().map(|pin| {
            let force = mass * acceleration - loads.force - weight - guide.force;
            (force, p * pin.point * force.transpose())
        });
        let (pin_force, pin_moment) = held.unwrap_or_default();
        let outside = outside_loads(at, scratch)?;
        let [kinetic_tensor, accelerated] = momentum_changes(at, &euler_tensor, &interior.acceleration);
        let inertia = if at.body.has_inertia() { 1.0 } else { 0.0 };
        let tension = match at.kind() {
            KindAt::Rigid(..) => {
                let unbalanced = p * (loads.moment + guide.moment).transpose() + pin_moment - accelerated;
                0.5 * (unbalanced + unbalanced.transpose())
            }
            KindAt::Affine(..) | KindAt::Contractile(..) => {
                solid.mass.volume * (interior.stress * p.transpose()).transpose()
            }
        };
        Ok(Self {
            mass,
            acceleration,
            affine_momentum: inertia * at.body.affine_momentum(p, rate),
            kinetic_tensor,
            accelerated,
            tension,
            force: outside.force + guide.force + pin_force,
            moment: p * (outside.moment + guide.moment).transpose() + pin_moment,
        })
    }
}

/// p̈₀ of a body with inertia that no pin holds.
fn center_acceleration(at: &BodyAt, scratch: &mut Scratch) -> Result<Vec3, Inadmissible> {
    let slots = Slots::with_inertia(at.body, 0);
    let mut rates = scratch.take_numbers(slots.block().len());
    let done = body_rates(at, &slots, scratch, &mut rates);
    let acceleration = Vec3::from_column_slice(&rates[slots.velocity()]);
    scratch.give_back(rates);
    done.map(|_| acceleration)
}
