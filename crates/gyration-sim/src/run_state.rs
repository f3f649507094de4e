//! What a run carries from step to step beside the state: the next sample, the audit, the wait for rest, what islands
//! have done that are no more.
//!
//! A checkpoint is the run state, and of each island its own and the stepper's memory, as plain little-endian numbers,
//! each list with its length before it, so that a resumed run goes on to the same bytes.

use crate::in_play::InPlay;
use crate::looseness::Looseness;
use crate::peaks::Peaks;
use crate::sum::Sum;
use gyration::ledger::Work;
use gyration_ode::{Integrator, MOST_COUNTED, Memory, Statistics};

/// The works that only take: within a body each is a quadratic form of the velocities, with a minus sign.
pub(crate) const DISSIPATION: [Work; 2] = [Work::Contraction, Work::Viscosity];

/// Beside the islands, all that the rest of a run depends on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunState {
    /// The time that all bodies have come to [s].
    pub time: f64,
    /// k of the next sample, at t = k·sample.
    pub next_sample: u64,
    /// Σ energies at t = 0 [J].
    pub initial_energy: f64,
    /// Largest |residual| of the ledger over the samples [J].
    pub largest_residual: f64,
    /// What the energies leave open at the start.
    pub(crate) looseness: Looseness,
    /// Smallest gap over the samples and closest approaches [m].
    pub smallest_gap: f64,
    /// How many events of each kind.
    pub events: [u64; 3],
    /// The impulses of all bodies at the last sample [N s]; empty where they are not asked for.
    pub(crate) sampled_impulses: Vec<f64>,
    /// What islands have done that are no more.
    pub(crate) settled: Settled,
}

/// What islands have done up to where they merged or fell apart. It belongs to the run: an island begins with works of
/// zero, so that none is lost where a part has no place for it, and none is counted twice.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Settled {
    /// The works of the run [J], in order; empty before an island ended.
    pub works: Vec<Sum>,
    pub statistics: Statistics,
}

impl Settled {
    /// Takes over what an island has done, given which of so many works of the run each of its own is.
    pub fn take(&mut self, count: usize, places: &[usize], integrator: &Integrator) {
        self.works.resize(count, Sum::default());
        for (place, work) in places.iter().zip(integrator.quadratures()) {
            self.works[*place].add(*work);
        }
        self.statistics = self.statistics.and(integrator.statistics());
    }
}

/// Beside the state, what the steps of an island change.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct IslandState {
    /// Since when all its bodies have been slow [s]; NaN if they are not.
    pub slow_since: f64,
    /// Largest correction by projection after a step.
    pub largest_projection: f64,
    /// Largest increment over a step of each work of [`DISSIPATION`] [J]: at most the error of a step; −∞ before the
    /// first.
    pub largest_gains: [f64; 2],
    /// Whether it waits to fall apart.
    pub is_parting: bool,
    /// The last significant signal of each kind for each body; NaN before there is one.
    pub signals: Vec<[f64; 3]>,
    /// The energy in play at the ends of its steps.
    pub in_play: InPlay,
    /// The largest contact forces since the last sample, where they are asked for.
    pub(crate) peaks: Peaks,
}

/// All that the rest of an island's path depends on.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct IslandMemory {
    /// Which bodies, in order.
    pub members: Vec<usize>,
    pub state: IslandState,
    pub stepper: Memory,
}

impl RunState {
    /// At the start of a run.
    pub fn new(time: f64) -> Self {
        Self { time, smallest_gap: f64::INFINITY, ..Self::default() }
    }

    /// Notes a residual of the ledger [J]; one that is not a number stays.
    pub(crate) fn note_residual(&mut self, residual: f64) {
        let size = residual.abs();
        if size > self.largest_residual || size.is_nan() {
            self.largest_residual = size;
        }
    }

    /// Run state and islands as bytes.
    pub(crate) fn checkpoint(&self, islands: impl Iterator<Item = IslandMemory>) -> Vec<u8> {
        let integers = [self.next_sample, self.events[0], self.events[1], self.events[2]];
        let Looseness { of_lengths, of_energies } = self.looseness;
        let reals = [self.time, self.initial_energy, self.largest_residual, of_lengths, of_energies, self.smallest_gap];
        let mut bytes = Vec::new();
        let mut list = |numbers: &mut dyn ExactSizeIterator<Item = u64>| put_list(&mut bytes, numbers);
        list(&mut integers.into_iter());
        let reals = [&reals[..], &self.sampled_impulses].concat();
        list(&mut reals.iter().map(|real| real.to_bits()));
        self.settled.write(&mut list);
        for island in islands {
            island.write(&mut list);
        }
        bytes
    }

