//! The stage equations of Radau IIA and Newton's method for them.
//!
//!   z_i = h Σ_j a_ij f(t₀ + c_j h, y₀ + z_j)
//!
//! With the exact Jacobian J in the middle of the step, as extrapolated, or at its start, and W = (T⁻¹ ⊗ I) z, the
//! three stages separate into a real and a complex linear system,
//!
//!   (γ/h I − J) ΔW₁ = r₁,   ((α + iβ)/h I − J)(ΔW₂ + iΔW₃) = r₂ + i r₃,   r = (T⁻¹ ⊗ I) F(z) − (Λ ⊗ I) W/h.
//!
//! The speed of convergence θ is measured; an iteration that would not arrive in time is broken off. Vectors of three
//! stages lie one stage after the other. Source: Hairer, Wanner II, §IV.8.

use crate::context::{Context, Point};
use crate::extended::{Extended, add};
use crate::layout::SystemLayout;
use crate::linear_system::LinearSystem;
use crate::radau::{COMPLEX, INVERSE, NODES, REAL, TRANSFORM, basis};
use crate::report::Cause;
use crate::system::System;

/// Newton iterations after which a shorter step is cheaper. Source: radau5.f.
pub(crate) const MAX_ITERATIONS: u32 = 7;
/// Longest step, in steps before, for which the collocation polynomial is worth extrapolating.
const EXTRAPOLATION_REACH: f64 = 4.0;
/// The stage nearest to the middle of a step.
const MIDDLE: usize = 1;
/// The least error that one iteration is supposed to leave, as a part of its correction, before a second confirms it.
const LEAST_CONTRACTION: f64 = 1e-2;
/// Corrections of so many roundings of the state, no longer contracting, are noise.
const NOISE: f64 = 1e3 * f64::EPSILON;

/// What an implicit attempt is given besides its two points.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NewtonPlan {
    pub h: f64,
    /// The time of the last node, t₀ + h as it is represented.
    pub end: f64,
    /// The size of the step that left the collocation polynomial; 0 if there is none.
    pub collocation_step: f64,
    /// θ/(1 − θ) of the last Newton iteration of the step before.
    pub contraction: f64,
    /// Whether the error estimate deserves its second, filtered variant: the first step, or one after a rejection.
    pub filtered: bool,
}

/// A step to be attempted, and the one before that tells where it will lead.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ahead {
    pub h: f64,
    /// The size of the step that left the collocation polynomial; 0 if there is none.
    pub collocation_step: f64,
}

/// How Newton's method has fared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Convergence {
    pub iterations: u32,
    /// θ/(1 − θ): the error left, as a part of the last correction.
    pub contraction: f64,
}

/// The unknowns of the three stages and the factors of their equations.
#[derive(Debug, Clone, Default)]
pub(crate) struct NewtonStages {
    /// z₁, z₂, z₃ of u = (y, w); Newton's method is for y, the rest is filled in by the quadratures.
    pub increments: Vec<f64>,
    /// The rates at the three stages.
    pub rates: Vec<f64>,
    /// z₁, z₂, z₃ of the last accepted step.
    pub collocation: Vec<f64>,
    /// W, of y alone.
    transformed: Vec<f64>,
    /// ΔW, then Δz.
    correction: Vec<f64>,
    stage: Vec<f64>,
    /// What the stage lacks.
    low: Vec<f64>,
    pub linear: LinearSystem,
}

impl NewtonStages {
    /// Holds the polynomial of a step before, and no scratch yet.
    pub fn holding(collocation: Vec<f64>) -> Self {
        Self { collocation, ..Self::default() }
    }

    /// Sizes the scratch for a layout; the polynomial stays.
    pub fn resize(&mut self, layout: &SystemLayout) {
        let (n, width) = (layout.dimension, layout.width);
        for triple in [&mut self.increments, &mut self.rates, &mut self.collocation] {
            triple.resize(3 * width, 0.0);
        }
        for triple in [&mut self.transformed, &mut self.correction] {
            triple.resize(3 * n, 0.0);
        }
        self.stage.resize(width, 0.0);
        self.low.resize(width, 0.0);
    }

    /// Evaluates the Jacobian for a step from this point: at its middle stage, where the polynomial of the step before
    /// can tell it, else at its start.
    ///
    /// While a body settles its gap changes by a good part of itself within a step, and the stiffness by several times
    /// that: a Jacobian from the middle lets Newton's method converge in two or three iterations instead of six.
    ///
    /// # Errors
    /// `Cause::Inadmissible` from the system.
    pub fn linearize<S: System>(
        &mut self,
        context: &mut Context<'_, S>,
        from: &Point,
        ahead: Option<Ahead>,
    ) -> Result<(), Cause<S::Inadmissible>> {
        if let Some(Ahead { h, collocation_step }) = ahead
            && self.predict(context.layout, h / collocation_step)
        {
            self.set_stage(from, MIDDLE);
            if self.evaluate_jacobian(context, from.t + NODES[MIDDLE] * h).is_ok() {
                return Ok(());
            }
        }
        self.stage.copy_from_slice(&from.u);
        self.low.copy_from_slice(&from.low);
        self.evaluate_jacobian(context, from.t).map_err(Cause::Inadmissible)
    }

