//! Which stepper advances further for its cost.
//!
//!   explicit → implicit:  h|λ| > 3.7/4 or −h Re λ > 1.5/4 in 10 of the last 16 steps (the boundary of stability is at 4.6)
//!   implicit → explicit:  min(2.2/ρ(J), h_max)/17 > 2 h/cost in 6 of the last 8 steps
//!
//! An explicit method on a stiff problem is held at the boundary of stability by its error control, whatever the
//! accuracy asked for; that is seen from the last two stages at no cost. An implicit one of high order reaches farther
//! than an explicit one that is still well within: a quarter of the way is worth a trial of six steps. Back, the
//! spectral radius ρ of the known Jacobian says how far the explicit method could step. A short, violent bounce is no
//! stiff problem: its steps are short for accuracy, and h|λ| stays small. A change that is taken back soon was a
//! mistake: each such doubles the number of explicit steps to be made before the next. Counts, not clocks, decide: a
//! run repeats itself.

use crate::report::{Statistics, Stepper};

/// h ρ(J) that an explicit step can be expected to reach, between what accuracy and what stability allow.
pub(crate) const EXPLICIT_REACH: f64 = 2.2;
/// The part of the stability used from which on the implicit method is worth a trial. A tenth to one were compared over
/// the gallery at three tolerances.
const WORTH_TRYING: f64 = 0.25;
/// Explicit steps that vote, and the votes that decide.
const EXPLICIT_VOTES: (u32, u32) = (16, 10);
/// Implicit steps that vote, and the votes that decide.
const IMPLICIT_VOTES: (u32, u32) = (8, 6);
/// Evaluations of an explicit step.
const EXPLICIT_COST: f64 = 17.0;
/// An analytic Jacobian in evaluations, which shares its integrals with the rates: measured at 1.5 (ellipsoid) to 2.9
/// (box) of them.
const JACOBIAN_COST: f64 = 2.5;
/// Factorizing and solving for a body of thirteen unknowns, and all else that an implicit step does itself, in
/// evaluations: measured at 1 (torus) to 6 (box), 4 to 5 µs. Both by `bench/benches/steppers.rs`.
const LINEAR_COST: f64 = 5.0;
/// The explicit method must promise to be cheaper by this factor: costs and spectral radius are rough.
const ADVANTAGE: f64 = 2.0;
/// An implicit stretch shorter than this was a mistake.
const SHORT_STAY: u64 = 10;
/// The first number of explicit steps barred after a mistake, and how often it may double.
const BAR: (u64, u64) = (32, 7);
/// The state of the decision; plain numbers, part of a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Switch {
    /// The last votes for the other stepper, the newest in the lowest bit.
    pub votes: u64,
    /// Steps since the last change.
    pub stay: u64,
    /// Explicit steps that must pass before a change is considered.
    pub bar: u64,
    /// Mistakes in a row.
    pub patience: u64,
}

impl Switch {
    /// Whether so many mistakes in a row are counted.
    pub fn is_patient(&self) -> bool {
        self.patience <= BAR.1
    }

    /// After an explicit step: whether the implicit method should take over.
    pub fn leave_explicit(&mut self, stiffness: f64) -> bool {
        self.stay += 1;
        if self.bar > 0 {
            self.bar -= 1;
            return false;
        }
        self.vote(stiffness > WORTH_TRYING, EXPLICIT_VOTES)
    }

    /// After an implicit step: whether the explicit method should take over.
    pub fn leave_implicit(&mut self, spectral_radius: f64, effort: &ImplicitEffort) -> bool {
        self.stay += 1;
        if self.stay == SHORT_STAY {
            self.patience = 0;
        }
        self.vote(effort.exceeds_explicit(spectral_radius), IMPLICIT_VOTES)
    }

    /// Records the change to a stepper.
    pub fn change(&mut self, to: Stepper, statistics: &mut Statistics) {
        statistics.switches += 1;
        self.bar = 0;
        if to == Stepper::Explicit && self.stay < SHORT_STAY {
            self.bar = BAR.0 << self.patience;
            self.patience = (self.patience + 1).min(BAR.1);
        }
        (self.votes, self.stay) = (0, 0);
    }

    fn vote(&mut self, against: bool, (window, decisive): (u32, u32)) -> bool {
        self.votes = ((self.votes << 1) | u64::from(against)) & ((1 << window) - 1);
        self.votes.count_ones() >= decisive
    }
}

/// An implicit step and what it has taken.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ImplicitEffort {
    pub h: f64,
    pub max_step: f64,
    pub evaluations: u64,
    /// The cost of the linear algebra beside that of blocks that do not couple.
    pub linear: f64,
}

impl ImplicitEffort {
    /// Whether the explicit method promises to advance further for its cost.
    pub fn exceeds_explicit(&self, spectral_radius: f64) -> bool {
        let explicit = (EXPLICIT_REACH / spectral_radius).min(self.max_step) / EXPLICIT_COST;
        let implicit = self.h / (self.evaluations as f64 + JACOBIAN_COST + self.linear * LINEAR_COST);
        explicit > ADVANTAGE * implicit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_taken_back_bars_the_next_ever_longer() {
        let (mut switch, mut statistics) = (Switch::default(), Statistics::default());
        let mut explicit_steps = Vec::new();
        for _ in 0..4 {
            let mut steps = 1;
            while !switch.leave_explicit(6.0) {
                steps += 1;
            }
            explicit_steps.push(steps);
            switch.change(Stepper::Implicit, &mut statistics);
            let effort = ImplicitEffort { h: 0.1, max_step: 1.0, evaluations: 10, linear: 1.0 };
            while !switch.leave_implicit(1.0, &effort) {}
            switch.change(Stepper::Explicit, &mut statistics);
        }
        assert_eq!(explicit_steps, [10, 42, 74, 138]);
        assert_eq!(statistics.switches, 8);
    }
}
