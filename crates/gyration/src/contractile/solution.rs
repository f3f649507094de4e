//! The balance of a contractile body solved at P, Ṗ, G, M and Q.
//!
//! With Σ = Fᵀ ∂φ/∂F and A as in `mobility`, the law of contraction is
//!
//!   A(V_G) = g Σ − g φ I + μ Fᵀ sym L F⁻ᵀ + Q − π I,       τ = g ∂φ/∂F Fᵀ + μ sym(L − F V_G F⁻¹),   S = (τ − π I) P⁻ᵀ
//!
//! - An incompressible material: tr V_G = tr L, and the trace of the law gives the pressure, without derivatives of L.
//! - tr V_G = 0 takes a multiplier in the place of the pressure. det P of an incompressible body is then kept too, and its
//!   pressure is that of the second derivative of det P, as of an affine body.
//! - If G is prescribed, so is V_G; the pressure is that of tr(P̈ P⁻¹) = tr L² + d(tr V_G)/dt, and Q is what is left of the law.
//!
//! With viscosity everything is in the axes N of FᵀF = N diag(c) Nᵀ: with D = F N, Fᵀ X F⁻ᵀ is Dᵀ X D diag(1/c) there.
//! Elastic stresses are symmetric to the last bit, and used without the mean that a pressure takes over, for the reason
//! told in `affine::solution`.

use super::mobility::{ContractionMobility, ElasticAxes};
use super::{ContractileBalance, Contraction, ContractionCommand, Pull};
use crate::affine::Constraint;
use crate::simd::{F64x4, SimdMat3};
use crate::tensor::Mat3;

const THIRD: f64 = 1.0 / 3.0;

/// What the derivative needs again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ContractionSolution<F> {
    /// F.
    pub elastic: SimdMat3<F>,
    /// P⁻ᵀ.
    pub across: SimdMat3<F>,
    /// L.
    pub l: SimdMat3<F>,
    /// g φ.
    pub energy: f64,
    /// V_G.
    pub velocity: SimdMat3<F>,
    /// Of F, where there is viscosity.
    pub axes: Option<ElasticAxes>,
    /// sym(Ḟ F⁻¹); zero without viscosity.
    straining: SimdMat3<F>,
    /// τ − π I, without internal friction that acts on L.
    pub kirchhoff: SimdMat3<F>,
    /// τ_L.
    medium: Option<SimdMat3<F>>,
    pub acceleration: SimdMat3<F>,
    /// Where the pressure is that of the second derivative of det P.
    pub constraint: Option<Constraint<F>>,
    /// π.
    pressure: f64,
}

/// What a contraction answers to.
struct Loaded<F> {
    /// g ∂φ/∂F Fᵀ without its mean.
    deviator: SimdMat3<F>,
    /// sym L.
    strain_rate: SimdMat3<F>,
    /// gφ less that mean: what is taken away where nothing is incompressible.
    free: f64,
    /// tr L.
    growth: f64,
}

/// F and what turns the law of contraction into its axes.
struct ElasticFrame<F> {
    elastic: SimdMat3<F>,
    /// G and P⁻ᵀ.
    own: SimdMat3<F>,
    across: SimdMat3<F>,
    axes: Option<ElasticAxes>,
}

impl<F: F64x4> ElasticFrame<F> {
    /// F⁻¹.
    #[inline(always)]
    fn back(&self) -> SimdMat3<F> {
        self.own.times_transposed(&self.across)
    }

    /// Fᵀ X F⁻ᵀ + Q, in the axes.
    #[inline(always)]
    fn pulled(&self, stress: &SimdMat3<F>, drive: &SimdMat3<F>) -> SimdMat3<F> {
        let Some(ElasticAxes { axes, carried, inverses, .. }) = &self.axes else {
            return self.elastic.transpose().times(stress).times_transposed(&self.back()) + *drive;
        };
        let registers = stress.0[0].0;
        let (n, d) = (axes.with(registers), carried.with(registers));
        d.transpose().times(stress).times(&d.scaled(inverses)) + n.transpose().times(drive).times(&n)
    }

    /// V_G, F V_G F⁻¹ and the multiple of I that the law of contraction takes away.
    #[inline(always)]
    fn contract(
        &self,
        pull: &Pull<'_>,
        command: &ContractionCommand,
        loaded: &Loaded<F>,
    ) -> (SimdMat3<F>, SimdMat3<F>, f64) {
        let Pull { body, contraction, .. } = *pull;
        let Loaded { deviator, strain_rate, free, growth } = loaded;
        let registers = deviator.0[0].0;
        let drive = match command {
            ContractionCommand::Drive(drive) => SimdMat3::load(drive, registers),
            ContractionCommand::Velocity(velocity, _) => {
                let velocity = SimdMat3::load(velocity, registers);
                return (velocity, self.elastic.times(&velocity).times(&self.back()), 0.0);
            }
        };
        let viscosity = body.viscosity.kirchhoff;
        let stress = if viscosity > 0.0 { *deviator + *strain_rate * viscosity } else { *deviator };
        let stress = self.pulled(&stress, &drive);
        let excess = match (contraction.kept_volume, body.is_incompressible()) {
            (Some(_), _) => stress.trace() * THIRD,
            (None, true) => (stress.trace() - (contraction.viscosity + viscosity) * growth) * THIRD,
            (None, false) => *free,
        };
        let mobility =
            ContractionMobility::new([contraction.viscosity, viscosity], contraction.spin, self.axes.as_ref());
        let [velocity, carried] = self.pushed(&mobility.velocity(&stress.plus_unit(-excess)));
        (velocity, carried, excess)
    }

