//! The equations of the stages of a collocation step, of which many unknowns may relax by themselves, as relaxation
//! modes do.
//!
//!   J = [K C; B −S], S diagonal:   E_k = (A⁻¹/h + S_k)⁻¹ (5×5, over the stages),   Z₂ = E (R₂ + B Z₁),
//!   (A⁻¹/h − K − C E B) Z₁ = R₁ + C E R₂
//!
//! A step of n₁ + n₂ unknowns costs 25 n₁² n₂ and the LU of 5 n₁ rows instead of that of 5 (n₁ + n₂). The form is read
//! off the matrices themselves, exactly; rows and columns that are zero cost nothing.

use nalgebra::{DMatrix, SMatrix, SVector};

/// The number of stages.
pub(super) const STAGES: usize = 5;

/// A matrix over the stages.
pub(super) type Square = SMatrix<f64, STAGES, STAGES>;

/// Unknowns that relax by themselves behind so many others.
fn leading(slopes: &DMatrix<f64>) -> usize {
    let n = slopes.nrows();
    let alone = |k: usize| {
        let coupled = (k + 1..n).any(|j| slopes[(k, j)] != 0.0 || slopes[(j, k)] != 0.0);
        !coupled && slopes[(k, k)] <= 0.0
    };
    (0..n).rev().take_while(|k| alone(*k)).last().unwrap_or(n)
}

/// The equations of one block: (`rule` ⊗ I − diag J_i) Z = R, with `rule` = A⁻¹/h, in the order stage by stage.
pub(super) struct StageEquations<'a> {
    rule: Square,
    slopes: [&'a DMatrix<f64>; STAGES],
    /// How many unknowns do not relax by themselves.
    lead: usize,
    /// E of each of the others.
    decays: Vec<Square>,
}

