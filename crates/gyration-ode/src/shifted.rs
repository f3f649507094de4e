//! The matrices s I − J of implicit steps, with half the unknowns where J is that of a system of second order.
//!
//!   J = [0 I; K C]:   s x₁ − x₂ = r₁,   −K x₁ + (s I − C) x₂ = r₂
//!   (s² I − s C − K) x₁ = r₂ + (s I − C) r₁,   x₂ = s x₁ − r₁
//!
//! s is γ/h or (α + iβ)/h. Bodies that deform are of this form; it costs an eighth. The form is read off the matrix itself,
//! exactly, in every factorization: other blocks are factorized as they stand.

use nalgebra::DMatrix;

use crate::linear::{ComplexLu, RealLu, Singular};

/// Whether the upper half of J is (0 I).
fn is_second_order(jacobian: &DMatrix<f64>) -> bool {
    let (n, half) = (jacobian.nrows(), jacobian.nrows() / 2);
    let unit = |i: usize, j: usize| if j == i + half { 1.0 } else { 0.0 };
    n > 0 && n.is_multiple_of(2) && (0..n).all(|j| (0..half).all(|i| jacobian[(i, j)] == unit(i, j)))
}

/// C of J = [0 I; K C], row by row.
fn copy_resistance(resistance: &mut [f64], jacobian: &DMatrix<f64>) {
    let half = jacobian.nrows() / 2;
    for i in 0..half {
        for j in 0..half {
            resistance[i * half + j] = jacobian[(half + i, half + j)];
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
    /// The number of coordinates, if the system is of second order.
    half: Option<usize>,
}

impl RealShifted {
    pub fn new(size: usize) -> Self {
        let half = size / 2;
        let (whole, reduced) = (RealLu::new(size), RealLu::new(half));
        Self { whole, reduced, resistance: vec![0.0; half * half], shift: 0.0, half: None }
    }

    /// Factorizes shift · I − J.
    ///
    /// # Errors
    /// `Singular`.
    pub fn factorize(&mut self, shift: f64, jacobian: &DMatrix<f64>) -> Result<(), Singular> {
        let half = jacobian.nrows() / 2;
        self.half = is_second_order(jacobian).then_some(half);
        if self.half.is_none() {
            return self.whole.factorize(|i, j| if i == j { shift - jacobian[(i, j)] } else { -jacobian[(i, j)] });
        }
        self.shift = shift;
        copy_resistance(&mut self.resistance, jacobian);
        self.reduced.factorize(|i, j| {
            let diagonal = if i == j { shift * shift } else { 0.0 };
            diagonal - shift * jacobian[(half + i, half + j)] - jacobian[(half + i, j)]
        })
    }

    /// Solves (shift · I − J) x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        let Some(half) = self.half else { return self.whole.solve(b) };
        let (first, second) = b.split_at_mut(half);
        for (i, row) in self.resistance.chunks_exact(half).enumerate() {
            let drag: f64 = row.iter().zip(first.iter()).map(|(c, r)| c * r).sum();
            second[i] += self.shift * first[i] - drag;
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
}

impl ComplexShifted {
    pub fn new(size: usize) -> Self {
        let half = size / 2;
        let (whole, reduced) = (ComplexLu::new(size), ComplexLu::new(half));
        Self { whole, reduced, resistance: vec![0.0; half * half], shift: (0.0, 0.0), half: None }
    }

    /// Factorizes (shift.0 + i shift.1) I − J.
    ///
    /// # Errors
    /// `Singular`.
    pub fn factorize(&mut self, shift: (f64, f64), jacobian: &DMatrix<f64>) -> Result<(), Singular> {
        let half = jacobian.nrows() / 2;
        self.half = is_second_order(jacobian).then_some(half);
        let (re, im) = shift;
        if self.half.is_none() {
            return self.whole.factorize(|i, j| {
                let entry = -jacobian[(i, j)];
                if i == j { (re + entry, im) } else { (entry, 0.0) }
            });
        }
        self.shift = shift;
        copy_resistance(&mut self.resistance, jacobian);
        let square = ((re - im) * (re + im), 2.0 * re * im);
        self.reduced.factorize(|i, j| {
            let (stiffness, resistance) = (jacobian[(half + i, j)], jacobian[(half + i, half + j)]);
            let diagonal = if i == j { square } else { (0.0, 0.0) };
            (diagonal.0 - re * resistance - stiffness, diagonal.1 - im * resistance)
        })
    }

    /// Solves ((shift.0 + i shift.1) I − J) x = b in place, b = real + i imaginary.
    pub fn solve(&self, real: &mut [f64], imaginary: &mut [f64]) {
        let Some(half) = self.half else { return self.whole.solve(real, imaginary) };
        let (re, im) = self.shift;
        let (first_re, second_re) = real.split_at_mut(half);
        let (first_im, second_im) = imaginary.split_at_mut(half);
        for (i, row) in self.resistance.chunks_exact(half).enumerate() {
            let drag = |r: &[f64]| row.iter().zip(r).map(|(c, r)| c * r).sum::<f64>();
            second_re[i] += re * first_re[i] - im * first_im[i] - drag(first_re);
            second_im[i] += re * first_im[i] + im * first_re[i] - drag(first_im);
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
            entries in proptest::collection::vec(-1.0_f64..1.0, 18),
            x in proptest::collection::vec(-1.0_f64..1.0, 12),
            shift in (0.5_f64..3.0, 0.5_f64..3.0),
        ) {
            let jacobian = DMatrix::from_fn(6, 6, |i, j| match i {
                0..3 => if j == i + 3 { 1.0 } else { 0.0 },
                _ => entries[6 * (i - 3) + j],
            });
            prop_assert!(is_second_order(&jacobian));
            let mut real = RealShifted::new(6);
            let mut complex = ComplexShifted::new(6);
            prop_assume!(real.factorize(shift.0, &jacobian).is_ok());
            prop_assume!(complex.factorize(shift, &jacobian).is_ok());
            let apply = |v: &[f64], i: usize| (0..6).map(|j| jacobian[(i, j)] * v[j]).sum::<f64>();
            let (re, im) = x.split_at(6);
            let mut b: Vec<f64> = (0..6).map(|i| shift.0 * re[i] - apply(re, i)).collect();
            real.solve(&mut b);
            let mut c: Vec<f64> = (0..6).map(|i| shift.0 * re[i] - shift.1 * im[i] - apply(re, i)).collect();
            let mut d: Vec<f64> = (0..6).map(|i| shift.0 * im[i] + shift.1 * re[i] - apply(im, i)).collect();
            complex.solve(&mut c, &mut d);
            // A matrix may be close to singular: the residual tells, the solution need not.
            let largest = b.iter().chain(&c).chain(&d).fold(1.0, |m: f64, v| m.max(v.abs()));
            for i in 0..6 {
                let residual = shift.0 * b[i] - apply(&b, i) - (shift.0 * re[i] - apply(re, i));
                prop_assert!(residual.abs() < 1e-12 * largest, "{residual:e}");
                let residual = shift.0 * c[i] - shift.1 * d[i] - apply(&c, i) - (shift.0 * re[i] - shift.1 * im[i] - apply(re, i));
                prop_assert!(residual.abs() < 1e-12 * largest, "{residual:e}");
            }
        }
    }

    #[test]
    fn other_systems_are_not_taken_for_second_order() {
        let mut jacobian = DMatrix::from_fn(4, 4, |i, j| if j == i + 2 { 1.0 } else { 0.0 });
        assert!(is_second_order(&jacobian));
        jacobian[(0, 1)] = 1e-300;
        assert!(!is_second_order(&jacobian));
        assert!(!is_second_order(&DMatrix::zeros(3, 3)) && !is_second_order(&DMatrix::zeros(0, 0)));
    }
}
