//! The powers [W] of the works done on one body.

use crate::contact::LawKind;
use crate::ledger::Work;
use std::ops::{AddAssign, Index, IndexMut};

/// A power for each work of the ledger.
#[derive(Debug, Clone, Copy, Default)]
pub struct Powers([f64; Work::COUNT]);

impl Powers {
    /// Adds the power of a law.
    pub fn add(&mut self, law: LawKind, power: f64) {
        self[law.work()] += power;
    }
}

impl Index<Work> for Powers {
    type Output = f64;

    fn index(&self, work: Work) -> &f64 {
        &self.0[work as usize]
    }
}

impl IndexMut<Work> for Powers {
    fn index_mut(&mut self, work: Work) -> &mut f64 {
        &mut self.0[work as usize]
    }
}

impl AddAssign for Powers {
    fn add_assign(&mut self, other: Self) {
        self.0.iter_mut().zip(other.0).for_each(|(power, more)| *power += more);
    }
}
