//! The kernels of a call, prepared once and evaluated together.
//!
//! Nodes are shared between requests and worked on in groups of [`LANES`], so that a gap, its reciprocal or logarithm
//! and the geometry of a node are computed once, and loops over the lanes become vector instructions. Whole exponents
//! are products of d^−1, d^−2, d^−4, d^−8, half-integers take one square root more, others are exp(−ν ln d). Nodes at
//! which every kernel has fallen below [`NEGLIGIBLE`] of its largest value may be left out; [`Integrand::cut`] says
//! from which gap on.

use crate::surface::{Kernel, MomentRequest};

/// The most requests that are worked on at once; longer lists are cut into groups of this size.
pub(crate) const GROUP: usize = 8;

/// Nodes that are worked on together.
pub(crate) const LANES: usize = 4;

/// One number for each node of a group.
pub(crate) type Lane = [f64; LANES];

/// The e-folds, 1e-12, below which a share of a moment may be left out: well below the accuracy of the rules.
const NEGLIGIBLE: f64 = 27.631021115928547;

/// Whole powers below this are products of the squarings d^∓1, d^∓2, d^∓4, d^∓8.
const MOST_WHOLE: u32 = 16;

/// The kernels of at most [`GROUP`] requests.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Integrand {
    terms: [KernelTerm; GROUP],
    count: usize,
    needs_log: bool,
    /// The largest exponent; that of ln d counts as 0.
    pub(crate) sharpest: f64,
    /// The smallest exponent.
    pub(crate) mildest: f64,
    /// The highest order.
    pub(crate) order: usize,
}

#[derive(Debug, Clone, Copy)]
enum KernelTerm {
    /// d^−n, times d^−½ if `half`.
    Inverse {
        whole: u32,
        half: bool,
    },
    /// d^p for any p.
    Real(f64),
    Log,
}

impl Integrand {
    /// The kernels of `requests`, [`GROUP`] at most.
    pub(crate) fn new(requests: &[MomentRequest]) -> Self {
        let mut integrand = Self {
            terms: [KernelTerm::Log; GROUP],
            count: requests.len().min(GROUP),
            needs_log: false,
            sharpest: f64::NEG_INFINITY,
            mildest: f64::INFINITY,
            order: 0,
        };
        for (term, request) in integrand.terms.iter_mut().zip(requests) {
            let (kind, exponent) = match request.kernel {
                Kernel::Power(nu) => (KernelTerm::power(nu), nu),
                Kernel::Log => (KernelTerm::Log, 0.0),
            };
            *term = kind;
            integrand.needs_log |= !matches!(kind, KernelTerm::Inverse { .. });
            integrand.sharpest = integrand.sharpest.max(exponent);
            integrand.mildest = integrand.mildest.min(exponent);
            integrand.order = integrand.order.max(request.order);
        }
        integrand
    }

    /// The number of kernels.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// The kernels at several gaps d > 0 [m]; entries beyond the requests are zero.
    #[inline(always)]
    pub(crate) fn at_each<const N: usize>(&self, gaps: &[f64; N]) -> [[f64; N]; GROUP] {
        let inverse = gaps.map(|gap| 1.0 / gap);
        let second = inverse.map(|x| x * x);
        let fourth = second.map(|x| x * x);
        let squarings = [inverse, second, fourth, fourth.map(|x| x * x)];
        let logs = if self.needs_log { gaps.map(libm::log) } else { [0.0; N] };
        let mut values = [[0.0; N]; GROUP];
        for (value, term) in values[..self.count].iter_mut().zip(&self.terms) {
            *value = match *term {
                KernelTerm::Inverse { whole, half } => {
                    let start = if half { inverse.map(f64::sqrt) } else { [1.0; N] };
                    product(&squarings, whole, start)
                }
                KernelTerm::Real(power) => logs.map(|log| libm::exp(power * log)),
                KernelTerm::Log => logs,
            };
        }
        values
    }

    /// The gap beyond which d^−(ν − less) is negligible for all kernels; infinite if some kernel never is.
    pub(crate) fn cut(&self, near: f64, less: f64) -> f64 {
        near * self.cut_ratio(less)
    }

    /// The same as a multiple of the smallest gap.
    pub(crate) fn cut_ratio(&self, less: f64) -> f64 {
        let exponent = self.mildest - less;
        if exponent > 0.1 { libm::exp(NEGLIGIBLE / exponent) } else { f64::INFINITY }
    }
}

impl KernelTerm {
    /// The cheapest way to d^−ν.
    fn power(nu: f64) -> Self {
        let floor = nu.floor();
        let half = nu - floor;
        if (half == 0.0 || half == 0.5) && floor >= 0.0 && floor < f64::from(MOST_WHOLE) {
            Self::Inverse { whole: floor as u32, half: half == 0.5 }
        } else {
            Self::Real(-nu)
        }
    }
}

/// start · x^whole from x, x², x⁴, x⁸.
#[inline(always)]
fn product<const N: usize>(squarings: &[[f64; N]; 4], whole: u32, start: [f64; N]) -> [f64; N] {
    let mut value = start;
    for (bit, power) in squarings.iter().enumerate() {
        if whole >> bit & 1 == 1 {
            for (value, factor) in value.iter_mut().zip(power) {
                *value *= factor;
            }
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_are_powers_of_the_gap() {
        let exponents = [-1.0, 0.0, 0.5, 1.0, 6.0, 7.5, 15.0, 17.0];
        let requests = exponents.map(|nu| MomentRequest { kernel: Kernel::Power(nu), order: 0 });
        let gaps = [1e-4, 0.03, 1.0, 20.0];
        let found = Integrand::new(&requests).at_each(&gaps);
        for (nu, values) in exponents.into_iter().zip(found) {
            for (gap, value) in gaps.into_iter().zip(values) {
                let exact = f64::powf(gap, -nu);
                // Rounding of ν ln d, at most 157, in the exponential.
                assert!((value / exact - 1.0).abs() < 1e-13, "{gap}^−{nu}: {value:e} against {exact:e}");
            }
        }
    }
}
