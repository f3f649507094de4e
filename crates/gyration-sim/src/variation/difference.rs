//! Differences of fourth order of lists of numbers, and how far they can be trusted.

/// Differences that are smaller than so many roundings of what is differentiated are rounding.
const ROUNDINGS: f64 = 1e3;

/// What rounding may add to the difference of numbers of a magnitude, over a step.
pub(super) fn rounding(magnitude_over_step: f64) -> f64 {
    0.1 * ROUNDINGS * f64::EPSILON * magnitude_over_step
}

/// The largest power of two that is no larger: numbers of usual size are neighbours by it to the last digit.
pub(crate) fn power_of_two(length: f64) -> f64 {
    let (_, exponent) = libm::frexp(length);
    libm::ldexp(0.5, exponent)
}

/// The points of a difference, in steps, with their weights.
pub(super) type Stencil = &'static [(f64, f64)];

/// (8 (f₁ − f₋₁) − (f₂ − f₋₂))/12.
pub(super) const CENTRAL: Stencil = &[(-2.0, 1.0 / 12.0), (-1.0, -8.0 / 12.0), (1.0, 8.0 / 12.0), (2.0, -1.0 / 12.0)];
/// (−25 f₀ + 48 f₁ − 36 f₂ + 16 f₃ − 3 f₄)/12.
pub(super) const FORWARD: Stencil =
    &[(0.0, -25.0 / 12.0), (1.0, 48.0 / 12.0), (2.0, -36.0 / 12.0), (3.0, 16.0 / 12.0), (4.0, -3.0 / 12.0)];

/// A derivative, and how well two estimates of it agree.
pub(super) struct Difference {
    pub derivative: Vec<f64>,
    /// The largest entry, in the scales.
    pub largest: f64,
    /// The largest difference of two estimates of lower order, in the scales; none where it is rounding.
    pub bend: f64,
    /// The largest difference of the slopes on both sides, in the scales; none where it is rounding.
    pub lean: f64,
    /// What rounding may make, in the scales.
    pub noise: f64,
}

impl Difference {
    pub fn of(step: f64, stencil: Stencil, values: &[Vec<f64>], scales: &[f64]) -> Self {
        let length = values.iter().map(Vec::len).min().unwrap_or(0);
        let at = |i: usize| {
            let terms = stencil.iter().zip(values).map(|((_, weight), values)| weight * values[i]);
            terms.sum::<f64>() / step
        };
        let mut this =
            Self { derivative: (0..length).map(at).collect(), largest: 0.0, bend: 0.0, lean: 0.0, noise: 0.0 };
        let magnitudes = scales.iter().enumerate().take(length).map(|(i, scale)| values[0][i].abs() / scale);
        let magnitude = magnitudes.fold(0.0, f64::max);
        let least = ROUNDINGS * f64::EPSILON * magnitude;
        this.noise = rounding(magnitude / step);
        for (i, scale) in scales.iter().enumerate().take(length) {
            // Of the middle and of the whole, or of the first half and the second.
            let [narrow, wide] = match stencil.len() {
                4 => [(values[2][i] - values[1][i]) / 2.0, (values[3][i] - values[0][i]) / 4.0],
                _ => [(values[2][i] - values[0][i]) / 2.0, (values[4][i] - values[2][i]) / 2.0],
            };
            this.largest = this.largest.max(this.derivative[i].abs() / scale);
            let apart = (narrow - wide).abs() / scale;
            if apart > least {
                this.bend = this.bend.max(apart / step);
            }
            let sides = (values[3][i] - values[2][i] - values[1][i] + values[0][i]).abs() / scale;
            if sides > least && stencil.len() == 4 {
                this.lean = this.lean.max(sides / step);
            }
        }
        this
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The derivative of f at 1 by a stencil of a step.
    fn differentiate(step: f64, stencil: Stencil, f: impl Fn(f64) -> f64) -> Difference {
        let values: Vec<Vec<f64>> = stencil.iter().map(|(offset, _)| vec![f(1.0 + offset * step)]).collect();
        Difference::of(step, stencil, &values, &[1.0])
    }

    #[test]
    fn differences_are_of_fourth_order() {
        for stencil in [CENTRAL, FORWARD] {
            let error = |step: f64| (differentiate(step, stencil, |p| p.powf(-3.0)).derivative[0] + 3.0).abs();
            let order = (error(2e-2) / error(1e-2)).log2();
            println!("order {order}");
            // Of the next power of the step, a hundredth.
            assert!((order - 4.0).abs() < 0.3, "{order}");
        }
    }

    #[test]
    fn a_corner_is_seen_by_its_sides_alone() {
        let corner = differentiate(1e-4, CENTRAL, |p| (p - 1.0).max(0.0));
        assert!((corner.derivative[0] - 0.5).abs() < 1e-9 && corner.bend < 1e-9, "{}", corner.derivative[0]);
        assert!((corner.lean - 1.0).abs() < 1e-9, "{}", corner.lean);
        // Of something smooth the sides differ by 3 h f″.
        let smooth = differentiate(1e-4, CENTRAL, |p| p * p);
        assert!((smooth.lean - 6e-4).abs() < 1e-9, "{}", smooth.lean);
    }
}
