//! What is between two spheres, from six numbers: a block of 6×6 in (velocity | spin), or (force | torque).
//!
//!   ( A  B̃ )      A = X^A dd + Y^A (1 − dd),    B = −Y^B [d]×
//!   ( B  C )      C = X^C dd + Y^C (1 − dd),    B̃ = Y^B̃ [d]×
//!
//! d is the unit vector from the first sphere to the second, [d]× x = d × x. Source: Jeffrey and Onishi (1984) §2.

use crate::load::{Loads, Mat12, numbers, unit};
use crate::tensor::{Mat3, Vec3, axial, cross_matrix};
use nalgebra::{SMatrix, SVector};
use std::f64::consts::PI;

/// 6×6: rows and columns are translation, then rotation.
pub(in crate::fluid) type Mat6 = SMatrix<f64, 6, 6>;
/// A derivative by the place of a sphere.
pub(in crate::fluid) type Mat6x3 = SMatrix<f64, 6, 3>;
/// (force | torque), or (velocity | spin).
pub(in crate::fluid) type Vec6 = SVector<f64, 6>;

/// The numbers of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::fluid) struct Scalars {
    pub xa: f64,
    pub ya: f64,
    /// Of B.
    pub yb: f64,
    /// Of B̃.
    pub yb_back: f64,
    pub xc: f64,
    pub yc: f64,
}

/// d and r.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::fluid) struct Line {
    direction: Vec3,
    pub distance: f64,
}

impl Line {
    /// From the place of the second sphere as seen from the first \[m\].
    pub fn of(apart: &Vec3) -> Self {
        let distance = apart.norm();
        Self { direction: apart / distance, distance }
    }

    /// From a plane, along its normal.
    pub fn from_plane(normal: &Vec3, height: f64) -> Self {
        Self { direction: *normal, distance: height }
    }
}

/// A block of 6×6.
fn block(a: &Mat3, back: &Mat3, b: &Mat3, c: &Mat3) -> Mat6 {
    let mut block = Mat6::zeros();
    for (place, part) in [((0, 0), a), ((0, 3), back), ((3, 0), b), ((3, 3), c)] {
        block.fixed_view_mut::<3, 3>(place.0, place.1).copy_from(part);
    }
    block
}

impl Scalars {
    /// The block.
    pub fn block(&self, line: &Line) -> Mat6 {
        let d = &line.direction;
        let (along, turned) = (d * d.transpose(), cross_matrix(d));
        let across = Mat3::identity() - along;
        block(
            &(self.xa * along + self.ya * across),
            &(self.yb_back * turned),
            &(-self.yb * turned),
            &(self.xc * along + self.yc * across),
        )
    }

    /// Its derivatives by the place of the second sphere, axis by axis, given those of the numbers by r.
    pub fn slopes(&self, by_distance: &Self, line: &Line) -> [Mat6; 3] {
        let Line { direction: d, distance } = line;
        let grown = by_distance.block(line);
        [0, 1, 2].map(|axis| {
            let change = (Vec3::ith(axis, 1.0) - d[axis] * d) / *distance;
            let (tilt, turned) = (change * d.transpose() + d * change.transpose(), cross_matrix(&change));
            let tilted = block(
                &((self.xa - self.ya) * tilt),
                &(self.yb_back * turned),
                &(-self.yb * turned),
                &((self.xc - self.yc) * tilt),
            );
            d[axis] * grown + tilted
        })
    }

