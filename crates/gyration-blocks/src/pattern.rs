//! Which blocks of a state enter the rates of which others.
//!
//!   ∂f_i/∂y_j ≠ 0   only for i = j and for the pairs (i, j) of the pattern
//!
//! A pattern says where numbers may stand, not what they are. Blocks that hang together through any chain of pairs form
//! a component; the equations of two components can be solved apart.

use std::sync::Arc;

/// The pairs (i, j), i ≠ j, in which block j enters the rates of block i; the diagonal is always understood.
///
/// Copies share them: there may be millions, and each step asks whether they are still the same.
#[derive(Debug, Clone, Default)]
pub struct Pattern(Option<Arc<Coupled>>);

/// The pairs of a pattern that has some.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Coupled {
    /// Where the columns of each row begin, and where the last end.
    starts: Vec<usize>,
    /// The columns of all rows, ascending within each.
    columns: Vec<usize>,
    /// How many of the first rates of each block only the block itself enters; empty if of none.
    local_rates: Vec<usize>,
}

impl PartialEq for Pattern {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (Some(own), Some(other)) => Arc::ptr_eq(own, other) || own == other,
            (None, None) => true,
            _ => false,
        }
    }
}

impl Eq for Pattern {}

impl Pattern {
    /// No block enters the rates of another.
    pub const fn uncoupled() -> Self {
        Self(None)
    }

    /// The pattern of so many blocks and of these pairs (row, column), in any order; repetitions and i = j do no harm.
    ///
    /// # Panics
    /// If a pair names a block that does not exist: a mistake in the system, not in its data.
    pub fn new(blocks: usize, pairs: impl IntoIterator<Item = (usize, usize)>) -> Self {
        let mut pairs: Vec<_> = pairs.into_iter().filter(|(row, column)| row != column).collect();
        if pairs.is_empty() {
            return Self::uncoupled();
        }
        pairs.sort_unstable();
        pairs.dedup();
        assert!(pairs.iter().all(|(row, column)| row.max(column) < &blocks), "a pair of blocks beyond {blocks}");
        let starts = (0..=blocks).map(|row| pairs.partition_point(|pair| pair.0 < row)).collect();
        let columns = pairs.into_iter().map(|(_, column)| column).collect();
        Self(Some(Arc::new(Coupled { starts, columns, local_rates: Vec::new() })))
    }

    /// States how many of the first rates of each block only the block itself enters, as those of positions where it is
    /// forces that couple. Their unknowns are eliminated first, which leaves so many fewer for the rest.
    ///
    /// # Panics
    /// If these are not as many numbers as there are blocks.
    #[must_use]
    pub fn with_local_rates(mut self, counts: Vec<usize>) -> Self {
        assert!(self.fits(counts.len()), "{} counts of local rates for other blocks", counts.len());
        if let Some(coupled) = self.0.as_mut().filter(|_| counts.iter().any(|count| *count > 0)) {
            Arc::make_mut(coupled).local_rates = counts;
        }
        self
    }

    /// How many of the first rates of a block only the block itself enters.
    pub(crate) fn local_rates(&self, block: usize) -> usize {
        self.0.as_ref().and_then(|coupled| coupled.local_rates.get(block)).copied().unwrap_or(0)
    }

    /// The number of pairs.
    pub fn pairs(&self) -> usize {
        self.0.as_ref().map_or(0, |coupled| coupled.columns.len())
    }

    /// The other blocks that enter the rates of a block, ascending.
    pub fn columns(&self, row: usize) -> &[usize] {
        self.0.as_ref().map_or(&[], |coupled| &coupled.columns[self.places(row)])
    }

    /// The places of the pairs of a row among all pairs.
    pub(crate) fn places(&self, row: usize) -> std::ops::Range<usize> {
        match &self.0 {
            Some(coupled) if row + 1 < coupled.starts.len() => coupled.starts[row]..coupled.starts[row + 1],
            _ => 0..0,
        }
    }

    /// The place of a pair among all pairs.
    pub(crate) fn place(&self, row: usize, column: usize) -> Option<usize> {
        self.columns(row).binary_search(&column).ok().map(|k| self.places(row).start + k)
    }

    /// Whether the pattern can be one of so many blocks.
    pub fn fits(&self, blocks: usize) -> bool {
        self.0.as_ref().is_none_or(|coupled| coupled.starts.len() == blocks + 1)
    }
}

