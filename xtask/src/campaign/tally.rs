//! Counts of a campaign.

use super::trial::{Killed, Verdict};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The most scenes of an outcome whose numbers are told: they are the rare ones, worth a look.
const FEW: usize = 12;

/// What the scenes came to.
#[derive(Debug, Default)]
pub struct CampaignTally {
    outcomes: BTreeMap<String, Vec<u64>>,
    kills: BTreeMap<Killed, usize>,
    /// Runs that ended well with an open ledger, and said so: their numbers.
    open: Vec<u64>,
    /// The largest residual over what the tolerances let pass, among closed ledgers, and whose it is.
    worst: (f64, u64),
    /// Scenes that failed, and why.
    pub failures: BTreeMap<u64, String>,
}

impl CampaignTally {
    /// Takes in what a scene came to.
    pub fn take(&mut self, case: u64, verdict: Result<Verdict, String>) {
        match verdict {
            Ok(verdict) => {
                if verdict.is_open {
                    self.open.push(case);
                } else if verdict.residual > self.worst.0 {
                    self.worst = (verdict.residual, case);
                }
                if let Some(killed) = verdict.killed {
                    *self.kills.entry(killed).or_default() += 1;
                }
                self.outcomes.entry(verdict.outcome).or_default().push(case);
            }
            Err(cause) => drop(self.failures.insert(case, cause)),
        }
    }

    /// Scenes that passed.
    pub fn passed(&self) -> usize {
        self.outcomes.values().map(Vec::len).sum()
    }

    /// The counts in words.
    pub fn text(&self) -> String {
        let mut text = format!("{} scenes passed, {} failed", self.passed(), self.failures.len());
        for (outcome, cases) in &self.outcomes {
            let _ = write!(text, "\n  {outcome:<18} {:>6}", cases.len());
            if cases.len() <= FEW {
                let _ = write!(text, "  {:?}", in_order(cases));
            }
        }
        let kills = |killed| self.kills.get(&killed).copied().unwrap_or(0);
        let _ = write!(
            text,
            "\nkilled and resumed: {} on their way, {} before there was a recording, {} had ended",
            kills(Killed::OnItsWay),
            kills(Killed::BeforeItBegan),
            kills(Killed::TooLate)
        );
        let (worst, case) = self.worst;
        let _ = write!(text, "\nworst residual of a closed ledger: {worst:.2e} of what is allowed (scene {case})");
        if !self.open.is_empty() {
            let _ = write!(text, "\nopen ledgers, told by warning and exit code: {:?}", in_order(&self.open));
        }
        text
    }
}

fn in_order(cases: &[u64]) -> Vec<u64> {
    let mut cases = cases.to_vec();
    cases.sort_unstable();
    cases
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_are_counted_by_outcome() {
        let mut tally = CampaignTally::default();
        let verdict = |residual, is_open| Verdict {
            outcome: "completed".into(),
            killed: Some(Killed::OnItsWay),
            residual,
            is_open,
        };
        tally.take(1, Ok(verdict(0.25, false)));
        tally.take(2, Ok(verdict(7.0, true)));
        tally.take(3, Err("panicked".into()));
        let text = tally.text();
        for told in
            ["2 scenes passed, 1 failed", "completed               2  [1, 2]", "2 on their way", "2.50e-1", "[2]"]
        {
            assert!(text.contains(told), "{told}: {text}");
        }
    }
}
