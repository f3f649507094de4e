//! Counts of a campaign.

use super::trial::{Stops, Verdict};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The most scenes of an outcome whose numbers are told: they are the rare ones, worth a look.
const FEW: usize = 12;

/// What the scenes came to.
#[derive(Debug, Default)]
pub struct CampaignTally {
    outcomes: BTreeMap<String, Vec<u64>>,
    stops: Stops,
    /// Steps after which a run was resumed and stepped on.
    steps: f64,
    /// The largest difference of a force by planes found anew, and whose it is.
    planes: (f64, u64),
    /// The largest change of a momentum and an angular momentum of what is alone, and whose they are.
    changes: [(f64, u64); 2],
    /// How many were alone.
    alone: usize,
    /// How far runs with bodies exchanged came, over rtol times the size.
    exchanged: Vec<(f64, u64)>,
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
                let Stops { killed, interrupted, early, late } = verdict.stops;
                self.stops.killed += killed;
                self.stops.interrupted += interrupted;
                self.stops.early += early;
                self.stops.late += late;
                self.steps += verdict.steps.count;
                raise(&mut self.planes, verdict.steps.planes, case);
                self.alone += usize::from(verdict.steps.changes.is_some());
                for (most, change) in self.changes.iter_mut().zip(verdict.steps.changes.unwrap_or_default()) {
                    raise(most, change, case);
                }
                self.exchanged.extend(verdict.exchanged.map(|off| (off, case)));
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
        let Stops { killed, interrupted, early, late } = self.stops;
        let _ = write!(
            text,
            "\nstopped and resumed: {killed} times killed, {interrupted} times interrupted; {early} times before there \
             was a recording, {late} times when all was done\n{} steps resumed to the same bytes",
            self.steps
        );
        for (what, (most, case)) in [
            ("difference of a force by planes found anew, over the largest force", self.planes),
            ("change of the momentum of bodies alone", self.changes[0]),
            ("change of their angular momentum", self.changes[1]),
        ] {
            let _ = write!(text, "\nlargest {what}: {most:.1e} (scene {case})");
        }
        let _ = write!(text, ", of {}", self.alone);
        let mut exchanged = self.exchanged.clone();
        exchanged.sort_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((most, case)) = exchanged.last() {
            let (median, _) = exchanged[exchanged.len() / 2];
            let _ = write!(
                text,
                "\nwith bodies exchanged and renamed, over rtol times the size: median {median:.1e}, most {most:.1e} \
                 (scene {case}), of {}",
                exchanged.len()
            );
        }
        let (worst, case) = self.worst;
        let _ = write!(text, "\nworst residual of a closed ledger: {worst:.2e} of what is allowed (scene {case})");
        if !self.open.is_empty() {
            let _ = write!(text, "\nopen ledgers, told by warning and exit code: {:?}", in_order(&self.open));
        }
        text
    }
}

/// Keeps the larger of two numbers, and whose it is.
fn raise(most: &mut (f64, u64), number: f64, case: u64) {
    if number > most.0 {
        *most = (number, case);
    }
}

fn in_order(cases: &[u64]) -> Vec<u64> {
    let mut cases = cases.to_vec();
    cases.sort_unstable();
    cases
}

#[cfg(test)]
mod tests {
    use super::super::first_steps::Shown;
    use super::*;

    #[test]
    fn scenes_are_counted_by_outcome() {
        let mut tally = CampaignTally::default();
        let verdict = |residual, is_open| Verdict {
            outcome: "completed".into(),
            stops: Stops { killed: 1, interrupted: 2, ..Stops::default() },
            residual,
            is_open,
            steps: Shown { count: 25.0, planes: 1e-12, changes: Some([1e-16, 1e-9]) },
            exchanged: Some(0.5),
        };
        tally.take(1, Ok(verdict(0.25, false)));
        tally.take(2, Ok(verdict(7.0, true)));
        tally.take(3, Err("panicked".into()));
        let text = tally.text();
        for told in [
            "2 scenes passed, 1 failed",
            "completed               2  [1, 2]",
            "2 times killed, 4 times",
            "50 steps",
            "2.50e-1",
            "[2]",
        ] {
            assert!(text.contains(told), "{told}: {text}");
        }
    }
}
