//! Integrals of the shape of an ellipsoid on which its gravity and slow flow about it depend.
//!
//!   b_i = 1/(a_i² + s),  Δ² = ∏ (a_i² + s),  V = a₁a₂a₃
//!   L_i  = (V/2) ∫₀^∞ b_i ds/Δ          Σ L_i = 1
//!   n_ij = (V/2) ∫₀^∞ b_i b_j ds/Δ
//!   m_ij = (V/4) ∫₀^∞ s b_i b_j ds/Δ    Σ_j m_ij + 2 m_ii = L_i
//!   m_ijk = (V/4) ∫₀^∞ s b_i b_j b_k ds/Δ
//!
//! L_i = ⟨x_i²⟩ and (1 + 2δ_ij) m_ij = ⟨x_i² x_j²⟩ are moments of directions over the unit sphere, weighted as the
//! ellipsoid does it; n_ij and m_ijk give their derivatives by the shape. With s = eᵗ the integrands are analytic
//! in |Im t| < π, and the sum over equal steps h converges as e^(−2π²/h): at h = 0.45 to 9e-20 but for a factor of some
//! hundreds. All terms are positive, so that nothing cancels, whatever the axes: spheres, discs, needles. Source:
//! `docs/theory-fluid.md`, whose α_i are 2 L_i/V.

use crate::simd::{F64x4, WithF64x4, dispatch_f64x4};

/// Step of t.
const STEP: f64 = 0.45;
/// e^h.
const GROWTH: f64 = 1.568_312_185_490_168_8;
/// How far below the least a², and above the largest, terms matter: they fall as s and as s^(−3/2).
const BELOW: f64 = 1e-16;
const ABOVE: f64 = 1e10;
/// Terms that are summed at most; axes whose ratio needs more are outside the range of numbers.
const MOST_TERMS: usize = 4096;
/// Terms are summed side by side in as many places.
const LANES: usize = 4;

/// The integrals of an ellipsoid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct EllipsoidMoments {
    /// L_i.
    pub second: [f64; 3],
    /// n_ij, symmetric \[1/m²\].
    pub narrow: [[f64; 3]; 3],
    /// m_ij, symmetric.
    pub fourth: [[f64; 3]; 3],
    /// m_ijk, symmetric \[1/m²\].
    pub sixth: [[[f64; 3]; 3]; 3],
}

/// The entries of m_ijk that differ.
const TRIPLES: [[usize; 3]; 10] =
    [[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 1, 1], [0, 1, 2], [0, 2, 2], [1, 1, 1], [1, 1, 2], [1, 2, 2], [2, 2, 2]];
/// The entries of n_ij and m_ij that differ.
const PAIRS: [[usize; 2]; 6] = [[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]];

/// Sums over s, term by term in a fixed place.
#[derive(Default)]
struct EllipsoidSums {
    second: [[f64; LANES]; 3],
    narrow: [[f64; LANES]; 6],
    fourth: [[f64; LANES]; 6],
    sixth: [[f64; LANES]; 10],
}

impl EllipsoidMoments {
    /// The integrals for the squares a_i² > 0 of the semi-axes \[m²\].
    pub fn of(squares: [f64; 3]) -> Self {
        let largest = squares[0].max(squares[1]).max(squares[2]);
        // In units of the largest axis no product leaves the range of numbers.
        let squares = [squares[0] / largest, squares[1] / largest, squares[2] / largest];
        dispatch_f64x4(Summation { squares: &squares }).moments(&squares, largest)
    }
}

/// The sums to be made, in the widest registers that there are.
struct Summation<'a> {
    squares: &'a [f64; 3],
}

impl WithF64x4 for Summation<'_> {
    type Output = EllipsoidSums;

    #[inline(always)]
    fn run<F: F64x4>(self, _: F) -> EllipsoidSums {
        let squares = self.squares;
        let least = squares[0].min(squares[1]).min(squares[2]);
        let mut sums = EllipsoidSums::default();
        let mut s = [BELOW * least, 0.0, 0.0, 0.0];
        for lane in 1..LANES {
            s[lane] = s[lane - 1] * GROWTH;
        }
        let stride = GROWTH * GROWTH * GROWTH * GROWTH;
        let mut terms = 0;
        while s[0] < ABOVE && terms < MOST_TERMS {
            sums.add(squares, &s);
            for number in &mut s {
                *number *= stride;
            }
            terms += LANES;
        }
        sums
    }
}

/// a_i b_i.
#[inline(always)]
fn product(a: &[f64; LANES], b: &[f64; LANES]) -> [f64; LANES] {
    let mut product = [0.0; LANES];
    for lane in 0..LANES {
        product[lane] = a[lane] * b[lane];
    }
    product
}

/// Adds to a sum.
#[inline(always)]
fn add(sum: &mut [f64; LANES], term: &[f64; LANES]) {
    for lane in 0..LANES {
        sum[lane] += term[lane];
    }
}

