//! What `run --json` says of a run, and whether exit code, warning and recording agree with it.

use super::process::Said;
use super::table::Table;
use crate::json::Json;
use std::path::Path;

/// The exit code of a run that has come to its end with an open ledger.
const OPEN: i32 = 4;

/// A run that has ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// `completed`, `at_rest`, or the reason of a stop.
    pub outcome: String,
    /// The largest residual over what the tolerances let pass.
    pub residual: f64,
    /// Whether the ledger is open, and the program says so.
    pub is_open: bool,
}

impl Report {
    /// Reads what a run said; what is wrong with it otherwise.
    pub fn of(said: &Said) -> Result<Self, String> {
        let first = || said.stderr.lines().next().unwrap_or_default();
        let is_no_report = || format!("--json prints no JSON; exit code {:?}: {}", said.code, first());
        let report = Json::parse(&said.stdout).ok_or_else(is_no_report)?;
        let outcome = outcome(report.get("outcome").ok_or("--json has no outcome")?).ok_or("an outcome of no kind")?;
        let ledger = report.get("ledger").ok_or("--json has no ledger")?;
        let number =
            |key: &str| ledger.get(key).and_then(Json::number).ok_or_else(|| format!("the ledger has no {key}"));
        let (largest, allowed) = (number("largest_residual")?, number("allowed_residual")?);
        let is_open = ledger.get("verdict").and_then(Json::text) == Some("open");
        if is_open != (largest > allowed) {
            return Err(format!(
                "a residual of {largest:e} J, {allowed:e} J allowed, and the ledger is open: {is_open}"
            ));
        }
        if is_open != said.stderr.contains("the energy balance is open") {
            return Err(format!("the ledger is open: {is_open}, which stderr tells otherwise"));
        }
        let in_play = number("energy_in_play")?;
        let expected = match outcome.as_str() {
            "completed" | "at_rest" if is_open => OPEN,
            "completed" | "at_rest" => 0,
            _ => 1,
        };
        if said.code != Some(expected) {
            return Err(format!(
                "{outcome} with a residual of {:e} of the energy in play exits with {:?}",
                largest / in_play,
                said.code
            ));
        }
        // A run that rests from the start has nothing in play.
        Ok(Self { outcome, residual: if allowed > 0.0 { largest / allowed } else { 0.0 }, is_open })
    }

    /// Whether there is nothing to resume.
    pub fn is_final(&self) -> bool {
        self.outcome != "wall_time"
    }

    /// What does not hold between the report, the rows and the attributes of the recording.
    pub fn audit(&self, said: &Said, table: &Table, recording: &Path, end: f64) -> Result<(), String> {
        table.audit()?;
        let report = Json::parse(&said.stdout).ok_or("no JSON")?;
        let told = |key: &str| report.get("ledger").and_then(|ledger| ledger.get(key)).and_then(Json::number);
        let largest = table.largest_residual();
        // A run that is given up within a step knows samples that have not come to the disk.
        let agrees = |told: f64| told == largest || (told > largest && !self.is_final());
        if !told("largest_residual").is_some_and(agrees) {
            return Err(format!("the rows have a residual of {largest:e} J, --json another"));
        }
        // Steps need not end where a row sees most in play, but they resolve the motion.
        if told("energy_in_play").is_none_or(|told| told < 0.5 * table.in_play()) {
            return Err(format!("the rows have {:e} J in play, --json not half of it", table.in_play()));
        }
        if self.outcome == "completed" && table.end() != end {
            return Err(format!("completed at t = {:?}, not at {end:?}", table.end()));
        }
        if !self.is_final() {
            return Ok(());
        }
        let text = std::fs::read_to_string(recording.join("zarr.json")).map_err(|error| error.to_string())?;
        let group = Json::parse(&text).ok_or("zarr.json is no JSON")?;
        let attribute = |key: &str| group.get("attributes").and_then(|attributes| attributes.get(key));
        let verdict = attribute("ledger").and_then(Json::text);
        if verdict != Some(if self.is_open { "open" } else { "closed" }) {
            return Err(format!("the recording calls its ledger {verdict:?}, --json otherwise"));
        }
        let recorded = attribute("outcome").and_then(outcome);
        if recorded.as_ref() != Some(&self.outcome) {
            return Err(format!("the recording has outcome {recorded:?}, --json {}", self.outcome));
        }
        Ok(())
    }
}

/// The outcome in a word: `"completed"`, `{"at_rest": …}`, `{"stopped": {"reason": …}}`.
fn outcome(value: &Json) -> Option<String> {
    if let Some(text) = value.text() {
        return Some(text.to_owned());
    }
    if value.get("at_rest").is_some() {
        return Some("at_rest".into());
    }
    value.get("stopped")?.get("reason")?.text().map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    fn said(outcome: &str, residual: f64, verdict: &str, code: i32, warned: bool) -> Said {
        let stdout = format!(
            r#"{{"outcome": {outcome}, "ledger": {{"largest_residual": {residual}, "allowed_residual": 0.001,
            "energy_in_play": 1.0, "verdict": "{verdict}"}}}}"#
        );
        let stderr = if warned { "warning: the energy balance is open: it misses" } else { "" }.to_owned();
        Said { code: Some(code), stdout, stderr, wall: Duration::ZERO }
    }

    const STOPPED: &str = r#"{"stopped": {"reason": "gap_closed"}}"#;

    #[test]
    fn reports_that_agree_with_themselves_pass() {
        let outcome = |said: &Said| Report::of(said).unwrap().outcome;
        assert_eq!(outcome(&said("\"completed\"", 1e-4, "closed", 0, false)), "completed");
        assert_eq!(outcome(&said(r#"{"at_rest": {"time": 1.0}}"#, 0.005, "open", 4, true)), "at_rest");
        assert_eq!(outcome(&said("\"completed\"", 0.02, "open", 4, true)), "completed");
        assert_eq!(outcome(&said(STOPPED, 1e-4, "closed", 1, false)), "gap_closed");
    }

    #[test]
    fn a_completed_run_that_lost_energy_without_a_word_is_a_failure() {
        for (said, told) in [
            (said("\"completed\"", 0.02, "closed", 1, true), "J allowed"),
            (said("\"completed\"", 0.02, "open", 1, false), "stderr"),
            (said("\"completed\"", 0.02, "open", 0, true), "exits with"),
            (said("\"completed\"", 0.02, "open", 1, true), "exits with"),
            (said(STOPPED, 1e-4, "closed", 0, false), "exits with"),
            (said("{}", 1e-4, "closed", 0, false), "no kind"),
        ] {
            assert!(Report::of(&said).unwrap_err().contains(told), "{said:?}");
        }
    }
}
