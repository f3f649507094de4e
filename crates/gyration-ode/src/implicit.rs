//! The implicit stepper: Radau IIA with s stages, for stiff stretches.
//!
//!   y₁ = y₀ + z_s,   w₁ = w₀ + h Σ_j a_sj g(t₀ + c_j h, y₀ + z_j),   z from `newton`
//!
//! L-stable: a transient of any rate is gone after a step. Error of the state:
//!
//!   e = (γ/h I − J)⁻¹ (f(y₀) + Σ e_i z_i/h),
//!
//! bounded however stiff the problem; where it rejects a first step, or one after a rejection, f(y₀ + e) takes the
//! place of f(y₀). Quadratures, which feed nothing back, have the same formula without J. J is evaluated anew in every
//! step: it is cheap here and a restart stays exact. Source: Hairer, Wanner II, §IV.8.

use crate::context::{Context, Point};
use crate::explicit::Trial;
use crate::extended::{Extended, add};
use crate::layout::SystemLayout;
use crate::newton::{NewtonPlan, NewtonStages};
use crate::norm::norm;
use crate::radau::Radau;
use crate::report::Cause;
use crate::stages::combine;
use crate::system::System;

/// Scratch of the implicit stepper and the polynomial of its last step.
#[derive(Debug, Clone)]
pub(crate) struct Implicit {
    pub stages: NewtonStages,
    error: Vec<f64>,
    /// A state beside the start of the step, and its rate.
    beside: Vec<f64>,
    beside_rate: Vec<f64>,
    /// What it is sized for.
    layout: SystemLayout,
}

impl Implicit {
    /// Holds the polynomial of a step before, and no scratch yet.
    pub fn holding(method: &'static Radau, collocation: Vec<f64>) -> Self {
        Self {
            stages: NewtonStages::holding(method, collocation),
            error: Vec::new(),
            beside: Vec::new(),
            beside_rate: Vec::new(),
            layout: SystemLayout::default(),
        }
    }

    /// Sizes the scratch for a layout, unless it has that size; the polynomial stays.
    pub fn fit(&mut self, layout: &SystemLayout) {
        if self.layout == *layout {
            return;
        }
        self.stages.resize(layout);
        self.stages.linear.set_layout(layout);
        for vector in [&mut self.error, &mut self.beside, &mut self.beside_rate] {
            vector.resize(layout.width, 0.0);
        }
        self.layout.clone_from(layout);
    }

    /// The same method, and no scratch.
    pub fn without_room(&self) -> Self {
        Self::holding(self.stages.method, Vec::new())
    }

    /// Whether it has the room that another needs for so many numbers of state and quadratures.
    pub fn has_the_size_of(&self, other: &Self, layout: &SystemLayout) -> bool {
        let stages = |implicit: &Self| implicit.stages.method.stages();
        let sizes = (self.layout.dimension, self.layout.width);
        stages(self) == stages(other) && sizes == (layout.dimension, layout.width)
    }

    /// Attempts a step from one point, where the stages were linearized, to `to`, whose time is set.
    ///
    /// # Errors
    /// `Cause::Newton`, `Cause::Error` if the error exceeds what is allowed at either end, or what stopped an
    /// evaluation.
    pub fn attempt<S: System>(
        &mut self,
        context: &mut Context<'_, S>,
        from: &Point,
        plan: &NewtonPlan,
        to: &mut Point,
    ) -> Result<Trial, Cause<S::Inadmissible>> {
        let layout = context.layout;
        self.stages.factorize(context, plan.h)?;
        let convergence = self.stages.solve(context, from, plan)?;
        self.estimate_state_error(context, from, plan);
        norm(layout, &self.error, &from.scale, &from.scale).allow()?;
        self.arrive(layout, from, to);
        if layout.width > layout.dimension {
            // Afresh, where Newton's method left the stages; the rate at the last is that at the new state.
            (0..self.last_stage()).try_for_each(|i| self.stages.evaluate_stage(context, from, plan, i))?;
        }
        let projection = context.land(to)?;
        self.integrate_quadratures(layout, from, plan.h, to);
        self.estimate_quadrature_error(context, from, plan);
        context.scales(to);
        let error = norm(layout, &self.error, &from.scale, &to.scale).allow()?;
        Ok(Trial { error, projection, stiffness: 0.0, convergence: Some(convergence) })
    }

    /// Keeps the collocation polynomial of an accepted step, so corrected that it ends in the projected state.
    pub fn accept(&mut self, from: &Point, to: &Point) {
        let (last_stage, stages) = (self.last_stage(), &mut self.stages);
        std::mem::swap(&mut stages.increments, &mut stages.collocation);
        let last = stages.collocation.stage_mut(last_stage);
        let ends = to.u.iter().zip(&to.low).zip(from.u.iter().zip(&from.low));
        for (z, (end, start)) in last.iter_mut().zip(ends) {
            *z = (end.0 - start.0) + (end.1 - start.1);
        }
    }

