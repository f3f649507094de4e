//! A set of laws that act together, with the list of surface moments that they need.
//!
//! Laws share powers of the gap (damping and friction often have the same exponent, and the derivative of d^−6 is the
//! power that d^−7 asks for), so the requests are merged once, when the set is made; all bodies that obey it share it.

use super::potential::{self, PotentialTerm};
use super::{Action, AreaMeasure, ContactLaw, OneSided, Term};
use crate::surface::{AxialMoments, MomentPlan, Moments, OrientedMoments, request};

/// Laws that act together.
#[derive(Debug, Clone, PartialEq)]
pub struct LawSet {
    /// In which measure of area the tractions are given.
    pub measure: AreaMeasure,
    laws: Vec<ContactLaw>,
    terms: Vec<PlannedTerm>,
    acts: [bool; Action::COUNT],
    mu: Option<f64>,
    release: Option<f64>,
    values: MomentPlan,
    derivatives: MomentPlan,
    potentials: MomentPlan,
    potential_terms: Vec<PotentialTerm>,
}

/// A term and where its moments stand among those requested.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PlannedTerm {
    pub term: Term,
    /// Index among the value requests.
    pub value: usize,
    /// Index of exponent ν among the derivative requests.
    pub value_with_derivative: usize,
    /// Index of exponent ν + 1 among the derivative requests.
    pub derivative: usize,
}

/// Room for the moments of one evaluation; made once, reused.
#[derive(Debug, Clone, Default)]
pub struct ContactScratch {
    moments: Vec<Moments>,
    oriented: Vec<OrientedMoments>,
    axial: Vec<AxialMoments>,
}

impl ContactScratch {
    /// The first `count` moments, growing if this is the first use.
    pub(super) fn take(&mut self, count: usize) -> &mut [Moments] {
        if self.moments.len() < count {
            self.moments.resize(count, Moments::default());
        }
        &mut self.moments[..count]
    }

    /// The first `count` oriented moments, growing if this is the first use.
    pub(super) fn take_oriented(&mut self, count: usize) -> &mut [OrientedMoments] {
        if self.oriented.len() < count {
            self.oriented.resize(count, OrientedMoments::default());
        }
        &mut self.oriented[..count]
    }

    /// The first `count` moments of a ball, growing if this is the first use.
    pub(super) fn take_axial(&mut self, count: usize) -> &mut [AxialMoments] {
        if self.axial.len() < count {
            self.axial.resize(count, AxialMoments::default());
        }
        &mut self.axial[..count]
    }
}

impl LawSet {
    /// Joins the laws and plans which surface moments they need.
    pub fn new(measure: AreaMeasure, laws: Vec<ContactLaw>) -> Self {
        let mut value_requests = Vec::new();
        let mut derivative_requests = Vec::new();
        let terms: Vec<PlannedTerm> = laws
            .iter()
            .flat_map(ContactLaw::terms)
            .flatten()
            .map(|term| {
                // A central traction needs ∫κX; a viscous one, linear in X itself, ∫κX⊗X.
                let order = if term.action == Action::Central { 1 } else { 2 };
                PlannedTerm {
                    term,
                    value: request(&mut value_requests, term.exponent, order),
                    value_with_derivative: request(&mut derivative_requests, term.exponent, order),
                    derivative: request(&mut derivative_requests, term.exponent + 1.0, order + 1),
                }
            })
            .collect();
        let (values, derivatives) = (MomentPlan::new(value_requests), MomentPlan::new(derivative_requests));
        let (requests, potential_terms) = potential::plan(laws.iter().flat_map(ContactLaw::terms).flatten());
        let potentials = MomentPlan::new(requests);
        let acts = Action::ALL.map(|action| terms.iter().any(|planned| planned.term.action == action));
        let mu = laws.iter().find_map(ContactLaw::mu);
        let release = laws.iter().find_map(ContactLaw::release);
        Self { measure, laws, terms, acts, mu, release, values, derivatives, potentials, potential_terms }
    }

    /// The laws.
    pub fn laws(&self) -> &[ContactLaw] {
        &self.laws
    }

    /// W of `negligible`: a bound on the work from a distance [m] to infinity on a surface of so large an area [m²],
    /// none of whose points comes nearer or moves faster than a speed [m/s]; infinite where an exponent is one or less
    /// [J].
    pub fn work_beyond(&self, area: f64, distance: f64, speed: f64) -> f64 {
        let work = |planned: &PlannedTerm| match planned.term.falling_work(speed) {
            Some((factor, falls)) => factor * libm::pow(distance, -falls) / falls,
            None => f64::INFINITY,
        };
        area * self.terms.iter().map(work).sum::<f64>()
    }

    pub(super) fn terms(&self) -> &[PlannedTerm] {
        &self.terms
    }

    /// Whether any of the terms acts like this.
    pub(super) fn acts(&self, action: Action) -> bool {
        self.acts[action as usize]
    }

    /// μ, where the friction has a bound: a contact has one friction.
    pub fn mu(&self) -> Option<f64> {
        self.mu
    }

    /// Of damping that is one-sided: a contact has one damping.
    pub(super) fn one_sided(&self) -> Option<OneSided> {
        self.release.map(OneSided)
    }

    /// Whether the loads are linear in the velocities.
    pub fn is_linear(&self) -> bool {
        self.mu.is_none() && self.release.is_none()
    }

    /// The moments that the loads need.
    pub(super) fn values(&self) -> &MomentPlan {
        &self.values
    }

    /// The moments of the potentials of the central laws.
    pub(super) fn potentials(&self) -> &MomentPlan {
        &self.potentials
    }

    /// How the potentials are put together from them.
    pub(super) fn potential_terms(&self) -> &[PotentialTerm] {
        &self.potential_terms
    }

    /// The moments that the loads and their derivatives need.
    pub(super) fn derivatives(&self) -> &MomentPlan {
        &self.derivatives
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Damping, Friction, Repulsion};
    use crate::surface::{Kernel, MomentRequest};

    #[test]
    fn laws_share_the_powers_that_they_have_in_common() {
        let laws = vec![
            ContactLaw::Repulsion(Repulsion { alpha: 1.0, exponent: 6.0, reference_gap: 1.0 }),
            ContactLaw::Damping(Damping { beta: 1.0, exponent: 5.0, reference_gap: 1.0, release: None }),
            ContactLaw::Friction(Friction { beta: 1.0, exponent: 5.0, reference_gap: 1.0, mu: None }),
        ];
        let laws = LawSet::new(AreaMeasure::default(), laws);
        let orders = |requests: &[MomentRequest]| {
            requests.iter().map(|request| (request.kernel, request.order)).collect::<Vec<_>>()
        };
        assert_eq!(orders(laws.values().requests()), [(Kernel::Power(6.0), 1), (Kernel::Power(5.0), 2)]);
        // d^−6 serves the repulsion itself and the derivative of the damping.
        assert_eq!(
            orders(laws.derivatives().requests()),
            [(Kernel::Power(6.0), 3), (Kernel::Power(7.0), 2), (Kernel::Power(5.0), 2)]
        );
    }
}
