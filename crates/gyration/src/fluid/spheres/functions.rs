//! The resistance functions of two spheres, for all radii and distances.
//!
//!   F(y) = g₁ S₁(y) + g₂ S₂(y) + g₃ S₃(y) + Σ_k r_k y^k,    y = (R_1 + R_2)/r
//!
//!   even   S = 1/(1 − y²),   −ln(1 − y²),        −(1 − y²) ln(1 − y²)
//!   odd    S = y/(1 − y²),   ln((1 + y)/(1 − y)),   (1 − y²) ln((1 + y)/(1 − y))
//!
//! The S take along what lubrication makes singular in touch, so that r_k falls as k⁻³; the sum ends at k = 140. What
//! is left out, in parts of the resistance of the sphere alone: in touch 1e-4 up to a ratio of radii of two, 1e-3 up to
//! ten; 1e-6 from a gap of a tenth of the mean radius on, rounding from one of half. Forces of radii alone: viscosity
//! 1, A in units of length, B of its square, C of its cube. Source: Jeffrey and Onishi, *J. Fluid Mech.* 139 (1984)
//! 261, eqs. (3.17)–(3.22) and their like; Kim and Karrila, *Microhydrodynamics*, ch. 11.

use super::coefficients::{COEFFICIENTS, POWERS, Rows};
use super::tensors::Scalars;
use std::f64::consts::PI;

/// Whether a function has even powers of y, or odd ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Parity {
    Even,
    Odd,
}

/// One function of y.
#[derive(Debug, Clone, PartialEq)]
struct Series {
    parity: Parity,
    singular: [f64; 3],
    /// r_k of every second k from 0 or 1 on.
    rest: Vec<f64>,
}

/// y, with 1 − y to all its digits.
#[derive(Debug, Clone, Copy)]
struct Nearness {
    y: f64,
    /// 1 − y².
    open: f64,
    /// ln(1 − y²) and ln((1 + y)/(1 − y)).
    logarithms: [f64; 2],
}

impl Series {
    /// Of the coefficients c_k of y^k and of the singular functions.
    fn new(parity: Parity, singular: [f64; 3], coefficient: impl Fn(usize) -> f64) -> Self {
        let first = usize::from(parity == Parity::Odd);
        let rest = (first..=POWERS).step_by(2).map(|k| {
            let taken = singular_coefficients(parity, k);
            coefficient(k) - singular.iter().zip(taken).map(|(g, s)| g * s).sum::<f64>()
        });
        Self { parity, singular, rest: rest.collect() }
    }

    /// F and dF/dy.
    fn at(&self, at: &Nearness) -> [f64; 2] {
        let Nearness { y, open, logarithms: [single, double] } = *at;
        let singular = match self.parity {
            Parity::Even => [
                [1.0 / open, 2.0 * y / (open * open)],
                [-single, 2.0 * y / open],
                [-open * single, 2.0 * y * (single + 1.0)],
            ],
            Parity::Odd => [
                [y / open, (1.0 + y * y) / (open * open)],
                [double, 2.0 / open],
                [open * double, 2.0 - 2.0 * y * double],
            ],
        };
        // Horner in y².
        let square = y * y;
        let (mut sum, mut slope) = (0.0, 0.0);
        for r in self.rest.iter().rev() {
            slope = slope * square + sum;
            sum = sum * square + r;
        }
        let slope = 2.0 * y * slope;
        let mut found = match self.parity {
            Parity::Even => [sum, slope],
            Parity::Odd => [y * sum, sum + y * slope],
        };
        for (g, [value, slope]) in self.singular.iter().zip(singular) {
            // Zero times infinity, where spheres touch, counts as nothing.
            if *g != 0.0 {
                found[0] += g * value;
                found[1] += g * slope;
            }
        }
        found
    }
}

/// The coefficients of y^k in the S.
fn singular_coefficients(parity: Parity, k: usize) -> [f64; 3] {
    if k == 0 {
        return [1.0, 0.0, 0.0];
    }
    let m = k as f64;
    let third = match (parity, k) {
        (Parity::Even, 2) => 1.0,
        (Parity::Odd, 1) => 2.0,
        _ => -4.0 / (m * (m - 2.0)),
    };
    [1.0, 2.0 / m, third]
}

/// The functions of one sphere beside another: what its own motion does to it, and that of the other.
#[derive(Debug, Clone, PartialEq)]
struct OneOfTwo {
    radius: f64,
    xa: [Series; 2],
    ya: [Series; 2],
    /// Torque of a velocity: of its own (odd), of that of the other (even).
    yb: [Series; 2],
    xc: [Series; 2],
    yc: [Series; 2],
}