impl<'a> StageEquations<'a> {
    /// Finds their form.
    pub fn new(rule: Square, slopes: [&'a DMatrix<f64>; STAGES]) -> Self {
        let (n, mut lead) = (slopes[0].nrows(), slopes.iter().map(|slopes| leading(slopes)).max().unwrap_or(0));
        let decay = |k: usize| {
            let own = SVector::<f64, STAGES>::from_fn(|i, _| -slopes[i][(k, k)]);
            (rule + Square::from_diagonal(&own)).try_inverse()
        };
        let decays: Option<Vec<_>> = (lead..n).map(decay).collect();
        if decays.is_none() {
            lead = n;
        }
        Self { rule, slopes, lead, decays: decays.unwrap_or_default() }
    }

    /// Solves them for the right sides R, which become Z; none if there is no solution.
    pub fn solve(&self, right: &mut DMatrix<f64>) -> Option<()> {
        let (n, lead) = (self.slopes[0].nrows(), self.lead);
        self.relax(right);
        if lead == 0 {
            return Some(());
        }
        let mut reduced =
            DMatrix::from_fn(STAGES * lead, right.ncols(), |row, column| right[(row / lead * n + row % lead, column)]);
        for (i, slopes) in self.slopes.iter().enumerate() {
            for (a, k) in self.couplings(slopes) {
                for column in 0..right.ncols() {
                    reduced[(i * lead + a, column)] += slopes[(a, k)] * right[(i * n + k, column)];
                }
            }
        }
        let solved = self.matrix().lu().solve(&reduced)?;
        for column in 0..right.ncols() {
            for row in 0..STAGES * lead {
                right[(row / lead * n + row % lead, column)] = solved[(row, column)];
            }
            self.follow(right, column);
        }
        Some(())
    }

    /// R₂ becomes E R₂.
    fn relax(&self, right: &mut DMatrix<f64>) {
        let n = self.slopes[0].nrows();
        for (k, decay) in (self.lead..n).zip(&self.decays) {
            for column in 0..right.ncols() {
                let own = SVector::<f64, STAGES>::from_fn(|i, _| right[(i * n + k, column)]);
                let relaxed = decay * own;
                (0..STAGES).for_each(|i| right[(i * n + k, column)] = relaxed[i]);
            }
        }
    }

    /// Z₂ = E R₂ + E B Z₁, for one column of right sides.
    fn follow(&self, right: &mut DMatrix<f64>, column: usize) {
        let n = self.slopes[0].nrows();
        for (k, decay) in (self.lead..n).zip(&self.decays) {
            let driven = |i: usize| {
                let terms = (0..self.lead).map(|b| self.slopes[i][(k, b)] * right[(i * n + b, column)]);
                terms.sum::<f64>()
            };
            let through = decay * SVector::<f64, STAGES>::from_fn(|i, _| driven(i));
            (0..STAGES).for_each(|i| right[(i * n + k, column)] += through[i]);
        }
    }

    /// Where C is not zero.
    fn couplings(&self, slopes: &'a DMatrix<f64>) -> impl Iterator<Item = (usize, usize)> + use<'a> {
        let (n, lead) = (slopes.nrows(), self.lead);
        (lead..n).flat_map(move |k| (0..lead).map(move |a| (a, k))).filter(|place| slopes[*place] != 0.0)
    }

    /// A⁻¹/h − K − C E B.
    fn matrix(&self) -> DMatrix<f64> {
        let lead = self.lead;
        let mut matrix = DMatrix::zeros(STAGES * lead, STAGES * lead);
        for i in 0..STAGES {
            for j in 0..STAGES {
                matrix.view_mut((i * lead, j * lead), (lead, lead)).fill_diagonal(self.rule[(i, j)]);
            }
            let own = self.slopes[i].view((0, 0), (lead, lead));
            matrix.view_mut((i * lead, i * lead), (lead, lead)).zip_apply(&own, |entry, slope| *entry -= slope);
            for (a, k) in self.couplings(self.slopes[i]) {
                let weight = self.slopes[i][(a, k)];
                for j in 0..STAGES {
                    let through = weight * self.decays[k - lead][(i, j)];
                    for b in 0..lead {
                        matrix[(i * lead + a, j * lead + b)] -= through * self.slopes[j][(k, b)];
                    }
                }
            }
        }
        matrix
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Five matrices of n unknowns, those from `lead` on relaxing, coupled to the others.
    fn slopes(n: usize, lead: usize) -> [DMatrix<f64>; STAGES] {
        std::array::from_fn(|stage| {
            DMatrix::from_fn(n, n, |i, j| {
                let entry = ((7 * i + 3 * j + 5 * stage) as f64).sin();
                match (i < lead, j < lead) {
                    (false, false) if i != j => 0.0,
                    (false, false) => -(10f64.powi(i as i32 - 4)) * (2.0 + entry),
                    _ => entry,
                }
            })
        })
    }

    #[test]
    fn eliminated_unknowns_come_out_as_from_the_whole_matrix() {
        let (n, lead, size) = (9, 3, 0.3);
        let rule = Square::from_fn(|i, j| if i == j { 2.0 / size } else { ((i + 2 * j) as f64).cos() });
        let slopes = slopes(n, lead);
        let right = DMatrix::from_fn(STAGES * n, 2, |i, j| ((i + 11 * j) as f64).cos());
        let whole = DMatrix::from_fn(STAGES * n, STAGES * n, |row, column| {
            let ((i, a), (j, b)) = ((row / n, row % n), (column / n, column % n));
            let own = if i == j { slopes[i][(a, b)] } else { 0.0 };
            if a == b { rule[(i, j)] - own } else { -own }
        });
        let expected = whole.lu().solve(&right).unwrap();
        let equations = StageEquations::new(rule, slopes.each_ref());
        assert_eq!(equations.lead, lead);
        let mut found = right;
        equations.solve(&mut found).unwrap();
        let off = (&found - &expected).amax() / expected.amax();
        println!("off by {off:e}");
        // Rounding of forty-five unknowns.
        assert!(off < 1e-13, "{off:e}");
    }

    #[test]
    fn a_matrix_without_such_unknowns_is_solved_whole() {
        assert_eq!(leading(&DMatrix::from_fn(3, 3, |i, j| (i + j) as f64)), 3);
        assert_eq!(leading(&DMatrix::from_diagonal_element(3, 3, 1.0)), 3);
    }
}
