//! What is kept of the way a body stands and moves: face, tilt, turns, distance.
//!
//! Upright is against gravity, or z where there is none.

use super::layout::ColumnPlaces;
use crate::value::Value;
use gyration::model::Model;
use gyration::tensor::{Mat3, Polar, Vec3};
use nalgebra::{Rotation3, UnitQuaternion};
use std::f64::consts::{PI, TAU};

/// The material axes, by name.
const FACES: [[&str; 2]; 3] = [["+x", "-x"], ["+y", "-y"], ["+z", "-z"]];

fn up(model: &Model) -> Vec3 {
    (-model.gravity).try_normalize(0.0).unwrap_or_else(Vec3::z)
}

/// Where P and p₀ of a body stand in a row.
#[derive(Clone, Copy)]
struct MotionPlaces {
    position: usize,
    gradient: usize,
}

impl MotionPlaces {
    fn new(layout: &ColumnPlaces, body: usize) -> Self {
        Self { position: layout.position + 3 * body, gradient: layout.gradient + 9 * body }
    }

    fn position(self, row: &[f64]) -> Vec3 {
        Vec3::from_column_slice(&row[self.position..self.position + 3])
    }

    fn gradient(self, row: &[f64]) -> Mat3 {
        Mat3::from_row_slice(&row[self.gradient..self.gradient + 9])
    }
}

/// The material axis whose face looks most nearly straight down: the normal of a face is along P⁻ᵀ e.
pub(super) struct LowestFace {
    motion: MotionPlaces,
    up: Vec3,
    at_start: bool,
    gradient: Option<Mat3>,
}

impl LowestFace {
    pub fn new(model: &Model, layout: &ColumnPlaces, body: usize, at_start: bool) -> Self {
        Self { motion: MotionPlaces::new(layout, body), up: up(model), at_start, gradient: None }
    }

    pub fn row(&mut self, row: &[f64]) {
        if self.gradient.is_none() || !self.at_start {
            self.gradient = Some(self.motion.gradient(row));
        }
    }

    pub fn value(&self) -> Value {
        let Some(normals) = self.gradient.and_then(|p| p.try_inverse()).map(|inverse| inverse.transpose()) else {
            return Value::Null;
        };
        let down = Vec3::from_fn(|axis, _| -self.up.dot(&normals.column(axis).normalize()));
        let axis = down.iamax();
        Value::Text(FACES[axis][usize::from(down[axis] < 0.0)].to_owned())
    }
}

/// The largest angle between the vertical and the material line that was upright at the start [rad].
pub(super) struct Tilt {
    motion: MotionPlaces,
    up: Vec3,
    /// P⁻¹ up at the start.
    line: Option<Vec3>,
    largest: f64,
}

impl Tilt {
    pub fn new(model: &Model, layout: &ColumnPlaces, body: usize) -> Self {
        Self { motion: MotionPlaces::new(layout, body), up: up(model), line: None, largest: 0.0 }
    }

    pub fn row(&mut self, row: &[f64]) {
        let gradient = self.motion.gradient(row);
        let up = self.up;
        let line = *self.line.get_or_insert_with(|| gradient.try_inverse().map_or(up, |inverse| inverse * up));
        let now = gradient * line;
        // Exact for small angles too, where the cosine says nothing.
        self.largest = self.largest.max(libm::atan2(now.cross(&up).norm(), now.dot(&up)));
    }

    pub fn value(&self) -> Value {
        if self.line.is_some() { Value::Number(self.largest) } else { Value::Null }
    }
}

/// The winding of an angle about an axis, from row to row by the shorter way.
///
///   matter: the twist 2 atan2(q·a, w) of the quaternion (w, q) of R, P = R U, modulo 2π
///   form: ½ atan2(2 B₁₂, B₁₁ − B₂₂), B = P J Pᵀ in the plane normal to a, modulo π
pub(super) struct Turns {
    motion: MotionPlaces,
    axis: Vec3,
    /// J and two directions of the plane, if the form is looked at.
    form: Option<(Mat3, [Vec3; 2])>,
    last: Option<f64>,
    /// The angle since the start [rad].
    wound: f64,
}

impl Turns {
    pub fn new(model: &Model, layout: &ColumnPlaces, body: usize, axis: Vec3, of_form: bool) -> Self {
        let across = axis.cross(&Vec3::ith(axis.iamin(), 1.0)).normalize();
        let form = of_form.then(|| (model.bodies[body].solid.mass.euler_tensor, [across, axis.cross(&across)]));
        Self { motion: MotionPlaces::new(layout, body), axis, form, last: None, wound: 0.0 }
    }

    pub fn row(&mut self, row: &[f64]) {
        let gradient = self.motion.gradient(row);
        let (angle, period) = match &self.form {
            Some((euler_tensor, [one, two])) => {
                let form = gradient * euler_tensor * gradient.transpose();
                let entry = |a: &Vec3, b: &Vec3| a.dot(&(form * b));
                (0.5 * libm::atan2(2.0 * entry(one, two), entry(one, one) - entry(two, two)), PI)
            }
            None => (twist(&Polar::of(&gradient).rotation, &self.axis), TAU),
        };
        if let Some(last) = self.last {
            let difference = angle - last;
            self.wound += difference - period * (difference / period).round();
        }
        self.last = Some(angle);
    }

    pub fn value(&self) -> Value {
        if self.last.is_some() { Value::Number(self.wound / TAU) } else { Value::Null }
    }
}

/// The angle by which a rotation turns about an axis, the rest of it being a swing of that axis [rad].
fn twist(rotation: &Mat3, axis: &Vec3) -> f64 {
    let quaternion = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation));
    2.0 * libm::atan2(quaternion.imag().dot(axis), quaternion.w)
}

/// The level distance of the centre of mass from its start [m].
pub(super) struct Distance {
    motion: MotionPlaces,
    up: Vec3,
    along: Option<Vec3>,
    per: Option<f64>,
    start: Option<(f64, Vec3)>,
    end: (f64, Vec3),
}

impl Distance {
    pub fn new(model: &Model, layout: &ColumnPlaces, body: usize, along: Option<Vec3>, per: Option<f64>) -> Self {
        Self {
            motion: MotionPlaces::new(layout, body),
            up: up(model),
            along,
            per,
            start: None,
            end: (0.0, Vec3::zeros()),
        }
    }

    pub fn row(&mut self, time: f64, row: &[f64]) {
        self.end = (time, self.motion.position(row));
        self.start.get_or_insert(self.end);
    }

    pub fn value(&self) -> Value {
        let Some((began, start)) = self.start else { return Value::Null };
        let (ended, end) = self.end;
        let moved = end - start;
        let distance = match self.along {
            Some(along) => moved.dot(&along),
            None => (moved - self.up * self.up.dot(&moved)).norm(),
        };
        let share = match self.per {
            Some(per) if ended > began => per / (ended - began),
            _ => 1.0,
        };
        Value::Number(distance * share)
    }
}
