//! Scratch that the islands of one body share: what a step needs and does not leave.
//!
//! The matrices of an implicit step and the workspace of the mechanics would be two thirds of the memory of a body. On
//! each thread one island steps at a time, and what it is lent leaves no trace in any number.

use crate::adapter::OwnWorkspace;
use crate::island::Island;
use gyration_ode::Scratch;
use std::sync::{Mutex, PoisonError};

/// Whether an island is lent scratch: not one of several bodies, whose factors are made for a pattern that few share,
/// nor one that meets supports with a shape: a workspace remembers the planes of pairs.
pub(super) fn borrows_scratch(island: &Island) -> bool {
    island.members().len() == 1 && island.model().rules().is_empty()
}

/// Scratch of one thread.
#[derive(Default)]
struct Pooled {
    stepper: Scratch,
    workspace: OwnWorkspace,
}

/// As much scratch as there are threads that have asked for it at once.
#[derive(Default)]
pub(crate) struct ScratchPool(Mutex<Vec<Pooled>>);

impl ScratchPool {
    /// Does something with each of these islands, which have scratch meanwhile.
    pub fn with_scratch<'a>(&self, islands: impl Iterator<Item = &'a mut Island>, mut act: impl FnMut(&mut Island)) {
        let shared = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut pooled = shared().pop().unwrap_or_default();
        for island in islands {
            if !borrows_scratch(island) {
                act(island);
                continue;
            }
            island.integrator.take_scratch(&mut pooled.stepper);
            island.system.exchange_workspace(&mut pooled.workspace);
            act(island);
            island.system.exchange_workspace(&mut pooled.workspace);
            island.integrator.give_scratch(&mut pooled.stepper);
        }
        shared().push(pooled);
    }
}
