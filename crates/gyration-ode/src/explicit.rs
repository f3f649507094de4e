//! The explicit stepper: Prince's pair 9(7), for accuracy where the problem is not stiff.
//!
//!   Y_s = u₀ + h Σ a_sj k_j,   k_s = f(t₀ + c_s h, Y_s),   u₁ = u₀ + h Σ b_j k_j,   u = (y, w)
//!
//! The rate at the start is that at the end of the step before, taken after the projection, so that an accepted step
//! costs seventeen evaluations; its interpolant of order 8 costs none. Error: h Σ (b̂_j − b_j) k_j, which behaves like
//! h⁸. Stiffness: λ is seen at no cost from f(u₁) − f(Y₁₇) against u₁ − Y₁₇, both being approximations at t₁.
//! Source: as of `prince`; Hairer, Wanner II, §IV.2 (stiffness).

use crate::newton::Convergence;
use crate::norm::{Norm, norm};
use crate::prince::{ERROR, NODES, ROWS, Row, STAGES, WEIGHTS, interpolation_weights};
use crate::report::Cause;
use crate::system::{Context, Layout, Point, System};

/// The stability region is a disk of radius 4.6 over most of the left half-plane: h|λ| from which on a step counts as
/// limited by it.
const STABLE_MODULUS: f64 = 3.7;
/// −h Re λ from which on it does so where the direction decays: the error estimate of a solution that only follows its
/// forcing grows well before the boundary, and an oscillation resolved for accuracy has no decay to show.
const STABLE_DECAY: f64 = 1.5;
/// So many components are summed side by side; rows of rates are padded with zeros to whole groups of them.
const LANES: usize = 4;
type Group = [f64; LANES];

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
    rates: Vec<Group>,
    /// The groups of one of them.
    groups: usize,
    stage: Vec<f64>,
    error: Vec<f64>,
}

impl Explicit {
    /// Scratch for vectors of the given width.
    pub fn new(width: usize) -> Self {
        let groups = width.div_ceil(LANES);
        let vector = vec![0.0; width];
        Self { rates: vec![[0.0; LANES]; (STAGES + 1) * groups], groups, stage: vector.clone(), error: vector }
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
        self.rate_mut(0).copy_from_slice(&from.rate);
        for (index, row) in ROWS.iter().enumerate() {
            let s = index + 1;
            combine(&mut self.stage, &from.u, h, row, &self.rates);
            let time = if s + 1 == STAGES { to.t } else { from.t + NODES[s] * h };
            let rate = &mut self.rates[s * self.groups..].as_flattened_mut()[..self.stage.len()];
            context.evaluate(time, &self.stage, rate)?;
        }
        combine(&mut to.u, &from.u, h, WEIGHTS, &self.rates);
        self.error.fill(0.0);
        accumulate(&mut self.error, h, ERROR, &self.rates);

        // Judged first by the scales of the start: a step far too long need not even be evaluated at its end.
        let layout = context.layout;
        norm(layout, &self.error, &from.scale, &from.scale).allow()?;
        let projection = context.land(to)?;
        context.scales(to);
        let error = norm(layout, &self.error, &from.scale, &to.scale).allow()?;
        let stiffness = self.stability_used(layout, from, to, h);
        Ok(Trial { error, projection, stiffness, convergence: None })
    }

    /// The part of the stability used: λ of the direction in which the last stage and the new state, both at t₁, differ.
    ///
    ///   |λ| ≈ ‖Δf‖/‖Δu‖,   Re λ ≈ Δf·Δu/‖Δu‖²,   the largest over the blocks
    ///
    /// Differences at the level of rounding say nothing and give 0.
    fn stability_used(&self, layout: &Layout, from: &Point, to: &Point, h: f64) -> f64 {
        let last = self.rates[(STAGES - 1) * self.groups..].as_flattened();
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

    /// Completes the rates of an accepted step by the one at its end, for the interpolant.
    pub fn accept(&mut self, to: &Point) {
        self.rate_mut(STAGES).copy_from_slice(&to.rate);
    }

    /// One row of rates.
    fn rate_mut(&mut self, stage: usize) -> &mut [f64] {
        &mut self.rates[stage * self.groups..].as_flattened_mut()[..self.stage.len()]
    }

    /// Hands u(θ) of the last step to `put`, component by component.
    pub fn interpolate(&self, from: &Point, to: &Point, h: f64, theta: f64, mut put: impl FnMut(usize, f64)) {
        let weights = interpolation_weights(theta);
        let rates = self.rates.as_flattened();
        for (i, (start, end)) in from.u.iter().zip(&to.u).enumerate() {
            let sum: f64 = weights.iter().map(|(stage, weight)| weight * rates[stage * self.groups * LANES + i]).sum();
            put(i, start + theta * (end - start) + h * sum);
        }
    }
}

/// out = base + h Σ a_j k_j.
fn combine(out: &mut [f64], base: &[f64], h: f64, row: Row, rates: &[Group]) {
    out.copy_from_slice(base);
    accumulate(out, h, row, rates);
}

/// out += h Σ a_j k_j, a group at a time, whose sums stay in registers.
fn accumulate(out: &mut [f64], h: f64, row: Row, rates: &[Group]) {
    let groups = out.len().div_ceil(LANES);
    for (group, out) in out.chunks_mut(LANES).enumerate() {
        let mut sums = [0.0; LANES];
        for &(stage, coefficient) in row {
            for (sum, rate) in sums.iter_mut().zip(&rates[stage * groups + group]) {
                *sum += coefficient * rate;
            }
        }
        for (value, sum) in out.iter_mut().zip(sums) {
            *value += h * sum;
        }
    }
}
