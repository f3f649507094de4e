//! A row of `gyration bench`.

use serde::Serialize;

/// How much is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Size {
    /// A few seconds: smaller crowds, fewer throws.
    Quick,
    /// A minute or two.
    Whole,
}

/// The least time of a piece of work.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Floor {
    /// \[s\].
    pub seconds: f64,
    /// What takes it.
    pub of: String,
}

/// A piece of work, and how long it takes on one thread unless it says otherwise.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BenchmarkRow {
    /// A name for programs, as `rates/box`.
    pub key: String,
    /// What is done, in words.
    pub work: String,
    /// Of a processor \[s\]; of a clock on the wall where several threads work.
    pub seconds: f64,
    /// The least that it can take, where one is known.
    pub floor: Option<Floor>,
    /// What it took besides time, and how good the answer is.
    pub remark: String,
}

impl BenchmarkRow {
    /// How many times its floor it takes.
    pub fn ratio(&self) -> Option<f64> {
        self.floor.as_ref().map(|floor| self.seconds / floor.seconds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_without_a_floor_has_no_ratio() {
        let row = |floor| BenchmarkRow {
            key: "throw".into(),
            work: "a throw".into(),
            seconds: 3.0,
            floor,
            remark: String::new(),
        };
        assert_eq!(row(None).ratio(), None);
        assert_eq!(row(Some(Floor { seconds: 1.5, of: "calls".into() })).ratio(), Some(2.0));
    }
}
