//! Which islands become one, and which fall apart, in order of time.
//!
//! Islands go on as if there were no others; what they do is right up to the first time at which two of them may have
//! met. The earliest change of all is carried out, the islands that it concerns begin anew there, and all is looked at
//! again. A change that is carried out stands: none that is found later comes before it.

use super::Simulation;
use crate::island::Island;
use crate::outcome::Stop;
use gyration::model::Model;
use gyration_ode::{Components, Pattern};

/// The pairs of bodies that act on one another within a reach.
#[derive(Debug, Default)]
pub(super) struct Meetings {
    pairs: Vec<([usize; 2], f64)>,
}

/// A change of the islands.
#[derive(Debug, Clone, PartialEq)]
enum Change {
    /// Two islands may meet within steps of which the later one begins here.
    Meets([usize; 2]),
    /// An island waits to fall apart.
    Parts(usize),
}

impl Meetings {
    /// Those of a model.
    pub fn of(model: &Model) -> Self {
        Self { pairs: model.cutoffs().filter_map(|(bodies, reach)| Some((bodies, reach?))).collect() }
    }

    /// Whether no body meets another.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// The sets of bodies that act on one another however far they are.
    pub fn always_joined(&self, model: &Model) -> Vec<Vec<usize>> {
        let always = model.cutoffs().filter(|(_, reach)| reach.is_none());
        let bodies = model.bodies.len();
        let joined = Components::of(&Pattern::new(bodies, always.map(|(bodies, _)| bodies.into())), bodies);
        joined.iter().map(<[usize]>::to_vec).collect()
    }

    /// Whether these could be the islands of a model: each body in one of them, with all to which it is joined.
    pub fn may_be(&self, model: &Model, islands: &[Vec<usize>]) -> bool {
        let always = self.always_joined(model);
        if self.is_empty() {
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
        let whole = |joined: &Vec<usize>| {
            joined.iter().all(|body| island_of[*body].is_some() && island_of[*body] == island_of[joined[0]])
        };
        islands.iter().all(|members| members.is_sorted()) && always.iter().all(whole)
    }
}

/// The island of each body, and its place there.
pub(super) fn island_of(bodies: usize, islands: &[Island]) -> Vec<(usize, usize)> {
    let mut island_of = vec![(0, 0); bodies];
    for (index, island) in islands.iter().enumerate() {
        island.members().iter().enumerate().for_each(|(place, body)| island_of[*body] = (index, place));
    }
    island_of
}

impl Simulation {
    /// Carries out the earliest change of the islands, if it comes before a time; whether there was one. One at that
    /// time is left to the next window.
    ///
    /// # Errors
    /// [`Stop`] where the islands cannot go on as they are to.
    pub(super) fn change_islands(&mut self, until: f64) -> Result<bool, Stop> {
        match self.first_change().filter(|(time, _)| *time < until) {
            None => Ok(false),
            Some((time, Change::Meets(islands))) => self.unite(islands, time).map(|()| true),
            Some((_, Change::Parts(island))) => self.part(island).map(|()| true),
        }
    }

    /// The time of the first change of the islands [s]; infinite if none is known.
    pub(super) fn change_time(&self) -> f64 {
        self.first_change().map_or(f64::INFINITY, |(time, _)| time)
    }

    /// The earliest change within what is known of all islands.
    fn first_change(&self) -> Option<(f64, Change)> {
        if self.meetings.is_empty() {
            return None;
        }
        let known = self.least_time();
        let first = match (self.first_meeting(), self.first_parting()) {
            (Some(meets), Some(parts)) if parts.0 < meets.0 => Some(parts),
            (meets, parts) => meets.or(parts),
        };
        first.filter(|(time, _)| *time <= known)
    }

    /// To where a window has come that went until a time [s]: where the island is that has come least far, but not
    /// beyond what it was to see, since islands may change there, nor beyond its portion of rows.
    pub(super) fn window_reached(&self, until: f64) -> f64 {
        let only_steps = matches!(&self.islands[..], [only] if only.restart_point.is_none());
        let least = self.least_time().min(if only_steps { f64::INFINITY } else { self.portion });
        match (self.meetings.is_empty(), self.is_step(until)) {
            (true, _) => least,
            (false, true) => least.min(self.change_time()),
            (false, false) => least.min(until),
        }
    }