    /// Reads what [`RunState::checkpoint`] wrote; `None` if it is not that.
    pub(crate) fn restore(bytes: &[u8]) -> Option<(Self, Vec<IslandMemory>)> {
        let mut rest = bytes;
        let integers: [u64; 4] = list(&mut rest)?.try_into().ok()?;
        let reals = list(&mut rest)?;
        let (reals, impulses) = reals.split_first_chunk::<6>()?;
        let [time, initial_energy, largest_residual, of_lengths, of_energies, smallest_gap] = reals.map(f64::from_bits);
        let sampled_impulses = impulses.iter().map(|bits| f64::from_bits(*bits)).collect();
        let looseness = Looseness { of_lengths, of_energies };
        let [next_sample, events @ ..] = integers;
        let settled = Settled::read(&mut rest)?;
        if !(time.is_finite() && integers.iter().all(|count| *count < MOST_COUNTED)) {
            return None;
        }
        let state = Self {
            time,
            next_sample,
            initial_energy,
            largest_residual,
            looseness,
            smallest_gap,
            events,
            sampled_impulses,
            settled,
        };
        let mut islands = Vec::new();
        while !rest.is_empty() {
            islands.push(IslandMemory::read(&mut rest)?);
        }
        Some((state, islands))
    }
}

impl Settled {
    fn write(&self, list: &mut impl FnMut(&mut dyn ExactSizeIterator<Item = u64>)) {
        let sums: Vec<[u64; 3]> = self.works.iter().map(|work| work.bits()).collect();
        list(&mut sums.as_flattened().iter().copied());
        let (counters, steps) = self.statistics.numbers();
        list(&mut counters.into_iter());
        list(&mut steps.into_iter().map(f64::to_bits));
    }

    fn read(rest: &mut &[u8]) -> Option<Self> {
        let sums = list(rest)?;
        let (sums, rest_of_sums) = sums.as_chunks::<3>();
        let works = sums.iter().map(|bits| Sum::of_bits(*bits)).collect();
        let counters: [u64; 9] = list(rest)?.try_into().ok()?;
        if counters.iter().any(|count| *count >= MOST_COUNTED) {
            return None;
        }
        let steps: [u64; 2] = list(rest)?.try_into().ok()?;
        let statistics = Statistics::of_numbers(counters, steps.map(f64::from_bits));
        rest_of_sums.is_empty().then_some(Self { works, statistics })
    }
}

impl IslandState {
    /// At the start of a run.
    pub fn new(bodies: usize) -> Self {
        let signals = vec![[f64::NAN; 3]; bodies];
        Self { slow_since: f64::NAN, largest_gains: [f64::NEG_INFINITY; 2], signals, ..Self::default() }
    }

    /// Notes what a step has added to the works of [`DISSIPATION`] [J].
    pub(crate) fn note_dissipation(&mut self, before: [f64; 2], after: [f64; 2]) {
        for (largest, (before, after)) in self.largest_gains.iter_mut().zip(before.into_iter().zip(after)) {
            *largest = largest.max(after - before);
        }
    }
}

impl IslandMemory {
    /// Puts an island in the place of what is remembered.
    pub fn remember(&mut self, state: &IslandState, integrator: &Integrator) {
        let (mut signals, mut peaks) = (std::mem::take(&mut self.state.signals), std::mem::take(&mut self.state.peaks));
        signals.clone_from(&state.signals);
        peaks.copy_from(&state.peaks);
        self.state = IslandState { signals, peaks, ..*state };
        integrator.remember(&mut self.stepper);
    }

    /// Hands its numbers to `list`, one list after the other.
    pub fn write(&self, list: &mut impl FnMut(&mut dyn ExactSizeIterator<Item = u64>)) {
        let Self { members, state, stepper } = self;
        list(&mut members.iter().map(|body| *body as u64));
        let peaks: Vec<u64> = state.peaks.bits().collect();
        list(&mut [&[u64::from(state.is_parting)][..], &peaks].concat().into_iter());
        let [first, second] = state.largest_gains;
        let reals = [[state.slow_since, state.largest_projection, first], state.in_play.numbers()];
        let reals = [reals.as_flattened(), &[second]].concat();
        list(&mut reals.iter().map(|real| real.to_bits()));
        list(&mut state.signals.as_flattened().iter().map(|real| real.to_bits()));
        list(&mut stepper.integers.iter().copied());
        list(&mut stepper.reals.iter().map(|real| real.to_bits()));
    }

    /// Reads what [`IslandMemory::write`] has handed out; `None` if it is not that.
    pub fn read(rest: &mut &[u8]) -> Option<Self> {
        let members = list(rest)?.into_iter().map(usize::try_from).collect::<Result<_, _>>().ok()?;
        let integers = list(rest)?;
        let (is_parting, peaks) = integers.split_first()?;
        let peaks = Peaks::of_bits(peaks);
        let reals: [u64; 7] = list(rest)?.try_into().ok()?;
        let [slow_since, largest_projection, first, in_play @ .., second] = reals.map(f64::from_bits);
        let (largest_gains, in_play) = ([first, second], InPlay::of_numbers(in_play));
        let signals = list(rest)?.into_iter().map(f64::from_bits).collect::<Vec<_>>();
        let (signals, rest_of_signals) = signals.as_chunks::<3>();
        if !rest_of_signals.is_empty() {
            return None;
        }
        let stepper = Memory { integers: list(rest)?, reals: list(rest)?.into_iter().map(f64::from_bits).collect() };
        let is_parting = *is_parting != 0;
        let signals = signals.to_vec();
        let state = IslandState { slow_since, largest_projection, largest_gains, is_parting, signals, in_play, peaks };
        Some(Self { members, state, stepper })
    }
}

