//! The history of a rigid sphere in a fluid with inertia, as loads and state.
//!
//!   f = −6πηR Σ c_k (w − y_k) + m_a (du∞/dt − p̈₀) + m_f Du∞/Dt,       m_a = 6πηR (τ/9 + rest)
//!   T = −8πηR³ Σ C_k (ω_w − Y_k) + I_a (dω∞/dt − ω̇),                    I_a = 8πηR³ rest
//!   y_k′ = s_k (w − y_k),   Y_k′ = S_k (ω_w − Y_k)
//!
//! beside the steady drag. w = ṗ₀ − u∞ and ω_w = ω − ½ rot u∞ are taken along the path of the sphere, d/dt = ∂/∂t +
//! ṗ₀·∇, and Du∞/Dt along that of the fluid, whose pressure gradient it is. y_k and Y_k are in the axes of space. m_a
//! and I_a stand on the left of the balance. Source: `history`; Maxey and Riley (1983).

use super::ambient::{Flow, Fluid};
use super::unsteady::{Exponentials, UnresolvedHistory};
use crate::tensor::{Mat3, Vec3, axial};
use std::f64::consts::PI;

/// What a sphere brings for its history.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Of its translation.
    pub translation: Exponentials,
    /// Of its rotation.
    pub rotation: Exponentials,
    /// 6πηR \[N s/m\].
    drag: f64,
    /// 8πηR³ \[N m s\].
    spin_drag: f64,
    /// m_f \[kg\].
    displaced: f64,
    /// m_a \[kg\].
    pub added_mass: f64,
    /// I_a \[kg m²\].
    pub added_inertia: f64,
}

/// The loads of the history at one instant, without those that are proportional to the accelerations of the sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryLoads {
    /// Force \[N\].
    pub force: Vec3,
    /// Torque in the axes of space \[N m\].
    pub torque: Vec3,
    /// The part of the torque that does not depend on the spin.
    pub given: Vec3,
    /// ∂f/∂p₀.
    pub by_place: Mat3,
    /// ∂f/∂ṗ₀.
    pub by_velocity: Mat3,
    /// ∂T/∂ω, a multiple of one.
    pub by_spin: f64,
    /// w.
    pub slip: Vec3,
    /// ω_w.
    pub spin_slip: Vec3,
}

impl History {
    /// The history of a sphere of a radius \[m\] in a fluid of viscosity \[Pa s\] and density \[kg/m³\] over a span of
    /// time \[s\], to an error as in [`Exponentials`].
    ///
    /// # Errors
    /// [`UnresolvedHistory`] for numbers out of all proportion.
    pub fn of_sphere(
        radius: f64,
        [viscosity, density]: [f64; 2],
        span: f64,
        error: f64,
    ) -> Result<Self, UnresolvedHistory> {
        let tau = density * radius * radius / viscosity;
        let translation = Exponentials::of_translation(tau, span, error)?;
        let rotation = Exponentials::of_rotation(tau, span, error)?;
        let (drag, spin_drag) = (6.0 * PI * viscosity * radius, 8.0 * PI * viscosity * radius.powi(3));
        Ok(Self {
            drag,
            spin_drag,
            displaced: 4.0 / 3.0 * PI * density * radius.powi(3),
            added_mass: drag * (tau / 9.0 + translation.rest),
            added_inertia: spin_drag * rotation.rest,
            translation,
            rotation,
        })
    }

    /// How many numbers of state it has.
    pub fn dimension(&self) -> usize {
        3 * (self.translation.rates.len() + self.rotation.rates.len())
    }

    /// The loads, of a sphere at a place that moves and turns in the axes of space; `modes` are y_k, then Y_k.
    pub fn loads(
        &self,
        (fluid, flow, time): (&Fluid, &Flow, f64),
        (place, velocity, spin): (&Vec3, &Vec3, &Vec3),
        modes: &[f64],
    ) -> HistoryLoads {
        let ambient = flow.at(place);
        let (slip, spin_slip) = (velocity - ambient, spin - 0.5 * axial(&flow.gradient));
        let (changing, spreading) = fluid.rate(time, place);
        let (trailing, turning) = modes.split_at(3 * self.translation.rates.len());
        let (weight, trail) = (sum(&self.translation.weights), weighed(&self.translation.weights, trailing));
        let (spin_weight, spin_trail) = (sum(&self.rotation.weights), weighed(&self.rotation.weights, turning));
        let l = &flow.gradient;
        let pressed = self.displaced * (changing + l * ambient);
        let force = self.drag * (trail - weight * slip) + self.added_mass * (changing + l * velocity) + pressed;
        let given =
            self.spin_drag * (spin_trail + 0.5 * spin_weight * axial(l)) + self.added_inertia * 0.5 * axial(&spreading);
        let by_spin = -self.spin_drag * spin_weight;
        HistoryLoads {
            force,
            torque: given + by_spin * spin,
            given,
            by_place: self.drag * weight * l + self.added_mass * spreading + self.displaced * (spreading + l * l),
            by_velocity: self.added_mass * l - Mat3::from_diagonal_element(self.drag * weight),
            by_spin,
            slip,
            spin_slip,
        }
    }

    /// The rates of the modes.
    pub fn rates(&self, history: &HistoryLoads, modes: &[f64], rates: &mut [f64]) {
        let slips = self.translation.rates.iter().map(|rate| (rate, &history.slip));
        let spins = self.rotation.rates.iter().map(|rate| (rate, &history.spin_slip));
        let each = modes.chunks_exact(3).zip(rates.chunks_exact_mut(3));
        for ((rate, slip), (mode, out)) in slips.chain(spins).zip(each) {
            for axis in 0..3 {
                out[axis] = rate * (slip[axis] - mode[axis]);
            }
        }
    }

    /// What a mode of y or Y does to the force or the torque, 6πηR c_k and 8πηR³ C_k, with its rate; y first.
    pub fn modes(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        fn each(history: &Exponentials, drag: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
            history.weights.iter().zip(&history.rates).map(move |(weight, rate)| (drag * weight, *rate))
        }
        each(&self.translation, self.drag).chain(each(&self.rotation, self.spin_drag))
    }
}

fn sum(weights: &[f64]) -> f64 {
    weights.iter().sum()
}

/// Σ c_k y_k.
fn weighed(weights: &[f64], modes: &[f64]) -> Vec3 {
    weights.iter().zip(modes.chunks_exact(3)).map(|(weight, mode)| *weight * Vec3::new(mode[0], mode[1], mode[2])).sum()
}
