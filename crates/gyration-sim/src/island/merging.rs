//! Bodies that come within reach of one another, and go out of it: islands that become one, and fall apart.
//!
//! Both are told by the paths of the islands alone, whatever windows and threads there are. Two islands become one at
//! the later of the beginnings of the two steps within which their bodies may meet first: up to there each has moved as
//! if there were no others, and its steps say so. An island falls apart at the end of a step behind which some of its
//! bodies are out of reach of the others, and stay so for a few steps if they go on as they do.

use crate::in_play::InPlay;
use crate::island::approach::{Approach, may_meet};
use crate::island::path_bound::{NODES, Node, PathBound};
use crate::island::paths::Paths;
use crate::island::{Island, Setting};
use crate::outcome::Stop;
use crate::plan::RunPlan;
use gyration::kinematics::Quaternion;
use gyration::neighbours::BodyPair;
use gyration::pair::EDGE;
use gyration::tensor::Vec3;
use gyration_ode::{Components, Integrator, Options, StepReport};
use gyration_threads::Interruption;

/// For how many of its next steps bodies must stay out of reach before an island falls apart.
const AHEAD: f64 = 2.0;

impl Island {
    /// Notes bounds of the paths of its bodies over the last step.
    pub fn note_path_bounds(&mut self, report: &StepReport) {
        let Self { integrator, system, sampled, paths, .. } = self;
        let Some(paths) = paths else { return };
        let model = system.model();
        let origin = Node { center: Vec3::zeros(), quaternion: Quaternion::IDENTITY };
        let mut nodes = vec![[origin; NODES]; model.bodies.len()];
        for (k, time) in PathBound::nodes(report.start, report.end).into_iter().enumerate() {
            integrator.interpolate(time, &mut sampled.bodies, &mut sampled.works);
            for (body, nodes) in nodes.iter_mut().enumerate() {
                nodes[k].center = sampled.motion(model, body).placement.position;
                // A body that deforms is never apart from another, and a mass point does not turn.
                let attitude = &sampled.bodies[model.slots(body).attitude()];
                if let Some(quaternion) = attitude.first_chunk().filter(|_| attitude.len() == 4) {
                    nodes[k].quaternion = Quaternion(*quaternion);
                }
            }
        }
        paths.push(nodes.iter().map(|nodes| PathBound::through((report.start, report.end), nodes)));
    }

    /// Notes whether some of its bodies are out of reach of the others, and stay so.
    pub fn note_parting(&mut self) {
        self.state.is_parting =
            self.paths.is_some() && self.members().len() > 1 && self.parts().iter().nth(1).is_some();
    }

    /// The sets of its bodies, by their places, that are within reach of one another or will be soon. They part a
    /// little farther out than they meet: two that stay at one distance do not do both in turns.
    pub fn parts(&self) -> Components {
        let (model, ahead) = (self.model(), AHEAD * self.integrator.next_size());
        let stays = |pair: &BodyPair| {
            let Some(cutoff) = model.cutoff(pair) else { return false };
            let [one, other] = pair.bodies.map(|body| &self.step_ends[body]);
            if Approach::of(one, other).least(ahead) > (1.0 + EDGE) * cutoff.centers {
                return false;
            }
            let solids = pair.bodies.map(|body| &*model.bodies[body].solid);
            let [one, other] = [one, other].map(|end| PathBound::ahead(end, ahead));
            !one.stay_apart(&other, (1.0 + EDGE) * cutoff.surfaces, solids)
        };
        let near = may_meet(model, &self.step_ends, ahead);
        let joined = near.iter().filter(|pair| stays(pair)).map(|pair| pair.bodies).chain(model.endless_chain());
        Components::joined(model.bodies.len(), joined)
    }

