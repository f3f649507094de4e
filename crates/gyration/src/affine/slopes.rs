//! The derivative of the balance of an affine body, in closed form.
//!
//! With F = P⁻¹, G = F Fᵀ, rows of F as F_A, places (i, A) of a matrix and increments δP = e_j ⊗ e_B:
//!
//!   ∂(V S_v)/∂Ṗ = V [½a (δ_ij G_AB + F_Bi F_Aj) + c F_Ai F_Bj]
//!   ∂(V S_v)/∂P = −V [½a (L_ij G_AB + F_Bi (FL)_Aj) + c F_Ai (FL)_Bj + (τ F_B)_i F_Aj − (τ_N P⁻ᵀ)_iA F_Bj]
//!
//! a, c and the Newtonian part τ_N as in `viscosity`; the elastic part is the tangent of the material. The constraint
//! tr(P̈ F) = tr(L²) is differentiated as it stands: δP̈ = u + s Y, u = (δB + πV δ(P⁻ᵀ)) J⁻¹, and s from
//!
//!   tr(δP̈ F) = Σ 2(FL)_Bj δṖ_jB + Σ (F P̈ F − 2FLL)_Bj δP_jB

use super::constraint::Constraint;
use super::{AffineBody, Gyration};
use crate::tensor::Mat3;
use nalgebra::{SMatrix, SVector};

/// A linear map of 3×3 matrices, column by column.
pub type Mat9 = SMatrix<f64, 9, 9>;
/// A 3×3 matrix, column by column.
pub type Vec9 = SVector<f64, 9>;

/// The derivative of the balance at P, Ṗ, M.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AffineSlopes {
    /// ∂B/∂P, M and the pressure kept, with the change of the reaction πV P⁻ᵀ.
    by_gradient: Mat9,
    /// ∂B/∂Ṗ.
    by_rate: Mat9,
    inverse: Mat3,
    constraint: Option<Rows>,
}

/// The derivative of the constraint.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Rows {
    constraint: Constraint,
    /// Of tr(δP̈ F) by δP and by δṖ.
    by_gradient: Vec9,
    by_rate: Vec9,
    volume: f64,
}

impl AffineBody {
    /// The derivative of the balance; `moment` is M [N m].
    pub fn slopes(&self, at: &Gyration, moment: &Mat3) -> AffineSlopes {
        let mut by_gradient = self.material.as_ref().map_or(Mat9::zeros(), |material| material.tangent(&at.gradient));
        by_gradient *= -self.volume;
        let mut by_rate = Mat9::zeros();
        if self.dissipates() {
            self.add_friction(at, &mut by_gradient, &mut by_rate);
        }
        let mut slopes = AffineSlopes { by_gradient, by_rate, inverse: self.inverse, constraint: None };
        if self.is_incompressible() {
            slopes.constrain(self, at, moment);
        }
        slopes
    }

    /// Takes the derivatives of V S_v away.
    fn add_friction(&self, at: &Gyration, by_gradient: &mut Mat9, by_rate: &mut Mat9) {
        let (a, c) = self.viscosity.coefficients(at.volume_ratio);
        let (half, cross) = (0.5 * self.volume * a, self.volume * c);
        let f = &at.inverse;
        let l = &at.velocity_gradient;
        let (g, fl) = (f * f.transpose(), f * l);
        let turned = self.volume * self.viscosity.kirchhoff_stress(at) * f.transpose();
        let grown = self.volume * self.viscosity.newtonian_stress(at) * f.transpose();
        each_column(|column, j, b| {
            each_row(|row, i, k| {
                let delta = if i == j { g[(k, b)] } else { 0.0 };
                by_rate[(row, column)] -= half * (delta + f[(b, i)] * f[(k, j)]) + cross * f[(k, i)] * f[(b, j)];
                by_gradient[(row, column)] += half * (l[(i, j)] * g[(k, b)] + f[(b, i)] * fl[(k, j)])
                    + cross * f[(k, i)] * fl[(b, j)]
                    + turned[(i, b)] * f[(k, j)]
                    - grown[(i, k)] * f[(b, j)];
            });
        });
        if let Some(friction) = &self.anisotropic {
            friction.add_slopes(self.volume, at, by_gradient, by_rate);
        }
    }
}

