//! The partition of the bodies into islands, and how it changes: which islands become one, and which fall apart, in
//! order of time.
//!
//! Islands go on as if there were no others; what they do is right up to the first time at which two of them may have
//! met. The earliest change of all is carried out, the islands that it concerns begin anew there, and all is looked at
//! again. A change that is carried out stands: a new island has no path before its time, and every other meeting that
//! is known is later. Meetings wait in a queue of times; only the steps that an island has made since are looked at
//! again.

use crate::island::{Effort, Island, PathBound, Paths, Setting};
use crate::outcome::Stop;
use crate::run::islands::Islands;
use crate::run::meeting::{Approaching, Meeting};
use crate::run_state::Settled;
use gyration::model::Model;
use gyration::neighbours::{BodyPair, Bounds, BoxTree};
use gyration::pair::EDGE;
use gyration_ode::Components;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The boxes are laid anew where the bodies whose steps are new, times this, are more than all.
const FRESH: usize = 4;
/// They are laid anew where there are more of them than so many a body.
const STALE: usize = 8;

/// The bodies of a run in islands.
pub(crate) struct Partition {
    /// In order of their first bodies.
    pub islands: Islands,
    /// The first body of the island of each body, and its place there.
    island_of: Vec<(usize, usize)>,
    /// Whether islands meet and part; without cutoff distances they do not.
    changes: bool,
    /// Boxes about the paths of the bodies, and about some that are no more, as much wider as their bodies are.
    paths: BoxTree,
    /// Meetings of islands that may be, some of them of islands that are no more.
    queue: BinaryHeap<Reverse<Meeting>>,
    /// The first bodies of islands that wait to fall apart, some of them of islands that are no more.
    parting: Vec<usize>,
    /// The first bodies of the islands that the last change has made.
    made: Vec<usize>,
    /// How many paths have been given a number.
    revisions: u64,
    /// The time of the last change [s].
    changed: f64,
    /// The steps in this window of islands that are no more.
    ended: Effort,
}

/// A change of the partition.
#[derive(Debug, Clone, PartialEq)]
enum Change {
    /// Two islands, by their first bodies, become one.
    Merge([usize; 2]),
    /// An island, by its first body, falls apart.
    Split(usize),
}

/// What a change needs of the run beside the islands.
pub(crate) struct Changing<'a> {
    pub setting: Setting<'a>,
    /// What islands have done that are no more.
    pub settled: &'a mut Settled,
}

/// The sets of bodies that act on one another however far they are.
pub(super) fn always_coupled(model: &Model) -> Vec<Vec<usize>> {
    Components::joined(model.bodies.len(), model.endless_chain()).iter().map(<[usize]>::to_vec).collect()
}

/// Whether these could be the islands of a model: each body in one of them, with all to which it is coupled always.
pub(super) fn may_be_islands(model: &Model, islands: &[Vec<usize>]) -> bool {
    let always = always_coupled(model);
    if !model.has_cutoffs() {
        return islands == always;
    }
    let mut island_of = vec![None; model.bodies.len()];
    for (island, members) in islands.iter().enumerate() {
        for body in members {
            match island_of.get_mut(*body) {
                Some(home @ None) => *home = Some(island),
                _ => return false,
            }
        }
    }
    let whole = |coupled: &Vec<usize>| {
        coupled.iter().all(|body| island_of[*body].is_some() && island_of[*body] == island_of[coupled[0]])
    };
    let ascend = islands.iter().all(|members| !members.is_empty() && members.is_sorted());
    ascend && islands.is_sorted_by_key(|members| members[0]) && always.iter().all(whole)
}

impl Partition {
    /// Of islands that hold each of so many bodies once.
    pub fn new(bodies: usize, islands: impl IntoIterator<Item = Box<Island>>, changes: bool) -> Self {
        let mut this = Self {
            islands: Islands::for_bodies(bodies),
            island_of: vec![(0, 0); bodies],
            changes,
            paths: BoxTree::default(),
            queue: BinaryHeap::new(),
            parting: Vec::new(),
            made: Vec::new(),
            revisions: 0,
            changed: f64::NEG_INFINITY,
            ended: Effort::default(),
        };
        this.put(islands);
        this.made = Vec::new();
        this
    }

    /// The first body of the island of a body, by which it is known, and the place of the body there.
    pub fn island_of(&self, body: usize) -> (usize, usize) {
        self.island_of[body]
    }

    /// The steps of all bodies since this was asked for last.
    pub fn take_effort(&mut self) -> Effort {
        let mut all = std::mem::take(&mut self.ended);
        self.islands.iter_mut().for_each(|island| all += std::mem::take(&mut island.effort));
        all
    }

