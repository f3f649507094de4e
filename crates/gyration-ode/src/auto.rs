//! Which stepper advances further for its cost.
//!
//!   explicit → implicit:  h|λ| > 3.7 or −h Re λ > 1.5 in 10 of the last 16 steps (the boundary of stability is at 4.6)
//!   implicit → explicit:  min(2.2/ρ(J), h_max)/17 > 2 h/cost in 6 of the last 8 steps
//!
//! An explicit method on a stiff problem is held at the boundary of stability by its error control, whatever the
//! accuracy asked for; that is seen from the last two stages at no cost. Back, the spectral radius ρ of the known
//! Jacobian says how far the explicit method could step. A short, violent bounce is no stiff problem: its steps are
//! short for accuracy, and h|λ| stays small. A change that is taken back soon was a mistake: each such doubles the
//! number of explicit steps to be made before the next. Counts, not clocks, decide: a run repeats itself.

use nalgebra::DMatrix;

use crate::report::{Statistics, Stepper};
use crate::system::Layout;

/// h ρ(J) that an explicit step can be expected to reach, between what accuracy and what stability allow.
pub(crate) const EXPLICIT_REACH: f64 = 2.2;
/// Explicit steps that vote, and the votes that decide.
const EXPLICIT_VOTES: (u32, u32) = (16, 10);
/// Implicit steps that vote, and the votes that decide.
const IMPLICIT_VOTES: (u32, u32) = (8, 6);
/// Evaluations of an explicit step.
const EXPLICIT_COST: f64 = 17.0;
/// An analytic Jacobian in evaluations, which shares its integrals with the rates: measured at 1.5 (ellipsoid) to 2.9
/// (box) of them.
const JACOBIAN_COST: f64 = 2.5;
/// Factorizing and solving for a body of thirteen unknowns, and all else that an implicit step does itself, in
/// evaluations: measured at 1 (torus) to 6 (box), 4 to 5 µs. Both by `bench/benches/steppers.rs`.
const LINEAR_COST: f64 = 5.0;
/// The explicit method must promise to be cheaper by this factor: costs and spectral radius are rough.
const ADVANTAGE: f64 = 2.0;
/// An implicit stretch shorter than this was a mistake.
const SHORT_STAY: u64 = 32;
/// The first number of explicit steps barred after a mistake, and how often it may double.
const BAR: (u64, u64) = (32, 7);
/// Applications of the Jacobian that let the largest eigenvalues prevail, and those over which growth is measured.
const POWER_ITERATIONS: (usize, usize) = (4, 8);

/// The state of the decision; plain numbers, part of a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Switch {
    /// The last votes for the other stepper, the newest in the lowest bit.
    pub votes: u64,
    /// Steps since the last change.
    pub stay: u64,
    /// Explicit steps that must pass before a change is considered.
    pub bar: u64,
    /// Mistakes in a row.
    pub patience: u64,
}

impl Switch {
    /// After an explicit step: whether the implicit method should take over.
    pub fn leave_explicit(&mut self, stiffness: f64) -> bool {
        self.stay += 1;
        if self.bar > 0 {
            self.bar -= 1;
            return false;
        }
        self.vote(stiffness > 1.0, EXPLICIT_VOTES)
    }

    /// After an implicit step: whether the explicit method should take over.
    pub fn leave_implicit(&mut self, spectral_radius: f64, h: f64, max_step: f64, evaluations: u64) -> bool {
        self.stay += 1;
        if self.stay == SHORT_STAY {
            self.patience = 0;
        }
        self.vote(explicit_is_cheaper(spectral_radius, h, max_step, evaluations), IMPLICIT_VOTES)
    }

    /// Records the change to a stepper.
    pub fn change(&mut self, to: Stepper, statistics: &mut Statistics) {
        statistics.switches += 1;
        self.bar = 0;
        if to == Stepper::Explicit && self.stay < SHORT_STAY {
            self.bar = BAR.0 << self.patience;
            self.patience = (self.patience + 1).min(BAR.1);
        }
        (self.votes, self.stay) = (0, 0);
    }

    fn vote(&mut self, against: bool, (window, decisive): (u32, u32)) -> bool {
        self.votes = ((self.votes << 1) | u64::from(against)) & ((1 << window) - 1);
        self.votes.count_ones() >= decisive
    }
}

/// Whether the explicit method promises to advance further for its cost than an implicit step of size h has done.
pub(crate) fn explicit_is_cheaper(spectral_radius: f64, h: f64, max_step: f64, evaluations: u64) -> bool {
    let explicit = (EXPLICIT_REACH / spectral_radius).min(max_step) / EXPLICIT_COST;
    let implicit = h / (evaluations as f64 + JACOBIAN_COST + LINEAR_COST);
    explicit > ADVANTAGE * implicit
}

/// A lower bound of the spectral radius for next to nothing: ρ ≥ |tr J|/n, the largest over the blocks.
pub(crate) fn least_spectral_radius(jacobian: &[DMatrix<f64>]) -> f64 {
    let blocks = jacobian.iter().filter(|matrix| !matrix.is_empty());
    blocks.map(|matrix| matrix.trace().abs() / matrix.nrows() as f64).fold(0.0, f64::max)
}

