//! The balance of a contractile body solved at P, Ṗ, G, M and Q.
//!
//! With Λ = F⁻¹ L F, Σ = Fᵀ ∂φ/∂F and A as in `mobility`, the law of contraction is
//!
//!   A(V_G) = g Σ − g φ I + μ Fᵀ sym L F⁻ᵀ + Q − π I,       τ = g ∂φ/∂F Fᵀ + μ sym(L − F V_G F⁻¹),   S = (τ − π I) P⁻ᵀ
//!
//! - An incompressible material: tr V_G = tr L, and the trace of the law gives the pressure, without derivatives of L.
//! - tr V_G = 0 takes a multiplier in the place of the pressure. det P of an incompressible body is then kept too, and its
//!   pressure is that of the second derivative of det P, as of an affine body.
//! - If G is prescribed, so is V_G; the pressure is that of tr(P̈ P⁻¹) = tr L² + d(tr V_G)/dt, and Q is what is left of the law.
//!
//! Elastic stresses are symmetric to the last bit, and used without the mean that a pressure takes over, for the reason
//! told in `affine::solution`.

use super::decomposition::Split;
use super::mobility::{Axes, Mobility};
use super::{Contraction, Pull};
use crate::affine::Constraint;
use crate::columns::{Columns, UNIT};
use crate::tensor::Mat3;

/// What drives or prescribes the contraction at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Command {
    /// Q \[Pa\].
    Drive(Mat3),
    /// V_G \[1/s\] and d(tr V_G)/dt \[1/s²\].
    Velocity(Mat3, f64),
}

/// The balance of a contractile body and its law of contraction, solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContractileBalance {
    /// P̈ [1/s²].
    pub acceleration: Mat3,
    /// V_G = Ġ G⁻¹ [1/s].
    pub contraction_velocity: Mat3,
    /// Q, given or taken \[Pa\].
    pub drive: Mat3,
    /// S, internal friction that acts on L included [Pa].
    pub stress: Mat3,
    /// π [Pa]; none of a compressible material.
    pub pressure: Option<f64>,
    /// V (μ |sym Ḟ F⁻¹|² + τ_L·L) ≥ 0 [W], τ_L being internal friction that acts on L.
    pub friction: f64,
    /// V μ_γ |V_G|² ≥ 0 [W].
    pub drag: f64,
    /// V Q·V_G [W].
    pub drive_power: f64,
}

/// What the derivative needs again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Solution {
    pub split: Split,
    /// g φ and g ∂φ/∂F.
    pub energy: f64,
    pub elastic_stress: Columns,
    /// V_G.
    pub velocity: Columns,
    /// Where they were needed.
    pub axes: Option<Axes>,
    /// sym(Ḟ F⁻¹).
    pub straining: Columns,
    /// τ − π I, without internal friction that acts on L.
    pub kirchhoff: Columns,
    /// τ_L.
    pub medium: Columns,
    pub acceleration: Columns,
    /// Where the pressure is that of the second derivative of det P.
    pub constraint: Option<Constraint>,
    /// V times the part of the pressure that the constraint gives.
    pub push: f64,
    /// π.
    pub pressure: f64,
}