    /// The first time from which on two islands may not be followed apart.
    fn first_meeting(&self) -> Option<(f64, Change)> {
        let mut first: Option<(f64, [usize; 2])> = None;
        for (bodies, reach) in &self.meetings.pairs {
            let [one, other] = bodies.map(|body| self.island_of[body]);
            if one.0 == other.0 {
                continue;
            }
            let path_bounds = |(island, place): (usize, usize)| {
                self.islands[island].path_bounds.iter().flat_map(move |path_bounds| &path_bounds[place])
            };
            for bound in path_bounds(one) {
                for beside in path_bounds(other).filter(|beside| beside.start < bound.end && bound.start < beside.end) {
                    let time = bound.start.max(beside.start);
                    let earlier = first.is_none_or(|first| time < first.0);
                    if earlier && bound.may_meet(beside, *reach) {
                        first = Some((time, [one.0.min(other.0), one.0.max(other.0)]));
                    }
                }
            }
        }
        first.map(|(time, islands)| (time, Change::Meets(islands)))
    }

    /// The first island that waits to fall apart.
    fn first_parting(&self) -> Option<(f64, Change)> {
        let waiting = self.islands.iter().enumerate().filter(|(_, island)| island.state.is_parting);
        let first = waiting.min_by(|(_, a), (_, b)| a.time().total_cmp(&b.time()));
        first.map(|(index, island)| (island.time(), Change::Parts(index)))
    }

    /// Makes one island of two at a time.
    fn unite(&mut self, [one, other]: [usize; 2], time: f64) -> Result<(), Stop> {
        for island in [one, other] {
            self.islands[island].come_to(time, &self.plan, self.state.time)?;
        }
        let second = self.islands.remove(other);
        let first = self.islands.remove(one);
        let mut members = [first.members(), second.members()].concat();
        members.sort_unstable();
        let works = [&first, &second].map(|island| island.integrator.quadratures());
        let in_play = first.state.in_play.merged(works[0], second.state.in_play, works[1]);
        let united = Island::successor(self.setting(), members, &[&first, &second], in_play);
        match united {
            Ok(mut united) => {
                united.take_events([&first, &second]);
                self.settle_works([&first, &second]);
                self.put([united]);
            }
            Err(stop) => {
                self.put([first, second]);
                return Err(stop);
            }
        }
        Ok(())
    }

    /// Lets an island fall apart where it stands.
    fn part(&mut self, index: usize) -> Result<(), Stop> {
        let island = &self.islands[index];
        let whole = island.kinetic_energy(0..island.members().len());
        let components = island.parts();
        let count = components.iter().count() as f64;
        let parts = components.iter().map(|places| {
            let members = places.iter().map(|place| island.members()[*place]).collect();
            let kinetic = island.kinetic_energy(places.iter().copied());
            let share = if whole > 0.0 { kinetic / whole } else { 1.0 / count };
            let in_play = island.state.in_play.share(island.integrator.quadratures(), share);
            Island::successor(self.setting(), members, &[island], in_play)
        });
        let mut parts = parts.collect::<Result<Vec<Island>, Stop>>()?;
        let island = self.islands.remove(index);
        // Its events are handed on by any of the parts.
        parts[0].take_events([&island]);
        self.settle_works([&island]);
        self.put(parts);
        Ok(())
    }

    /// Keeps what islands have done that end here.
    fn settle_works<'a>(&mut self, ended: impl IntoIterator<Item = &'a Island>) {
        let count = self.model.works().len();
        for island in ended {
            self.state.settled.take(count, island.works(), &island.integrator);
        }
    }

    /// Puts islands to the others, all in order of their first bodies.
    fn put(&mut self, islands: impl IntoIterator<Item = Island>) {
        self.islands.extend(islands);
        self.islands.sort_by_key(|island| island.members()[0]);
        self.island_of = island_of(self.model.bodies.len(), &self.islands);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration::load::{Bond, SpringLaw};
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
        let bond = Bond { bodies: [3, 1], points: [Vec3::zeros(); 2], law: spring };
        let model = scene.built().model.clone().bonded(vec![bond]);
        let meetings = Meetings::of(&model);
        let may_be =
            |islands: &[&[usize]]| meetings.may_be(&model, &islands.iter().map(|it| it.to_vec()).collect::<Vec<_>>());
        assert!(may_be(&[&[0], &[1, 3], &[2]]) && may_be(&[&[0, 1, 3], &[2]]) && may_be(&[&[0, 1, 2, 3]]));
        // One parted, one missing, one twice, one too many, one that does not ascend.
        for wrong in [
            &[&[0][..], &[1], &[2], &[3]][..],
            &[&[0], &[1, 3]],
            &[&[0], &[1, 3], &[2], &[2]],
            &[&[0], &[1, 3], &[2, 4]],
            &[&[0], &[3, 1], &[2]],
        ] {
            assert!(!may_be(wrong), "{wrong:?}");
        }
    }
}
