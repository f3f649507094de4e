//! The equations of the stages of a collocation step, of which many unknowns may follow from the others: those whose
//! rate is another unknown, as places are integrals of velocities, and those that relax by themselves, as relaxation
//! modes do.
//!
//!   J = [K C; B −S], S diagonal:   E_k = (A⁻¹/h + S_k)⁻¹ (5×5, over the stages),   Z₂ = E (R₂ + B Z₁),
//!   (A⁻¹/h − K − C E B) Z₁ = R₁ + C E R₂
//!
//! A step of n₁ + n₂ unknowns costs the LU of 5 n₁ rows instead of that of 5 (n₁ + n₂), and 25 for each entry of C and
//! each of B that meet: an eighth of the LU of a body whose places all follow. The form is read off the matrices
//! themselves, exactly. Of unknowns that are coupled with more than that none is eliminated: there is no pivot to be
//! chosen.

use gyration_blocks::{BlockArithmetic, Real};
use nalgebra::{DMatrix, SMatrix, SVector};

/// The number of stages.
pub(super) const STAGES: usize = 5;

/// A matrix over the stages.
pub(super) type Square = SMatrix<f64, STAGES, STAGES>;

/// The slopes of one set of unknowns at the stages.
type Slopes<'a> = [&'a DMatrix<f64>; STAGES];

/// Unknowns that relax by themselves behind so many others.
fn leading(slopes: &DMatrix<f64>) -> usize {
    let n = slopes.nrows();
    let alone = |k: usize| {
        let coupled = (k + 1..n).any(|j| slopes[(k, j)] != 0.0 || slopes[(j, k)] != 0.0);
        !coupled && slopes[(k, k)] <= 0.0
    };
    (0..n).rev().take_while(|k| alone(*k)).last().unwrap_or(n)
}

/// Where an unknown stands whose multiple is the rate of this one at all stages, if that is all there is of it.
fn derivative_of(slopes: &Slopes, k: usize) -> Option<usize> {
    let mut entries = slopes.iter().flat_map(|slopes| (0..slopes.ncols()).filter(|j| slopes[(k, *j)] != 0.0));
    let first = entries.next()?;
    (first != k && entries.all(|other| other == first)).then_some(first)
}

/// Those among the leading unknowns that are integrals of others, of which none is one of them.
fn integrals(slopes: &Slopes, lead: usize) -> Vec<usize> {
    let n = slopes[0].nrows();
    let mut is_used = vec![false; lead];
    let mut found: Vec<usize> = Vec::new();
    for k in 0..lead {
        let Some(rate) = derivative_of(slopes, k).filter(|rate| *rate < lead) else { continue };
        let relaxes = |j: usize| slopes.iter().any(|slopes| slopes[(j, k)] != 0.0);
        if !is_used[k] && !found.contains(&rate) && !(lead..n).any(relaxes) {
            is_used[rate] = true;
            found.push(k);
        }
    }
    found
}

/// The equations of one block: (`rule` ⊗ I − diag J_i) Z = R, with `rule` = A⁻¹/h, in the order stage by stage.
pub(super) struct StageEquations<'a> {
    rule: Square,
    slopes: Slopes<'a>,
    /// The unknowns that are solved for.
    kept: Vec<usize>,
    /// Those that follow from them, and E of each.
    following: Vec<usize>,
    decays: Vec<Square>,
    /// B of each that follows, stage by stage: places among the kept ones, and entries.
    driving: Vec<Vec<(usize, f64)>>,
}

