//! Sums of coefficient × moment over the terms of a contact, action by action: what the laws share before they act.
//!
//! A law's moments are those of its power of the gap, A₀, A₁, A₂ of d^−ν. Their derivatives by the height g₀ and the
//! components of m, d = g₀ + m·X, are those of exponent ν + 1, of the same order and of one more:
//!
//!   ∂(d^−ν) = −ν d^−(ν+1) (δg₀ + δm·X)

use super::law_set::{LawSet, PlannedTerm};
use super::{Action, Bound, LawKind, Sliding, Term};
use crate::surface::Moments;
use crate::tensor::{Mat3, Vec3};

/// Σ c A₀, Σ c A₁ and, for viscous actions, Σ c A₂.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sums {
    pub zeroth: f64,
    pub first: Vec3,
    pub second: Mat3,
}

/// The sums of each action and their derivatives.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SumSlopes {
    /// By [`Action`].
    pub values: [Sums; Action::COUNT],
    /// By [`Action`]: the derivatives by g₀ and the three components of m.
    pub by_gap: [[Sums; 4]; Action::COUNT],
}

impl Sums {
    /// Adds a term's moments.
    #[inline]
    pub fn add(&mut self, coefficient: f64, action: Action, moments: &Moments) {
        self.zeroth += coefficient * moments.zeroth;
        self.first += coefficient * moments.first;
        if action != Action::Central {
            self.second += coefficient * moments.second;
        }
    }

    /// All of it times a factor.
    pub fn scale(&mut self, factor: f64) {
        self.zeroth *= factor;
        self.first *= factor;
        self.second *= factor;
    }

    /// Adds other sums times a factor.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        self.zeroth += factor * other.zeroth;
        self.first += factor * other.first;
        self.second += factor * other.second;
    }

    /// Adds the derivatives by one component of m: the moments with one more X.
    fn add_raised(&mut self, slope: f64, action: Action, moments: &Moments, axis: usize) {
        self.zeroth += slope * moments.first[axis];
        self.first += slope * moments.second.column(axis);
        if action != Action::Central {
            self.second += slope * moments.third.slice(axis);
        }
    }

    /// The sums of each [`Action`] over the terms of a contact, from the moments that it planned for loads.
    #[inline(always)]
    pub fn by_action(laws: &LawSet, moments: &[Moments]) -> [Self; Action::COUNT] {
        let mut sums = [Self::default(); Action::COUNT];
        for planned in laws.terms() {
            let term = &planned.term;
            sums[term.action as usize].add(term.coefficient, term.action, &moments[planned.value]);
        }
        sums
    }

    /// Puts the bound on friction, if it has one, given what it takes of its sums [W]: the sums are then those of σ κ.
    #[inline]
    pub fn bind(sums: &mut [Self; Action::COUNT], laws: &LawSet, moments: &[Moments], lost: impl Fn(&Self) -> f64) {
        if let Some(bound) = Self::bound(sums, laws, moments, lost) {
            sums[Action::Tangential as usize].scale(bound.factor());
        }
    }

    /// The bound on friction, if it has one, given what it takes of its sums [W].
    #[inline]
    pub fn bound(
        sums: &[Self; Action::COUNT],
        laws: &LawSet,
        moments: &[Moments],
        lost: impl Fn(&Self) -> f64,
    ) -> Option<Bound> {
        let mu = laws.mu()?;
        let push = push(laws, |planned| planned.term.coefficient * moments[planned.value].zeroth);
        let friction = &sums[Action::Tangential as usize];
        Some(Bound::new(mu, Sliding { lost: lost(friction), resistance: friction.zeroth, push }))
    }
}

/// Σ over the terms of repulsion: N, or its derivative.
pub(super) fn push(laws: &LawSet, of_term: impl Fn(&PlannedTerm) -> f64) -> f64 {
    laws.terms().iter().filter(|planned| planned.term.kind == LawKind::Repulsion).map(of_term).sum()
}

impl SumSlopes {
    /// The sums over the terms of a contact, from the moments that it planned for derivatives.
    pub fn new(laws: &LawSet, moments: &[Moments]) -> Self {
        let mut sums = Self::default();
        for planned in laws.terms() {
            let term = &planned.term;
            let action = term.action as usize;
            sums.values[action].add(term.coefficient, term.action, &moments[planned.value_with_derivative]);
            let (slope, moments) = (-term.exponent * term.coefficient, &moments[planned.derivative]);
            let [by_height, by_direction @ ..] = &mut sums.by_gap[action];
            by_height.add(slope, term.action, moments);
            for (axis, by_component) in by_direction.iter_mut().enumerate() {
                by_component.add_raised(slope, term.action, moments, axis);
            }
        }
        sums
    }

    /// Puts the bound on friction, if it has one, given what it takes of its sums [W]: the sums are then those of σ κ,
    /// at velocities that are kept. What is returned has the sums without it.
    pub fn bind(&mut self, laws: &LawSet, moments: &[Moments], lost: impl Fn(&Sums) -> f64) -> Option<(Bound, Sums)> {
        let mu = laws.mu()?;
        let free = self.values[Action::Tangential as usize];
        let at = push(laws, |planned| planned.term.coefficient * moments[planned.value_with_derivative].zeroth);
        let bound = Bound::new(mu, Sliding { lost: lost(&free), resistance: free.zeroth, push: at });
        let slope = |term: &Term| -term.exponent * term.coefficient;
        for (place, sums) in self.by_gap[Action::Tangential as usize].iter_mut().enumerate() {
            let push = push(laws, |planned| {
                let moments = &moments[planned.derivative];
                slope(&planned.term) * if place == 0 { moments.zeroth } else { moments.first[place - 1] }
            });
            let change = bound.change(&Sliding { lost: lost(sums), resistance: sums.zeroth, push });
            sums.scale(bound.factor());
            sums.add_scaled(change, &free);
        }
        self.values[Action::Tangential as usize].scale(bound.factor());
        Some((bound, free))
    }
}
