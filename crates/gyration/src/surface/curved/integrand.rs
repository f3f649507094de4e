//! The kernels of a call, evaluated together at one gap.
//!
//! Nodes are shared between requests, so that a gap, its logarithm and the geometry of a node are computed once.
//! Whole exponents are evaluated by multiplication, others as exp(−ν ln d).

use super::super::{Kernel, MomentRequest};

/// The most requests that are worked on at once; longer lists are cut into groups of this size.
pub(crate) const GROUP: usize = 8;

/// The kernels of at most [`GROUP`] requests.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Integrand {
    terms: [Term; GROUP],
    count: usize,
    needs_log: bool,
}

#[derive(Debug, Clone, Copy)]
enum Term {
    Whole(i32),
    Real(f64),
    Log,
}

impl Integrand {
    /// The kernels of the first [`GROUP`] of `requests`.
    pub(crate) fn new(requests: &[MomentRequest]) -> Self {
        let count = requests.len().min(GROUP);
        let mut terms = [Term::Log; GROUP];
        for (term, request) in terms.iter_mut().zip(requests) {
            *term = match request.kernel {
                Kernel::Power(nu) if nu == nu.trunc() && nu.abs() < 1e3 => {
                    Term::Whole(-(nu as i32))
                }
                Kernel::Power(nu) => Term::Real(-nu),
                Kernel::Log => Term::Log,
            };
        }
        let needs_log = terms[..count]
            .iter()
            .any(|term| !matches!(term, Term::Whole(_)));
        Self {
            terms,
            count,
            needs_log,
        }
    }

    /// The kernels at a gap d > 0 [m]; entries beyond the requests are zero.
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
}
