//! The matrices s I − J of implicit steps, with fewer unknowns where some of the rates are unknowns themselves: x₁' =
//! x₂.
//!
//!   J = [0 I 0; K C D; E H M]:
//!   s x₁ − x₂ = r₁,   −K x₁ + (s I − C) x₂ − D x₃ = r₂,   −E x₁ − H x₂ + (s I − M) x₃ = r₃
//!
//!   (s² I − s C − K) x₁ − D x₃ = r₂ + (s I − C) r₁,   −(s H + E) x₁ + (s I − M) x₃ = r₃ − H r₁,   x₂ = s x₁ − r₁
//!
//! s is γ/h or (α + iβ)/h. Bodies that deform are of this form, without x₃ or with a contraction there: a factorization
//! costs an eighth, or a quarter. Where most unknowns relax by themselves (`arrowhead`) these are eliminated first. The
//! form is read off the matrix itself, exactly, in every factorization: other blocks are factorized as they stand.

use nalgebra::DMatrix;

use crate::arrowhead::{ComplexArrowhead, RealArrowhead, leading};
use gyration_blocks::{ComplexLu, RealLu, Singular};

/// How many rates are unknowns themselves: the number of rows (0 I 0) at the top of J.
fn second_order(jacobian: &DMatrix<f64>) -> Option<usize> {
    let n = jacobian.nrows();
    let half = (1..=n / 2).find(|column| jacobian[(0, *column)] != 0.0)?;
    let unit = |i: usize, j: usize| if j == i + half { 1.0 } else { 0.0 };
    let is_unit = (0..n).all(|j| (0..half).all(|i| jacobian[(i, j)] == unit(i, j)));
    is_unit.then_some(half)
}

/// C and H, row by row.
fn copy_resistance(resistance: &mut [f64], jacobian: &DMatrix<f64>, half: usize) {
    for (i, row) in resistance.chunks_exact_mut(half).take(jacobian.nrows() - half).enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = jacobian[(half + i, half + j)];
        }
    }
}

/// The factors of γ/h I − J.
#[derive(Debug, Clone, Default)]
pub(crate) struct RealShifted {
    whole: RealLu,
    reduced: RealLu,
    resistance: Vec<f64>,
    shift: f64,
    /// The number of x₁, if there are any.
    half: Option<usize>,
    /// Where most unknowns relax by themselves.
    arrowhead: RealArrowhead,
    is_arrowhead: bool,
}

impl RealShifted {
    pub fn new(size: usize) -> Self {
        // Half of the square is the largest (n − half) × half.
        let (whole, reduced, resistance) = (RealLu::new(size), RealLu::new(size), vec![0.0; size * size / 2]);
        Self { whole, reduced, resistance, arrowhead: RealArrowhead::new(size), ..Self::default() }
    }

    /// Factorizes shift · I − J.
    ///
    /// # Errors
    /// `Singular`.
    pub fn factorize(&mut self, shift: f64, jacobian: &DMatrix<f64>) -> Result<(), Singular> {
        let lead = leading(jacobian);
        self.is_arrowhead = lead.is_some();
        if let Some(lead) = lead {
            return self.arrowhead.factorize(shift, jacobian, lead);
        }
        self.half = second_order(jacobian);
        let Some(half) = self.half else {
            return self.whole.factorize(|i, j| if i == j { shift - jacobian[(i, j)] } else { -jacobian[(i, j)] });
        };
        self.shift = shift;
        copy_resistance(&mut self.resistance, jacobian, half);
        self.reduced.resize(jacobian.nrows() - half);
        self.reduced.factorize(|i, j| {
            let one = if i == j { shift } else { 0.0 };
            if j < half {
                shift * (one - jacobian[(half + i, half + j)]) - jacobian[(half + i, j)]
            } else {
                one - jacobian[(half + i, half + j)]
            }
        })
    }

    /// Solves (shift · I − J) x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        if self.is_arrowhead {
            return self.arrowhead.solve(b);
        }
        let Some(half) = self.half else { return self.whole.solve(b) };
        let (first, second) = b.split_at_mut(half);
        for (value, row) in second.iter_mut().zip(self.resistance.chunks_exact(half)) {
            *value -= row.iter().zip(first.iter()).map(|(c, r)| c * r).sum::<f64>();
        }
        for (value, r) in second.iter_mut().zip(first.iter()) {
            *value += self.shift * r;
        }
        self.reduced.solve(second);
        for (x, r) in second.iter_mut().zip(first) {
            (*r, *x) = (*x, self.shift * *x - *r);
        }
    }
}

