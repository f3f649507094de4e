//! The equations of a soft box over the plane z = 0 once more, without the code of the program.
//!
//!   m v̇ = m g + Σ q k a,   P̈ J − πV P⁻ᵀ = Σ k a q ⊗ X − V τ P⁻ᵀ,   tr(P⁻¹P̈) = tr(L²) if incompressible
//!   q = α (d/d₀)^−ν n − β_d (d/d₀)^−ν_d (w·n) n − β_f (d/d₀)^−ν_f (w − (w·n) n)
//!
//! summed point by point over the six faces by Gauss's rule, uniform in the logarithm of the gap from the lowest
//! corner; k is the ratio of the areas of |Pe₁ × Pe₂| and |e₁ × e₂|, τ a Kirchhoff stress in terms of B = PPᵀ and sym
//! L, and P̈ with π is solved for by elimination. Time by Gragg's modified midpoint rule with Richardson's
//! extrapolation: see `gragg`.

#![allow(dead_code, unused_imports, reason = "each test uses a part of this")]

pub mod contracting;
mod gragg;
pub mod inclusion;

pub use gragg::integrate;

pub type Matrix = [[f64; 3]; 3];

/// How many numbers: p₀, P (rows), ṗ₀, Ṗ (rows).
pub const NUMBERS: usize = 24;
pub type Numbers = [f64; NUMBERS];

/// A system of ordinary differential equations, with the sizes by which errors are measured.
pub trait Equations<const N: usize> {
    /// None outside the model.
    fn rates(&self, y: &[f64; N]) -> Option<[f64; N]>;
    fn scale(&self, index: usize) -> f64;
}

/// Lengths of 0.1 m, P of 1, velocities of 1 m/s, Ṗ of 10 /s.
fn usual_scale(index: usize) -> f64 {
    match index {
        0..3 => 0.1,
        3..15 => 1.0,
        _ => 10.0,
    }
}

/// A factor, an integer exponent; d₀ is the same for all.
#[derive(Clone, Copy)]
pub struct Power(pub f64, pub i32);

/// What the box is made of.
#[derive(Clone, Copy)]
pub enum Stuff {
    /// τ = 2c₁B + 2c₂(tr(B)B − B²) + μ sym L, det P = 1.
    Rubber { c1: f64, c2: f64, viscosity: f64 },
    /// τ = μ(B − I) + λ ln J I + J(2η dev sym L + ζ tr(L) I).
    Foam { mu: f64, lambda: f64, shear: f64, bulk: f64 },
}

/// The box and what acts on it.
pub struct SoftBox {
    pub size: [f64; 3],
    pub density: f64,
    pub gravity: f64,
    pub stuff: Stuff,
    pub reference_gap: f64,
    pub repulsion: Power,
    pub damping: Power,
    pub friction: Power,
    /// Whether repulsion derives from ∫U k dA.
    pub potential: bool,
    /// Nodes and weights on [0, 1].
    pub rule: Vec<(f64, f64)>,
}

fn matrix(numbers: &[f64]) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| numbers[3 * i + j]))
}

fn of(entry: impl Fn(usize, usize) -> f64) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    of(|i, j| (0..3).map(|k| a[i][k] * b[k][j]).sum())
}

fn transpose(a: &Matrix) -> Matrix {
    of(|i, j| a[j][i])
}

fn trace(a: &Matrix) -> f64 {
    a[0][0] + a[1][1] + a[2][2]
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn image(a: &Matrix, x: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i][0] * x[0] + a[i][1] * x[1] + a[i][2] * x[2])
}

