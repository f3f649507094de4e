//! The factors of γ/h I − J and of each (α + iβ)/h I − J, component by component.
//!
//! A block that couples with no other is factorized by itself, in the form that its Jacobian has (`shifted`). Blocks
//! that hang together are eliminated one after the other (`analysis`, `elimination`).

use std::ops::Range;

use crate::radau::Radau;
use crate::shifted::{ComplexShifted, RealShifted};
use gyration_blocks::{Analysis, BlockLu, BlockMatrix, Complex, Components, Real, Singular};

/// The factorizations of every component.
#[derive(Debug, Clone, Default)]
pub(crate) struct ComponentFactors {
    single: Vec<Single>,
    coupled: Vec<Coupled>,
    relative_cost: f64,
}

/// A block by itself.
#[derive(Debug, Clone)]
struct Single {
    block: usize,
    unknowns: Range<usize>,
    real: RealShifted,
    complex: Vec<ComplexShifted>,
}

/// Blocks that hang together.
#[derive(Debug, Clone)]
struct Coupled {
    analysis: Analysis,
    real: BlockLu<Real>,
    complex: Vec<BlockLu<Complex>>,
}

impl ComponentFactors {
    /// Analyses a pattern; room for its factors.
    pub fn new(blocks: &[Range<usize>], components: &Components, matrix: &BlockMatrix, method: &Radau) -> Self {
        let (mut factors, pairs) = (Self::default(), method.complex.len());
        for component in components.iter() {
            if let [block] = *component {
                let unknowns = blocks[block].clone();
                let (real, complex) =
                    (RealShifted::new(unknowns.len()), vec![ComplexShifted::new(unknowns.len()); pairs]);
                factors.single.push(Single { block, unknowns, real, complex });
            } else {
                let analysis = Analysis::of(component, blocks, matrix);
                let (real, complex) = (BlockLu::new(&analysis), vec![BlockLu::new(&analysis); pairs]);
                factors.coupled.push(Coupled { analysis, real, complex });
            }
        }
        factors.relative_cost = factors.count_products() * of_pairs(pairs);
        factors
    }

    /// Factorizes all matrices for a step of size h.
    ///
    /// # Errors
    /// `Singular` if one of them is singular or not finite.
    pub fn factorize(&mut self, h: f64, jacobian: &BlockMatrix, method: &Radau) -> Result<(), Singular> {
        let shift = method.real / h;
        let shifts = || method.complex.iter().map(|(alpha, beta)| (alpha / h, beta / h));
        for Single { block, real, complex, .. } in &mut self.single {
            let jacobian = &jacobian.diagonal()[*block];
            real.factorize(shift, jacobian)?;
            complex.iter_mut().zip(shifts()).try_for_each(|(factors, shift)| factors.factorize(shift, jacobian))?;
        }
        for Coupled { analysis, real, complex } in &mut self.coupled {
            real.factorize(analysis, shift, jacobian)?;
            let mut pairs = complex.iter_mut().zip(shifts());
            pairs.try_for_each(|(factors, shift)| factors.factorize(analysis, shift, jacobian))?;
        }
        Ok(())
    }

    /// Solves (γ/h I − J) x = b in place.
    pub fn solve_real(&mut self, b: &mut [f64]) {
        for Single { unknowns, real, .. } in &self.single {
            real.solve(&mut b[unknowns.clone()]);
        }
        for Coupled { analysis, real, .. } in &mut self.coupled {
            real.solve(analysis, &mut [&mut *b]);
        }
    }

    /// Solves ((α + iβ)/h I − J) x = b of a pair in place, b = real + i imaginary.
    pub fn solve_complex(&mut self, pair: usize, re: &mut [f64], im: &mut [f64]) {
        for Single { unknowns, complex, .. } in &self.single {
            complex[pair].solve(&mut re[unknowns.clone()], &mut im[unknowns.clone()]);
        }
        for Coupled { analysis, complex, .. } in &mut self.coupled {
            complex[pair].solve(analysis, &mut [&mut *re, &mut *im]);
        }
    }

    /// What the linear algebra of a step costs beside that of the same blocks without coupling.
    pub fn relative_cost(&self) -> f64 {
        self.relative_cost
    }

    /// That cost, by counting products.
    fn count_products(&self) -> f64 {
        if self.coupled.is_empty() {
            return 1.0;
        }
        let alone: f64 = self.single.iter().map(|single| (single.unknowns.len() as f64).powi(3) / 3.0).sum();
        let products = self.coupled.iter().map(|coupled| coupled.analysis.products());
        let sums = products.fold((alone, alone), |sums, (alone, all)| (sums.0 + alone, sums.1 + all));
        sums.1 / sums.0
    }

    /// How many numbers the factors of the coupled blocks are, all matrices together.
    pub fn entries(&self) -> usize {
        let numbers = |coupled: &Coupled| (1 + 2 * coupled.complex.len()) * coupled.analysis.entries_of_factors();
        self.coupled.iter().map(numbers).sum()
    }
}

