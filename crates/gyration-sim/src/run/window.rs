//! A window: every island comes to one time or beyond, and what is known of all is handed on.

use super::partition::Changing;
use super::{Simulation, is_asked};
use crate::events::FoundEvent;
use crate::island::{Effort, Island, Setting};
use crate::outcome::{Reason, Stop};
use crate::ports::{Monitor, Progress, RunError, Sink};
use gyration::{Quantity, Team};
use gyration_threads::{Interruption, in_order};
use std::num::NonZeroUsize;

/// Steps of all bodies together in a window: fewer, and windows become wider; more, and they become narrower. So a
/// window takes a part of a second, and to share it out among threads next to nothing.
const STEPS: [u64; 2] = [1 << 12, 1 << 14];
/// The parts of them that are made anew since islands change: less, and windows may become wider; more, and they become
/// narrower.
const AGAIN: [f64; 2] = [0.02, 0.1];
/// Over so many windows this is judged.
const JUDGED: u64 = 8;
/// A window becomes narrower if it holds more steps than this part of the islands: each of them is looked at.
const LOOKED_AT: u64 = 16;
/// Steps of all islands together at most before the monitor is asked again.
const MOST_STEPS: u64 = 1 << 14;
/// A window that takes more than so many times that ends before its time.
const MOST_ROUNDS: u32 = 4;
/// The first window is this part of the run, or of a sample.
const FIRST_WINDOW: f64 = 1e-6;
/// Into how many pieces of work the islands are shared out, for each thread.
const PIECES: usize = 16;

/// What the width of a window lacks, as a difference of times that are far longer.
const ROUNDING: f64 = 1e-6;

/// How wide windows are: so that they hold as many steps as [`STEPS`] says, of which few are made twice. Whatever their
/// width, the steps that stand are the same.
pub(super) struct WindowWidth {
    /// At most [s].
    most: f64,
    /// That of the last one [s].
    last: f64,
    /// The steps of windows that are judged together, and how many of these there are.
    judged: (Effort, u64),
}

impl WindowWidth {
    pub fn new(shortest: f64) -> Self {
        Self { most: FIRST_WINDOW * shortest, last: 0.0, judged: (Effort::default(), 0) }
    }

    /// The width of the next window [s], given the steps of the last one and how many islands there are.
    fn next(&mut self, effort: Effort, islands: usize) -> f64 {
        let (all, windows) = &mut self.judged;
        *all += effort;
        *windows += 1;
        let again = (all.made - all.kept) as f64 / all.made.max(1) as f64;
        let is_costly = again > AGAIN[1] && all.made * LOOKED_AT > islands as u64 * *windows;
        // One that had to end early for something else does not say that windows should be wider. The last width is a
        // difference of times.
        let is_short = effort.made < STEPS[0] && self.last >= (1.0 - ROUNDING) * self.most;
        if effort.made > STEPS[1] || is_costly {
            // One that has not come farther says nothing on how wide it should have been.
            self.most = 0.5 * if self.last > 0.0 { self.most.min(self.last) } else { self.most };
        } else if is_short && (effort.made == 0 || (*windows >= JUDGED && again < AGAIN[0])) {
            self.most *= 2.0;
        } else if *windows < 2 * JUDGED {
            return self.most;
        }
        self.judged = (Effort::default(), 0);
        self.most
    }
}

impl Simulation {
    /// Tells the monitor how far the run is, and which island holds it up: the one whose last step was the shortest.
    pub(crate) fn ask(&self, monitor: &mut dyn Monitor) -> Option<Reason> {
        let length = |island: &Island| island.report.as_ref().map_or(f64::INFINITY, |step| step.end - step.start);
        let slowest = self.partition.islands.iter().min_by(|a, b| length(a).total_cmp(&length(b)))?;
        let step = slowest.report.as_ref()?;
        let statistics = &self.statistics();
        let model = slowest.model();
        monitor.after_step(&Progress { time: self.state.time, end: self.plan.end, step, statistics, model })
    }

