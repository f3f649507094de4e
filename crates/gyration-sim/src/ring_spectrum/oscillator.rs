//! Frequency and decay of a wave from samples of its amplitude, and of that of the wave that runs against it.
//!
//!   s = (a, p) = ½ (q ± i q̇/ω̃),   s(t + τ) = Φ s(t),   Φ = (Σ s(t + τ) s(t)ᴴ)(Σ s(t) s(t)ᴴ)⁻¹,   μ = e^{(−δ ± iω)τ}
//!
//! Φ is the map that takes samples to the next ones, best in least squares, μ its eigenvalue nearest to what leads from
//! a to a. Of q̈ + 2δq̇ + ω₀²q = 0 it is exact, whatever the start and ω̃: ω² = ω₀² − δ². Where p is nothing, or goes
//! with a in step, μ = Σ a(t + τ) a(t)*/Σ |a|², which is exact too. Of a motion that noise keeps going it is that of
//! the regression of first order, whose correlations fall as e^{−δt}.
//!
//! Source: G. E. P. Box and G. M. Jenkins, *Time Series Analysis* (1970).

use nalgebra::{Complex, ComplexField, Matrix2, Vector2};

type C64 = Complex<f64>;

/// Samples of which there are a frequency and a decay: fewer are fitted by any.
const FEWEST: usize = 3;
/// One less the square of a correlation, below which two go in step: rounding would be as large as what is left out.
const IN_STEP: f64 = 1e-8;
/// Eigenvalues as near as this to one number are as near as one another.
const AS_NEAR: f64 = 1e-6;
/// What turns by less than this from sample to sample [rad] does not turn.
const LEAST_TURN: f64 = 1e-8;

/// Sums over pairs of samples.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Oscillator {
    now: Matrix2<C64>,
    next: Matrix2<C64>,
    pairs: usize,
}

/// How it swings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Swing {
    /// ω [rad/s]; zero where it creeps or grows without swinging.
    pub omega: f64,
    /// δ [1/s], the smaller of two; negative where it grows.
    pub width: f64,
}

/// a and p, in any unit.
pub(super) type Sample = Vector2<C64>;

impl Oscillator {
    /// Takes in a sample and the next.
    pub fn add(&mut self, now: &Sample, next: &Sample) {
        self.now += now * now.adjoint();
        self.next += next * now.adjoint();
        self.pairs += 1;
    }

    /// ω and δ from samples so far apart [s]; none of too few, or if no oscillator moves like this. A part of Σ |a|²
    /// below this is no motion.
    pub fn swing(&self, apart: f64, noise: f64) -> Option<Swing> {
        let [own, other] = [self.now[(0, 0)].re, self.now[(1, 1)].re];
        if self.pairs + 1 < FEWEST || own <= 0.0 {
            return None;
        }
        let correlation = self.now[(0, 1)].norm_sqr() / (own * other);
        let factor = match other > noise * own && 1.0 - correlation > IN_STEP {
            true => self.nearest()?,
            false => self.next[(0, 0)] / own,
        };
        let turned = libm::atan2(factor.im, factor.re).abs();
        let omega = if turned < LEAST_TURN { 0.0 } else { turned / apart };
        let width = -libm::log(factor.modulus()) / apart;
        width.is_finite().then_some(Swing { omega, width })
    }

    /// The eigenvalue of Φ nearest to Φ₁₁; of two as near the larger.
    fn nearest(&self) -> Option<C64> {
        // Both amplitudes in units of their own: one may be far smaller.
        let scales = [0, 1].map(|k| 1.0 / libm::sqrt(self.now[(k, k)].re));
        let scaled = |matrix: &Matrix2<C64>| Matrix2::from_fn(|i, j| matrix[(i, j)] * (scales[i] * scales[j]));
        let map = scaled(&self.next) * scaled(&self.now).try_inverse()?;
        let (half, product) = (map.trace() * 0.5, map.determinant());
        let apart = root(half * half - product);
        let values = [half + apart, half - apart];
        let away = values.map(|value| (value - map[(0, 0)]).modulus());
        let first = match (away[0] - away[1]).abs() > AS_NEAR * (away[0] + away[1]) {
            true => away[0] < away[1],
            false => values[0].modulus() >= values[1].modulus(),
        };
        Some(values[usize::from(!first)])
    }
}

