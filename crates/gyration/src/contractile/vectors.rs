//! The vectors of which the derivative of a contractile body is made: all increments are of rank one, ξ = u ⊗ w, and
//! what stands beside the tangent of the material in δ(gΣ) − X K + K X + 𝓜(δΛ) is four dyads,
//!
//!   w ⊗ (gΣ − Kᵀ)u + K C u ⊗ C⁻¹w − C u ⊗ (KᵀC⁻¹w + (μ/2) C⁻¹Λᵀw) + (K − (μ/2) Λᵀ)w ⊗ u        for δΛ = −ξ Λ,
//!
//! of which one vector depends on the row of the increment alone (`RowVectors`) and one on its column
//! (`ColumnVectors`). An increment of G has ξ = u ⊗ w with u = −e_j and δΛ = −ξ Λ + Λ ξ, of which the second adds
//! (μ/2)(C Λ u ⊗ C⁻¹w + w ⊗ Λ u). In the axes gΣ = diag(m) and 𝔸 couples little (`material::coaxial`), so that all that
//! goes with u_i and u_k in number (i, k) is gathered before:
//!
//!   R_ik = u_i (a_ik w_k − c_i first_k) + u_k (b_ik w_i + second_i) + (K C u)_i (C⁻¹w)_k − (Kᵀu)_k w_i,   R_ii besides: Σ_j≠i d_ij u_j w_j
//!
//! Symbols as in `slopes`.

use super::batch::MatrixBatch;
use crate::simd::{F64x4, SimdMat3, SimdVec3};

/// What depends on j alone, of all three: column i holds the numbers i of their vectors.
#[derive(Debug, Clone, Copy)]
pub(super) struct RowVectors<F> {
    pub u: SimdMat3<F>,
    /// K C u, and −Kᵀ u.
    forth: SimdMat3<F>,
    across: SimdMat3<F>,
    /// −Zᵀ u.
    pub total: SimdMat3<F>,
}

/// What depends on B alone.
#[derive(Debug, Clone, Copy)]
pub(super) struct ColumnVectors {
    pub w: SimdVec3,
    /// C⁻¹ w, m w, −Λᵀ w, Z w.
    pub back: SimdVec3,
    pub heavy: SimdVec3,
    pub pulled: SimdVec3,
    pub total: SimdVec3,
    /// What goes with u_i, u_k and, on the diagonal, with u_j.
    own: SimdMat3,
    other: SimdMat3,
    along: SimdMat3,
}

/// What the vectors of rows and columns are made of.
pub(super) struct DyadVectors<F> {
    /// c and 1/c, m.
    pub values: SimdVec3<F>,
    pub inverses: SimdVec3<F>,
    pub mandel: SimdVec3<F>,
    /// μ/2.
    pub half: f64,
    /// K, Λ and Z.
    pub kept: SimdMat3<F>,
    pub pulled: SimdMat3<F>,
    pub total: SimdMat3<F>,
    /// a with d_ii + m_i on the diagonal, b with m_k added, d without diagonal; times g.
    pub own: SimdMat3<F>,
    pub other: SimdMat3<F>,
    pub along: SimdMat3<F>,
}

/// What the vectors of columns are made of, column B for each.
struct ColumnTerms<F> {
    w: SimdMat3<F>,
    back: SimdMat3<F>,
    first: SimdMat3<F>,
    second: SimdMat3<F>,
    pulled: SimdMat3<F>,
    total: SimdMat3<F>,
}

/// diag(a) B.
#[inline(always)]
fn stretched<F: F64x4>(a: &SimdVec3<F>, SimdMat3([x, y, z]): &SimdMat3<F>) -> SimdMat3<F> {
    SimdMat3([a.product(x), a.product(y), a.product(z)])
}

impl<F: F64x4> DyadVectors<F> {
    /// For ξ = u ⊗ w, δΛ = −ξ Λ; column i of u holds the numbers i of all three.
    #[inline(always)]
    pub fn spatial(&self, u: &SimdMat3<F>) -> RowVectors<F> {
        let carried = u.scaled(&self.three());
        RowVectors {
            u: *u,
            forth: carried.times_transposed(&self.kept),
            across: u.times(&self.kept) * -1.0,
            total: u.times(&self.total) * -1.0,
        }
    }

    /// For ξ = u ⊗ w, δΛ = −ξ Λ + Λ ξ.
    #[inline(always)]
    pub fn relaxed(&self, u: &SimdMat3<F>) -> RowVectors<F> {
        let RowVectors { forth, across, total, .. } = self.spatial(u);
        let seen = u.times_transposed(&self.pulled) * self.half;
        RowVectors { u: *u, forth: forth + seen.scaled(&self.three()), across: across + seen, total }
    }

