//! Vectors of the stages of a step, one for each, and linear combinations of them.

use std::ops::Range;

/// Vectors of equal length, one for each stage, one after the other.
#[derive(Debug, Clone, Default)]
pub(crate) struct StageVectors {
    numbers: Vec<f64>,
    stages: usize,
    length: usize,
}

impl StageVectors {
    /// These numbers, of so many stages.
    pub fn of(numbers: Vec<f64>, stages: usize) -> Self {
        let length = numbers.len() / stages;
        Self { numbers, stages, length }
    }

    /// Room for vectors of this length; what stands there stays if they had it already.
    pub fn resize(&mut self, stages: usize, length: usize) {
        self.numbers.resize(stages * length, 0.0);
        (self.stages, self.length) = (stages, length);
    }

    /// The number of stages.
    pub fn stages(&self) -> usize {
        self.stages
    }

    /// All numbers.
    pub fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// All numbers, to be changed.
    pub fn numbers_mut(&mut self) -> &mut [f64] {
        &mut self.numbers
    }

    /// The vector of a stage.
    pub fn stage(&self, i: usize) -> &[f64] {
        &self.numbers[i * self.length..(i + 1) * self.length]
    }

    /// The vector of a stage, to be changed.
    pub fn stage_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.numbers[i * self.length..(i + 1) * self.length]
    }

    /// The vectors of two stages, one after the other, to be changed.
    pub fn pair_mut(&mut self, i: usize) -> (&mut [f64], &mut [f64]) {
        self.numbers[i * self.length..(i + 2) * self.length].split_at_mut(self.length)
    }

    /// x_i = Σ_j m_ij y_j within a range of components.
    pub fn set_product(&mut self, matrix: &[f64], vectors: &Self, range: Range<usize>) {
        for (i, row) in matrix.chunks_exact(self.stages).enumerate() {
            combine(row, vectors, range.clone(), &mut self.stage_mut(i)[range.clone()]);
        }
    }

    /// x_i ← x_i + y_i within a range of components.
    pub fn add(&mut self, vectors: &Self, range: Range<usize>) {
        for i in 0..self.stages {
            for (sum, part) in self.stage_mut(i)[range.clone()].iter_mut().zip(&vectors.stage(i)[range.clone()]) {
                *sum += part;
            }
        }
    }
}

/// Σ_j w_j y_j within a range of components.
pub(crate) fn combine(weights: &[f64], vectors: &StageVectors, range: Range<usize>, sum: &mut [f64]) {
    for (j, weight) in weights.iter().enumerate() {
        let parts = sum.iter_mut().zip(&vectors.stage(j)[range.clone()]);
        if j == 0 {
            parts.for_each(|(sum, part)| *sum = weight * part);
        } else {
            parts.for_each(|(sum, part)| *sum += weight * part);
        }
    }
}
