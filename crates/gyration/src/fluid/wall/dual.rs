//! Numbers with their derivative by one variable: a + a′ε, ε² = 0.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its derivative.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Dual {
    pub value: f64,
    pub slope: f64,
}

impl Dual {
    /// A number that does not change.
    pub const fn constant(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }

    /// The variable itself.
    pub const fn variable(value: f64) -> Self {
        Self { value, slope: 1.0 }
    }

    pub fn exp(self) -> Self {
        let value = libm::exp(self.value);
        Self { value, slope: value * self.slope }
    }

    pub fn ln(self) -> Self {
        Self { value: libm::log(self.value), slope: self.slope / self.value }
    }

    pub fn sinh(self) -> Self {
        Self { value: libm::sinh(self.value), slope: libm::cosh(self.value) * self.slope }
    }

    pub fn cosh(self) -> Self {
        Self { value: libm::cosh(self.value), slope: libm::sinh(self.value) * self.slope }
    }

    /// coth x = 1 + 2/(e^2x − 1).
    pub fn coth(self) -> Self {
        let below = libm::expm1(2.0 * self.value);
        let value = 1.0 + 2.0 / below;
        // 1 − coth², without a difference.
        Self { value, slope: -4.0 / below * (1.0 + 1.0 / below) * self.slope }
    }
}

impl Add for Dual {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Sub for Dual {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl Neg for Dual {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl Mul for Dual {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

impl Div for Dual {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl Mul<Dual> for f64 {
    type Output = Dual;

    fn mul(self, other: Dual) -> Dual {
        Dual { value: self * other.value, slope: self * other.slope }
    }
}

#[cfg(test)]
mod tests {
    use super::Dual;

    #[test]
    fn derivatives_agree_with_differences() {
        let function =
            |x: Dual| (x.coth() * x.exp() - x.sinh() / x.cosh()) / (x * x + Dual::constant(0.3)) - (-x).exp() * x.ln();
        for x in [0.02, 0.7, 3.0] {
            let step = 1e-6 * x;
            let known =
                (function(Dual::constant(x + step)).value - function(Dual::constant(x - step)).value) / (2.0 * step);
            let found = function(Dual::variable(x)).slope;
            assert!((found - known).abs() < 1e-8 * known.abs(), "{x}: {found} {known}");
        }
    }
}