    /// Makes one window and hands on its events.
    pub(crate) fn step(
        &mut self,
        sink: &mut dyn Sink,
        monitor: &mut dyn Monitor,
    ) -> Result<Result<(), Stop>, RunError> {
        let before = self.state.time;
        let wanted = self.window_end(sink.wants_event_rows() || self.is_by_steps(monitor));
        let mut until = wanted;
        let (mut stop, mut rounds) = (None, 0);
        loop {
            self.reach(until, MOST_STEPS)?;
            if self.partition.islands.iter().any(|island| island.system.was_interrupted()) {
                self.is_broken = true;
                return Ok(Err(Stop::by_interruption(before)));
            }
            if let Some(found) = self.first_stop() {
                // Those that are behind it may stop earlier still.
                until = found.time;
                stop = Some(found);
            }
            let time = self.least_time();
            match self.change_islands(until, stop.is_none()) {
                Ok(false) => {}
                // What stopped there may never come to pass.
                Ok(true) => {
                    (until, stop) = (wanted, None);
                    continue;
                }
                Err(found) => {
                    until = found.time;
                    stop = Some(found);
                    continue;
                }
            }
            if time >= until {
                break;
            }
            let asked = self.asked(time, monitor)?;
            if asked.is_some() {
                stop = asked;
                break;
            }
            rounds += 1;
            if rounds == MOST_ROUNDS && stop.is_none() {
                break;
            }
        }
        let reached = until.min(self.least_time());
        if stop.is_some() || reached < until {
            self.go_back(reached)?;
        }
        let reached = self.window_reached(until);
        self.commit(reached);
        self.width.last = self.state.time - before;
        self.hand_on_events(before, sink)?;
        Ok(stop.map_or(Ok(()), Err))
    }

    /// Up to where the next window goes [s]: to the next sample or the first time of rest at most, so that both lie
    /// within the last steps of all islands. What is known of all must be so at every event where rows are wanted
    /// there: then only the islands that are behind all others make a step.
    fn window_end(&mut self, at_events: bool) -> f64 {
        let time = self.state.time;
        if self.partition.islands.len() == 1 || at_events {
            return time.next_up();
        }
        let effort = self.partition.take_effort();
        let width = self.width.next(effort, self.partition.islands.len());
        let mut until = (time + width).min(self.plan.end).min(self.sample_time(self.state.next_sample));
        if let Some(criterion) = self.plan.stop_at_rest {
            until = until.min(self.rest().unwrap_or(time + criterion.hold));
        }
        if until > time { until } else { time.next_up() }
    }

    /// Lets all islands come to a time, or make so many steps towards it, all together; on several ranks each does a
    /// share of that.
    fn reach(&mut self, until: f64, most: u64) -> Result<(), RunError> {
        if let Some(only) = self.partition.islands.only() {
            only.reach_with(self.plan.team(), until, most, &self.plan);
            return Ok(());
        }
        let count = self.partition.islands.iter().filter(|island| island.time() < until).count();
        let most = (most / count.max(1) as u64).max(1);
        let Some(shares) = self.shares(until).filter(|_| !self.is_step(until)) else {
            self.reach_of(|_| true, count, until, most);
            return Ok(());
        };
        let own = &shares[self.rank()];
        self.reach_of(|island| own.binary_search(&island.first_body()).is_ok(), own.len(), until, most);
        self.exchange(&shares)
    }

