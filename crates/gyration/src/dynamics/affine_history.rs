//! An affine sphere whose motion the fluid remembers: the balance with added mass and inertia.
//!
//!   (m + m_a) p̈₀ = m g + f,   P̈ J + 𝒦:(P̈ P⁻¹) P⁻ᵀ = M + C P⁻ᵀ − V S
//!   C = ½ [T]× + C_E + 𝒦:L²
//!
//! f, T and C_E with the loads of the history (`fluid::HistoryLoads`) that do not depend on the accelerations; f and M
//! with the steady loads of the fluid, which are those of the ellipsoid that the sphere has become. Source:
//! `docs/fluid-memory.md`.

use super::loads::Acting;
use crate::affine::{Accelerated, AddedBalance, AddedInertia, AffineBalance, AffineBody, Gyration};
use crate::body::{Affine, Slots};
use crate::fluid::{History, HistoryLoads, HistoryReaction, StrainLoads, deviator};
use crate::instant::MotionAt;
use crate::ledger::Work;
use crate::load::{LoadSlopes, Loads, unit};
use crate::tensor::{Mat3, Vec3, cross_matrix};

/// Such a sphere at one instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AffineHistory<'a> {
    at: &'a MotionAt<'a>,
    pub history: &'a History,
    interior: &'a AffineBody,
    gyration: &'a Gyration,
    loads: HistoryLoads,
    strain: StrainLoads,
    added: AddedInertia,
    /// L∞.
    pub flow: Mat3,
    /// The balance with added inertia.
    pub inertia: AddedBalance<'a>,
}

impl<'a> AffineHistory<'a> {
    /// None if the fluid forgets how the body moved.
    pub fn of(at: &'a MotionAt<'a>, affine: &'a Affine, gyration: &'a Gyration) -> Option<Self> {
        let MotionAt { model, time, body, motion, .. } = *at;
        let history = body.history()?;
        debug_assert!(history.strain.is_some(), "the history of a sphere that deforms has that of its strain");
        let (fluid, strain) = (model.fluid.as_deref()?, history.strain.as_ref()?);
        let flow = fluid.flow(time);
        let moving = (&motion.placement.position, &at.velocity(), &gyration.velocity_gradient);
        let loads = history.loads((fluid, &flow, time), moving, at.extra());
        let (interior, added) = (&affine.interior, strain.added);
        let inertia = AddedBalance::of(interior, gyration, added);
        Some(Self {
            at,
            history,
            interior,
            gyration,
            loads,
            strain: loads.strain?,
            added,
            flow: flow.gradient,
            inertia,
        })
    }

    /// m + m_a.
    pub fn mass(&self) -> f64 {
        self.at.body.solid.mass.mass + self.history.added_mass
    }

    /// C.
    fn couple(&self) -> Mat3 {
        let l = &self.gyration.velocity_gradient;
        0.5 * cross_matrix(&self.loads.torque) + self.strain.couple + self.added.of(&(l * l))
    }

    /// C P⁻ᵀ.
    fn moment(&self) -> Mat3 {
        self.couple() * self.gyration.inverse.transpose()
    }

    /// P̈, stress and pressure under the other loads.
    pub fn balance(&self, loads: &Loads) -> AffineBalance {
        let moment = loads.moment + self.moment();
        let mut balance = self.interior.balance(self.gyration, &moment);
        let Accelerated { acceleration, push } = self.accelerated(&balance);
        balance.acceleration = acceleration;
        if let Some(pressure) = &mut balance.pressure {
            let excess = push / self.interior.volume;
            *pressure += excess;
            balance.stress -= excess * self.gyration.inverse.transpose();
        }
        balance
    }

    /// P̈ with added inertia, of the balance of all loads without it.
    fn accelerated(&self, balance: &AffineBalance) -> Accelerated {
        self.inertia.solve(&(balance.acceleration * self.interior.euler_tensor))
    }

    /// Writes the rates, and adds the power of the history's loads.
    pub fn write(&self, acting: &mut Acting, acceleration: &Mat3, slots: &Slots, rates: &mut [f64]) {
        let velocity = &self.at.motion.velocity;
        let weight = self.at.body.solid.mass.mass * self.at.model.gravity;
        let linear: Vec3 = (weight + acting.total.force + self.loads.force) / self.mass();
        rates[slots.position()].copy_from_slice(velocity.velocity.as_slice());
        rates[slots.attitude()].copy_from_slice(velocity.gradient_rate.as_slice());
        rates[slots.velocity()].copy_from_slice(linear.as_slice());
        rates[slots.rate()].copy_from_slice(acceleration.as_slice());
        self.history.rates(&self.loads, self.at.extra(), &mut rates[slots.extra()]);
        let reaction = self.reaction(&linear, acceleration).loads(&self.gyration.inverse);
        acting.powers[Work::Fluid] += reaction.power(&velocity.velocity, &velocity.gradient_rate);
    }

    /// Force and moment of history and added mass at p̈₀ and P̈.
    pub fn reaction(&self, linear: &Vec3, acceleration: &Mat3) -> HistoryReaction {
        HistoryReaction {
            force: self.loads.force - self.history.added_mass * linear,
            couple: self.couple() - self.added.of(&(acceleration * self.gyration.inverse)),
        }
    }

    /// P̈ and q under M of all loads, C P⁻ᵀ among them.
    pub fn accelerated_by(&self, moment: &Mat3) -> Accelerated {
        self.accelerated(&self.interior.balance(self.gyration, moment))
    }

    /// Adds f and M of the history, without what is proportional to the accelerations, and their derivatives.
    pub fn add_to(&self, slopes: &mut LoadSlopes) {
        let moment = self.moment();
        slopes.loads += Loads { force: self.loads.force, moment };
        let (inverse, l) = (&self.gyration.inverse, &self.gyration.velocity_gradient);
        for axis in 0..3 {
            let force = |by: &Mat3| Loads { force: by.column(axis).into(), moment: Mat3::zeros() };
            slopes.add_by_place(axis, &force(&self.loads.by_place));
            slopes.add_by_rate(axis, &force(&self.loads.by_velocity));
        }
        for entry in 0..9 {
            let spread = unit(entry) * inverse;
            let moved = |moment: Mat3| Loads { force: Vec3::zeros(), moment };
            let by_rate = self.along(&spread) * inverse.transpose();
            // δL = −L δP P⁻¹, δM = δC P⁻ᵀ − M (P⁻¹ δP)ᵀ.
            let by_place =
                self.along(&-(l * spread)) * inverse.transpose() - moment * (inverse * unit(entry)).transpose();
            slopes.add_by_rate(3 + entry, &moved(by_rate));
            slopes.add_by_place(3 + entry, &moved(by_place));
        }
    }

    /// δC along δL.
    fn along(&self, change: &Mat3) -> Mat3 {
        let l = &self.gyration.velocity_gradient;
        let turning = 0.5 * (change - change.transpose());
        0.5 * self.loads.by_spin * turning
            + self.strain.by_strain * deviator(change)
            + self.added.of(&(change * l + l * change))
    }
}
