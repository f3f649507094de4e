//! The box that contracts, once more: P = F G, with the law of contraction as ten linear equations in V_G and π.
//!
//!   μ_γ V + μ Fᵀ sym(F V F⁻¹) F⁻ᵀ + π I = g Fᵀ φ_F − g φ I + Q + μ Fᵀ sym L F⁻ᵀ,   tr V = tr L
//!   P̈ J = M − V (g φ_F Fᵀ + μ sym(L − F V F⁻¹) − π I) P⁻ᵀ,   Ġ = V G
//!
//! The operator on the left is found by applying it to nine matrices with a single one. The time is a number of the
//! state.

use super::{
    Equations, Matrix, NUMBERS, Numbers, SoftBox, Stuff, matrix, of, product, solve, trace, transpose, usual_scale,
};

/// p₀, P, ṗ₀, Ṗ, G (rows), t.
pub const MORE: usize = NUMBERS + 10;

/// The box, and what makes it contract.
pub struct ContractingBox {
    /// Its stuff is rubber.
    pub soft: SoftBox,
    /// μ_γ [Pa s].
    pub drag: f64,
    /// Q is this times sin(2πft) [Pa].
    pub amplitude: Matrix,
    /// f [Hz].
    pub frequency: f64,
}

fn inverse(a: &Matrix) -> Matrix {
    let minor = |i: usize, j: usize| {
        let ([r, s], [c, d]) = ([(i + 1) % 3, (i + 2) % 3], [(j + 1) % 3, (j + 2) % 3]);
        a[r][c] * a[s][d] - a[r][d] * a[s][c]
    };
    let determinant = determinant(a);
    of(|i, j| minor(j, i) / determinant)
}

fn determinant(a: &Matrix) -> f64 {
    (0..3).map(|k| a[0][k] * (a[1][(k + 1) % 3] * a[2][(k + 2) % 3] - a[1][(k + 2) % 3] * a[2][(k + 1) % 3])).sum()
}

fn symmetric(a: &Matrix) -> Matrix {
    of(|i, j| 0.5 * (a[i][j] + a[j][i]))
}

fn sandwich(a: &Matrix, b: &Matrix, c: &Matrix) -> Matrix {
    product(&product(a, b), c)
}

impl Equations<MORE> for ContractingBox {
    fn scale(&self, index: usize) -> f64 {
        if index < NUMBERS { usual_scale(index) } else { 1.0 }
    }

    fn rates(&self, y: &[f64; MORE]) -> Option<[f64; MORE]> {
        let Stuff::Rubber { c1, c2, viscosity } = self.soft.stuff else { return None };
        let placed: Numbers = std::array::from_fn(|k| y[k]);
        let (force, moment) = self.soft.contact(&placed)?;
        let (p, rate, g) = (matrix(&y[3..12]), matrix(&y[15..24]), matrix(&y[24..33]));
        let ratio = determinant(&g);
        if ratio <= 0.0 {
            return None;
        }
        let f = product(&p, &inverse(&g));
        let (back, turned) = (inverse(&f), transpose(&f));
        let across = transpose(&back);
        let l = product(&rate, &inverse(&p));
        let one = |i: usize, j: usize| f64::from(u8::from(i == j));

        // φ and φ_F Fᵀ; Fᵀ φ_F is Fᵀ (φ_F Fᵀ) F⁻ᵀ.
        let b = product(&f, &turned);
        let (square, sum) = (product(&b, &b), trace(&b));
        let energy = c1 * (sum - 3.0) + c2 * (0.5 * (sum * sum - trace(&square)) - 3.0);
        let elastic = of(|i, j| ratio * (2.0 * c1 * b[i][j] + 2.0 * c2 * (sum * b[i][j] - square[i][j])));

        let angle = std::f64::consts::TAU * self.frequency * y[MORE - 1];
        let loaded = of(|i, j| elastic[i][j] + viscosity * symmetric(&l)[i][j]);
        let right = sandwich(&turned, &loaded, &across);
        let mut rows = [[0.0; 11]; 10];
        for k in 0..9 {
            let unit = of(|i, j| one(3 * i + j, k));
            let drawn = sandwich(&turned, &symmetric(&sandwich(&f, &unit, &back)), &across);
            for (place, row) in rows.iter_mut().enumerate().take(9) {
                row[k] = self.drag * one(place, k) + viscosity * drawn[place / 3][place % 3];
            }
        }
        for (place, row) in rows.iter_mut().enumerate().take(9) {
            let (i, j) = (place / 3, place % 3);
            row[9] = one(i, j);
            row[10] = right[i][j] - ratio * energy * one(i, j) + self.amplitude[i][j] * angle.sin();
        }
        (0..3).for_each(|k| rows[9][4 * k] = 1.0);
        rows[9][10] = trace(&l);
        let solved = solve(&mut rows, 10);
        let (velocity, pressure) = (matrix(&solved[..9]), solved[9]);

        let drawn = sandwich(&f, &velocity, &back);
        let straining = symmetric(&of(|i, j| l[i][j] - drawn[i][j]));
        let kirchhoff = of(|i, j| elastic[i][j] + viscosity * straining[i][j] - pressure * one(i, j));
        let stress = product(&kirchhoff, &transpose(&inverse(&p)));
        let volume: f64 = self.soft.size.iter().product();
        let mass = self.soft.density * volume;
        let growth = product(&velocity, &g);
        let mut slopes = [0.0; MORE];
        slopes[..12].copy_from_slice(&y[12..24]);
        (0..3).for_each(|k| slopes[12 + k] = force[k] / mass);
        slopes[14] -= self.soft.gravity;
        for place in 0..9 {
            let (i, a) = (place / 3, place % 3);
            let inertia = mass / 12.0 * self.soft.size[a] * self.soft.size[a];
            slopes[15 + place] = (moment[i][a] - volume * stress[i][a]) / inertia;
            slopes[24 + place] = growth[i][a];
        }
        slopes[MORE - 1] = 1.0;
        Some(slopes)
    }
}
