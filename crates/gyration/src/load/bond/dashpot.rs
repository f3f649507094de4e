//! Dashpots of bonds.
//!
//!   R = ½ c |w|²,   w = Δ̇ − ω̄ × Δ,   ω̄ the mean spin of the bodies that turn
//!
//! needs no direction: where the points lie together w = Δ̇. Between two mass points, which have no spin, it is the
//! part of Δ̇ along Δ where they lie apart. Of a 6×6 matrix R = ½ żᵀ Ĉ ż. Forces are −∂R/∂(velocities); the spin of a
//! body that deforms is that of the skew part of Ṗ P⁻¹.

use super::gram::{Span, SpanSlopes};
use super::stiffness::{BondAxes, Stiffness6};
use super::{BondPlace, Loads};
use crate::load::resistance::Mat12;
use crate::load::{loads, numbers};
use crate::tensor::{Mat3, Vec3, axial, cross_matrix};
use nalgebra::SVector;
use std::sync::Arc;

type Vec12 = SVector<f64, 12>;

/// What a bond dissipates.
#[derive(Debug, Clone, PartialEq)]
pub enum Dashpot {
    /// c [N s/m].
    Vector(f64),
    /// Ĉ [N s/m, N m s] in the axes of the bond.
    Matrix(Arc<(BondAxes, Stiffness6)>),
}

/// A vector dashpot at an instant, or a change of one.
#[derive(Debug, Clone, Copy)]
struct Resisted {
    /// Δ and Δ̇.
    apart: Vec3,
    rate: Vec3,
    /// ω̄.
    spin: Vec3,
    /// w.
    slip: Vec3,
}

impl Dashpot {
    /// The loads on both bodies.
    pub(super) fn loads(&self, points: &[Vec3; 2], span: &Span, at: &BondPlace) -> [Loads; 2] {
        match self {
            Self::Vector(c) => Resisted::at(span, at).loads(*c, points, at),
            Self::Matrix(both) => {
                let (axes, matrix) = &**both;
                axes.loads(points, span, &(matrix * axes.rate(span)))
            }
        }
    }

    /// Adds the derivatives by places and by velocities.
    pub(super) fn add_slopes(
        &self,
        points: &[Vec3; 2],
        span: &Span,
        at: &BondPlace,
        (by_place, by_rate): (&mut [[Mat12; 2]; 2], &mut [[Mat12; 2]; 2]),
    ) {
        match self {
            Self::Vector(c) => {
                for end in 0..2 {
                    for k in 0..12 {
                        let changes = vector_slopes((*c, points), span, at, (end, k));
                        for (on, [placed, moved]) in changes.iter().enumerate() {
                            let mut column = by_place[on][end].column_mut(k);
                            column += placed;
                            let mut column = by_rate[on][end].column_mut(k);
                            column += moved;
                        }
                    }
                }
            }
            Self::Matrix(both) => {
                let (axes, matrix) = &**both;
                let (vectors, rates) = (span.vectors(), span.rates());
                let mut placed = SpanSlopes::zeros();
                axes.add_curvature(&(matrix * axes.rate(span)), &mut placed);
                axes.add_square(matrix, [&vectors, &rates], &mut placed);
                placed.add_to(points, by_place);
                let mut moved = SpanSlopes::zeros();
                axes.add_square(matrix, [&vectors, &vectors], &mut moved);
                moved.add_to(points, by_rate);
            }
        }
    }
}

/// How much of ω̄ is the spin of each body.
fn shares(at: &BondPlace) -> [f64; 2] {
    match at.turn {
        [true, true] => [0.5, 0.5],
        turn => turn.map(|turns| f64::from(u8::from(turns))),
    }
}

/// ω of Ṗ P⁻¹.
fn spin(rate: &Mat3) -> Vec3 {
    0.5 * axial(rate)
}

