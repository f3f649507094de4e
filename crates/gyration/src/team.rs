//! A team of threads, among which an evaluation of many pairs and bodies shares them out. The mechanics starts no
//! thread: whoever has some lends them.
//!
//! Each item has a place of its own for what is found of it, and depends on no other item. Sums over them are made
//! afterwards, in their order: which thread does what leaves no trace in any number.

use std::num::NonZeroUsize;
use std::sync::{Mutex, PoisonError};

/// Fewer items than so many a piece are not worth a thread.
const LEAST: usize = 4;
/// Pieces of work for each thread: some items take longer than others.
const PIECES: usize = 4;

/// Does each of so many jobs once, by their numbers, on so many threads at most; returns when all are done.
pub type EachOnThreads = fn(NonZeroUsize, usize, &(dyn Fn(usize) + Sync));

/// Threads that somebody lends.
#[derive(Debug, Clone, Copy)]
pub struct Team {
    /// How many.
    pub threads: NonZeroUsize,
    /// How they are set to work.
    pub each: EachOnThreads,
}

impl Team {
    /// One of so many threads; none of fewer than two.
    pub fn new(threads: usize, each: EachOnThreads) -> Option<Self> {
        let threads = NonZeroUsize::new(threads).filter(|threads| threads.get() > 1)?;
        Some(Self { threads, each })
    }
}

/// Scratch: one for whoever works alone, and as many more as there are pieces that may be worked on at once.
#[derive(Debug)]
pub(crate) struct Rooms<'a, R> {
    pub own: &'a mut R,
    pub others: &'a mut Vec<R>,
}

impl<R> Rooms<'_, R> {
    /// The same, lent further.
    pub fn lend(&mut self) -> Rooms<'_, R> {
        Rooms { own: self.own, others: self.others }
    }
}

/// Finds each of the items, in the order of which the first error is told. Each piece of them has a room.
pub(crate) fn find_each<T: Send, R: Default + Send, E: Send>(
    team: Option<Team>,
    items: &mut [T],
    Rooms { own, others }: Rooms<R>,
    find: impl Fn(usize, &mut T, &mut R) -> Result<(), E> + Sync,
) -> Result<(), E> {
    let pieces = team.map_or(1, |team| PIECES * team.threads.get());
    let length = items.len().div_ceil(pieces).max(LEAST);
    let count = items.len().div_ceil(length).max(1);
    let find_piece = |first: usize, piece: &mut [T], room: &mut R| {
        piece.iter_mut().enumerate().try_for_each(|(place, item)| find(first + place, item, room))
    };
    let Some(team) = team.filter(|_| count > 1) else {
        return find_piece(0, items, own);
    };
    if others.len() + 1 < count {
        others.resize_with(count - 1, R::default);
    }
    let rooms = std::iter::once(own).chain(others);
    let pieces = items.chunks_mut(length).zip(rooms).map(|(piece, room)| Mutex::new((piece, room, Ok(()))));
    let pieces: Vec<_> = pieces.collect();
    (team.each)(team.threads, count, &|number| {
        let mut piece = pieces[number].lock().unwrap_or_else(PoisonError::into_inner);
        let (items, room, found) = &mut *piece;
        *found = find_piece(number * length, items, room);
    });
    let found = |piece: Mutex<(_, _, Result<(), E>)>| piece.into_inner().unwrap_or_else(PoisonError::into_inner).2;
    pieces.into_iter().try_for_each(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The jobs one after the other, the last one first.
    fn backward(_: NonZeroUsize, count: usize, job: &(dyn Fn(usize) + Sync)) {
        (0..count).rev().for_each(job);
    }

    #[test]
    fn items_are_found_as_if_one_after_the_other() {
        let team = Team { threads: NonZeroUsize::new(3).unwrap(), each: backward };
        for count in [0, 1, 5, 47, 1000] {
            let found = |team: Option<Team>, worst: usize| {
                let mut items = vec![0; count];
                let (mut own, mut others) = (0, Vec::new());
                let rooms = Rooms { own: &mut own, others: &mut others };
                let all = find_each(team, &mut items, rooms, |index, item, room| {
                    *item = index * index;
                    *room += 1;
                    if index >= worst { Err(index) } else { Ok(()) }
                });
                (items, all, own + others.iter().sum::<usize>(), others.len())
            };
            let (alone, shared) = (found(None, usize::MAX), found(Some(team), usize::MAX));
            assert_eq!(alone.0, (0..count).map(|index| index * index).collect::<Vec<_>>());
            assert_eq!((&alone.0, alone.1, alone.2), (&shared.0, shared.1, shared.2));
            assert!(alone.3 == 0 && (shared.3 > 0) == (count > LEAST), "{} more rooms for {count}", shared.3);
            // Of two that fail the first one is told.
            assert_eq!(found(Some(team), 30).1, if count > 30 { Err(30) } else { Ok(()) });
        }
    }
}