/// The components of a pattern, in the order of their first blocks; the blocks of each ascend.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Components {
    starts: Vec<usize>,
    members: Vec<usize>,
}

impl Components {
    /// Each block is one, however many there are; none of them is listed.
    pub const fn apart() -> Self {
        Self { starts: Vec::new(), members: Vec::new() }
    }

    /// Whether these, which are listed, are the same as others, which may not be.
    pub fn are(&self, others: &Self) -> bool {
        if others.starts.is_empty() { self.are_apart() } else { self == others }
    }

    /// The same of so many blocks, each listed.
    ///
    /// # Panics
    /// If these are components of another number of blocks: a mistake in the system, not in its data.
    pub fn listed(&self, blocks: usize) -> Self {
        if self.starts.is_empty() {
            return Self::joined(blocks, []);
        }
        assert!(self.members.len() == blocks, "the components are not those of {blocks} blocks");
        self.clone()
    }

    /// Whether each pair of a pattern is within one of these, which are listed.
    pub fn contain(&self, pattern: &Pattern) -> bool {
        let mut set = vec![0; self.members.len()];
        for (k, members) in self.iter().enumerate() {
            members.iter().for_each(|block| set[*block] = k);
        }
        (0..set.len()).all(|row| pattern.columns(row).iter().all(|column| set[row] == set[*column]))
    }

    /// Whether each block is one.
    pub fn are_apart(&self) -> bool {
        self.iter().all(|members| members.len() == 1)
    }

    /// The components of a pattern of so many blocks.
    pub fn of(pattern: &Pattern, blocks: usize) -> Self {
        Self::joined(blocks, (0..blocks).flat_map(|row| pattern.columns(row).iter().map(move |column| [row, *column])))
    }

    /// So many blocks, of which these pairs hang together.
    ///
    /// # Panics
    /// If a pair names a block that does not exist.
    pub fn joined(blocks: usize, pairs: impl IntoIterator<Item = [usize; 2]>) -> Self {
        let mut first: Vec<usize> = (0..blocks).collect();
        for [one, other] in pairs {
            let (a, b) = (root(&mut first, one), root(&mut first, other));
            first[a.max(b)] = a.min(b);
        }
        let mut members: Vec<usize> = (0..blocks).collect();
        let roots: Vec<usize> = members.iter().map(|block| root(&mut first, *block)).collect();
        members.sort_by_key(|block| roots[*block]);
        let begins = |k: usize| k == 0 || roots[members[k]] != roots[members[k - 1]];
        let starts = (0..blocks).filter(|k| begins(*k)).chain([blocks]).collect();
        Self { starts, members }
    }

    /// The blocks of each component.
    pub fn iter(&self) -> impl Iterator<Item = &[usize]> {
        self.starts.windows(2).map(|ends| &self.members[ends[0]..ends[1]])
    }
}

/// The first block known to hang together with a block; shortens the way there.
fn root(first: &mut [usize], mut block: usize) -> usize {
    while first[block] != block {
        first[block] = first[first[block]];
        block = first[block];
    }
    block
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_sorted_by_row_and_counted_once() {
        let pattern = Pattern::new(4, [(2, 1), (0, 3), (2, 0), (2, 1), (1, 1)]);
        assert_eq!((pattern.columns(0), pattern.columns(1), pattern.columns(2)), (&[3][..], &[][..], &[0, 1][..]));
        assert_eq!((pattern.pairs(), pattern.place(2, 1), pattern.place(1, 2)), (3, Some(2), None));
        assert_eq!(Pattern::new(4, [(3, 3)]), Pattern::uncoupled());
    }

    #[test]
    fn components_hang_together_whichever_block_feels_the_other() {
        let components = |pairs: &[(usize, usize)]| {
            let pattern = Pattern::new(6, pairs.iter().copied());
            Components::of(&pattern, 6).iter().map(<[usize]>::to_vec).collect::<Vec<_>>()
        };
        assert_eq!(components(&[(5, 1), (3, 5), (0, 2)]), [vec![0, 2], vec![1, 3, 5], vec![4]]);
        assert_eq!(components(&[]), (0..6).map(|block| vec![block]).collect::<Vec<_>>());
        assert_eq!(Components::of(&Pattern::uncoupled(), 0).iter().count(), 0);
    }
}
