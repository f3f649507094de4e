//! The last whole cycle of a body whose drive repeats itself: the window over which a stroke, a distance, a cost are
//! told.
//!
//!   [t₁ − T, t₁],   t₁ the last sample, T the period of the drive
//!
//! A cycle begins between two samples as a rule: values there are those of the chord between them.

use crate::chart::ticks::short;

/// A window of one period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// T [s].
    pub period: f64,
    /// Its beginning [s].
    pub start: f64,
}

impl Cycle {
    /// The last whole cycle of a recording from `first` to `last` [s]; none if there is none.
    pub fn last(period: Option<f64>, (first, last): (f64, f64)) -> Option<Self> {
        let period = period?;
        let start = last - period;
        // A recording of one period begins with the cycle, but for the rounding of its times.
        (start >= first - 1e-9 * period).then_some(Self { period, start: start.max(first) })
    }

    /// How long it takes, in words.
    pub fn in_words(&self) -> String {
        format!("{} s", rounded(self.period))
    }
}

/// Watches values pass and keeps those at one time.
#[derive(Debug, Clone)]
pub struct AtTime<const N: usize> {
    time: f64,
    previous: Option<(f64, [f64; N])>,
    found: Option<[f64; N]>,
}

impl<const N: usize> AtTime<N> {
    /// For the values at a time [s].
    pub fn at(time: f64) -> Self {
        Self { time, previous: None, found: None }
    }

    /// Takes the values of the next sample; returns whether the time has just been reached or passed.
    pub fn push(&mut self, time: f64, values: [f64; N]) -> bool {
        let reached = self.found.is_none() && time >= self.time;
        if reached {
            self.found = Some(match self.previous {
                Some((before, old)) if time > before => {
                    let part = (self.time - before) / (time - before);
                    std::array::from_fn(|k| old[k] + part * (values[k] - old[k]))
                }
                _ => values,
            });
        }
        self.previous = Some((time, values));
        reached
    }

    /// The values at the time, once it has been reached.
    pub fn found(&self) -> Option<[f64; N]> {
        self.found
    }

    /// The values of the last sample.
    pub fn last(&self) -> Option<[f64; N]> {
        self.previous.map(|(_, values)| values)
    }

    /// What has been added since the time.
    pub fn since(&self) -> Option<[f64; N]> {
        let (old, new) = self.found().zip(self.last())?;
        Some(std::array::from_fn(|k| new[k] - old[k]))
    }
}

/// Three digits of a number, in words.
pub fn rounded(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_owned() } else { "undefined".to_owned() };
    }
    let power = 2 - libm::log10(value.abs()).floor() as i32;
    // Divided by a power of ten that is exact where the digits are decimals.
    let digits = if power >= 0 {
        (value * 10f64.powi(power)).round() / 10f64.powi(power)
    } else {
        (value / 10f64.powi(-power)).round() * 10f64.powi(-power)
    };
    short(digits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_cycle_ends_with_the_recording() {
        assert_eq!(Cycle::last(Some(0.25), (0.0, 1.0)), Some(Cycle { period: 0.25, start: 0.75 }));
        assert_eq!(Cycle::last(Some(2.0), (0.0, 1.0)), None);
        assert_eq!(Cycle::last(None, (0.0, 1.0)), None);
        // Thirty steps of a tenth are not 3 in floating point.
        assert!(Cycle::last(Some(3.0), (0.0, 0.1 * 30.0 - 1e-15)).is_some());
    }

    #[test]
    fn marks_lie_on_the_chord_between_samples() {
        let mut mark = AtTime::at(1.5);
        let reached: Vec<bool> = (0..4).map(|k| mark.push(f64::from(k), [f64::from(k * k)])).collect();
        assert_eq!(reached, [false, false, true, false]);
        assert_eq!((mark.found(), mark.last(), mark.since()), (Some([2.5]), Some([9.0]), Some([6.5])));
    }

    #[test]
    fn three_digits_are_told() {
        let words = [0.0, 0.012345, -1234.0, 1e-9, 0.2, f64::NAN].map(rounded);
        assert_eq!(words, ["0", "0.0123", "-1230", "10^{-9}", "0.2", "undefined"]);
    }
}