    /// What a force on the second sphere does to the first, far away: the mobility of Rotne, Prager and Yamakawa, and
    /// its derivative by r, for viscosity 1.
    ///
    ///   8πr X^A = 2 − 2(R_1² + R_2²)/3r²,   8πr Y^A = 1 + (R_1² + R_2²)/3r²,   8πr² Y^B̃ = 1,   8πr³ X^C = 1
    ///
    /// It is what two spheres do whose tractions are those of a sphere alone, so that the mobility of any number is
    /// positive definite. Source: Zuk, Wajnryb, Mizerski, Szymczak, *J. Fluid Mech.* 741 (2014) R5, eqs. (2)–(4).
    pub fn far([one, other]: [f64; 2], distance: f64) -> [Self; 2] {
        let r = distance;
        let (inverse, squares) = (1.0 / (8.0 * PI * r), (one * one + other * other) / (3.0 * r * r));
        let turned = inverse / r;
        let value = Self {
            xa: inverse * (2.0 - 2.0 * squares),
            ya: inverse * (1.0 + squares),
            yb: -turned,
            yb_back: turned,
            xc: turned / r,
            yc: -0.5 * turned / r,
        };
        let slope = Self {
            xa: -inverse / r * (2.0 - 6.0 * squares),
            ya: -inverse / r * (1.0 + 3.0 * squares),
            yb: 2.0 * turned / r,
            yb_back: -2.0 * turned / r,
            xc: -3.0 * turned / (r * r),
            yc: 1.5 * turned / (r * r),
        };
        [value, slope]
    }
}

/// The mobility of a sphere alone: 1/(6πR) and 1/(8πR³), for viscosity 1.
pub(super) fn alone(radius: f64) -> [f64; 2] {
    [1.0 / (6.0 * PI * radius), 1.0 / (8.0 * PI * radius * radius * radius)]
}

/// ω of Ṗ P⁻¹.
pub(in crate::fluid) fn spin(rate: &Mat3) -> Vec3 {
    0.5 * axial(rate)
}

/// Force and torque.
pub(in crate::fluid) fn parts(numbers: &Vec6) -> (Vec3, Vec3) {
    (numbers.fixed_rows::<3>(0).into(), numbers.fixed_rows::<3>(3).into())
}

/// A torque as the affine moment ½ [T]× P, which turns and does not strain.
pub(in crate::fluid) fn of_wrench(numbers: &Vec6, gradient: &Mat3) -> Loads {
    let (force, torque) = parts(numbers);
    Loads { force, moment: 0.5 * cross_matrix(&torque) * gradient }
}

/// How (force | torque) on one sphere change with the motion of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::fluid) struct Felt {
    /// By (velocity | spin).
    pub by_slip: Mat6,
    /// By the place, at fixed velocities.
    pub by_place: Mat6x3,
}

impl Felt {
    /// ∂Q/∂q and ∂Q/∂q̇, where `on` is P of the one that feels it, `of` are P⁻¹ and Ṗ of the other; of a sphere itself
    /// with its torque, which turns with P.
    pub fn coupling(&self, own: Option<&Vec3>, on: &Mat3, (inverse, rate): (&Mat3, &Mat3)) -> [Mat12; 2] {
        let (mut by_place, mut by_rate) = (Mat12::zeros(), Mat12::zeros());
        let turned = |spin: &Vec3| {
            let along = |row: usize| (0..3).map(|k| self.by_slip[(row, 3 + k)] * spin[k]).sum();
            numbers(&of_wrench(&Vec6::from_fn(|row, _| along(row)), on))
        };
        for k in 0..3 {
            by_rate.set_column(k, &numbers(&of_wrench(&self.by_slip.column(k).into(), on)));
            by_place.set_column(k, &numbers(&of_wrench(&self.by_place.column(k).into(), on)));
        }
        for k in 0..9 {
            let change = unit(k);
            by_rate.set_column(3 + k, &turned(&spin(&(change * inverse))));
            // δ(Ṗ P⁻¹) = −Ṗ P⁻¹ δP P⁻¹.
            let mut placed = turned(&-spin(&(rate * inverse * change * inverse)));
            if let Some(torque) = own {
                placed += numbers(&Loads { force: Vec3::zeros(), moment: 0.5 * cross_matrix(torque) * change });
            }
            by_place.set_column(3 + k, &placed);
        }
        [by_place, by_rate]
    }
}
