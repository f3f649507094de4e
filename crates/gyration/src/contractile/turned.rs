//! The balance of a contractile body at one instant in the axes N of C = FᵀF: what its derivative starts from.
//!
//! There gΣ = diag(m), and 𝓜(A) = (μ/2)(C A C⁻¹ + Aᵀ) goes number by number. With Λ = F⁻¹ L F the law of contraction
//! reads
//!
//!   A(V_G) = gΣ + 𝓜(Λ) + Q − e I,   Z = gΣ + 𝓜(Λ − V_G) − π I,   K = (μ/2) C (V_G − Λ) C⁻¹
//!
//! so that beyond Λ and NᵀQN nothing is multiplied: e = gφ of a compressible material; tr A(V_G) = (μ_γ + μ) tr Λ gives
//! e = gφ + π of an incompressible one, and tr A(V_G) = 0 where det G is kept. Where V_G is prescribed, or the pressure
//! is that of the second derivative of det P, V_G and Z are those of `solution`.

use super::mobility::{ContractionMobility, ElasticAxes};
use super::solution::ContractionSolution;
use super::{ContractionCommand, Pull};
use crate::material::Coaxial;
use crate::simd::{F64x4, SimdMat3, SimdVec3};
use crate::tensor::Mat3;

/// What decides tr V_G.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Volume {
    /// The stress.
    Free,
    /// tr L, by the pressure.
    Follows,
    /// It is zero.
    Kept,
    /// All of V_G is prescribed.
    Prescribed,
}

/// What a pressure adds that is that of the second derivative of det P.
#[derive(Debug, Clone, Copy)]
pub(super) struct TurnedReaction {
    /// P⁻ᵀ, P⁻ᵀ J⁻¹ and 1/tr(P⁻ᵀ J⁻¹ P⁻¹).
    pub across: SimdMat3,
    pub way: SimdMat3,
    pub compliance: f64,
    /// (F P̈ F − 2FLL)ᵀ and (FL)ᵀ with F = P⁻¹.
    pub by_gradient: SimdMat3,
    pub by_rate: SimdMat3,
}

/// The material in the axes, times g.
#[derive(Debug, Clone, Copy)]
pub(super) struct TurnedElastic<F> {
    /// gφ and m.
    pub energy: f64,
    pub mandel: [f64; 3],
    /// a, b and d of `material::coaxial`.
    pub own: SimdMat3<F>,
    pub other: SimdMat3<F>,
    pub along: SimdMat3<F>,
}

/// The balance in the axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turned<F> {
    /// N and F⁻ᵀ N.
    pub axes: SimdMat3<F>,
    pub back: SimdMat3<F>,
    /// Λ, K and Z.
    pub pulled: SimdMat3<F>,
    pub kept: SimdMat3<F>,
    pub total: SimdMat3<F>,
    /// V_Gᵀ, outside the axes.
    pub velocity: SimdMat3<F>,
    pub reaction: Option<TurnedReaction>,
}

