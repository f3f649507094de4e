//! Elimination by blocks, of the matrices s I − J of a component of several blocks.
//!
//!   D_k = A_kk,   U_kj = D_k⁻¹ A_kj,   A_ij ← A_ij − A_ik U_kj   for all i, j after k that couple with k
//!
//! Rows are exchanged within a block only: s I is part of every diagonal block, and a step for which that is not enough
//! is one that Newton's method rejects for a shorter one. The factors are therefore where `analysis` has found them,
//! nothing is allocated, and sums run in an order that depends on the pattern alone. A library's sparse LU was compared
//! (`bench`): exchanging rows freely costs it the structure of blocks, and threefold fill.

use std::marker::PhantomData;
use std::ops::Range;

use crate::analysis::Analysis;
use crate::block_matrix::BlockMatrix;
use crate::kernel::BlockArithmetic;
use crate::linear::Singular;
use crate::reduction::Reduction;

/// The factors of s I − J.
#[derive(Debug, Clone)]
pub struct BlockLu<K> {
    factors: Vec<f64>,
    pivots: Vec<usize>,
    /// A vector in the order of the elimination.
    work: Vec<f64>,
    reduction: Reduction<K>,
}

impl<K: BlockArithmetic> BlockLu<K> {
    /// Room for the factors of a component.
    pub fn new(analysis: &Analysis) -> Self {
        let unknowns = analysis.firsts.last().copied().unwrap_or(0);
        Self {
            factors: vec![0.0; K::PARTS * analysis.entries_of_factors()],
            pivots: vec![0; unknowns],
            work: vec![0.0; K::PARTS * unknowns],
            reduction: Reduction::new(analysis),
        }
    }

    /// Factorizes s I − J.
    ///
    /// # Errors
    /// `Singular` if a diagonal block is, or something is not finite.
    pub fn factorize(&mut self, analysis: &Analysis, shift: K::Shift, jacobian: &BlockMatrix) -> Result<(), Singular> {
        self.reduction.factorize(analysis, shift, jacobian)?;
        self.factors.fill(0.0);
        for (index, entry) in analysis.entries.iter().enumerate() {
            let block = jacobian.block(analysis.blocks[entry.row], analysis.blocks[entry.column]).ok_or(Singular)?;
            let (at, size) = (
                [entry.row, entry.column].map(|step| analysis.local[step].len()),
                [entry.row, entry.column].map(|step| analysis.size(step)),
            );
            let place = &mut self.factors[K::PARTS * entry.place..][..K::PARTS * size[0] * size[1]];
            K::set(place, block.view(at.into(), size.into()), (entry.row == entry.column).then_some(shift));
            self.reduction.subtract(analysis, index, place);
        }
        (0..analysis.unknowns.len()).try_for_each(|step| self.eliminate(analysis, step))
    }

    /// One step of the elimination.
    fn eliminate(&mut self, analysis: &Analysis, step: usize) -> Result<(), Singular> {
        let (n, followers) = (analysis.size(step), analysis.followers(step));
        let (before, after) = self.factors.split_at_mut(K::PARTS * analysis.offsets[step + 1]);
        let own = &mut before[K::PARTS * analysis.offsets[step]..];
        let (diagonal, others) = own.split_at_mut(K::PARTS * n * n);
        let pivots = &mut self.pivots[analysis.firsts[step]..analysis.firsts[step + 1]];
        K::factorize(diagonal, pivots)?;
        let (below, beside) = others.split_at_mut(others.len() / 2);
        let mut blocks = BlockRow { at: 0, width: K::PARTS * n };
        for other in followers {
            let size = analysis.size(*other);
            K::solve_columns(diagonal, pivots, &mut beside[blocks.next(size)], size);
        }
        let origin = K::PARTS * analysis.offsets[step + 1];
        let mut rows = BlockRow { at: 0, width: K::PARTS * n };
        for (k, i) in followers.iter().enumerate() {
            let size = analysis.size(*i);
            let row = rows.next(size);
            let mut target = Target::<K>::of(analysis, *i, origin);
            let diagonal = target.below.next(size);
            K::subtract_product(&mut after[diagonal], &below[row.clone()], &beside[row.clone()], n, size);
            let mut columns = rows;
            for j in &followers[k + 1..] {
                let (other, column) = (analysis.size(*j), columns.next(analysis.size(*j)));
                let (under, right) = target.of_follower(analysis, *j);
                K::subtract_product(&mut after[right], &below[row.clone()], &beside[column.clone()], n, other);
                K::subtract_product(&mut after[under], &below[column], &beside[row.clone()], n, size);
            }
        }
        Ok(())
    }

