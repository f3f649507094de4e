//! The spectral radius of a Jacobian, roughly: the largest over the components of its pattern.

use std::ops::Range;

use crate::layout::SystemLayout;
use gyration_blocks::{BlockMatrix, Components};

/// Applications of the Jacobian that let the largest eigenvalues prevail, and those over which growth is measured.
const POWER_ITERATIONS: (usize, usize) = (4, 8);

/// A lower bound of the spectral radius for next to nothing: ρ ≥ |tr J|/n.
pub(crate) fn least_spectral_radius(jacobian: &BlockMatrix, components: &Components) -> f64 {
    let bounds = components.iter().filter_map(|component| {
        let blocks = component.iter().map(|block| &jacobian.diagonal()[*block]);
        let (trace, n) = blocks.fold((0.0, 0), |(trace, n), block| (trace + block.trace(), n + block.nrows()));
        (n > 0).then(|| trace.abs() / n as f64)
    });
    bounds.fold(0.0, f64::max)
}

/// The spectral radius by the power method; `work` has room for two vectors.
///
///   ρ ≈ (‖J^(m+k) v‖/‖J^m v‖)^(1/k)
///
/// in components relative to their scales, which makes unlike units comparable; the mean over k applications irons out
/// what a complex pair does to the norm. The start is fixed and has no symmetry. A nilpotent block (free flight)
/// gives 0. An estimate, good to a factor of two.
pub(crate) fn spectral_radius(
    (jacobian, components): (&BlockMatrix, &Components),
    layout: &SystemLayout,
    scale: &[f64],
    work: &mut [f64],
) -> f64 {
    let (vector, rest) = work.split_at_mut(layout.dimension);
    let image = &mut rest[..layout.dimension];
    let growths = components.iter().map(|blocks| {
        let component = CoupledBlocks { jacobian, ranges: layout.blocks(), blocks, scale };
        component.power_growth(vector, image)
    });
    growths.fold(0.0, f64::max)
}

/// Blocks that hang together, within vectors of the whole state.
struct CoupledBlocks<'a> {
    jacobian: &'a BlockMatrix,
    ranges: &'a [Range<usize>],
    blocks: &'a [usize],
    scale: &'a [f64],
}

