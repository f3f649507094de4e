//! Tensors in time: what drives a contraction or a joint, what prescribes it, and the couples of a table.
//!
//!   constant A,   sine A sin(2πft + φ),   square A sgn sin(2πft + φ),   ramp from A to B in a time,   tables,   sums
//!
//! Everything is continuous: an edge of a square wave takes a hundred-thousandth of a period, half of it before and
//! half behind the jump, so that its impulse is exact and its moment in time is off by 1e-11 of a period squared. Where
//! a signal is not smooth it says so in advance (`next_kink`), and a run ends a step there.

mod table;

pub use table::{Interpolation, TableError, TensorTable};

use crate::tensor::Mat3;
use std::f64::consts::TAU;

/// A 3×3 tensor in time.
#[derive(Debug, Clone, PartialEq)]
pub enum Signal {
    /// The same at all times.
    Constant(Mat3),
    /// A sin(2πft + φ).
    Sine(Wave),
    /// A where sin(2πft + φ) > 0, −A where it is below zero.
    Square(Wave),
    /// Linear in time from one value to another, which then stays.
    Ramp {
        /// At t = 0.
        from: Mat3,
        /// From t = `duration` on.
        to: Mat3,
        /// How long it takes, > 0 \[s\].
        duration: f64,
    },
    /// Given at times.
    Table(TensorTable),
    /// All of them added.
    Sum(Vec<Signal>),
}

/// What repeats itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// A.
    pub amplitude: Mat3,
    /// f \[Hz\].
    pub frequency: f64,
    /// φ \[rad\].
    pub phase: f64,
}

/// A signal at one instant, with its derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Jet {
    /// The value.
    pub value: Mat3,
    /// Its rate \[1/s\].
    pub rate: Mat3,
    /// The rate of that \[1/s²\].
    pub acceleration: Mat3,
}

/// How smooth a signal is at its worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Smoothness {
    /// It has edges.
    Jumps,
    /// Its rate jumps.
    Kinks,
    /// Twice differentiable.
    Smooth,
}

/// The part of a period that an edge of a square wave takes.
const EDGE: f64 = 1e-5;
/// A kink nearer than this part of a period is passed: a step has just ended there.
const PASSED: f64 = 1e-9;

impl Wave {
    /// 2πft + φ, in periods.
    fn periods(&self, time: f64) -> f64 {
        self.frequency * time + self.phase / TAU
    }

    /// A sin(2πft + φ).
    fn sine(&self, time: f64) -> Jet {
        let (rate, (sine, cosine)) = (TAU * self.frequency, libm::sincos(TAU * self.frequency * time + self.phase));
        Jet {
            value: self.amplitude * sine,
            rate: self.amplitude * (rate * cosine),
            acceleration: self.amplitude * (-rate * rate * sine),
        }
    }

    /// The wave with edges of finite steepness.
    fn square(&self, time: f64) -> Jet {
        let place = self.periods(time).rem_euclid(1.0);
        // The distance from the nearest zero of the sine, with the sign of the sine.
        let [up, down] = [place.min(1.0 - place), (place - 0.5).abs()];
        let away = up.min(down).copysign(0.5 - place);
        let height = (away / (0.5 * EDGE)).clamp(-1.0, 1.0);
        let steep = if height.abs() < 1.0 { self.frequency / (0.5 * EDGE) } else { 0.0 };
        let steep = if up < down { steep } else { -steep };
        Jet { value: self.amplitude * height, rate: self.amplitude * steep, acceleration: Mat3::zeros() }
    }

    /// The first end of an edge after a time.
    fn next_edge(&self, time: f64) -> Option<f64> {
        if self.frequency == 0.0 {
            return None;
        }
        let (now, forward) = (self.periods(time), self.frequency.signum());
        let half = (2.0 * now).floor();
        let ends = (-1..=2).flat_map(|k| [-0.5, 0.5].map(|side| 0.5 * (half + f64::from(k)) + side * EDGE));
        let ahead = ends.map(|end| (end - now) * forward).filter(|ahead| *ahead > PASSED);
        Some(time + ahead.fold(f64::INFINITY, f64::min) / self.frequency.abs())
    }
}

impl Signal {
    /// The value at a time [s].
    pub fn at(&self, time: f64) -> Mat3 {
        match self {
            Self::Constant(value) => *value,
            Self::Sine(wave) => wave.amplitude * libm::sin(TAU * wave.frequency * time + wave.phase),
            Self::Sum(parts) => parts.iter().map(|part| part.at(time)).sum(),
            _ => self.jet(time).value,
        }
    }

    /// The value at a time [s] with its derivatives; at a kink those behind it.
    pub fn jet(&self, time: f64) -> Jet {
        match self {
            Self::Constant(value) => Jet { value: *value, ..Jet::default() },
            Self::Sine(wave) => wave.sine(time),
            Self::Square(wave) => wave.square(time),
            Self::Ramp { from, to, duration } => {
                let part = (time / duration).clamp(0.0, 1.0);
                let rising = if (0.0..1.0).contains(&part) { (to - from) / *duration } else { Mat3::zeros() };
                Jet { value: from + (to - from) * part, rate: rising, acceleration: Mat3::zeros() }
            }
            Self::Table(table) => table.jet(time),
            Self::Sum(parts) => parts.iter().map(|part| part.jet(time)).fold(Jet::default(), |sum, jet| Jet {
                value: sum.value + jet.value,
                rate: sum.rate + jet.rate,
                acceleration: sum.acceleration + jet.acceleration,
            }),
        }
    }