impl AffineSlopes {
    /// Adds the constraint of an incompressible body.
    fn constrain(&mut self, body: &AffineBody, at: &Gyration, moment: &Mat3) {
        let balance = body.balance(at, moment);
        let constraint = Constraint::new(body, at);
        let (f, l) = (&at.inverse, &at.velocity_gradient);
        let fl = f * l;
        let by_gradient = f * (balance.acceleration * f) - 2.0 * fl * l;
        let push = balance.pressure.unwrap_or(0.0) * body.volume;
        each_column(|column, j, b| {
            // The reaction turns with P: πV δ(P⁻ᵀ) = −πV (F δP F)ᵀ.
            each_row(|row, i, k| self.by_gradient[(row, column)] -= push * f[(b, i)] * f[(k, j)]);
        });
        self.constraint = Some(Rows {
            constraint,
            // (j, B) of the transpose, column by column.
            by_gradient: Vec9::from_column_slice(by_gradient.transpose().as_slice()),
            by_rate: Vec9::from_column_slice((2.0 * fl).transpose().as_slice()),
            volume: body.volume,
        });
    }

    /// Turns the changes δM along each δP_jB, at 3B + j, into those of P̈, in place; one column of nine each.
    #[inline]
    pub fn along_gradient(&self, columns: &mut [f64]) {
        add(columns, self.by_gradient.as_slice());
        self.accelerate(columns, self.constraint.as_ref().map(|rows| rows.by_gradient.as_slice()));
    }

    /// Turns the changes δM along each δṖ_jB, at 3B + j, into those of P̈, in place.
    #[inline]
    pub fn along_rate(&self, columns: &mut [f64]) {
        add(columns, self.by_rate.as_slice());
        self.accelerate(columns, self.constraint.as_ref().map(|rows| rows.by_rate.as_slice()));
    }

    /// Turns changes δM alone into those of P̈, in place.
    pub fn along_moment(&self, columns: &mut [f64]) {
        self.accelerate(columns, None);
    }

    /// The changes of P̈ and of the pressure (0 without one) with those of P, Ṗ and M.
    pub fn apply(&self, dp: &Mat3, drate: &Mat3, dmoment: &Mat3) -> (Mat3, f64) {
        let vector = |matrix: &Mat3| Vec9::from_column_slice(matrix.as_slice());
        let (dp, drate) = (vector(dp), vector(drate));
        let change = self.by_gradient * dp + self.by_rate * drate + vector(dmoment);
        let asked = self.constraint.as_ref().map_or(0.0, |rows| rows.by_gradient.dot(&dp) + rows.by_rate.dot(&drate));
        let mut acceleration = change;
        let push = self.accelerate(acceleration.as_mut_slice(), Some(&[asked]));
        let pressure = self.constraint.as_ref().map_or(0.0, |rows| push / rows.volume);
        (Mat3::from_column_slice(acceleration.as_slice()), pressure)
    }

    /// Turns each column δB into δP̈, where tr(δP̈ F) has to be as asked (0 if nothing is said); returns the last δ(πV).
    #[inline]
    fn accelerate(&self, columns: &mut [f64], asked: Option<&[f64]>) -> f64 {
        let j: &[f64] = self.inverse.as_slice();
        let mut push = 0.0;
        for (place, column) in columns.chunks_exact_mut(9).enumerate() {
            let mut u = [0.0; 9];
            for k in 0..3 {
                for i in 0..3 {
                    // J⁻¹ is symmetric.
                    u[3 * k + i] = (column[i] * j[3 * k] + column[3 + i] * j[3 * k + 1]) + column[6 + i] * j[3 * k + 2];
                }
            }
            if let Some(rows) = &self.constraint {
                let Constraint { way, across, compliance } = &rows.constraint;
                let met = dot(&u, across);
                push = (asked.map_or(0.0, |asked| asked[place]) - met) * compliance;
                for (u, way) in u.iter_mut().zip(way) {
                    *u += push * way;
                }
            }
            column.copy_from_slice(&u);
        }
        push
    }
}

fn add(columns: &mut [f64], others: &[f64]) {
    for (entry, other) in columns.iter_mut().zip(others) {
        *entry += other;
    }
}

/// A·B of two 3×3 matrices, column by column; three partial sums, so that they can be added side by side.
#[inline]
fn dot(a: &[f64; 9], b: &Mat3) -> f64 {
    let b = b.as_slice();
    let part = |i: usize| (a[i] * b[i] + a[3 + i] * b[3 + i]) + a[6 + i] * b[6 + i];
    (part(0) + part(1)) + part(2)
}

/// Calls with the place 3B + j of a column, j and B.
#[inline(always)]
pub(super) fn each_column(mut each: impl FnMut(usize, usize, usize)) {
    for b in 0..3 {
        for j in 0..3 {
            each(3 * b + j, j, b);
        }
    }
}

/// Calls with the place 3A + i of a row, i and A.
#[inline(always)]
fn each_row(mut each: impl FnMut(usize, usize, usize)) {
    for a in 0..3 {
        for i in 0..3 {
            each(3 * a + i, i, a);
        }
    }
}
