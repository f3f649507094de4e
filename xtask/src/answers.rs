//! The table of known answers: read from test output, written to and compared with `docs/known-answers.md`.
//!
//! A test prints one line for each answer (`gyration_validation::Answer::check`):
//!
//!   validation: row=13 case="…" quantity="…" reference=… measured=… error=… tolerance=… source="…"
//!
//! The page shows them in order of row, case and quantity. Digits differ a little between machines, so that a test run
//! compares only which answers there are, not what was measured.

use std::collections::BTreeSet;

const FIELDS: [&str; 8] = ["row", "case", "quantity", "reference", "measured", "error", "tolerance", "source"];

/// One known answer, as printed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Answer {
    /// The values of `FIELDS`.
    values: [String; FIELDS.len()],
}

/// What tells answers apart: row, case, quantity.
type Key = [String; 3];

impl Answer {
    /// Reads `key=value` pairs, values quoted or not, in the order of `FIELDS`; none if one is missing.
    pub fn parse(text: &str) -> Option<Self> {
        fields(FIELDS, text).map(|values| Self { values })
    }

    fn key(&self) -> Key {
        let [row, case, quantity, ..] = &self.values;
        [row.clone(), case.clone(), quantity.clone()]
    }

    /// Orders by number of row, those without one last.
    fn rank(&self) -> (usize, Key) {
        (self.values[0].parse().unwrap_or(usize::MAX), self.key())
    }
}

/// The values of `key=value` pairs with these keys in this order, quoted or not; none if one is missing.
pub fn fields<const N: usize>(names: [&str; N], text: &str) -> Option<[String; N]> {
    let mut rest = text.trim();
    let mut values = [const { String::new() }; N];
    for (name, value) in names.iter().zip(&mut values) {
        rest = rest.strip_prefix(name)?.strip_prefix('=')?;
        let (found, after) = match rest.strip_prefix('"') {
            Some(quoted) => quoted.split_once('"')?,
            None => rest.split_once(' ').unwrap_or((rest, "")),
        };
        *value = found.to_owned();
        rest = after.trim_start();
    }
    rest.is_empty().then_some(values)
}

const PREAMBLE: &str = "\
# Known answers

Problems with a known answer, run by the tests: the reference, what this program measures, and the error. The error is
relative to the reference, or absolute where the reference is 0. Rows are those of the list of known answers; – marks
a further case. This page is written by `cargo xtask validate`; do not edit it by hand.

";

/// The page for these answers.
pub fn page(answers: &[Answer]) -> String {
    let mut sorted: Vec<&Answer> = answers.iter().collect();
    sorted.sort_by_key(|answer| answer.rank());
    let mut page = PREAMBLE.to_owned();
    page += &format!("| {} |\n", FIELDS.join(" | "));
    page += &format!("|{}\n", "---|".repeat(FIELDS.len()));
    for answer in sorted {
        page += &format!("| {} |\n", answer.values.join(" | "));
    }
    page
}

/// The answers that a page lists.
fn listed(page: &str) -> BTreeSet<Key> {
    let rows = page.lines().filter(|line| line.starts_with('|')).skip(2);
    let cells = |line: &str| {
        let mut cells = line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned());
        Some([cells.next()?, cells.next()?, cells.next()?])
    };
    rows.filter_map(cells).collect()
}

/// The differences between a page and the answers of a test run, in words; none if they list the same.
pub fn differences(page: &str, answers: &[Answer]) -> Vec<String> {
    let listed = listed(page);
    let printed: BTreeSet<Key> = answers.iter().map(Answer::key).collect();
    let missing = printed.difference(&listed).map(|key| format!("not on the page: {}", key.join(", ")));
    let stale = listed.difference(&printed).map(|key| format!("no longer printed: {}", key.join(", ")));
    let twice = (printed.len() < answers.len()).then(|| "two answers have the same names".to_owned());
    missing.chain(stale).chain(twice).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(row: &str, case: &str) -> Answer {
        let line = format!(
            "row={row} case=\"{case}\" quantity=\"d, gap\" reference=1e0 measured=1e0 error=0e0 tolerance=1e-9 \
             source=\"book, p. 3\""
        );
        Answer::parse(&line).unwrap()
    }

    #[test]
    fn a_page_lists_what_it_was_made_from() {
        let answers = [answer("13", "bounce, nu=3"), answer("3", "free body"), answer("–", "box")];
        let page = page(&answers);
        assert!(differences(&page, &answers).is_empty());
        let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| ")).skip(1).collect();
        assert!(rows[0].starts_with("| 3 ") && rows[1].starts_with("| 13 ") && rows[2].starts_with("| – "));
    }

    #[test]
    fn new_stale_and_doubled_answers_are_differences() {
        let page = page(&[answer("3", "old")]);
        assert_eq!(differences(&page, &[answer("3", "new")]).len(), 2);
        assert_eq!(differences(&page, &[answer("3", "old"), answer("3", "old")]).len(), 1);
    }

    #[test]
    fn a_line_with_a_missing_field_is_not_an_answer() {
        assert_eq!(Answer::parse("row=3 case=\"a\" quantity=\"b\" reference=1"), None);
    }
}
