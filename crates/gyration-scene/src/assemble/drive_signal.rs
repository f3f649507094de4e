//! A torque or force in time that drives a joint: the first entry of a signal.

use super::context::SceneContext;
use super::signal::{SignalBuilder, first_fault, not_finite};
use crate::check::Reporter;
use crate::file::{DriveSignal, DriveWave};
use crate::key::Key;
use crate::table::read_numbers;
use crate::units::shown;
use gyration::signal::{Signal, Wave};
use gyration::tensor::Mat3;

/// The signal at a key; notes what is wrong with it.
pub(super) fn drive_signal(
    written: &DriveSignal,
    key: &Key,
    context: &SceneContext,
    reporter: &mut Reporter<'_>,
) -> Option<Signal> {
    let signal = match written {
        DriveSignal::Constant(constant) => Signal::Constant(first(constant.value.0)),
        DriveSignal::Sine(it) => Signal::Sine(wave(it)),
        DriveSignal::Square(it) => Signal::Square(wave(it)),
        DriveSignal::Ramp(ramp) => {
            Signal::Ramp { from: first(ramp.from.0), to: first(ramp.to.0), duration: ramp.duration.value() }
        }
        DriveSignal::Table(table) => {
            let mut maker = SignalBuilder { context, reporter, symbol: 'u', rest: Mat3::zeros() };
            Signal::Table(maker.table(table, &key.key("table").key("file"), read_numbers)?)
        }
        DriveSignal::Sum(parts) => {
            let key = key.key("sum");
            let parts =
                parts.iter().enumerate().map(|(index, part)| drive_signal(part, &key.index(index), context, reporter));
            // All of them, so that each is checked.
            let parts: Vec<Option<Signal>> = parts.collect();
            Signal::Sum(parts.into_iter().collect::<Option<_>>()?)
        }
    };
    let Some((time, message)) = first_fault(&signal, context.end.unwrap_or(0.0), not_finite) else {
        return Some(signal);
    };
    reporter.note(key, format!("at t = {} s {message}", shown(time)), "write smaller numbers");
    None
}

/// Where the torques or forces of a signal are written.
pub(super) fn numbers(written: &DriveSignal, key: &Key) -> Vec<Key> {
    let (word, names): (&str, &[&str]) = match written {
        DriveSignal::Constant(_) => ("constant", &["value"]),
        DriveSignal::Sine(_) => ("sine", &["amplitude"]),
        DriveSignal::Square(_) => ("square", &["amplitude"]),
        DriveSignal::Ramp(_) => ("ramp", &["from", "to"]),
        DriveSignal::Table(_) => return Vec::new(),
        DriveSignal::Sum(parts) => {
            let key = key.key("sum");
            return parts.iter().enumerate().flat_map(|(index, part)| numbers(part, &key.index(index))).collect();
        }
    };
    names.iter().map(|name| key.key(word).key(name)).collect()
}

/// A number as the first entry of a tensor.
fn first(number: f64) -> Mat3 {
    let mut value = Mat3::zeros();
    value[(0, 0)] = number;
    value
}

fn wave(written: &DriveWave) -> Wave {
    Wave { amplitude: first(written.amplitude.0), frequency: written.frequency.value(), phase: written.phase.0 }
}