    /// V and F V F⁻¹ of a V in the axes.
    #[inline(always)]
    fn pushed(&self, velocity: &SimdMat3<F>) -> [SimdMat3<F>; 2] {
        let Some(ElasticAxes { axes, carried, inverses, .. }) = &self.axes else {
            return [*velocity, self.elastic.times(velocity).times(&self.back())];
        };
        let registers = velocity.0[0].0;
        let (n, d) = (axes.with(registers), carried.with(registers));
        [n.times(velocity).times_transposed(&n), d.times(velocity).times_transposed(&d.scaled(inverses))]
    }
}

impl<F: F64x4> ContractionSolution<F> {
    #[inline(always)]
    pub fn new(pull: &Pull<'_>, command: &ContractionCommand, moment: &SimdMat3<F>) -> Self {
        let Pull { body, contraction, at, decomposition } = *pull;
        let registers = moment.0[0].0;
        let elastic = SimdMat3::load(&decomposition.elastic, registers);
        let across = SimdMat3::load(&at.inverse, registers).transpose();
        let l = SimdMat3::load(&at.velocity_gradient, registers);
        let ratio = decomposition.volume_ratio;
        let (energy, stress) = match &body.material {
            Some(material) => material.energy_and_kirchhoff_stress(&elastic, at.volume_ratio / ratio),
            None => (0.0, SimdMat3::default().with(registers)),
        };
        let (energy, elastic_stress) = (ratio * energy, stress * ratio);
        let mean = elastic_stress.trace() * THIRD;
        let deviator = elastic_stress.plus_unit(-mean);
        let viscosity = body.viscosity.kirchhoff;
        let strain_rate = l.symmetric();
        let incompressible = body.is_incompressible();
        let own_pressure = incompressible && contraction.gives_pressure();

        let own = SimdMat3::load(&decomposition.contraction, registers);
        let frame = ElasticFrame { elastic, own, across, axes: ElasticAxes::of(&elastic.kept(), viscosity) };
        let loaded = Loaded { deviator, strain_rate, free: energy - mean, growth: l.trace() };
        let (velocity, carried, excess) = frame.contract(pull, command, &loaded);

        // π = excess + mean − gφ of an incompressible material whose law of contraction tells it.
        let (left, mut pressure) = match (incompressible, own_pressure) {
            (false, _) => (mean, 0.0),
            (true, true) => (energy - excess, excess + mean - energy),
            (true, false) => (0.0, mean),
        };
        let mut kirchhoff = deviator.plus_unit(left);
        let mut straining = SimdMat3::default().with(registers);
        if viscosity > 0.0 {
            straining = (l - carried).symmetric();
            kirchhoff += straining * viscosity;
        }
        let medium = body.medium_stress(at, &l);
        let stress = if let Some(medium) = medium { kirchhoff + medium } else { kirchhoff };
        let free = *moment - stress.times(&across) * body.volume;
        let mut acceleration = body.per_inertia(&free);
        let constraint = if incompressible && !own_pressure { Some(Constraint::new(body, &across)) } else { None };
        if let Some(constraint) = &constraint {
            let growing = if let ContractionCommand::Velocity(_, growing) = command { *growing } else { 0.0 };
            let push = constraint.push(&free, l.dot(&l.transpose()) + growing);
            acceleration += constraint.way * push;
            kirchhoff = kirchhoff.plus_unit(-push / body.volume);
            pressure += push / body.volume;
        }
        let axes = frame.axes;
        Self {
            elastic,
            across,
            l,
            energy,
            velocity,
            axes,
            straining,
            kirchhoff,
            medium,
            acceleration,
            constraint,
            pressure,
        }
    }

    /// What is told of it.
    #[inline(always)]
    pub fn balance(&self, pull: &Pull<'_>, command: &ContractionCommand) -> ContractileBalance {
        let Pull { body, contraction, decomposition, .. } = *pull;
        let Self { elastic, across, l, velocity, straining, kirchhoff, medium, .. } = self;
        let own = SimdMat3::load(&decomposition.contraction, across.0[0].0);
        let drive = match command {
            ContractionCommand::Drive(drive) => *drive,
            ContractionCommand::Velocity(velocity, _) => {
                let back = own.times_transposed(across);
                let mandel = elastic.transpose().times(kirchhoff).times_transposed(&back);
                velocity * contraction.viscosity - mandel.matrix() + Mat3::from_diagonal_element(self.energy)
            }
        };
        let contraction_velocity = velocity.matrix();
        let mut viscous = body.viscosity.kirchhoff * straining.dot(straining);
        let mut stress = *kirchhoff;
        if let Some(medium) = medium {
            viscous += medium.dot(l);
            stress += *medium;
        }
        ContractileBalance {
            acceleration: self.acceleration.matrix(),
            contraction_velocity,
            contraction_rate: velocity.times(&own).matrix(),
            drive,
            stress: stress.times(across).matrix(),
            pressure: body.is_incompressible().then_some(self.pressure),
            friction: body.volume * viscous,
            drag: body.volume * contraction.viscosity * velocity.dot(velocity),
            drive_power: body.volume * drive.dot(&contraction_velocity),
        }
    }
}

impl Contraction {
    /// Whether the law of contraction gives the pressure of an incompressible material.
    pub(crate) fn gives_pressure(&self) -> bool {
        self.is_driven() && self.kept_volume.is_none()
    }
}