    /// Whether the islands stay what they are.
    pub fn is_fixed(&self) -> bool {
        !self.changes
    }

    /// The time of the island that has come least far [s]; none if nothing moves.
    pub fn least_time(&self) -> Option<f64> {
        self.islands.iter().map(|island| island.time()).reduce(f64::min)
    }

    /// The same of those that do not wait to fall apart; infinite if all do.
    pub fn known_time(&self) -> f64 {
        self.islands
            .iter()
            .filter(|island| !island.state.is_parting)
            .map(|island| island.time())
            .fold(f64::INFINITY, f64::min)
    }

    /// Carries out the earliest change, if it comes before a time; whether there was one. One at that time is left to
    /// the next window.
    ///
    /// # Errors
    /// [`Stop`] where the islands cannot go on as they are to.
    pub fn change(&mut self, until: f64, changing: Changing) -> Result<bool, Stop> {
        let first = self.first_change(changing.setting.model);
        self.carry_out(first, until, changing)
    }

    /// The same where, since the last change, only the islands that it has made have moved, and all but those that wait
    /// to fall apart have come to a time that is `known`. What waits falls apart before anything later.
    ///
    /// # Errors
    /// As there.
    pub fn change_again(&mut self, known: f64, until: f64, changing: Changing) -> Result<bool, Stop> {
        let made = std::mem::take(&mut self.made);
        let has_come = |island: &Island| island.time() >= known || island.state.is_parting;
        debug_assert!(made.iter().all(|first| has_come(&self.islands[*first])), "all have come to {known}");
        let first = self.first_after(&made, changing.setting.model).filter(|(time, _)| *time <= known);
        self.carry_out(first, until, changing)
    }

    /// The islands that the last change has made.
    pub fn made(&self) -> &[usize] {
        &self.made
    }

    /// Carries out a change, if it comes before a time.
    fn carry_out(&mut self, first: Option<(f64, Change)>, until: f64, changing: Changing) -> Result<bool, Stop> {
        let Some((time, change)) = first.filter(|(time, _)| *time < until) else {
            return Ok(false);
        };
        self.made.clear();
        debug_assert!(time >= self.changed, "changes come in order of time: {time} after {}", self.changed);
        self.changed = time;
        match change {
            Change::Merge(islands) => self.merge(islands, time, changing)?,
            Change::Split(island) => self.split(island, changing)?,
        }
        Ok(true)
    }

    /// The time of the first change [s]; infinite if none is known.
    pub fn change_time(&mut self, model: &Model) -> f64 {
        self.first_change(model).map_or(f64::INFINITY, |(time, _)| time)
    }

    /// The earliest change within what is known of all islands.
    fn first_change(&mut self, model: &Model) -> Option<(f64, Change)> {
        if self.is_fixed() {
            return None;
        }
        let known = self.least_time()?;
        self.parting.clear();
        let all: Vec<usize> = self.islands.iter().map(Island::first_body).collect();
        self.first_after(&all, model).filter(|(time, _)| *time <= known)
    }

    /// The earliest change, where these islands alone have moved since it was looked for.
    fn first_after(&mut self, moved: &[usize], model: &Model) -> Option<(f64, Change)> {
        self.look(moved, model);
        let is_parting = |first: &&usize| self.islands[**first].state.is_parting;
        self.parting.extend(moved.iter().filter(is_parting));
        match (self.first_merge(), self.first_split()) {
            (Some(merge), Some(split)) if split.0 < merge.0 => Some(split),
            (merge, split) => merge.or(split),
        }
    }

    /// Queues the meetings within steps of these islands that nobody has looked at.
    fn look(&mut self, moved: &[usize], model: &Model) {
        let unseen = |island: &Island| island.paths.as_ref().map_or(0, Paths::unseen);
        let fresh: Vec<usize> = moved.iter().copied().filter(|first| unseen(&self.islands[*first]) > 0).collect();
        let count: usize = fresh.iter().map(|first| self.islands[*first].members().len()).sum();
        let bodies = self.island_of.len();
        if FRESH * count > bodies || self.paths.count() > STALE * bodies {
            self.paths = BoxTree::new(self.islands.iter().flat_map(|island| boxes(model, island, usize::MAX)));
        } else {
            for island in fresh.iter().map(|first| &self.islands[*first]) {
                boxes(model, island, unseen(island)).for_each(|(bounds, body)| self.paths.insert(bounds, body));
            }
        }
        for first in fresh {
            let Some(paths) = &mut self.islands[first].paths else { continue };
            let (unseen, number) = (paths.unseen(), self.revisions);
            self.revisions += u64::from(paths.revision().is_none());
            paths.saw(number);
            self.look_at(model, first, unseen);
        }
    }