/// The cost of a real factorization and those of so many pairs, beside that of one pair: a complex product is four.
fn of_pairs(pairs: usize) -> f64 {
    (1 + 4 * pairs) as f64 / 5.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::SystemLayout;
    use crate::radau::{FIVE, THIRTEEN};
    use gyration_blocks::Pattern;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    /// Blocks of several sizes, one of them empty, with these pairs and numbers below one in size.
    fn system(
        sizes: &[usize],
        pairs: &[(usize, usize)],
        local: &[usize],
        entries: &[f64],
    ) -> (BlockMatrix, SystemLayout) {
        let ends = sizes.iter().scan(0, |end, size| {
            *end += size;
            Some(*end - size..*end)
        });
        let blocks: Vec<_> = ends.collect();
        let pattern = Pattern::new(sizes.len(), pairs.iter().copied()).with_local_rates(local.to_vec());
        let (mut jacobian, mut numbers) = (BlockMatrix::new(&blocks), entries.iter().cycle());
        jacobian.arrange(&pattern);
        for (i, j) in pairs.iter().copied().chain((0..sizes.len()).map(|i| (i, i))) {
            let block = jacobian.block_mut(i, j).unwrap();
            block.apply(|value| *value = *numbers.next().unwrap());
            if i != j {
                block.rows_mut(0, local[i].min(sizes[i])).fill(0.0);
            }
        }
        (jacobian, SystemLayout::new(&blocks, &Components::of(&pattern, blocks.len()), 0))
    }

    fn dense(jacobian: &BlockMatrix, layout: &SystemLayout) -> DMatrix<f64> {
        let mut whole = DMatrix::zeros(layout.dimension, layout.dimension);
        for (row, range) in layout.blocks().iter().enumerate() {
            for (column, block) in jacobian.row(row) {
                whole.view_mut((range.start, layout.blocks()[column].start), block.shape()).copy_from(block);
            }
        }
        whole
    }

    proptest! {
        #[test]
        fn factors_solve_like_those_of_the_whole_matrix(
            pairs in proptest::collection::vec((0_usize..7, 0_usize..7), 0..12),
            entries in proptest::collection::vec(-1.0_f64..1.0, 101),
            b in proptest::collection::vec(-1.0_f64..1.0, 32),
            local in proptest::collection::vec(0_usize..4, 7),
        ) {
            let pairs: Vec<_> = pairs.into_iter().filter(|(i, j)| i != j).collect();
            let (jacobian, layout) = system(&[3, 1, 2, 0, 4, 2, 4], &pairs, &local, &entries);
            let mut factors = ComponentFactors::new(layout.blocks(), &layout.components, &jacobian, &THIRTEEN);
            // Small enough a step for shifts of 23 and more, beyond the sums of 16 numbers: no cancellation.
            let h = 0.1;
            prop_assert!(factors.factorize(h, &jacobian, &THIRTEEN).is_ok());
            let (whole, n) = (dense(&jacobian, &layout), layout.dimension);
            let mut real = b[..n].to_vec();
            factors.solve_real(&mut real);
            let [b0, b1, real] = [&b[..n], &b[n..], &real].map(DVector::from_column_slice);
            // Some roundings of numbers of order one.
            prop_assert!((THIRTEEN.real / h * &real - &whole * &real - &b0).amax() < 1e-13);
            for (pair, (alpha, beta)) in THIRTEEN.complex.iter().enumerate() {
                let (mut re, mut im) = (b[..n].to_vec(), b[n..].to_vec());
                factors.solve_complex(pair, &mut re, &mut im);
                let [re, im] = [&re, &im].map(|part| DVector::from_column_slice(part));
                prop_assert!((alpha / h * &re - beta / h * &im - &whole * &re - &b0).amax() < 1e-13);
                prop_assert!((alpha / h * &im + beta / h * &re - &whole * &im - &b1).amax() < 1e-13);
            }
        }
    }

    /// Eliminated by itself beside a component of several, in the same form and to the same bytes.
    #[test]
    fn a_block_beside_a_component_is_factorized_as_if_alone() {
        let entries: Vec<f64> = (0..97).map(|k| f64::from(k).sin()).collect();
        let (mut jacobian, layout) = system(&[2, 4, 3, 2], &[(0, 2), (2, 3)], &[0; 4], &entries);
        // Of second order, which `shifted` finds.
        let own = &mut jacobian.diagonal_mut()[1];
        own.rows_mut(0, 2).fill(0.0);
        (own[(0, 2)], own[(1, 3)]) = (1.0, 1.0);
        let mut factors = ComponentFactors::new(layout.blocks(), &layout.components, &jacobian, &FIVE);
        let (mut alone, h) = (RealShifted::new(4), 0.3);
        factors.factorize(h, &jacobian, &FIVE).unwrap();
        alone.factorize(FIVE.real / h, &jacobian.diagonal()[1]).unwrap();
        let mut all: Vec<f64> = (0..layout.dimension).map(|k| (k as f64).cos()).collect();
        let mut one = all[2..6].to_vec();
        factors.solve_real(&mut all);
        alone.solve(&mut one);
        assert_eq!(all[2..6], one);
        assert_eq!((factors.single.len(), factors.coupled.len()), (1, 1));
    }

    /// A star has no fill where its middle comes last: n + 2(n − 1) blocks.
    #[test]
    fn the_order_keeps_the_factors_of_a_star_sparse() {
        for n in [40, 400] {
            let pairs: Vec<_> = (1..n).flat_map(|i| [(0, i), (i, 0)]).collect();
            let (jacobian, layout) = system(&vec![2; n], &pairs, &vec![0; n], &[0.5]);
            let factors = ComponentFactors::new(layout.blocks(), &layout.components, &jacobian, &FIVE);
            assert_eq!(factors.entries(), 3 * 4 * (3 * n - 2));
            // A third of eight products for each block, and twice eight more for all but the middle.
            assert!((factors.relative_cost() - (n as f64 + 6.0 * (n - 1) as f64) / n as f64).abs() < 1e-12);
        }
    }
}
