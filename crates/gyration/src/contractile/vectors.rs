//! The vectors of which the derivative of a contractile body is made: all increments are of rank one, ξ = u ⊗ w, and what
//! stands beside the tangent of the material in δ(gΣ) − X K + K X + 𝓜(δΛ) is four dyads,
//!
//!   w ⊗ (gΣ − Kᵀ)u + K C u ⊗ C⁻¹w − C u ⊗ (KᵀC⁻¹w + (μ/2) C⁻¹Λᵀw) + (K − (μ/2) Λᵀ)w ⊗ u        for δΛ = −ξ Λ,
//!
//! of which one vector depends on the row of the increment alone (`Side`) and one on its column (`Row`). For an increment of G, ξ is −e_j ⊗ w and
//! δΛ has −Λ e_j ⊗ w besides. Symbols as in `slopes`.

use crate::columns::{Column, Columns, Four};

/// The dyads of one j: w ⊗ a + b ⊗ C⁻¹w + c ⊗ w₁ + w₂ ⊗ d, and what else is needed of u.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Side {
    pub u: Column,
    /// C u.
    pub carried: Column,
    pub dyads: [Column; 4],
    /// gΣ u, Zᵀu.
    pub heavy: Column,
    pub total: Column,
}

/// What depends on B alone.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Row {
    pub w: Column,
    /// C⁻¹ w, w₁ = −(Kᵀ C⁻¹ w + (μ/2) C⁻¹ Λᵀ w), w₂ = K w − (μ/2) Λᵀ w, Λᵀ w.
    pub back: Column,
    pub first: Column,
    pub second: Column,
    pub pulled: Column,
}

/// What the sides and rows are made of.
pub(super) struct Vectors {
    /// c and μ/2.
    pub values: [f64; 3],
    pub half: f64,
    /// K, Λ, gΣ and Z.
    pub kept: Columns,
    pub pulled: Columns,
    pub mandel: Columns,
    pub total: Columns,
}

#[inline(always)]
fn times(column: &Column, [x, y, z]: [f64; 3]) -> Column {
    let Column([a, b, c, _]) = *column;
    Column([a * x, b * y, c * z, 0.0])
}

impl Vectors {
    /// For ξ = u ⊗ w, δΛ = −ξ Λ.
    #[inline(always)]
    pub fn spatial(&self, u: Column) -> Side {
        let carried = times(&u, self.values);
        let heavy = self.mandel.image(&u);
        let dyads = [heavy - self.kept.transpose().image(&u), self.kept.image(&carried), carried, u];
        Side { u, carried, dyads, heavy, total: self.total.transpose().image(&u) }
    }

    /// For γ = u ⊗ w = −ξ, δΛ = γ Λ − Λ γ.
    #[inline(always)]
    pub fn relaxed(&self, u: Column) -> Side {
        let forth = self.spatial(u);
        let seen = self.pulled.image(&u) * self.half;
        let [a, b, c, d] = forth.dyads;
        let (a, b) = (a * -1.0 - seen, b * -1.0 - times(&seen, self.values));
        Side { dyads: [a, b, c * -1.0, d * -1.0], ..forth }
    }

    #[inline(always)]
    pub fn row(&self, w: Column) -> Row {
        let inverses = self.values.map(|value| 1.0 / value);
        let (back, pulled) = (times(&w, inverses), self.pulled.transpose().image(&w));
        let first = self.kept.transpose().image(&back) + times(&pulled, inverses) * self.half;
        Row { w, back, first: first * -1.0, second: self.kept.image(&w) - pulled * self.half, pulled }
    }
}

/// a ⊗ b.
#[inline(always)]
pub(super) fn dyad<F: Four>(a: &Column, b: &Column, registers: F) -> Columns<F> {
    let (a, [x, y, z, _]) = (Column(registers.like(a.0)), b.0);
    Columns([a * x, a * y, a * z])
}
