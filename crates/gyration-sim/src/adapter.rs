//! Shows a model to a stepper: the only place where mechanics and integration meet.
//!
//! The errors allowed per step are scale-free. rtol is relative to what the forces depend on: lengths to the gap (or
//! the size, if that is smaller), velocities to the speed of the fastest material point, works to the energy in play.
//! atol is a fraction of the body's size, of 1 for a rotation, and of the body's own speed scale. One step may spend a
//! tenth of either.

use gyration::balance::{fastest_speed, smallest_gap};
use gyration::body::BodyKind;
use gyration::model::Model;
use gyration::rates::{Workspace, rates};
use gyration::state::{BodyMotion, State};
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3};
use gyration::{Inadmissible, jacobian};
use gyration_ode::System;
use nalgebra::DMatrix;
use std::ops::Range;

/// rtol and atol of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Relative error allowed per step.
    pub rtol: f64,
    /// Error allowed per step as a fraction of the body's scales.
    pub atol: f64,
}

/// The share of the tolerances that one step may spend. Errors of thousands of bounces add up, most of them in one
/// sense; with a tenth each, the ledger of a long run stays within a hundred times rtol.
const SHARE: f64 = 0.1;

/// A model with its scratch and scales, as a stepper sees it.
#[derive(Debug)]
pub struct ModelSystem<'a> {
    model: &'a Model,
    workspace: Workspace,
    tolerance: Tolerance,
    speeds: Vec<f64>,
    energy: f64,
    radii: Vec<f64>,
    /// The rates of the bodies at the start.
    first_rates: Vec<f64>,
}

impl<'a> ModelSystem<'a> {
    /// Prepares a model for a run that starts from `start`.
    ///
    /// # Errors
    /// [`Inadmissible`] if the start is outside the model.
    pub fn new(model: &'a Model, start: &State, tolerance: Tolerance) -> Result<Self, Inadmissible> {
        let mut workspace = Workspace::default();
        let mut slopes = vec![0.0; model.dimension()];
        let mut powers = vec![0.0; model.works().len()];
        rates(model, &mut workspace, start.time, &start.bodies, &mut slopes, &mut powers)?;
        let speeds: Vec<f64> = (0..model.bodies.len()).map(|body| speed_scale(model, start, &slopes, body)).collect();
        let energy = model.bodies.iter().zip(&speeds).map(|(b, v)| 0.5 * b.mass.mass * v * v).sum();
        // |X| is the speed of X under the unit gradient rate.
        let radius = |surface: &Surface| surface.fastest_point(&Vec3::zeros(), &Mat3::identity());
        let radii = model.bodies.iter().map(|body| body.surface.as_ref().map_or(0.0, radius)).collect();
        Ok(Self { model, workspace, tolerance, speeds, energy, radii, first_rates: slopes })
    }

    /// The model.
    pub fn model(&self) -> &'a Model {
        self.model
    }

    /// The radius of each body's surface about its centre of mass [m].
    pub fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// The rates of the bodies at the start of the run, laid out as the state.
    pub fn first_rates(&self) -> &[f64] {
        &self.first_rates
    }

    /// The scratch of the mechanics, for observations between steps.
    pub fn workspace(&mut self) -> &mut Workspace {
        &mut self.workspace
    }

    /// The speed scale of a body [m/s]: its initial speed or √(g·size), whichever is larger.
    pub fn speed_scale(&self, body: usize) -> f64 {
        self.speeds[body]
    }
}

/// A body's own speed [m/s]: initial or √(g·size); where both vanish that of its first acceleration, and one size a second
/// for a body that nothing moves.
fn speed_scale(model: &Model, start: &State, slopes: &[f64], index: usize) -> f64 {
    let body = &model.bodies[index];
    let motion = start.motion(model, index);
    let slopes = &slopes[model.blocks()[index].clone()];
    let scale = fastest_speed(body, &motion).max((model.gravity.norm() * body.size).sqrt());
    if scale > 0.0 {
        return scale;
    }
    // A body that starts at rest without gravity: the velocities' places in the rates hold the accelerations.
    let (linear, angular) = if body.pin.is_some() { (&[][..], &slopes[4..]) } else { slopes[7..].split_at(3) };
    let norm = |numbers: &[f64]| numbers.iter().map(|number| number * number).sum::<f64>().sqrt();
    let scale = ((norm(linear) + norm(angular) * body.size) * body.size).sqrt();
    if scale > 0.0 { scale } else { body.size }
}

impl System for ModelSystem<'_> {
    type Inadmissible = Inadmissible;

    fn dimension(&self) -> usize {
        self.model.dimension()
    }

    fn quadratures(&self) -> usize {
        self.model.works().len()
    }

    fn blocks(&self) -> &[Range<usize>] {
        self.model.blocks()
    }

    fn rates(&mut self, t: f64, y: &[f64], dy: &mut [f64], dw: &mut [f64]) -> Result<(), Inadmissible> {
        rates(self.model, &mut self.workspace, t, y, dy, dw)
    }

    fn jacobian(&mut self, t: f64, y: &[f64], blocks: &mut [DMatrix<f64>]) -> Result<(), Inadmissible> {
        jacobian::jacobian(self.model, &mut self.workspace, t, y, blocks)
    }

    fn error_scales(&mut self, t: f64, y: &[f64], _w: &[f64], y_scale: &mut [f64], w_scale: &mut [f64]) {
        let (rtol, atol) = (SHARE * self.tolerance.rtol, SHARE * self.tolerance.atol);
        let mut energy = self.energy;
        for (index, (body, block)) in self.model.bodies.iter().zip(self.model.blocks()).enumerate() {
            let motion = BodyMotion::unpack(body, &y[block.clone()]);
            let gap = smallest_gap(self.model, t, index, &motion).max(0.0);
            let speed = fastest_speed(body, &motion);
            energy += 0.5 * body.mass.mass * speed * speed;
            let length = atol * body.size + rtol * gap.min(body.size);
            // The rounding of the places from which the gap is computed is all that can be had.
            let rounding = 4.0 * f64::EPSILON * (motion.placement.position.norm() + body.size);
            let velocity = atol * self.speeds[index] + (rtol + 4.0 * f64::EPSILON) * speed;
            let scales = &mut y_scale[block.clone()];
            match (&body.kind, &body.pin) {
                (BodyKind::Rigid(_), None) => {
                    scales[..3].fill(length + rounding);
                    scales[3..7].fill((length + rounding) / body.size);
                    scales[7..10].fill(velocity);
                    scales[10..].fill(velocity / body.size);
                }
                (BodyKind::Rigid(_), Some(_)) => {
                    scales[..4].fill((length + rounding) / body.size);
                    scales[4..].fill(velocity / body.size);
                }
            }
        }
        w_scale.fill((atol + rtol) * energy);
    }

    fn project(&mut self, y: &mut [f64]) -> f64 {
        let mut correction: f64 = 0.0;
        for (body, block) in self.model.bodies.iter().zip(self.model.blocks()) {
            let BodyKind::Rigid(_) = body.kind;
            let at = block.start + if body.pin.is_some() { 0 } else { 3 };
            let quaternion = &mut y[at..at + 4];
            let norm = quaternion.iter().map(|c| c * c).sum::<f64>().sqrt();
            correction = correction.max((norm - 1.0).abs());
            quaternion.iter_mut().for_each(|c| *c /= norm);
        }
        correction
    }
}
