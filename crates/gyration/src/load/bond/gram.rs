//! Potentials of the products of seven vectors: u = Δ, the columns of P_i, the columns of P_j.
//!
//!   G_mn = u_m·u_n,   ∂V/∂u_m = Σ_n W_mn u_n,   ∂²V/∂u_m∂u_n = W_mn 1 + Σ_vw V_vw (∂G_v/∂u_m) ⊗ (∂G_w/∂u_n)
//!
//! The u are linear in the coordinates: Δ has p_j and P_j Y, and the opposite of p_i and P_i X.

use super::{BondFault, Loads};
use crate::load::resistance::Mat12;
use crate::tensor::{Mat3, Vec3};
use gyration_expression::{Expression, ParseError, Scratch};
use nalgebra::SMatrix;

/// How many vectors there are.
pub(super) const VECTORS: usize = 7;
/// How many variables V may have.
const VARIABLES: usize = 31;

/// The names of the invariants, and t.
pub const INVARIANT_NAMES: [&str; VARIABLES] = [
    "d_x", "d_y", "d_z", "H_xx", "H_xy", "H_xz", "H_yx", "H_yy", "H_yz", "H_zx", "H_zy", "H_zz", "C_xx", "C_xy",
    "C_xz", "C_yx", "C_yy", "C_yz", "C_zx", "C_zy", "C_zz", "D_xx", "D_xy", "D_xz", "D_yx", "D_yy", "D_yz", "D_zx",
    "D_zy", "D_zz", "t",
];

/// Between which two of the seven vectors an invariant is the product.
fn vectors_of(variable: usize) -> [usize; 2] {
    match variable {
        0..3 => [0, 1 + variable],
        3..12 => [1 + (variable - 3) / 3, 4 + (variable - 3) % 3],
        12..21 => [1 + (variable - 12) / 3, 1 + (variable - 12) % 3],
        _ => [4 + (variable - 21) / 3, 4 + (variable - 21) % 3],
    }
}

/// How two bodies stand to each other, and how that changes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    /// Δ [m].
    pub apart: Vec3,
    /// Δ̇ [m/s].
    pub rate: Vec3,
    /// P_i, P_j.
    pub gradients: [Mat3; 2],
    /// Ṗ_i, Ṗ_j.
    pub gradient_rates: [Mat3; 2],
}

/// A product of two of the seven vectors, and what a unit of it changes by each.
pub(super) type GramPair = [usize; 2];

impl Span {
    /// The seven vectors.
    pub fn vectors(&self) -> [Vec3; VECTORS] {
        seven(&self.apart, &self.gradients)
    }

    /// Their rates.
    pub fn rates(&self) -> [Vec3; VECTORS] {
        seven(&self.rate, &self.gradient_rates)
    }

    /// The loads of ∂V/∂Δ alone.
    pub fn of_force(&self, points: &[Vec3; 2], force: &Vec3) -> [Loads; 2] {
        [Loads::at_point(*force, &points[0]), Loads::at_point(-force, &points[1])]
    }
}

fn seven(apart: &Vec3, gradients: &[Mat3; 2]) -> [Vec3; VECTORS] {
    let [one, other] = gradients;
    let column = |matrix: &Mat3, k: usize| -> Vec3 { matrix.column(k).into() };
    [*apart, column(one, 0), column(one, 1), column(one, 2), column(other, 0), column(other, 1), column(other, 2)]
}

/// The loads of the derivatives g_m of a potential by the seven vectors.
pub(super) fn loads_of(points: &[Vec3; 2], gradient: &[Vec3; VECTORS]) -> [Loads; 2] {
    let own = |first: usize| Mat3::from_columns(&[gradient[first], gradient[first + 1], gradient[first + 2]]);
    let force = gradient[0];
    [
        Loads { force, moment: force * points[0].transpose() - own(1) },
        Loads { force: -force, moment: -(force * points[1].transpose()) - own(4) },
    ]
}

/// ∂²V/∂u_m∂u_n, or what takes its place.
#[derive(Debug, Clone)]
pub(super) struct SpanSlopes {
    pub blocks: [[Mat3; VECTORS]; VECTORS],
}

impl SpanSlopes {
    /// Zeros.
    pub fn zeros() -> Self {
        Self { blocks: [[Mat3::zeros(); VECTORS]; VECTORS] }
    }

    /// Of a potential of Δ alone.
    pub fn of_apart(slope: &Mat3) -> Self {
        let mut slopes = Self::zeros();
        slopes.blocks[0][0] = *slope;
        slopes
    }

    /// Subtracts Lᵀ H L, L the seven vectors by the coordinates of both bodies: ∂Q = −∂²V.
    pub fn add_to(&self, points: &[Vec3; 2], by: &mut [[Mat12; 2]; 2]) {
        let weights = weights(points);
        for (row, weighted) in weights.iter().enumerate() {
            for (column, other) in weights.iter().enumerate() {
                let mut block = Mat3::zeros();
                for (m, left) in weighted {
                    for (n, right) in other {
                        block += (left * right) * self.blocks[*m][*n];
                    }
                }
                let target = &mut by[row / 4][column / 4];
                let mut place = target.fixed_view_mut::<3, 3>(3 * (row % 4), 3 * (column % 4));
                place -= block;
            }
        }
    }
}

