//! What the runs of a row come to: the limit, its order and the verdict, and the line that the page is made from.

use super::{Published, Row, Verdict, rows};
use std::fmt;

/// Differences between runs below this part of the number are what steps and rounding leave, and have no order.
const ROUNDING: f64 = 1e-9;
/// The part of the tolerance below which it does not matter whether differences shrink.
const SMALL: f64 = 0.1;

/// What the program measured for a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Runs {
    /// One run, of a number that holds at any gap.
    Once(f64),
    /// Runs at d₀, d₀/2 and d₀/4.
    Halved([f64; 3]),
}

/// The measured numbers of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finding {
    /// The number at d₀, or that of the one run.
    pub whole: f64,
    /// The number at d₀/2.
    pub half: Option<f64>,
    /// The limit of small d₀; the number itself of one run.
    pub limit: f64,
    /// The order in d₀ with which the limit is reached.
    pub order: Order,
}

/// How the runs of a row approach their limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Order {
    /// As this power of d₀.
    Power(f64),
    /// They differ by what steps and rounding leave.
    Rounding,
    /// Their differences are far below the tolerance, and do not shrink in order.
    Unordered,
    /// There is one run.
    Single,
}

impl fmt::Display for Order {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Power(order) => write!(f, "{order:.2}"),
            Self::Rounding => f.write_str("rounding"),
            Self::Unordered => f.write_str("none"),
            Self::Single => f.write_str("–"),
        }
    }
}

impl Finding {
    /// The limit of the runs of a number of this size, which is asked for to this error.
    ///
    ///   p = log₂((x₁ − x₂)/(x₂ − x₃)),   x = x₃ + (x₃ − x₂)/(2^p − 1)
    ///
    /// # Errors
    /// The runs, if the differences do not shrink and are not far below that error: they have no limit.
    pub fn of(runs: Runs, size: f64, error: f64) -> Result<Self, String> {
        let [whole, half, quarter] = match runs {
            Runs::Once(value) => return Ok(Self { whole: value, half: None, limit: value, order: Order::Single }),
            Runs::Halved(values) => values,
        };
        let (first, second) = (whole - half, half - quarter);
        let settled = Self { whole, half: Some(half), limit: quarter, order: Order::Rounding };
        if second.abs() <= ROUNDING * size && first.is_finite() {
            return Ok(settled);
        }
        let ratio = first / second;
        if ratio > 1.0 {
            return Ok(Self { limit: quarter - second / (ratio - 1.0), order: Order::Power(ratio.log2()), ..settled });
        }
        let small = first.abs() <= SMALL * error && second.abs() <= SMALL * error;
        match small {
            true => Ok(Self { order: Order::Unordered, ..settled }),
            false => Err(format!("the runs {:?} do not settle", [whole, half, quarter])),
        }
    }
}

impl Row {
    /// Prints the line of a row that was run.
    ///
    /// # Panics
    /// If the row asks for no run, the runs have no limit, or the verdict is not the one expected.
    pub fn check(&self, runs: Runs) {
        let line = self.line(runs).unwrap_or_else(|fault| panic!("{}: {fault}", self.key));
        println!("published: {line}");
        assert!(line.is_expected(), "{line}");
    }

    fn line(&self, runs: Runs) -> Result<Line<'_>, String> {
        let Published::Number(published) = self.published else { panic!("{} has no number to compare", self.key) };
        let size = if published == 0.0 { 1.0 } else { published.abs() };
        let error = self.tolerance * size + self.reading;
        let finding = Finding::of(runs, size, error)?;
        let within = (finding.limit - published).abs() <= error;
        let found = if within { Verdict::Agrees } else { Verdict::Disagrees };
        Ok(Line { row: self, finding: Some(finding), found })
    }

    /// Prints the line of a row that asks for no run.
    ///
    /// # Panics
    /// If it asks for one.
    pub fn tell(&self) {
        let asks = matches!(self.expected, Verdict::Agrees | Verdict::Disagrees);
        assert!(!asks, "{} is to be run", self.key);
        println!("published: {}", Line { row: self, finding: None, found: self.expected });
    }
}

/// A row with what was found.
struct Line<'a> {
    row: &'a Row,
    finding: Option<Finding>,
    found: Verdict,
}

impl Line<'_> {
    fn is_expected(&self) -> bool {
        self.found == self.row.expected
    }
}