/// The factors of (α + iβ)/h I − J.
#[derive(Debug, Clone, Default)]
pub(crate) struct ComplexShifted {
    whole: ComplexLu,
    reduced: ComplexLu,
    resistance: Vec<f64>,
    shift: (f64, f64),
    half: Option<usize>,
    arrowhead: ComplexArrowhead,
    is_arrowhead: bool,
}

impl ComplexShifted {
    pub fn new(size: usize) -> Self {
        let (whole, reduced, resistance) = (ComplexLu::new(size), ComplexLu::new(size), vec![0.0; size * size / 2]);
        Self { whole, reduced, resistance, arrowhead: ComplexArrowhead::new(size), ..Self::default() }
    }

    /// Factorizes (shift.0 + i shift.1) I − J.
    ///
    /// # Errors
    /// `Singular`.
    pub fn factorize(&mut self, shift: (f64, f64), jacobian: &DMatrix<f64>) -> Result<(), Singular> {
        let lead = leading(jacobian);
        self.is_arrowhead = lead.is_some();
        if let Some(lead) = lead {
            return self.arrowhead.factorize(shift, jacobian, lead);
        }
        self.half = second_order(jacobian);
        let (re, im) = shift;
        let Some(half) = self.half else {
            return self.whole.factorize(|i, j| {
                let entry = -jacobian[(i, j)];
                if i == j { (re + entry, im) } else { (entry, 0.0) }
            });
        };
        self.shift = shift;
        copy_resistance(&mut self.resistance, jacobian, half);
        self.reduced.resize(jacobian.nrows() - half);
        let square = ((re - im) * (re + im), 2.0 * re * im);
        self.reduced.factorize(|i, j| {
            let (own, resistance) = (i == j, jacobian[(half + i, half + j)]);
            if j >= half {
                return if own { (re - resistance, im) } else { (-resistance, 0.0) };
            }
            let diagonal = if own { square } else { (0.0, 0.0) };
            (diagonal.0 - re * resistance - jacobian[(half + i, j)], diagonal.1 - im * resistance)
        })
    }

