//! What acts between two bodies, found by body.

use std::sync::Arc;

/// Something between two bodies of a model.
pub trait Interaction {
    /// The indices of the two bodies, which differ.
    fn bodies(&self) -> [usize; 2];
}

/// An interaction as one of its bodies sees it.
#[derive(Debug)]
pub struct InteractionEnd<'a, J> {
    /// Its number in the model.
    pub number: usize,
    /// The interaction.
    pub interaction: &'a J,
    /// Which of its ends is the body's own, 0 or 1.
    pub end: usize,
}

/// The interactions of a model, which copies of it share.
#[derive(Debug, Clone)]
pub struct Interactions<J> {
    all: Arc<[J]>,
    /// Where the ends of each body begin, and where the last end; empty without interactions.
    starts: Arc<[usize]>,
    /// The number of an interaction and which of its ends it is, body by body.
    ends: Arc<[(usize, usize)]>,
}

impl<J> Clone for InteractionEnd<'_, J> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<J> Copy for InteractionEnd<'_, J> {}

impl<J> Default for Interactions<J> {
    fn default() -> Self {
        Self { all: Arc::from([]), starts: Arc::from([]), ends: Arc::from([]) }
    }
}

impl<J: Interaction> InteractionEnd<'_, J> {
    /// Whether energy and dissipation are counted here.
    pub fn counts(&self) -> bool {
        self.end == 0
    }

    /// The other body.
    pub fn other(&self) -> usize {
        self.interaction.bodies()[1 - self.end]
    }
}

impl<J: Interaction> Interactions<J> {
    /// The interactions between so many bodies.
    ///
    /// # Panics
    /// If one joins a body to itself, or names one that does not exist.
    pub fn new(bodies: usize, all: Vec<J>) -> Self {
        if all.is_empty() {
            return Self::default();
        }
        let joins = |[one, other]: [usize; 2]| one != other && one.max(other) < bodies;
        assert!(
            all.iter().all(|interaction| joins(interaction.bodies())),
            "an interaction is between two of the {bodies} bodies"
        );
        // Sorted by counting: a crowd has millions.
        let mut starts = vec![0; bodies + 1];
        all.iter().flat_map(J::bodies).for_each(|body| starts[body + 1] += 1);
        (0..bodies).for_each(|body| starts[body + 1] += starts[body]);
        let (mut next, mut ends) = (starts.clone(), vec![(0, 0); 2 * all.len()]);
        for (number, interaction) in all.iter().enumerate() {
            for (end, body) in interaction.bodies().into_iter().enumerate() {
                ends[next[body]] = (number, end);
                next[body] += 1;
            }
        }
        Self { all: all.into(), starts: starts.into(), ends: ends.into() }
    }

    /// All of them.
    pub fn all(&self) -> &[J] {
        &self.all
    }

    /// Those of a body, in order.
    pub fn of(&self, body: usize) -> impl Iterator<Item = InteractionEnd<'_, J>> {
        let ends = if body + 1 < self.starts.len() { self.starts[body]..self.starts[body + 1] } else { 0..0 };
        self.ends[ends].iter().map(|(number, end)| InteractionEnd {
            number: *number,
            interaction: &self.all[*number],
            end: *end,
        })
    }

    /// Whether these are the same as others, or a copy of them.
    pub fn are(&self, others: &Self) -> bool {
        Arc::ptr_eq(&self.all, &others.all)
    }

    /// Those between some bodies, which ascend, as `renumbered` makes them with the places of their bodies among these.
    #[must_use]
    pub fn among(&self, members: &[usize], renumbered: impl Fn(&J, [usize; 2]) -> J) -> Self {
        let place = |body: usize| members.binary_search(&body).ok();
        let within = |end: InteractionEnd<J>| {
            let [Some(one), Some(other)] = end.interaction.bodies().map(place) else { return None };
            Some((end.number, renumbered(end.interaction, [one, other])))
        };
        let counted = members.iter().flat_map(|body| self.of(*body)).filter(InteractionEnd::counts);
        let mut numbered: Vec<(usize, J)> = counted.filter_map(within).collect();
        numbered.sort_by_key(|(number, _)| *number);
        Self::new(members.len(), numbered.into_iter().map(|(_, interaction)| interaction).collect())
    }
}