    /// Solves (s I − J) x = b in place, b in as many parts as the numbers have; unknowns of other components stay.
    pub fn solve(&mut self, analysis: &Analysis, b: &mut [&mut [f64]]) {
        let steps = analysis.unknowns.len();
        let Self { factors, pivots, work, reduction } = self;
        let place = |step: usize| K::PARTS * analysis.firsts[step]..K::PARTS * analysis.firsts[step + 1];
        for (step, unknowns) in analysis.unknowns.iter().enumerate() {
            for (part, vector) in work[place(step)].chunks_exact_mut(unknowns.len()).zip(b.iter()) {
                part.copy_from_slice(&vector[unknowns.clone()]);
            }
        }
        reduction.solve_local(analysis, b, work);
        let own = |step: usize| {
            let all = &factors[K::PARTS * analysis.offsets[step]..K::PARTS * analysis.offsets[step + 1]];
            let (diagonal, others) = all.split_at(K::PARTS * analysis.size(step).pow(2));
            let (below, beside) = others.split_at(others.len() / 2);
            (diagonal, below, beside)
        };
        for step in 0..steps {
            let (diagonal, below, _) = own(step);
            let (before, after) = work.split_at_mut(place(step).end);
            let x = &mut before[place(step).start..];
            K::solve(diagonal, &pivots[analysis.firsts[step]..analysis.firsts[step + 1]], x);
            let mut blocks = BlockRow { at: 0, width: K::PARTS * analysis.size(step) };
            for other in analysis.followers(step) {
                let target = place(*other).start - place(step).end..place(*other).end - place(step).end;
                K::subtract_image(&mut after[target], &below[blocks.next(analysis.size(*other))], x);
            }
        }
        for step in (0..steps).rev() {
            let (_, _, beside) = own(step);
            let (before, after) = work.split_at_mut(place(step).end);
            let x = &mut before[place(step).start..];
            let mut blocks = BlockRow { at: 0, width: K::PARTS * analysis.size(step) };
            for other in analysis.followers(step) {
                let source = place(*other).start - place(step).end..place(*other).end - place(step).end;
                K::subtract_image(x, &beside[blocks.next(analysis.size(*other))], &after[source]);
            }
        }
        for (step, unknowns) in analysis.unknowns.iter().enumerate() {
            for (part, vector) in work[place(step)].chunks_exact(unknowns.len()).zip(b.iter_mut()) {
                vector[unknowns.clone()].copy_from_slice(part);
            }
        }
        reduction.solve_rest(analysis, b, work);
    }
}

/// Blocks that lie one after the other, all of so many numbers in one direction.
#[derive(Debug, Clone, Copy)]
struct BlockRow {
    at: usize,
    width: usize,
}

impl BlockRow {
    /// The place of the next block, of so many numbers in the other direction.
    fn next(&mut self, size: usize) -> Range<usize> {
        let start = self.at;
        self.at += self.width * size;
        start..self.at
    }
}

/// The factors of a later step, followed by its followers.
struct Target<'a, K> {
    below: BlockRow,
    beside: BlockRow,
    followers: &'a [usize],
    kernel: PhantomData<K>,
}

impl<'a, K: BlockArithmetic> Target<'a, K> {
    /// The factors of a step, counted from an origin; those below begin with the diagonal.
    fn of(analysis: &'a Analysis, step: usize, origin: usize) -> Self {
        let (begin, end) = (K::PARTS * analysis.offsets[step], K::PARTS * analysis.offsets[step + 1]);
        let width = K::PARTS * analysis.size(step);
        let middle = (begin + end + width * analysis.size(step)) / 2;
        Self {
            below: BlockRow { at: begin - origin, width },
            beside: BlockRow { at: middle - origin, width },
            followers: analysis.followers(step),
            kernel: PhantomData,
        }
    }

    /// The places of the blocks below and beside the diagonal of a follower, which comes after those asked for before.
    fn of_follower(&mut self, analysis: &Analysis, wanted: usize) -> (Range<usize>, Range<usize>) {
        loop {
            let (next, rest) =
                self.followers.split_first().map_or((wanted, self.followers), |(next, rest)| (*next, rest));
            self.followers = rest;
            let size = analysis.size(next);
            let places = (self.below.next(size), self.beside.next(size));
            if next >= wanted {
                return places;
            }
        }
    }
}
