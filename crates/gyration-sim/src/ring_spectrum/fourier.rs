//! Sums over the cells of a ring, of all wave vectors that it allows.
//!
//!   û(κ) = N⁻¹ Σ_n u_n e^{−2πi κ·n},   κ_a = j_a/N_a
//!
//! One direction after the other, each by the factors of its count: N Σ p products, p its primes.
//!
//! Source: J. W. Cooley and J. W. Tukey, *Math. Comp.* 19 (1965) 297.

use crate::modes::bands::unit_phase;
use nalgebra::Complex;

type C64 = Complex<f64>;

/// The sums of a ring of so many cells along each direction.
#[derive(Debug, Clone)]
pub(super) struct Fourier {
    counts: [usize; 3],
    /// e^{−2πi j/N} along each.
    roots: [Vec<C64>; 3],
}

impl Fourier {
    pub fn new(counts: [usize; 3]) -> Self {
        let roots = counts.map(|count| (0..count).map(|j| unit_phase(-(j as f64) / count as f64)).collect());
        Self { counts, roots }
    }

    /// û of j in the place of u of n, the first direction fastest.
    pub fn transform(&self, values: &mut [C64]) {
        let mut stride = 1;
        for (count, roots) in self.counts.iter().zip(&self.roots) {
            for start in (0..values.len()).filter(|place| place / stride % count == 0) {
                let places = (0..*count).map(|n| start + n * stride);
                let line: Vec<C64> = places.clone().map(|place| values[place]).collect();
                places.zip(sums(line, roots)).for_each(|(place, sum)| values[place] = sum);
            }
            stride *= count;
        }
        let all = values.len() as f64;
        values.iter_mut().for_each(|value| *value /= all);
    }
}

/// Σ_n u_n e^{−2πi jn/N} of all j, given the phases of a whole number of N.
fn sums(values: Vec<C64>, roots: &[C64]) -> Vec<C64> {
    let count = values.len();
    let Some(factor) = (2..=count).find(|factor| count.is_multiple_of(*factor)) else { return values };
    let part = |first: usize| values.iter().skip(first).step_by(factor).copied().collect();
    let parts: Vec<Vec<C64>> = (0..factor).map(|first| sums(part(first), roots)).collect();
    let step = roots.len() / count;
    let within = count / factor;
    let sum = |j: usize| {
        let terms = parts.iter().enumerate();
        terms.map(|(first, part)| part[j % within] * roots[step * (j * first % count)]).sum()
    };
    (0..count).map(sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_by_factors_are_those_term_by_term() {
        for counts in [[1, 1, 1], [7, 1, 1], [12, 1, 1], [8, 3, 1], [3, 4, 5]] {
            let places = |count: [usize; 3]| {
                let [x, y, z] = count;
                (0..z).flat_map(move |c| (0..y).flat_map(move |b| (0..x).map(move |a| [a, b, c])))
            };
            let all: usize = counts.iter().product();
            let given: Vec<C64> = (0..all).map(|n| C64::new((1.3 * n as f64).sin(), (0.7 * n as f64).cos())).collect();
            let mut found = given.clone();
            Fourier::new(counts).transform(&mut found);
            for (j, found) in places(counts).zip(&found) {
                let term = |(n, value): ([usize; 3], &C64)| {
                    let turns: f64 = (0..3).map(|a| (j[a] * n[a]) as f64 / counts[a] as f64).sum();
                    value * unit_phase(-turns) / all as f64
                };
                let exact: C64 = places(counts).zip(&given).map(term).sum();
                assert!((exact - found).norm() < 1e-14, "{counts:?} {j:?}: {exact} {found}");
            }
        }
    }
}