fn norm(a: &[f64; 3]) -> f64 {
    a.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// Nodes and weights of the rule, uniform in log(low + rise u) for u in [0, 1].
fn graded(low: f64, rise: f64, rule: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if rise < 1e-9 * low {
        return rule.to_vec();
    }
    let span = (rise / low).ln_1p();
    rule.iter().map(|(s, w)| ((s * span).exp_m1() * low / rise, w * span * (s * span).exp() * low / rise)).collect()
}

/// Solves A x = b by elimination with pivots; the last column of each row is b.
fn solve(rows: &mut [[f64; 11]; 10], count: usize) -> [f64; 10] {
    for column in 0..count {
        let largest = (column..count).max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()));
        rows.swap(column, largest.unwrap_or(column));
        let pivot = rows[column];
        for row in rows.iter_mut().take(count).skip(column + 1) {
            let factor = row[column] / pivot[column];
            (column..11).for_each(|k| row[k] -= factor * pivot[k]);
        }
    }
    let mut x = [0.0; 10];
    for row in (0..count).rev() {
        let known: f64 = (row + 1..count).map(|k| rows[row][k] * x[k]).sum();
        x[row] = (rows[row][10] - known) / rows[row][row];
    }
    x
}

impl SoftBox {
    /// f [N] and M [N m] of the plane; none where a point lies on it or behind it.
    fn contact(&self, y: &Numbers) -> Option<([f64; 3], Matrix)> {
        let (p, rate) = (matrix(&y[3..12]), matrix(&y[15..24]));
        let (mut force, mut moment) = ([0.0; 3], [[0.0; 3]; 3]);
        for face in 0..6 {
            let (axis, a, b) = (face / 2, (face / 2 + 1) % 3, (face / 2 + 2) % 3);
            let mut corner = self.size.map(|side| -0.5 * side);
            corner[axis] *= if face % 2 == 0 { 1.0 } else { -1.0 };
            let mut edges = [[0.0; 3]; 2];
            (edges[0][a], edges[1][b]) = (self.size[a], self.size[b]);
            // From the lowest corner upwards.
            for edge in &mut edges {
                if image(&p, edge)[2] < 0.0 {
                    (0..3).for_each(|k| corner[k] += edge[k]);
                    *edge = edge.map(|c| -c);
                }
            }
            let current = cross(&image(&p, &edges[0]), &image(&p, &edges[1]));
            let (area, low) = (norm(&current), y[2] + image(&p, &corner)[2]);
            if low <= 0.0 {
                return None;
            }
            let [first, second] = edges.map(|edge| image(&p, &edge)[2]);
            let mut energy = 0.0;
            for (u, along) in graded(low, first, &self.rule) {
                for (v, across) in graded(low + u * first, second, &self.rule) {
                    let weight = along * across * area;
                    let x: [f64; 3] = std::array::from_fn(|k| corner[k] + u * edges[0][k] + v * edges[1][k]);
                    let q = self.traction(y, &rate, &x, low + u * first + v * second);
                    for i in 0..3 {
                        force[i] += weight * q.0[i];
                        (0..3).for_each(|k| moment[i][k] += weight * q.0[i] * x[k]);
                    }
                    energy += weight * q.1;
                }
            }
            if self.potential {
                let normal = current.map(|c| c / area);
                let tension = of(|i, j| energy * (f64::from(u8::from(i == j)) - normal[i] * normal[j]));
                let pull = self.times_inverse_transpose(&p, &tension);
                (0..9).for_each(|k| moment[k / 3][k % 3] -= pull[k / 3][k % 3]);
            }
        }
        Some((force, moment))
    }

    /// Traction per deformed area, and U.
    fn traction(&self, y: &Numbers, rate: &Matrix, x: &[f64; 3], gap: f64) -> ([f64; 3], f64) {
        let spin = image(rate, x);
        let inverse = self.reference_gap / gap;
        let power = |Power(factor, exponent): Power| factor * inverse.powi(exponent);
        let (push, slow) = (power(self.repulsion), power(self.damping));
        let [wx, wy, wz] = [y[12] + spin[0], y[13] + spin[1], y[14] + spin[2]];
        let drag = power(self.friction);
        ([-drag * wx, -drag * wy, push - slow * wz], push * gap / (f64::from(self.repulsion.1) - 1.0))
    }

    /// A P⁻ᵀ, row by row: x Pᵀ = a.
    fn times_inverse_transpose(&self, p: &Matrix, a: &Matrix) -> Matrix {
        let columns = [cross(&p[1], &p[2]), cross(&p[2], &p[0]), cross(&p[0], &p[1])];
        let determinant: f64 = (0..3).map(|k| p[0][k] * columns[0][k]).sum();
        // The columns of P⁻¹ are the cross products of the rows of P.
        of(|i, j| (0..3).map(|k| a[i][k] * columns[k][j]).sum::<f64>() / determinant)
    }

