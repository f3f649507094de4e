//! Joints: exact constraints between two bodies, or a body and space.
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
//! derivatives, `graph` who hangs together through joints, `dynamics/joints` has the forces that keep them. A joint
//! knows no body: its forces are G_i λ, and do no work. Source: `docs/theory-rigid.md`.

mod graph;
mod row;

pub use graph::JointGraph;
pub use row::{Jet, Row};

use crate::load::{Interaction, InteractionEnd, Loads, Mat12, Party};
use crate::tensor::{Mat3, Vec3, axial};
use nalgebra::Matrix3x4;
use std::sync::Arc;

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
    /// X and Y, each from its centre of mass; of space zero, which is the anchor [m].
    pub points: [Vec3; 2],
    /// The place of the joint in space, where the second party is space [m].
    pub anchor: Vec3,
    /// Whether the scene names them the other way round, and so is told of the force on the second.
    pub is_reversed: bool,
    parties: [Party; 2],
    frames: [Mat3; 2],
    rows: Vec<Row>,
}

/// A joint as one of its bodies sees it.
pub type JointEnd<'a> = InteractionEnd<'a, Joint>;

/// What a joint does to its parties.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointLoads {
    /// (f | M) on each.
    pub on: [Loads; 2],
    /// λ of its equations.
    pub multipliers: [f64; MOST_ROWS],
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
    /// A joint of these parties, in order, at these points of theirs; that of space is its place.
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
            Some(_) => (points, Vec3::zeros()),
            None => ([points[0], Vec3::zeros()], points[1]),
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
        Self { name: name.into(), kind, points, anchor, is_reversed: false, parties, frames, rows }
    }

    /// The same joint, which the scene names the other way round.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self { is_reversed: true, ..self }
    }

    /// The same joint between parties that have other indices.
    pub(crate) fn of_parties(&self, parties: [Party; 2]) -> Self {
        Self { parties, ..self.clone() }
    }

    /// The bodies that it joins; none of one to space.
    pub fn bodies(&self) -> Option<[usize; 2]> {
        let [one, other] = self.parties.map(Party::body);
        Some([one?, other?])
    }

    /// Its equations.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// What it does with these multipliers.
    pub(crate) fn loads(&self, of: &[Jet; 2], multipliers: &[f64]) -> JointLoads {
        let mut kept = JointLoads::default();
        for (k, (row, multiplier)) in self.rows.iter().zip(multipliers).enumerate() {
            kept.multipliers[k] = *multiplier;
            for end in 0..2 {
                kept.on[end] += packed(&(row.gradient(of, end) * *multiplier));
            }
        }
        kept
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

    /// The angle by which the second is turned about the axis, from where both frames are one, in (−π, π] [rad]; none
    /// of a joint that is no hinge.
    pub fn angle(&self, of: &[Jet; 2]) -> Option<f64> {
        if self.kind != JointKind::Hinge {
            return None;
        }
        let axis = |end: usize, k: usize| of[end].place * row::direction(&self.frames[end].column(k).into_owned());
        let (n, first, second) = (axis(0, 0).normalize(), axis(0, 1), axis(1, 1));
        let across = |vector: Vec3| vector - n * n.dot(&vector);
        let (first, second) = (across(first), across(second));
        Some(libm::atan2(n.dot(&first.cross(&second)), first.dot(&second)))
    }

    /// The distance of the points; of a slider, how far the second has gone along the axis [m]; none of any other.
    pub fn distance(&self, of: &[Jet; 2]) -> Option<f64> {
        let [one, other] = self.places(of);
        match self.kind {
            JointKind::Distance => Some((other - one).norm()),
            JointKind::Slider => {
                let axis = of[0].place * row::direction(&self.frames[0].column(0).into_owned());
                Some((other - one).dot(&axis.normalize()))
            }
            JointKind::Ball | JointKind::Hinge | JointKind::Weld => None,
        }
    }

    /// The material point of one of its parties, the anchor of space.
    pub fn point(&self, end: usize) -> &Vec3 {
        if self.parties[end].body().is_some() { &self.points[end] } else { &self.anchor }
    }

    /// Force [N] and torque about its point [N m] on one of its parties, in space.
    pub fn wrench(&self, of: &[Jet; 2], loads: &JointLoads, end: usize) -> [Vec3; 2] {
        let Loads { force, moment } = loads.on[end];
        let gradient = of[end].place.fixed_view::<3, 3>(0, 1).into_owned();
        // M Pᵀ = ∫ q ⊗ (p − p₀): its antisymmetric part is the torque about the centre.
        let about_center = axial(&(moment * gradient.transpose()));
        [force, about_center - (gradient * self.points[end]).cross(&force)]
    }
}

/// (f | M) of three rows and four columns.
fn packed(columns: &Matrix3x4<f64>) -> Loads {
    Loads { force: columns.column(0).into(), moment: columns.fixed_view::<3, 3>(0, 1).into() }
}

/// A frame whose first column is an axis (any length but zero): the second is across it and across the axis of space
/// least along it.
pub fn frame_about(axis: &Vec3) -> Mat3 {
    let a = axis.normalize();
    let b = a.cross(&Vec3::ith(a.iamin(), 1.0)).normalize();
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
