//! The order in which the blocks of a component are eliminated, and which blocks their factors have.
//!
//!   struct(k) = {blocks after k that couple with k} ∪ struct(c) \ {k}   for every child c, min struct(c) = k
//!
//! Blocks are ordered by minimum degree over the graph of blocks, which is far smaller than that of the single
//! unknowns. Everything here follows from the pattern alone: it is done once for each, and a run continued from a
//! checkpoint comes to the same order. Source: Amestoy, Davis, Duff, *ACM Trans. Math. Softw.* 30 (2004); Davis,
//! *Direct Methods for Sparse Linear Systems*, §4.1.

use std::ops::Range;

use crate::block_matrix::BlockMatrix;

/// Where the factors of a component stand: block k of the elimination, its diagonal first, then the blocks below it,
/// then those beside it.
#[derive(Debug, Clone, Default)]
pub struct Analysis {
    /// The block of each step of the elimination.
    pub(crate) blocks: Vec<usize>,
    /// The unknowns of local rates of each step, in the whole vector.
    pub(crate) local: Vec<Range<usize>>,
    /// The other unknowns of each step, in the whole vector.
    pub(crate) unknowns: Vec<Range<usize>>,
    /// Where the unknowns of each step stand in the order of the elimination, and where the last end.
    pub(crate) firsts: Vec<usize>,
    /// Where the followers of each step begin among all followers.
    starts: Vec<usize>,
    /// The later steps whose blocks a step changes, ascending.
    followers: Vec<usize>,
    /// Where the factors of each step begin, and where the last end.
    pub(crate) offsets: Vec<usize>,
    /// The blocks of the matrix: row, column and where they go.
    pub(crate) entries: Vec<BlockEntry>,
}

/// A block of the matrix, by the steps of its row and its column, and its place among the factors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BlockEntry {
    pub row: usize,
    pub column: usize,
    pub place: usize,
}

impl Analysis {
    /// Analyses the component of these blocks, of which `ranges` are the unknowns.
    pub fn of(component: &[usize], ranges: &[Range<usize>], matrix: &BlockMatrix) -> Self {
        let component: Vec<usize> = component.iter().copied().filter(|block| !ranges[*block].is_empty()).collect();
        let neighbours = neighbours(&component, matrix);
        let order = minimum_degree(&neighbours);
        let mut steps = vec![0; order.len()];
        for (step, block) in order.iter().enumerate() {
            steps[*block] = step;
        }
        let blocks: Vec<usize> = order.iter().map(|block| component[*block]).collect();
        // One unknown at least is left to couple.
        let local = |block: usize| matrix.pattern().local_rates(block).min(ranges[block].len() - 1);
        let split = |block: &usize| {
            let Range { start, end } = ranges[*block];
            (start..start + local(*block), start + local(*block)..end)
        };
        let (local, unknowns) = blocks.iter().map(split).unzip();
        let mut analysis = Self { blocks, local, unknowns, ..Self::default() };
        analysis.follow(&order, &steps, &neighbours);
        analysis.place();
        for row in &component {
            let local = |block: &usize| component.binary_search(block).ok();
            for (column, _) in matrix.row(*row) {
                if let (Some(i), Some(j)) = (local(row), local(&column)) {
                    let place = analysis.find(steps[i], steps[j]);
                    analysis.entries.push(BlockEntry { row: steps[i], column: steps[j], place });
                }
            }
        }
        analysis
    }