impl fmt::Display for Line<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (row, finding) = (self.row, self.finding);
        let nothing = || "–".to_owned();
        let published = match row.published {
            Published::Number(value) if row.reading > 0.0 => format!("{} ± {}", number(value), number(row.reading)),
            Published::Number(value) => number(value),
            Published::Words(words) => words.to_owned(),
        };
        let tolerance = if finding.is_some() { format!("{:.0e}", row.tolerance) } else { nothing() };
        let fields = [
            ("place", rows().position(|other| other.key == row.key).map_or_else(nothing, |place| place.to_string())),
            ("key", row.key.to_owned()),
            ("source", row.source.to_owned()),
            ("quantity", row.quantity.to_owned()),
            ("published", published),
            ("tolerance", tolerance),
            ("whole", finding.map_or_else(nothing, |it| number(it.whole))),
            ("half", finding.and_then(|it| it.half).map_or_else(nothing, number)),
            ("limit", finding.map_or_else(nothing, |it| number(it.limit))),
            ("order", finding.map_or_else(nothing, |it| it.order.to_string())),
            ("expected", row.expected.to_string()),
            ("found", self.found.to_string()),
            ("completed", row.completed.to_owned()),
            ("reason", row.reason.to_owned()),
        ];
        let fields = fields.map(|(name, value)| format!("{name}=\"{value}\""));
        f.write_str(&fields.join(" "))
    }
}

/// Ten digits; nothing but the digit for 0, and two digits of what is as small as rounding.
fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        return "0".to_owned();
    }
    if !(1e-4..1e6).contains(&size) {
        return if size < 1e-9 { format!("{value:.1e}") } else { format!("{value:.9e}") };
    }
    let decimals = (9.0 - size.log10().floor()).max(0.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    // Lines that are tried here are not printed: the page is made from what tests print.

    fn power(order: f64) -> Runs {
        Runs::Halved([1.0, 0.5, 0.25].map(|d0: f64| 2.0 + 0.1 * d0.powf(order)))
    }

    #[test]
    fn limit_and_order_of_a_power_are_exact() {
        for wanted in [0.5, 1.0, 1.2, 1.5, 3.0] {
            let Finding { limit, order, .. } = Finding::of(power(wanted), 2.0, 1e-6).unwrap();
            assert!((limit - 2.0).abs() < 1e-12, "{limit}");
            assert!(matches!(order, Order::Power(order) if (order - wanted).abs() < 1e-9), "{order:?}");
        }
    }

    #[test]
    fn runs_that_differ_by_rounding_have_no_order() {
        let found = Finding::of(Runs::Halved([3.0 + 1e-9, 3.0, 3.0 + 2e-9]), 3.0, 1e-6).unwrap();
        assert_eq!((found.limit, found.order), (3.0 + 2e-9, Order::Rounding));
        let found = Finding::of(Runs::Halved([1.0, 1.0 + 1e-8, 1.0]), 1.0, 1e-6).unwrap();
        assert_eq!((found.limit, found.order), (1.0, Order::Unordered));
    }

    #[test]
    fn runs_that_wander_or_are_no_numbers_have_no_limit() {
        for values in [[1.0, 1.1, 1.3], [f64::NAN, 1.0, 1.0]] {
            assert!(Finding::of(Runs::Halved(values), 1.0, 1e-6).unwrap_err().contains("do not settle"));
        }
    }

    #[test]
    fn numbers_are_short() {
        let found = [0.0, -10.0, 0.2741127020893, 7108.241279902, 1.8e-15, 2.5e-5, 0.9999999999999].map(number);
        assert_eq!(found, ["0", "-10", "0.2741127021", "7108.24128", "1.8e-15", "2.500000000e-5", "1"]);
    }

    const ROW: Row = Row {
        key: "try",
        source: "a",
        quantity: "b",
        published: Published::Number(2.0),
        reading: 0.0,
        tolerance: 1e-3,
        expected: Verdict::Agrees,
        completed: "",
        reason: "",
    };

    #[test]
    fn a_reading_widens_the_tolerance() {
        let found = |row: &Row| row.line(Runs::Once(2.01)).unwrap().found;
        assert_eq!([found(&ROW), found(&Row { reading: 0.01, ..ROW })], [Verdict::Disagrees, Verdict::Agrees]);
    }

    #[test]
    fn it_is_the_limit_that_is_compared() {
        assert!(ROW.line(power(1.0)).unwrap().is_expected());
        assert_eq!(ROW.line(Runs::Once(2.1)).unwrap().found, Verdict::Disagrees);
    }

    #[test]
    fn a_verdict_that_was_not_expected_is_told() {
        let line = ROW.line(Runs::Once(2.01)).unwrap();
        assert!(!line.is_expected() && line.to_string().contains("found=\"disagrees\""));
        let other = Row { expected: Verdict::Disagrees, ..ROW };
        let line = other.line(Runs::Once(2.0)).unwrap();
        assert!(!line.is_expected() && line.to_string().contains("found=\"agrees\""));
    }
}
