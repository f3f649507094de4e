//! Detects the events of a step.
//!
//! The signals are looked at on the quarters of the step, and on more parts where a body that is no ball turns far, on
//! its interpolant, which costs no evaluation of the rates. Where one changes its sign from a significant value to
//! another, the crossing is closed in. Neither the steps nor the samples have a part in this.
//!
//! A force is known at the ends of a step. Between two at which a body is pushed, it may have left its support all the
//! same: where the acceleration of the interpolant says that the force may be small, it is asked for.

use crate::adapter::ModelSystem;
use crate::events::{self, APEX, CLOSEST_APPROACH, Event, FoundEvent, LIFT_OFF, Signals};
use crate::island::Island;
use crate::island::step_end::StepEnd;
use crate::outcome::Stop;
use gyration::dynamics::acting;
use gyration::instant::PairGaps;
use gyration::state::{BodyMotion, State};
use gyration_ode::{CrossingDirection, StepReport, find_crossing};

/// On how many parts of a step an event is looked for, at least and at most.
const PARTS: [usize; 2] = [4, 100];
/// By how much a body that is no ball turns in a part of a step at most [rad]: an edge of a box five times as wide as
/// it is high is down for twice as long before its face lies flat.
const TURN: f64 = std::f64::consts::PI / 16.0;
/// Half the time between two velocities of which an acceleration is the difference, as a part of the step.
const DIFFERENCE: f64 = 1e-3;
/// A force is asked for that seems to be below this part of that at the end of the step and this multiple of that at
/// which a body has left what it touched.
const SMALL: [f64; 2] = [0.02, 3.0];

impl Island {
    /// The signals of a body after the last step, once the forces there are known.
    pub fn signals(&self, body: usize) -> Signals {
        let (model, time) = (self.model(), self.time());
        let (motion, speed) = (self.step_ends[body].motion, self.system.speed_scale(body));
        let [apex, approach] = motion_signals(&self.system, (body, time), &motion, self.system.step_end_gaps());
        [apex, approach, events::lift_off(model, body, self.forces[body], speed)]
    }

    /// |f| of the contacts of every body after the last step [N]: from its balance where nothing else pulls at it, else
    /// by integration; NaN without contacts.
    pub fn find_forces(&mut self) {
        let Self { system, step_ends, forces, .. } = self;
        let model = system.model();
        forces.clear();
        let balanced = |(body, end): (usize, &StepEnd)| end.contact_force(model, body).unwrap_or(f64::NAN);
        forces.extend(step_ends.iter().enumerate().map(balanced));
        let unknown = |body: usize, force: f64| force.is_nan() && model.has_contact(body);
        if !(0..forces.len()).any(|body| unknown(body, forces[body])) {
            return;
        }
        self.sample(self.time());
        let (model, workspace) = self.system.observed();
        let Ok((instant, scratch)) = workspace.read(model, &self.sampled) else { return };
        let unknown = |body: usize, force: f64| force.is_nan() && model.has_contact(body);
        for (body, force) in self.forces.iter_mut().enumerate().filter(|(body, force)| unknown(*body, **force)) {
            *force = acting(&instant.at(body), scratch).map_or(f64::NAN, |acting| acting.contact.force.norm());
        }
    }

    /// Finds the planes between its bodies after the last step, from which those of the next begin.
    pub fn find_gaps(&mut self) {
        let Self { system, integrator, .. } = self;
        let (model, workspace) = system.observed();
        // Where no plane is found none is remembered; stages of the next step that find none either end the run.
        let _ = workspace.remember_pairs(model, integrator.time(), integrator.state().into());
    }

    /// The stop of an island in which two bodies touch, as far as digits tell: what would follow is made of rounding.
    pub fn touch(&self) -> Option<Stop> {
        let model = self.model();
        self.system.step_end_gaps()?.iter().find_map(|(pair, slab)| {
            let size = pair.parties.into_iter().filter_map(|it| model.size_of(it)).fold(f64::INFINITY, f64::min);
            let gap = pair.form.touch(slab, size)?;
            Some(Stop::by_touch(model, self.time(), pair.parties, gap, size))
        })
    }

