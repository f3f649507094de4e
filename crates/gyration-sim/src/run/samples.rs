//! Samples of a run: the bodies of all islands at one time, rows, the audit of each.

use super::Simulation;
use crate::looseness::Looseness;
use crate::outcome::Stop;
use crate::ports::{RunError, Sink};
use crate::rows::{Audit, Fields, Ledger};
use gyration::dynamics::exchanges;
use gyration::{Inadmissible, Quantity};

/// Bodies and pairs of bodies in the rows of a window at most: some tens of milliseconds.
const MOST_LOOKS: u64 = 4096;
/// A step may be by so much longer than it was to be: the last one before the end is.
const LONGER: f64 = 2.0;

impl Simulation {
    /// The time of sample k [s].
    pub(super) fn sample_time(&self, k: u64) -> f64 {
        self.plan.sample_time(k)
    }

    /// Ends the next window before its rows take long, though the steps behind it go farther; an island that is the
    /// whole run then needs a restart point, from which the rest of its step can be had again.
    pub(super) fn portion(&mut self) {
        let looks = self.model.bodies.len() + self.model.count_pairs()[1];
        let rows = (MOST_LOOKS / looks.max(1) as u64).max(1);
        let end = self.sample_time(self.state.next_sample + rows);
        self.portion = end;
        let is_fixed = self.partition.is_fixed();
        if let (Some(only), true) = (self.partition.islands.only(), is_fixed) {
            let size = only.integrator.next_size();
            let is_long = size == 0.0 || only.time() + LONGER * size > end;
            only.keep_restart_point(only.time() > self.state.time || is_long);
        }
    }

    /// Records the samples up to the time of the run, and the end; a sample outside the model is a stop.
    pub(super) fn sample_window(&mut self, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        let last = self.last_time();
        if let Err(stop) = self.sample_until(last, sink)? {
            return Ok(Err(stop));
        }
        if last >= self.plan.end { self.record_last(sink) } else { Ok(Ok(())) }
    }

    /// Records the samples up to a time that all bodies have come to; one outside the model is a stop.
    pub(crate) fn sample_until(&mut self, last: f64, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        while self.sample_time(self.state.next_sample) <= last {
            self.sample(self.sample_time(self.state.next_sample));
            if let Err(stop) = self.record(sink)? {
                return Ok(Err(stop));
            }
            self.state.next_sample += 1;
        }
        Ok(Ok(()))
    }

    /// Records the state at the time of the run, unless it was just sampled.
    ///
    /// # Errors
    /// [`RunError::Record`] if the row cannot be stored; within, a stop if the state is outside the model.
    pub fn record_last(&mut self, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        // Of several islands that are broken there is no state at one time.
        if self.recorded >= self.state.time || self.is_scattered() {
            return Ok(Ok(()));
        }
        self.sample(self.state.time);
        self.record(sink)
    }

    /// Samples all bodies at a time within the last steps.
    pub(super) fn sample(&mut self, time: f64) {
        let Self { partition, assembled, state, shared, .. } = self;
        assembled.begin(time, &state.settled);
        shared.with_scratch(partition.islands.iter_mut(), |island| {
            island.sample(time);
            assembled.add(island, &island.sampled);
        });
        assembled.end();
    }

    /// Finds what has come of the interval between the last sample and the time that was sampled.
    fn find_interval(&mut self) {
        let Self { model, plan, partition, assembled, state, rows, shared, .. } = self;
        let time = assembled.state.time;
        let before = state.sampled_impulses.iter().copied().chain(std::iter::repeat(0.0));
        rows.interval.impulses.clear();
        rows.interval.impulses.extend(assembled.impulses().zip(before).map(|(now, before)| now - before));
        rows.interval.peak_forces.clear();
        if plan.extras.peak_forces() {
            rows.interval.peak_forces.resize(model.bodies.len(), 0.0);
            shared.with_scratch(partition.islands.iter_mut(), |island| {
                let found = island.peaks_at(time, state.next_sample, plan);
                for (body, force) in island.members().iter().zip(found) {
                    rows.interval.peak_forces[*body] = force;
                }
            });
        }
    }

    /// Finds what any two do to each other in the state that was sampled.
    fn find_exchanges(&mut self) -> Result<(), Inadmissible> {
        let Self { model, workspace, assembled, exchanges: found, .. } = self;
        let (instant, scratch) = workspace.read(model, &assembled.state)?;
        exchanges(&instant, scratch, found)
    }

    /// Fills the row of the time that was sampled; `initial` is Σ energies at t = 0.
    fn fill(&mut self, initial: Option<f64>) -> Result<Audit, Inadmissible> {
        self.find_interval();
        let Self { model, fields, workspace, assembled, rows, .. } = self;
        fields.fill(model, workspace, &assembled.state, initial, rows)
    }

    /// The row of a time within the last steps; none where that state is outside the model.
    pub(super) fn row_at(&mut self, time: f64) -> Result<&[f64], Inadmissible> {
        self.sample(time);
        self.fill(Some(self.state.initial_energy))?;
        Ok(&self.rows.row)
    }

    /// The ledger at the time of the run.
    ///
    /// # Errors
    /// [`Stop`] if the state is outside the model, which an accepted one is not.
    pub(crate) fn ledger(&mut self) -> Result<Ledger, Stop> {
        self.sample(self.state.time);
        let initial = Some(self.state.initial_energy);
        let ledger = Ledger::of(&self.model, &mut self.workspace, &self.assembled.state, initial);
        ledger.map_err(|left| Stop::by_inadmissible(&self.model, self.state.time, &left))
    }

    /// All that a recording would hold of the time of the run.
    ///
    /// # Errors
    /// [`Stop`] if the state is outside the model, which an accepted one is not.
    pub(crate) fn row(&mut self) -> Result<Vec<f64>, Stop> {
        let time = self.state.time;
        let row = self.row_at(time).map(<[f64]>::to_vec);
        row.map_err(|left| Stop::by_inadmissible(&self.model, time, &left))
    }

    /// What the rows hold.
    pub(crate) fn fields(&self) -> &Fields {
        &self.fields
    }

    /// Records the sampled state and audits it, unless it is outside the model.
    pub(super) fn record(&mut self, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        let time = self.assembled.state.time;
        let first = self.state.next_sample == 0;
        let initial = (!first).then_some(self.state.initial_energy);
        let audit = match self.fill(initial) {
            Ok(audit) => audit,
            Err(left) => {
                self.is_broken |= left.quantity == Quantity::Interruption;
                return Ok(Err(Stop::by_inadmissible(&self.model, time, &left)));
            }
        };
        if !audit.energy.is_finite() {
            return Ok(Err(Stop::by_infinite_energy(time)));
        }
        if self.plan.pairs {
            if let Err(left) = self.find_exchanges() {
                self.is_broken |= left.quantity == Quantity::Interruption;
                return Ok(Err(Stop::by_inadmissible(&self.model, time, &left)));
            }
            sink.exchanges(&self.exchanges)?;
        }
        sink.row(time, &self.rows.row)?;
        self.recorded = time;
        self.state.sampled_impulses.clear();
        self.state.sampled_impulses.extend(self.assembled.impulses());
        if first {
            let looseness = Looseness::of(&self.model, &mut self.workspace, &self.assembled.state, self.plan.tolerance);
            self.state.looseness = looseness.unwrap_or_default();
            self.state.initial_energy = audit.energy;
        }
        let state = &mut self.state;
        state.note_residual(audit.residual);
        state.smallest_gap = state.smallest_gap.min(audit.smallest_gap);
        Ok(Ok(()))
    }
}
