//! The kernels of a call, prepared once and evaluated together.
//!
//! Nodes are shared between requests, so that a gap, its logarithm and the geometry of a node are computed once.
//! Whole exponents are evaluated by multiplication, others as exp(−ν ln d). Nodes at which every kernel has fallen
//! below [`NEGLIGIBLE`] of its largest value may be left out; [`Integrand::cut`] says from which gap on.

use super::super::power::LineKernel;
use super::super::{Kernel, MomentRequest};

/// The most requests that are worked on at once; longer lists are cut into groups of this size.
pub(crate) const GROUP: usize = 8;

/// Share of a moment that may be left out, well below the accuracy of the rules.
const NEGLIGIBLE: f64 = 1e-12;

/// The kernels of at most [`GROUP`] requests.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Integrand {
    terms: [Term; GROUP],
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
enum Term {
    Whole(i32),
    Real(f64),
    Log,
}

impl Integrand {
    /// The kernels of `requests`, [`GROUP`] at most.
    pub(crate) fn new(requests: &[MomentRequest]) -> Self {
        let mut integrand = Self {
            terms: [Term::Log; GROUP],
            count: requests.len().min(GROUP),
            needs_log: false,
            sharpest: f64::NEG_INFINITY,
            mildest: f64::INFINITY,
            order: 0,
        };
        for (term, request) in integrand.terms.iter_mut().zip(requests) {
            let (kind, exponent) = match request.kernel {
                Kernel::Power(nu) if nu == nu.trunc() && nu.abs() < 1e3 => (Term::Whole(-(nu as i32)), nu),
                Kernel::Power(nu) => (Term::Real(-nu), nu),
                Kernel::Log => (Term::Log, 0.0),
            };
            *term = kind;
            integrand.needs_log |= !matches!(kind, Term::Whole(_));
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

    /// The kernels at a gap d > 0 [m]; entries beyond the requests are zero.
    #[inline]
    pub(crate) fn at(&self, gap: f64) -> [f64; GROUP] {
        let log = if self.needs_log { gap.ln() } else { 0.0 };
        let mut values = [0.0; GROUP];
        for (value, term) in values[..self.count].iter_mut().zip(&self.terms) {
            *value = match *term {
                Term::Whole(power) => gap.powi(power),
                Term::Real(power) => (power * log).exp(),
                Term::Log => log,
            };
        }
        values
    }

    /// The gap beyond which d^−(ν − less) is negligible for all kernels; infinite if some kernel never is.
    pub(crate) fn cut(&self, near: f64, less: f64) -> f64 {
        let exponent = self.mildest - less;
        if exponent > 0.1 { near * NEGLIGIBLE.powf(-1.0 / exponent) } else { f64::INFINITY }
    }
}

/// The kernels of at most [`GROUP`] requests, for integration along straight lines.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lines {
    kernels: [LineKernel; GROUP],
    count: usize,
}

impl Lines {
    pub(crate) fn new(requests: &[MomentRequest]) -> Self {
        let count = requests.len().min(GROUP);
        let mut kernels = [LineKernel::new(requests.first().map_or(Kernel::Log, |request| request.kernel)); GROUP];
        for (kernel, request) in kernels.iter_mut().zip(requests).skip(1) {
            *kernel = LineKernel::new(request.kernel);
        }
        Self { kernels, count }
    }

    /// The kernels, in the order of the requests.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &LineKernel> {
        self.kernels[..self.count].iter()
    }
}