    /// Finds the events of the last step, in order of time behind those found before.
    pub fn find_events(&mut self, report: &StepReport) {
        let before = self.events.len();
        self.since.clear();
        self.since.resize(self.step_ends.len(), [report.start; 3]);
        self.find_forces();
        self.find_pushed();
        let parts = self.count_parts(report);
        for part in 1..=parts {
            let time = part_of(report, (part, parts));
            if part < parts {
                self.interpolate(time);
                self.find_signals_within(time);
                self.find_partings_within(time, DIFFERENCE * (report.end - report.start));
            } else {
                self.find_signals();
            }
            for body in 0..self.step_ends.len() {
                self.compare(body, time);
            }
        }
        self.events[before..].sort_by(|a, b| a.event.time.total_cmp(&b.event.time));
    }

    /// On how many parts of the last step its events are looked for.
    fn count_parts(&self, report: &StepReport) -> usize {
        let model = self.model();
        let is_seen = |body: &usize| model.bodies[*body].has_inertia() && !model.bodies[*body].solid.is_ball();
        let bodies = (0..self.step_ends.len()).filter(is_seen);
        let spin = bodies.map(|body| self.step_ends[body].motion.angular_velocity().norm()).fold(0.0, f64::max);
        ((spin * (report.end - report.start) / TURN).ceil() as usize).clamp(PARTS[0], PARTS[1])
    }

    /// The signals of all bodies at the end of the step.
    fn find_signals(&mut self) {
        let mut signals = std::mem::take(&mut self.signals);
        signals.clear();
        signals.extend((0..self.step_ends.len()).map(|body| self.signals(body)));
        self.signals = signals;
    }

    /// The signals of all bodies in the sampled state, but for the one that needs a force.
    fn find_signals_within(&mut self, time: f64) {
        let Self { system, sampled, signals, .. } = self;
        let (system, gaps) = system.gaps_at(time, &sampled.bodies);
        signals.clear();
        signals.extend((0..system.model().bodies.len()).map(|body| {
            let motion = sampled.motion(system.model(), body);
            let [apex, approach] = motion_signals(system, (body, time), &motion, gaps);
            [apex, approach, f64::NAN]
        }));
    }

    /// The state within the last step, as the interpolant has it.
    fn interpolate(&mut self, time: f64) {
        let State { bodies, low, works, time: at } = &mut self.sampled;
        *at = time;
        self.integrator.interpolate_extended(time, bodies, works, Some(low));
    }

    /// Finds the bodies that are pushed at both ends of the last step, and by their contacts alone.
    fn find_pushed(&mut self) {
        let mut pushed = std::mem::take(&mut self.pushed);
        pushed.clear();
        pushed.extend((0..self.step_ends.len()).filter(|body| {
            self.state.signals[*body][LIFT_OFF] > 0.0
                && self.forces[*body] > events::parting_force(self.model(), *body, self.system.speed_scale(*body))
                && self.step_ends[*body].contact_force(self.model(), *body).is_some()
        }));
        self.pushed = pushed;
    }

    /// The signals of those that have left what they touched at a time within the last step: the force of contacts is
    /// asked for where m (p̈₀ − g) of the interpolant is small.
    fn find_partings_within(&mut self, time: f64, half: f64) {
        if self.pushed.is_empty() {
            return;
        }
        let velocity = |island: &Self, body: usize| island.sampled.motion(island.model(), body).velocity.velocity;
        let mut changes = std::mem::take(&mut self.changes);
        changes.clear();
        self.interpolate(time - half);
        changes.extend(self.pushed.iter().map(|body| velocity(self, *body)));
        self.interpolate(time + half);
        for (body, change) in self.pushed.iter().zip(&mut changes) {
            *change = velocity(self, *body) - *change;
        }
        let mut is_sampled = false;
        for (place, change) in changes.iter().enumerate() {
            let body = self.pushed[place];
            let (model, speed) = (self.model(), self.system.speed_scale(body));
            let force = model.bodies[body].solid.mass.mass * (change / (2.0 * half) - model.gravity).norm();
            let small = SMALL[0] * self.forces[body] + SMALL[1] * events::parting_force(model, body, speed);
            if force >= small {
                continue;
            }
            if !std::mem::replace(&mut is_sampled, true) {
                self.sample(time);
            }
            let (model, workspace) = self.system.observed();
            let force = workspace.contact_force((model, body), &self.sampled).map_or(f64::NAN, |force| force.norm());
            self.signals[body][LIFT_OFF] = events::lift_off(self.system.model(), body, force, speed);
        }
        self.changes = changes;
    }

