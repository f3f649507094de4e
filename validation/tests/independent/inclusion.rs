//! An ellipsoid in a viscous fluid once more, without the code of the program: neither principal axes nor integrals
//! over s.
//!
//!   N = ⟨n⊗n⟩,  𝓜 = ⟨n⊗n⊗n⊗n⟩,   n = F⁻ᵀω/|F⁻ᵀω|,  ω all over the unit sphere,  F = P A
//!   T N − 𝓜:T = η (L∞ − L + θ N),  N:T = 0,   T = σ − 2η sym L + 2ηθ I
//!
//! which is what Fourier's transform makes of the flow of a uniform stress in an ellipsoid: along each direction n of a
//! wave the stress T n is opposed by the viscosity, and incompressibility takes out n(n·Tn). An elastic particle
//! without inertia has σ = μ P Pᵀ − π I, which makes the first line nine equations for L. Drag is Carlson's: −16πη
//! U_i/(2R_F + ⅔ R_D a_i²), by his duplication.

use super::{Equations, Matrix, cross, gauss, image, matrix, of, product, solve, trace, transpose};

/// N and 𝓜; 𝓜 by the sorted indices of its entries.
pub struct Averages {
    pub second: Matrix,
    fourth: [f64; 15],
}

/// Where the entry of these indices stands among the 15 that differ.
fn place(indices: [usize; 4]) -> usize {
    // By how many of the four are 0, 1 and 2.
    let count = |axis: usize| indices.iter().filter(|index| **index == axis).count();
    let (ones, twos) = (count(1), count(2));
    let before = [0, 5, 9, 12, 14];
    before[twos] + ones
}

impl Averages {
    fn zero() -> Self {
        Self { second: [[0.0; 3]; 3], fourth: [0.0; 15] }
    }

    /// Of F, with directions ω and weights that add up to 1.
    pub fn of(carried: &Matrix, sphere: &[([f64; 3], f64)]) -> Self {
        let rows = cofactors(carried);
        let mut sum = Self::zero();
        for (direction, weight) in sphere {
            sum.add(&image(&rows, direction), *weight);
        }
        sum
    }

    /// Of an ellipsoid with its axes along those of the frame, however different they are: with the weight V/|A n|³
    /// over the directions n themselves, whose coordinates, in an octant, are divided into panels that halve towards
    /// both ends.
    pub fn of_axes(axes: [f64; 3]) -> Self {
        let panels = graded_panels(&gauss(16), 40);
        let volume: f64 = axes.iter().product();
        let mut sum = Self::zero();
        for (height, along) in &panels {
            let level = (1.0 - height * height).sqrt();
            for (turn, across) in &panels {
                let (sine, cosine) = (0.5 * std::f64::consts::PI * turn).sin_cos();
                let n = [level * cosine, level * sine, *height];
                let stretched: f64 = n.iter().zip(&axes).map(|(n, a)| (n * a).powi(2)).sum();
                sum.add(&n, along * across * volume / stretched.powf(1.5));
            }
        }
        // An octant stands for all: what is odd vanishes.
        (0..3).for_each(|i| (0..3).filter(|j| *j != i).for_each(|j| sum.second[i][j] = 0.0));
        let even = [[0, 0, 0, 0], [0, 0, 1, 1], [1, 1, 1, 1], [0, 0, 2, 2], [1, 1, 2, 2], [2, 2, 2, 2]].map(place);
        (0..15).filter(|k| !even.contains(k)).for_each(|k| sum.fourth[k] = 0.0);
        sum
    }

    fn add(&mut self, along: &[f64; 3], weight: f64) {
        let square: f64 = along.iter().map(|c| c * c).sum();
        let (second, fourth) = (weight / square, weight / (square * square));
        (0..9).for_each(|k| self.second[k / 3][k % 3] += second * along[k / 3] * along[k % 3]);
        let [x, y, z] = *along;
        let powers = |c: f64| [1.0, c, c * c, c * c * c, c * c * c * c];
        let (x, y, z) = (powers(x), powers(y), powers(z));
        let mut next = 0;
        for twos in 0..5 {
            for ones in 0..5 - twos {
                self.fourth[next] += fourth * x[4 - twos - ones] * y[ones] * z[twos];
                next += 1;
            }
        }
    }

    /// T N − 𝓜:T.
    pub fn act(&self, stress: &Matrix) -> Matrix {
        let swept = product(stress, &self.second);
        of(|i, j| {
            let double: f64 = (0..9).map(|k| self.fourth[place([i, j, k / 3, k % 3])] * stress[k / 3][k % 3]).sum();
            swept[i][j] - double
        })
    }
}

/// Nodes and weights on [0, 1], in panels that halve towards both ends so many times.
fn graded_panels(rule: &[(f64, f64)], halvings: i32) -> Vec<(f64, f64)> {
    let mut panels = Vec::new();
    for k in 1..=halvings {
        let (low, high) = (if k == halvings { 0.0 } else { 0.5_f64.powi(k + 1) }, 0.5_f64.powi(k));
        for (u, w) in rule {
            let node = low + (high - low) * u;
            panels.push((node, (high - low) * w));
            panels.push((1.0 - node, (high - low) * w));
        }
    }
    panels
}