/// Adds a list of numbers behind its length.
pub(crate) fn put_list(bytes: &mut Vec<u8>, numbers: &mut dyn ExactSizeIterator<Item = u64>) {
    bytes.extend((numbers.len() as u64).to_le_bytes());
    numbers.for_each(|number| bytes.extend(number.to_le_bytes()));
}

/// A list of numbers behind its length; none where the bytes are no such list.
pub(crate) fn list(rest: &mut &[u8]) -> Option<Vec<u64>> {
    let count = usize::try_from(take(rest)?).ok()?;
    if count > rest.len() / 8 {
        return None;
    }
    (0..count).map(|_| take(rest)).collect()
}

fn take(bytes: &mut &[u8]) -> Option<u64> {
    let (number, rest) = bytes.split_first_chunk::<8>()?;
    *bytes = rest;
    Some(u64::from_le_bytes(*number))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn island(bodies: usize, first: f64) -> IslandMemory {
        let mut state = IslandState::new(bodies);
        state.note_dissipation([-1.0, -2.0], [-1.5, -2.25]);
        state.is_parting = bodies > 1;
        state.in_play.note(3.0, &[0.25, -0.5]);
        let stepper = Memory { integers: vec![1, 2, 3], reals: vec![first, f64::INFINITY, -0.0] };
        IslandMemory { members: (0..bodies).collect(), state, stepper }
    }

    #[test]
    fn a_checkpoint_restores_every_bit() {
        let state = RunState { next_sample: 17, initial_energy: -0.1, events: [1, 2, 3], ..RunState::new(0.25) };
        let works = [[1.0, 1e-20, 0.1], [-0.0; 3]];
        let works = works.map(|terms| {
            let mut sum = Sum::default();
            terms.into_iter().for_each(|term| sum.add(term));
            sum
        });
        let statistics = Statistics { implicit_steps: 5, smallest_step: 0.1, ..Statistics::default() };
        let state = RunState { settled: Settled { works: works.to_vec(), statistics }, ..state };
        let islands = [island(2, 0.1), island(1, 0.2)];
        let bytes = state.checkpoint(islands.iter().cloned());
        let (read, read_islands) = RunState::restore(&bytes).unwrap();
        assert_eq!(read, state);
        assert_eq!(read.checkpoint(read_islands.iter().cloned()), bytes);
        assert_eq!([&read_islands[0].stepper, &read_islands[1].stepper], [&islands[0].stepper, &islands[1].stepper]);
        assert!(
            read_islands[0].state.is_parting && read_islands[0].members == [0, 1] && read_islands[1].members == [0]
        );
        assert!(read_islands[0].state.slow_since.is_nan() && read.smallest_gap == f64::INFINITY);
        assert_eq!(read_islands[1].state.largest_gains, [-0.5, -0.25]);
        assert_eq!(read_islands[0].state.in_play.numbers(), [3.0, 0.75, 0.0]);
    }

    #[test]
    fn the_step_that_takes_least_is_kept() {
        let mut state = IslandState::new(1);
        let works = [[0.0, 0.0], [-1.0, -3.0], [-1.5, -3.0], [-4.0, -2.0]];
        works.windows(2).for_each(|pair| state.note_dissipation(pair[0], pair[1]));
        assert_eq!(state.largest_gains, [-0.5, 1.0]);
    }

    #[test]
    fn a_residual_that_is_no_number_is_kept() {
        let mut state = RunState::new(0.0);
        let mut noted = |residual| {
            state.note_residual(residual);
            state.largest_residual
        };
        assert_eq!([noted(1.0), noted(-3.0), noted(2.0)], [1.0, 3.0, 3.0]);
        assert!(noted(f64::NAN).is_nan() && noted(5.0).is_nan());
    }

    #[test]
    fn damaged_checkpoints_are_refused() {
        let bytes = RunState::new(0.0).checkpoint([island(1, 1.0)].into_iter());
        // All but the one that ends with the run state: one without islands.
        let refused = |length: &usize| RunState::restore(&bytes[..*length]).is_none();
        assert_eq!((0..bytes.len()).filter(refused).count(), bytes.len() - 1);
        let mut huge = bytes;
        huge[..8].copy_from_slice(&u64::MAX.to_le_bytes());
        assert!(RunState::restore(&huge).is_none());
    }
}