impl Solution {
    pub fn new(pull: &Pull<'_>, command: &Command, moment: &Columns) -> Self {
        let Pull { body, contraction, at, decomposition } = *pull;
        let split = decomposition.split(at);
        let Split { elastic, back, l, across, .. } = &split;
        let ratio = decomposition.volume_ratio;
        let (energy, stress) = body.material.as_ref().map_or_else(Default::default, |it| it.energy_and_stress(elastic));
        let (energy, elastic_stress) = (ratio * energy, stress * ratio);
        let viscosity = body.viscosity.kirchhoff;
        let strain_rate = l.symmetric();

        // Elastic stresses without their mean, that of the law of contraction and that of the balance.
        let mandel = elastic.transpose().times(&elastic_stress).symmetric();
        let mean = mandel.trace() / 3.0;
        let push_back = elastic_stress.times_transposed(elastic).symmetric();
        let deviator = push_back + Columns(UNIT) * (-push_back.trace() / 3.0);
        let incompressible = body.is_incompressible();
        let own_pressure = incompressible && contraction.gives_pressure();

        let mut axes = None;
        let (velocity, excess) = match command {
            Command::Velocity(velocity, _) => (Columns::of(velocity), 0.0),
            Command::Drive(drive) => {
                let mut stress = mandel + Columns(UNIT) * -mean + Columns::of(drive);
                if viscosity > 0.0 {
                    stress += elastic.transpose().times(&strain_rate).times_transposed(back) * viscosity;
                }
                let growth = match contraction.kept_volume {
                    Some(_) => Some(0.0),
                    None => own_pressure.then(|| l.trace()),
                };
                let excess = growth.map_or(energy - mean, |growth| {
                    (stress.trace() - (contraction.viscosity + viscosity) * growth) / 3.0
                });
                stress += Columns(UNIT) * -excess;
                axes = Axes::of(elastic, viscosity);
                let mobility = Mobility::new([contraction.viscosity, viscosity], contraction.spin, axes.as_ref());
                (in_axes(axes.as_ref(), &stress, |stress| mobility.velocity(stress)), excess)
            }
        };

        let straining = match velocity == Columns::default() {
            true => strain_rate,
            false => (*l - elastic.times(&velocity).times(back)).symmetric(),
        };
        // π = excess + mean − gφ of an incompressible material whose law of contraction tells it.
        let (left, mut pressure) = match (incompressible, own_pressure) {
            (false, _) => (mean, 0.0),
            (true, true) => (energy - excess, excess + mean - energy),
            (true, false) => (0.0, mean),
        };
        let mut kirchhoff = (deviator + Columns(UNIT) * left) + straining * viscosity;
        let medium = body.medium_stress(at);
        let free = *moment - (kirchhoff + medium).times(across) * body.volume;
        let mut acceleration = body.per_inertia(&free);
        let constraint = (incompressible && !own_pressure).then(|| Constraint::new(body, across));
        let mut push = 0.0;
        if let Some(constraint) = &constraint {
            let growth = if let Command::Velocity(_, growing) = command { *growing } else { 0.0 };
            push = constraint.push(&free, l.dot(&l.transpose()) + growth);
            acceleration += constraint.way * push;
            kirchhoff += Columns(UNIT) * (-push / body.volume);
            pressure += push / body.volume;
        }
        Self {
            split,
            energy,
            elastic_stress,
            velocity,
            axes,
            straining,
            kirchhoff,
            medium,
            acceleration,
            constraint,
            push,
            pressure,
        }
    }

    pub fn balance(&self, pull: &Pull<'_>, command: &Command) -> ContractileBalance {
        let Pull { body, contraction, .. } = *pull;
        let Self { split, velocity, straining, kirchhoff, medium, .. } = self;
        let drive = match command {
            Command::Drive(drive) => *drive,
            Command::Velocity(velocity, _) => {
                let mandel = split.elastic.transpose().times(kirchhoff).times_transposed(&split.back);
                velocity * contraction.viscosity - mandel.matrix() + Mat3::from_diagonal_element(self.energy)
            }
        };
        let contraction_velocity = velocity.matrix();
        let viscous = body.viscosity.kirchhoff * straining.dot(straining) + medium.dot(&split.l);
        ContractileBalance {
            acceleration: self.acceleration.matrix(),
            contraction_velocity,
            drive,
            stress: (*kirchhoff + *medium).times(&split.across).matrix(),
            pressure: body.is_incompressible().then_some(self.pressure),
            friction: body.volume * viscous,
            drag: body.volume * contraction.viscosity * velocity.dot(velocity),
            drive_power: body.volume * drive.dot(&contraction_velocity),
        }
    }
}

/// A map in the axes N, of a matrix outside them.
#[inline(always)]
fn in_axes(axes: Option<&Axes>, matrix: &Columns, map: impl Fn(&Columns) -> Columns) -> Columns {
    match axes {
        None => map(matrix),
        Some(turn) => turn.axes.times(&map(&turn.turned(matrix))).times_transposed(&turn.axes),
    }
}

impl Contraction {
    /// Whether the law of contraction gives the pressure of an incompressible material.
    pub(super) fn gives_pressure(&self) -> bool {
        self.is_driven() && self.kept_volume.is_none()
    }
}
