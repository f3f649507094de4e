//! The gaps at which a force carries a weight: where a balance changes its sign, and by halving between two trial gaps.
//!
//! Trial gaps stand in a geometric row. Of a balance that only falls the trials beside its root are found by halving
//! the row; it is then the root that a search through all of them finds, at a tenth of the cost.

use gyration_threads::Interruption;

/// Trial gaps in a decade; two balances nearer than that would be missed.
const TRIALS_PER_DECADE: f64 = 25.0;
/// Halvings of a bracket: a step of the search is halved to below rounding.
const HALVINGS: usize = 60;

/// Trial gaps [m], ascending.
pub(crate) struct TrialGaps {
    least: f64,
    ratio: f64,
    /// How many steps the row has: one less than gaps.
    steps: usize,
}

impl TrialGaps {
    /// From the least gap to the largest.
    pub fn between(least: f64, largest: f64) -> Self {
        let ratio = largest / least;
        Self { least, ratio, steps: (TRIALS_PER_DECADE * libm::log10(ratio)).ceil() as usize }
    }

    fn gap(&self, k: usize) -> f64 {
        self.least * libm::pow(self.ratio, k as f64 / self.steps as f64)
    }

    /// All gaps at which a balance changes its sign, ascending; it is not known everywhere. Those found so far, where
    /// it is given up.
    pub fn roots(&self, balance: impl Fn(f64) -> Option<f64>) -> Vec<f64> {
        let mut roots = Vec::new();
        let mut previous = None;
        for k in 0..=self.steps {
            if Interruption::due().is_some() {
                break;
            }
            let here = balance(self.gap(k)).map(|value| (self.gap(k), value));
            if let (Some(before), Some(here)) = (previous, here)
                && crosses(before, here)
            {
                roots.extend(bisect(before, here, &balance));
            }
            previous = here;
        }
        roots
    }

    /// The same of a balance that only falls, and is unknown at small gaps only, where it is too large for a number.
    pub fn root_of_falling(&self, balance: impl Fn(f64) -> Option<f64>) -> Vec<f64> {
        let here = |k: usize| balance(self.gap(k)).map(|value| (self.gap(k), value));
        let is_behind = |k: usize| here(k).is_some_and(|(_, value)| value <= 0.0);
        // All that stand before `low` push, `high` and all behind do not.
        let (mut low, mut high) = (0, self.steps);
        if !is_behind(high) {
            // Nothing crosses, unless it is unknown there: then look everywhere.
            return if here(high).is_some() { Vec::new() } else { self.roots(balance) };
        }
        while low < high {
            let middle = low.midpoint(high);
            if is_behind(middle) { high = middle } else { low = middle + 1 }
        }
        let before = high.checked_sub(1).and_then(here);
        before.zip(here(high)).and_then(|(before, here)| bisect(before, here, &balance)).into_iter().collect()
    }
}

/// Whether the balance changes its sign; a zero counts with what follows, so that it is found once.
fn crosses(before: (f64, f64), here: (f64, f64)) -> bool {
    (before.1 > 0.0) != (here.1 > 0.0)
}

/// The root between two gaps, by halving in ln d.
fn bisect(before: (f64, f64), here: (f64, f64), balance: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let (mut low, mut high) = (before.0, here.0);
    let positive_below = before.1 > 0.0;
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if (balance(middle)? > 0.0) == positive_below { low = middle } else { high = middle }
    }
    Some((low * high).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_falling_balance_halving_finds_the_root_that_the_search_finds() {
        let trials = TrialGaps::between(1e-15, 1e3);
        // Too large for a number at the smallest gaps; the last two have no root in the row, the one before at its end.
        for (weight, power) in [(1.0, 6), (1e-3, 2), (3e200, 30), (7.0, 1), (1e-3, 1), (-1.0, 6), (1e40, 1)] {
            let balance = |gap: f64| Some(gap.powi(-power)).filter(|push| push.is_finite()).map(|push| push - weight);
            assert_eq!(trials.root_of_falling(balance), trials.roots(balance), "{weight:e}, {power}");
        }
        let unknown_far_away = |gap: f64| (gap < 10.0).then(|| 1.0 / gap - 1.0);
        assert_eq!(trials.root_of_falling(unknown_far_away), trials.roots(unknown_far_away));
    }

    #[test]
    fn halving_finds_the_root_of_a_falling_and_of_a_rising_balance() {
        for sign in [1.0, -1.0] {
            let balance = |gap: f64| Some(sign * (2.0 - gap));
            let root = bisect((0.5, balance(0.5).unwrap()), (30.0, balance(30.0).unwrap()), balance);
            // Sixty halvings of ln 60 leave rounding.
            assert!((root.unwrap() - 2.0).abs() < 1e-14);
        }
    }
}
