//! Scales of the state, and derivatives of what is known in a state along a direction of it.

use super::Meaningless;
use crate::adapter::{ModelSystem, Tolerance};
use crate::outcome::Stop;
use crate::variation::{NoDerivative, power_of_two};
use gyration::Inadmissible;
use gyration::extended::Extended;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::System as _;

/// Scales of the state, lengths being gaps: what changes by one of them has changed altogether. A thousandth of the
/// body's own size and speed counts at least.
pub(crate) const SCALES: Tolerance = Tolerance { rtol: 10.0, atol: 1e-2 };
/// The state is varied along S by this part of its scales at first.
const PROBE: f64 = 5e-4;
/// By so many times less where differences do not agree.
const FINER: f64 = 8.0;
/// So many steps are tried.
const MOST_PROBES: i32 = 8;
/// Differences agree whose error is no larger a part of them.
const AGREE: f64 = 1e-8;
/// The sixth difference of seven values has nothing but their rounding, if they are near enough to one another.
const SIXTH: [f64; 7] = [1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0];
/// It is taken over so many steps, from so many of them on: about the middle, or on one side.
const NOISY: [f64; 2] = [1.0, 3.0];
const SIDES: [f64; 3] = [-3.0, 0.0, -6.0];

/// Four places of a line, in steps, and what weighs them in a difference over one step and in one over two.
struct Stencil {
    places: [f64; 4],
    near: [f64; 4],
    far: [f64; 4],
    /// The power of their disagreement that the error of what both tell goes with.
    order: f64,
}

/// About the middle: of second order, and of fourth together.
const CENTRAL: Stencil =
    Stencil { places: [-2.0, -1.0, 1.0, 2.0], near: [0.0, -0.5, 0.5, 0.0], far: [-0.25, 0.0, 0.0, 0.25], order: 2.0 };
/// On one side: of second order, and of third together.
const AHEAD: Stencil =
    Stencil { places: [0.0, 1.0, 2.0, 4.0], near: [-1.5, 2.0, -0.5, 0.0], far: [-0.75, 0.0, 1.0, -0.25], order: 1.5 };

/// A difference of one number: its slope, the error of that, and whether it needs no shorter step.
struct Slope {
    value: f64,
    error: f64,
    agrees: bool,
}

impl Stencil {
    /// The slopes over a step of either sign of what is evaluated at multiples of a direction, and rounded by so much
    /// where that is known.
    fn slopes<E>(
        &self,
        step: f64,
        noise: &[f64],
        evaluate: &mut impl FnMut(f64) -> Result<Vec<f64>, E>,
    ) -> Result<Vec<Slope>, E> {
        let [a, b, c, d] = self.places.map(|place| place * step);
        let points = [evaluate(a)?, evaluate(b)?, evaluate(c)?, evaluate(d)?];
        let slope = |i: usize| {
            let values = points.each_ref().map(|point| point[i]);
            let over = |weights: &[f64; 4]| weights.iter().zip(values).map(|(w, value)| w * value).sum::<f64>() / step;
            let (near, far) = (over(&self.near), over(&self.far));
            let value = (4.0 * near - far) / 3.0;
            let most = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            let noise = noise.get(i).map_or(f64::EPSILON * most, |noise| noise.max(f64::EPSILON * most));
            let (bend, rounding) = ((near - far).abs(), noise / step.abs());
            let part = libm::pow(bend / value.abs(), self.order - 1.0);
            let error = bend.min(bend * part).max(0.0) + rounding;
            // What is no number is none over any step.
            let agrees = bend.is_nan() || bend <= 4.0 * rounding || error <= AGREE * value.abs();
            Slope { value, error, agrees }
        };
        Ok((0..points[0].len()).map(slope).collect())
    }
}

/// By how much what is evaluated within a step, far below all that it could change in, is rounded: a gap of two bodies
/// by parts of their distance, not of its own. What is not known there tells nothing.
fn noise<E>(step: f64, evaluate: &mut impl FnMut(f64) -> Result<Vec<f64>, E>) -> Vec<f64> {
    let deviation = SIXTH.iter().map(|weight| weight * weight).sum::<f64>().sqrt();
    let mut at = |spacing: f64, from: f64| -> Result<Vec<f64>, E> {
        let mut sums = Vec::new();
        for (weight, k) in SIXTH.iter().zip(0..) {
            let values = evaluate((from + f64::from(k)) * spacing * step)?;
            sums.resize(values.len(), 0.0);
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
        }
        Ok(sums)
    };
    let mut most: Vec<f64> = Vec::new();
    for spacing in NOISY {
        let Some(sums) = SIDES.iter().find_map(|from| at(spacing, *from).ok()) else { return Vec::new() };
        most.resize(sums.len(), 0.0);
        most.iter_mut().zip(sums).for_each(|(most, sum)| *most = most.max(sum.abs() / deviation));
    }
    most
}

/// The derivative of something along a direction of the state, by differences; `evaluate` gives it at a multiple of the
/// direction.
///
/// Scales know gaps to contacts, and neither the way to a limit of a joint nor the width of an expression. So the step
/// is reduced until differences over it and twice as far agree, or what is evaluated is known there at all, be it on
/// one side: of each number that of the least error is taken, be it curvature or rounding, which is measured.
pub(super) fn along<E>(
    direction: &[f64],
    scales: &[f64],
    mut evaluate: impl FnMut(f64) -> Result<Vec<f64>, E>,
) -> Result<Vec<f64>, E> {
    let size = direction.iter().zip(scales).map(|(part, scale)| part.abs() / scale).fold(0.0, f64::max);
    if size == 0.0 {
        return Ok(vec![0.0; evaluate(0.0)?.len()]);
    }
    by_steps_from(PROBE / size, evaluate)
}

