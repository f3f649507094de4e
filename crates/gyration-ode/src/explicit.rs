//! The explicit stepper: Dormand–Prince 8(5,3), for accuracy where the problem is not stiff.
//!
//!   Y_s = u₀ + h Σ a_sj k_j,   k_s = f(t₀ + c_s h, Y_s),   u₁ = u₀ + h Σ b_j k_j,   u = (y, w)
//!
//! The rate at the start is that at the end of the step before, taken after the projection, so that an accepted step
//! costs twelve evaluations. Error: the two embedded solutions together, e = h e₅²/√(e₅² + 0.01 e₃²).
//! Stiffness: λ is seen at no cost from f(u₁) − f(Y₁₂) against u₁ − Y₁₂, both being approximations at t₁.
//! Source: Hairer, Nørsett, Wanner I, §II.10; Hairer, Wanner II, §IV.2 (stiffness).

use crate::dop853::{DENSE, DENSE_STAGES, ERROR_FIFTH, ERROR_THIRD, NODES, Row, STAGES, WEIGHTS};
use crate::newton::Convergence;
use crate::norm::{Norm, embedded_norm};
use crate::report::Cause;
use crate::system::{Context, Layout, Point, System};

/// The number of stages of a step.
const STEP_STAGES: usize = 12;

/// h|λ| from which on a step counts as limited by stability; on the negative real axis DOP853 is stable to 6.1.
const STABLE_MODULUS: f64 = 5.0;
/// −h Re λ from which on it does so where the direction decays: the error estimate of a solution that only follows its
/// forcing grows well before the boundary, and an oscillation resolved for accuracy has no decay to show.
const STABLE_DECAY: f64 = 2.0;

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
    /// Rates of the sixteen stages, one after the other.
    rates: Vec<f64>,
    stage: Vec<f64>,
    fifth: Vec<f64>,
    third: Vec<f64>,
    /// The four highest coefficients of the interpolant.
    pub dense: Vec<f64>,
}

impl Explicit {
    /// Scratch for vectors of the given width.
    pub fn new(width: usize) -> Self {
        let vector = vec![0.0; width];
        Self {
            rates: vec![0.0; 16 * width],
            stage: vector.clone(),
            fifth: vector.clone(),
            third: vector,
            dense: vec![0.0; 4 * width],
        }
    }

    /// The rate at the start of the last step.
    pub fn first_rate(&self) -> &[f64] {
        &self.rates[..self.stage.len()]
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
        let width = self.stage.len();
        self.rates[..width].copy_from_slice(&from.rate);
        for (index, row) in STAGES.iter().enumerate() {
            let s = index + 1;
            combine(&mut self.stage, &from.u, h, row, &self.rates);
            let time = if s + 1 == STEP_STAGES { to.t } else { from.t + NODES[s] * h };
            context.evaluate(time, &self.stage, &mut self.rates[s * width..(s + 1) * width])?;
        }
        combine(&mut to.u, &from.u, h, WEIGHTS, &self.rates);
        combine_alone(&mut self.fifth, h, ERROR_FIFTH, &self.rates);
        combine_alone(&mut self.third, h, ERROR_THIRD, &self.rates);

        // Judged first by the scales of the start: a step far too long need not even be evaluated at its end.
        let layout = context.layout;
        embedded_norm(layout, &self.fifth, &self.third, &from.scale, &from.scale).allow()?;
        let projection = context.land(to)?;
        context.scales(to);
        let error = embedded_norm(layout, &self.fifth, &self.third, &from.scale, &to.scale).allow()?;
        let stiffness = self.stability_used(layout, from, to, h);
        Ok(Trial { error, projection, stiffness, convergence: None })
    }

    /// The part of the stability used: λ of the direction in which the last stage and the new state, both at t₁, differ.
    ///
    ///   |λ| ≈ ‖Δf‖/‖Δu‖,   Re λ ≈ Δf·Δu/‖Δu‖²,   the largest over the blocks
    ///
    /// Differences at the level of rounding say nothing and give 0.
    fn stability_used(&self, layout: &Layout, from: &Point, to: &Point, h: f64) -> f64 {
        let last = &self.rates[(STEP_STAGES - 1) * self.stage.len()..];
        let mut largest: f64 = 0.0;
        for block in layout.blocks() {
            let (mut rates, mut products, mut states, mut size) = (0.0, 0.0, 0.0, 0.0);
            for i in block.clone() {
                let scale = from.scale[i];
                let (rate, state) = ((to.rate[i] - last[i]) / scale, (to.u[i] - self.stage[i]) / scale);
                rates += rate * rate;
                products += rate * state;
                states += state * state;
                size += (to.u[i] / scale).powi(2);
            }
            if states > size * (100.0 * f64::EPSILON).powi(2) {
                let (modulus, decay) = ((rates / states).sqrt(), -products / states);
                largest = largest.max(h * modulus / STABLE_MODULUS).max(h * decay / STABLE_DECAY);
            }
        }
        largest
    }

    /// Evaluates the three stages of dense output over an accepted step and forms its four highest coefficients.
    ///
    /// # Errors
    /// As an evaluation; the step itself is untouched.
    pub fn extend<S: System>(
        &mut self,
        context: &mut Context<'_, S>,
        from: &Point,
        h: f64,
        to: &Point,
    ) -> Result<(), Cause<S::Inadmissible>> {
        let width = self.stage.len();
        self.rates[STEP_STAGES * width..(STEP_STAGES + 1) * width].copy_from_slice(&to.rate);
        for (index, row) in DENSE_STAGES.iter().enumerate() {
            let s = STEP_STAGES + 1 + index;
            combine(&mut self.stage, &from.u, h, row, &self.rates);
            context.evaluate(from.t + NODES[s] * h, &self.stage, &mut self.rates[s * width..(s + 1) * width])?;
        }
        for (coefficient, row) in self.dense.chunks_exact_mut(width.max(1)).zip(DENSE) {
            combine_alone(coefficient, h, row, &self.rates);
        }
        Ok(())
    }
}

/// out = base + h Σ a_j k_j.
fn combine(out: &mut [f64], base: &[f64], h: f64, row: Row, rates: &[f64]) {
    combine_alone(out, h, row, rates);
    for (value, base) in out.iter_mut().zip(base) {
        *value += base;
    }
}

/// out = h Σ a_j k_j.
fn combine_alone(out: &mut [f64], h: f64, row: Row, rates: &[f64]) {
    let width = out.len();
    out.fill(0.0);
    for &(stage, coefficient) in row {
        let weight = h * coefficient;
        for (value, rate) in out.iter_mut().zip(&rates[stage * width..(stage + 1) * width]) {
            *value += weight * rate;
        }
    }
}
