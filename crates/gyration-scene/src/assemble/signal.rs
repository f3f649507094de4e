//! Values in time: from what the file calls them to signals of tensors, and what they are over a whole run.
//!
//! Between 0 and the end of the run a signal is looked at 64 times in the whole and in each period of its fastest wave,
//! and 8 times between neighbours among the times of its tables and the ends of its ramps.

use super::context::SceneContext;
use super::start::matrix;
use crate::check::Reporter;
use crate::file::{Interpolation as Written, Ramp, Rows, Signal as WrittenSignal, Table, Wave as WrittenWave};
use crate::key::Key;
use crate::quantity::{AnyQuantity, Velocity, si};
use crate::read::NamedFile;
use crate::table::{ReadTable, TableFault, read_numbers, read_tensors, read_vectors};
use crate::units::shown;
use gyration::signal::{Interpolation, Signal, TensorTable, Wave};
use gyration::tensor::{Mat3, Vec3};

/// Reads a table: its path, what messages call its tensors, what it does between its times.
pub(super) type Reader = fn(NamedFile<'_>, char, Interpolation) -> Result<ReadTable, TableFault>;

/// What a signal of the file is at a time.
pub(super) trait Value {
    /// Reads a table of such.
    const READ: Reader;

    /// The tensor as which a signal keeps it.
    fn tensor(&self) -> Mat3;
}

impl<T: Into<f64> + Copy> Value for Rows<T> {
    const READ: Reader = read_tensors;

    fn tensor(&self) -> Mat3 {
        matrix(self)
    }
}

/// A vector is the first column.
impl Value for [Velocity; 3] {
    const READ: Reader = read_vectors;

    fn tensor(&self) -> Mat3 {
        Mat3::from_columns(&[si(self), Vec3::zeros(), Vec3::zeros()])
    }
}

/// A number is the first entry.
impl Value for AnyQuantity {
    const READ: Reader = read_numbers;

    fn tensor(&self) -> Mat3 {
        Mat3::from_columns(&[Vec3::x() * self.0, Vec3::zeros(), Vec3::zeros()])
    }
}

/// Makes signals of one kind of value.
pub(super) struct SignalBuilder<'a, 'b> {
    pub(super) context: &'a SceneContext<'a>,
    pub(super) reporter: &'a mut Reporter<'b>,
    /// What messages call the tensor.
    pub(super) symbol: char,
    /// Where a ramp starts that does not say so.
    pub(super) rest: Mat3,
}

impl SignalBuilder<'_, '_> {
    /// The signal at a key; notes what is wrong with any part of it.
    pub(super) fn signal<V: Value>(&mut self, written: &WrittenSignal<V>, key: &Key) -> Option<Signal> {
        self.part(written, key, Some(self.rest))
    }

    /// The same of one that stays within the range of numbers over the whole run.
    pub(super) fn bounded<V: Value>(&mut self, written: &WrittenSignal<V>, key: &Key) -> Option<Signal> {
        let signal = self.signal(written, key)?;
        let fault = first_fault(&signal, self.context.end.unwrap_or(0.0), not_finite);
        let Some((time, message)) = fault else { return Some(signal) };
        self.reporter.note(key, format!("at t = {} s {message}", shown(time)), "write smaller numbers");
        None
    }

    /// A signal or a part of a sum; `rest` is where a ramp starts that does not say so, if that is clear.
    fn part<V: Value>(&mut self, written: &WrittenSignal<V>, key: &Key, rest: Option<Mat3>) -> Option<Signal> {
        Some(match written {
            WrittenSignal::Constant(constant) => Signal::Constant(constant.value.tensor()),
            WrittenSignal::Sine(it) => Signal::Sine(wave(it)),
            WrittenSignal::Square(it) => Signal::Square(wave(it)),
            WrittenSignal::Ramp(ramp) => self.ramp(ramp, &key.key("ramp"), rest)?,
            WrittenSignal::Table(table) => Signal::Table(self.table(table, &key.key("table").key("file"), V::READ)?),
            WrittenSignal::Sum(parts) => {
                // What is not zero would be added as often as there are ramps.
                let (key, rest) = (key.key("sum"), rest.filter(|rest| *rest == Mat3::zeros()));
                let made = parts.iter().enumerate().map(|(index, part)| self.part(part, &key.index(index), rest));
                // All of them, so that each is checked.
                let made: Vec<Option<Signal>> = made.collect();
                Signal::Sum(made.into_iter().collect::<Option<_>>()?)
            }
        })
    }

    fn ramp<V: Value>(&mut self, ramp: &Ramp<V>, key: &Key, rest: Option<Mat3>) -> Option<Signal> {
        let Some(from) = ramp.from.as_ref().map(V::tensor).or(rest) else {
            let help = "add `from`: [[0, 0, 0], [0, 0, 0], [0, 0, 0]] if another part of the sum is where it starts";
            self.reporter.note(&key.key("from"), "within a sum it is open where the ramp starts", help);
            return None;
        };
        Some(Signal::Ramp { from, to: ramp.to.tensor(), duration: ramp.duration.value() })
    }

    /// The table of a file, read by `read`; notes what is wrong with it.
    fn table(&mut self, table: &Table, key: &Key, read: Reader) -> Option<TensorTable> {
        let interpolation = match table.interpolation {
            Written::Linear => Interpolation::Linear,
            Written::Cubic => Interpolation::Cubic,
        };
        let files = self.context.files;
        let path = files.path(&table.file);
        let made = match read((files, &table.file), self.symbol, interpolation) {
            Ok(ReadTable { table: made, sum }) => {
                self.reporter.read(key, &table.file, sum);
                made
            }
            Err(error) => {
                self.reporter.note(key, error.to_string(), error.help(files));
                return None;
            }
        };
        let [first, last] = made.span();
        let end = self.context.end.unwrap_or(last);
        if first > 0.0 {
            let message = format!("table {} begins late, at {} s: the run begins at 0 s", path.display(), shown(first));
            self.reporter.note(key, message, "add a row at t = 0");
        }
        if last < end {
            let message = format!("table {} ends early, at {last:?} s: time.end is {end:?} s", path.display());
            self.reporter.note(key, message, format!("add rows up to t = {end:?}, or end the run at {last:?} s"));
        }
        (first <= 0.0 && last >= end).then_some(made)
    }
}

fn wave<V: Value>(written: &WrittenWave<V>) -> Wave {
    Wave { amplitude: written.amplitude.tensor(), frequency: written.frequency.value(), phase: written.phase.0 }
}

/// The first time from 0 to `end`, of those at which a signal is looked at, where there is something wrong with it.
pub(super) fn first_fault(signal: &Signal, end: f64, fault: impl Fn(&Mat3) -> Option<String>) -> Option<(f64, String)> {
    instants(signal, end).find_map(|time| Some((time, fault(&signal.at(time))?)))
}

pub(super) fn not_finite(value: &Mat3) -> Option<String> {
    // Its square has a place in the power.
    let held = value.iter().all(|entry| (entry * entry).is_finite());
    (!held).then(|| "it leaves the range of numbers".to_owned())
}

/// In the whole run and in a period of the fastest wave.
const PER_PERIOD: f64 = 64.0;
/// Between two knots.
const PER_KNOT: f64 = 8.0;
/// At most so many in the whole, beside those between knots: of a wave of more periods each shows another phase.
const MOST: f64 = 1e5;

/// Times at which a signal is looked at, from 0 to `end`.
fn instants(signal: &Signal, end: f64) -> impl Iterator<Item = f64> {
    let mut knots = vec![0.0, end];
    add_knots(signal, end, &mut knots);
    knots.sort_by(f64::total_cmp);
    let whole = (PER_PERIOD * (signal.highest_frequency() * end).max(1.0)).min(MOST);
    let pieces: Vec<(f64, f64)> = knots.windows(2).map(|pair| (pair[0], pair[1] - pair[0])).collect();
    let within = move |(from, length): (f64, f64)| {
        let count = (whole * (length / end)).ceil().max(PER_KNOT);
        (0..count as usize).map(move |step| from + length * (step as f64 / count))
    };
    pieces.into_iter().flat_map(within).chain([end])
}

/// Adds the times before `end` at which a table has a row or a ramp ends.
fn add_knots(signal: &Signal, end: f64, knots: &mut Vec<f64>) {
    match signal {
        Signal::Ramp { duration, .. } => knots.extend(Some(*duration).filter(|time| *time < end)),
        Signal::Table(table) => {
            let next = |time: f64| table.next_knot(time).filter(|time| *time < end);
            knots.extend(std::iter::successors(next(0.0), |time| next(*time)));
        }
        Signal::Sum(parts) => parts.iter().for_each(|part| add_knots(part, end, knots)),
        Signal::Constant(_) | Signal::Sine(_) | Signal::Square(_) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sine(frequency: f64) -> Signal {
        Signal::Sine(Wave { amplitude: Mat3::identity(), frequency, phase: 0.0 })
    }

    #[test]
    fn a_signal_is_looked_at_from_the_start_to_the_end_in_every_period() {
        let ramp = Signal::Ramp { from: Mat3::zeros(), to: Mat3::identity(), duration: 1e-3 };
        let rows = [0.0, 0.1, 0.10001, 5.0].map(|time| (time, Mat3::zeros())).to_vec();
        let table = TensorTable::new(rows, Interpolation::Linear).unwrap();
        let sum = Signal::Sum(vec![sine(0.0), sine(7.0), ramp, Signal::Table(table)]);
        for (signal, end, longest) in [
            (Signal::Constant(Mat3::zeros()), 2.0, 2.0 / 64.0),
            (sine(3.0), 2.0, 1.0 / 192.0),
            (sum, 3.0, 1.0 / (7.0 * 64.0)),
            (sine(1e300), 1e300, 1e300 / MOST),
            (sine(1.0), 1e-320, 1e-320),
        ] {
            let times: Vec<f64> = instants(&signal, end).collect();
            assert_eq!((times[0], times[times.len() - 1]), (0.0, end));
            assert!(times.len() <= 2 * MOST as usize, "{} instants", times.len());
            // Steps are rounded to parts of 1e-16 of the end.
            let largest = times.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
            assert!(largest <= longest + 1e-15 * end, "{signal:?}: steps of {largest}");
        }
    }

    #[test]
    fn what_happens_between_two_rows_of_a_table_is_seen() {
        // A dip of a ten-thousandth of the run.
        let rows = [(0.0, 1.0), (0.5, 1.0), (0.50005, -1.0), (0.5001, 1.0), (1.0, 1.0)];
        let rows = rows.map(|(time, value)| (time, Mat3::from_diagonal_element(value))).to_vec();
        let signal = Signal::Table(TensorTable::new(rows, Interpolation::Linear).unwrap());
        let found = first_fault(&signal, 1.0, |value| (value[(0, 0)] < 0.0).then(|| "below zero".to_owned()));
        assert!(found.is_some_and(|(time, _)| (time - 0.50005).abs() < 3e-5));
    }
}
