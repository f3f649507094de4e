//! Finds the events of a step.
//!
//! The signals are looked at on the quarters of the step, at first on the interpolant that costs no evaluation. Only where
//! one of them changes its sign is the interpolant made accurate, walked through from quarter to quarter, and the
//! crossing closed in. Neither the steps nor the samples have a part in this.

use crate::events::{self, APEX, Event, LIFT_OFF, Signals};
use crate::ports::{RunError, Sink};
use crate::run::Simulation;
use gyration::balance::observe;
use gyration::state::BodyMotion;
use gyration_ode::{Direction, StepReport, find_crossing};

/// On how many parts of a step an event is looked for.
const PARTS: usize = 4;

impl Simulation<'_> {
    /// The signals of a body after the last step.
    pub(crate) fn signals(&mut self, body: usize) -> Signals {
        let (model, time) = (self.system.model(), self.integrator.time());
        let (view, speed) = (self.views[body], self.system.speed_scale(body));
        let force = match view.contact_force(model, &model.bodies[body]) {
            Some(force) => force,
            None => {
                self.sampled.time = time;
                self.sampled.bodies.copy_from_slice(self.integrator.state());
                self.contact_force(body)
            }
        };
        let [apex, approach] = self.motion_signals(body, time, &view.motion);
        [apex, approach, events::lift_off(model, body, force, speed)]
    }

    /// Finds and hands on the events of the last step, in order of time.
    pub(crate) fn find_events(&mut self, report: &StepReport, sink: &mut dyn Sink) -> Result<(), RunError> {
        let mut found = std::mem::take(&mut self.found);
        found.clear();
        for body in 0..self.system.model().bodies.len() {
            let end = self.signals(body);
            if self.changes_sign(report, body, &end) {
                self.walk(report, body, &end, &mut found);
            } else {
                let known = self.tally.signals[body].iter_mut().zip(end);
                known.filter(|(_, now)| events::is_significant(*now)).for_each(|(known, now)| *known = now);
            }
        }
        found.sort_by(|a, b| a.time.total_cmp(&b.time));
        for event in &found {
            self.tally.events[event.kind] += 1;
            sink.event(event)?;
        }
        self.found = found;
        Ok(())
    }

    /// Whether a signal of the body changes its sign between the parts of the step.
    fn changes_sign(&mut self, report: &StepReport, body: usize, end: &Signals) -> bool {
        let before = self.tally.signals[body];
        let against = |signals: &[f64]| {
            signals.iter().zip(before).any(|(now, before)| events::is_significant(*now) && now * before < 0.0)
        };
        against(end)
            || (1..PARTS).any(|part| {
                let motion = self.motion_at(part_of(report, part), body);
                against(&self.motion_signals(body, part_of(report, part), &motion))
            })
    }

    /// Walks through the step and collects the events of a body.
    fn walk(&mut self, report: &StepReport, body: usize, end: &Signals, found: &mut Vec<Event>) {
        self.integrator.prepare_dense(&mut self.system);
        let mut since = [report.start; 3];
        for part in 1..=PARTS {
            let time = part_of(report, part);
            let signals = if part == PARTS {
                *end
            } else {
                let motion = self.motion_at(time, body);
                let [apex, approach] = self.motion_signals(body, time, &motion);
                [apex, approach, f64::NAN]
            };
            for (kind, after) in signals.into_iter().enumerate().filter(|(_, after)| events::is_significant(*after)) {
                let before = std::mem::replace(&mut self.tally.signals[body][kind], after);
                if events::happened(kind, before, after) {
                    found.push(Event { time: self.locate(body, kind, (since[kind], time)), kind, body });
                }
                since[kind] = time;
            }
        }
    }

    /// The time of an event between two times of the last step [s].
    fn locate(&mut self, body: usize, kind: usize, (from, to): (f64, f64)) -> f64 {
        let model = self.system.model();
        let speed = self.system.speed_scale(body);
        let (workspace, state) = (self.system.workspace(), &mut self.sampled);
        let sense = if events::rises(kind) { 1.0 } else { -1.0 };
        let signal = |time: f64, bodies: &[f64], _: &[f64]| {
            // Constant outside of the interval, so that the first crossing is the one within.
            if time < from || time > to {
                return if time < from { -sense } else { sense };
            }
            state.time = time;
            state.bodies.copy_from_slice(bodies);
            let motion = state.motion(model, body);
            match kind {
                LIFT_OFF => {
                    let force =
                        observe(model, workspace, state, body).map_or(f64::NAN, |seen| seen.contact_force.norm());
                    events::lift_off(model, body, force, speed)
                }
                APEX => events::apex(model, body, &motion, speed),
                _ => events::approach(model, time, body, &motion, speed),
            }
        };
        let direction = if events::rises(kind) { Direction::Rising } else { Direction::Falling };
        find_crossing(&mut self.integrator, signal, direction, PARTS).unwrap_or(to)
    }

    fn motion_signals(&self, body: usize, time: f64, motion: &BodyMotion) -> [f64; 2] {
        let (model, speed) = (self.system.model(), self.system.speed_scale(body));
        [events::apex(model, body, motion, speed), events::approach(model, time, body, motion, speed)]
    }

    /// The motion of a body at a time within the last step.
    fn motion_at(&mut self, time: f64, body: usize) -> BodyMotion {
        self.integrator.interpolate(time, &mut self.sampled.bodies, &mut self.sampled.works);
        self.sampled.motion(self.system.model(), body)
    }

    /// |f| of the contacts in the sampled state, by integration [N].
    fn contact_force(&mut self, body: usize) -> f64 {
        let model = self.system.model();
        observe(model, self.system.workspace(), &self.sampled, body).map_or(f64::NAN, |seen| seen.contact_force.norm())
    }
}

/// The end of a part of a step [s].
fn part_of(report: &StepReport, part: usize) -> f64 {
    if part == PARTS {
        return report.end;
    }
    report.start + (report.end - report.start) * (part as f64 / PARTS as f64)
}
