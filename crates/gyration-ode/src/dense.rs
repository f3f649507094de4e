//! The solution between the ends of the last step.
//!
//!   explicit:  u(θ) = u₀ + θ(u₁ − u₀) + θ(1 − θ) h Σ r_j(θ) k_j, of order 8
//!   implicit:  u(θ) = u₀ + Σ ℓ_i(θ) z_i, the collocation polynomial, of the order of its stages
//!
//! Neither needs an evaluation. Both take the exact values at the ends, the projected state at θ = 1. In between they
//! do not lie on the manifold; project if it matters. Source: as of `prince`; Hairer, Wanner II, §IV.8.

use crate::context::Point;
use crate::extended::add;
use crate::integrator::{Integrator, LastStep};

impl Integrator {
    /// The solution at a time of the last step, y and w; outside of it, or without one, the nearest end.
    ///
    /// # Panics
    /// If `y` or `w` has not the size of the state.
    pub fn interpolate(&self, t: f64, y: &mut [f64], w: &mut [f64]) {
        self.interpolate_extended(t, y, w, None);
    }

    /// The same, with what y lacks of twice its digits, if that is wanted.
    ///
    /// # Panics
    /// As [`Integrator::interpolate`].
    pub fn interpolate_extended(&self, t: f64, y: &mut [f64], w: &mut [f64], lack: Option<&mut [f64]>) {
        let (start, end) = (self.other.t, self.current.t);
        let part = if t >= end { 1.0 } else { (t - start) / self.last_size };
        self.interpolate_part(part, y, w, lack);
    }

    /// The same at a part θ of the last step: a short step at a late time has points that no time tells apart.
    ///
    /// # Panics
    /// As [`Integrator::interpolate`].
    pub fn interpolate_part(&self, theta: f64, y: &mut [f64], w: &mut [f64], mut lack: Option<&mut [f64]>) {
        let (start, end) = (&self.other, &self.current);
        let n = self.layout.dimension;
        assert!(y.len() == n && w.len() == end.u.len() - n, "interpolate needs room for y and for w");
        // At the ends the values are copied, not computed: they are exact.
        let exact = if self.last == LastStep::None || theta >= 1.0 {
            Some(end)
        } else if theta <= 0.0 {
            Some(start)
        } else {
            None
        };
        if let Some(Point { u, low, .. }) = exact {
            y.copy_from_slice(&u[..n]);
            w.copy_from_slice(&u[n..]);
            if let Some(lack) = lack {
                lack.copy_from_slice(&low[..n]);
            }
            return;
        }
        let mut put = |i: usize, change: f64| {
            let (high, low) = add(start.u[i], start.low[i], change);
            match y.get_mut(i) {
                Some(value) => *value = high,
                None => w[i - n] = high,
            }
            if let Some(place) = lack.as_mut().and_then(|lack| lack.get_mut(i)) {
                *place = low;
            }
        };
        if self.last == LastStep::Collocation {
            let stages = &self.implicit.stages;
            let weights = stages.method.basis(theta);
            let z = |k: usize| stages.collocation.stage(k);
            for i in 0..start.u.len() {
                put(i, (0..stages.method.stages()).map(|k| weights[k] * z(k)[i]).sum());
            }
        } else {
            self.explicit.interpolate(start, end, self.last_size, theta, put);
        }
    }
}
