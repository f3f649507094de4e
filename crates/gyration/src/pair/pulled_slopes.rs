//! How what adhesion does changes with the places of both bodies: along a direction, with the change of the plane, of
//! p, and of all moments, those of what places the plane to third order.
//!
//!   δF_i = σ_i {δn⊗(A_i + e_i) + n⊗(δA_i + δe_i) − b_i [(δ log b_i p_t + δp_t)⊗a_i + p_t⊗δa_i]}
//!   K δp = −Σ [Z_iᵀ(δA_i + δ_p e_i) + δZ_iᵀ(A_i + e_i)] + Σ ±W_m (m−1) (δy_t; 0)
//!
//! δ_p is at a fixed p. Planes are counted in the chart in which y = (n, c) is affine in their three numbers; what |y|
//! brings to K there is stationary.

use super::areas::{AreaMoments, AreaPotentials, potentials_along};
use super::expansion::{Change, Expansion};
use super::fault::PairFault;
use super::laws::PairLaws;
use super::pulled::{Carried, Pulled, Term, by_plane, carried};
use super::side::{Half, Potential, contracted};
use super::state::PairState;
use super::{Mat4, Mat34, Vec4};
use crate::surface::Moments;
use crate::tensor::Vec3;

/// What adhesion does, on its way to its derivatives.
pub(super) struct PulledSlopes<'a> {
    pulled: &'a Pulled,
    halves: [&'a Half<'a>; 2],
    expansion: &'a Expansion,
    /// −∂h_i by z along ζ_i: ν(ν+1) ∫(α/d₀²)(d/d₀)^−(ν+2) (X̃·ζ) X̃⊗X̃ dA.
    bent: [Mat4; 2],
    /// The potentials of its powers as areas change.
    areas: [AreaPotentials; 2],
}

/// What changes of adhesion along a direction.
pub(super) struct PulledChange {
    /// δW, of the plane in balance.
    pub energy: f64,
    /// δ(f | M).
    pub on: [Mat34; 2],
}

impl<'a> PulledSlopes<'a> {
    /// From what adhesion does.
    ///
    /// # Errors
    /// [`PairFault`] if the plane does not separate the bodies.
    pub fn new(
        laws: &PairLaws,
        pulled: &'a Pulled,
        halves: [&'a Half<'a>; 2],
        expansion: &'a Expansion,
        (room, areas): ([&mut [Moments]; 2], &mut AreaMoments),
    ) -> Result<Self, PairFault> {
        let (coefficient, exponent) = (laws.coefficient, laws.repulsion.exponent);
        let mut bent = [Mat4::zeros(); 2];
        for (side, room) in room.into_iter().enumerate() {
            halves[side].moments(&expansion.plane, &laws.bent, room)?;
            let weighed = contracted(&room[0], &pulled.carried[side].heights);
            bent[side] = exponent * (exponent + 1.0) * coefficient * weighed;
        }
        let areas = match &laws.pull {
            Some(pull) => areas.pulling(pull, halves, &expansion.plane)?,
            None => Default::default(),
        };
        Ok(Self { pulled, halves, expansion, bent, areas })
    }