    /// Queues the meetings within the last steps of an island, of which so many are new, with steps of other islands
    /// that were looked at: those that were not look at these.
    fn look_at(&mut self, model: &Model, first: usize, unseen: usize) {
        let Self { islands, island_of, paths, queue, .. } = self;
        let island = &islands[first];
        let Some((own, revision)) = known(island) else { return };
        let rules = model.rules();
        for (bounds, body) in boxes(model, island, unseen) {
            let new = last(own.body(island_of[body].1), unseen);
            let reaches = rules.of(body).iter().filter_map(|rule| Some(rules.all()[*rule].reach?.longest()));
            let bounds = bounds.wider(reaches.fold(0.0, f64::max));
            let mut beside: Vec<usize> = paths.touching(&bounds).filter(|other| island_of[*other].0 != first).collect();
            beside.sort_unstable();
            beside.dedup();
            for other in beside {
                let (home, there) = island_of[other];
                let Some((paths, revision_there)) = known(&islands[home]) else { continue };
                let steps = paths.body(there);
                let seen = &steps[..steps.len() - paths.unseen()];
                for rule in rules.of(body) {
                    let Some(bodies) = rules.all()[*rule].between(body, other) else { continue };
                    let pair = BodyPair { rule: *rule, bodies };
                    let Some(approaching) = Approaching::of(model, &pair, [body, other]) else { continue };
                    // Later steps would meet later.
                    if let Some(time) = new.iter().find_map(|bound| approaching.first_meeting(bound, seen)) {
                        let is_first = bodies[0] == body;
                        let revisions = if is_first { [revision, revision_there] } else { [revision_there, revision] };
                        queue.push(Reverse(Meeting { time, pair, revisions }));
                    }
                }
            }
        }
    }

    /// The first time from which on two islands may not be followed apart. Meetings of islands that are no more, or
    /// have gone back, leave the queue.
    fn first_merge(&mut self) -> Option<(f64, Change)> {
        while let Some(Reverse(meeting)) = self.queue.peek() {
            let islands = meeting.pair.bodies.map(|body| self.island_of[body].0);
            let revision = |island: usize| known(&self.islands[island]).map(|(_, revision)| revision);
            if islands.map(revision) == meeting.revisions.map(Some) {
                let [one, other] = islands;
                return Some((meeting.time, Change::Merge([one.min(other), one.max(other)])));
            }
            self.queue.pop();
        }
        None
    }

    /// The first island that waits to fall apart; of several at one time that of the first body.
    fn first_split(&mut self) -> Option<(f64, Change)> {
        let Self { islands, parting, .. } = self;
        let waiting = |first: usize| islands.get(first).filter(|island| island.state.is_parting);
        parting.retain(|first| waiting(*first).is_some());
        let waiting = parting.iter().filter_map(|first| Some((waiting(*first)?.time(), *first)));
        let first = waiting.min_by(|(a, one), (b, other)| a.total_cmp(b).then(one.cmp(other)));
        first.map(|(time, first)| (time, Change::Split(first)))
    }

    /// Makes one island of two at a time.
    fn merge(&mut self, [one, other]: [usize; 2], time: f64, changing: Changing) -> Result<(), Stop> {
        assert!(one < other, "islands ascend");
        let Changing { setting, settled } = changing;
        for island in [one, other] {
            self.islands[island].come_to(time, setting.plan)?;
        }
        let (first, second) = (self.islands.take(one), self.islands.take(other));
        let mut members = [first.members(), second.members()].concat();
        members.sort_unstable();
        let works = [&first, &second].map(|island| island.done());
        let in_play = first.state.in_play.merged(works[0], second.state.in_play, works[1]);
        let merged = Island::successor(setting, members, &[&first, &second], in_play);
        match merged {
            Ok(mut merged) => {
                merged.take_events([&*first, &*second]);
                self.ended += first.effort;
                self.ended += second.effort;
                settle_works(settled, setting, [&*first, &*second]);
                self.put([Box::new(merged)]);
            }
            Err(stop) => {
                self.put([first, second]);
                return Err(stop);
            }
        }
        Ok(())
    }

    /// Lets an island fall apart where it stands.
    fn split(&mut self, first: usize, changing: Changing) -> Result<(), Stop> {
        let Changing { setting, settled } = changing;
        let island = &self.islands[first];
        let whole = island.kinetic_energy(0..island.members().len());
        let components = island.parts();
        let count = components.iter().count() as f64;
        let pieces = components.iter().map(|places| {
            let members = places.iter().map(|place| island.members()[*place]).collect();
            let kinetic = island.kinetic_energy(places.iter().copied());
            let share = if whole > 0.0 { kinetic / whole } else { 1.0 / count };
            let in_play = island.state.in_play.share(island.done(), share);
            Island::successor(setting, members, &[island], in_play)
        });
        let mut pieces = pieces.map(|piece| piece.map(Box::new)).collect::<Result<Vec<_>, Stop>>()?;
        let island = self.islands.take(first);
        self.ended += island.effort;
        // Its events are handed on by any of the pieces.
        pieces[0].take_events([&*island]);
        settle_works(settled, setting, [&*island]);
        self.put(pieces);
        Ok(())
    }