    /// The same for some of those that are behind the time, so many, each by itself.
    fn reach_of(&mut self, is_own: impl Fn(&Island) -> bool, count: usize, until: f64, most: u64) {
        let (is_step, team) = (self.is_step(until), self.plan.team());
        let (plan, shared, threads) = (&self.plan, &self.shared, self.plan.threads.unwrap_or(NonZeroUsize::MIN));
        let behind = self.partition.islands.iter_mut().filter(|island| island.time() < until && is_own(island));
        if threads.get() == 1 || count == 1 || is_step {
            return shared.with_scratch(behind, |island| island.reach_with(team, until, most, plan));
        }
        let interruption = Interruption::in_force();
        let (mut large, mut small): (Vec<&mut Island>, Vec<&mut Island>) =
            behind.partition(|island| island.is_worth_a_team());
        if large.len() >= threads.get() {
            small.append(&mut large);
        }
        if !small.is_empty() {
            let piece = small.len().div_ceil(PIECES * threads.get());
            in_order(small.chunks_mut(piece), threads, |islands| {
                let islands = islands.iter_mut().map(|island| &mut **island);
                interruption.within(|| shared.with_scratch(islands, |island| island.reach(until, most, plan)));
            });
        }
        // Those that are left are fewer than threads, which they have in equal parts.
        let Some(side_by_side) = NonZeroUsize::new(large.len()) else { return };
        let team = team.and_then(|team| Team::new(team.threads.get() / side_by_side.get(), team.each));
        in_order(large, side_by_side, |island| interruption.within(|| island.reach_with(team, until, most, plan)));
    }

    /// Carries out the earliest change of the islands, if it comes before a time; whether there was one. Where none has
    /// stopped, those that it has made follow at once to the time that all have come to, and so do the changes up to
    /// there: what a change costs then does not depend on how many islands there are.
    ///
    /// # Errors
    /// [`Stop`] where the islands cannot go on as they are to.
    fn change_islands(&mut self, until: f64, none_stopped: bool) -> Result<bool, Stop> {
        if self.partition.is_fixed() {
            return Ok(false);
        }
        let known = until.min(self.partition.known_time());
        let Self { model, start, speeds, plan, partition, state, shared, .. } = self;
        let setting = Setting { model, start, speeds, plan };
        let mut is_changed = partition.change(until, Changing { setting, settled: &mut state.settled })?;
        let any = is_changed;
        while is_changed && none_stopped {
            let made = partition.made().to_vec();
            for first in &made {
                let island = std::iter::once(&mut partition.islands[*first]);
                shared.with_scratch(island, |island| island.reach_with(plan.team(), known, MOST_STEPS, plan));
            }
            let is_there = |first: &usize| {
                let island = &partition.islands[*first];
                let has_come = island.time() >= known || island.state.is_parting;
                has_come && island.stop.is_none() && !island.system.was_interrupted()
            };
            let changing = Changing { setting, settled: &mut state.settled };
            is_changed = made.iter().all(is_there) && partition.change_again(known, until, changing)?;
        }
        Ok(any)
    }

    /// To where a window has come that went until a time [s]: where the island is that has come least far, but not
    /// beyond what it was to see, since islands may change there, nor beyond its portion of rows.
    fn window_reached(&mut self, until: f64) -> f64 {
        let only_steps = self.partition.islands.only().is_some_and(|only| only.restart_point.is_none());
        let least = self.least_time().min(if only_steps { f64::INFINITY } else { self.portion });
        match (self.partition.is_fixed(), self.is_step(until)) {
            (true, _) => least,
            (false, true) => least.min(self.partition.change_time(&self.model)),
            (false, false) => least.min(until),
        }
    }

    /// The stop that comes first, if any; of several at one time that of the first body. An interruption is where the
    /// island is that has come least far, unless that one cannot go on.
    fn first_stop(&mut self) -> Option<Stop> {
        let least = self.least_time();
        let (mut first, mut asked): (Option<Stop>, Option<Stop>) = (None, None);
        for stop in self.partition.islands.iter_mut().filter_map(|island| island.stop.take()) {
            if is_asked(&stop) {
                asked = asked.or(Some(stop));
            } else if first.as_ref().is_none_or(|first| stop.time < first.time) {
                first = Some(stop);
            }
        }
        match (first, asked) {
            (Some(first), Some(asked)) if first.time > least => Some(Stop { time: least, ..asked }),
            (None, Some(asked)) => Some(Stop { time: least, ..asked }),
            (first, _) => first,
        }
    }