    /// The evaluations of a step that are made for quadratures alone which have no part in its error.
    pub fn free_evaluations(&self, layout: &SystemLayout) -> u64 {
        if layout.has_only_free_quadratures() { self.last_stage() as u64 } else { 0 }
    }

    /// The stage at the end of the step.
    fn last_stage(&self) -> usize {
        self.stages.method.stages() - 1
    }

    /// y₁ = y₀ + z_s; w is left for later.
    fn arrive(&self, layout: &SystemLayout, from: &Point, to: &mut Point) {
        to.u.copy_from_slice(&from.u);
        to.low.copy_from_slice(&from.low);
        let last = self.stages.increments.stage(self.last_stage());
        for ((high, low), z) in to.u.iter_mut().zip(&mut to.low).zip(last).take(layout.dimension) {
            (*high, *low) = add(*high, *low, *z);
        }
    }

    /// The error of y into `error`, that of w left at 0.
    fn estimate_state_error<S: System>(&mut self, context: &mut Context<'_, S>, from: &Point, plan: &NewtonPlan) {
        let layout = context.layout;
        let Self { stages, error, .. } = self;
        error.fill(0.0);
        state_error(layout, stages, &from.rate, plan.h, error);
        let size = norm(layout, error, &from.scale, &from.scale).value;
        if plan.filtered && size > 1.0 && self.evaluate_beside(context, from) {
            state_error(layout, &mut self.stages, &self.beside_rate, plan.h, &mut self.error);
        }
    }

    /// Increments and new values of the quadratures.
    fn integrate_quadratures(&mut self, layout: &SystemLayout, from: &Point, h: f64, to: &mut Point) {
        let (last, quadratures) = (self.last_stage(), layout.dimension..layout.width);
        let NewtonStages { method, increments, rates, .. } = &mut self.stages;
        rates.stage_mut(last)[quadratures.clone()].copy_from_slice(&to.rate[quadratures.clone()]);
        increments.set_product(method.matrix, rates, quadratures.clone());
        for i in 0..=last {
            increments.stage_mut(i)[quadratures.clone()].iter_mut().for_each(|z| *z *= h);
        }
        for j in quadratures {
            (to.u[j], to.low[j]) = add(from.u[j], from.low[j], increments.stage(last)[j]);
        }
    }

    /// The error of w into `error`, that of y being there.
    fn estimate_quadrature_error<S: System>(&mut self, context: &mut Context<'_, S>, from: &Point, plan: &NewtonPlan) {
        let layout = context.layout;
        quadrature_error(layout, &self.stages, &from.rate, plan.h, &mut self.error);
        let size = norm(layout, &self.error, &from.scale, &from.scale).value;
        if plan.filtered && size > 1.0 && self.evaluate_beside(context, from) {
            quadrature_error(layout, &self.stages, &self.beside_rate, plan.h, &mut self.error);
        }
    }

    /// The rate at the start displaced by the error of y; false if there is none.
    fn evaluate_beside<S: System>(&mut self, context: &mut Context<'_, S>, from: &Point) -> bool {
        for ((value, start), error) in self.beside.iter_mut().zip(&from.u).zip(&self.error) {
            *value = start + error;
        }
        let state = Extended { high: &self.beside, low: &from.low };
        context.evaluate(from.t, state, &mut self.beside_rate).is_ok()
    }
}

/// e = (γ/h I − J)⁻¹ (f + Σ e_i z_i/h) of y.
fn state_error(layout: &SystemLayout, stages: &mut NewtonStages, rate: &[f64], h: f64, error: &mut [f64]) {
    let error = &mut error[..layout.dimension];
    combine(stages.method.error, &stages.increments, 0..layout.dimension, error);
    for (value, f) in error.iter_mut().zip(rate) {
        *value = f + *value / h;
    }
    stages.linear.solve_real(error);
}

/// e = (h/γ) (g + Σ e_i z_i/h) of w.
fn quadrature_error(layout: &SystemLayout, stages: &NewtonStages, rate: &[f64], h: f64, error: &mut [f64]) {
    let quadratures = layout.dimension..layout.width;
    let error = &mut error[quadratures.clone()];
    combine(stages.method.error, &stages.increments, quadratures.clone(), error);
    for (value, g) in error.iter_mut().zip(&rate[quadratures]) {
        *value = (h * g + *value) / stages.method.real;
    }
}