/// A square root.
fn root(square: C64) -> C64 {
    let part = libm::sqrt(0.5 * (square.modulus() + square.re.abs()));
    if part == 0.0 {
        return square;
    }
    // The smaller part by what it is with the larger.
    let other = 0.5 * square.im / part;
    if square.re < 0.0 { C64::new(other, part) } else { C64::new(part, other) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples of q and q̇ as those of ω̃ = 3.
    fn sample([q, rate]: [C64; 2]) -> Sample {
        let turned = C64::new(0.0, 1.0 / 3.0) * rate;
        Sample::new(q + turned, q - turned)
    }

    /// Samples of α e^{λt} + β e^{λ*t}.
    fn samples(root: C64, parts: [C64; 2], apart: f64, count: usize) -> Vec<Sample> {
        let at = |n: usize| {
            let t = n as f64 * apart;
            let [one, other] = [root, root.conj()].map(|root| (root * t).exp());
            let [a, b] = [parts[0] * one, parts[1] * other];
            sample([a + b, a * root + b * root.conj()])
        };
        (0..count).map(at).collect()
    }

    fn found(samples: &[Sample], apart: f64) -> Option<Swing> {
        let mut sums = Oscillator::default();
        samples.windows(2).for_each(|pair| sums.add(&pair[0], &pair[1]));
        sums.swing(apart, 1e-20)
    }

    #[test]
    fn a_damped_oscillator_has_its_frequency_and_decay_from_any_start() {
        let both = [C64::new(0.3, -0.2), C64::new(0.01, 0.4)];
        let zero = C64::new(0.0, 0.0);
        for parts in [both, [both[0], zero], [zero, both[1]], [both[1], both[1].conj()], [both[0] * 1e-9, both[1]]] {
            let swing = found(&samples(C64::new(-0.4, 7.0), parts, 0.1, 40), 0.1).unwrap();
            assert!((swing.omega - 7.0).abs() < 1e-7 && (swing.width - 0.4).abs() < 1e-7, "{parts:?} {swing:?}");
        }
        let grows = found(&samples(C64::new(0.2, 3.0), both, 0.1, 5), 0.1).unwrap();
        assert!((grows.width + 0.2).abs() < 1e-12, "{grows:?}");
    }

    #[test]
    fn waves_against_one_another_are_told_apart() {
        // a turns with 3 and p, a hundred times weaker, with 5 rad/s the other way round.
        let turned = |rate: f64, n: i32| (C64::new(0.0, rate) * (0.1 * f64::from(n))).exp();
        let both: Vec<Sample> = (0..200).map(|n| Sample::new(turned(-3.0, n), turned(5.0, n) * 0.01)).collect();
        assert!((found(&both, 0.1).unwrap().omega - 3.0).abs() < 1e-12);
        let back: Vec<Sample> = both.iter().map(|it| Sample::new(it.y.conj(), it.x.conj())).collect();
        assert!((found(&back, 0.1).unwrap().omega - 5.0).abs() < 1e-12);
    }

    #[test]
    fn what_creeps_has_the_slower_of_its_rates() {
        let creep = |t: f64| (-0.5 * t).exp() + 0.3 * (-4.0 * t).exp();
        let rate = |t: f64| -0.5 * (-0.5 * t).exp() - 1.2 * (-4.0 * t).exp();
        let at = |n: i32| sample([creep(0.1 * f64::from(n)), rate(0.1 * f64::from(n))].map(|x| C64::new(x, 0.0)));
        let swing = found(&(0..30).map(at).collect::<Vec<_>>(), 0.1).unwrap();
        assert!(swing.omega == 0.0 && (swing.width - 0.5).abs() < 1e-10, "{swing:?}");
        let alone: Vec<Sample> = (0..30)
            .map(|n| (-0.05 * f64::from(n)).exp())
            .map(|x| sample([C64::new(x, 0.0), C64::new(-0.5 * x, 0.0)]))
            .collect();
        let swing = found(&alone, 0.1).unwrap();
        assert!(swing.omega == 0.0 && (swing.width - 0.5).abs() < 1e-12, "{swing:?}");
    }

    #[test]
    fn two_samples_tell_no_frequency() {
        let two = samples(C64::new(0.0, 1.0), [C64::new(1.0, 0.0), C64::new(0.0, 0.0)], 0.1, 2);
        assert_eq!(found(&two, 0.1), None);
    }
}
