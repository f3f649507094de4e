//! The continuum of u alone: what α adds once it follows.
//!
//!   D_c(k) = D_mm − D_ms D_ss⁻¹ D_sm,   M_c(k) = Nᴴ M N,   N = (1 | −D_ss⁻¹ D_sm)
//!
//! as series in k along a direction, m = u with the motions of α that D₀ does not oppose, s the others in axes along
//! which M is one and D₀ diagonal.

use super::super::bloch::C64;
use super::super::waves::NEUTRAL;
use gyration::tensor::Vec3;
use nalgebra::DMatrix;

/// (u, α) with α in its own axes, those that nothing holds first.
#[derive(Debug, Clone)]
pub(super) struct Condensed {
    /// Column by column: u, what nothing holds, the others.
    basis: DMatrix<f64>,
    /// How many columns are not eliminated.
    kept: usize,
    /// ω² of the others at k = 0 [1/s²].
    squares: Vec<f64>,
    /// M along the basis.
    mass: DMatrix<f64>,
    /// R [m] and Φ_R along the basis.
    cells: Vec<(Vec3, DMatrix<f64>)>,
}

impl Condensed {
    /// Of D₀, M and the matrices of all cells; none where M of α is not positive.
    pub fn new(zeroth: &DMatrix<f64>, mass: &DMatrix<f64>, cells: &[(Vec3, DMatrix<f64>)]) -> Option<Self> {
        let (size, inner) = (mass.nrows(), mass.nrows() - 3);
        let mut basis = DMatrix::identity(size, size);
        let (mut squares, mut kept) = (Vec::new(), 3);
        if inner > 0 {
            let of_inner = |matrix: &DMatrix<f64>| matrix.view((3, 3), (inner, inner)).into_owned();
            let lower = of_inner(mass).cholesky()?.l();
            let half = lower.solve_lower_triangular(&of_inner(zeroth))?;
            let within = lower.solve_lower_triangular(&half.transpose())?;
            let eigen = (0.5 * (&within + within.transpose())).symmetric_eigen();
            let largest = eigen.eigenvalues.amax();
            let is_floppy = |k: &usize| eigen.eigenvalues[*k].abs() <= NEUTRAL * largest;
            let (floppy, stiff): (Vec<usize>, Vec<usize>) = (0..inner).partition(is_floppy);
            kept += floppy.len();
            squares = stiff.iter().map(|k| eigen.eigenvalues[*k]).collect();
            let order: Vec<usize> = floppy.into_iter().chain(stiff).collect();
            let vectors = lower.transpose().solve_upper_triangular(&eigen.eigenvectors.select_columns(&order))?;
            basis.view_mut((3, 3), (inner, inner)).copy_from(&vectors);
        }
        let along = |matrix: &DMatrix<f64>| basis.tr_mul(&(matrix * &basis));
        let cells = cells.iter().map(|(place, matrix)| (*place, along(matrix))).collect();
        Some(Self { mass: along(mass), kept, squares, cells, basis })
    }

    /// How many motions of α nothing holds.
    pub fn floppy(&self) -> usize {
        self.kept - 3
    }

    /// M of u.
    pub fn density(&self) -> DMatrix<f64> {
        self.mass.view((0, 0), (3, 3)).into_owned()
    }

    /// D₁ of u by the axes that are eliminated, given D₁ᵃ.
    pub fn coupling(&self, first: &DMatrix<f64>) -> DMatrix<f64> {
        let whole = first.rows(0, 3) * &self.basis;
        whole.columns(self.kept, self.squares.len()).into_owned()
    }

    /// ω² of the axes that are eliminated [1/s²].
    pub fn squares(&self) -> &[f64] {
        &self.squares
    }

    /// D_c and M_c at k, to an order in k of D_c, of M_c two less.
    pub fn at(&self, k: &Vec3, order: usize) -> (DMatrix<C64>, DMatrix<C64>) {
        let terms = self.terms(k, order);
        let (kept, rest) = (self.kept, self.squares.len());
        let block = |term: &DMatrix<C64>, (row, high): (usize, usize), (column, wide): (usize, usize)| {
            term.view((row, column), (high, wide)).into_owned()
        };
        let (m, s) = ((0, kept), (kept, rest));
        // The series of D_ss⁻¹.
        let inverse =
            DMatrix::from_fn(rest, rest, |i, j| C64::new(if i == j { 1.0 / self.squares[i] } else { 0.0 }, 0.0));
        let mut inverses = vec![inverse.clone()];
        for p in 1..=order {
            let sum = (1..=p).map(|q| block(&terms[q], s, s) * &inverses[p - q]);
            inverses.push(-(&inverse * sum.fold(DMatrix::zeros(rest, rest), |sum, term| sum + term)));
        }
        let follows = |p: usize| {
            let sum = (0..=p).map(|q| &inverses[q] * block(&terms[p - q], s, m));
            sum.fold(DMatrix::zeros(rest, kept), |sum, term| sum + term)
        };
        let follows: Vec<DMatrix<C64>> = (0..=order).map(follows).collect();
        let mut stiffness = DMatrix::zeros(kept, kept);
        for p in 0..=order {
            stiffness += block(&terms[p], m, m);
            for q in 0..=p {
                stiffness -= block(&terms[q], m, s) * &follows[p - q];
            }
        }
        let whole = self.mass.map(|entry| C64::new(entry, 0.0));
        let (across, own) = (block(&whole, m, s), block(&whole, s, s));
        let mut mass = block(&whole, m, m);
        for p in 0..=order - 2 {
            let moved = &across * &follows[p];
            mass -= &moved + moved.adjoint();
            for q in 0..=p {
                mass += follows[q].adjoint() * &own * &follows[p - q];
            }
        }
        (stiffness, mass)
    }

    /// D and M of the lattice itself at k, along the basis.
    pub fn whole(&self, k: &Vec3) -> (DMatrix<C64>, DMatrix<C64>) {
        let mut stiffness = DMatrix::zeros(self.mass.nrows(), self.mass.nrows());
        for (place, matrix) in &self.cells {
            let (sin, cos) = libm::sincos(k.dot(place));
            stiffness.zip_apply(matrix, |sum: &mut C64, entry| *sum += C64::new(cos, sin) * entry);
        }
        (stiffness, self.mass.map(|entry| C64::new(entry, 0.0)))
    }

    /// (i k·R)^p/p! Φ_R, summed over R, for each p up to an order.
    fn terms(&self, k: &Vec3, order: usize) -> Vec<DMatrix<C64>> {
        let size = self.mass.nrows();
        let mut terms = vec![DMatrix::zeros(size, size); order + 1];
        for (place, matrix) in &self.cells {
            let along = C64::new(0.0, k.dot(place));
            let mut factor = C64::new(1.0, 0.0);
            for (p, term) in terms.iter_mut().enumerate() {
                if p > 0 {
                    factor *= along / p as f64;
                }
                term.zip_apply(matrix, |sum, entry| *sum += factor * entry);
            }
        }
        terms
    }
}
