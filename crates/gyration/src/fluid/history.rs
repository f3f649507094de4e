//! The history of a sphere in a fluid with inertia, as loads and state.
//!
//!   f = −6πηR Σ c_k (w − y_k) + m_a (du∞/dt − p̈₀) + m_f Du∞/Dt,       m_a = 6πηR (τ/9 + rest)
//!   T = −8πηR³ Σ C_k (ω_w − Y_k) + I_a (dω∞/dt − ω̇),                    I_a = 8πηR³ rest
//!   y_k′ = s_k (w − y_k),   Y_k′ = S_k (ω_w − Y_k)
//!
//! beside the steady drag. w = ṗ₀ − u∞ and ω_w = ω − ½ rot u∞ are taken along the path of the sphere, d/dt = ∂/∂t +
//! ṗ₀·∇, and Du∞/Dt along that of the fluid, whose pressure gradient it is. y_k and Y_k are in the axes of space. m_a
//! and I_a stand on the left of the balance. The fastest modes trail w by some 1e-12 of it, with weights of 1e6: the
//! differences w − y_k are taken with the low halves of the state. A sphere that deforms, and one in a flow that
//! strains, has the history of its strain as well (`straining`). Source: `unsteady`; Maxey and Riley (1983).

use super::ambient::{Flow, Fluid};
use super::straining::{STRAIN_NUMBERS, StrainHistory, StrainLoads};
use super::unsteady::{Exponentials, UnresolvedHistory};
use crate::extended::{Extended, ExtendedVec3, Numbers};
use crate::load::Loads;
use crate::tensor::{Mat3, Vec3, axial};
use std::f64::consts::PI;

/// What a sphere brings for its history.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Of its translation.
    pub translation: Exponentials,
    /// Of its rotation, and of its strain.
    pub rotation: Exponentials,
    /// That of the strain, if it counts.
    pub strain: Option<StrainHistory>,
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
    slip: ExtendedVec3,
    /// ω_w.
    spin_slip: ExtendedVec3,
    /// Of the strain, if that counts.
    pub strain: Option<StrainLoads>,
}

/// Force and moment of the history and of the added mass, in the axes of space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HistoryReaction {
    /// f \[N\].
    pub force: Vec3,
    /// Nᵀ \[N m\]: ½ [T]× of a torque T, and of what strains a symmetric tensor.
    pub couple: Mat3,
}

impl HistoryReaction {
    /// f and M = Nᵀ P⁻ᵀ.
    pub fn loads(&self, inverse: &Mat3) -> Loads {
        Loads { force: self.force, moment: self.couple * inverse.transpose() }
    }
}

impl History {
    /// The history of a rigid sphere of a radius \[m\] in a fluid of viscosity \[Pa s\] and density \[kg/m³\] over a
    /// span of time \[s\], to an error as in [`Exponentials`].
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
            strain: None,
        })
    }

    /// The same of a sphere whose strain against the fluid counts.
    ///
    /// # Errors
    /// [`UnresolvedHistory`] for numbers out of all proportion.
    pub fn of_straining_sphere(radius: f64, fluid: [f64; 2], span: f64, error: f64) -> Result<Self, UnresolvedHistory> {
        let mut history = Self::of_sphere(radius, fluid, span, error)?;
        let strain = StrainHistory::of_sphere(radius, fluid, &history.rotation, history.added_inertia);
        history.strain = Some(strain);
        Ok(history)
    }

    /// How many numbers of state it has.
    pub fn dimension(&self) -> usize {
        let of_strain = self.strain.map_or(0, |_| STRAIN_NUMBERS * self.rotation.rates.len());
        self.strain_modes() + of_strain
    }

    /// The place of the first mode of the strain.
    pub(crate) fn strain_modes(&self) -> usize {
        3 * (self.translation.rates.len() + self.rotation.rates.len())
    }

    /// The loads, of a sphere at a place with the velocity of its centre and the gradient L; `modes` are y_k, then Y_k,
    /// then those of the strain.
    pub(crate) fn loads(
        &self,
        (fluid, flow, time): (&Fluid, &Flow, f64),
        (place, velocity, gradient): (&Vec3, &ExtendedVec3, &Mat3),
        modes: Numbers,
    ) -> HistoryLoads {
        let ambient = flow.at(place);
        let moving = Vec3::from(velocity.map(Extended::value));
        let slip = [0, 1, 2].map(|i| velocity[i] - Extended::from(ambient[i]));
        let spin = 0.5 * axial(gradient);
        let turning: Vec3 = spin - 0.5 * axial(&flow.gradient);
        let spin_slip = [0, 1, 2].map(|i| Extended::from(turning[i]));
        let (changing, spreading) = fluid.rate(time, place);
        let behind = weighed(&self.translation, &slip, modes, 0);
        let spun_behind = weighed(&self.rotation, &spin_slip, modes, 3 * self.translation.rates.len());
        let (weight, spin_weight) = (sum(&self.translation.weights), sum(&self.rotation.weights));
        let l = &flow.gradient;
        let pressed = self.displaced * (changing + l * ambient);
        let force = self.added_mass * (changing + l * moving) + pressed - self.drag * behind;
        let torque = self.added_inertia * 0.5 * axial(&spreading) - self.spin_drag * spun_behind;
        let by_spin = -self.spin_drag * spin_weight;
        let stirred = [&flow.gradient, &spreading];
        let of_strain =
            |strain: &StrainHistory| strain.loads(&self.rotation, stirred, gradient, (modes, self.strain_modes()));
        HistoryLoads {
            force,
            torque,
            given: torque - by_spin * spin,
            by_place: self.drag * weight * l + self.added_mass * spreading + self.displaced * (spreading + l * l),
            by_velocity: self.added_mass * l - Mat3::from_diagonal_element(self.drag * weight),
            by_spin,
            slip,
            spin_slip,
            strain: self.strain.as_ref().map(of_strain),
        }
    }

    /// The rates of the modes.
    pub(crate) fn rates(&self, history: &HistoryLoads, modes: Numbers, rates: &mut [f64]) {
        let slips = self.translation.rates.iter().map(|rate| (rate, &history.slip));
        let spins = self.rotation.rates.iter().map(|rate| (rate, &history.spin_slip));
        for (mode, ((rate, slip), out)) in slips.chain(spins).zip(rates.chunks_exact_mut(3)).enumerate() {
            out.copy_from_slice((*rate * modes.behind(slip, 3 * mode)).as_slice());
        }
        if let Some(strain) = &history.strain {
            let from = self.strain_modes();
            strain.rates(&self.rotation, (modes, from), &mut rates[from..]);
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

/// Σ c_k (w − y_k), of the modes from a place on.
fn weighed(history: &Exponentials, slip: &ExtendedVec3, modes: Numbers, from: usize) -> Vec3 {
    let each = history.weights.iter().enumerate();
    each.map(|(mode, weight)| *weight * modes.behind(slip, from + 3 * mode)).sum()
}