impl EllipsoidSums {
    #[inline(always)]
    fn add(&mut self, squares: &[f64; 3], s: &[f64; LANES]) {
        let mut sums = [[0.0; LANES]; 3];
        for (sum, square) in sums.iter_mut().zip(squares) {
            for lane in 0..LANES {
                sum[lane] = square + s[lane];
            }
        }
        let across = [product(&sums[1], &sums[2]), product(&sums[2], &sums[0]), product(&sums[0], &sums[1])];
        // ∏ b_i, from which each b_i follows without a further division.
        let mut inverse = product(&across[0], &sums[0]);
        let mut weight = [0.0; LANES];
        for lane in 0..LANES {
            inverse[lane] = 1.0 / inverse[lane];
            // ds = s dt; 1/Δ = √(∏ b_i).
            weight[lane] = s[lane] * inverse[lane].sqrt();
        }
        let b = [product(&across[0], &inverse), product(&across[1], &inverse), product(&across[2], &inverse)];
        let mut pairs = [[0.0; LANES]; 6];
        for (sum, b) in self.second.iter_mut().zip(&b) {
            add(sum, &product(&weight, b));
        }
        for (place, [i, j]) in PAIRS.into_iter().enumerate() {
            let narrow = product(&weight, &product(&b[i], &b[j]));
            add(&mut self.narrow[place], &narrow);
            pairs[place] = product(s, &narrow);
            add(&mut self.fourth[place], &pairs[place]);
        }
        for (place, [i, j, k]) in TRIPLES.into_iter().enumerate() {
            add(&mut self.sixth[place], &product(&pairs[pair(i, j)], &b[k]));
        }
    }

    fn moments(&self, squares: &[f64; 3], unit: f64) -> EllipsoidMoments {
        let total = |lanes: &[f64; LANES]| (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
        let volume = STEP * (squares[0] * squares[1] * squares[2]).sqrt();
        let mut moments = EllipsoidMoments::default();
        for i in 0..3 {
            moments.second[i] = 0.5 * volume * total(&self.second[i]);
            for j in 0..3 {
                let place = pair(i.min(j), i.max(j));
                moments.narrow[i][j] = 0.5 * volume / unit * total(&self.narrow[place]);
                moments.fourth[i][j] = 0.25 * volume * total(&self.fourth[place]);
                for k in 0..3 {
                    let place = batch([i, j, k]);
                    moments.sixth[i][j][k] = 0.25 * volume / unit * total(&self.sixth[place]);
                }
            }
        }
        moments
    }
}

/// The place among [`PAIRS`] of i ≤ j.
#[inline(always)]
const fn pair(i: usize, j: usize) -> usize {
    i * (5 - i) / 2 + j
}

/// The place among [`TRIPLES`] of three indices in any order.
fn batch(mut indices: [usize; 3]) -> usize {
    indices.sort_unstable();
    TRIPLES.iter().position(|batch| *batch == indices).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(axes: [f64; 3]) -> EllipsoidMoments {
        EllipsoidMoments::of(axes.map(|a| a * a))
    }

    const CASES: [[f64; 3]; 6] =
        [[1.0, 1.0, 1.0], [3.0, 1.0, 1.0], [1e-3, 2e-3, 5e-4], [1e4, 1.0, 1.0], [1.0, 1.0, 1e-4], [7.0, 0.1, 40.0]];

    #[test]
    fn sums_over_directions_are_one_and_the_second_moments() {
        for axes in CASES {
            let EllipsoidMoments { second, fourth, narrow, sixth } = of(axes);
            let total: f64 = second.iter().sum();
            // Some 150 roundings of each sum.
            assert!((total - 1.0).abs() < 2e-14, "{axes:?}: {total}");
            for i in 0..3 {
                let sum: f64 = fourth[i].iter().sum::<f64>() + 2.0 * fourth[i][i];
                assert!((sum / second[i] - 1.0).abs() < 2e-14, "{axes:?}: {i}");
                // From d/ds of s b_i b_j/Δ: Σ_k m_ijk (1 + …) = n_ij/2, and so on for the next order.
                for j in 0..3 {
                    let (delta_i, delta_j) = (2.0 * sixth[i][j][i], 2.0 * sixth[i][j][j]);
                    let sum: f64 = sixth[i][j].iter().sum::<f64>() + delta_i + delta_j;
                    assert!((sum / narrow[i][j] - 1.0).abs() < 2e-14, "{axes:?}: {i} {j}");
                }
            }
        }
    }

    /// Quadrature with thirty digits.
    #[test]
    fn integrals_have_all_digits() {
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 2e-14, "{a} {b}");
        let m = of([1.0, 0.5, 0.2]);
        close(m.second[0], 0.0954202423917334);
        close(m.second[2], 0.6585011697596648);
        close(m.fourth[0][0], 0.03684057689630998 / 3.0);
        close(m.fourth[0][1], 0.022600396953055293);
        close(m.fourth[1][2], 0.08376095278991398);
        let needle = of([100.0, 1.0, 1.0]);
        close(needle.second[0], 0.0004298987198818899);
        close(needle.fourth[0][0], 4.994050924294201e-5 / 3.0);
        let disc = of([1.0, 1.0, 0.01]);
        close(disc.second[2], 0.9844897069128692);
        close(disc.fourth[0][1], 0.000981603720990596);
    }

    #[test]
    fn derivatives_by_the_squares_follow_from_the_next_moments() {
        let squares = [1.3, 0.4, 2.2];
        let at = EllipsoidMoments::of(squares);
        for k in 0..3 {
            let step = 1e-5;
            let shifted = |by: f64| {
                let mut moved = squares;
                moved[k] += by;
                EllipsoidMoments::of(moved)
            };
            let (ahead, behind) = (shifted(step), shifted(-step));
            for i in 0..3 {
                let difference = (ahead.second[i] - behind.second[i]) / (2.0 * step);
                let own = if i == k { at.narrow[i][i] } else { 0.0 };
                let exact = 0.5 * at.second[i] / squares[k] - 0.5 * at.narrow[i][k] - own;
                // Central differences: step² and eps/step.
                assert!((difference - exact).abs() < 1e-9, "{i} {k}: {difference} {exact}");
            }
        }
    }
}
