//! The one motion that a hinge or slider leaves: an angle θ or a way s, and a force along it.
//!
//!   s = a₁·(y − x),   θ = atan2(S, C),  S = c₁·b₂, C = b₁·b₂;   Q_i = F ∂x/∂q_i
//!
//! so that the power of F is F ẋ. All derivatives are exact, also where the joint is missed by the error of a step.
//! Source: `docs/theory-rigid.md`.

use super::row::{Jet, Row};
use crate::load::Mat12;
use nalgebra::SVector;

type Vec12 = SVector<f64, 12>;

/// What a hinge or slider leaves free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointCoordinate {
    /// How far the second has gone along the axis [m].
    Way(Row),
    /// How far it is turned about it [rad]: S and C.
    Angle([Row; 2]),
}

/// A coordinate, its rate, and its derivatives by q of both bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoordinateAt {
    /// x [m], or in (−π, π] [rad].
    pub value: f64,
    /// ẋ.
    pub rate: f64,
    /// ∂x/∂q_i = ∂ẋ/∂q̇_i.
    pub gradient: [Vec12; 2],
}

fn gradient(row: &Row, of: &[Jet; 2]) -> [Vec12; 2] {
    [0, 1].map(|end| Vec12::from_column_slice(row.gradient(of, end).as_slice()))
}

fn second(row: &Row, ends: [usize; 2]) -> Mat12 {
    let mut slope = Mat12::zeros();
    row.add_slope(1.0, ends, &mut slope);
    slope
}

impl JointCoordinate {
    /// At an instant.
    pub fn at(&self, of: &[Jet; 2]) -> CoordinateAt {
        match self {
            Self::Way(row) => CoordinateAt { value: row.value(of), rate: row.rate(of), gradient: gradient(row, of) },
            Self::Angle([sin, cos]) => {
                let (s, c) = (sin.value(of), cos.value(of));
                let square = s * s + c * c;
                let (by_sin, by_cos) = (c / square, -s / square);
                let (of_sin, of_cos) = (gradient(sin, of), gradient(cos, of));
                CoordinateAt {
                    value: libm::atan2(s, c),
                    rate: by_sin * sin.rate(of) + by_cos * cos.rate(of),
                    gradient: [0, 1].map(|end| by_sin * of_sin[end] + by_cos * of_cos[end]),
                }
            }
        }
    }

    /// ∂²x/∂q_i∂q_j.
    pub fn second(&self, of: &[Jet; 2], ends: [usize; 2]) -> Mat12 {
        match self {
            Self::Way(row) => second(row, ends),
            Self::Angle([sin, cos]) => {
                let (s, c) = (sin.value(of), cos.value(of));
                let square = s * s + c * c;
                let [i, j] = ends;
                let (of_sin, of_cos) = (gradient(sin, of), gradient(cos, of));
                let cross = of_sin[i] * of_cos[j].transpose() + of_cos[i] * of_sin[j].transpose();
                let own = of_cos[i] * of_cos[j].transpose() - of_sin[i] * of_sin[j].transpose();
                let curved = 2.0 * s * c * own + (s * s - c * c) * cross;
                (c * second(sin, ends) - s * second(cos, ends)) / square + curved / (square * square)
            }
        }
    }
}
