//! A contact of a rigid body in the body's own axes: force, torque and their derivatives.
//!
//! With the normal m = Rᵀn, the relative velocity u(X) = v + Ω × X, the sums C of the central laws, T of the tangential ones
//! and D of the normal ones less the tangential ones,
//!
//!   F = C₀ m − (T₀v + Ω×T₁) − push m                          push = D₀ s + D₁·c,   lever = D₁ s + D₂ c
//!   τ = C₁×m − (T₁×v + (tr T₂) Ω − T₂Ω) − lever×m             s = m·v,  c = m×Ω,    m·u = s + c·X
//!
//! These are f and M of `resultant` for P = R, seen in the body: F = Rᵀf, τ_i = ε_ijk (RᵀM)_kj. They depend on ten
//! numbers, g₀, m, v and Ω, however many the state has; derivatives are taken by those and carried over once
//! (`rigid_slopes`). Moments are linear in the sums, so that derivatives through the gap are the same formula with other sums.

use super::plan::{Contact, ContactScratch};
use super::sums::{SumSlopes, Sums};
use crate::load::{Wrench, WrenchSlope};
use crate::surface::{GapClosed, GapField, Surface};
use crate::tensor::{Mat3, Vec3, cross_matrix};

/// The motion of a rigid body relative to a support, in the body's axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidMotion {
    /// m = Rᵀn, unit normal of the support.
    pub normal: Vec3,
    /// v = Rᵀw₀ [m/s], relative velocity of the centre of mass.
    pub velocity: Vec3,
    /// Ω [rad/s].
    pub spin: Vec3,
}

/// The wrench of one contact and the powers of its viscous laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidLoads {
    /// F and τ of all laws together.
    pub wrench: Wrench,
    /// The power of damping on the relative motion [W], −∫κ (m·u)² dA.
    pub damping_power: f64,
    /// The power of friction on the relative motion [W], −∫κ (|u|² − (m·u)²) dA.
    pub friction_power: f64,
}

/// The wrench of one contact and its derivatives by the ten numbers that it depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactWrench {
    /// F and τ of all laws together.
    pub wrench: Wrench,
    /// By the height g₀ of the centre of mass.
    pub by_height: Wrench,
    /// By m, through the gap and through the laws.
    pub by_normal: WrenchSlope,
    /// By v.
    pub by_velocity: WrenchSlope,
    /// By Ω.
    pub by_spin: WrenchSlope,
}

/// C, T and D.
struct Actions {
    central: Sums,
    tangential: Sums,
    difference: Sums,
}

impl Actions {
    fn new([central, normal, tangential]: &[Sums; 3]) -> Self {
        Self { central: *central, tangential: *tangential, difference: normal.minus(tangential) }
    }

    /// push and lever.
    fn along_normal(&self, motion: &RigidMotion) -> (f64, Vec3) {
        let RigidMotion { normal, velocity, spin } = motion;
        let (s, c) = (normal.dot(velocity), normal.cross(spin));
        let d = &self.difference;
        (d.zeroth * s + d.first.dot(&c), d.first * s + d.second * c)
    }

    fn wrench(&self, motion: &RigidMotion) -> Wrench {
        let RigidMotion { normal, velocity, spin } = motion;
        let (push, lever) = self.along_normal(motion);
        let (c, t) = (&self.central, &self.tangential);
        let drag = t.zeroth * velocity + spin.cross(&t.first);
        let drag_torque = t.first.cross(velocity) + t.second.trace() * spin - t.second * spin;
        Wrench { force: (c.zeroth - push) * normal - drag, torque: (c.first - lever).cross(normal) - drag_torque }
    }

    /// By m, the sums being kept.
    fn by_normal(&self, motion: &RigidMotion) -> WrenchSlope {
        let RigidMotion { normal, velocity, spin } = motion;
        let (push, lever) = self.along_normal(motion);
        let d = &self.difference;
        // ∂push/∂m and ∂lever/∂m, with ∂s/∂m = v and ∂c/∂m = −[Ω]×.
        let push_slope = d.zeroth * velocity + spin.cross(&d.first);
        let lever_slope = d.first * velocity.transpose() - d.second * cross_matrix(spin);
        WrenchSlope {
            force: Mat3::from_diagonal_element(self.central.zeroth - push) - normal * push_slope.transpose(),
            torque: cross_matrix(&(self.central.first - lever)) + cross_matrix(normal) * lever_slope,
        }
    }

