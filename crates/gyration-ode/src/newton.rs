//! The stage equations of Radau IIA and Newton's method for them.
//!
//!   z_i = h Σ_j a_ij f(t₀ + c_j h, y₀ + z_j)
//!
//! With the exact Jacobian J in the middle of the step, as extrapolated, or at its start, and W = (T⁻¹ ⊗ I) z, the
//! stages separate into a real and one or more complex linear systems,
//!
//!   (γ/h I − J) ΔW₁ = r₁,   ((α + iβ)/h I − J)(ΔW₂ + iΔW₃) = r₂ + i r₃, …   r = (T⁻¹ ⊗ I) F(z) − (Λ ⊗ I) W/h.
//!
//! The speed of convergence θ is measured; an iteration that would not arrive in time is broken off. Source: Hairer,
//! Wanner II, §IV.8.

use crate::context::{Context, Point};
use crate::extended::{Extended, add};
use crate::layout::SystemLayout;
use crate::linear_system::LinearSystem;
use crate::radau::{MOST_STAGES, Radau};
use crate::report::Cause;
use crate::stages::StageVectors;
use crate::system::System;

/// Longest step, in steps before, for which the collocation polynomial is worth extrapolating.
const EXTRAPOLATION_REACH: f64 = 4.0;
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

/// The unknowns of the stages and the factors of their equations.
#[derive(Debug, Clone)]
pub(crate) struct NewtonStages {
    pub method: &'static Radau,
    /// z_i of u = (y, w); Newton's method is for y, the rest is filled in by the quadratures.
    pub increments: StageVectors,
    /// The rates at the stages.
    pub rates: StageVectors,
    /// z_i of the last accepted step.
    pub collocation: StageVectors,
    /// W, of y alone.
    transformed: StageVectors,
    /// ΔW.
    correction: StageVectors,
    /// Δz.
    change: StageVectors,
    stage: Vec<f64>,
    /// What the stage lacks.
    low: Vec<f64>,
    pub linear: LinearSystem,
}

impl NewtonStages {
    /// Holds the polynomial of a step before, and no scratch yet.
    pub fn holding(method: &'static Radau, collocation: Vec<f64>) -> Self {
        let none = StageVectors::default;
        Self {
            method,
            increments: none(),
            rates: none(),
            collocation: StageVectors::of(collocation, method.stages()),
            transformed: none(),
            correction: none(),
            change: none(),
            stage: Vec::new(),
            low: Vec::new(),
            linear: LinearSystem::of(method),
        }
    }

