//! Joints: exact constraints between two bodies, or a body and a place in space, which may move as prescribed.
//!
//! | kind     | equations                                                                            |
//! |----------|--------------------------------------------------------------------------------------|
//! | ball     | the points X and Y stay together (3)                                                 |
//! | hinge    | and a₁ of the first stays across b₂ and c₂ of the second (2)                         |
//! | weld     | the points stay together, and a₁·b₂ = b₁·c₂ = c₁·a₂ = 0 (3)                          |
//! | slider   | Y stays on the line through X along a₁ (2), and the three of a weld's directions     |
//! | distance | the points stay at a distance (1)                                                    |
//!
//! (a, b, c) is a frame of each body, a the axis; both are one at the angle zero. `row` has one equation and its
//! derivatives, `coordinate` and `motor` what acts along what a hinge or slider leaves free, `graph` who hangs together
//! through joints, `dynamics/joints` has the forces that keep them. A joint knows no body: its forces are G_i λ, and do
//! no work. Source: `docs/theory-rigid.md`.

mod coordinate;
mod graph;
mod motor;
mod row;

pub use coordinate::{CoordinateAt, JointCoordinate};
pub use graph::JointGraph;
pub use motor::{ANGLE_NAMES, Drive, Motor, MotorAt, MotorFault, Stop, StopLaw, WAY_NAMES};
pub use row::{Jet, Row};

use crate::load::{Anchor, Interaction, InteractionEnd, Loads, Mat12, Party};
use crate::support::SupportMotion;
use crate::tensor::{Mat3, Vec3, axial};
use gyration_expression::Scratch;
use nalgebra::{Matrix3x4, SVector};
use std::sync::Arc;

type Vec12 = SVector<f64, 12>;

/// How two parties are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// The points stay together.
    Ball,
    /// Beside that the second turns about the axis of the first only.
    Hinge,
    /// The second moves along the axis of the first only, and does not turn beside it.
    Slider,
    /// The second does not move beside the first.
    Weld,
    /// The points stay at a distance.
    Distance,
}

/// The most equations of a joint.
pub const MOST_ROWS: usize = 6;

/// A joint between two parties, of which the first is a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// What it is called.
    pub name: Arc<str>,
    /// How it joins them.
    pub kind: JointKind,
    /// X and Y, each from its centre of mass; zero of space and of a support, which are the anchor [m].
    pub points: [Vec3; 2],
    /// The place of the joint in space, where the second party is no body, and how a support carries it.
    pub anchor: Anchor,
    /// Whether the scene names them the other way round, and so is told of the force on the second.
    pub is_reversed: bool,
    /// What acts along what it leaves free.
    pub motor: Motor,
    parties: [Party; 2],
    /// What a hinge or slider leaves free.
    coordinate: Option<JointCoordinate>,
    rows: Vec<Row>,
}

/// A joint as one of its bodies sees it.
pub type JointEnd<'a> = InteractionEnd<'a, Joint>;

/// What a joint does to its parties.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointLoads {
    /// (f | M) on each of what keeps its equations.
    pub kept: [Loads; 2],
    /// λ of its equations.
    pub multipliers: [f64; MOST_ROWS],
    /// (f | M) on each of its motor.
    pub driven: [Loads; 2],
    /// F of its motor.
    pub motor: MotorAt,
}

/// The derivatives of what the motor of a joint does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotorSlopes {
    /// ∂Q_i/∂q_j, i first.
    pub by_place: [[Mat12; 2]; 2],
    /// ∂Q_i/∂q̇_j.
    pub by_rate: [[Mat12; 2]; 2],
}

impl JointLoads {
    /// (f | M) on one of the two.
    pub fn on(&self, end: usize) -> Loads {
        let mut sum = self.kept[end];
        sum += self.driven[end];
        sum
    }
}

impl Interaction for Joint {
    fn parties(&self) -> [Party; 2] {
        self.parties
    }
}

