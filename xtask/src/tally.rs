//! What test programs say about themselves, read from the lines that they print.
//!
//!   test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.05s
//!   Tests  1 failed | 11 passed | 2 skipped (14)               of the viewer
//!   test name ... FAILED                                       ` FAIL  file > name` of the viewer
//!   validation: row=13 case="…" …
//!   published: key="…" source="…" …

use crate::answers::Answer;
use crate::published::Finding;

/// Sums over test programs, and the known answers and published numbers that they printed.
#[derive(Debug, Default)]
pub struct Tally {
    /// Tests that passed.
    pub passed: usize,
    /// Tests that failed, and steps that failed without a test saying so.
    pub failed: usize,
    /// Tests that were not run.
    pub ignored: usize,
    /// The names of those that failed, as far as they are told.
    pub names: Vec<String>,
    /// Known answers, in the order of printing.
    pub answers: Vec<Answer>,
    /// Published numbers, in the order of printing.
    pub findings: Vec<Finding>,
    /// Lines that began as a known answer or a published number and could not be read.
    pub unreadable: Vec<String>,
}

impl Tally {
    /// Takes in one line of output.
    pub fn read(&mut self, line: &str) {
        if let Some(result) = line.strip_prefix("test result: ") {
            self.passed += count(result, "passed");
            self.failed += count(result, "failed");
            self.ignored += count(result, "ignored");
        } else if let Some(name) = failure(line) {
            self.names.push(name.to_owned());
        } else if let Some(result) = line.trim_start().strip_prefix("Tests  ") {
            self.passed += count(result, "passed");
            self.failed += count(result, "failed");
            self.ignored += count(result, "skipped");
        } else if let Some(text) = line.strip_prefix("validation: ") {
            match Answer::parse(text) {
                Some(answer) => self.answers.push(answer),
                None => self.unreadable.push(line.to_owned()),
            }
        } else if let Some(text) = line.strip_prefix("published: ") {
            match Finding::parse(text) {
                Some(finding) => self.findings.push(finding),
                None => self.unreadable.push(line.to_owned()),
            }
        }
    }

    /// Adds another tally to this one.
    pub fn add(&mut self, other: Self) {
        self.passed += other.passed;
        self.failed += other.failed;
        self.ignored += other.ignored;
        self.names.extend(other.names);
        self.answers.extend(other.answers);
        self.findings.extend(other.findings);
        self.unreadable.extend(other.unreadable);
    }
}

/// The name of a test that failed: `test name ... FAILED`, `FAILED file::name - why` of Python, ` FAIL  file > name` of
/// the viewer.
fn failure(line: &str) -> Option<&str> {
    let of_rust = line.strip_prefix("test ").and_then(|rest| rest.strip_suffix(" ... FAILED"));
    let of_python = || line.strip_prefix("FAILED ").and_then(|rest| rest.split(" - ").next());
    of_rust.or_else(of_python).or_else(|| line.trim_start().strip_prefix("FAIL  ")).map(str::trim)
}

/// The number before `word` in "ok. 12 passed; 0 failed; …" or "12 passed | 2 skipped (14)".
fn count(result: &str, word: &str) -> usize {
    let fields = result.split([';', '.', '|', '(']).map(str::trim);
    let field = fields.into_iter().find(|field| field.ends_with(word));
    field.and_then(|field| field.split(' ').next()).and_then(|n| n.parse().ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_of_the_viewer_are_read() {
        let mut tally = Tally::default();
        tally.read(" Test Files  1 failed | 2 passed (3)");
        tally.read("      Tests  1 failed | 11 passed | 2 skipped (14)");
        tally.read("      Tests  5 passed (5)");
        assert_eq!((tally.passed, tally.failed, tally.ignored), (16, 1, 2));
    }

    #[test]
    fn results_of_all_programs_are_summed() {
        let mut tally = Tally::default();
        tally.read("test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 7 filtered out; finished in 0.05s");
        tally.read("test result: FAILED. 3 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out");
        tally.read("test some_test ... ok");
        assert_eq!((tally.passed, tally.failed, tally.ignored), (15, 2, 1));
    }

    #[test]
    fn tests_that_failed_are_named() {
        let mut tally = Tally::default();
        for line in ["test a::b ... FAILED", "test c ... ok", " FAIL  |unit| tests/x.test.ts > y > z "] {
            tally.read(line);
        }
        tally.read("FAILED tests/test_x.py::test_y[z] - AssertionError");
        assert_eq!(tally.names, ["a::b", "|unit| tests/x.test.ts > y > z", "tests/test_x.py::test_y[z]"]);
    }

    #[test]
    fn a_damaged_line_is_kept_for_complaint() {
        let mut tally = Tally::default();
        tally.read("validation: row=3 case=\"x\" quantity=\"y\"");
        tally.read("published: key=\"x\" source=\"y\"");
        assert!(tally.answers.is_empty() && tally.findings.is_empty());
        assert_eq!(tally.unreadable.len(), 2);
    }
}