    /// The time of the island that has come least far [s]; the end if nothing moves.
    pub(super) fn least_time(&self) -> f64 {
        self.partition.least_time().unwrap_or(self.plan.end)
    }

    /// Undoes what islands have done in this window beyond the step that reaches a time to which all have come.
    fn go_back(&mut self, time: f64) -> Result<(), RunError> {
        for island in self.partition.islands.iter_mut().filter(|island| island.time() > time) {
            island.go_back(&self.plan, self.state.time);
        }
        // They have been there once.
        Interruption::default().within(|| self.reach(time, u64::MAX))
    }

    /// Whether a window that goes until a time is one step of the islands that have come least far.
    pub(super) fn is_step(&self, until: f64) -> bool {
        until == self.state.time.next_up()
    }

    /// A time that all islands have come to is that of the run.
    pub(super) fn commit(&mut self, time: f64) {
        self.state.time = time;
        for island in self.partition.islands.iter_mut() {
            island.commit(self.state.time);
        }
    }

    /// Hands on the events up to the time of the run, in order of time and body.
    fn hand_on_events(&mut self, before: f64, sink: &mut dyn Sink) -> Result<(), RunError> {
        let mut found = std::mem::take(&mut self.found);
        found.clear();
        let time = self.last_time();
        for island in self.partition.islands.iter_mut() {
            let known = island.events.partition_point(|found| found.event.time <= time);
            found.extend(island.events.drain(..known));
        }
        debug_assert!(found.iter().all(|found| found.event.time >= before));
        // In place: nothing is allocated.
        found.sort_unstable_by(|a, b| a.event.in_order(&b.event));
        for FoundEvent { event, gap } in &found {
            self.state.events[event.kind] += 1;
            self.state.smallest_gap = self.state.smallest_gap.min(*gap);
            sink.event(event)?;
            if sink.wants_event_rows() {
                match self.row_at(event.time) {
                    Ok(row) => sink.event_row(event, row)?,
                    Err(left) => self.is_broken |= left.quantity == Quantity::Interruption,
                }
            }
        }
        self.found = found;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The steps of the last window and the width of the next, where so many steps are made a second of which a part is
    /// made anew for each second of the window, of 1,600 islands; a sample ends each window after 0.1 s.
    fn settled(rate: f64, again: f64, width: &mut WindowWidth) -> (u64, f64) {
        let mut effort = Effort::default();
        for _ in 0..5000 {
            width.last = width.next(effort, 1600).min(0.1);
            let kept = rate * width.last;
            effort = Effort { made: (kept * (1.0 + again * width.last)) as u64, kept: kept as u64 };
        }
        (effort.made, width.most)
    }

    #[test]
    fn windows_hold_so_many_steps_whatever_else_ends_them() {
        let mut width = WindowWidth::new(0.1);
        assert!((STEPS[0]..=STEPS[1]).contains(&settled(1e6, 0.0, &mut width).0));
        // Quiet for long: the sample alone ends windows, which do not grow without bound meanwhile.
        assert!(settled(10.0, 0.0, &mut width).1 <= 0.2);
        assert!((STEPS[0]..=STEPS[1]).contains(&settled(1e7, 0.0, &mut width).0));
    }

    #[test]
    fn windows_are_so_narrow_that_little_is_done_anew() {
        let mut width = WindowWidth::new(0.1);
        let (steps, wide) = settled(1e6, 100.0, &mut width);
        assert!(wide * 100.0 < 0.12 && steps >= 30, "{steps} in {wide} s");
        // Not so narrow that there is more to look at than to do.
        let (steps, wide) = settled(1e5, 1e4, &mut width);
        assert!(wide * 1e4 > 0.12 && (50..=200).contains(&steps), "{steps} in {wide} s");
        let (_, wide) = settled(1e4, 0.0, &mut width);
        assert!(wide >= 0.1, "{wide} s");
    }
}