/// The derivative of something by time, within a span \[s\]. Steps are powers of two, so that times are neighbours by
/// these to the last digit.
pub(super) fn in_time<E>(span: f64, evaluate: impl FnMut(f64) -> Result<Vec<f64>, E>) -> Result<Vec<f64>, E> {
    by_steps_from(power_of_two(PROBE * span), evaluate)
}

/// A derivative by differences over steps of which this is the largest.
fn by_steps_from<E>(first: f64, mut evaluate: impl FnMut(f64) -> Result<Vec<f64>, E>) -> Result<Vec<f64>, E> {
    let (mut best, mut rounded): (Vec<Slope>, Vec<f64>) = (Vec::new(), Vec::new());
    for probe in 0.. {
        let step = first * FINER.powi(-probe);
        let is_last = probe + 1 == MOST_PROBES;
        let found = CENTRAL
            .slopes(step, &rounded, &mut evaluate)
            .or_else(|_| AHEAD.slopes(step, &rounded, &mut evaluate))
            .or_else(|_| AHEAD.slopes(-step, &rounded, &mut evaluate));
        let found = match found {
            Ok(found) => found,
            // A finer one that is not known adds nothing to what is.
            Err(_) if !best.is_empty() => break,
            Err(fault) if is_last => return Err(fault),
            Err(_) => continue,
        };
        let do_agree = found.iter().all(|slope| slope.agrees);
        if best.is_empty() {
            best = found;
            if !do_agree && !is_last {
                rounded = noise(first * FINER.powi(1 - MOST_PROBES), &mut evaluate);
                best.iter_mut().zip(&rounded).for_each(|(slope, noise)| slope.error += noise / step);
            }
        } else {
            for (best, found) in best.iter_mut().zip(found) {
                if found.error < best.error {
                    *best = found;
                }
            }
        }
        if is_last || do_agree {
            break;
        }
    }
    Ok(best.into_iter().map(|slope| slope.value).collect())
}

/// The numbers of a state that has gone a part of a direction, to twice the digits.
pub(super) fn gone(state: &State, direction: &[f64], part: f64) -> [Vec<f64>; 2] {
    let numbers = state.bodies.iter().zip(direction).enumerate();
    let sums = numbers.map(|(i, (y, s))| {
        let own = Extended { high: *y, low: state.low.get(i).copied().unwrap_or(0.0) };
        own + Extended::from(part * s)
    });
    let (high, low) = sums.map(|sum| (sum.high, sum.low)).unzip();
    [high, low]
}

/// The scales of state and works.
pub(super) fn fill_scales(system: &mut ModelSystem, state: &State, scales: &mut [f64]) {
    let (bodies, works) = scales.split_at_mut(state.bodies.len());
    system.error_scales(state.time, &state.bodies, &state.works, bodies, works);
}

/// Why a state is outside the model, in words.
pub(super) fn reason(model: &Model, time: f64, left: &Inadmissible) -> String {
    Stop::by_inadmissible(model, time, left).what
}

/// A fault in words.
pub(super) fn meaningless(model: &Model, time: f64, fault: &NoDerivative) -> Meaningless {
    let reason = match fault {
        NoDerivative::Reason(reason) => reason.clone(),
        NoDerivative::Inadmissible(left) => format!("with a little more or less of it, {}", reason(model, time, left)),
    };
    Meaningless { from: time, reason }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// Symptom: of a force that changes within a tenth of a millimetre along a body of 10 cm the derivative had the
    /// wrong sign, since the step was a two thousandth of the size.
    #[test]
    fn what_changes_within_less_than_a_probe_is_followed() {
        for width in [1.0, 1e-2, 1e-4, 1e-6] {
            let at = 0.3 * width;
            let of = |part: f64| Ok::<_, Infallible>(vec![libm::tanh((at + part) / width), 2.0 + 3.0 * part, 7.0]);
            let found = along(&[1.0], &[1.0], of).unwrap();
            let exact = 1.0 / (width * libm::cosh(0.3).powi(2));
            println!("{width}: off by {:e}", found[0] / exact - 1.0);
            // The fourth power of a step that is 5e-4 to 4e-3 of the width.
            assert!((found[0] / exact - 1.0).abs() < 1e-8, "{width}: {}", found[0]);
            assert!((found[1] - 3.0).abs() < 1e-9 && found[2] == 0.0, "{found:?}");
        }
    }

    /// Symptom: a probe beyond the limit of a joint was told as the end of the run.
    #[test]
    fn what_is_known_beside_a_limit_only_is_followed_there() {
        let left = 1e-5;
        let of = |part: f64| if part < left { Ok(vec![libm::pow(left - part, -1.5)]) } else { Err("beyond") };
        let found = along(&[1.0], &[1.0], of).unwrap();
        let exact = 1.5 * libm::pow(left, -2.5);
        assert!((found[0] / exact - 1.0).abs() < 1e-8, "{}", found[0] / exact);
        // At the limit itself one side is all there is.
        let of = |part: f64| if part >= 0.0 { Ok(vec![libm::exp(-3.0 * part)]) } else { Err("beyond") };
        let found = along(&[1.0], &[1.0], of).unwrap();
        assert!((found[0] + 3.0).abs() < 1e-8, "{}", found[0]);
        assert_eq!(along(&[1.0], &[1.0], |_| Err::<Vec<f64>, _>("nowhere")), Err("nowhere"));
    }
}
