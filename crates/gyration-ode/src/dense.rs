//! The solution between the ends of the last step.
//!
//!   explicit:  u(θ) = u₀ + θ(u₁ − u₀) + θ(1 − θ) h Σ r_j(θ) k_j, of order 8
//!   implicit:  u(θ) = u₀ + Σ ℓ_i(θ) z_i, the collocation polynomial, of order 3
//!
//! Neither needs an evaluation. Both take the exact values at the ends, the projected state at θ = 1. In between they
//! do not lie on the manifold; project if it matters. Source: as of `prince`; Hairer, Wanner II, §IV.8.

use crate::integrator::{Integrator, LastStep};
use crate::radau::basis;

impl Integrator {
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
        if self.last == LastStep::Collocation {
            let width = start.u.len();
            let (weights, z) = (basis(theta), &self.implicit.stages.collocation);
            for (i, value) in y.iter_mut().chain(w.iter_mut()).enumerate() {
                *value = start.u[i] + weights[0] * z[i] + weights[1] * z[width + i] + weights[2] * z[2 * width + i];
            }
        } else {
            self.explicit.interpolate(start, end, self.last_size, theta, |i, value| {
                if i < n { y[i] = value } else { w[i - n] = value }
            });
        }
    }
}
