//! The points of Sobol, each by its index.
//!
//!   x_d(i) = ⊕_k i_k V_{d,k},   i_k the binary digits of i
//!
//! V are the direction numbers of Joe and Kuo (2008, set new-joe-kuo-6.21201), continued by the recurrence of a
//! primitive polynomial over GF(2). In this order of the digits the first 2^m points are those of the Gray-code order,
//! as a set.

/// The most dimensions.
pub const MOST_DIMENSIONS: usize = INITIAL.len() + 1;

/// Digits of a coordinate.
const BITS: usize = 64;

/// The polynomial's inner coefficients, and the initial numbers m₁, m₂, … of the dimensions from the second on.
const INITIAL: [(u64, &[u64]); 20] = [
    (0, &[1]),
    (1, &[1, 3]),
    (1, &[1, 3, 1]),
    (2, &[1, 1, 1]),
    (1, &[1, 1, 3, 3]),
    (4, &[1, 3, 5, 13]),
    (2, &[1, 1, 5, 5, 17]),
    (4, &[1, 1, 5, 5, 5]),
    (7, &[1, 1, 7, 11, 19]),
    (11, &[1, 1, 5, 1, 1]),
    (13, &[1, 1, 1, 3, 11]),
    (14, &[1, 3, 5, 5, 31]),
    (1, &[1, 3, 3, 9, 7, 49]),
    (13, &[1, 1, 1, 15, 21, 21]),
    (16, &[1, 3, 1, 13, 27, 49]),
    (19, &[1, 1, 1, 15, 7, 5]),
    (22, &[1, 3, 1, 15, 13, 25]),
    (25, &[1, 1, 5, 5, 19, 61]),
    (1, &[1, 3, 7, 11, 23, 15, 103]),
    (4, &[1, 3, 7, 13, 13, 15, 69]),
];

/// The direction numbers of some dimensions.
#[derive(Debug, Clone, PartialEq)]
pub struct Sobol(Vec<[u64; BITS]>);

impl Sobol {
    /// The sequence in so many dimensions, at most [`MOST_DIMENSIONS`].
    pub fn new(dimensions: usize) -> Self {
        let first = std::array::from_fn(|k| 1 << (BITS - 1 - k));
        let others = INITIAL.iter().map(|(polynomial, initial)| directions(*polynomial, initial));
        Self(std::iter::once(first).chain(others).take(dimensions).collect())
    }

    /// The first 64 binary digits of a coordinate of a point.
    pub fn digits(&self, index: u64, dimension: usize) -> u64 {
        let Some(directions) = self.0.get(dimension) else { return 0 };
        let digits = (0..BITS).take_while(|k| index >> k != 0).filter(|k| index >> k & 1 == 1);
        digits.fold(0, |sum, k| sum ^ directions[k])
    }
}

/// V_k = m_k 2^(64−k), m_k from the s numbers before it (Joe and Kuo, equation 2).
fn directions(polynomial: u64, initial: &[u64]) -> [u64; BITS] {
    let degree = initial.len();
    let mut v = [0_u64; BITS];
    for k in 0..BITS {
        v[k] = if k < degree {
            initial[k] << (BITS - 1 - k)
        } else {
            let inner = (1..degree).filter(|j| polynomial >> (degree - 1 - j) & 1 == 1);
            inner.fold(v[k - degree] ^ (v[k - degree] >> degree), |sum, j| sum ^ v[k - j])
        };
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;
    use sobol::Sobol as Published;
    use sobol::params::JoeKuoD6;

    #[test]
    fn points_are_those_published() {
        let ours = Sobol::new(MOST_DIMENSIONS);
        let theirs = Published::<f64>::new(MOST_DIMENSIONS, &JoeKuoD6::minimal());
        for (index, point) in theirs.take(5000).enumerate() {
            // The published generator goes through the points in the order of the Gray code.
            let gray = (index ^ (index >> 1)) as u64;
            for (dimension, coordinate) in point.iter().enumerate() {
                let found = ours.digits(gray, dimension) as f64 * 0.5_f64.powi(64);
                assert!(
                    (found - coordinate).abs() < 1e-9,
                    "point {index}, dimension {dimension}: {found} {coordinate}"
                );
            }
        }
    }

    #[test]
    fn each_coordinate_takes_every_interval_once() {
        let sobol = Sobol::new(MOST_DIMENSIONS);
        for dimension in 0..MOST_DIMENSIONS {
            let mut seen = [false; 1024];
            (0..1024).for_each(|index| seen[(sobol.digits(index, dimension) >> 54) as usize] = true);
            assert!(seen.iter().all(|seen| *seen), "dimension {dimension}");
        }
    }
}
