//! The tests that the field shares: read from test output, written to and compared with `docs/published.md`.
//!
//! A test prints one line for each published number (`gyration_validation::published`):
//!
//!   published: place="…" key="…" source="…" quantity="…" published="…" tolerance="…" whole="…" half="…" limit="…"
//!     order="…" expected="…" found="…" completed="…" reason="…"
//!
//! The page shows them in the order of their places, and below the table what was completed and why a verdict is not
//! `agrees`. As with known answers, a test run compares which rows there are, here with their verdicts, not digits.

use crate::answers::fields;
use std::collections::BTreeSet;

const FIELDS: [&str; 14] = [
    "place",
    "key",
    "source",
    "quantity",
    "published",
    "tolerance",
    "whole",
    "half",
    "limit",
    "order",
    "expected",
    "found",
    "completed",
    "reason",
];

/// The heads of the columns, those of the fields from `key` to `found`.
const COLUMNS: &str =
    "| row | source | quantity | published | tolerance | at d₀ | at d₀/2 | limit | order | expected | found |\n";

/// One published number with what was found, as printed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The values of `FIELDS`.
    values: [String; FIELDS.len()],
}

/// What the page and a test run must have alike: key and both verdicts.
type Key = [String; 3];

impl Finding {
    /// Reads `key="value"` pairs in the order of `FIELDS`; none if one is missing.
    pub fn parse(text: &str) -> Option<Self> {
        fields(FIELDS, text).map(|values| Self { values })
    }

    fn key(&self) -> Key {
        [1, 10, 11].map(|field| self.values[field].clone())
    }

    /// Orders by place, then by name.
    fn rank(&self) -> (usize, Key) {
        (self.values[0].parse().unwrap_or(usize::MAX), self.key())
    }

    /// The cells of its row.
    fn cells(&self) -> &[String] {
        &self.values[1..12]
    }

    /// What stands below the table; none if there is nothing to say.
    fn note(&self) -> Option<String> {
        let said: Vec<&str> = self.values[12..].iter().map(String::as_str).filter(|text| !text.is_empty()).collect();
        (!said.is_empty()).then(|| said.join(" "))
    }
}

const PREAMBLE: &str = "\
# The tests that the field shares

Numbers that other codes and laboratories publish, run here by the tests. Source, tolerance and verdict of a row were
written down before its first run, and a row that was changed by it says so; a verdict that is not the one expected
fails the tests, in either direction. This page is written by `cargo xtask validate`; do not edit it by hand.

- *agrees*: the number found is the published one within the tolerance, which is relative, or absolute where the
  published number is 0. A value read off a figure has its own error beside it.
- *disagrees*: the problem exists here and comes out otherwise; the reason stands below the table.
- *outside the model*: no law of this program makes it; the reason stands below, too. *Not run* is what could be.

Bodies of other codes are hard. Here they keep a gap, and hardness is a limit: such a row is run at d₀, at d₀/2 and at
d₀/4 with all else alike, and its claim is the limit x₃ + (x₃ − x₂)/(2^p − 1), with the order p = log₂((x₁ − x₂)/(x₂ −
x₃)) that the three runs show. What the gap does to a ball at rest goes as d₀^1.2, since so does the gap, and as d₀^1.5
in an impact. The limit is the last run where the order is *rounding*, as the runs differ by less than 1e-9, or *none*,
as they differ by less than a tenth of the tolerance and in no order. – marks what holds at any gap and was run once.

Problems whose answer is a closed form or an independent computation are among the [known answers](known-answers.md).
Five small ones can be put to any engine: [check any simulator](check-any-simulator.md).

";

const NOTES: &str = "
## What was completed, and why a row does not agree

What a source leaves open was chosen here. Verdicts other than *agrees* have their reason behind it.

";

