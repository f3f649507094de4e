//! Three 3×3 matrices at once, number by number: number (i, k) of all three stands in one `SimdVec3`.
//!
//! The three belong to the rows j of an increment e_j ⊗ e_B. All that is done with them is the same for each, so that
//! sums over i and k, transposes and traces take no shuffling of numbers; they are told apart only when they are
//! written. What they are multiplied by is kept with each of its numbers in all places (`Broadcast`), from where a
//! product can take it.
//!
//! No closures: they would not be compiled for the registers.

use crate::simd::{F64x4, SimdMat3, SimdVec3};

/// Three matrices: number (i, k) at [k][i].
#[derive(Debug, Clone, Copy)]
pub(crate) struct MatrixBatch<F>(pub [[SimdVec3<F>; 3]; 3]);

/// A matrix for all three: number (i, k) in all places of [k][i].
///
/// Aligned, and with it the frame of the function where it stands, so that no register is kept across two lines of the
/// cache.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(crate) struct Broadcast<F>(pub [[SimdVec3<F>; 3]; 3]);

/// A number in all places.
#[inline(always)]
pub(super) fn broadcast<F: F64x4>(number: f64, registers: F) -> SimdVec3<F> {
    SimdVec3(registers.like([number; 4]))
}

impl<F: F64x4> Broadcast<F> {
    #[inline(always)]
    pub fn of(matrix: &SimdMat3, registers: F) -> Self {
        let [x, y, z] = &matrix.0;
        Self([Self::column(x, registers), Self::column(y, registers), Self::column(z, registers)])
    }

    #[inline(always)]
    fn column(column: &SimdVec3, registers: F) -> [SimdVec3<F>; 3] {
        let SimdVec3([x, y, z, _]) = *column;
        [broadcast(x, registers), broadcast(y, registers), broadcast(z, registers)]
    }
}

impl<F: F64x4> MatrixBatch<F> {
    /// A T B.
    #[inline(always)]
    pub fn between(&self, a: &Broadcast<F>, b: &Broadcast<F>) -> Self {
        Self([self.between_column(a, &b.0[0]), self.between_column(a, &b.0[1]), self.between_column(a, &b.0[2])])
    }

    /// A T b.
    #[inline(always)]
    fn between_column(&self, a: &Broadcast<F>, b: &[SimdVec3<F>; 3]) -> [SimdVec3<F>; 3] {
        image(&a.0, &image(&self.0, b))
    }

    /// tr T.
    #[inline(always)]
    pub fn trace(&self) -> SimdVec3<F> {
        (self.0[0][0] + self.0[1][1]) + self.0[2][2]
    }

    /// X_ik T_ik + Y_ik T_ki off the diagonal, X_ii (T_ii − e) + l on it.
    #[inline(always)]
    pub fn mixed(
        &self,
        own: &Broadcast<F>,
        other: &Broadcast<F>,
        (excess, level): (&SimdVec3<F>, &SimdVec3<F>),
    ) -> Self {
        let Self([[xx, yx, zx], [xy, yy, zy], [xz, yz, zz]]) = self;
        let Broadcast([[a, b, c], [d, e, f], [g, h, i]]) = own;
        let Broadcast([[_, q, r], [s, _, u], [v, w, _]]) = other;
        let (one, two, three) = ((*xx - *excess).product(a), (*yy - *excess).product(e), (*zz - *excess).product(i));
        Self([
            [one + *level, yx.product(b) + xy.product(q), zx.product(c) + xz.product(r)],
            [xy.product(d) + yx.product(s), two + *level, zy.product(f) + yz.product(u)],
            [xz.product(g) + zx.product(v), yz.product(h) + zy.product(w), three + *level],
        ])
    }

    /// f T + l I, with a number l for each of the three.
    #[inline(always)]
    pub fn times_plus_unit(&self, factor: f64, level: &SimdVec3<F>) -> Self {
        let Self([x, y, z]) = self;
        Self([
            [x[0] * factor + *level, x[1] * factor, x[2] * factor],
            [y[0] * factor, y[1] * factor + *level, y[2] * factor],
            [z[0] * factor, z[1] * factor, z[2] * factor + *level],
        ])
    }

    /// T + a ⊗ b with one a for all three.
    #[inline(always)]
    pub fn plus_dyad(&self, a: &SimdVec3, b: &SimdMat3<F>) -> Self {
        let Self([x, y, z]) = self;
        Self([plus_column(x, a, &b.0[0]), plus_column(y, a, &b.0[1]), plus_column(z, a, &b.0[2])])
    }

    /// T + b ⊗ a with one a for all three.
    #[inline(always)]
    pub fn plus_dyad_transposed(&self, b: &SimdMat3<F>, a: &SimdVec3) -> Self {
        let (Self([x, y, z]), SimdMat3([p, q, r])) = (self, b);
        Self([plus_row(x, [p, q, r], a.0[0]), plus_row(y, [p, q, r], a.0[1]), plus_row(z, [p, q, r], a.0[2])])
    }

    /// T + diag(a) s, with a number s for each of the three.
    #[inline(always)]
    pub fn plus_diagonal(&self, a: &SimdVec3, s: &SimdVec3<F>) -> Self {
        let (Self([x, y, z]), SimdVec3([a, b, c, _])) = (self, *a);
        Self([[x[0] + *s * a, x[1], x[2]], [y[0], y[1] + *s * b, y[2]], [z[0], z[1], z[2] + *s * c]])
    }

    /// T − A with one A for all three.
    #[inline(always)]
    pub fn less(&self, Broadcast(a): &Broadcast<F>) -> Self {
        let Self([x, y, z]) = self;
        Self([less_column(x, &a[0]), less_column(y, &a[1]), less_column(z, &a[2])])
    }
}

#[inline(always)]
fn less_column<F: F64x4>(t: &[SimdVec3<F>; 3], a: &[SimdVec3<F>; 3]) -> [SimdVec3<F>; 3] {
    [t[0] - a[0], t[1] - a[1], t[2] - a[2]]
}

/// A b, number by number.
#[inline(always)]
fn image<F: F64x4>([x, y, z]: &[[SimdVec3<F>; 3]; 3], [a, b, c]: &[SimdVec3<F>; 3]) -> [SimdVec3<F>; 3] {
    [
        (x[0].product(a) + y[0].product(b)) + z[0].product(c),
        (x[1].product(a) + y[1].product(b)) + z[1].product(c),
        (x[2].product(a) + y[2].product(b)) + z[2].product(c),
    ]
}

/// a·b for one a and three b.
#[inline(always)]
pub(super) fn along<F: F64x4>([x, y, z]: &[SimdVec3<F>; 3], a: &SimdVec3) -> SimdVec3<F> {
    (*x * a.0[0] + *y * a.0[1]) + *z * a.0[2]
}

/// t + a s, with one a and three s.
#[inline(always)]
fn plus_column<F: F64x4>([x, y, z]: &[SimdVec3<F>; 3], a: &SimdVec3, s: &SimdVec3<F>) -> [SimdVec3<F>; 3] {
    [*x + *s * a.0[0], *y + *s * a.0[1], *z + *s * a.0[2]]
}

/// t + b a, with one a and three b.
#[inline(always)]
fn plus_row<F: F64x4>([x, y, z]: &[SimdVec3<F>; 3], [p, q, r]: [&SimdVec3<F>; 3], a: f64) -> [SimdVec3<F>; 3] {
    [*x + *p * a, *y + *q * a, *z + *r * a]
}