    /// Puts islands to the others.
    fn put(&mut self, islands: impl IntoIterator<Item = Box<Island>>) {
        for island in islands {
            let first = island.first_body();
            island.members().iter().enumerate().for_each(|(place, body)| self.island_of[*body] = (first, place));
            self.made.push(first);
            self.islands.put(island);
        }
        debug_assert!(self.is_valid(), "each body is in one island, and where it is said to be");
    }

    /// Whether each body is where it is said to be, and in one island alone.
    fn is_valid(&self) -> bool {
        let is_home = |(body, (first, place)): (usize, &(usize, usize))| {
            self.islands.get(*first).and_then(|island| island.members().get(*place)) == Some(&body)
        };
        let count: usize = self.islands.iter().map(|island| island.members().len()).sum();
        count == self.island_of.len() && self.island_of.iter().enumerate().all(is_home)
    }
}

/// Boxes about the last steps of the bodies of an island that meet others within a distance, so many of each, as much
/// wider as the bodies are.
fn boxes(model: &Model, island: &Island, steps: usize) -> impl Iterator<Item = (Bounds, usize)> {
    let bodies = island.members().iter().enumerate().filter(|(_, body)| model.meets_bodies(**body));
    bodies.filter_map(move |(place, body)| {
        let bounds = last(island.paths.as_ref()?.body(place), steps).iter().map(PathBound::bounds);
        let radius = model.bodies[*body].solid.radius()?;
        Some((bounds.reduce(|all, bounds| all.with(&bounds))?.wider((1.0 + EDGE) * radius), *body))
    })
}

/// The last of some steps, so many if there are.
fn last(steps: &[PathBound], count: usize) -> &[PathBound] {
    &steps[steps.len().saturating_sub(count)..]
}

/// The paths of an island that somebody has looked at, and what they are known by.
fn known(island: &Island) -> Option<(&Paths, u64)> {
    let paths = island.paths.as_ref()?;
    Some((paths, paths.revision()?))
}

/// Keeps what islands have done that end here.
fn settle_works<'a>(settled: &mut Settled, setting: Setting, ended: impl IntoIterator<Item = &'a Island>) {
    for island in ended {
        settled.take(setting.plan.count_quadratures(setting.model), island.works(), &island.integrator);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration::load::{Spring, SpringLaw};
    use gyration::tensor::Vec3;
    use std::path::Path;

    #[test]
    fn islands_of_a_checkpoint_hold_each_body_once_with_all_to_which_it_is_joined() {
        let body = |k: usize| {
            format!(
                "[[body]]\nname = \"b{k}\"\nshape = {{ sphere = {{ radius = 0.1 }} }}\nmass = 1\n\
                 position = [{k}, 0, 0]\n"
            )
        };
        let head = "time = { end = 1, sample = 1 }\n[[contact]]\nbetween = [\"b0\", \"b1\"]\nreach = 0.1\n\
                    repulsion = { alpha = 1, nu = 6, d0 = 0.1 }\n";
        let text: String = [head.to_owned()].into_iter().chain((0..4).map(body)).collect();
        let scene = gyration_scene::Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
        let spring = SpringLaw { stiffness: 1.0, rest_length: 0.0, damping: 0.0 };
        let spring = Spring::between([3, 1], [Vec3::zeros(); 2], spring);
        let model = scene.built().model.clone().with_springs(vec![spring]);
        let may_be =
            |islands: &[&[usize]]| may_be_islands(&model, &islands.iter().map(|it| it.to_vec()).collect::<Vec<_>>());
        assert!(may_be(&[&[0], &[1, 3], &[2]]) && may_be(&[&[0, 1, 3], &[2]]) && may_be(&[&[0, 1, 2, 3]]));
        // One parted, one missing, one twice, one too many, one that does not ascend, two exchanged, an empty one.
        for wrong in [
            &[&[0][..], &[1], &[2], &[3]][..],
            &[&[0], &[1, 3]],
            &[&[0], &[1, 3], &[2], &[2]],
            &[&[0], &[1, 3], &[2, 4]],
            &[&[0], &[3, 1], &[2]],
            &[&[1, 3], &[0], &[2]],
            &[&[0], &[], &[1, 3], &[2]],
        ] {
            assert!(!may_be(wrong), "{wrong:?}");
        }
    }
}