    /// The Jacobian at the state of `stage`.
    fn evaluate_jacobian<S: System>(&mut self, context: &mut Context<'_, S>, time: f64) -> Result<(), S::Inadmissible> {
        context.statistics.jacobians += 1;
        let jacobian = self.linear.cleared(context.layout);
        let n = context.layout.dimension;
        context.system.extended_jacobian(time, Extended { high: &self.stage[..n], low: &self.low[..n] }, jacobian)
    }

    /// Sets `stage` to the state of stage i.
    fn set_stage(&mut self, from: &Point, i: usize) {
        let width = self.stage.len();
        let increments = &self.increments[i * width..(i + 1) * width];
        let stage = self.stage.iter_mut().zip(&mut self.low);
        for ((stage, start), z) in stage.zip(from.u.iter().zip(&from.low)).zip(increments) {
            (*stage.0, *stage.1) = add(*start.0, *start.1, *z);
        }
    }

    /// The spectral radius of the Jacobian of this step; spends the scratch of the corrections.
    pub fn spectral_radius(&mut self, layout: &SystemLayout, scale: &[f64]) -> f64 {
        self.linear.spectral_radius(layout, scale, &mut self.correction)
    }

    /// Factorizes the matrices of a step of size h.
    ///
    /// # Errors
    /// `Cause::Newton` if one of them is singular or not finite.
    pub fn factorize<S: System>(&mut self, context: &mut Context<'_, S>, h: f64) -> Result<(), Cause<S::Inadmissible>> {
        context.statistics.factorizations += 1;
        self.linear.factorize(h).map_err(|_| Cause::Newton)
    }

    /// Solves for the increments of y.
    ///
    /// # Errors
    /// `Cause::Newton` if it does not converge or not in time, or what stopped an evaluation.
    pub fn solve<S: System>(
        &mut self,
        context: &mut Context<'_, S>,
        from: &Point,
        plan: &NewtonPlan,
    ) -> Result<Convergence, Cause<S::Inadmissible>> {
        let layout = context.layout;
        let (tolerance, noise) = tolerance(layout, from);
        let mut contraction = plan.contraction;
        let mut left = libm::pow(contraction.max(f64::EPSILON), 0.8).max(LEAST_CONTRACTION);
        let mut previous = f64::INFINITY;
        self.predict_and_evaluate(context, from, plan)?;
        for iterations in 1..=MAX_ITERATIONS {
            if iterations > 1 {
                self.evaluate(context, from, plan)?;
            }
            let size = self.correct(layout, plan.h, &from.scale);
            if iterations > 1 {
                let theta = size / previous;
                if theta >= 0.5 && size <= noise {
                    return Ok(Convergence { iterations, contraction });
                }
                contraction = theta / (1.0 - theta);
                left = contraction;
                // What the iterations still allowed would leave.
                let predicted = left * size * theta.powi((MAX_ITERATIONS - iterations) as i32);
                if !(theta < 0.99 && predicted <= tolerance) {
                    return Err(Cause::Newton);
                }
            }
            if left * size <= tolerance {
                return Ok(Convergence { iterations, contraction });
            }
            previous = size;
        }
        Err(Cause::Newton)
    }

    /// Starts from the extrapolated polynomial of the step before or, where that leaves the domain, from z = 0.
    fn predict_and_evaluate<S: System>(
        &mut self,
        context: &mut Context<'_, S>,
        from: &Point,
        plan: &NewtonPlan,
    ) -> Result<(), Cause<S::Inadmissible>> {
        if self.predict(context.layout, plan.h / plan.collocation_step) && self.evaluate(context, from, plan).is_ok() {
            return Ok(());
        }
        self.increments.fill(0.0);
        self.transformed.fill(0.0);
        self.evaluate(context, from, plan)
    }

    /// z_i = q(1 + c_i h/h_old) − q(1), with q the polynomial of the step before; false where that is too far off.
    fn predict(&mut self, layout: &SystemLayout, ratio: f64) -> bool {
        // Without such a step the ratio is infinite.
        if ratio > EXTRAPOLATION_REACH {
            return false;
        }
        let (n, width) = (layout.dimension, layout.width);
        let weights = NODES.map(|node| {
            let [a, b, c] = basis(1.0 + node * ratio);
            [a, b, c - 1.0]
        });
        for j in 0..n {
            let z = multiply(&weights, triple(&self.collocation, width, j));
            set_triple(&mut self.increments, width, j, z);
            set_triple(&mut self.transformed, n, j, multiply(&INVERSE, z));
        }
        true
    }