    /// Along a direction (δq_A, δq_B), with the change of the plane.
    pub fn along(&self, places: [&Mat34; 2], change: &Change) -> PulledChange {
        let Self { pulled, halves, expansion, .. } = self;
        let Pulled { pulls, turn, carried: own, .. } = pulled;
        let (normal, tangents) = (&expansion.plane.normal, &expansion.tangents);
        let scales = expansion.mean.weights_along(change.by_side).map(|weight| weight - change.growth);
        let held = self.carried_along(places, change, &scales);
        let bent = self.pulls_along(change);
        let sums = [0, 1].map(|i| bent[i] + held[i]);
        let mut right = -by_plane(*halves, tangents, sums.each_ref());
        for i in 0..2 {
            let turned = halves[i].sign * (places[i] * (pulls[i] + own[i].pull));
            right -= Vec3::new(tangents[0].dot(&turned), tangents[1].dot(&turned), 0.0);
        }
        let length: f64 = pulled
            .terms
            .iter()
            .flatten()
            .map(|Term { law, mean, .. }| law.sign * mean.energy * (law.exponent - 1.0))
            .sum();
        right += length * Vec3::new(change.plane.x, change.plane.y, 0.0);
        let shift = expansion.curvature.solve(&right);
        let (shifted, turned) = (carried(expansion, *halves, &shift), expansion.turned(&shift));
        let on = [0, 1].map(|i| {
            let Carried { scale, pull, .. } = &own[i];
            let pressed =
                change.normal * (pulls[i] + pull).transpose() + normal * (sums[i] + shifted[i].pull).transpose();
            let first = &expansion.potentials[i].first;
            let tilted = (scales[i] * turn + turned) * first.transpose() + turn * change.first[i].transpose();
            halves[i].sign * (pressed - *scale * tilted)
        });
        let power = |i: usize| pulled.on[i].dot(places[i]);
        PulledChange { energy: -(power(0) + power(1)), on }
    }

    /// δA of both.
    fn pulls_along(&self, change: &Change) -> [Vec4; 2] {
        let mut sums = [Vec4::zeros(); 2];
        for (term, areas) in self.pulled.terms.iter().zip(&self.areas) {
            let Some(term) = term else { continue };
            let areas = potentials_along(areas, &change.stretch).unwrap_or([Potential::ZERO; 2]);
            let growth = [0, 1].map(|i| {
                let Potential { value, first, .. } = &term.potentials[i];
                (areas[i].value - first.dot(&change.heights[i])) / value
            });
            let weights = term.mean.weights_along(growth);
            for i in 0..2 {
                let Potential { first, second, .. } = &term.potentials[i];
                sums[i] += term.weight(i) * (weights[i] * first - second * change.heights[i] + areas[i].first);
            }
        }
        sums
    }

    /// δ_p e of both, given δ log b.
    fn carried_along(&self, places: [&Mat34; 2], change: &Change, scales: &[f64; 2]) -> [Vec4; 2] {
        let Self { pulled, halves, expansion, bent, .. } = self;
        let (parts, power) = (expansion.mean.parts, expansion.mean.power);
        let own = &pulled.carried;
        let growth = &change.by_side;
        let areas = change.areas.unwrap_or([Potential::ZERO; 2]);
        let tilted = [0, 1].map(|i| halves[i].sign * places[i].tr_mul(&pulled.turn));
        let steeper = [0, 1].map(|i| {
            let Potential { value, first, .. } = &expansion.potentials[i];
            let bent =
                change.heights[i].dot(&own[i].stiff) - first.dot(&tilted[i]) - areas[i].first.dot(&own[i].heights);
            bent / value - own[i].growth * growth[i]
        });
        let of_mean = |i: usize| parts[i] * (steeper[i] - power * (growth[i] - change.growth) * own[i].growth);
        let mean = of_mean(0) + of_mean(1);
        [0, 1].map(|i| {
            let Potential { first, second, .. } = &expansion.potentials[i];
            let Carried { scale, weight, pull, .. } = &own[i];
            let heavier = power * mean - (1.0 + power) * steeper[i];
            let stiff = second * tilted[i] - bent[i] * change.heights[i] + areas[i].second * own[i].heights;
            scales[i] * pull + *scale * (stiff - heavier * first - *weight * change.first[i])
        })
    }
}

impl PairState<'_> {
    /// The change of (f | M) of adhesion on both sides, given that of the repulsion.
    pub fn adhesion_along(
        &self,
        slopes: &PulledSlopes,
        places: [&Mat34; 2],
        change: &Change,
        repulsion: &[Mat34; 2],
    ) -> [Mat34; 2] {
        let Pulled { energy, on, .. } = slopes.pulled;
        let switch = &self.placed.switch;
        let along = slopes.along(places, change);
        let risen = along.energy + switch.lifting * change.growth * energy;
        [0, 1].map(|i| {
            let own = switch.value * along.on[i] + switch.rise * change.growth * on[i];
            own + switch.lift * (*energy * repulsion[i] + risen * self.repulsion(i))
        })
    }
}