    /// Sizes the scratch for a layout; the polynomial stays.
    pub fn resize(&mut self, layout: &SystemLayout) {
        let (n, width, stages) = (layout.dimension, layout.width, self.method.stages());
        for vectors in [&mut self.increments, &mut self.rates, &mut self.collocation] {
            vectors.resize(stages, width);
        }
        for vectors in [&mut self.transformed, &mut self.correction, &mut self.change] {
            vectors.resize(stages, n);
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
            let middle = self.method.stages() / 2;
            self.set_stage(from, middle);
            if self.evaluate_jacobian(context, from.t + self.method.nodes[middle] * h).is_ok() {
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
        let increments = self.increments.stage(i);
        let stage = self.stage.iter_mut().zip(&mut self.low);
        for ((stage, start), z) in stage.zip(from.u.iter().zip(&from.low)).zip(increments) {
            (*stage.0, *stage.1) = add(*start.0, *start.1, *z);
        }
    }

    /// The spectral radius of the Jacobian of this step; spends the scratch of the corrections.
    pub fn spectral_radius(&mut self, layout: &SystemLayout, scale: &[f64]) -> f64 {
        self.linear.spectral_radius(layout, scale, self.correction.numbers_mut())
    }

    /// Factorizes the matrices of a step of size h.
    ///
    /// # Errors
    /// `Cause::Newton` if one of them is singular or not finite.
    pub fn factorize<S: System>(&mut self, context: &mut Context<'_, S>, h: f64) -> Result<(), Cause<S::Inadmissible>> {
        context.statistics.factorizations += 1;
        self.linear.factorize(context.layout, h).map_err(|_| Cause::Newton)
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
        let most = self.method.most_iterations();
        let mut contraction = plan.contraction;
        let mut left = libm::pow(contraction.max(f64::EPSILON), 0.8).max(LEAST_CONTRACTION);
        let mut previous = f64::INFINITY;
        self.predict_and_evaluate(context, from, plan)?;
        for iterations in 1..=most {
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
                let predicted = left * size * theta.powi((most - iterations) as i32);
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
        self.increments.numbers_mut().fill(0.0);
        self.transformed.numbers_mut().fill(0.0);
        self.evaluate(context, from, plan)
    }

    /// z_i = q(1 + c_i h/h_old) − q(1), with q the polynomial of the step before; false where that is too far off.
    fn predict(&mut self, layout: &SystemLayout, ratio: f64) -> bool {
        // Without such a step the ratio is infinite.
        if ratio > EXTRAPOLATION_REACH {
            return false;
        }
        let (n, stages) = (layout.dimension, self.method.stages());
        let mut weights = [0.0; MOST_STAGES * MOST_STAGES];
        for (row, node) in weights.chunks_exact_mut(stages).zip(self.method.nodes) {
            row.copy_from_slice(&self.method.basis(1.0 + node * ratio)[..stages]);
            row[stages - 1] -= 1.0;
        }
        self.increments.set_product(&weights[..stages * stages], &self.collocation, 0..n);
        self.transformed.set_product(self.method.inverse, &self.increments, 0..n);
        true
    }

    fn evaluate<S: System>(
        &mut self,
        context: &mut Context<'_, S>,
        from: &Point,
        plan: &NewtonPlan,
    ) -> Result<(), Cause<S::Inadmissible>> {
        (0..self.method.stages()).try_for_each(|i| self.evaluate_stage(context, from, plan, i))
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
        let nodes = self.method.nodes;
        let time = if i + 1 == nodes.len() { plan.end } else { from.t + nodes[i] * plan.h };
        self.set_stage(from, i);
        let stage = Extended { high: &self.stage, low: &self.low };
        context.evaluate(time, stage, self.rates.stage_mut(i))
    }

    /// One correction of z and W; returns the size of Δz relative to the scales.
    fn correct(&mut self, layout: &SystemLayout, h: f64, scale: &[f64]) -> f64 {
        let Self { method, increments, rates, transformed, correction, change, linear, .. } = self;
        let all = 0..layout.dimension;
        correction.set_product(method.inverse, rates, all.clone());
        let gamma = method.real / h;
        for (residual, w) in correction.stage_mut(0).iter_mut().zip(transformed.stage(0)) {
            *residual -= gamma * w;
        }
        linear.solve_real(correction.stage_mut(0));
        for (pair, (alpha, beta)) in method.complex.iter().enumerate() {
            let (first, alpha, beta) = (1 + 2 * pair, alpha / h, beta / h);
            let (real, imaginary) = correction.pair_mut(first);
            let unknowns = transformed.stage(first).iter().zip(transformed.stage(first + 1));
            for ((re, im), (w, v)) in real.iter_mut().zip(imaginary.iter_mut()).zip(unknowns) {
                *re -= alpha * w - beta * v;
                *im -= beta * w + alpha * v;
            }
            linear.solve_complex(pair, real, imaginary);
        }
        change.set_product(method.transform, correction, all.clone());
        transformed.add(correction, all.clone());
        increments.add(change, all);
        block_norm(layout, scale, method.stages(), |i| change.stage(i))
    }
}

/// How accurately to solve the stages, and the size of rounding noise, both relative to the error allowed.
///
/// κ = 10 ‖y/s‖^(−½) within 10⁻⁴…10⁻²: the error of a step is of order 2s where its estimate is of order s + 1, so that
/// the solution is better than asked by the root of the relative tolerance or more, and so must be that of the
/// equations. Other powers were tried for five and seven stages, without gain (`bench/2026-11-25-orders.md`). Ten: the
/// scales s are relative to gaps, which are a hundredth of what y measures. Never below ten roundings of the state,
/// which rates may see, and never above a tenth of what is allowed, however small that is beside the state. Source:
/// radau5.f, which knows the relative tolerance itself.
fn tolerance(layout: &SystemLayout, from: &Point) -> (f64, f64) {
    let size = block_norm(layout, &from.scale, 1, |_| &from.u);
    let wanted = (10.0 * libm::pow(size.max(1.0), -0.5)).clamp(1e-4, 1e-2);
    (wanted.max(10.0 * f64::EPSILON * size).min(0.1), (NOISE * size).min(1.0))
}

/// The largest root mean square over the blocks of y, of so many vectors together; a NaN is the largest of all.
fn block_norm<'a>(layout: &SystemLayout, scale: &[f64], stages: usize, vector: impl Fn(usize) -> &'a [f64]) -> f64 {
    let mut largest = 0.0;
    for block in layout.blocks().iter().filter(|block| !block.is_empty()) {
        let squares = |j: usize| (0..stages).map(|i| (vector(i)[j] / scale[j]).powi(2)).sum::<f64>();
        let size = (block.clone().map(squares).sum::<f64>() / (stages * block.len()) as f64).sqrt();
        if size.is_nan() {
            return size;
        }
        largest = size.max(largest);
    }
    largest
}
