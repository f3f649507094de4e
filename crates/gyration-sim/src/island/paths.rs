//! The paths of the bodies of an island since the time of the run, step by step, and which of them are new.

use super::path_bound::PathBound;

/// Bounds of the paths of some bodies since the time of the run.
#[derive(Debug)]
pub(crate) struct Paths {
    /// Of each body, in order of time: one a step.
    bounds: Vec<Vec<PathBound>>,
    /// How many of the last steps nobody has looked at.
    unseen: usize,
    /// What they are known by since they were begun; none before somebody looks.
    revision: Option<u64>,
}

impl Paths {
    /// Of so many bodies that have not moved yet.
    pub fn of(bodies: usize) -> Self {
        Self { bounds: vec![Vec::new(); bodies], unseen: 0, revision: None }
    }

    /// Those of a body.
    pub fn body(&self, place: usize) -> &[PathBound] {
        &self.bounds[place]
    }

    /// The numbers of all bounds, body by body.
    pub fn numbers(&self) -> Vec<f64> {
        self.bounds.iter().flatten().flat_map(PathBound::numbers).collect()
    }

    /// Becomes paths of the same bodies with these numbers, of whose last steps so many are new; none where the numbers
    /// are not those of bounds.
    pub fn become_those_of(&mut self, numbers: &[f64], unseen: usize) -> Option<()> {
        let (bounds, []) = numbers.as_chunks() else { return None };
        let steps = bounds.len() / self.bounds.len();
        if steps * self.bounds.len() != bounds.len() || unseen > steps {
            return None;
        }
        for (body, own) in self.bounds.iter_mut().enumerate() {
            own.clear();
            own.extend(bounds[body * steps..(body + 1) * steps].iter().map(|numbers| PathBound::of_numbers(*numbers)));
        }
        self.unseen = unseen;
        Some(())
    }

    /// Where each step begins [s].
    pub fn beginnings(&self) -> impl Iterator<Item = f64> {
        self.bounds.first().into_iter().flatten().map(|bound| bound.start)
    }

    /// Adds a step.
    pub fn push(&mut self, step: impl Iterator<Item = PathBound>) {
        for (bounds, bound) in self.bounds.iter_mut().zip(step) {
            bounds.push(bound);
        }
        self.unseen += 1;
    }

    /// Begins anew.
    pub fn clear(&mut self) {
        self.bounds.iter_mut().for_each(Vec::clear);
        (self.unseen, self.revision) = (0, None);
    }

    /// Forgets the steps that end at a time or before.
    pub fn forget(&mut self, time: f64) {
        let past = self.bounds.first().map_or(0, |steps| steps.partition_point(|bound| bound.end <= time));
        if past > 0 {
            self.bounds.iter_mut().for_each(|steps| drop(steps.drain(..past)));
            self.unseen = self.unseen.min(self.bounds[0].len());
        }
    }

    /// What they are known by; none before somebody looks.
    pub fn revision(&self) -> Option<u64> {
        self.revision
    }

    /// How many of the last steps nobody has looked at.
    pub fn unseen(&self) -> usize {
        self.unseen
    }

    /// Notes that somebody has looked at all steps; they are then known by this number, unless they are by another.
    pub fn saw(&mut self, number: u64) {
        self.unseen = 0;
        self.revision.get_or_insert(number);
    }
}