impl JointKind {
    /// The word of the scene.
    pub fn word(self) -> &'static str {
        match self {
            Self::Ball => "ball",
            Self::Hinge => "hinge",
            Self::Slider => "slider",
            Self::Weld => "weld",
            Self::Distance => "distance",
        }
    }

    /// Whether it has an axis.
    pub fn has_axis(self) -> bool {
        matches!(self, Self::Hinge | Self::Slider)
    }
}

impl Joint {
    /// A joint of these parties, in order, at these points of theirs; that of no body is its place in space.
    ///
    /// `frames` have the columns a, b, c of each; of a distance `length` [m] is what it keeps.
    pub fn new(
        (name, kind): (impl Into<Arc<str>>, JointKind),
        parties: [Party; 2],
        points: [Vec3; 2],
        frames: [Mat3; 2],
        length: f64,
    ) -> Self {
        let (points, anchor) = match parties[1].body() {
            Some(_) => (points, Anchor::at_rest(Vec3::zeros())),
            None => ([points[0], Vec3::zeros()], Anchor::at_rest(points[1])),
        };
        let [first, second] = frames.map(|frame| [0, 1, 2].map(|k| frame.column(k).into_owned()));
        let together = [Vec3::x(), Vec3::y(), Vec3::z()].map(|along| Row::meet(&points, along));
        let turned = [(0, 1), (1, 2), (2, 0)].map(|(own, other)| Row::perpendicular(&first[own], &second[other]));
        let rows = match kind {
            JointKind::Ball => together.to_vec(),
            JointKind::Hinge => {
                let about = [1, 2].map(|other| Row::perpendicular(&first[0], &second[other]));
                together.into_iter().chain(about).collect()
            }
            JointKind::Slider => {
                let across = [1, 2].map(|own| Row::across(&points, &first[own]));
                across.into_iter().chain(turned).collect()
            }
            JointKind::Weld => together.into_iter().chain(turned).collect(),
            JointKind::Distance => vec![Row::distance(&points, length)],
        };
        let axis = |own: usize, other: usize| Row::perpendicular(&first[own], &second[other]);
        let coordinate = match kind {
            JointKind::Hinge => Some(JointCoordinate::Angle([axis(2, 1), axis(1, 1)])),
            JointKind::Slider => Some(JointCoordinate::Way(Row::across(&points, &first[0]))),
            JointKind::Ball | JointKind::Weld | JointKind::Distance => None,
        };
        let motor = Motor::default();
        Self { name: name.into(), kind, points, anchor, is_reversed: false, motor, parties, coordinate, rows }
    }

