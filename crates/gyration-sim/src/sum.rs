//! A sum whose rounding does not grow with the number of its terms.

/// A compensated sum (Neumaier): the sum of the terms to about its own rounding, in whatever sizes they come.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Sum {
    sum: f64,
    /// What the roundings have taken.
    lost: f64,
    /// Whether there is a term.
    is_begun: bool,
}

impl Sum {
    /// Adds a term; one alone stays as it is, with its sign if it is zero.
    pub fn add(&mut self, term: f64) {
        if !std::mem::replace(&mut self.is_begun, true) {
            self.sum = term;
            return;
        }
        let sum = self.sum + term;
        self.lost += if self.sum.abs() >= term.abs() { (self.sum - sum) + term } else { (term - sum) + self.sum };
        self.sum = sum;
    }

    /// The numbers of a checkpoint: sum, what the roundings have taken, whether there is a term.
    pub fn bits(&self) -> [u64; 3] {
        [self.sum.to_bits(), self.lost.to_bits(), u64::from(self.is_begun)]
    }

    /// From the numbers of a checkpoint.
    pub fn of_bits([sum, lost, is_begun]: [u64; 3]) -> Self {
        Self { sum: f64::from_bits(sum), lost: f64::from_bits(lost), is_begun: is_begun != 0 }
    }

    /// The sum.
    pub fn value(&self) -> f64 {
        if self.lost == 0.0 { self.sum } else { self.sum + self.lost }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(terms: impl IntoIterator<Item = f64>) -> f64 {
        let mut sum = Sum::default();
        terms.into_iter().for_each(|term| sum.add(term));
        sum.value()
    }

    #[test]
    fn what_rounding_takes_from_one_term_comes_back_with_the_last() {
        assert_eq!(sum([1.0, 1e100, 1.0, -1e100]), 2.0);
        assert_eq!(sum((0..10_000_000).map(|_| 0.1)), 1e6);
    }

    #[test]
    fn one_term_is_the_sum_to_the_sign_of_its_zero() {
        assert!(sum([-0.0]).is_sign_negative() && sum([0.0]).is_sign_positive() && sum([]) == 0.0);
    }
}
