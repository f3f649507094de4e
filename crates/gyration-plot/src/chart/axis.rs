//! Axes: what is measured along a side of a chart, over which range, and where a value stands.
//!
//!   linear (v − low)/(high − low);   logarithmic ln(v/low)/ln(high/low)
//!
//! The words of a linear axis use a prefix of the unit (mm, kN) so that they stay short.

use super::ticks::{self, Tick};

/// How values are spread over an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisScale {
    /// Evenly.
    Linear,
    /// By their logarithms.
    Logarithmic,
}

/// One axis of a chart; values are in the unit without prefix.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What is measured.
    pub name: String,
    /// Its unit; empty for a pure number.
    pub unit: String,
    /// How values are spread.
    pub scale: AxisScale,
    /// The value at the beginning; > 0 on a logarithmic axis.
    pub low: f64,
    /// The value at the end; > `low`.
    pub high: f64,
    /// Names of the values 0, 1, 2, …; empty for an axis of numbers.
    pub words: Vec<String>,
    /// Values that have names, the only ones with ticks; empty for an axis of numbers.
    pub places: Vec<(f64, String)>,
}

/// The smallest and the largest of the finite values, if there is one.
pub fn extremes(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let finite = values.into_iter().filter(|value| value.is_finite());
    finite.fold(None, |range, value| match range {
        None => Some((value, value)),
        Some((low, high)) => Some((f64::min(low, value), f64::max(high, value))),
    })
}

/// A unit with its powers raised: `m/s^2` as `Label::new` reads it.
pub fn raised(unit: &str) -> String {
    let mut words = String::new();
    let mut parts = unit.split('^');
    words += parts.next().unwrap_or_default();
    for part in parts {
        let end = part.find(|c: char| !(c.is_ascii_digit() || c == '-')).unwrap_or(part.len());
        let (power, rest) = part.split_at(end);
        words += &format!("^{{{power}}}{rest}");
    }
    words
}

