//! A drive that answers to what the body itself feels: linear in one of its measures, without delay.
//!
//!   Q = A m + B,   m = gap, |P a| or d|P a|/dt along a material direction a, within limits if there are any
//!
//! With δP, δp₀ of the body: δgap = n·(δp₀ + δP X) at the nearest point X, δ|P a| = u·δP a, δ(u·Ṗ a) = u·δṖ a + (Ṗ a −
//! u (u·Ṗ a))·δP a/|P a|, u = P a/|P a|.

use crate::kinematics::{Placement, Velocity};
use crate::tensor::{Mat3, Vec3};

/// A part of the drive that is linear in a measure of the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feedback {
    /// What the body feels.
    pub measure: FeedbackMeasure,
    /// A, in Pa per unit of the measure.
    pub gain: Mat3,
    /// B \[Pa\].
    pub bias: Mat3,
    /// The least and the largest value that the measure counts as.
    pub limits: Option<[f64; 2]>,
}

/// What a body feels of itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FeedbackMeasure {
    /// The smallest distance to a support \[m\].
    SupportGap,
    /// The stretch |P a| along a unit vector a of the reference shape.
    Stretch(Vec3),
    /// The rate d|P a|/dt of a stretch \[1/s\].
    Rate(Vec3),
}

/// The nearest support as a body sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// The distance \[m\].
    pub gap: f64,
    /// The normal of the support.
    pub normal: Vec3,
    /// The nearest point X − X₀ \[m\].
    pub point: Vec3,
    /// Its velocity relative to the support, along the normal \[m/s\].
    pub speed: f64,
}

/// A measure and its derivatives by p₀, P and Ṗ.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Felt {
    /// m.
    pub value: f64,
    /// ∂m/∂p₀.
    pub by_position: Vec3,
    /// ∂m/∂P.
    pub by_gradient: Mat3,
    /// ∂m/∂Ṗ.
    pub by_rate: Mat3,
}

impl FeedbackMeasure {
    /// The measure in a motion; the nearest support is asked for where it counts, and none is infinitely far.
    pub fn of(&self, placement: &Placement, velocity: &Velocity, nearest: impl FnOnce() -> Option<Nearest>) -> Felt {
        match self {
            Self::SupportGap => nearest().map_or(Felt { value: f64::INFINITY, ..Felt::default() }, |nearest| Felt {
                value: nearest.gap,
                by_position: nearest.normal,
                by_gradient: nearest.normal * nearest.point.transpose(),
                by_rate: Mat3::zeros(),
            }),
            Self::Stretch(along) => {
                let (length, direction) = carried(&placement.gradient, along);
                Felt { value: length, by_gradient: direction * along.transpose(), ..Felt::default() }
            }
            Self::Rate(along) => {
                let (length, direction) = carried(&placement.gradient, along);
                let rate = velocity.gradient_rate * along;
                let value = direction.dot(&rate);
                Felt {
                    value,
                    by_position: Vec3::zeros(),
                    by_gradient: (rate - direction * value) / length * along.transpose(),
                    by_rate: direction * along.transpose(),
                }
            }
        }
    }
}

/// |P a| and P a/|P a|.
fn carried(gradient: &Mat3, along: &Vec3) -> (f64, Vec3) {
    let image = gradient * along;
    let length = image.norm();
    (length, image / length)
}

impl Feedback {
    /// Q \[Pa\] for a value of the measure, and whether it follows the measure there.
    pub fn answer(&self, value: f64) -> (Mat3, bool) {
        let [least, most] = self.limits.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let follows = value > least && value < most;
        (self.gain * value.clamp(least, most) + self.bias, follows)
    }
}
