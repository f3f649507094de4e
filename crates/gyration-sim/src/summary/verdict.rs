//! Whether the ledger of a run closes.
//!
//!   |Σ energies − Σ energies at 0 − Σ works| ≤ MARGIN [(rtol + atol) E + Σ|f| δ] + ROUNDING Σ|energies| + ε
//!
//! E is the energy in play (`in_play`), f the forces of what is loaded at the start and the end, δ the lengths that the
//! step control allows, ε the rounding of the energies of pairs and strains (`looseness`). Over a run the residual
//! stays below rtol·E where the steps are what they claim to be; one that is a hundred times the tolerances has lost or
//! made energy that no law accounts for. However loose the tolerances are, more than 1 % of E is never taken for
//! closed.

use crate::adapter::Tolerance;
use serde::Serialize;

/// What the residual may be, in tolerances times the energy in play.
const MARGIN: f64 = 100.0;
/// Part of the energy in play that is never let pass, however loose the tolerances.
const MOST_LOST: f64 = 0.01;
/// A residual below this fraction of the energies is their own rounding.
pub(super) const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// What to do about an open ledger.
pub(super) const ADVICE: &str =
    "take a smaller solver.rtol, and look for gaps and coefficients out of proportion with the bodies";
/// Runs that are named.
const MOST_NAMED: usize = 5;

/// Whether the energy balance of a run closes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// As well as the tolerances promise.
    Closed,
    /// It misses by much more than the tolerances.
    Open,
}

impl Verdict {
    /// Its name in recordings and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Closed => "closed",
            Self::Open => "open",
        }
    }
}

/// Those of many runs whose ledger is open.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct OpenLedgers {
    /// How many there are.
    pub count: u64,
    /// The first few.
    first: Vec<u64>,
}

impl OpenLedgers {
    /// One more, by the number of its run.
    pub fn add(&mut self, run: u64) {
        self.count += 1;
        if self.first.len() < MOST_NAMED {
            self.first.push(run);
        }
    }

    /// What a user must be told of them.
    pub fn warning(&self) -> Option<String> {
        let named = self.first.iter().map(u64::to_string).collect::<Vec<_>>().join(", ");
        match self.count {
            0 => None,
            1 => Some(format!("the energy balance of run {named} is open. Do not trust it: {ADVICE}.")),
            count => {
                let more = count - self.first.len() as u64;
                let more = if more > 0 { format!(" and {more} more") } else { String::new() };
                Some(format!("the energy balance of {count} runs is open: {named}{more}. Do not trust them: {ADVICE}."))
            }
        }
    }
}

/// The residual of a run and what it is compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balance {
    /// Largest |residual| over the samples [J].
    pub residual: f64,
    /// The energy in play [J].
    pub in_play: f64,
    /// Σ|energies| [J].
    pub total: f64,
    /// Σ|f| δ, what the tolerances let loaded contacts and springs miss [J].
    pub loaded: f64,
    /// The rounding of the energies of pairs and strains [J].
    pub of_energies: f64,
}

impl Balance {
    /// Whether it closes within tolerances.
    pub fn verdict(&self, tolerance: Tolerance) -> Verdict {
        match self.residual <= self.allowed(tolerance) {
            true => Verdict::Closed,
            false => Verdict::Open,
        }
    }

    /// The residual [J] that tolerances let pass.
    pub fn allowed(&self, tolerance: Tolerance) -> f64 {
        let part = MARGIN * (tolerance.rtol + tolerance.atol);
        part.min(MOST_LOST) * self.in_play + MARGIN * self.loaded + self.rounding()
    }

    /// Whether the residual is no more than the rounding of the energies.
    pub fn is_rounding(&self) -> bool {
        self.residual <= self.rounding()
    }

    fn rounding(&self) -> f64 {
        ROUNDING * self.total + self.of_energies
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(residual: f64, rtol: f64) -> Verdict {
        let balance = Balance { residual, in_play: 2.0, total: 1e3, loaded: 0.0, of_energies: 0.0 };
        balance.verdict(Tolerance { rtol, atol: 0.01 * rtol })
    }

    #[test]
    fn a_residual_is_compared_with_the_tolerances() {
        assert_eq!(verdict(1e-8, 1e-8), Verdict::Closed);
        assert_eq!(verdict(1e-5, 1e-8), Verdict::Open);
        assert_eq!(verdict(1e-5, 1e-4), Verdict::Closed);
    }

    #[test]
    fn a_hundredth_of_the_energy_in_play_is_too_much_at_any_tolerance() {
        assert_eq!(verdict(0.019, 1e-2), Verdict::Closed);
        assert_eq!(verdict(0.021, 1e-2), Verdict::Open);
        assert_eq!(verdict(f64::NAN, 1e-2), Verdict::Open);
    }

    #[test]
    fn of_many_open_ledgers_the_first_are_named() {
        let told = |runs: std::ops::Range<u64>| {
            let mut open = OpenLedgers::default();
            runs.for_each(|run| open.add(run));
            open.warning().unwrap_or_default()
        };
        assert_eq!(told(0..0), "");
        assert!(told(7..8).starts_with("the energy balance of run 7 is open. Do not trust it: take a smaller"));
        assert!(told(7..9).starts_with("the energy balance of 2 runs is open: 7, 8. Do not trust them: "));
        assert!(told(0..1000).starts_with("the energy balance of 1000 runs is open: 0, 1, 2, 3, 4 and 995 more. "));
    }

    #[test]
    fn the_rounding_of_large_energies_is_no_residual() {
        let still = Balance { residual: 1e-13, in_play: 0.0, total: 1e3, loaded: 0.0, of_energies: 0.0 };
        assert_eq!(still.verdict(Tolerance { rtol: 1e-14, atol: 0.0 }), Verdict::Closed);
        assert!(still.is_rounding());
    }
}