    /// Compares the signals of a body with the last significant ones, and collects the events between.
    fn compare(&mut self, body: usize, time: f64) {
        let signals = self.signals[body].into_iter().enumerate();
        for (kind, after) in signals.filter(|(_, after)| events::is_significant(*after)) {
            let before = std::mem::replace(&mut self.state.signals[body][kind], after);
            let since = std::mem::replace(&mut self.since[body][kind], time);
            if events::happened(kind, before, after) {
                let event = Event { time: self.locate(body, kind, since, time), kind, body: self.members()[body] };
                let gap = if kind == CLOSEST_APPROACH { self.gap_within(body, event.time) } else { f64::INFINITY };
                self.events.push(FoundEvent { event, gap });
            }
        }
    }

    /// The gap of a body to a support that it has a contact with, or to a body that it acts on, at a time within the
    /// last step [m]; infinite without one, and where it is not known.
    fn gap_within(&mut self, body: usize, time: f64) -> f64 {
        // Signals are known by now: nobody needs the sample of another time.
        self.sample(time);
        let (model, workspace) = self.system.observed();
        workspace.gap_of((model, body), time, self.sampled.numbers()).unwrap_or(f64::INFINITY)
    }

    /// The time of an event between two times of the last step [s].
    fn locate(&mut self, body: usize, kind: usize, since: f64, until: f64) -> f64 {
        let speed = self.system.speed_scale(body);
        let Self { system, sampled: state, integrator, .. } = self;
        let (model, workspace) = system.observed();
        let (this, slots) = (&model.bodies[body], model.slots(body));
        let signal = |time: f64, bodies: &[f64], _: &[f64]| {
            let motion = || BodyMotion::read(this, slots, bodies);
            match kind {
                APEX => events::apex(model, body, &motion(), speed),
                LIFT_OFF => {
                    // The sample is made anew for whoever needs it next.
                    state.time = time;
                    state.bodies.copy_from_slice(bodies);
                    state.low.fill(0.0);
                    let force = workspace.contact_force((model, body), state).map_or(f64::NAN, |force| force.norm());
                    events::lift_off(model, body, force, speed)
                }
                _ => {
                    let gaps = workspace.pair_gaps_of((model, body), time, bodies.into()).ok();
                    events::approach(model, time, body, (&motion(), gaps), speed)
                }
            }
        };
        let direction = if events::rises(kind) { CrossingDirection::Rising } else { CrossingDirection::Falling };
        find_crossing(integrator, (since, until), signal, direction, 1).unwrap_or(until)
    }
}

/// Those signals of a body that follow from its motion and from the slabs between bodies, as far as these are known.
fn motion_signals(
    system: &ModelSystem,
    (body, time): (usize, f64),
    motion: &BodyMotion,
    gaps: Option<&PairGaps>,
) -> [f64; 2] {
    let (model, speed) = (system.model(), system.speed_scale(body));
    [events::apex(model, body, motion, speed), events::approach(model, time, body, (motion, gaps), speed)]
}

/// The end of one of so many parts of a step [s].
fn part_of(report: &StepReport, (part, parts): (usize, usize)) -> f64 {
    if part == parts {
        return report.end;
    }
    report.start + (report.end - report.start) * (part as f64 / parts as f64)
}
