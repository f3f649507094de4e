//! The largest contact force of each body since the last sample, as far as an island has come.
//!
//! It follows from the steps and the times of the samples alone: windows, threads and restarts leave no trace.

/// The largest |f| of the contacts of each body [N] in the interval that ends with a sample.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Peaks {
    /// The number of that sample.
    pub sample: u64,
    /// Of each body; empty where nobody asks for them.
    pub forces: Vec<f64>,
}

impl Peaks {
    /// Takes forces of an interval [N]: what is known of an earlier one is forgotten.
    pub fn take(&mut self, sample: u64, forces: &[f64]) {
        if self.sample != sample {
            self.forces.fill(0.0);
        }
        self.sample = sample;
        for (most, force) in self.forces.iter_mut().zip(forces) {
            *most = most.max(*force);
        }
    }

    /// Puts itself in the place of others, without allocation.
    pub fn copy_from(&mut self, other: &Self) {
        self.sample = other.sample;
        self.forces.clone_from(&other.forces);
    }

    /// The numbers of a checkpoint; none where nobody asks for them.
    pub fn bits(&self) -> impl Iterator<Item = u64> {
        let sample = (!self.forces.is_empty()).then_some(self.sample);
        sample.into_iter().chain(self.forces.iter().map(|force| force.to_bits()))
    }

    /// From the numbers of a checkpoint.
    pub fn of_bits(bits: &[u64]) -> Self {
        let Some((sample, forces)) = bits.split_first() else { return Self::default() };
        Self { sample: *sample, forces: forces.iter().map(|bits| f64::from_bits(*bits)).collect() }
    }
}
