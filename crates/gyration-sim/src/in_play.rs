//! The energy in play of an island: what its bodies exchange, by which a residual of the ledger is judged.
//!
//!   E = max(max_t K, max_t Σ|W|)
//!
//! K is the magnitude of the kinetic energy [J], W the works [J], t the ends of all steps: a motion that is looked at
//! where it turns has no kinetic energy in any row. The potential energies vary by Σ W − K, which E bounds to a factor
//! of two.
//!
//! When islands merge, what was in play in both is in play in one. When an island falls apart, its parts share what was
//! in play by their kinetic energies. The sum over all islands so changes only where energy comes into play, and hangs
//! on the paths alone.

/// What has been in play in an island.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InPlay {
    /// The largest kinetic energy [J].
    kinetic: f64,
    /// The largest Σ|works| [J], those of the islands before it included.
    exchanged: f64,
    /// Σ|works| of the islands before it at the time at which it began [J].
    before: f64,
}

impl InPlay {
    /// Notes the kinetic energy [J] and the works [J] at the end of a step.
    pub fn note(&mut self, kinetic: f64, works: &[f64]) {
        self.kinetic = self.kinetic.max(kinetic.abs());
        self.exchanged = self.exchanged.max(self.before + sum(works));
    }

    /// Two islands, with their works [J], that become one.
    #[must_use]
    pub fn merged(self, works: &[f64], other: Self, works_of_other: &[f64]) -> Self {
        Self {
            kinetic: self.kinetic + other.kinetic,
            exchanged: self.exchanged + other.exchanged,
            before: self.before + sum(works) + other.before + sum(works_of_other),
        }
    }

    /// The share of a part of an island, with its works [J], that falls apart.
    #[must_use]
    pub fn share(self, works: &[f64], share: f64) -> Self {
        Self {
            kinetic: share * self.kinetic,
            exchanged: share * self.exchanged,
            before: share * (self.before + sum(works)),
        }
    }

    /// The numbers of a checkpoint.
    pub fn numbers(&self) -> [f64; 3] {
        [self.kinetic, self.exchanged, self.before]
    }

    /// From the numbers of a checkpoint.
    pub fn of_numbers([kinetic, exchanged, before]: [f64; 3]) -> Self {
        Self { kinetic, exchanged, before }
    }

    /// The energy in play of all islands together [J].
    pub fn of_all(islands: impl Iterator<Item = Self>) -> f64 {
        let (kinetic, exchanged) = islands.fold((0.0, 0.0), |(k, w), it| (k + it.kinetic, w + it.exchanged));
        f64::max(kinetic, exchanged)
    }
}

fn sum(works: &[f64]) -> f64 {
    works.iter().map(|work| work.abs()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_in_play_does_not_grow_by_merging_and_falling_apart() {
        let mut one = InPlay::default();
        one.note(1.0, &[0.0, -0.5]);
        let mut united = one.merged(&[0.0, -0.5], InPlay::default(), &[0.0]);
        united.note(0.75, &[0.0, -0.25]);
        assert_eq!(united.numbers(), [1.0, 0.75, 0.5]);
        let parts = [0.25, 0.75].map(|share| united.share(&[0.0, -0.25], share));
        assert_eq!(InPlay::of_all([united].into_iter()), 1.0);
        assert_eq!(InPlay::of_all(parts.into_iter()), 1.0);
        let again = parts[0].merged(&[], parts[1], &[]);
        assert_eq!(again.numbers(), [1.0, 0.75, 0.75]);
    }

    #[test]
    fn works_that_swing_count_once_and_works_that_take_add_up() {
        let (mut swinging, mut taken) = (InPlay::default(), InPlay::default());
        // Each part begins with works of zero.
        for _ in 0..4 {
            [3.0, 0.0].into_iter().for_each(|work| swinging.note(0.0, &[work]));
            swinging = swinging.share(&[0.0], 1.0);
            taken.note(0.0, &[-1.0]);
            taken = taken.share(&[-1.0], 1.0);
        }
        assert_eq!([swinging, taken].map(|it| InPlay::of_all([it].into_iter())), [3.0, 4.0]);
    }
}