    /// The symbolic elimination.
    fn follow(&mut self, order: &[usize], steps: &[usize], neighbours: &[Vec<usize>]) {
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); order.len()];
        let mut seen = vec![usize::MAX; order.len()];
        self.starts.push(0);
        for (step, block) in order.iter().enumerate() {
            let own = neighbours[*block].iter().map(|other| steps[*other]);
            let inherited =
                children[step].iter().flat_map(|child| &self.followers[self.starts[*child]..self.starts[child + 1]]);
            let mut all: Vec<usize> = own.chain(inherited.copied()).filter(|other| *other > step).collect();
            all.retain(|other| std::mem::replace(&mut seen[*other], step) != step);
            all.sort_unstable();
            if let Some(parent) = all.first() {
                children[*parent].push(step);
            }
            self.followers.extend(all);
            self.starts.push(self.followers.len());
        }
    }

    /// Gives every factor its place.
    fn place(&mut self) {
        let (mut first, mut offset) = (0, 0);
        for step in 0..self.unknowns.len() {
            self.firsts.push(first);
            self.offsets.push(offset);
            first += self.size(step);
            let beside: usize = self.followers(step).iter().map(|other| self.size(*other)).sum();
            offset += self.size(step) * (self.size(step) + 2 * beside);
        }
        self.firsts.push(first);
        self.offsets.push(offset);
    }

    /// The number of unknowns of a step that couple.
    pub fn size(&self, step: usize) -> usize {
        self.unknowns[step].len()
    }

    /// The later steps whose blocks a step changes, ascending.
    pub fn followers(&self, step: usize) -> &[usize] {
        &self.followers[self.starts[step]..self.starts[step + 1]]
    }

    /// The place of block (i, j) among the factors, which must have it.
    fn find(&self, i: usize, j: usize) -> usize {
        let step = i.min(j);
        let before: usize =
            self.followers(step).iter().take_while(|other| **other < i.max(j)).map(|k| self.size(*k)).sum();
        let all: usize = if i < j { self.followers(step).iter().map(|k| self.size(*k)).sum() } else { 0 };
        let own = if i == j { 0 } else { self.size(step) };
        self.offsets[step] + self.size(step) * (own + all + before)
    }

    /// How many numbers the factors are.
    pub fn entries_of_factors(&self) -> usize {
        self.offsets.last().copied().unwrap_or(0)
    }

    /// How many products a factorization takes, were the blocks alone and as they are.
    pub fn products(&self) -> (f64, f64) {
        let (mut alone, mut all) = (0.0, 0.0);
        for (step, local) in self.local.iter().enumerate() {
            let (n, local) = (self.size(step) as f64, local.len() as f64);
            let beside: f64 = self.followers(step).iter().map(|other| self.size(*other) as f64).sum();
            alone += (n + local).powi(3) / 3.0;
            all += n * n * n / 3.0 + n * n * beside + n * beside * beside + local * local * (local / 3.0 + n);
        }
        let size = |step: usize| self.size(step) as f64;
        let reduced = self
            .entries
            .iter()
            .map(|BlockEntry { row, column, .. }| size(*row) * self.local[*column].len() as f64 * size(*column));
        (alone, all + reduced.sum::<f64>())
    }
}

/// The graph of the blocks of a component, each a neighbour of itself: who feels whom, or is felt by.
fn neighbours(component: &[usize], matrix: &BlockMatrix) -> Vec<Vec<usize>> {
    let mut neighbours = vec![Vec::new(); component.len()];
    for (i, row) in component.iter().enumerate() {
        for j in matrix.row(*row).filter_map(|(column, _)| component.binary_search(&column).ok()) {
            neighbours[i].push(j);
            neighbours[j].push(i);
        }
    }
    for list in &mut neighbours {
        list.sort_unstable();
        list.dedup();
    }
    neighbours
}

/// A permutation that leaves little fill, by a library; as they come where it has none.
fn minimum_degree(neighbours: &[Vec<usize>]) -> Vec<usize> {
    let n = neighbours.len();
    let mut starts = vec![0];
    starts.extend(neighbours.iter().scan(0, |sum, list| {
        *sum += list.len();
        Some(*sum)
    }));
    let found = amd::order(n, &starts, &neighbours.concat(), &amd::Control::default());
    found.map_or_else(|_| (0..n).collect(), |(order, _, _)| order)
}