impl Pull<'_> {
    pub(super) fn volume(&self) -> Volume {
        let Pull { body, contraction, .. } = *self;
        match (contraction.is_driven(), contraction.kept_volume, body.is_incompressible()) {
            (false, _, _) => Volume::Prescribed,
            (true, Some(_), _) => Volume::Kept,
            (true, None, true) => Volume::Follows,
            (true, None, false) => Volume::Free,
        }
    }

    #[inline(always)]
    pub(super) fn elastic<F: F64x4>(&self, axes: &ElasticAxes, registers: F) -> TurnedElastic<F> {
        let Pull { body, at, decomposition, .. } = *self;
        let g = decomposition.volume_ratio;
        let Coaxial { energy, mandel: [x, y, z], own, other, along } = match &body.material {
            Some(material) => material.coaxial(&axes.values, at.volume_ratio / g),
            None => Coaxial::default(),
        };
        TurnedElastic {
            energy: g * energy,
            mandel: [g * x, g * y, g * z],
            own: own.with(registers) * g,
            other: other.with(registers) * g,
            along: along.with(registers) * g,
        }
    }

    #[inline(always)]
    pub(super) fn turned<F: F64x4>(
        &self,
        (axes, mobility): (&ElasticAxes, &ContractionMobility),
        elastic: &TurnedElastic<F>,
        command: &ContractionCommand,
        moment: &Mat3,
    ) -> Turned<F> {
        let (registers, volume) = (elastic.own.0[0].0, self.volume());
        let (n, carried) = (axes.axes.with(registers), axes.carried.with(registers));
        let back = carried.scaled(&axes.inverses);
        let half = 0.5 * self.body.viscosity.kirchhoff;
        let ratios = axes.ratios().with(registers) * half;
        let l = SimdMat3::load(&self.at.velocity_gradient, registers);
        let pulled = back.transpose().times(&l).times(&carried);
        let constrained = self.body.is_incompressible() && !self.contraction.gives_pressure();
        if let (ContractionCommand::Drive(drive), false) = (command, constrained) {
            let mandel = diagonal(elastic.mandel).with(registers);
            let drive = n.transpose().times(&SimdMat3::load(drive, registers)).times(&n);
            let loaded = (mandel + pulled.entrywise(&ratios)) + (pulled.transpose() * half + drive);
            let [excess, level] = self.excess(volume, elastic.energy, [loaded.trace(), pulled.trace()]);
            let velocity = mobility.velocity(&loaded.plus_unit(-excess));
            let over = velocity - pulled;
            let kept = over.entrywise(&ratios);
            let total = (mandel - kept - over.transpose() * half).plus_unit(level);
            let velocity = n.times(&velocity.transpose()).times_transposed(&n);
            return Turned { axes: n, back, pulled, kept, total, velocity, reaction: None };
        }
        let solution = ContractionSolution::new(self, command, &SimdMat3::of(moment).with(registers));
        let total = carried.transpose().times(&solution.kirchhoff).times(&back);
        let over = n.transpose().times(&solution.velocity).times(&n) - pulled;
        let (kept, reaction) = (over.entrywise(&ratios), reaction(&solution));
        Turned { axes: n, back, pulled, kept, total, velocity: solution.velocity.transpose(), reaction }
    }

    /// e and −π, given the traces of A(V_G) + e I and Λ.
    #[inline(always)]
    fn excess(&self, volume: Volume, energy: f64, [trace, growth]: [f64; 2]) -> [f64; 2] {
        const THIRD: f64 = 1.0 / 3.0;
        let stretching = self.contraction.viscosity + self.body.viscosity.kirchhoff;
        match volume {
            Volume::Kept => [trace * THIRD, 0.0],
            Volume::Follows => {
                let excess = (trace - stretching * growth) * THIRD;
                [excess, energy - excess]
            }
            Volume::Free | Volume::Prescribed => [energy, 0.0],
        }
    }
}

#[inline(always)]
pub(super) fn diagonal([x, y, z]: [f64; 3]) -> SimdMat3 {
    SimdMat3([SimdVec3([x, 0.0, 0.0, 0.0]), SimdVec3([0.0, y, 0.0, 0.0]), SimdVec3([0.0, 0.0, z, 0.0])])
}

#[inline(always)]
fn reaction<F: F64x4>(solution: &ContractionSolution<F>) -> Option<TurnedReaction> {
    let constraint = solution.constraint.as_ref()?;
    let ContractionSolution { l, across, acceleration, .. } = solution;
    let carried = l.transpose().times(across);
    let straight = across.times_transposed(acceleration).times(across);
    Some(TurnedReaction {
        across: across.kept(),
        way: constraint.way.kept(),
        compliance: constraint.compliance,
        by_gradient: (straight - l.transpose().times(&carried) * 2.0).kept(),
        by_rate: carried.kept(),
    })
}
