//! The explicit stepper: Prince's pair 9(7), for accuracy where the problem is not stiff.
//!
//!   Y_s = u₀ + h Σ a_sj k_j,   k_s = f(t₀ + c_s h, Y_s),   u₁ = u₀ + h Σ b_j k_j,   u = (y, w)
//!
//! The rate at the start is that at the end of the step before, taken after the projection, so that an accepted step
//! costs seventeen evaluations; its interpolant of order 8 costs none. Error: h Σ (b̂_j − b_j) k_j, which behaves like
//! h⁸. Stiffness: λ is seen at no cost from f(u₁) − f(Y₁₇) against u₁ − Y₁₇, both being approximations at t₁. Source:
//! as of `prince`; Hairer, Wanner II, §IV.2 (stiffness).

use crate::combination::Rates;
use crate::context::{Context, Point};
use crate::extended::{Extended, ExtendedMut};
use crate::interpolant::interpolation_weights;
use crate::layout::SystemLayout;
use crate::newton::Convergence;
use crate::norm::{Norm, norm};
use crate::prince::{ERROR, NODES, ROWS, STAGES, WEIGHTS};
use crate::report::Cause;
use crate::system::System;

/// The stability region is a disk of radius 4.6 over most of the left half-plane: h|λ| from which on a step counts as
/// limited by it.
const STABLE_MODULUS: f64 = 3.7;
/// −h Re λ from which on it does so where the direction decays: the error estimate of a solution that only follows its
/// forcing grows well before the boundary, and an oscillation resolved for accuracy has no decay to show.
const STABLE_DECAY: f64 = 1.5;

/// A step that has met its tolerance.
pub(crate) struct Trial {
    /// The error relative to the error allowed.
    pub error: Norm,
    /// The size of the correction by the projection.
    pub projection: f64,
    /// The part of its stability that the explicit step uses; 0 for an implicit one.
    pub stiffness: f64,
    /// How Newton's method of the implicit step has fared; none for an explicit one.
    pub convergence: Option<Convergence>,
}

/// Scratch of the explicit stepper, sized once.
#[derive(Debug, Clone, Default)]
pub(crate) struct Explicit {
    /// Rates of the stages and at the new state, one after the other.
    rates: Rates,
    stage: Vec<f64>,
    /// What the stage lacks.
    low: Vec<f64>,
    error: Vec<f64>,
}

impl Explicit {
    /// Scratch for vectors of the given width.
    pub fn new(width: usize) -> Self {
        let [stage, low, error] = std::array::from_fn(|_| vec![0.0; width]);
        Self { rates: Rates::new(STAGES + 1, width), stage, low, error }
    }

    /// Attempts a step from one point to `to`, whose time is set; `to` receives state, rate and scales.
    ///
    /// # Errors
    /// `Cause::Error` if the error exceeds what is allowed at either end, else what stopped the evaluations.
    pub fn attempt<S: System>(
        &mut self,
        context: &mut Context<'_, S>,
        from: &Point,
        h: f64,
        to: &mut Point,
    ) -> Result<Trial, Cause<S::Inadmissible>> {
        self.rates.row_mut(0).copy_from_slice(&from.rate);
        for (index, row) in ROWS.iter().enumerate() {
            let s = index + 1;
            let Self { rates, stage, low, .. } = self;
            rates.add_combined(ExtendedMut { high: stage, low }, from.extended(), h, row);
            let time = if s + 1 == STAGES { to.t } else { from.t + NODES[s] * h };
            context.evaluate(time, Extended { high: stage, low }, rates.row_mut(s))?;
        }
        self.rates.add_combined(ExtendedMut { high: &mut to.u, low: &mut to.low }, from.extended(), h, WEIGHTS);
        self.rates.combine(&mut self.error, h, ERROR);
        to.round();

        // Judged first by the scales of the start: a step far too long need not even be evaluated at its end.
        let layout = context.layout;
        norm(layout, &self.error, &from.scale, &from.scale).allow()?;
        let projection = context.land(to)?;
        context.scales(to);
        let error = norm(layout, &self.error, &from.scale, &to.scale).allow()?;
        let stiffness = self.stability_used(layout, from, to, h);
        Ok(Trial { error, projection, stiffness, convergence: None })
    }

    /// The part of the stability used: λ of the direction in which the last stage and the new state, both at t₁,
    /// differ.
    ///
    ///   |λ| ≈ ‖Δf‖/‖Δu‖,   Re λ ≈ Δf·Δu/‖Δu‖²,   the largest over the components
    ///
    /// Differences at the level of rounding say nothing and give 0.
    fn stability_used(&self, layout: &SystemLayout, from: &Point, to: &Point, h: f64) -> f64 {
        let last = self.rates.row(STAGES - 1);
        let apart = |i: usize| (to.u[i] - self.stage[i]) + (to.low[i] - self.low[i]);
        let mut largest: f64 = 0.0;
        for component in layout.components.iter() {
            let (mut rates, mut products, mut states, mut size) = (0.0, 0.0, 0.0, 0.0);
            for block in component {
                for i in layout.groups[*block].clone() {
                    let scale = from.scale[i];
                    let (rate, state) = ((to.rate[i] - last[i]) / scale, apart(i) / scale);
                    rates += rate * rate;
                    products += rate * state;
                    states += state * state;
                    size += (to.u[i] / scale).powi(2);
                }
            }
            if states > size * (100.0 * f64::EPSILON).powi(2) {
                let (modulus, decay) = ((rates / states).sqrt(), -products / states);
                largest = largest.max(h * modulus / STABLE_MODULUS).max(h * decay / STABLE_DECAY);
            }
        }
        largest
    }

    /// Completes the rates of an accepted step by the one at its end, for the interpolant.
    pub fn accept(&mut self, to: &Point) {
        self.rates.row_mut(STAGES).copy_from_slice(&to.rate);
    }

    /// The rates of a stage of the last step.
    pub fn rates_of(&self, stage: usize) -> &[f64] {
        self.rates.row(stage)
    }

    /// Puts rates in the place of those of a stage of the last step.
    pub fn put_rates(&mut self, stage: usize, rates: &[f64]) {
        self.rates.row_mut(stage).copy_from_slice(rates);
    }

    /// Hands u(θ) − u₀ of the last step to `put`, component by component.
    pub fn interpolate(&self, from: &Point, to: &Point, h: f64, theta: f64, mut put: impl FnMut(usize, f64)) {
        let weights = interpolation_weights(theta);
        self.rates.each_sum(&weights, |i, sum| {
            let change = (to.u[i] - from.u[i]) + (to.low[i] - from.low[i]);
            put(i, theta * change + h * sum);
        });
    }
}
