//! The potential of a 6×6 matrix: ½ zᵀ S z of the relative displacement and turn, zero at the start.
//!
//!   r = ½ Eᵀ [P_i0⁻ᵀ P_iᵀ Δ + P_j0⁻ᵀ P_jᵀ Δ] − Eᵀ Δ_0,   φ_k = −½ ε_kab (Eᵀ P_i0⁻ᵀ P_iᵀ P_j P_j0⁻¹ E)_ab
//!
//! z = (r | φ) along the axes E, the first of which is that of the bond. Both are forms of the products of Δ and the
//! columns of P_i and P_j.

use super::Loads;
use super::gram::{Forms, GramPair, Products, Span, SpanSlopes, VECTORS, loads_of, product_slope};
use crate::kinematics::Placement;
use crate::tensor::{Mat3, Vec3, axial};
use nalgebra::{SMatrix, SVector};

/// S, symmetric and positive semidefinite: N/m for r, N m for φ.
pub type Stiffness6 = SMatrix<f64, 6, 6>;

type Vec6 = SVector<f64, 6>;
type Vec15 = SVector<f64, 15>;

/// The products of which z is made: Δ with the columns of P_i, of P_j, and these with each other.
const PRODUCTS: [GramPair; 15] = [
    [0, 1],
    [0, 2],
    [0, 3],
    [0, 4],
    [0, 5],
    [0, 6],
    [1, 4],
    [1, 5],
    [1, 6],
    [2, 4],
    [2, 5],
    [2, 6],
    [3, 4],
    [3, 5],
    [3, 6],
];

/// z as forms of these products.
#[derive(Debug, Clone, PartialEq)]
pub struct BondAxes {
    forms: Forms,
    /// z of the start is taken off.
    start: Vec6,
}

impl BondAxes {
    /// Along axes E (columns, orthonormal), of bodies that start at these places, with Δ_0 between the points [m].
    pub fn new(axes: &Mat3, starts: [&Placement; 2], apart: &Vec3) -> Self {
        let inverses = starts.map(|start| start.gradient.try_inverse().unwrap_or_else(Mat3::identity));
        // E^T P0^-T: takes d to r, and the left side of H to the axes.
        let [one, other] = inverses.map(|inverse| axes.transpose() * inverse.transpose());
        let mut forms = Forms::zeros();
        for k in 0..3 {
            for axis in 0..3 {
                forms[(k, axis)] = 0.5 * one[(k, axis)];
                forms[(k, 3 + axis)] = 0.5 * other[(k, axis)];
            }
        }
        for a in 0..3 {
            for b in 0..3 {
                // φ of H = e_a ⊗ e_b: −½ ε_k·(columns of the two maps).
                let turned: Mat3 = one.column(a) * other.column(b).transpose();
                let phi = -0.5 * turning(&turned);
                (0..3).for_each(|k| forms[(3 + k, 6 + 3 * a + b)] = phi[k]);
            }
        }
        let mut start = Vec6::zeros();
        start.fixed_rows_mut::<3>(0).copy_from(&(axes.transpose() * apart));
        Self { forms, start }
    }

    /// The products of a span.
    fn products(vectors: &[Vec3; VECTORS]) -> Vec15 {
        Vec15::from_fn(|v, _| vectors[PRODUCTS[v][0]].dot(&vectors[PRODUCTS[v][1]]))
    }

    /// z.
    pub(super) fn value(&self, span: &Span) -> Vec6 {
        self.forms * Self::products(&span.vectors()) - self.start
    }

    /// ż.
    pub(super) fn rate(&self, span: &Span) -> Vec6 {
        let (vectors, rates) = (span.vectors(), span.rates());
        let rate = |[m, n]: GramPair| vectors[m].dot(&rates[n]) + rates[m].dot(&vectors[n]);
        self.forms * Vec15::from_fn(|v, _| rate(PRODUCTS[v]))
    }

    /// The loads of −ςᵀ ∂z, given ς.
    pub(super) fn loads(&self, points: &[Vec3; 2], span: &Span, conjugate: &Vec6) -> [Loads; 2] {
        let slopes = self.forms.transpose() * conjugate;
        let products = Products { pairs: &PRODUCTS, gradient: slopes.as_slice() };
        loads_of(points, &products.gradient(&span.vectors()))
    }

    /// Adds Σ ς_k ∂²z_k/∂u².
    pub(super) fn add_curvature(&self, conjugate: &Vec6, slopes: &mut SpanSlopes) {
        let weights = self.forms.transpose() * conjugate;
        Products { pairs: &PRODUCTS, gradient: weights.as_slice() }.curvature(slopes);
    }

    /// Adds (∂z/∂u)ᵀ S (∂z/∂u at other vectors).
    pub(super) fn add_square(
        &self,
        matrix: &Stiffness6,
        [left, right]: [&[Vec3; VECTORS]; 2],
        slopes: &mut SpanSlopes,
    ) {
        let [rows, columns] = [left, right].map(|vectors| self.slope(vectors));
        for m in 0..VECTORS {
            let weighted = rows.fixed_view::<6, 3>(0, 3 * m).transpose() * matrix;
            for n in 0..VECTORS {
                slopes.blocks[m][n] += weighted * columns.fixed_view::<6, 3>(0, 3 * n);
            }
        }
    }

    /// ∂z/∂u, 6×21.
    fn slope(&self, vectors: &[Vec3; VECTORS]) -> SMatrix<f64, 6, 21> {
        let mut slope = SMatrix::<f64, 6, 21>::zeros();
        for (v, pair) in PRODUCTS.iter().enumerate() {
            for (m, by) in product_slope(*pair, vectors) {
                let mut place = slope.fixed_view_mut::<6, 3>(0, 3 * m);
                place += self.forms.column(v) * by.transpose();
            }
        }
        slope
    }
}

/// ε_kab M_ab.
fn turning(matrix: &Mat3) -> Vec3 {
    // `axial` of a matrix is ε_kab M_ba in this convention: see `Loads::body_torque`.
    -axial(matrix)
}

/// A bond with a stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct BondStiffness {
    /// Where z is measured.
    pub axes: BondAxes,
    /// S.
    pub matrix: Stiffness6,
}

impl BondStiffness {
    pub(super) fn loads(&self, points: &[Vec3; 2], span: &Span) -> (f64, [Loads; 2]) {
        let z = self.axes.value(span);
        let conjugate = self.matrix * z;
        (0.5 * z.dot(&conjugate), self.axes.loads(points, span, &conjugate))
    }

    pub(super) fn slopes(&self, span: &Span) -> SpanSlopes {
        let mut slopes = SpanSlopes::zeros();
        let vectors = span.vectors();
        self.axes.add_curvature(&(self.matrix * self.axes.value(span)), &mut slopes);
        self.axes.add_square(&self.matrix, [&vectors, &vectors], &mut slopes);
        slopes
    }
}