    /// The same joint, which the scene names the other way round.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self { is_reversed: true, ..self }
    }

    /// The same joint to a place that moves so.
    #[must_use]
    pub fn carried(self, motion: Arc<SupportMotion>) -> Self {
        Self { anchor: Anchor { motion, ..self.anchor }, ..self }
    }

    /// The same joint to the place where it is at a time [s], held there.
    #[must_use]
    pub fn held_at(self, time: f64) -> Self {
        Self { anchor: self.anchor.held_at(time), ..self }
    }

    /// The same joint with what acts along what it leaves free.
    #[must_use]
    pub fn driven(self, motor: Motor) -> Self {
        Self { motor, ..self }
    }

    /// The same joint between parties that have other indices.
    pub(crate) fn of_parties(&self, parties: [Party; 2]) -> Self {
        Self { parties, ..self.clone() }
    }

    /// The bodies that it joins; none of one to space or a support.
    pub fn bodies(&self) -> Option<[usize; 2]> {
        let [one, other] = self.parties.map(Party::body);
        Some([one?, other?])
    }

    /// Its equations.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// q, q̇ and q̈ of space or a support as its second party at a time [s]: p₀ is the anchor, and zero.
    pub(crate) fn prescribed(&self, time: f64) -> Jet {
        let Anchor { start, motion } = &self.anchor;
        let mut jet = Jet::space();
        if !motion.is_fixed() {
            let carried = motion.carriage(time);
            let place = carried.place(start);
            let [rate, second] = carried.rotation_rates();
            let acceleration = carried.turning_acceleration_at(&place) + motion.acceleration(time);
            let columns = |jet: &mut Matrix3x4<f64>, vector: &Vec3, matrix: &Mat3| {
                jet.set_column(0, vector);
                jet.fixed_view_mut::<3, 3>(0, 1).copy_from(matrix);
            };
            columns(&mut jet.place, &Vec3::zeros(), &carried.rotation);
            columns(&mut jet.rate, &carried.velocity_at(&place), &rate);
            columns(&mut jet.acceleration, &acceleration, &second);
        }
        jet
    }

    /// The power [W] that these loads have on what moves as prescribed, of what keeps its equations and of all; none
    /// where nothing does.
    pub(crate) fn powers_on_support(&self, time: f64, loads: &JointLoads) -> Option<[f64; 2]> {
        if self.anchor.motion.is_fixed() {
            return None;
        }
        let rate = self.prescribed(time).rate;
        let (velocity, gradient_rate) = (rate.column(0).into_owned(), rate.fixed_view::<3, 3>(0, 1).into_owned());
        Some([loads.kept[1], loads.on(1)].map(|loads| loads.power(&velocity, &gradient_rate)))
    }

    /// Adds what it does with these multipliers.
    pub(crate) fn keep(&self, of: &[Jet; 2], multipliers: &[f64], loads: &mut JointLoads) {
        for (k, (row, multiplier)) in self.rows.iter().zip(multipliers).enumerate() {
            loads.multipliers[k] = *multiplier;
            for end in 0..2 {
                loads.kept[end] += packed(&(row.gradient(of, end) * *multiplier));
            }
        }
    }

    /// What its motor does.
    ///
    /// # Errors
    /// [`MotorFault`].
    pub(crate) fn drive(&self, of: &[Jet; 2], time: f64, scratch: &mut Scratch) -> Result<JointLoads, MotorFault> {
        let mut loads = JointLoads::default();
        let Some(coordinate) = self.coordinate.filter(|_| self.motor.acts()) else { return Ok(loads) };
        let at = coordinate.at(of);
        loads.motor = self.motor.at([self.told(at.value), self.told(at.rate), time], scratch)?;
        let force = self.told(loads.motor.force);
        loads.driven = at.gradient.map(|gradient| unpacked(&(gradient * force)));
        Ok(loads)
    }

    /// The derivatives of what its motor does.
    pub(crate) fn motor_slopes(&self, of: &[Jet; 2], motor: &MotorAt) -> Option<MotorSlopes> {
        let coordinate = self.coordinate.filter(|_| self.motor.acts())?;
        let at = coordinate.at(of);
        let second = [0, 1].map(|i| [0, 1].map(|j| coordinate.second(of, [i, j])));
        let rates = [0, 1].map(|end| Vec12::from_column_slice(of[end].rate.as_slice()));
        let force = self.told(motor.force);
        let by_place = |i: usize, j: usize| {
            // ∂ẋ/∂q_j.
            let swept = second[j][0] * rates[0] + second[j][1] * rates[1];
            let change = motor.by_value * at.gradient[j] + motor.by_rate * swept;
            force * second[i][j] + at.gradient[i] * change.transpose()
        };
        let by_rate = |i: usize, j: usize| motor.by_rate * at.gradient[i] * at.gradient[j].transpose();
        Some(MotorSlopes {
            by_place: [0, 1].map(|i| [0, 1].map(|j| by_place(i, j))),
            by_rate: [0, 1].map(|i| [0, 1].map(|j| by_rate(i, j))),
        })
    }

    /// A coordinate, rate or force along it as the scene has it, which may name the two the other way round.
    fn told(&self, value: f64) -> f64 {
        if self.is_reversed { -value } else { value }
    }

    /// ∂Q_i/∂q_j at fixed multipliers.
    pub(crate) fn slope(&self, loads: &JointLoads, ends: [usize; 2]) -> Mat12 {
        let mut slope = Mat12::zeros();
        for (row, multiplier) in self.rows.iter().zip(&loads.multipliers) {
            row.add_slope(*multiplier, ends, &mut slope);
        }
        slope
    }

    /// The place of the points [m], each from the same origin.
    fn places(&self, of: &[Jet; 2]) -> [Vec3; 2] {
        [0, 1].map(|end| of[end].place * row::point(&self.points[end]))
    }

    /// The angle by which the second that the scene names is turned about the axis, from where both frames are one, in
    /// (−π, π] [rad]; none of a joint that is no hinge.
    pub fn angle(&self, of: &[Jet; 2]) -> Option<f64> {
        let coordinate = self.coordinate.filter(|_| self.kind == JointKind::Hinge)?;
        Some(self.told(coordinate.at(of).value))
    }

    /// The distance of the points; of a slider, how far the second that the scene names has gone along the axis [m];
    /// none of any other.
    pub fn distance(&self, of: &[Jet; 2]) -> Option<f64> {
        match self.coordinate {
            Some(JointCoordinate::Way(row)) => Some(self.told(row.value(of))),
            Some(JointCoordinate::Angle(_)) => None,
            None if self.kind == JointKind::Distance => {
                let [one, other] = self.places(of);
                Some((other - one).norm())
            }
            None => None,
        }
    }

    /// The material point of one of its parties, the anchor of no body.
    pub fn point(&self, end: usize) -> &Vec3 {
        if self.parties[end].body().is_some() { &self.points[end] } else { &self.anchor.start }
    }

    /// Force [N] and torque about its point [N m] on one of its parties, in space.
    pub fn wrench(&self, of: &[Jet; 2], loads: &JointLoads, end: usize) -> [Vec3; 2] {
        let Loads { force, moment } = loads.on(end);
        let gradient = of[end].place.fixed_view::<3, 3>(0, 1).into_owned();
        // M Pᵀ = ∫ q ⊗ (p − p₀): its antisymmetric part is the torque about the centre.
        let about_center = axial(&(moment * gradient.transpose()));
        [force, about_center - (gradient * self.points[end]).cross(&force)]
    }
}