impl<'a> StageEquations<'a> {
    /// Finds their form.
    pub fn new(rule: Square, slopes: Slopes<'a>) -> Self {
        let (n, lead) = (slopes[0].nrows(), slopes.iter().map(|slopes| leading(slopes)).max().unwrap_or(0));
        let mut following = integrals(&slopes, lead);
        following.extend(lead..n);
        // The last unknown relaxes by itself in any case, and may feel all places.
        let alone = integrals(&slopes, n);
        if alone.len() > following.len() {
            following = alone;
        }
        let decay = |k: &usize| {
            let own = SVector::<f64, STAGES>::from_fn(|i, _| -slopes[i][(*k, *k)]);
            (rule + Square::from_diagonal(&own)).try_inverse()
        };
        let decays: Option<Vec<_>> = following.iter().map(decay).collect();
        let decays = decays.unwrap_or_else(|| {
            following.clear();
            Vec::new()
        });
        let mut is_kept = vec![true; n];
        following.iter().for_each(|k| is_kept[*k] = false);
        let kept: Vec<usize> = (0..n).filter(|k| is_kept[*k]).collect();
        let row = |k: usize, slopes: &DMatrix<f64>| {
            let entries = kept.iter().enumerate().map(|(b, place)| (b, slopes[(k, *place)]));
            entries.filter(|(_, slope)| *slope != 0.0).collect()
        };
        let driving = following.iter().flat_map(|k| slopes.iter().map(|slopes| row(*k, slopes))).collect();
        Self { rule, slopes, kept, following, decays, driving }
    }

    /// Solves them for the right sides R, which become Z; none if there is no solution.
    pub fn solve(&self, right: &mut DMatrix<f64>) -> Option<()> {
        let (n, columns, size) = (self.slopes[0].nrows(), right.ncols(), STAGES * self.kept.len());
        self.relax(right);
        if size == 0 {
            return Some(());
        }
        let place = |row: usize| row / self.kept.len() * n + self.kept[row % self.kept.len()];
        // Row by row, as the factors are.
        let mut reduced = vec![0.0; size * columns];
        for (row, values) in reduced.chunks_exact_mut(columns).enumerate() {
            values.iter_mut().enumerate().for_each(|(column, value)| *value = right[(place(row), column)]);
        }
        self.each_coupling(|stage, a, behind, slope| {
            let values = &mut reduced[(stage * self.kept.len() + a) * columns..][..columns];
            let from = stage * n + self.following[behind];
            values.iter_mut().enumerate().for_each(|(column, value)| *value += slope * right[(from, column)]);
        });
        let (mut matrix, mut pivots) = (self.matrix(), vec![0; size]);
        Real::factorize(&mut matrix, &mut pivots).ok()?;
        Real::solve_columns(&matrix, &pivots, &mut reduced, columns);
        for (row, values) in reduced.chunks_exact(columns).enumerate() {
            values.iter().enumerate().for_each(|(column, value)| right[(place(row), column)] = *value);
        }
        (0..columns).for_each(|column| self.follow(right, column));
        Some(())
    }

