//! The matrices s I − J of implicit steps where many unknowns relax by themselves: x₂' = B x₁ − S x₂, S ≥ 0 diagonal.
//!
//!   J = [K C; B −S]:   (s I − K − C (s I + S)⁻¹ B) x₁ = r₁ + C (s I + S)⁻¹ r₂,   x₂ = (s I + S)⁻¹ (r₂ + B x₁)
//!
//! Such are the relaxation modes of a history force. A factorization costs n₁² (n₁/3 + n₂) instead of n³/3. S ≥ 0 and
//! Re s > 0, so that nothing small is divided by. The form is read off the matrix itself, exactly.

use nalgebra::DMatrix;

use gyration_blocks::{ComplexLu, RealLu, Singular};

/// How many unknowns come before those that relax by themselves, if these are the most.
pub(crate) fn leading(jacobian: &DMatrix<f64>) -> Option<usize> {
    let n = jacobian.nrows();
    let relaxes = |k: usize| {
        let alone = (k + 1..n).all(|j| jacobian[(k, j)] == 0.0 && jacobian[(j, k)] == 0.0);
        alone && jacobian[(k, k)] <= 0.0
    };
    let lead = (0..n).rev().take_while(|k| relaxes(*k)).last()?;
    (lead > 0 && n - lead > lead).then_some(lead)
}

/// C row by row, B row by row, and S.
#[derive(Debug, Clone, Default)]
struct ArrowheadParts {
    lead: usize,
    into: Vec<f64>,
    from: Vec<f64>,
    decay: Vec<f64>,
}

impl ArrowheadParts {
    /// Room for a matrix of this size: at most half of the unknowns do not relax.
    fn new(size: usize) -> Self {
        let half = || Vec::with_capacity(size * size / 4 + 1);
        Self { lead: 0, into: half(), from: half(), decay: Vec::with_capacity(size) }
    }

    fn copy(&mut self, jacobian: &DMatrix<f64>, lead: usize) {
        let n = jacobian.nrows();
        self.lead = lead;
        self.into.clear();
        self.from.clear();
        self.decay.clear();
        for i in 0..lead {
            self.into.extend((lead..n).map(|k| jacobian[(i, k)]));
        }
        for k in lead..n {
            self.from.extend((0..lead).map(|j| jacobian[(k, j)]));
            self.decay.push(-jacobian[(k, k)]);
        }
    }

    /// Row i of C.
    fn coupling(&self, i: usize) -> &[f64] {
        &self.into[i * self.decay.len()..(i + 1) * self.decay.len()]
    }

    /// Row k of B.
    fn drive(&self, k: usize) -> &[f64] {
        &self.from[k * self.lead..(k + 1) * self.lead]
    }
}

/// The factors of γ/h I − J.
#[derive(Debug, Clone, Default)]
pub(crate) struct RealArrowhead {
    parts: ArrowheadParts,
    reduced: RealLu,
    /// (s + S)⁻¹.
    inverse: Vec<f64>,
}

impl RealArrowhead {
    pub fn new(size: usize) -> Self {
        let (reduced, inverse) = (RealLu::new(size / 2), Vec::with_capacity(size));
        Self { parts: ArrowheadParts::new(size), reduced, inverse }
    }

    /// Factorizes shift · I − J, of which the first `lead` unknowns do not relax by themselves.
    ///
    /// # Errors
    /// `Singular`.
    pub fn factorize(&mut self, shift: f64, jacobian: &DMatrix<f64>, lead: usize) -> Result<(), Singular> {
        self.parts.copy(jacobian, lead);
        self.inverse.clear();
        self.inverse.extend(self.parts.decay.iter().map(|decay| 1.0 / (shift + decay)));
        self.reduced.resize(lead);
        let (parts, inverse) = (&self.parts, &self.inverse);
        self.reduced.factorize(|i, j| {
            let through = parts.coupling(i).iter().zip(inverse).enumerate();
            let through: f64 = through.map(|(k, (c, inverse))| c * inverse * parts.drive(k)[j]).sum();
            (if i == j { shift } else { 0.0 }) - jacobian[(i, j)] - through
        })
    }