impl CoupledBlocks<'_> {
    /// Where its numbers stand, block by block.
    fn places(&self) -> impl Iterator<Item = Range<usize>> {
        self.blocks.iter().map(|block| self.ranges[*block].clone())
    }

    fn size(&self, vector: &[f64]) -> f64 {
        self.places().fold(0.0_f64, |sum, place| vector[place].iter().fold(sum, |sum, part| sum + part * part)).sqrt()
    }

    fn power_growth(&self, vector: &mut [f64], image: &mut [f64]) -> f64 {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        for (k, i) in self.places().flatten().enumerate() {
            vector[i] = 0.5 + (GOLDEN * (k + 1) as f64).fract();
        }
        let (settle, measure) = POWER_ITERATIONS;
        let mut logarithm = 0.0;
        for iteration in 0..settle + measure {
            self.apply(vector, image);
            let norm = self.size(image);
            let growth = norm / self.size(vector);
            if growth == 0.0 || !growth.is_finite() {
                return growth.abs();
            }
            if iteration >= settle {
                logarithm += libm::log(growth);
            }
            for place in self.places() {
                for (component, image) in vector[place.clone()].iter_mut().zip(&image[place]) {
                    *component = image / norm;
                }
            }
        }
        libm::exp(logarithm / measure as f64)
    }

    /// The image of a vector, both relative to the scales.
    fn apply(&self, vector: &[f64], image: &mut [f64]) {
        for row in self.blocks {
            let image = &mut image[self.ranges[*row].clone()];
            image.fill(0.0);
            for (column, block) in self.jacobian.row(*row) {
                for (at, entries) in self.ranges[column].clone().zip(block.column_iter()) {
                    // A freed component has scale +∞: it does not take part.
                    let weight = if self.scale[at].is_finite() { vector[at] * self.scale[at] } else { 0.0 };
                    for (sum, entry) in image.iter_mut().zip(entries.as_slice()) {
                        *sum += entry * weight;
                    }
                }
            }
            for (sum, scale) in image.iter_mut().zip(&self.scale[self.ranges[*row].clone()]) {
                *sum /= scale;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration_blocks::Pattern;
    use nalgebra::{DMatrix, DVector};

    fn whole(matrix: DMatrix<f64>) -> (BlockMatrix, SystemLayout) {
        let blocks = [0..0, 0..matrix.nrows()];
        let mut jacobian = BlockMatrix::new(&blocks);
        jacobian.diagonal_mut()[1].copy_from(&matrix);
        (jacobian, SystemLayout::new(&blocks, &Components::apart(), 0))
    }

    fn radius(matrix: DMatrix<f64>, scale: &[f64]) -> f64 {
        let (jacobian, layout) = whole(matrix);
        spectral_radius((&jacobian, &layout.components), &layout, scale, &mut vec![0.0; 2 * scale.len()])
    }

    #[test]
    fn spectral_radius_of_real_spectra_is_found() {
        let rho = radius(DMatrix::from_diagonal(&DVector::from_vec(vec![-1.0, -1e6, 20.0])), &[1.0; 3]);
        assert!((rho / 1e6 - 1.0).abs() < 1e-9, "{rho}");
    }

    /// An oscillator in units that differ by its frequency: eigenvalues ±iω; relative to the scales the matrix is
    /// normal.
    #[test]
    fn spectral_radius_of_an_oscillator_is_its_frequency() {
        let omega = 1e4;
        let oscillator = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, -omega * omega, 0.0]);
        let rho = radius(oscillator.clone(), &[1e-9, 1e-5]);
        assert!((rho / omega - 1.0).abs() < 1e-9, "{rho}");
        // Even with scales off by a hundred, a factor of two holds.
        let rho = radius(oscillator, &[1e-9, 1e-7]);
        assert!((0.5..2.0).contains(&(rho / omega)), "{rho}");
    }

    /// The blocks of an oscillator are zero, what couples them is not: apart they would have no stiffness.
    #[test]
    fn spectral_radius_sees_the_coupling() {
        let (blocks, pattern) = ([0..1, 1..1, 1..2], Pattern::new(3, [(0, 2), (2, 0)]));
        let components = Components::of(&pattern, 3);
        let mut jacobian = BlockMatrix::new(&blocks);
        jacobian.arrange(&pattern);
        for (pair, value) in [((0, 2), 1e4), ((2, 0), -1e4)] {
            jacobian.block_mut(pair.0, pair.1).unwrap()[(0, 0)] = value;
        }
        let layout = SystemLayout::new(&blocks, &components, 0);
        let rho = spectral_radius((&jacobian, &components), &layout, &[1.0; 2], &mut [0.0; 4]);
        assert!((rho / 1e4 - 1.0).abs() < 1e-9, "{rho}");
    }

    #[test]
    fn free_flight_has_no_stiffness() {
        assert_eq!(radius(DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 0.0, 0.0]), &[1.0, 1.0]), 0.0);
    }

    #[test]
    fn the_lower_bound_is_below_the_spectral_radius() {
        for trial in 0..20 {
            let entry = |i: usize, j: usize| ((trial * 31 + i * 7 + j * 13) as f64).sin() - f64::from(u8::from(i == j));
            let matrix = DMatrix::from_fn(5, 5, entry);
            let exact = matrix.complex_eigenvalues().iter().map(|value| value.norm()).fold(0.0, f64::max);
            let (jacobian, layout) = whole(matrix);
            let least = least_spectral_radius(&jacobian, &layout.components);
            assert!(least > 0.0 && least <= exact, "{least} {exact}");
        }
    }
}