    /// (μ/2) C u and (μ/2) u.
    #[inline(always)]
    pub fn strained(&self, u: &SimdMat3<F>) -> [SimdMat3<F>; 2] {
        let half = *u * self.half;
        [half.scaled(&self.three()), half]
    }

    #[inline(always)]
    fn three(&self) -> [f64; 3] {
        let [x, y, z, _] = self.values.0.numbers();
        [x, y, z]
    }

    /// Of all three w, columns of a matrix.
    #[inline(always)]
    pub fn columns(&self, w: &SimdMat3<F>) -> [ColumnVectors; 3] {
        let back = stretched(&self.inverses, w);
        let pulled = self.pulled.transpose().times(w);
        let half = pulled * self.half;
        let columns = ColumnTerms {
            w: *w,
            back,
            first: self.kept.transpose().times(&back) + stretched(&self.inverses, &half),
            second: self.kept.times(w) - half,
            pulled: pulled * -1.0,
            total: self.total.times(w),
        };
        [self.column(&columns, 0), self.column(&columns, 1), self.column(&columns, 2)]
    }

    #[inline(always)]
    fn column(&self, columns: &ColumnTerms<F>, b: usize) -> ColumnVectors {
        let (w, second, first) = (columns.w.0[b], columns.second.0[b], SimdVec3(columns.first.0[b].0.numbers()));
        let kept = SimdVec3(w.0.numbers());
        let ([x, y, z], [p, q, r]) = (self.own.0, self.other.0);
        let own = [
            x * kept.0[0] - self.values * first.0[0],
            y * kept.0[1] - self.values * first.0[1],
            z * kept.0[2] - self.values * first.0[2],
        ];
        let other = [p.product(&w) + second, q.product(&w) + second, r.product(&w) + second];
        ColumnVectors {
            w: kept,
            back: SimdVec3(columns.back.0[b].0.numbers()),
            heavy: SimdVec3(self.mandel.product(&w).0.numbers()),
            pulled: SimdVec3(columns.pulled.0[b].0.numbers()),
            total: SimdVec3(columns.total.0[b].0.numbers()),
            own: SimdMat3(own).kept(),
            other: SimdMat3(other).kept(),
            along: self.along.scaled(&[kept.0[0], kept.0[1], kept.0[2]]).kept(),
        }
    }
}

impl<F: F64x4> RowVectors<F> {
    /// R.
    #[inline(always)]
    pub fn stretched(&self, column: &ColumnVectors) -> MatrixBatch<F> {
        let [x, y, z] = &self.u.0;
        let SimdMat3([a, b, c]) = &column.along;
        let one = self.number(column, 0, 0) + (*y * b.0[0] + *z * c.0[0]);
        let two = self.number(column, 1, 1) + (*x * a.0[1] + *z * c.0[1]);
        let three = self.number(column, 2, 2) + (*x * a.0[2] + *y * b.0[2]);
        MatrixBatch([
            [one, self.number(column, 1, 0), self.number(column, 2, 0)],
            [self.number(column, 0, 1), two, self.number(column, 2, 1)],
            [self.number(column, 0, 2), self.number(column, 1, 2), three],
        ])
    }

    #[inline(always)]
    fn number(&self, column: &ColumnVectors, i: usize, k: usize) -> SimdVec3<F> {
        let Self { u, forth, across, .. } = self;
        let pair = u.0[i] * column.own.0[k].0[i] + u.0[k] * column.other.0[k].0[i];
        pair + (forth.0[i] * column.back.0[k] + across.0[k] * column.w.0[i])
    }
}

/// x ⊗ C⁻¹w + w ⊗ y.
#[inline(always)]
pub(super) fn strained<F: F64x4>([x, y]: &[SimdMat3<F>; 2], column: &ColumnVectors) -> MatrixBatch<F> {
    let (a, b) = (&column.back.0, &column.w.0);
    let ([p, q, r], [u, v, w]) = (&x.0, &y.0);
    MatrixBatch([
        [*p * a[0] + *u * b[0], *q * a[0] + *u * b[1], *r * a[0] + *u * b[2]],
        [*p * a[1] + *v * b[0], *q * a[1] + *v * b[1], *r * a[1] + *v * b[2]],
        [*p * a[2] + *w * b[0], *q * a[2] + *w * b[1], *r * a[2] + *w * b[2]],
    ])
}
