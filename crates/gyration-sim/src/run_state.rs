//! What a run carries from step to step beside the state: the next sample, the audit, the wait for rest.
//!
//! A checkpoint is the run state and the stepper's memory as plain little-endian numbers, each list with its length
//! before it, so that a resumed run goes on to the same bytes.

use gyration::ledger::Work;
use gyration_ode::Memory;

/// The works that only take: within a body each is a quadratic form of the velocities, with a minus sign.
pub(crate) const DISSIPATION: [Work; 2] = [Work::Contraction, Work::Viscosity];

/// Beside the state, all that the rest of a run depends on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunState {
    /// k of the next sample, at t = k·sample.
    pub next_sample: u64,
    /// Σ energies at t = 0 [J].
    pub initial_energy: f64,
    /// Since when all bodies have been slow [s]; NaN if they are not.
    pub slow_since: f64,
    /// Largest |residual| of the ledger over the samples [J].
    pub largest_residual: f64,
    /// The energy in play [J]: the largest kinetic energy, or sum of |works|, over the samples.
    pub energy_in_play: f64,
    /// Smallest gap over the samples [m].
    pub smallest_gap: f64,
    /// Largest correction by projection after a step.
    pub largest_projection: f64,
    /// Largest increment over a step of each work of [`DISSIPATION`] [J]: at most the error of a step; −∞ before the
    /// first.
    pub largest_gains: [f64; 2],
    /// How many events of each kind.
    pub events: [u64; 3],
    /// The last significant signal of each kind for each body; NaN before there is one.
    pub signals: Vec<[f64; 3]>,
}

impl RunState {
    /// At the start of a run.
    pub fn new(bodies: usize) -> Self {
        let signals = vec![[f64::NAN; 3]; bodies];
        let (slow_since, smallest_gap) = (f64::NAN, f64::INFINITY);
        Self { slow_since, smallest_gap, largest_gains: [f64::NEG_INFINITY; 2], signals, ..Self::default() }
    }

    /// Notes what a step has added to the works of [`DISSIPATION`] [J].
    pub(crate) fn note_dissipation(&mut self, before: [f64; 2], after: [f64; 2]) {
        for (largest, (before, after)) in self.largest_gains.iter_mut().zip(before.into_iter().zip(after)) {
            *largest = largest.max(after - before);
        }
    }

    /// Notes a residual of the ledger [J]; one that is not a number stays.
    pub(crate) fn note_residual(&mut self, residual: f64) {
        let size = residual.abs();
        if size > self.largest_residual || size.is_nan() {
            self.largest_residual = size;
        }
    }

    /// Run state and memory as bytes.
    pub fn checkpoint(&self, memory: &Memory) -> Vec<u8> {
        let integers = [self.next_sample, self.events[0], self.events[1], self.events[2]];
        let reals = [
            self.initial_energy,
            self.slow_since,
            self.largest_residual,
            self.energy_in_play,
            self.smallest_gap,
            self.largest_projection,
            self.largest_gains[0],
            self.largest_gains[1],
        ];
        let mut bytes = Vec::new();
        let mut list = |numbers: &mut dyn ExactSizeIterator<Item = u64>| {
            bytes.extend((numbers.len() as u64).to_le_bytes());
            numbers.for_each(|number| bytes.extend(number.to_le_bytes()));
        };
        list(&mut integers.into_iter());
        list(&mut reals.iter().map(|real| real.to_bits()));
        list(&mut self.signals.as_flattened().iter().map(|real| real.to_bits()));
        list(&mut memory.integers.iter().copied());
        list(&mut memory.reals.iter().map(|real| real.to_bits()));
        bytes
    }

    /// Reads what [`RunState::checkpoint`] wrote; `None` if it is not that.
    pub fn restore(bytes: &[u8]) -> Option<(Self, Memory)> {
        let mut rest = bytes;
        let mut list = || {
            let count = usize::try_from(take(&mut rest)?).ok()?;
            if count > rest.len() / 8 {
                return None;
            }
            (0..count).map(|_| take(&mut rest)).collect::<Option<Vec<u64>>>()
        };
        let integers: [u64; 4] = list()?.try_into().ok()?;
        let reals: [u64; 8] = list()?.try_into().ok()?;
        let signals = list()?.into_iter().map(f64::from_bits).collect::<Vec<_>>();
        let (signals, rest_of_signals) = signals.as_chunks::<3>();
        if !rest_of_signals.is_empty() {
            return None;
        }
        let memory = Memory { integers: list()?, reals: list()?.into_iter().map(f64::from_bits).collect() };
        let [
            initial_energy,
            slow_since,
            largest_residual,
            energy_in_play,
            smallest_gap,
            largest_projection,
            gains @ ..,
        ] = reals.map(f64::from_bits);
        let state = Self {
            next_sample: integers[0],
            initial_energy,
            slow_since,
            largest_residual,
            energy_in_play,
            smallest_gap,
            largest_projection,
            largest_gains: gains,
            events: [integers[1], integers[2], integers[3]],
            signals: signals.to_vec(),
        };
        rest.is_empty().then_some((state, memory))
    }
}

fn take(bytes: &mut &[u8]) -> Option<u64> {
    let (number, rest) = bytes.split_first_chunk::<8>()?;
    *bytes = rest;
    Some(u64::from_le_bytes(*number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_checkpoint_restores_every_bit() {
        let mut state = RunState { next_sample: 17, initial_energy: -0.1, events: [1, 2, 3], ..RunState::new(2) };
        state.note_dissipation([-1.0, -2.0], [-1.5, -2.25]);
        let memory = Memory { integers: vec![1, 2, 3], reals: vec![0.1, f64::INFINITY, -0.0] };
        let bytes = state.checkpoint(&memory);
        let (read, read_memory) = RunState::restore(&bytes).unwrap();
        assert_eq!(read.checkpoint(&read_memory), bytes);
        assert_eq!(read_memory, memory);
        assert!(read.slow_since.is_nan() && read.smallest_gap == f64::INFINITY);
        assert_eq!(read.largest_gains, [-0.5, -0.25]);
    }

    #[test]
    fn the_step_that_takes_least_is_kept() {
        let mut state = RunState::new(1);
        let works = [[0.0, 0.0], [-1.0, -3.0], [-1.5, -3.0], [-4.0, -2.0]];
        works.windows(2).for_each(|pair| state.note_dissipation(pair[0], pair[1]));
        assert_eq!(state.largest_gains, [-0.5, 1.0]);
    }

    #[test]
    fn a_residual_that_is_no_number_is_kept() {
        let mut state = RunState::new(1);
        let mut noted = |residual| {
            state.note_residual(residual);
            state.largest_residual
        };
        assert_eq!([noted(1.0), noted(-3.0), noted(2.0)], [1.0, 3.0, 3.0]);
        assert!(noted(f64::NAN).is_nan() && noted(5.0).is_nan());
    }

    #[test]
    fn damaged_checkpoints_are_refused() {
        let bytes = RunState::new(1).checkpoint(&Memory { integers: vec![4], reals: vec![1.0] });
        assert!((0..bytes.len()).all(|length| RunState::restore(&bytes[..length]).is_none()));
        let mut huge = bytes;
        huge[..8].copy_from_slice(&u64::MAX.to_le_bytes());
        assert!(RunState::restore(&huge).is_none());
    }
}
