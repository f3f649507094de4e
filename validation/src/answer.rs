//! The line that a known answer prints, and the comparison.
//!
//! Errors are relative to the reference, |measured − reference|/|reference|, and absolute where it is 0.

use std::fmt;

/// A number with a known value.
///
/// ```no_run
/// use gyration_validation::Answer;
/// Answer {
///     row: Some(13),
///     case: "bounce without loss, nu = 3",
///     quantity: "smallest gap [m]",
///     reference: 0.01,
///     measured: 0.01 * (1.0 + 1e-12),
///     tolerance: 1e-9,
///     source: "d_min² = αA/(m v²)",
/// }
/// .check();
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// The row in the list of known answers; none for a further case.
    pub row: Option<u32>,
    /// The problem, with the numbers that tell it from others.
    pub case: &'static str,
    /// What is measured, with its unit.
    pub quantity: &'static str,
    /// The known value.
    pub reference: f64,
    /// The value that the program gives.
    pub measured: f64,
    /// The largest error allowed, relative (absolute if the reference is 0).
    pub tolerance: f64,
    /// Where the reference comes from.
    pub source: &'static str,
}

impl Answer {
    /// The error, relative to the reference; absolute if that is 0.
    pub fn error(&self) -> f64 {
        let difference = (self.measured - self.reference).abs();
        if self.reference == 0.0 { difference } else { difference / self.reference.abs() }
    }

    /// Prints the line and returns the error.
    ///
    /// # Panics
    /// If the error is above the tolerance or not a number, or a text could not be read back from the line.
    pub fn check(&self) -> f64 {
        println!("validation: {self}");
        self.judged().unwrap_or_else(|fault| panic!("{fault}"))
    }

    /// The error, or what is wrong.
    fn judged(&self) -> Result<f64, String> {
        let texts = [self.case, self.quantity, self.source];
        if texts.iter().any(|text| text.contains(['"', '|', '\n'])) {
            return Err(format!("quote, bar or line break in {texts:?}"));
        }
        let error = self.error();
        if error <= self.tolerance { Ok(error) } else { Err(self.to_string()) }
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let row = self.row.map_or("–".to_owned(), |row| row.to_string());
        write!(
            f,
            "row={row} case=\"{}\" quantity=\"{}\" reference={} measured={} error={:.1e} tolerance={:.0e} \
                source=\"{}\"",
            self.case,
            self.quantity,
            digits(self.reference),
            digits(self.measured),
            self.error(),
            self.tolerance,
            self.source,
        )
    }
}

/// A problem of which several quantities are known.
///
/// ```no_run
/// use gyration_validation::Case;
/// let case = Case { row: Some(13), name: "bounce of one face, ν = 3", source: "d_min² = αA/(m v²)" };
/// case.check("smallest gap [m]", 0.01, 0.01 * (1.0 + 1e-12), 1e-9);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Case {
    /// The row in the list of known answers; none for a further case.
    pub row: Option<u32>,
    /// The problem, with the numbers that tell it from others.
    pub name: &'static str,
    /// Where the references come from.
    pub source: &'static str,
}

impl Case {
    /// The same problem with a reference from elsewhere.
    pub fn by(self, source: &'static str) -> Self {
        Self { source, ..self }
    }

    /// Prints the line of one quantity and returns its error.
    ///
    /// # Panics
    /// As [`Answer::check`].
    pub fn check(&self, quantity: &'static str, reference: f64, measured: f64, tolerance: f64) -> f64 {
        let Self { row, name: case, source } = *self;
        Answer { row, case, quantity, reference, measured, tolerance, source }.check()
    }
}

/// The largest magnitude; NaN if there is one, which `f64::max` would lose.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |largest: f64, value| match value.is_nan() || largest.is_nan() {
        true => f64::NAN,
        false => largest.max(value.abs()),
    })
}

/// Thirteen digits; nothing but the digit for 0.
fn digits(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.12e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    // Nothing here is printed: the table of known answers is made from what tests print.

    const ANSWER: Answer =
        Answer { row: Some(1), case: "a", quantity: "b", reference: 2.0, measured: 2.1, tolerance: 0.06, source: "c" };

    #[test]
    fn error_is_relative_unless_the_reference_is_zero() {
        assert!((ANSWER.judged().unwrap() - 0.05).abs() < 1e-15);
        assert_eq!(Answer { reference: 0.0, measured: -3.0, ..ANSWER }.error(), 3.0);
    }

    #[test]
    fn what_is_wrong_is_told() {
        for (answer, told) in [
            (Answer { tolerance: 0.04, ..ANSWER }, "error=5.0e-2"),
            (Answer { case: "a \"b\"", ..ANSWER }, "quote, bar or line break"),
            (Answer { measured: f64::NAN, ..ANSWER }, "measured=NaN"),
        ] {
            assert!(answer.judged().unwrap_err().contains(told), "{answer}");
        }
    }

    #[test]
    fn largest_keeps_what_is_not_a_number() {
        assert_eq!(largest([0.5, -2.0, 1.0]), 2.0);
        assert!(largest([f64::NAN, 1.0]).is_nan() && largest([1.0, f64::NAN]).is_nan());
    }
}
