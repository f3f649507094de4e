//! The solution between the ends of the last step.
//!
//!   explicit:  u(θ) = u₀ + θ(Δ + θ̄(B + θ(C + θ̄(D₄ + θ(D₅ + θ̄(D₆ + θ D₇)))))),   θ̄ = 1 − θ, order 7
//!              Δ = u₁ − u₀,  B = h f₀ − Δ,  C = Δ − h f₁ − B
//!   implicit:  u(θ) = u₀ + Σ ℓ_i(θ) z_i, the collocation polynomial, order 3
//!
//! The explicit form is Hermite's cubic for D = 0: what is had without more evaluations, of order 3. Both take the
//! exact values at the ends, the projected state at θ = 1. In between they do not lie on the manifold; project if it
//! matters. Source: Hairer, Nørsett, Wanner I, §II.6; Hairer, Wanner II, §IV.8.

use crate::integrator::Integrator;
use crate::radau::basis;
use crate::report::Statistics;
use crate::system::{Context, System};

/// What the last accepted step has left to interpolate with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum LastStep {
    /// No step yet, or none since a checkpoint or an attempt that failed.
    #[default]
    None,
    /// Explicit, ends only: Hermite's cubic.
    Hermite,
    /// Explicit, with the coefficients of order 7.
    Extended,
    /// Implicit.
    Collocation,
}

impl Integrator {
    /// Readies `interpolate` for its full accuracy; returns the order of the interpolant.
    ///
    /// An explicit step needs three more evaluations for order 7; without them, or where one leaves the domain, the
    /// order is 3. Neither later steps nor the checkpoint nor `statistics` depend on whether this was called.
    pub fn prepare_dense<S: System>(&mut self, system: &mut S) -> u32 {
        if self.last == LastStep::Hermite {
            let mut uncounted = Statistics::default();
            let mut context = Context { system, layout: &self.layout, statistics: &mut uncounted };
            let h = self.last_size;
            if self.explicit.extend(&mut context, &self.other, h, &self.current).is_ok() {
                self.last = LastStep::Extended;
            }
        }
        if self.last == LastStep::Extended { 7 } else { 3 }
    }

    /// The solution at a time of the last step, y and w; outside of it, or without one, the nearest end.
    ///
    /// # Panics
    /// If `y` or `w` has not the size of the state.
    pub fn interpolate(&self, t: f64, y: &mut [f64], w: &mut [f64]) {
        let (start, end) = (&self.other, &self.current);
        let n = self.layout.dimension;
        assert!(y.len() == n && w.len() == end.u.len() - n, "interpolate needs room for y and for w");
        // At the ends the values are copied, not computed: they are exact.
        let exact = if self.last == LastStep::None || t >= end.t {
            Some(&end.u)
        } else if t <= start.t {
            Some(&start.u)
        } else {
            None
        };
        if let Some(u) = exact {
            y.copy_from_slice(&u[..n]);
            w.copy_from_slice(&u[n..]);
            return;
        }
        let theta = (t - start.t) / self.last_size;
        let outputs = y.iter_mut().chain(w.iter_mut()).enumerate();
        if self.last == LastStep::Collocation {
            let width = start.u.len();
            let (weights, z) = (basis(theta), &self.implicit.stages.collocation);
            for (i, value) in outputs {
                *value = start.u[i] + weights[0] * z[i] + weights[1] * z[width + i] + weights[2] * z[2 * width + i];
            }
        } else {
            for (i, value) in outputs {
                *value = self.explicit_value(i, theta);
            }
        }
    }

    fn explicit_value(&self, i: usize, theta: f64) -> f64 {
        let (rest, width, h) = (1.0 - theta, self.other.u.len(), self.last_size);
        let change = self.current.u[i] - self.other.u[i];
        let bend = h * self.explicit.first_rate()[i] - change;
        let twist = change - h * self.current.rate[i] - bend;
        let d = &self.explicit.dense;
        let high = if self.last == LastStep::Extended {
            d[i] + theta * (d[width + i] + rest * (d[2 * width + i] + theta * d[3 * width + i]))
        } else {
            0.0
        };
        self.other.u[i] + theta * (change + rest * (bend + theta * (twist + rest * high)))
    }
}
