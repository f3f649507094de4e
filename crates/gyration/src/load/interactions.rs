//! What acts between two parties, found by body.

use crate::lattice::{Cell, HERE, opposite};
use crate::party::Party;
use std::sync::Arc;

/// Something between a body of a model and another party.
pub trait Interaction {
    /// The two, of which the first is a body; they differ, unless the second is in another cell.
    fn parties(&self) -> [Party; 2];

    /// The cell of the second as seen from that of the first.
    fn cell(&self) -> Cell {
        HERE
    }
}

/// The bodies among two parties.
fn bodies_of(parties: [Party; 2]) -> impl Iterator<Item = usize> {
    parties.into_iter().filter_map(Party::body)
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

    /// The other party.
    pub fn other(&self) -> Party {
        self.interaction.parties()[1 - self.end]
    }

    /// The cell of the other party as seen from the body's own.
    pub fn cell(&self) -> Cell {
        if self.end == 0 { self.interaction.cell() } else { opposite(self.interaction.cell()) }
    }
}

impl<J: Interaction> Interactions<J> {
    /// The interactions of so many bodies.
    ///
    /// # Panics
    /// If one has no body first, joins a body to itself in the same cell, or names one that does not exist.
    pub fn new(bodies: usize, all: Vec<J>) -> Self {
        if all.is_empty() {
            return Self::default();
        }
        let joins = |interaction: &J| {
            let [one, other] = interaction.parties();
            let differ = one != other || interaction.cell() != HERE;
            one.body().is_some() && differ && bodies_of([one, other]).all(|body| body < bodies)
        };
        assert!(all.iter().all(joins), "an interaction is between one of the {bodies} bodies and another party");
        // Sorted by counting: a crowd has millions.
        let mut starts = vec![0; bodies + 1];
        let concerned = all.iter().flat_map(|interaction| bodies_of(interaction.parties()));
        concerned.for_each(|body| starts[body + 1] += 1);
        (0..bodies).for_each(|body| starts[body + 1] += starts[body]);
        let (mut next, mut ends) = (starts.clone(), vec![(0, 0); starts[bodies]]);
        for (number, interaction) in all.iter().enumerate() {
            for (end, party) in interaction.parties().into_iter().enumerate() {
                if let Party::Body(body) = party {
                    ends[next[body]] = (number, end);
                    next[body] += 1;
                }
            }
        }
        Self { all: all.into(), starts: starts.into(), ends: ends.into() }
    }

    /// All of them.
    pub fn all(&self) -> &[J] {
        &self.all
    }

    /// Those of a body, in order.
    pub fn of(&self, body: usize) -> impl Iterator<Item = InteractionEnd<'_, J>> + Clone {
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

    /// Others between the same parties.
    #[must_use]
    pub fn changed(&self, change: impl Fn(&J) -> J) -> Self {
        let all: Arc<[J]> = self.all.iter().map(change).collect();
        debug_assert!(all.iter().map(J::parties).eq(self.all.iter().map(J::parties)), "they join whom they joined");
        Self { all, starts: Arc::clone(&self.starts), ends: Arc::clone(&self.ends) }
    }

    /// Those that have none but some bodies, which ascend, as `renumbered` makes them with the places of their bodies
    /// among these.
    #[must_use]
    pub fn among(&self, members: &[usize], renumbered: impl Fn(&J, [Party; 2]) -> J) -> Self {
        let place = |party: Party| match party {
            Party::Body(body) => members.binary_search(&body).ok().map(Party::Body),
            Party::Support(_) | Party::SolidSupport(_) | Party::Space => Some(party),
        };
        let within = |end: InteractionEnd<J>| {
            let [Some(one), Some(other)] = end.interaction.parties().map(place) else { return None };
            Some((end.number, renumbered(end.interaction, [one, other])))
        };
        let counted = members.iter().flat_map(|body| self.of(*body)).filter(InteractionEnd::counts);
        let mut numbered: Vec<(usize, J)> = counted.filter_map(within).collect();
        numbered.sort_by_key(|(number, _)| *number);
        Self::new(members.len(), numbered.into_iter().map(|(_, interaction)| interaction).collect())
    }
}