/// The spectral radius of the Jacobian, the largest over its blocks, by the power method.
///
///   ρ ≈ (‖J^(m+k) v‖/‖J^m v‖)^(1/k)
///
/// in components relative to their scales, which makes unlike units comparable; the mean over k applications irons
/// out what a complex pair does to the norm. The start is fixed and has no symmetry. A nilpotent block (free flight)
/// gives 0. An estimate, good to a factor of two.
pub(crate) fn spectral_radius(jacobian: &[DMatrix<f64>], layout: &Layout, scale: &[f64], work: &mut [f64]) -> f64 {
    let mut largest: f64 = 0.0;
    for (matrix, block) in jacobian.iter().zip(layout.blocks()) {
        let (vector, rest) = work.split_at_mut(block.len());
        let growth = power_growth(matrix, &scale[block.clone()], vector, &mut rest[..block.len()]);
        largest = largest.max(growth);
    }
    largest
}

fn power_growth(matrix: &DMatrix<f64>, scale: &[f64], vector: &mut [f64], image: &mut [f64]) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    for (i, value) in vector.iter_mut().enumerate() {
        *value = 0.5 + (GOLDEN * (i + 1) as f64).fract();
    }
    let (settle, measure) = POWER_ITERATIONS;
    let mut logarithm = 0.0;
    for iteration in 0..settle + measure {
        image.fill(0.0);
        for (j, value) in vector.iter().enumerate() {
            // A freed component has scale +∞: it does not take part.
            let weight = if scale[j].is_finite() { value * scale[j] } else { 0.0 };
            for (i, sum) in image.iter_mut().enumerate() {
                *sum += matrix[(i, j)] * weight;
            }
        }
        for (sum, scale) in image.iter_mut().zip(scale) {
            *sum /= scale;
        }
        let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let growth = size(image) / size(vector);
        if growth == 0.0 || !growth.is_finite() {
            return growth.abs();
        }
        if iteration >= settle {
            logarithm += growth.ln();
        }
        let norm = size(image);
        for (value, sum) in vector.iter_mut().zip(image.iter()) {
            *value = sum / norm;
        }
    }
    (logarithm / measure as f64).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn radius(matrix: DMatrix<f64>, scale: &[f64]) -> f64 {
        let n = matrix.nrows();
        let blocks = 0..n;
        let layout = Layout { dimension: n, width: n, groups: vec![blocks], blocks: 1 };
        spectral_radius(&[matrix], &layout, scale, &mut vec![0.0; 2 * n])
    }

    #[test]
    fn spectral_radius_of_real_spectra_is_found() {
        let rho = radius(DMatrix::from_diagonal(&nalgebra::DVector::from_vec(vec![-1.0, -1e6, 20.0])), &[1.0; 3]);
        assert!((rho / 1e6 - 1.0).abs() < 1e-9, "{rho}");
    }

    /// An oscillator in units that differ by its frequency: eigenvalues ±iω; relative to the scales the matrix is normal.
    #[test]
    fn spectral_radius_of_an_oscillator_is_its_frequency() {
        let omega = 1e4;
        let oscillator = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, -omega * omega, 0.0]);
        let rho = radius(oscillator.clone(), &[1e-9, 1e-5]);
        assert!((rho / omega - 1.0).abs() < 1e-9, "{rho}");
        // Even with scales off by a hundred, a factor of two holds.
        let rho = radius(oscillator, &[1e-9, 1e-7]);
        assert!((0.5..2.0).contains(&(rho / omega)), "{rho}");
    }

    #[test]
    fn free_flight_has_no_stiffness() {
        assert_eq!(radius(DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, 0.0]), &[1.0, 1.0]), 0.0);
    }

    #[test]
    fn the_lower_bound_is_below_the_spectral_radius() {
        for trial in 0..20 {
            let entry = |i: usize, j: usize| ((trial * 31 + i * 7 + j * 13) as f64).sin() - f64::from(u8::from(i == j));
            let matrix = DMatrix::from_fn(5, 5, entry);
            let exact = matrix.complex_eigenvalues().iter().map(|value| value.norm()).fold(0.0, f64::max);
            let least = least_spectral_radius(&[DMatrix::zeros(0, 0), matrix]);
            assert!(least > 0.0 && least <= exact, "{least} {exact}");
        }
    }

    #[test]
    fn a_change_taken_back_bars_the_next_ever_longer() {
        let (mut switch, mut statistics) = (Switch::default(), Statistics::default());
        let mut explicit_steps = Vec::new();
        for _ in 0..4 {
            let mut steps = 1;
            while !switch.leave_explicit(6.0) {
                steps += 1;
            }
            explicit_steps.push(steps);
            switch.change(Stepper::Implicit, &mut statistics);
            while !switch.leave_implicit(1.0, 0.1, 1.0, 10) {}
            switch.change(Stepper::Explicit, &mut statistics);
        }
        assert_eq!(explicit_steps, [10, 42, 74, 138]);
        assert_eq!(statistics.switches, 8);
    }
}