/// By which weights the coordinates p, and the columns of P, of both bodies enter the seven vectors.
fn weights(points: &[Vec3; 2]) -> [[(usize, f64); 2]; 8] {
    std::array::from_fn(|coordinate| {
        let (body, column) = (coordinate / 4, coordinate % 4);
        let sign = if body == 0 { -1.0 } else { 1.0 };
        match column.checked_sub(1) {
            None => [(0, sign), (0, 0.0)],
            Some(k) => [(0, sign * points[body][k]), (1 + 3 * body + k, 1.0)],
        }
    })
}

/// Products of the seven vectors, with the derivatives of a potential by them.
#[derive(Debug, Clone)]
pub(super) struct Products<'a> {
    pub pairs: &'a [GramPair],
    /// V_v.
    pub gradient: &'a [f64],
}

impl Products<'_> {
    /// Σ_v V_v ∂G_v/∂u.
    pub fn gradient(&self, vectors: &[Vec3; VECTORS]) -> [Vec3; VECTORS] {
        let mut sum = [Vec3::zeros(); VECTORS];
        for ([m, n], slope) in self.pairs.iter().zip(self.gradient) {
            sum[*m] += *slope * vectors[*n];
            sum[*n] += *slope * vectors[*m];
        }
        sum
    }

    /// Σ_v V_v ∂²G_v/∂u².
    pub fn curvature(&self, slopes: &mut SpanSlopes) {
        for ([m, n], slope) in self.pairs.iter().zip(self.gradient) {
            slopes.blocks[*m][*n] += Mat3::from_diagonal_element(*slope);
            slopes.blocks[*n][*m] += Mat3::from_diagonal_element(*slope);
        }
    }
}

/// ∂G_v/∂u of a product: two vectors, each at a place.
pub(super) fn product_slope([m, n]: GramPair, vectors: &[Vec3; VECTORS]) -> [(usize, Vec3); 2] {
    [(m, vectors[n]), (n, vectors[m])]
}

/// A potential of the invariants.
#[derive(Debug, Clone, PartialEq)]
pub struct InvariantPotential {
    expression: Expression,
    /// The invariants that occur, and between which vectors they are products.
    variables: Vec<usize>,
    pairs: Vec<GramPair>,
}

impl InvariantPotential {
    /// Reads V of d_x …, H_xx …, C_xx …, D_xx … and t.
    ///
    /// # Errors
    /// [`ParseError`] with the column.
    pub fn parse(text: &str, constants: &[(String, f64)]) -> Result<Self, ParseError> {
        let expression = Expression::parse(text, &INVARIANT_NAMES, constants)?.holding(&[VARIABLES - 1]);
        let variables: Vec<usize> = (0..VARIABLES - 1).filter(|variable| expression.uses(*variable)).collect();
        let pairs = variables.iter().map(|variable| vectors_of(*variable)).collect();
        Ok(Self { expression, variables, pairs })
    }

    pub(super) fn uses_time(&self) -> bool {
        self.expression.uses(VARIABLES - 1)
    }

    /// The values of all variables.
    fn values(vectors: &[Vec3; VECTORS], time: f64) -> [f64; VARIABLES] {
        std::array::from_fn(|variable| match variable {
            t if t == VARIABLES - 1 => time,
            other => {
                let [m, n] = vectors_of(other);
                vectors[m].dot(&vectors[n])
            }
        })
    }

    /// The derivatives by the invariants that occur, in their order.
    fn of_variables(&self, all: &[f64; VARIABLES]) -> [f64; VARIABLES] {
        let mut chosen = [0.0; VARIABLES];
        chosen.iter_mut().zip(&self.variables).for_each(|(chosen, variable)| *chosen = all[*variable]);
        chosen
    }

    /// V, and the loads.
    pub(super) fn loads(
        &self,
        points: &[Vec3; 2],
        span: &Span,
        time: f64,
        scratch: &mut Scratch,
    ) -> Result<(f64, [Loads; 2]), BondFault> {
        let vectors = span.vectors();
        let mut all = [0.0; VARIABLES];
        let found = self.expression.gradient(&Self::values(&vectors, time), scratch, &mut all);
        let value = found.map_err(BondFault::Undefined)?;
        let gradient = self.of_variables(&all);
        let products = Products { pairs: &self.pairs, gradient: &gradient };
        Ok((value, loads_of(points, &products.gradient(&vectors))))
    }

    /// ∂²V/∂u².
    pub(super) fn slopes(&self, span: &Span, time: f64, scratch: &mut Scratch) -> Result<SpanSlopes, BondFault> {
        let vectors = span.vectors();
        let (mut all, mut hessian) = ([0.0; VARIABLES], [0.0; VARIABLES * VARIABLES]);
        let found = self.expression.hessian(&Self::values(&vectors, time), scratch, &mut all, &mut hessian);
        found.map_err(BondFault::Undefined)?;
        let gradient = self.of_variables(&all);
        let mut slopes = SpanSlopes::zeros();
        Products { pairs: &self.pairs, gradient: &gradient }.curvature(&mut slopes);
        for (v, one) in self.variables.iter().enumerate() {
            for (w, other) in self.variables.iter().enumerate() {
                let second = hessian[one * VARIABLES + other];
                if second == 0.0 {
                    continue;
                }
                for (m, left) in product_slope(self.pairs[v], &vectors) {
                    for (n, right) in product_slope(self.pairs[w], &vectors) {
                        slopes.blocks[m][n] += second * left * right.transpose();
                    }
                }
            }
        }
        Ok(slopes)
    }
}

/// Six forms of products.
pub(super) type Forms = SMatrix<f64, 6, 15>;