    /// τ [Pa].
    fn kirchhoff(&self, p: &Matrix, l: &Matrix) -> Matrix {
        let b = product(p, &transpose(p));
        let one = |i: usize, j: usize| f64::from(u8::from(i == j));
        let strain = of(|i, j| 0.5 * (l[i][j] + l[j][i]));
        match self.stuff {
            Stuff::Rubber { c1, c2, viscosity } => {
                let (square, sum) = (product(&b, &b), trace(&b));
                of(|i, j| 2.0 * c1 * b[i][j] + 2.0 * c2 * (sum * b[i][j] - square[i][j]) + viscosity * strain[i][j])
            }
            Stuff::Foam { mu, lambda, shear, bulk } => {
                let volume = (0..3).map(|k| p[0][k] * cross(&p[1], &p[2])[k]).sum::<f64>();
                let growth = trace(l);
                let deviator = |i: usize, j: usize| strain[i][j] - growth / 3.0 * one(i, j);
                let friction = |i: usize, j: usize| volume * (2.0 * shear * deviator(i, j) + bulk * growth * one(i, j));
                of(|i, j| mu * (b[i][j] - one(i, j)) + lambda * volume.ln() * one(i, j) + friction(i, j))
            }
        }
    }
}

impl Equations<NUMBERS> for SoftBox {
    fn scale(&self, index: usize) -> f64 {
        usual_scale(index)
    }

    fn rates(&self, y: &Numbers) -> Option<Numbers> {
        let (p, rate) = (matrix(&y[3..12]), matrix(&y[15..24]));
        let volume: f64 = self.size.iter().product();
        let mass = self.density * volume;
        let (force, moment) = self.contact(y)?;
        let inverse = transpose(&self.times_inverse_transpose(&p, &of(|i, j| f64::from(u8::from(i == j)))));
        let l = product(&rate, &inverse);
        let stress = product(&self.kirchhoff(&p, &l), &transpose(&inverse));
        let mut rows = [[0.0; 11]; 10];
        for (place, row) in rows.iter_mut().enumerate().take(9) {
            let (i, a) = (place / 3, place % 3);
            row[place] = mass / 12.0 * self.size[a] * self.size[a];
            row[9] = -volume * inverse[a][i];
            row[10] = moment[i][a] - volume * stress[i][a];
        }
        // tr(P⁻¹P̈) = tr(L²).
        (0..9).for_each(|place| rows[9][place] = inverse[place % 3][place / 3]);
        rows[9][10] = trace(&product(&l, &l));
        let count = if matches!(self.stuff, Stuff::Rubber { .. }) { 10 } else { 9 };
        let acceleration = solve(&mut rows, count);
        let mut slopes = [0.0; NUMBERS];
        slopes[..12].copy_from_slice(&y[12..]);
        (0..3).for_each(|k| slopes[12 + k] = force[k] / mass);
        slopes[14] -= self.gravity;
        slopes[15..].copy_from_slice(&acceleration[..9]);
        Some(slopes)
    }
}

/// Gauss's rule with so many points on [0, 1], by Newton's method on Legendre's polynomial.
pub fn gauss(points: u32) -> Vec<(f64, f64)> {
    let n = f64::from(points);
    let legendre = |x: f64| {
        let (mut before, mut now) = (1.0, x);
        for k in 2..=points {
            let k = f64::from(k);
            (before, now) = (now, ((2.0 * k - 1.0) * x * now - (k - 1.0) * before) / k);
        }
        (now, n * (x * now - before) / (x * x - 1.0))
    };
    let node = |k: u32| {
        let mut x = (std::f64::consts::PI * (f64::from(k) + 0.75) / (n + 0.5)).cos();
        for _ in 0..8 {
            let (value, slope) = legendre(x);
            x -= value / slope;
        }
        let slope = legendre(x).1;
        (0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..points).map(node).collect()
}