impl Resisted {
    fn at(span: &Span, at: &BondPlace) -> Self {
        let shares = shares(at);
        let spins = [0, 1].map(|end| shares[end] * spin(&(span.gradient_rates[end] * at.inverses[end])));
        let spin = spins[0] + spins[1];
        let (apart, rate) = (span.apart, span.rate);
        let mut slip = rate - spin.cross(&apart);
        if at.turn == [false, false] {
            slip = along(&apart, &slip);
        }
        Self { apart, rate, spin, slip }
    }

    fn loads(&self, c: f64, points: &[Vec3; 2], at: &BondPlace) -> [Loads; 2] {
        let force = c * self.slip;
        let torque = c * self.apart.cross(&self.slip);
        let shares = shares(at);
        let turned = |end: usize| (0.5 * shares[end]) * cross_matrix(&torque) * at.inverses[end].transpose();
        let mut on = [Loads::at_point(force, &points[0]), Loads::at_point(-force, &points[1])];
        on.iter_mut().enumerate().for_each(|(end, loads)| loads.moment += turned(end));
        on
    }
}

/// The part of a vector along another; all of it where that has no direction.
fn along(direction: &Vec3, vector: &Vec3) -> Vec3 {
    let square = direction.norm_squared();
    if square > 0.0 { (direction.dot(vector) / square) * direction } else { *vector }
}

/// The changes of the loads on both bodies with one of the twelve places of a body, and with its rate.
fn vector_slopes(
    (c, points): (f64, &[Vec3; 2]),
    span: &Span,
    at: &BondPlace,
    (end, k): (usize, usize),
) -> [[Vec12; 2]; 2] {
    let base = Resisted::at(span, at);
    let shares = shares(at);
    let Loads { force: center, moment: gradient } = loads(&Vec12::ith(k, 1.0));
    let sign = if end == 0 { -1.0 } else { 1.0 };
    let moved = sign * (center + gradient * points[end]);
    let (inverse, rate) = (at.inverses[end], span.gradient_rates[end] * at.inverses[end]);
    // δ(Ṗ P⁻¹) = δṖ P⁻¹ − Ṗ P⁻¹ δP P⁻¹.
    let by_place = (moved, Vec3::zeros(), shares[end] * spin(&-(rate * gradient * inverse)));
    let by_rate = (Vec3::zeros(), moved, shares[end] * spin(&(gradient * inverse)));
    let change = |(apart, rate, spinning): (Vec3, Vec3, Vec3), turns: bool| {
        let mut slip = rate - spinning.cross(&base.apart) - base.spin.cross(&apart);
        if at.turn == [false, false] {
            slip = along(&base.apart, &slip) + along_change(&base.apart, &base.rate, &apart);
        }
        let force = c * slip;
        let torque = c * (apart.cross(&base.slip) + base.apart.cross(&slip));
        let whole = c * base.apart.cross(&base.slip);
        [0, 1].map(|on| {
            let sign = if on == 0 { 1.0 } else { -1.0 };
            let mut loads = Loads::at_point(sign * force, &points[on]);
            let transposed = at.inverses[on].transpose();
            loads.moment += (0.5 * shares[on]) * cross_matrix(&torque) * transposed;
            if on == end && turns {
                // δ(P⁻ᵀ) = −P⁻ᵀ δPᵀ P⁻ᵀ.
                loads.moment -=
                    (0.5 * shares[on]) * cross_matrix(&whole) * transposed * gradient.transpose() * transposed;
            }
            numbers(&loads)
        })
    };
    let (placed, moving) = (change(by_place, true), change(by_rate, false));
    [0, 1].map(|on| [placed[on], moving[on]])
}

/// The change of the part of a vector along a direction, with a change of that.
fn along_change(direction: &Vec3, vector: &Vec3, change: &Vec3) -> Vec3 {
    let square = direction.norm_squared();
    if square <= 0.0 {
        return Vec3::zeros();
    }
    let share = direction.dot(vector) / square;
    let shares = (change.dot(vector) - 2.0 * share * direction.dot(change)) / square;
    shares * direction + share * change
}
