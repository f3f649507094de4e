//! Detects the events of a step.
//!
//! The signals are looked at on the quarters of the step, on its interpolant, which costs no evaluation of the rates.
//! Where one changes its sign from a significant value to another, the crossing is closed in. Neither the steps nor the
//! samples have a part in this.

use crate::events::{self, APEX, Event, LIFT_OFF, Signals};
use crate::ports::{RunError, Sink};
use crate::run::Simulation;
use crate::step_end::StepEnd;
use gyration::balance::observe;
use gyration::dynamics::acting;
use gyration::state::{BodyMotion, State};
use gyration_ode::{CrossingDirection, StepReport, find_crossing};

/// On how many parts of a step an event is looked for.
const PARTS: usize = 4;

impl Simulation<'_> {
    /// The signals of a body after the last step, once the forces there are known.
    pub(crate) fn signals(&mut self, body: usize) -> Signals {
        let (model, time) = (self.system.model(), self.run.integrator.time());
        let (motion, speed) = (self.run.step_ends[body].motion, self.system.speed_scale(body));
        let [apex, approach] = self.motion_signals(body, time, &motion);
        [apex, approach, events::lift_off(model, body, self.run.forces[body], speed)]
    }

    /// |f| of the contacts of every body after the last step [N]: from its balance where nothing else pulls at it, else by
    /// integration; NaN without contacts.
    pub(crate) fn find_forces(&mut self) {
        let model = self.system.model();
        self.run.forces.clear();
        let balanced = |(body, end): (usize, &StepEnd)| end.contact_force(model, body).unwrap_or(f64::NAN);
        self.run.forces.extend(self.run.step_ends.iter().enumerate().map(balanced));
        let unknown = |body: usize, force: f64| force.is_nan() && !model.bodies[body].contacts.is_empty();
        if !(0..self.run.forces.len()).any(|body| unknown(body, self.run.forces[body])) {
            return;
        }
        self.sample_end();
        let Ok((instant, scratch)) = self.system.workspace().read(model, &self.run.sampled) else { return };
        for (body, force) in self.run.forces.iter_mut().enumerate().filter(|(body, force)| unknown(*body, **force)) {
            *force = acting(&instant.at(model, body), scratch).map_or(f64::NAN, |acting| acting.contact.force.norm());
        }
    }

    /// Finds and hands on the events of the last step, in order of time.
    pub(crate) fn find_events(&mut self, report: &StepReport, sink: &mut dyn Sink) -> Result<(), RunError> {
        let mut found = std::mem::take(&mut self.run.found);
        found.clear();
        self.run.since.clear();
        self.run.since.resize(self.run.step_ends.len(), [report.start; 3]);
        for part in 1..=PARTS {
            let time = part_of(report, part);
            if part < PARTS {
                let State { bodies, low, works, .. } = &mut self.run.sampled;
                self.run.integrator.interpolate_extended(time, bodies, works, Some(low));
            } else {
                self.find_forces();
            }
            for body in 0..self.run.step_ends.len() {
                let signals = if part == PARTS { self.signals(body) } else { self.signals_within(body, time) };
                self.compare(body, time, &signals, &mut found);
            }
        }
        found.sort_by(|a, b| a.time.total_cmp(&b.time));
        for event in &found {
            self.run.state.events[event.kind] += 1;
            sink.event(event)?;
            if sink.wants_event_rows() && self.fill_row(event.time) {
                sink.event_row(event, &self.run.rows.row)?;
            }
        }
        self.run.found = found;
        Ok(())
    }

    /// Fills the row of a time within the last step; false where that state is outside the model.
    fn fill_row(&mut self, time: f64) -> bool {
        self.interpolate(time);
        let (model, initial) = (self.system.model(), Some(self.run.state.initial_energy));
        self.run.fields.fill(model, self.system.workspace(), &self.run.sampled, initial, &mut self.run.rows).is_ok()
    }

    /// The signals of a body in the sampled state, but for the one that needs a force.
    fn signals_within(&self, body: usize, time: f64) -> Signals {
        let motion = self.run.sampled.motion(self.system.model(), body);
        let [apex, approach] = self.motion_signals(body, time, &motion);
        [apex, approach, f64::NAN]
    }

    /// Compares the signals of a body with the last significant ones, and collects the events between.
    fn compare(&mut self, body: usize, time: f64, signals: &Signals, found: &mut Vec<Event>) {
        for (kind, after) in signals.iter().enumerate().filter(|(_, after)| events::is_significant(**after)) {
            let before = std::mem::replace(&mut self.run.state.signals[body][kind], *after);
            let since = std::mem::replace(&mut self.run.since[body][kind], time);
            if events::happened(kind, before, *after) {
                found.push(Event { time: self.locate(body, kind, since, time), kind, body });
            }
        }
    }

    /// The time of an event between two times of the last step [s].
    fn locate(&mut self, body: usize, kind: usize, since: f64, until: f64) -> f64 {
        let model = self.system.model();
        let speed = self.system.speed_scale(body);
        let (this, slots) = (&model.bodies[body], model.slots(body));
        let (workspace, state) = (self.system.workspace(), &mut self.run.sampled);
        let signal = |time: f64, bodies: &[f64], _: &[f64]| {
            let motion = || BodyMotion::read(this, slots, bodies);
            match kind {
                APEX => events::apex(model, body, &motion(), speed),
                LIFT_OFF => {
                    // Looked for at the end of a step only, when nothing else needs the sample.
                    state.time = time;
                    state.bodies.copy_from_slice(bodies);
                    state.low.fill(0.0);
                    let seen = observe(model, workspace, state, body);
                    events::lift_off(model, body, seen.map_or(f64::NAN, |seen| seen.contact_force.norm()), speed)
                }
                _ => events::approach(model, time, body, &motion(), speed),
            }
        };
        let direction = if events::rises(kind) { CrossingDirection::Rising } else { CrossingDirection::Falling };
        find_crossing(&mut self.run.integrator, (since, until), signal, direction, 1).unwrap_or(until)
    }

    fn motion_signals(&self, body: usize, time: f64, motion: &BodyMotion) -> [f64; 2] {
        let (model, speed) = (self.system.model(), self.system.speed_scale(body));
        [events::apex(model, body, motion, speed), events::approach(model, time, body, motion, speed)]
    }
}

/// The end of a part of a step [s].
fn part_of(report: &StepReport, part: usize) -> f64 {
    if part == PARTS {
        return report.end;
    }
    report.start + (report.end - report.start) * (part as f64 / PARTS as f64)
}