    fn evaluate<S: System>(
        &mut self,
        context: &mut Context<'_, S>,
        from: &Point,
        plan: &NewtonPlan,
    ) -> Result<(), Cause<S::Inadmissible>> {
        (0..3).try_for_each(|i| self.evaluate_stage(context, from, plan, i))
    }

    /// The rates at a stage, from its increments.
    ///
    /// # Errors
    /// As an evaluation.
    pub fn evaluate_stage<S: System>(
        &mut self,
        context: &mut Context<'_, S>,
        from: &Point,
        plan: &NewtonPlan,
        i: usize,
    ) -> Result<(), Cause<S::Inadmissible>> {
        let width = self.stage.len();
        let time = if i == 2 { plan.end } else { from.t + NODES[i] * plan.h };
        self.set_stage(from, i);
        let stage = Extended { high: &self.stage, low: &self.low };
        context.evaluate(time, stage, &mut self.rates[i * width..(i + 1) * width])
    }

    /// One correction of z and W; returns the size of Δz relative to the scales.
    fn correct(&mut self, layout: &SystemLayout, h: f64, scale: &[f64]) -> f64 {
        let (n, width) = (layout.dimension, layout.width);
        let (gamma, alpha, beta) = (REAL / h, COMPLEX.0 / h, COMPLEX.1 / h);
        for j in 0..n {
            let [f1, f2, f3] = multiply(&INVERSE, triple(&self.rates, width, j));
            let [w1, w2, w3] = triple(&self.transformed, n, j);
            let residual = [f1 - gamma * w1, f2 - (alpha * w2 - beta * w3), f3 - (beta * w2 + alpha * w3)];
            set_triple(&mut self.correction, n, j, residual);
        }
        let (first, others) = self.correction.split_at_mut(n);
        let (second, third) = others.split_at_mut(n);
        self.linear.solve_real(first);
        self.linear.solve_complex(second, third);
        for j in 0..n {
            let dw = triple(&self.correction, n, j);
            let dz = multiply(&TRANSFORM, dw);
            set_triple(&mut self.correction, n, j, dz);
            for i in 0..3 {
                self.transformed[i * n + j] += dw[i];
                self.increments[i * width + j] += dz[i];
            }
        }
        block_norm(layout, scale, |j| triple(&self.correction, n, j))
    }
}

/// How accurately to solve the stages, and the size of rounding noise, both relative to the error allowed.
///
/// κ = 10 ‖y/s‖^(−½) within 10⁻⁴…10⁻²: the error of the method is of order 6 where its estimate is of order 4, so that
/// its solution is better than asked by about the root of the relative tolerance, and so must be that of its equations.
/// Ten: the scales s are relative to gaps, which are a hundredth of what y measures. Never below ten roundings of the
/// state, which rates may see, and never above a tenth of what is allowed, however small that is beside the state.
/// Source: radau5.f, which knows the relative tolerance itself.
fn tolerance(layout: &SystemLayout, from: &Point) -> (f64, f64) {
    let size = block_norm(layout, &from.scale, |j| [from.u[j]; 3]);
    let wanted = (10.0 * libm::pow(size.max(1.0), -0.5)).clamp(1e-4, 1e-2);
    (wanted.max(10.0 * f64::EPSILON * size).min(0.1), (NOISE * size).min(1.0))
}

/// The largest root mean square over the blocks of y, of three vectors together; a NaN is the largest of all.
fn block_norm(layout: &SystemLayout, scale: &[f64], vectors: impl Fn(usize) -> [f64; 3]) -> f64 {
    let mut largest = 0.0;
    for block in layout.blocks().iter().filter(|block| !block.is_empty()) {
        let squares: f64 = block.clone().map(|j| vectors(j).map(|v| (v / scale[j]).powi(2)).iter().sum::<f64>()).sum();
        let size = (squares / (3 * block.len()) as f64).sqrt();
        if size.is_nan() {
            return size;
        }
        largest = size.max(largest);
    }
    largest
}

/// Component j of the three stages.
pub(crate) fn triple(stages: &[f64], stride: usize, j: usize) -> [f64; 3] {
    [stages[j], stages[stride + j], stages[2 * stride + j]]
}

/// Sets component j of the three stages.
pub(crate) fn set_triple(stages: &mut [f64], stride: usize, j: usize, values: [f64; 3]) {
    (stages[j], stages[stride + j], stages[2 * stride + j]) = values.into();
}

/// Matrix times vector.
pub(crate) fn multiply(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}