impl Axis {
    /// An axis from `low` to `high` without any margin.
    pub fn exact(name: &str, unit: &str, low: f64, high: f64) -> Self {
        let high = if high > low { high } else { low + low.abs().max(1.0) };
        Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            scale: AxisScale::Linear,
            low,
            high,
            words: Vec::new(),
            places: Vec::new(),
        }
    }

    /// An axis on which names stand one beside the other.
    pub fn of_words(name: &str, words: Vec<String>) -> Self {
        let high = words.len().max(1) as f64 - 0.5;
        Self { words, ..Self::exact(name, "", -0.5, high) }
    }

    /// A linear axis that holds the values, with a margin of a twentieth.
    pub fn linear(name: &str, unit: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = extremes(values).unwrap_or((0.0, 1.0));
        // Values that differ by rounding alone are drawn as one line, not as noise over the whole height.
        let least = 1e-9 * low.abs().max(high.abs());
        let span = if high - low > least { high - low } else { low.abs().max(f64::MIN_POSITIVE * 1e16) };
        let span = if low == 0.0 && high == 0.0 { 1.0 } else { span };
        let margin = 0.05 * span;
        let (low, high) = if high - low > least { (low, high) } else { (low - span / 2.0, high + span / 2.0) };
        Self::exact(name, unit, low - margin, high + margin)
    }

    /// A logarithmic axis that holds the values that are > 0, with a margin of a twentieth.
    pub fn logarithmic(name: &str, unit: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let positive = values.into_iter().filter(|value| *value > 0.0);
        let (low, high) = extremes(positive).unwrap_or((0.1, 10.0));
        let margin = libm::pow(high / low, 0.05).max(1.1);
        let (low, high) = (low / margin, high * margin);
        Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            scale: AxisScale::Logarithmic,
            low,
            high,
            words: Vec::new(),
            places: Vec::new(),
        }
    }

    /// Where a value stands: 0 at the beginning, 1 at the end.
    pub fn place(&self, value: f64) -> f64 {
        match self.scale {
            AxisScale::Linear => (value - self.low) / (self.high - self.low),
            AxisScale::Logarithmic => libm::log(value / self.low) / libm::log(self.high / self.low),
        }
    }

    /// The factor and the prefix by which words are given.
    fn prefix(&self) -> (f64, &'static str) {
        let largest = self.low.abs().max(self.high.abs());
        let plain = (0.1..1000.0).contains(&largest);
        let simple = !self.unit.is_empty() && self.unit.chars().all(char::is_alphabetic);
        if plain || !simple || self.scale == AxisScale::Logarithmic { (1.0, "") } else { ticks::prefix(largest) }
    }

    /// What stands beside the axis: name and unit.
    pub fn label(&self) -> String {
        if self.unit.is_empty() {
            return self.name.clone();
        }
        format!("{} [{}{}]", self.name, self.prefix().1, raised(&self.unit))
    }

    /// At most about `count` ticks with words.
    pub fn ticks(&self, count: usize) -> Vec<Tick> {
        if !self.words.is_empty() {
            let tick = |(k, word): (usize, &String)| Tick { value: k as f64, label: Some(word.clone()) };
            return self.words.iter().enumerate().map(tick).collect();
        }
        if !self.places.is_empty() {
            let tick = |(value, name): &(f64, String)| Tick { value: *value, label: Some(name.clone()) };
            return self.places.iter().map(tick).collect();
        }
        match self.scale {
            AxisScale::Logarithmic => ticks::logarithmic(self.low, self.high, count),
            AxisScale::Linear => {
                let factor = self.prefix().0;
                let with = |count: usize| ticks::linear(factor * self.low, factor * self.high, count);
                // One tick alone tells no scale.
                let enough = (count..2 * count + 4).map(with).find(|ticks| ticks.len() > 1);
                let mut ticks = enough.unwrap_or_else(|| with(count));
                ticks.iter_mut().for_each(|tick| tick.value /= factor);
                ticks
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_shorten_the_words() {
        let axis = Axis::exact("gap", "m", 0.0, 0.02);
        assert_eq!(axis.label(), "gap [mm]");
        let ticks = axis.ticks(4);
        assert_eq!(ticks[1].label.as_deref(), Some("5"));
        assert!((ticks[1].value - 0.005).abs() < 1e-15);
    }

    #[test]
    fn powers_of_units_are_raised() {
        assert_eq!(Axis::exact("density", "kg/m^3", 0.0, 1e3).label(), "density [kg/m^{3}]");
        assert_eq!(["m", "kg m^2/s", "1/s", "m^-2 s^-10"].map(raised), ["m", "kg m^{2}/s", "1/s", "m^{-2} s^{-10}"]);
    }

    #[test]
    fn there_are_two_ticks_at_least() {
        for (low, high) in [(-3.9, 4.3), (0.1, 9.9), (-0.9, 4.9), (1.01e-3, 1.99e-3)] {
            let ticks = Axis::exact("x", "m", low, high).ticks(2);
            assert!(ticks.len() > 1, "{low} to {high}: {ticks:?}");
        }
    }

    #[test]
    fn one_value_gets_a_range_around_it() {
        for value in [0.0, 3.0, -2.0, 1e-200] {
            let axis = Axis::linear("x", "m", [value, value]);
            assert!(axis.low < value && value < axis.high, "{value}: {axis:?}");
        }
        let axis = Axis::logarithmic("x", "m", [0.0, -1.0, 2.0]);
        assert!(axis.low < 2.0 && 2.0 < axis.high && axis.low > 0.0);
    }

    #[test]
    fn rounding_is_not_blown_up() {
        let axis = Axis::linear("x", "m", [1.0, 1.0 + 1e-13]);
        assert!(axis.high - axis.low > 0.5);
    }

    #[test]
    fn values_stand_where_the_scale_says() {
        let axis = Axis { scale: AxisScale::Logarithmic, ..Axis::exact("x", "m", 1e-2, 1e2) };
        assert!((axis.place(1.0) - 0.5).abs() < 1e-15);
    }
}