/// The page for these findings.
pub fn page(findings: &[Finding]) -> String {
    let mut sorted: Vec<&Finding> = findings.iter().collect();
    sorted.sort_by_key(|finding| finding.rank());
    let mut page = PREAMBLE.to_owned() + COLUMNS;
    page += &format!("|{}\n", "---|".repeat(sorted.first().map_or(11, |finding| finding.cells().len())));
    for finding in &sorted {
        page += &format!("| {} |\n", finding.cells().join(" | "));
    }
    page += NOTES;
    let mut noted: Vec<(String, Vec<String>)> = Vec::new();
    for finding in &sorted {
        let Some(note) = finding.note() else { continue };
        let name = format!("`{}`", finding.values[1]);
        match noted.iter_mut().find(|(text, _)| *text == note) {
            Some((_, names)) => names.push(name),
            None => noted.push((note, vec![name])),
        }
    }
    for (text, names) in noted {
        page += &item(&format!("{}: {text}", names.join(", ")));
    }
    page
}

/// An item of a list, its words in lines of at most 120 columns.
fn item(text: &str) -> String {
    let (mut item, mut width) = ("-".to_owned(), 1);
    for word in text.split_whitespace() {
        let wide = word.chars().count();
        if width + 1 + wide > 120 {
            item += "\n ";
            width = 1;
        }
        item += " ";
        item += word;
        width += 1 + wide;
    }
    item + "\n"
}

/// The rows that a page lists.
fn listed(page: &str) -> BTreeSet<Key> {
    let rows = page.lines().filter(|line| line.starts_with('|')).skip(2);
    let cells = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [key, .., expected, found] = cells.as_slice() else { return None };
        Some([key, expected, found].map(|cell| (*cell).to_owned()))
    };
    rows.filter_map(cells).collect()
}

/// The differences between a page and the findings of a test run, in words; none if they list the same.
pub fn differences(page: &str, findings: &[Finding]) -> Vec<String> {
    let listed = listed(page);
    let printed: BTreeSet<Key> = findings.iter().map(Finding::key).collect();
    let missing = printed.difference(&listed).map(|key| format!("not on the page: {}", key.join(", ")));
    let stale = listed.difference(&printed).map(|key| format!("no longer printed: {}", key.join(", ")));
    let twice = (printed.len() < findings.len()).then(|| "two rows have the same name".to_owned());
    missing.chain(stale).chain(twice).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row whose place is that of its key's first letter.
    fn finding(key: &str, found: &str, reason: &str) -> Finding {
        let line = format!(
            "place=\"{}\" key=\"{key}\" \
             source=\"someone, 2011\" quantity=\"speed [m/s]\" published=\"1\" tolerance=\"1e-6\" \
             whole=\"1.1\" half=\"1.05\" limit=\"1\" order=\"1.00\" expected=\"agrees\" found=\"{found}\" \
             completed=\"a ball\" reason=\"{reason}\"",
            key.as_bytes()[0]
        );
        Finding::parse(&line).unwrap()
    }

    #[test]
    fn a_page_lists_what_it_was_made_from_and_notes_that_are_alike_once() {
        let findings = [finding("b", "agrees", ""), finding("a", "agrees", ""), finding("c", "disagrees", "no law")];
        let page = page(&findings);
        assert!(differences(&page, &findings).is_empty());
        assert!(page.ends_with("- `a`, `b`: a ball\n- `c`: a ball no law\n"), "{page}");
        let rows: Vec<&str> = page.lines().filter(|line| line.starts_with('|')).collect();
        assert!(rows.iter().all(|row| row.matches('|').count() == 12), "{rows:?}");
    }

    #[test]
    fn another_verdict_a_new_row_and_a_doubled_one_are_differences() {
        let page = page(&[finding("a", "agrees", "")]);
        assert_eq!(differences(&page, &[finding("a", "disagrees", "")]).len(), 2);
        assert_eq!(differences(&page, &[finding("a", "agrees", ""), finding("b", "agrees", "")]).len(), 1);
        assert_eq!(differences(&page, &[finding("a", "agrees", ""), finding("a", "agrees", "")]).len(), 1);
    }

    #[test]
    fn items_are_filled() {
        let text = item(&"word ".repeat(60));
        let widths: Vec<usize> = text.lines().map(|line| line.chars().count()).collect();
        assert!(widths.len() == 3 && widths[0] > 115 && widths.iter().all(|width| *width <= 120), "{widths:?}");
    }

    #[test]
    fn the_text_before_the_table_is_filled() {
        assert!((PREAMBLE.to_owned() + NOTES).lines().all(|line| line.chars().count() <= 120));
    }
}