    /// Comes to a time within its paths, by a step that ends there; what it has done since is forgotten. Events up to
    /// there stay those of the step that is cut: some of them may have been handed on.
    ///
    /// # Errors
    /// [`Stop`] if that step cannot be made.
    pub fn come_to(&mut self, time: f64, plan: &RunPlan) -> Result<(), Stop> {
        let known = std::mem::take(&mut self.events);
        // The last step that begins no later is cut there, the others are repeated.
        let begins = self.paths.iter().flat_map(Paths::beginnings);
        let cut = begins.filter(|begin| *begin <= time).fold(f64::NEG_INFINITY, f64::max);
        let come = Interruption::default().within(|| {
            if let Some(kept) = self.restart_point.as_ref().map(|restart_point| restart_point.kept().clone()) {
                let restored = self.restore(&kept, plan);
                debug_assert!(restored.is_ok(), "an island remembers itself");
            }
            while self.time() < cut {
                self.step(plan)?;
            }
            while self.time() < time {
                self.step_towards(time.min(self.target(plan)), plan)?;
            }
            Ok(())
        });
        self.events = known;
        self.events.retain(|found| found.event.time <= time);
        come
    }

    /// The island of some bodies that goes on from others, all of which are at one time; its works begin at zero.
    ///
    /// # Errors
    /// [`Stop`] if together they have no rates.
    pub fn successor(setting: Setting, members: Vec<usize>, before: &[&Island], in_play: InPlay) -> Result<Self, Stop> {
        let plan = setting.plan;
        // Where it begins has been come to: that is not given up.
        let mut this = Interruption::default().within(|| Self::new(setting, members, false))?;
        let time = before.iter().map(|island| island.time()).fold(f64::NEG_INFINITY, f64::max);
        let step = before.iter().map(|island| island.integrator.next_size()).filter(|size| *size > 0.0);
        let step = step.reduce(f64::min);
        let (mut numbers, mut low) = (Vec::new(), Vec::new());
        for (island, place) in this.members().iter().filter_map(|body| place_of(*body, before)) {
            let own = island.model().blocks()[place].clone();
            numbers.extend_from_slice(&island.integrator.state()[own.clone()]);
            low.extend_from_slice(&island.integrator.state_low()[own]);
        }
        let options = Options { initial_step: step, ..plan.options };
        this.integrator = Integrator::new(time, &numbers, &vec![0.0; this.works().len()], options)
            .succeeding(&low, before.iter().map(|island| &island.integrator));
        this.take_over(before);
        this.state.in_play = in_play;
        // The planes of the rates there are looked for from where they are.
        Interruption::default().within(|| {
            this.find_gaps();
            this.restart()
        })?;
        this.note_in_play();
        if let Some(restart_point) = &mut this.restart_point {
            restart_point.drop_at(&this.state, &this.integrator);
        }
        Ok(this)
    }

    /// Takes over what is known of its bodies beside their state.
    fn take_over(&mut self, before: &[&Island]) {
        for (place, body) in self.members().to_vec().into_iter().enumerate() {
            let Some((island, there)) = place_of(body, before) else { continue };
            self.state.signals[place] = island.state.signals[there];
            self.state.peaks.sample = island.state.peaks.sample;
            if let (Some(own), Some(force)) =
                (self.state.peaks.forces.get_mut(place), island.state.peaks.forces.get(there))
            {
                *own = *force;
            }
        }
        // A maximum that is not a number where one of them is none.
        let later = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) };
        let since = before.iter().map(|island| island.state.slow_since).reduce(later);
        self.state.slow_since = since.unwrap_or(f64::NAN);
        for island in before {
            self.state.largest_projection = self.state.largest_projection.max(island.state.largest_projection);
            for (own, gain) in self.state.largest_gains.iter_mut().zip(island.state.largest_gains) {
                *own = own.max(gain);
            }
        }
    }

    /// Takes the events of other islands that are not handed on yet.
    pub fn take_events<'a>(&mut self, before: impl IntoIterator<Item = &'a Island>) {
        self.events = before.into_iter().flat_map(|island| island.events.iter().copied()).collect();
        self.events.sort_by(|a, b| a.event.in_order(&b.event));
    }
}

/// The island that has a body, and its place there.
fn place_of<'a>(body: usize, islands: &[&'a Island]) -> Option<(&'a Island, usize)> {
    islands.iter().find_map(|island| Some((*island, island.members().binary_search(&body).ok()?)))
}
