//! What makes a body contract, in words. A signal is told by its kind and its largest entries.

use crate::format::significant;
use gyration::contractile::{Contraction, ContractionSource, Feedback, FeedbackMeasure, Spin};
use gyration::signal::{Interpolation, Signal, Wave};
use gyration::tensor::{Mat3, Vec3};

/// One entry for what resists the contraction, and one for each part of what makes it.
pub fn contraction(it: &Contraction) -> Vec<String> {
    let viscosity = (it.viscosity > 0.0).then(|| {
        let volume = if it.kept_volume.is_some() { ", keeps the volume" } else { "" };
        let spin = if it.spin == Spin::Symmetric { ", without spin" } else { "" };
        format!("contraction viscosity {} Pa s{volume}{spin}", significant(it.viscosity, 5))
    });
    let made = match &it.source {
        ContractionSource::Prescribed(signal) => vec![format!("contraction prescribed: {}", words(signal, ""))],
        ContractionSource::Driven { drive, feedback } => {
            let silent = *drive == Signal::Constant(Mat3::zeros());
            let drive = match (silent, feedback.is_empty()) {
                (true, true) => Some("no drive".to_owned()),
                (true, false) => None,
                (false, _) => Some(format!("drive: {}", words(drive, " Pa"))),
            };
            drive.into_iter().chain(feedback.iter().map(answer)).collect()
        }
    };
    viscosity.into_iter().chain(made).collect()
}

/// More parts of a sum than these are counted.
const MOST_PARTS: usize = 4;

fn words(signal: &Signal, unit: &str) -> String {
    let size = |value: &Mat3| format!("{}{unit}", significant(value.amax(), 5));
    let wave = |name: &str, wave: &Wave| {
        let phase =
            if wave.phase == 0.0 { String::new() } else { format!(", phase {} rad", significant(wave.phase, 5)) };
        format!("{name} of up to {} at {} Hz{phase}", size(&wave.amplitude), significant(wave.frequency, 5))
    };
    match signal {
        Signal::Constant(value) => format!("constant of up to {}", size(value)),
        Signal::Sine(it) => wave("sine", it),
        Signal::Square(it) => wave("square wave", it),
        Signal::Ramp { from, to, duration } => {
            format!("ramp from up to {} to up to {} in {} s", size(from), size(to), significant(*duration, 5))
        }
        Signal::Table(table) => {
            let [first, last] = table.span().map(|time| significant(time, 5));
            let between = match table.interpolation() {
                Interpolation::Linear => "linear",
                Interpolation::Cubic => "cubic",
            };
            format!("table from {first} s to {last} s, {between}")
        }
        Signal::Sum(parts) if parts.len() > MOST_PARTS => format!("sum of {} signals", parts.len()),
        Signal::Sum(parts) => parts.iter().map(|part| words(part, unit)).collect::<Vec<_>>().join(" + "),
    }
}

fn answer(feedback: &Feedback) -> String {
    let along = |a: &Vec3| format!("[{}, {}, {}]", significant(a.x, 4), significant(a.y, 4), significant(a.z, 4));
    let (what, unit) = match &feedback.measure {
        FeedbackMeasure::SupportGap => ("the gap".to_owned(), "Pa/m"),
        FeedbackMeasure::Stretch(a) => (format!("the stretch along {}", along(a)), "Pa"),
        FeedbackMeasure::Rate(a) => (format!("the rate of stretch along {}", along(a)), "Pa s"),
    };
    let limits =
        feedback.limits.map(|[least, most]| format!(", within {} and {}", significant(least, 5), significant(most, 5)));
    format!(
        "feedback on {what}, gain of up to {} {unit}{}",
        significant(feedback.gain.amax(), 5),
        limits.unwrap_or_default()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along_z(value: f64) -> Mat3 {
        Mat3::from_diagonal(&Vec3::new(0.0, 0.0, value))
    }

    #[test]
    fn what_makes_a_body_contract_is_told() {
        let sine = Signal::Sine(Wave { amplitude: along_z(-100.0), frequency: 5.0, phase: 0.5 });
        let ramp = Signal::Ramp { from: Mat3::zeros(), to: along_z(2e7), duration: 0.25 };
        let gap = Feedback {
            measure: FeedbackMeasure::SupportGap,
            gain: along_z(-3e4),
            bias: Mat3::zeros(),
            limits: Some([0.0, 0.01]),
        };
        let rate = Feedback { measure: FeedbackMeasure::Rate(Vec3::x()), limits: None, ..gap };
        let driven = |drive: &Signal, feedback: &[Feedback]| Contraction {
            viscosity: 50.0,
            kept_volume: Some(1.0),
            spin: Spin::Symmetric,
            source: ContractionSource::Driven { drive: drive.clone(), feedback: feedback.to_vec() },
        };
        let silent = Signal::Constant(Mat3::zeros());
        let viscosity = "contraction viscosity 50 Pa s, keeps the volume, without spin";
        let sum = Signal::Sum(vec![sine.clone(), ramp]);
        let told =
            "drive: sine of up to 100 Pa at 5 Hz, phase 0.5 rad + ramp from up to 0 Pa to up to 2.0000e7 Pa in 0.25 s";
        let felt = "feedback on the gap, gain of up to 30000 Pa/m, within 0 and 0.01";
        let rates = "feedback on the rate of stretch along [1, 0, 0], gain of up to 30000 Pa s";
        assert_eq!(contraction(&driven(&sum, &[])), [viscosity, told]);
        assert_eq!(contraction(&driven(&silent, &[gap, rate])), [viscosity, felt, rates]);
        assert_eq!(contraction(&driven(&silent, &[])), [viscosity, "no drive"]);
        let source = ContractionSource::Prescribed(Signal::Sum(vec![Signal::Constant(Mat3::identity()), sine]));
        let prescribed = Contraction { viscosity: 0.0, kept_volume: None, spin: Spin::Full, source };
        let told = "contraction prescribed: constant of up to 1 + sine of up to 100 at 5 Hz, phase 0.5 rad";
        assert_eq!(contraction(&prescribed), [told]);
    }
}
