//! The resistance of an ellipsoid by closed forms, in its axes and about its centre, for a fluid of viscosity one.
//!
//!   translation along i:  16π/(χ₀ + α_i a_i²)
//!   gradient L:  N = V (T + 2E − 2qI),   L − q diag(L_i) = −G:T,   G_ijkl = L_j δ_ik δ_jl − ⟨x_i x_j x_k x_l⟩,   Σ L_i T_ii = 0
//!
//! with α_i = ∫ds/((a_i² + s)Δ), χ₀ = ∫ds/Δ, Δ² = ∏(a_i² + s), L_i = (a₁a₂a₃/2) α_i and ⟨x_i²x_j²⟩ = (a₁a₂a₃/4) ∫ s
//! ds/((a_i² + s)(a_j² + s)Δ). The integrals by the trapezoid rule in ln s, which converges exponentially. Source:
//! Jeffery (1922); `docs/theory-fluid.md`.

#![allow(
    dead_code,
    clippy::expect_used,
    reason = "each test takes what it needs; a reference that fails is a failed test"
)]

use nalgebra::{Matrix3, SMatrix, Vector4};
use std::f64::consts::PI;

pub type Mat12 = SMatrix<f64, 12, 12>;

/// ∫₀^∞ f(s) ds/Δ; poles of f at s = −a_i² bound the error by exp(−2π²/h).
fn integral(axes: [f64; 3], f: impl Fn(f64) -> f64) -> f64 {
    const STEP: f64 = 0.25;
    let scale = axes.iter().product::<f64>().cbrt().powi(2);
    let term = |k: i32| {
        let s = scale * (STEP * f64::from(k)).exp();
        s * f(s) / axes.map(|a| a * a + s).iter().product::<f64>().sqrt()
    };
    STEP * (-400..400).map(term).sum::<f64>()
}

struct Ellipsoid {
    axes: [f64; 3],
    /// L_i.
    depolarization: [f64; 3],
    /// ⟨x_i²x_j²⟩.
    fourth: Matrix3<f64>,
}

impl Ellipsoid {
    fn new(axes: [f64; 3]) -> Self {
        let product: f64 = axes.iter().product();
        let depolarization = axes.map(|a| 0.5 * product * integral(axes, |s| 1.0 / (a * a + s)));
        let mixed = |i: usize, j: usize| {
            0.25 * product * integral(axes, |s| s / ((axes[i] * axes[i] + s) * (axes[j] * axes[j] + s)))
        };
        let mut fourth = Matrix3::from_fn(|i, j| if i == j { 0.0 } else { mixed(i, j) });
        for i in 0..3 {
            fourth[(i, i)] = depolarization[i] - fourth.row(i).sum();
        }
        Self { axes, depolarization, fourth }
    }

    /// T of a velocity gradient, without pressure at infinity.
    fn eigenstress(&self, gradient: &Matrix3<f64>) -> Matrix3<f64> {
        let (l, m) = (&self.depolarization, &self.fourth);
        let mut stress = Matrix3::zeros();
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            // (L_j − m) T_ij − m T_ji = −L_ij and the same with i and j exchanged.
            let (p, q, m) = (l[j] - m[(i, j)], l[i] - m[(i, j)], m[(i, j)]);
            let determinant = p * q - m * m;
            stress[(i, j)] = -(q * gradient[(i, j)] + m * gradient[(j, i)]) / determinant;
            stress[(j, i)] = -(p * gradient[(j, i)] + m * gradient[(i, j)]) / determinant;
        }
        // Diagonal: singular for T = I, bordered by the pressure condition.
        let mut system = nalgebra::Matrix4::zeros();
        let mut side = Vector4::zeros();
        for i in 0..3 {
            (0..3).for_each(|k| system[(i, k)] = -m[(i, k)]);
            system[(i, i)] += l[i];
            system[(3, i)] = l[i];
            system[(i, 3)] = 1.0;
            side[i] = -(gradient[(i, i)] - gradient.trace() * l[i]);
        }
        let solved = system.lu().solve(&side).expect("the bordered system is regular");
        (0..3).for_each(|i| stress[(i, i)] = solved[i]);
        stress
    }
}

/// H of (f; N row by row) = −H (U; L row by row).
pub fn ellipsoid(axes: [f64; 3]) -> Mat12 {
    let ellipsoid = Ellipsoid::new(axes);
    let chi = integral(axes, |_| 1.0);
    let product: f64 = axes.iter().product();
    let volume = 4.0 / 3.0 * PI * product;
    let mut h = Mat12::zeros();
    for i in 0..3 {
        let alpha = 2.0 * ellipsoid.depolarization[i] / product;
        h[(i, i)] = 16.0 * PI / (chi + alpha * ellipsoid.axes[i].powi(2));
    }
    for column in 0..9 {
        let mut gradient = Matrix3::zeros();
        gradient[(column / 3, column % 3)] = 1.0;
        let stress = ellipsoid.eigenstress(&gradient) + gradient + gradient.transpose()
            - 2.0 * gradient.trace() * Matrix3::identity();
        (0..9).for_each(|row| h[(3 + row, 3 + column)] = -volume * stress[(row / 3, row % 3)]);
    }
    h
}

/// The matrix of plain numbers.
pub fn matrix(rows: &[[f64; 12]; 12]) -> Mat12 {
    Mat12::from_fn(|i, j| rows[i][j])
}

/// max over x of |x·(A − H)x| / x·H x.
pub fn largest_error(measured: &Mat12, exact: &Mat12) -> f64 {
    let lower = exact.cholesky().expect("a resistance is positive definite").l();
    let half = lower.solve_lower_triangular(&(measured - exact)).expect("regular");
    let whole = lower.solve_lower_triangular(&half.transpose()).expect("regular");
    (0.5 * (whole + whole.transpose())).symmetric_eigenvalues().amax()
}