/// (f | M) of a vector of twelve.
fn unpacked(numbers: &Vec12) -> Loads {
    packed(&Matrix3x4::from_column_slice(numbers.as_slice()))
}

/// (f | M) of three rows and four columns.
fn packed(columns: &Matrix3x4<f64>) -> Loads {
    Loads { force: columns.column(0).into(), moment: columns.fixed_view::<3, 3>(0, 1).into() }
}

/// A frame whose first column is an axis (any length but zero): the second is across it and across the axis of space
/// least along it.
pub fn frame_about(axis: &Vec3) -> Mat3 {
    frame_beside(axis, &Vec3::ith(axis.iamin(), 1.0))
}

/// A frame whose first column is an axis (any length but zero): the second is across it and across another direction.
pub fn frame_beside(axis: &Vec3, other: &Vec3) -> Mat3 {
    let a = axis.normalize();
    let b = a.cross(other).normalize();
    Mat3::from_columns(&[a, b, a.cross(&b)])
}

/// The rotation by an angle [rad] about the first column of a frame, in its own axes.
pub fn turned_about_axis(angle: f64) -> Mat3 {
    let (sin, cos) = libm::sincos(angle);
    Mat3::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tensor::cross_matrix;

    #[test]
    fn frame_is_a_rotation_about_the_axis() {
        let frame = frame_about(&Vec3::new(0.2, -3.0, 0.5));
        assert!((frame.transpose() * frame - Mat3::identity()).norm() < 1e-15 && frame.determinant() > 0.0);
        let turned = frame * turned_about_axis(0.3) * frame.transpose();
        let axis = frame.column(0).into_owned();
        let skew = cross_matrix(&axis);
        let exact = Mat3::identity() + skew * libm::sin(0.3) + skew * skew * (1.0 - libm::cos(0.3));
        assert!((turned - exact).norm() < 1e-15);
    }
}
