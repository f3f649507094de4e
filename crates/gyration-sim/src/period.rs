//! After which time a signal repeats itself: the cycle over which a stroke, a distance, a cost are told.
//!
//!   T = 1/gcd(f₁, f₂, …)
//!
//! of the frequencies of its waves. A sum of waves without a common measure, a ramp, and a table have no period; a
//! constant part changes none.

use gyration::signal::Signal;

/// Frequencies have a common measure if they are multiples of it, as far as this goes.
const MOST_MULTIPLES: u32 = 1000;
/// A multiple is whole to this: far above the rounding of a ratio, far below 1/[`MOST_MULTIPLES`].
const WHOLE: f64 = 1e-9;

/// The period of a signal [s]; none if it does not repeat itself, or never changes.
pub(crate) fn period(signal: &Signal) -> Option<f64> {
    let mut frequencies = Vec::new();
    collect(signal, &mut frequencies)?;
    let least = frequencies.iter().copied().reduce(f64::min)?;
    let is_whole = |ratio: f64| (ratio - ratio.round()).abs() < WHOLE * ratio;
    // The measure divides the least frequency.
    let parts = (1..=MOST_MULTIPLES).map(f64::from);
    let measure = parts.map(|parts| least / parts).find(|measure| frequencies.iter().all(|f| is_whole(f / measure)))?;
    Some(1.0 / measure)
}

/// The frequencies of what changes; `None` if something does not repeat itself.
fn collect(signal: &Signal, frequencies: &mut Vec<f64>) -> Option<()> {
    match signal {
        Signal::Constant(_) => {}
        Signal::Sine(wave) | Signal::Square(wave) => {
            if wave.frequency != 0.0 && wave.amplitude.amax() > 0.0 {
                frequencies.push(wave.frequency.abs());
            }
        }
        Signal::Sum(parts) => parts.iter().try_for_each(|part| collect(part, frequencies))?,
        Signal::Ramp { .. } | Signal::Table(_) => return None,
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration::signal::Wave;
    use gyration::tensor::Mat3;

    fn sine(frequency: f64) -> Signal {
        Signal::Sine(Wave { amplitude: Mat3::identity(), frequency, phase: 0.3 })
    }

    #[test]
    fn sums_repeat_after_the_common_multiple_of_their_periods() {
        let still = Signal::Constant(Mat3::identity());
        for (frequencies, expected) in
            [(vec![5.0], 0.2), (vec![2.0, -3.0], 1.0), (vec![0.1, 0.25], 20.0), (vec![1.1, 0.0, 3.3], 1.0 / 1.1)]
        {
            let parts = frequencies.iter().map(|f| sine(*f)).chain([still.clone()]).collect();
            let found = period(&Signal::Sum(parts)).unwrap();
            // A few roundings.
            assert!((found - expected).abs() < 1e-14 * expected, "{frequencies:?}: {found}");
        }
    }

    #[test]
    fn what_does_not_repeat_itself_has_no_period() {
        let ramp = Signal::Ramp { from: Mat3::zeros(), to: Mat3::identity(), duration: 1.0 };
        let incommensurable = Signal::Sum(vec![sine(1.0), sine(2f64.sqrt())]);
        for signal in
            [ramp.clone(), Signal::Sum(vec![sine(1.0), ramp]), incommensurable, Signal::Constant(Mat3::zeros())]
        {
            assert_eq!(period(&signal), None, "{signal:?}");
        }
    }
}
