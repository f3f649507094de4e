//! What the energies of a state leave open: so much a ledger that is right may miss.
//!
//!   Σ |f| (atol·size + rtol·min(g, size)) + Σ (8(ν−1) + ν size/g) ε U + Σ 16 ε V |∂S/∂P|
//!
//! The first sum is over the contacts, springs and pairs of all bodies: the step control allows each length the error
//! in brackets, and the energy of what is loaded at rest feels it at first order, however small the motion about it is.
//! The second is over the pairs of bodies, whose gaps are differences, the third over bodies with a material, whose
//! strains are: the rounding of their energies.

use crate::adapter::Tolerance;
use crate::scales::{ROUNDING, elastic_stiffness};
use gyration::Inadmissible;
use gyration::dynamics::{Workspace, each_push};
use gyration::model::Model;
use gyration::state::State;
use std::ops::Add;

/// What the energies of a state leave open.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Looseness {
    /// Forces times the lengths that the step control allows [J].
    pub of_lengths: f64,
    /// The rounding of the energies of pairs and strains [J].
    pub of_energies: f64,
}

impl Add for Looseness {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { of_lengths: self.of_lengths + other.of_lengths, of_energies: self.of_energies + other.of_energies }
    }
}

impl Looseness {
    /// Of a state.
    ///
    /// # Errors
    /// [`Inadmissible`] where it is outside the model.
    pub fn of(
        model: &Model,
        workspace: &mut Workspace,
        state: &State,
        tolerance: Tolerance,
    ) -> Result<Self, Inadmissible> {
        let Tolerance { rtol, atol } = tolerance;
        let (instant, scratch) = workspace.read(model, state)?;
        let mut sum = Self::default();
        for (index, body) in model.bodies.iter().enumerate() {
            sum.of_energies += ROUNDING * elastic_stiffness(body);
            each_push(&instant.at(index), scratch, |push| {
                let of_lengths = push.force * (atol * body.size + rtol * push.gap.min(body.size));
                sum = sum + Self { of_lengths, of_energies: push.rounding };
            })?;
        }
        Ok(sum)
    }

    /// What a run leaves open, given that of its start and of its end: the forces that load it at both, not those of an
    /// impact in which it ends, and the larger rounding.
    #[must_use]
    pub fn over(self, end: Self) -> Self {
        Self { of_lengths: self.of_lengths.min(end.of_lengths), of_energies: self.of_energies.max(end.of_energies) }
    }
}
