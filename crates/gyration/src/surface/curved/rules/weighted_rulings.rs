//! Rulings of a deformed wall, for several weights at once.
//!
//! The integrals L_j along a ruling do not depend on the weight, which is a function of the azimuth: they are found
//! once and added to the sums of every weight, those with w₊ = ½ (w(φ) + w(−φ)) and those with w₋ sin φ, w₋ = ½ (w(φ) −
//! w(−φ)).

use pulp::{Simd, WithSimd};

use super::integrand::LANES;
use super::rulings::{RulingSums, RulingSweep, Rulings, rows_of};
use super::weight::{Weights, bases};
use crate::simd::{F64s, Row, WIDTH, dispatch};
use crate::surface::MomentRequest;
use crate::tensor::Vec3;

/// Weights that depend on the azimuth only.
pub(crate) struct WallWeights<'a, const N: usize, const W: usize> {
    /// x, y, z of the current area vector v = z + cos φ x + sin φ y.
    pub(crate) vectors: [Vec3; 3],
    pub(crate) weights: &'a Weights<N, W>,
}

impl Rulings<'_> {
    /// For each weight w the sums with w₊ and those with w₋ sin φ, w± = ½ (w(φ) ± w(−φ)).
    pub(crate) fn weighted_sums<const N: usize, const W: usize>(
        &self,
        request: &MomentRequest,
        weights: &WallWeights<N, W>,
    ) -> [[RulingSums; 2]; W] {
        let line = self.line(request);
        dispatch(WeightedSweep { sweep: RulingSweep::new(self, &line, request), weights })
    }
}

/// The pass with several weights.
struct WeightedSweep<'a, const N: usize, const W: usize> {
    sweep: RulingSweep<'a>,
    weights: &'a WallWeights<'a, N, W>,
}

impl<const N: usize, const W: usize> WithSimd for WeightedSweep<'_, N, W> {
    type Output = [[RulingSums; 2]; W];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        match self.sweep.order {
            1 => self.sums::<S, 1>(simd),
            2 => self.sums::<S, 2>(simd),
            _ => self.sums::<S, 3>(simd),
        }
    }
}

impl<const N: usize, const W: usize> WeightedSweep<'_, N, W> {
    #[inline(always)]
    fn sums<S: Simd, const ORDER: usize>(&self, simd: S) -> [[RulingSums; 2]; W] {
        let Rulings { ring, near, reach, cut, .. } = *self.sweep.rulings;
        let mut sums = [[[[0.0; WIDTH]; 13]; 2]; W];
        for pair in ring.chunks(WIDTH / LANES) {
            if near + reach * pair[0].versine[0] > cut {
                break;
            }
            let [weight, cos, versine, sin_squared] = rows_of(pair);
            for register in 0..WIDTH / S::F64_LANES {
                let load = |row: &Row| F64s::<S>::load(simd, row, register);
                let line = self.sweep.line::<S, ORDER>(load(&versine) * reach + near);
                let (weight, cos, sin_squared) = (load(&weight), load(&cos), load(&sin_squared));
                let sin = sin_squared.sqrt();
                let [plus, minus] = self.weights.at(cos, sin);
                for (place, [even, odd]) in sums.iter_mut().enumerate() {
                    let half = weight * 0.5;
                    let (w, v) = (half * (plus[place] + minus[place]), half * (plus[place] - minus[place]) * sin);
                    self.sweep.add::<S, ORDER>(&line, (w, cos, sin_squared), register, even);
                    self.sweep.add::<S, ORDER>(&line, (v, cos, sin_squared), register, odd);
                }
            }
        }
        sums.map(|parities| parities.map(|rows| RulingSums::folded(&rows)))
    }
}

impl<const N: usize, const W: usize> WallWeights<'_, N, W> {
    /// The weights at φ and at −φ.
    #[inline(always)]
    fn at<S: Simd>(&self, cos: F64s<S>, sin: F64s<S>) -> [[F64s<S>; W]; 2] {
        let [x, y, z] = &self.vectors;
        let even = [cos * x[0] + z[0], cos * x[1] + z[1], cos * x[2] + z[2]];
        let odd = [sin * y[0], sin * y[1], sin * y[2]];
        [
            self.of(&[even[0] + odd[0], even[1] + odd[1], even[2] + odd[2]]),
            self.of(&[even[0] - odd[0], even[1] - odd[1], even[2] - odd[2]]),
        ]
    }

    /// The weights of the area vector v.
    #[inline(always)]
    fn of<S: Simd>(&self, v: &[F64s<S>; 3]) -> [F64s<S>; W] {
        let squared = (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2];
        let mut weights = [bases::<S, N>(squared); W];
        for (weight, factors) in weights.iter_mut().zip(&self.weights.factors) {
            for &factor in factors {
                *weight = *weight * v[factor];
            }
        }
        weights
    }
}