    /// By v and by Ω: minus a symmetric 6×6 matrix, the resistance of the contact.
    fn by_motion(&self, normal: &Vec3) -> (WrenchSlope, WrenchSlope) {
        let (t, d) = (&self.tangential, &self.difference);
        let coupling = cross_matrix(&t.first) - normal * d.first.cross(normal).transpose();
        let translation = -d.zeroth * normal * normal.transpose() - Mat3::from_diagonal_element(t.zeroth);
        let across = cross_matrix(normal);
        let rotation = t.second - Mat3::from_diagonal_element(t.second.trace()) + across * d.second * across;
        (
            WrenchSlope { force: translation, torque: coupling.transpose() },
            WrenchSlope { force: coupling, torque: rotation },
        )
    }
}

impl RigidMotion {
    /// ∫κ (m·u)² dA = s² A₀ + 2s c·A₁ + c·A₂c.
    fn squared_along_normal(&self, sums: &Sums) -> f64 {
        let (s, c) = (self.normal.dot(&self.velocity), self.normal.cross(&self.spin));
        s * (s * sums.zeroth + 2.0 * c.dot(&sums.first)) + c.dot(&(sums.second * c))
    }

    /// ∫κ |u|² dA = v² A₀ + 2 v·(Ω×A₁) + tr A₂ Ω² − Ω·A₂Ω.
    fn squared(&self, sums: &Sums) -> f64 {
        let (v, spin) = (&self.velocity, &self.spin);
        v.norm_squared() * sums.zeroth
            + 2.0 * v.dot(&spin.cross(&sums.first))
            + sums.second.trace() * spin.norm_squared()
            - spin.dot(&(sums.second * spin))
    }
}

impl RigidLoads {
    /// Integrates the laws of a contact over a surface.
    ///
    /// # Errors
    /// [`GapClosed`] if a point of the surface lies on or behind the plane.
    pub fn integrate(
        contact: &Contact,
        surface: &Surface,
        field: &GapField,
        motion: &RigidMotion,
        scratch: &mut ContactScratch,
    ) -> Result<Self, GapClosed> {
        let plan = contact.values();
        let moments = scratch.take(plan.requests().len());
        surface.planned_moments(field, plan, moments)?;
        let sums = Sums::by_action(contact, moments);
        let [_, normal, tangential] = &sums;
        Ok(Self {
            wrench: Actions::new(&sums).wrench(motion),
            damping_power: -motion.squared_along_normal(normal),
            friction_power: motion.squared_along_normal(tangential) - motion.squared(tangential),
        })
    }
}

impl ContactWrench {
    /// Integrates the laws of a contact and their derivatives over a surface.
    ///
    /// # Errors
    /// [`GapClosed`] if a point of the surface lies on or behind the plane.
    pub fn integrate(
        contact: &Contact,
        surface: &Surface,
        field: &GapField,
        motion: &RigidMotion,
        scratch: &mut ContactScratch,
    ) -> Result<Self, GapClosed> {
        let plan = contact.derivatives();
        let moments = scratch.take(plan.requests().len());
        surface.planned_moments(field, plan, moments)?;
        let sums = SumSlopes::new(contact, moments);
        let values = Actions::new(&sums.values);
        let through_gap = |slope: usize| {
            let [central, normal, tangential] = &sums.by_gap;
            Actions::new(&[central[slope], normal[slope], tangential[slope]]).wrench(motion)
        };
        let mut by_normal = values.by_normal(motion);
        for axis in 0..3 {
            let slope = through_gap(axis + 1);
            by_normal.force.set_column(axis, &(by_normal.force.column(axis) + slope.force));
            by_normal.torque.set_column(axis, &(by_normal.torque.column(axis) + slope.torque));
        }
        let (by_velocity, by_spin) = values.by_motion(&motion.normal);
        let (wrench, by_height) = (values.wrench(motion), through_gap(0));
        Ok(Self { wrench, by_height, by_normal, by_velocity, by_spin })
    }
}