    /// Solves (shift · I − J) x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        let (first, second) = b.split_at_mut(self.parts.lead);
        for (value, inverse) in second.iter_mut().zip(&self.inverse) {
            *value *= inverse;
        }
        for (i, value) in first.iter_mut().enumerate() {
            *value += self.parts.coupling(i).iter().zip(second.iter()).map(|(c, r)| c * r).sum::<f64>();
        }
        self.reduced.solve(first);
        for (k, (value, inverse)) in second.iter_mut().zip(&self.inverse).enumerate() {
            *value += inverse * self.parts.drive(k).iter().zip(first.iter()).map(|(b, x)| b * x).sum::<f64>();
        }
    }
}

/// The factors of (α + iβ)/h I − J.
#[derive(Debug, Clone, Default)]
pub(crate) struct ComplexArrowhead {
    parts: ArrowheadParts,
    reduced: ComplexLu,
    /// Real and imaginary parts of (s + S)⁻¹.
    inverse: Vec<(f64, f64)>,
}

impl ComplexArrowhead {
    pub fn new(size: usize) -> Self {
        let (reduced, inverse) = (ComplexLu::new(size / 2), Vec::with_capacity(size));
        Self { parts: ArrowheadParts::new(size), reduced, inverse }
    }

    /// Factorizes (shift.0 + i shift.1) I − J.
    ///
    /// # Errors
    /// `Singular`.
    pub fn factorize(&mut self, shift: (f64, f64), jacobian: &DMatrix<f64>, lead: usize) -> Result<(), Singular> {
        self.parts.copy(jacobian, lead);
        self.inverse.clear();
        self.inverse.extend(self.parts.decay.iter().map(|decay| {
            let (re, im) = (shift.0 + decay, shift.1);
            let square = re * re + im * im;
            (re / square, -im / square)
        }));
        self.reduced.resize(lead);
        let (parts, inverse) = (&self.parts, &self.inverse);
        self.reduced.factorize(|i, j| {
            let (mut re, mut im) = if i == j { shift } else { (0.0, 0.0) };
            re -= jacobian[(i, j)];
            for (k, (c, inverse)) in parts.coupling(i).iter().zip(inverse).enumerate() {
                let weight = c * parts.drive(k)[j];
                re -= weight * inverse.0;
                im -= weight * inverse.1;
            }
            (re, im)
        })
    }

    /// Solves ((shift.0 + i shift.1) I − J) x = b in place, b = real + i imaginary.
    pub fn solve(&self, real: &mut [f64], imaginary: &mut [f64]) {
        let lead = self.parts.lead;
        let (first_re, second_re) = real.split_at_mut(lead);
        let (first_im, second_im) = imaginary.split_at_mut(lead);
        let divided = |(re, im): (f64, f64), inverse: (f64, f64)| {
            (re * inverse.0 - im * inverse.1, re * inverse.1 + im * inverse.0)
        };
        for (k, inverse) in self.inverse.iter().enumerate() {
            (second_re[k], second_im[k]) = divided((second_re[k], second_im[k]), *inverse);
        }
        for i in 0..lead {
            let through = |r: &[f64]| self.parts.coupling(i).iter().zip(r).map(|(c, r)| c * r).sum::<f64>();
            first_re[i] += through(second_re);
            first_im[i] += through(second_im);
        }
        self.reduced.solve(first_re, first_im);
        for (k, inverse) in self.inverse.iter().enumerate() {
            let drive = |x: &[f64]| self.parts.drive(k).iter().zip(x).map(|(b, x)| b * x).sum::<f64>();
            let (re, im) = divided((drive(first_re), drive(first_im)), *inverse);
            second_re[k] += re;
            second_im[k] += im;
        }
    }
}