    /// Solves ((shift.0 + i shift.1) I − J) x = b in place, b = real + i imaginary.
    pub fn solve(&self, real: &mut [f64], imaginary: &mut [f64]) {
        if self.is_arrowhead {
            return self.arrowhead.solve(real, imaginary);
        }
        let Some(half) = self.half else { return self.whole.solve(real, imaginary) };
        let (re, im) = self.shift;
        let (first_re, second_re) = real.split_at_mut(half);
        let (first_im, second_im) = imaginary.split_at_mut(half);
        for (i, row) in self.resistance.chunks_exact(half).take(second_re.len()).enumerate() {
            let drag = |r: &[f64]| row.iter().zip(r).map(|(c, r)| c * r).sum::<f64>();
            second_re[i] -= drag(first_re);
            second_im[i] -= drag(first_im);
        }
        for i in 0..half {
            second_re[i] += re * first_re[i] - im * first_im[i];
            second_im[i] += re * first_im[i] + im * first_re[i];
        }
        self.reduced.solve(second_re, second_im);
        for i in 0..half {
            let (x_re, x_im) = (second_re[i], second_im[i]);
            second_re[i] = re * x_re - im * x_im - first_re[i];
            second_im[i] = re * x_im + im * x_re - first_im[i];
            (first_re[i], first_im[i]) = (x_re, x_im);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Residuals within rounding of the entries, s² of them included.
        #[test]
        fn systems_of_second_order_are_solved_like_any_other(
            entries in proptest::collection::vec(-1.0_f64..1.0, 64),
            x in proptest::collection::vec(-1.0_f64..1.0, 16),
            more in 0_usize..3,
            shift in (0.5_f64..3.0, 0.5_f64..3.0),
        ) {
            let n = 6 + more;
            let jacobian = DMatrix::from_fn(n, n, |i, j| match i {
                0..3 => if j == i + 3 { 1.0 } else { 0.0 },
                _ => entries[8 * i + j],
            });
            prop_assert_eq!(second_order(&jacobian), Some(3));
            let mut real = RealShifted::new(n);
            let mut complex = ComplexShifted::new(n);
            prop_assume!(real.factorize(shift.0, &jacobian).is_ok());
            prop_assume!(complex.factorize(shift, &jacobian).is_ok());
            let apply = |v: &[f64], i: usize| (0..n).map(|j| jacobian[(i, j)] * v[j]).sum::<f64>();
            let (re, im) = x.split_at(8);
            let mut b: Vec<f64> = (0..n).map(|i| shift.0 * re[i] - apply(re, i)).collect();
            real.solve(&mut b);
            let mut c: Vec<f64> = (0..n).map(|i| shift.0 * re[i] - shift.1 * im[i] - apply(re, i)).collect();
            let mut d: Vec<f64> = (0..n).map(|i| shift.0 * im[i] + shift.1 * re[i] - apply(im, i)).collect();
            complex.solve(&mut c, &mut d);
            // A matrix may be close to singular: the residual tells, the solution need not.
            let largest = b.iter().chain(&c).chain(&d).fold(1.0, |m: f64, v| m.max(v.abs()));
            for i in 0..n {
                let residual = shift.0 * b[i] - apply(&b, i) - (shift.0 * re[i] - apply(re, i));
                prop_assert!(residual.abs() < 1e-12 * largest, "{residual:e}");
                let wanted = shift.0 * re[i] - shift.1 * im[i] - apply(re, i);
                let residual = shift.0 * c[i] - shift.1 * d[i] - apply(&c, i) - wanted;
                prop_assert!(residual.abs() < 1e-12 * largest, "{residual:e}");
            }
        }
    }

    proptest! {
        #[test]
        fn systems_with_unknowns_that_relax_are_solved_like_any_other(
            entries in proptest::collection::vec(-1.0_f64..1.0, 121),
            x in proptest::collection::vec(-1.0_f64..1.0, 22),
            shift in (2.5_f64..5.0, 0.5_f64..3.0),
        ) {
            let n = 11;
            let jacobian = DMatrix::from_fn(n, n, |i, j| match (i < 4, j < 4, i == j) {
                (false, false, true) => -entries[n * i + j].abs() * 1e3,
                (false, false, false) => 0.0,
                _ => 0.3 * entries[n * i + j],
            });
            prop_assert_eq!(leading(&jacobian), Some(4));
            let (mut real, mut complex) = (RealShifted::new(n), ComplexShifted::new(n));
            prop_assert!(real.factorize(shift.0, &jacobian).is_ok());
            prop_assert!(complex.factorize(shift, &jacobian).is_ok());
            let apply = |v: &[f64], i: usize| (0..n).map(|j| jacobian[(i, j)] * v[j]).sum::<f64>();
            let (re, im) = x.split_at(n);
            let mut b: Vec<f64> = (0..n).map(|i| shift.0 * re[i] - apply(re, i)).collect();
            real.solve(&mut b);
            let mut c: Vec<f64> = (0..n).map(|i| shift.0 * re[i] - shift.1 * im[i] - apply(re, i)).collect();
            let mut d: Vec<f64> = (0..n).map(|i| shift.0 * im[i] + shift.1 * re[i] - apply(im, i)).collect();
            complex.solve(&mut c, &mut d);
            for i in 0..n {
                // Diagonally dominant: some roundings of numbers of order one, of entries up to 1e3.
                let errors = [b[i] - re[i], c[i] - re[i], d[i] - im[i]];
                prop_assert!(errors.iter().all(|error| error.abs() < 1e-12), "{errors:?}");
            }
        }
    }

    #[test]
    fn other_systems_are_not_taken_for_second_order() {
        let mut jacobian = DMatrix::from_fn(4, 4, |i, j| if j == i + 2 { 1.0 } else { 0.0 });
        assert_eq!(second_order(&jacobian), Some(2));
        jacobian[(0, 1)] = 1e-300;
        assert_eq!(second_order(&jacobian), None);
        assert_eq!([0, 1, 3].map(|n| second_order(&DMatrix::zeros(n, n))), [None; 3]);
    }
}