    /// The first time after this one at which the signal is not smooth [s].
    pub fn next_kink(&self, time: f64) -> Option<f64> {
        match self {
            Self::Constant(_) | Self::Sine(_) => None,
            Self::Square(wave) => wave.next_edge(time),
            Self::Ramp { duration, .. } => (time < *duration).then_some(*duration),
            Self::Table(table) => table.next_knot(time),
            Self::Sum(parts) => parts.iter().filter_map(|part| part.next_kink(time)).min_by(f64::total_cmp),
        }
    }

    /// How smooth it is at its worst.
    pub fn smoothness(&self) -> Smoothness {
        match self {
            Self::Constant(_) | Self::Sine(_) => Smoothness::Smooth,
            Self::Square(_) => Smoothness::Jumps,
            Self::Ramp { .. } => Smoothness::Kinks,
            Self::Table(table) => match table.interpolation() {
                Interpolation::Linear => Smoothness::Kinks,
                Interpolation::Cubic => Smoothness::Smooth,
            },
            Self::Sum(parts) => parts.iter().map(Self::smoothness).min().unwrap_or(Smoothness::Smooth),
        }
    }

    /// Whether it is the same at all times, as it is written.
    pub fn is_steady(&self) -> bool {
        match self {
            Self::Constant(_) => true,
            Self::Sum(parts) => parts.iter().all(Self::is_steady),
            Self::Sine(_) | Self::Square(_) | Self::Ramp { .. } | Self::Table(_) => false,
        }
    }

    /// The highest frequency of its waves [Hz]; 0 without any.
    pub fn highest_frequency(&self) -> f64 {
        match self {
            Self::Sine(wave) | Self::Square(wave) => wave.frequency.abs(),
            Self::Sum(parts) => parts.iter().map(Self::highest_frequency).fold(0.0, f64::max),
            Self::Constant(_) | Self::Ramp { .. } | Self::Table(_) => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(value: f64) -> Mat3 {
        Mat3::from_diagonal_element(value)
    }

    fn wave(frequency: f64, phase: f64) -> Wave {
        Wave { amplitude: unit(2.0), frequency, phase }
    }

    fn signals() -> Vec<(Signal, f64)> {
        let rows: Vec<(f64, Mat3)> =
            [(0.0, 1.0), (0.3, -0.4), (0.5, 0.2), (1.2, 0.9)].map(|(time, value)| (time, unit(value))).to_vec();
        let table = |interpolation| Signal::Table(TensorTable::new(rows.clone(), interpolation).unwrap());
        let ramp = Signal::Ramp { from: unit(-1.0), to: unit(2.0), duration: 0.6 };
        // With a bound on the third derivative, of which differences are off by h²/6.
        vec![
            (Signal::Constant(unit(3.0)), 0.0),
            (Signal::Sine(wave(2.0, 0.4)), 2.0 * (2.0 * TAU).powi(3)),
            (Signal::Square(wave(-1.5, 0.1)), 0.0),
            (ramp.clone(), 0.0),
            (table(Interpolation::Linear), 0.0),
            (table(Interpolation::Cubic), 200.0),
            (
                Signal::Sum(vec![ramp, Signal::Sine(wave(0.7, 0.0)), Signal::Square(wave(0.7, 1.0))]),
                2.0 * (0.7 * TAU).powi(3),
            ),
        ]
    }

    #[test]
    fn rates_are_the_derivatives_of_the_values() {
        let h = 1e-5;
        for (signal, third) in signals() {
            for step in 0..97 {
                let time = 0.007 + 0.0121 * f64::from(step);
                if signal.next_kink(time - 2.0 * h).is_some_and(|kink| kink < time + 2.0 * h) {
                    continue;
                }
                let (before, now, after) = (signal.jet(time - h), signal.jet(time), signal.jet(time + h));
                let by_differences = (after.value - before.value) / (2.0 * h);
                let bend = (after.rate - before.rate) / (2.0 * h);
                // And rounding, 1e-16/h of the value and of the rate.
                let allowed = 1e-9 + third * h * h + 1e-10 * third.cbrt();
                assert!((by_differences - now.rate).amax() < allowed, "{signal:?} at {time}");
                assert!((bend - now.acceleration).amax() < allowed * (1.0 + third.cbrt()), "{signal:?} at {time}");
                assert_eq!(signal.at(time), now.value);
            }
        }
    }

    #[test]
    fn signals_are_continuous_and_tell_their_kinks() {
        for (signal, _) in signals() {
            let (mut time, mut kinks) = (0.0, 0);
            while let Some(kink) = signal.next_kink(time).filter(|kink| *kink < 2.0) {
                assert!(kink > time, "{signal:?}");
                let (before, after) = (signal.at(kink - 1e-12), signal.at(kink + 1e-12));
                assert!((after - before).amax() < 1e-5, "{signal:?} at {kink}");
                let (before, after) = (signal.jet(kink - 1e-12), signal.jet(kink + 1e-12));
                if signal.smoothness() != Smoothness::Smooth {
                    assert!((after.rate - before.rate).amax() > 1e-3, "{signal:?} has no kink at {kink}");
                }
                (time, kinks) = (kink, kinks + 1);
            }
            let none = matches!(signal, Signal::Constant(_) | Signal::Sine(_));
            assert_eq!(kinks == 0, none, "{signal:?}");
        }
    }

    #[test]
    fn square_wave_has_the_sign_of_the_sine() {
        for (frequency, phase) in [(2.0, 0.0), (-1.3, 0.4), (0.4, -2.0)] {
            let square = Signal::Square(wave(frequency, phase));
            for step in 0..1000 {
                let time = 0.00123 + 0.0031 * f64::from(step);
                let sine = (TAU * frequency * time + phase).sin();
                if sine.abs() > 1e-4 {
                    assert_eq!(square.at(time), unit(2.0 * sine.signum()), "{frequency} at {time}");
                }
            }
        }
    }
}