    /// R₂ becomes E R₂.
    fn relax(&self, right: &mut DMatrix<f64>) {
        let n = self.slopes[0].nrows();
        for (k, decay) in self.following.iter().zip(&self.decays) {
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
        for (behind, (k, decay)) in self.following.iter().zip(&self.decays).enumerate() {
            let driven = |i: usize| {
                let entries = self.driving[behind * STAGES + i].iter();
                let terms = entries.map(|(b, slope)| slope * right[(i * n + self.kept[*b], column)]);
                terms.sum::<f64>()
            };
            let through = decay * SVector::<f64, STAGES>::from_fn(|i, _| driven(i));
            (0..STAGES).for_each(|i| right[(i * n + k, column)] += through[i]);
        }
    }

    /// Each entry of C: its stage, the place of the kept one, that of the one that follows, and what it is.
    fn each_coupling(&self, mut each: impl FnMut(usize, usize, usize, f64)) {
        for (stage, slopes) in self.slopes.iter().enumerate() {
            for (behind, k) in self.following.iter().enumerate() {
                for (a, place) in self.kept.iter().enumerate() {
                    let slope = slopes[(*place, *k)];
                    if slope != 0.0 {
                        each(stage, a, behind, slope);
                    }
                }
            }
        }
    }

    /// A⁻¹/h − K − C E B, row by row.
    fn matrix(&self) -> Vec<f64> {
        let lead = self.kept.len();
        let width = STAGES * lead;
        let mut matrix = vec![0.0; width * width];
        for (i, slopes) in self.slopes.iter().enumerate() {
            for (a, place) in self.kept.iter().enumerate() {
                let row = &mut matrix[(i * lead + a) * width..][..width];
                (0..STAGES).for_each(|j| row[j * lead + a] = self.rule[(i, j)]);
                for (entry, column) in row[i * lead..].iter_mut().zip(&self.kept) {
                    *entry -= slopes[(*place, *column)];
                }
            }
        }
        self.each_coupling(|i, a, behind, slope| {
            let row = &mut matrix[(i * lead + a) * width..][..width];
            for j in 0..STAGES {
                let through = slope * self.decays[behind][(i, j)];
                for (b, driven) in &self.driving[behind * STAGES + j] {
                    row[j * lead + b] -= through * driven;
                }
            }
        });
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

    /// How far what is found of these slopes is off the solution of the whole matrix, and how many unknowns were kept.
    fn compared(slopes: &[DMatrix<f64>; STAGES]) -> (f64, usize) {
        let (n, size) = (slopes[0].nrows(), 0.3);
        let rule = Square::from_fn(|i, j| if i == j { 2.0 / size } else { ((i + 2 * j) as f64).cos() });
        let right = DMatrix::from_fn(STAGES * n, 2, |i, j| ((i + 11 * j) as f64).cos());
        let whole = DMatrix::from_fn(STAGES * n, STAGES * n, |row, column| {
            let ((i, a), (j, b)) = ((row / n, row % n), (column / n, column % n));
            let own = if i == j { slopes[i][(a, b)] } else { 0.0 };
            if a == b { rule[(i, j)] - own } else { -own }
        });
        let expected = whole.lu().solve(&right).unwrap();
        let equations = StageEquations::new(rule, slopes.each_ref());
        let mut found = right;
        equations.solve(&mut found).unwrap();
        ((&found - &expected).amax() / expected.amax(), equations.kept.len())
    }

    #[test]
    fn eliminated_unknowns_come_out_as_from_the_whole_matrix() {
        let (off, kept) = compared(&slopes(9, 3));
        println!("off by {off:e}");
        assert_eq!(kept, 3);
        // Rounding of forty-five unknowns.
        assert!(off < 1e-13, "{off:e}");
    }

    /// Two places, their velocities, a third place beside, whose rate is two of them, and a mode that relaxes.
    #[test]
    fn places_follow_from_velocities() {
        let mut slopes = slopes(6, 5);
        for slopes in &mut slopes {
            for (k, rates) in [(0, [0.0, 0.0, 1.0, 0.0]), (1, [0.0, 0.0, 0.0, -2.5]), (4, [0.0, 0.0, 1.0, 1.0])] {
                slopes.row_mut(k).fill(0.0);
                rates.iter().enumerate().for_each(|(j, rate)| slopes[(k, j)] = *rate);
            }
            (slopes[(5, 0)], slopes[(5, 1)]) = (0.0, 0.0);
        }
        let (off, kept) = compared(&slopes);
        println!("off by {off:e}");
        assert_eq!(kept, 3);
        assert!(off < 1e-13, "{off:e}");
        // What a relaxing one feels is no integral of its own.
        slopes[2][(5, 1)] = 0.3;
        let (off, kept) = compared(&slopes);
        assert_eq!(kept, 4);
        assert!(off < 1e-13, "{off:e}");
        // Of two that are the rates of one another, one follows.
        let oscillation = std::array::from_fn(|_| DMatrix::from_row_slice(2, 2, &[0.0, 1.0, -4.0, 0.0]));
        assert_eq!(integrals(&oscillation.each_ref(), 2), [0]);
    }

    #[test]
    fn a_matrix_without_such_unknowns_is_solved_whole() {
        assert_eq!(leading(&DMatrix::from_fn(3, 3, |i, j| (i + j) as f64)), 3);
        assert_eq!(leading(&DMatrix::from_diagonal_element(3, 3, 1.0)), 3);
    }
}
