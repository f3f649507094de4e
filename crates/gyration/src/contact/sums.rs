//! Sums of coefficient × moment over the terms of a contact, action by action: what the laws share before they act.
//!
//! A law's moments are those of its power of the gap, A₀, A₁, A₂ of d^−ν. Their derivatives by the height g₀ and the
//! components of m, d = g₀ + m·X, are those of exponent ν + 1, of the same order and of one more:
//!
//!   ∂(d^−ν) = −ν d^−(ν+1) (δg₀ + δm·X)

use super::Action;
use super::law_set::LawSet;
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
}
