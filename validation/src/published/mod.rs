//! The tests that the field shares: what other codes and laboratories publish, one row a number.
//!
//! Tolerance and verdict of a row stand here before its first run, with the source and what of the set-up had to be
//! completed. A row whose verdict is another than the one written down fails, in either direction. Bodies of other
//! codes are hard, and here that is a limit of small gaps: such a row is run at d₀, d₀/2 and d₀/4, and its claim is the
//! limit. `cargo xtask validate` makes `docs/published.md` of the lines that the runs print:
//!
//!   published: place="…" key="…" source="…" quantity="…" published="…" … reason="…"
//!
//! Nothing here runs a scene; the runs stand beside the tests.

mod chung_ooi;
mod crowds;
mod finding;
mod granular;
mod more;
#[cfg(test)]
mod runs;

pub use finding::{Finding, Order, Runs};
use std::fmt;

/// What is said of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Within the tolerance.
    Agrees,
    /// The problem exists here and comes out otherwise.
    Disagrees,
    /// No law here makes it.
    Outside,
    /// It could be run and is not, for the reason given.
    NotRun,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Agrees => "agrees",
            Self::Disagrees => "disagrees",
            Self::Outside => "outside the model",
            Self::NotRun => "not run",
        })
    }
}

/// What a source gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Published {
    /// A number in the unit of the quantity.
    Number(f64),
    /// A formula or a finding of which no number is asked.
    Words(&'static str),
}

/// A published number, as it is declared before it is run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// What tells it from the others.
    pub key: &'static str,
    /// Author, journal and year, or the code; with the closed form.
    pub source: &'static str,
    /// What is measured, with its unit.
    pub quantity: &'static str,
    /// What the source gives.
    pub published: Published,
    /// By how much a value read off a figure may be off, in the unit of the quantity; 0 for closed forms.
    pub reading: f64,
    /// The largest error allowed, relative (absolute if the published number is 0).
    pub tolerance: f64,
    /// The verdict that the row must come to.
    pub expected: Verdict,
    /// What the source leaves open and was chosen here.
    pub completed: &'static str,
    /// The cause of a verdict that is not [`Verdict::Agrees`].
    pub reason: &'static str,
}

/// All rows, in the order of the table.
pub fn rows() -> impl Iterator<Item = &'static Row> {
    [chung_ooi::ROWS, granular::ROWS, more::ROWS, crowds::ROWS].into_iter().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn rows_have_names_of_their_own_and_texts_that_a_line_can_hold() {
        let mut keys = BTreeSet::new();
        for row in rows() {
            assert!(keys.insert(row.key), "{} stands twice", row.key);
            let texts = [row.key, row.source, row.quantity, row.completed, row.reason];
            assert!(!texts.iter().any(|text| text.contains(['"', '|', '\n'])), "quote, bar or line break in {texts:?}");
            assert!(texts[..3].iter().all(|text| !text.is_empty()), "{row:?}");
        }
        assert!(keys.len() > 50, "{} rows", keys.len());
    }

    #[test]
    fn what_does_not_agree_has_a_reason_and_what_is_compared_a_number() {
        for row in rows() {
            assert_eq!(row.reason.is_empty(), row.expected == Verdict::Agrees, "{row:?}");
            let compared = matches!(row.expected, Verdict::Agrees | Verdict::Disagrees);
            assert_eq!(matches!(row.published, Published::Number(_)), compared, "{row:?}");
            assert_eq!(row.tolerance > 0.0, compared, "{row:?}");
        }
    }
}
