//! What everything took, at the end of a chore: each stage, and the slowest test programs.

use crate::child::Cost;
use std::fmt::Write as _;

/// How many of the slowest programs are told.
const SLOWEST: usize = 10;

/// Stages and programs with what they took.
#[derive(Debug, Default)]
pub struct TestReport {
    stages: Vec<(String, Cost)>,
    programs: Vec<(String, Cost)>,
}

impl TestReport {
    /// Notes a stage.
    pub fn stage(&mut self, title: &str, cost: Cost) {
        self.stages.push((title.to_owned(), cost));
    }

    /// Notes a test program; the stage that it belongs to is noted by itself.
    pub fn program(&mut self, title: &str, cost: Cost) {
        self.programs.push((title.to_owned(), cost));
    }

    /// Takes in what another lane noted.
    pub fn add(&mut self, other: Self) {
        self.stages.extend(other.stages);
        self.programs.extend(other.programs);
    }

    /// The two lists.
    pub fn text(&self) -> String {
        let mut text = String::new();
        let mut list = |title: &str, entries: &[(String, Cost)]| {
            if !entries.is_empty() {
                let _ = writeln!(text, "{title:<42} {:>8} {:>8}", "time", "CPU");
            }
            for (title, Cost { wall, cpu }) in entries {
                let _ = writeln!(text, "  {title:<40} {wall:>6.1} s {cpu:>6.1} s");
            }
        };
        list("stages", &self.stages);
        let mut slowest = self.programs.clone();
        slowest.sort_by(|(_, a), (_, b)| b.wall.total_cmp(&a.wall));
        slowest.truncate(SLOWEST);
        list("slowest test programs", &slowest);
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_come_in_their_order_and_programs_by_their_time() {
        let mut report = TestReport::default();
        for (title, wall) in [("format", 1.0), ("tests", 200.0)] {
            report.stage(title, Cost { wall, cpu: 2.0 * wall });
        }
        for number in 0..12 {
            report.program(&format!("crate-{number}"), Cost { wall: f64::from(number), cpu: 0.0 });
        }
        let text = report.text();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[2], "  tests                                     200.0 s  400.0 s");
        assert!(lines[4].contains("crate-11") && lines[13].contains("crate-2 "), "{text}");
        assert_eq!(lines.len(), 14);
    }
}
