//! Damping that hardly pulls on what recedes.
//!
//!   s(w) = ½(w + w₀ − √(w² + w₀²)),   0 ≤ s w,   s → w + ½w₀ as w → −∞,   s → ½w₀ as w → ∞
//!
//! takes the place of the mean speed w with which a body recedes from a plane, weighed by β (d/d₀)^−ν. That is the
//! speed whose product with B = ∫β (d/d₀)^−ν dA is the force of damping: what tilts without receding is damped as ever,
//! on the side that rises as on the side that sinks. So all of damping is that of the motion with s − w added along n,
//! and minus the derivative of the convex R + B(∫s dw − ½w²), R the half of what two-sided damping takes: the power is
//! −(2R − B w² + B s w) ≤ 0. Between bodies n is the normal of their plane, w the speed of one that recedes from the
//! other, and B the force at w = 1 with the mediator in balance (`pair/mediator`). Source: `docs/theory-rigid.md`.

/// w₀ of a damping that is one-sided [m/s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OneSided(pub f64);

/// What is added to the speed with which something recedes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shift {
    /// s − w [m/s].
    pub by: f64,
    /// ds/dw − 1.
    pub slope: f64,
}

impl OneSided {
    /// At a speed w [m/s].
    pub fn shift(self, speed: f64) -> Shift {
        let Self(release) = self;
        let root = libm::hypot(speed, release);
        // ½(w₀ − w − √(w² + w₀²)): where w is far below zero, w + √ is w₀²/(√ − w).
        let sum = if speed < 0.0 { release * release / (root - speed) } else { speed + root };
        Shift { by: 0.5 * (release - sum), slope: -0.5 * sum / root }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speed_of_what_recedes_is_bounded_and_of_what_comes_kept() {
        let one_sided = OneSided(1e-3);
        let taken = |speed: f64| speed + one_sided.shift(speed).by;
        assert_eq!(taken(0.0), 0.0);
        assert!((taken(10.0) / 5e-4 - 1.0).abs() < 1e-4 && (taken(-10.0) / -9.9995 - 1.0).abs() < 1e-8);
        for k in -40..=40 {
            let speed = 1e-4 * f64::from(k);
            let slope = (taken(speed + 1e-8) - taken(speed - 1e-8)) / 2e-8;
            assert!((1.0 + one_sided.shift(speed).slope - slope).abs() < 1e-7);
            assert!(taken(speed) * speed >= 0.0 && (0.0..=1.0).contains(&slope));
        }
    }
}
