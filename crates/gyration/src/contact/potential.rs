//! The potentials of central laws as kernels of the gap: U = c d^(1−ν)/(ν−1); at ν = 1, −c (ln d − ln d₀).

use super::{Action, LawKind, Term};
use crate::surface::{Kernel, MomentRequest};

/// A kernel of the potential of a term: U is the sum of coefficient × kernel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PotentialTerm {
    pub kind: LawKind,
    pub coefficient: f64,
    /// Index among the requests.
    pub request: usize,
}

/// The kernels of U for one term of a law.
pub(super) fn potential(term: &Term) -> Vec<(Kernel, f64)> {
    match (term.action, term.exponent == 1.0) {
        (Action::Central, true) => {
            let constant = term.coefficient * libm::log(term.reference_gap);
            vec![(Kernel::Log, -term.coefficient), (Kernel::Power(0.0), constant)]
        }
        (Action::Central, false) => {
            vec![(Kernel::Power(term.exponent - 1.0), term.coefficient / (term.exponent - 1.0))]
        }
        _ => Vec::new(),
    }
}

/// The requests of the potentials of some terms, and how they are put together.
pub(super) fn plan(terms: impl Iterator<Item = Term>) -> (Vec<MomentRequest>, Vec<PotentialTerm>) {
    let (mut requests, mut parts): (Vec<MomentRequest>, Vec<PotentialTerm>) = (Vec::new(), Vec::new());
    for term in terms {
        for (kernel, coefficient) in potential(&term) {
            let known = requests.iter().position(|request| request.kernel == kernel);
            let request = known.unwrap_or(requests.len());
            if known.is_none() {
                requests.push(MomentRequest { kernel, order: 0 });
            }
            parts.push(PotentialTerm { kind: term.kind, coefficient, request });
        }
    }
    (requests, parts)
}
