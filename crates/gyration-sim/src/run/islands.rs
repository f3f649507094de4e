//! The islands of a run, each where its first body is: to put one there or to take it away moves no other.

use crate::island::Island;
use std::ops::{Index, IndexMut};

/// Islands in order of their first bodies; boxed, since each is kilobytes and most bodies are not the first of one.
pub(crate) struct Islands {
    by_first_body: Vec<Option<Box<Island>>>,
    count: usize,
}

impl Islands {
    /// None yet, of so many bodies.
    pub fn for_bodies(bodies: usize) -> Self {
        Self { by_first_body: (0..bodies).map(|_| None).collect(), count: 0 }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.count
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &Island> {
        self.by_first_body.iter().filter_map(|island| island.as_deref())
    }

    /// All of them.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Island> {
        self.by_first_body.iter_mut().filter_map(|island| island.as_deref_mut())
    }

    /// The only one; none where there are several.
    pub fn only(&mut self) -> Option<&mut Island> {
        if self.count == 1 { self.iter_mut().next() } else { None }
    }

    /// That of this first body.
    pub fn get(&self, first: usize) -> Option<&Island> {
        self.by_first_body.get(first)?.as_deref()
    }

    /// Puts an island to the others, none of which has its bodies.
    pub fn put(&mut self, island: Box<Island>) {
        let place = &mut self.by_first_body[island.first_body()];
        debug_assert!(place.is_none(), "each body is in one island");
        *place = Some(island);
        self.count += 1;
    }

    /// Takes away that of this first body.
    ///
    /// # Panics
    /// If no island begins with this body.
    pub fn take(&mut self, first: usize) -> Box<Island> {
        let island = self.by_first_body.get_mut(first).and_then(Option::take);
        self.count -= usize::from(island.is_some());
        island.unwrap_or_else(|| panic!("no island begins with body {first}"))
    }
}

impl Index<usize> for Islands {
    type Output = Island;

    /// # Panics
    /// If no island begins with this body.
    fn index(&self, first: usize) -> &Island {
        self.get(first).unwrap_or_else(|| panic!("no island begins with body {first}"))
    }
}

impl IndexMut<usize> for Islands {
    fn index_mut(&mut self, first: usize) -> &mut Island {
        let island = self.by_first_body.get_mut(first).and_then(|island| island.as_deref_mut());
        island.unwrap_or_else(|| panic!("no island begins with body {first}"))
    }
}