/// Directions over the unit sphere, with weights: Gauss in the height times equal steps around; half of them stand for
/// all.
pub fn directions(parallels: u32, meridians: u32) -> Vec<([f64; 3], f64)> {
    let turn = |k: u32| (std::f64::consts::PI * f64::from(k) / f64::from(meridians)).sin_cos();
    let rule = gauss(parallels);
    let ring = |(node, weight): &(f64, f64)| {
        let (height, weight) = (2.0 * node - 1.0, weight / f64::from(meridians));
        let level = (1.0 - height * height).sqrt();
        (0..meridians).map(move |k| ([level * turn(k).1, level * turn(k).0, height], weight)).collect::<Vec<_>>()
    };
    rule.iter().flat_map(ring).collect()
}

/// The matrix of cofactors, F⁻ᵀ det F.
fn cofactors(f: &Matrix) -> Matrix {
    [cross(&f[1], &f[2]), cross(&f[2], &f[0]), cross(&f[0], &f[1])]
}

/// The matrix whose image under a linear map of matrices is `side`.
fn solved(map: impl Fn(&Matrix) -> Matrix, side: &Matrix) -> Matrix {
    let columns: [Matrix; 9] = std::array::from_fn(|k| map(&of(|i, j| f64::from(u8::from(3 * i + j == k)))));
    let mut rows = [[0.0; 11]; 10];
    for (k, row) in rows.iter_mut().enumerate().take(9) {
        row.iter_mut().zip(&columns).for_each(|(entry, column)| *entry = column[k / 3][k % 3]);
        row[10] = side[k / 3][k % 3];
    }
    let found = solve(&mut rows, 9);
    of(|i, j| found[3 * i + j])
}

fn contracted(a: &Matrix, b: &Matrix) -> f64 {
    (0..9).map(|k| a[k / 3][k % 3] * b[k / 3][k % 3]).sum()
}

/// σ of the fluid on an ellipsoid that moves with L, θ = tr L, in the flow L∞.
pub fn stress(at: &Averages, viscosity: f64, gradient: &Matrix, flow: &Matrix) -> Matrix {
    let growth = trace(gradient);
    // With N (N:T) added the equations have one solution, and its N:T vanishes.
    let map = |stress: &Matrix| {
        let (acted, along) = (at.act(stress), contracted(&at.second, stress));
        of(|i, j| acted[i][j] + along * at.second[i][j])
    };
    let extra = solved(map, &of(|i, j| viscosity * (flow[i][j] - gradient[i][j] + growth * at.second[i][j])));
    of(|i, j| {
        let straining = viscosity * (gradient[i][j] + gradient[j][i]);
        extra[i][j] + straining - if i == j { 2.0 * viscosity * growth } else { 0.0 }
    })
}

/// An incompressible neo-Hookean ellipsoid without inertia in a linear flow; its numbers are P, row by row.
pub struct Particle {
    pub axes: [f64; 3],
    pub shear: f64,
    pub viscosity: f64,
    pub flow: Matrix,
    pub sphere: Vec<([f64; 3], f64)>,
}

impl Particle {
    /// L at this P.
    pub fn gradient(&self, p: &Matrix) -> Matrix {
        let at = Averages::of(&of(|i, j| p[i][j] * self.axes[j]), &self.sphere);
        let map = |gradient: &Matrix| {
            let acted = at.act(&of(|i, j| gradient[i][j] + gradient[j][i]));
            of(|i, j| self.viscosity * (gradient[i][j] - acted[i][j]))
        };
        let elastic = product(p, &transpose(p));
        let pulled = at.act(&of(|i, j| self.shear * elastic[i][j]));
        solved(map, &of(|i, j| self.viscosity * self.flow[i][j] - pulled[i][j]))
    }
}

impl Equations<9> for Particle {
    fn rates(&self, y: &[f64; 9]) -> Option<[f64; 9]> {
        let p = matrix(y);
        let rate = product(&self.gradient(&p), &p);
        Some(std::array::from_fn(|k| rate[k / 3][k % 3]))
    }

    fn scale(&self, _: usize) -> f64 {
        1.0
    }
}

/// Carlson's R_F by duplication.
pub fn carlson_f(x: f64, y: f64, z: f64) -> f64 {
    let (mut v, mut mean) = ([x, y, z], 0.0);
    for _ in 0..60 {
        let roots = v.map(f64::sqrt);
        let lambda = roots[0] * roots[1] + roots[1] * roots[2] + roots[2] * roots[0];
        v = v.map(|v| 0.25 * (v + lambda));
        mean = (v[0] + v[1] + v[2]) / 3.0;
        if v.iter().all(|v| (v / mean - 1.0).abs() < 1e-8) {
            break;
        }
    }
    // Deviations of the second order are left.
    let d = v.map(|v| 1.0 - v / mean);
    (1.0 + (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / 20.0) / mean.sqrt()
}

/// Carlson's R_D by duplication: 3 Σ 4⁻ᵏ/(√z_k (z_k + λ_k)) + 4⁻ⁿ (mean of x, y, z, z, z)^(−3/2).
pub fn carlson_d(x: f64, y: f64, z: f64) -> f64 {
    let (mut v, mut sum, mut factor) = ([x, y, z], 0.0, 1.0);
    for _ in 0..60 {
        let roots = v.map(f64::sqrt);
        let lambda = roots[0] * roots[1] + roots[1] * roots[2] + roots[2] * roots[0];
        sum += factor / (roots[2] * (v[2] + lambda));
        factor *= 0.25;
        v = v.map(|v| 0.25 * (v + lambda));
    }
    // After sixty duplications the rest is 4⁻⁶⁰ of the first term.
    3.0 * sum + factor * v[2].powf(-1.5)
}