impl OneOfTwo {
    /// λ is the radius of the other over its own.
    fn new(radius: f64, other: f64) -> Self {
        let (l, total) = (other / radius, 1.0 + other / radius);
        let shares = [radius / (radius + other), other / (radius + other)];
        let cubed = total * total * total;
        let all = &*COEFFICIENTS;
        let powers = |rows: &Rows, k: usize, factor: f64| factor * binary(&rows[k], shares);
        let both = |singular: [f64; 3], rows: &Rows, factor: f64| {
            [Parity::Even, Parity::Odd].map(|parity| Series::new(parity, singular, |k| powers(rows, k, factor)))
        };
        let polynomial = |coefficients: &[f64]| coefficients.iter().rev().fold(0.0, |sum, c| sum * l + c);
        let along = [
            2.0 * l * l / cubed,
            0.2 * l * polynomial(&[1.0, 7.0, 1.0]) / cubed,
            polynomial(&[1.0, 18.0, -29.0, 18.0, 1.0]) / (42.0 * cubed),
        ];
        let across = [
            0.0,
            4.0 / 15.0 * l * polynomial(&[2.0, 1.0, 2.0]) / cubed,
            2.0 / 375.0 * polynomial(&[16.0, -45.0, 58.0, -45.0, 16.0]) / cubed,
        ];
        let turned = [
            0.0,
            -0.2 * l * (4.0 + l) / (total * total),
            -polynomial(&[32.0, -33.0, 83.0, 43.0]) / (250.0 * total * total),
        ];
        let spun = [0.0, 0.0, -0.25 * l * l / total];
        let turning = [0.0, 0.4 * l / total, polynomial(&[8.0, 6.0, 33.0]) / (125.0 * total)];
        let turning_other = [0.0, 0.1 * l * l / total, l * polynomial(&[43.0, -24.0, 43.0]) / (500.0 * total)];
        Self {
            radius,
            xa: both(along, &all.xa, 1.0),
            ya: both(across, &all.ya, 1.0),
            yb: both(turned, &all.yb, 2.0),
            xc: [
                Series::new(Parity::Even, spun, |k| powers(&all.xc, k, 1.0)),
                Series::new(Parity::Odd, spun, |k| powers(&all.xc, k, l)),
            ],
            yc: [
                Series::new(Parity::Even, turning, |k| powers(&all.yc, k, 1.0)),
                Series::new(Parity::Odd, turning_other, |k| powers(&all.yc, k, l)),
            ],
        }
    }
}

/// Σ_q P_q t_α^{k−q} t_β^q.
fn binary(row: &[f64], [own, other]: [f64; 2]) -> f64 {
    // The larger share is taken out of the powers, so that none of them grows.
    if own >= other {
        let ratio = other / own;
        own.powi(row.len() as i32 - 1) * row.iter().rev().fold(0.0, |sum, p| sum * ratio + p)
    } else {
        let ratio = own / other;
        other.powi(row.len() as i32 - 1) * row.iter().fold(0.0, |sum, p| sum * ratio + p)
    }
}

/// The resistance functions of two spheres.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PairFunctions {
    one: OneOfTwo,
    other: OneOfTwo,
}

/// The scalars of the blocks (1, 1), (1, 2) and (2, 2), and their derivatives by the distance.
pub(super) type PairScalars = [[Scalars; 2]; 3];

impl PairFunctions {
    /// Of two radii \[m\].
    pub fn new([one, other]: [f64; 2]) -> Self {
        Self { one: OneOfTwo::new(one, other), other: OneOfTwo::new(other, one) }
    }

    /// At a distance r of the centres, more than the sum of the radii \[m\], for viscosity 1.
    pub fn at(&self, distance: f64) -> PairScalars {
        let sum = self.one.radius + self.other.radius;
        let y = sum / distance;
        let below = (distance - sum) / distance;
        let open = below * (1.0 + y);
        let at = Nearness { y, open, logarithms: [libm::log(open), libm::log((1.0 + y) / below)] };
        let slope = -y / distance;
        let value = |series: &Series, factor: f64| {
            let [value, by_y] = series.at(&at);
            [factor * value, factor * by_y * slope]
        };
        let own = |of: &OneOfTwo, sign: f64| {
            let R { force, square, cube } = R::of(of.radius);
            let yb = value(&of.yb[1], sign * square);
            scalars([
                value(&of.xa[0], force),
                value(&of.ya[0], force),
                yb,
                yb,
                value(&of.xc[0], cube),
                value(&of.yc[0], cube),
            ])
        };
        let R { force, square, cube } = R::of(self.one.radius);
        let between = scalars([
            value(&self.one.xa[1], -force),
            value(&self.one.ya[1], -force),
            value(&self.one.yb[0], -square),
            value(&self.other.yb[0], R::of(self.other.radius).square),
            value(&self.one.xc[1], -cube),
            value(&self.one.yc[1], cube),
        ]);
        [own(&self.one, 1.0), between, own(&self.other, -1.0)]
    }
}

/// 6πR, 4πR², 8πR³.
struct R {
    force: f64,
    square: f64,
    cube: f64,
}

impl R {
    fn of(radius: f64) -> Self {
        let square = radius * radius;
        Self { force: 6.0 * PI * radius, square: 4.0 * PI * square, cube: 8.0 * PI * square * radius }
    }
}

/// Values and slopes apart.
fn scalars([xa, ya, yb, yb_back, xc, yc]: [[f64; 2]; 6]) -> [Scalars; 2] {
    [0, 1].map(|k| Scalars { xa: xa[k], ya: ya[k], yb: yb[k], yb_back: yb_back[k], xc: xc[k], yc: yc[k] })
}
