//! A stepped run that is begun anew from a state that its caller gives, as if a scene started there.
//!
//! Loads and drives that are held stay, and so does what the fluid remembers. Works count from there, scales come from
//! there, and the events so far are forgotten. What bodies, guides and joints do not allow is refused: nothing is moved
//! by more than the digits of a single-precision number.

use super::recorder::Kept;
use super::{Refusal, SteppedRun, begun};
use crate::plan::RunPlan;
use crate::ports::RunError;
use crate::projection::project;
use gyration::body::BodyKind;
use gyration::dynamics::Workspace;
use gyration::kinematics::{Placement, Quaternion, Velocity};
use gyration::model::Model;
use gyration::state::{BodyMotion, RigidStart, Start, State};
use gyration::tensor::{Mat3, Vec3, axial};
use gyration_ode::ExtendedMut;

/// The largest part of a size, of a matrix, or of the fastest speed that is taken for rounding: 16 units of single
/// precision.
const ROUNDING: f64 = 1e-6;
/// The rounding of a time may be this part of the time of a scene.
const DIGITS: f64 = 1e-3;

/// A state of one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyStart {
    /// Which body.
    pub body: usize,
    /// p₀ and P.
    pub placement: Placement,
    /// ṗ₀ and Ṗ; of no consequence to a body without inertia.
    pub velocity: Velocity,
    /// G of a body that contracts, where it is not prescribed; as it is, if not given.
    pub contraction: Option<Mat3>,
}

impl SteppedRun {
    /// A run that begins at a time [s] with some bodies where they are said to be and the others where they are now.
    ///
    /// # Errors
    /// [`RunError::Start`] if that state is outside the model; within, a [`Refusal`] if there is no such body, a number
    /// is not finite, or a body cannot move like that.
    pub fn begun_anew(&self, time: f64, starts: &[BodyStart]) -> Result<Result<Self, Refusal>, RunError> {
        let state = match self.state_with(time, starts) {
            Ok(state) => state,
            Err(refusal) => return Ok(Err(refusal)),
        };
        let reaching = RunPlan { end: self.plan.end.max(time), ..self.plan };
        let (mut simulation, held) = (begun(&self.scene, &state, reaching)?, self.held());
        held.put_on(&mut simulation);
        let (scene, plan, kept) = (self.scene.clone(), self.plan, Kept::default());
        let changed = held.applied.keys().chain(held.drives.keys()).copied().collect();
        Ok(Ok(Self { simulation, scene, plan, changed, drives: held.drives, kept }))
    }

    fn state_with(&self, time: f64, starts: &[BodyStart]) -> Result<State, Refusal> {
        let (model, span) = (&self.scene, self.plan.end);
        if time.is_finite() && time.abs() * f64::EPSILON > DIGITS * span {
            return Err(Refusal::Time { time, span });
        }
        let mut state = State { time, works: vec![0.0; model.works().len()], ..self.state() };
        let mut asked: Vec<BodyMotion> = (0..model.bodies.len()).map(|body| state.motion(model, body)).collect();
        let mut contractions: Vec<Option<Mat3>> =
            (0..model.bodies.len()).map(|body| state.contraction(model, body)).collect();
        for start in starts {
            let name = self.named(start.body)?;
            if !(time.is_finite() && is_finite(start)) {
                return Err(Refusal::NotFinite { body: name });
            }
            asked[start.body] = BodyMotion { placement: start.placement, velocity: start.velocity };
            if let (Some(contraction), None) = (start.contraction, model.bodies[start.body].contraction()) {
                return Err(Refusal::Impossible { body: name, quantity: "G", off: contraction.norm() });
            }
            contractions[start.body] = start.contraction.or(contractions[start.body]);
            state.put(model, start.body, &start.of_kind(&model.bodies[start.body].kind, contractions[start.body]));
        }
        let State { bodies, low, works, .. } = &mut state;
        project(model, &mut Workspace::default(), time, ExtendedMut { high: bodies, low }, works);
        state.works.fill(0.0);
        let found = |(body, (asked, contraction)): (usize, (&BodyMotion, &Option<Mat3>))| {
            left_out(model, body, asked, &state.motion(model, body), self.simulation.speed(body)).or_else(|| {
                contraction
                    .and_then(|asked| contraction_left_out(model, body, &asked, &state.contraction(model, body)?))
            })
        };
        asked.iter().zip(&contractions).enumerate().find_map(found).map_or(Ok(state.clone()), Err)
    }
}

impl BodyStart {
    /// The numbers that a body of a kind has of it.
    fn of_kind(&self, kind: &BodyKind, contraction: Option<Mat3>) -> Start {
        let Self { placement, velocity, .. } = *self;
        match kind {
            BodyKind::Rigid(_) => {
                let orientation = Quaternion::of_rotation(&placement.gradient);
                // Ṗ = [ω]× P
                let spin = velocity.gradient_rate * orientation.rotation().transpose();
                let (position, angular_velocity) = (placement.position, 0.5 * axial(&spin));
                RigidStart { position, orientation, velocity: velocity.velocity, angular_velocity }.into()
            }
            BodyKind::Affine(_) => Start::Affine(placement, velocity),
            BodyKind::Contractile(_) => {
                Start::Contractile(placement, velocity, contraction.unwrap_or_else(Mat3::identity))
            }
        }
    }
}

fn is_finite(start: &BodyStart) -> bool {
    let BodyStart { placement, velocity, contraction, .. } = start;
    let vectors = [placement.position, velocity.velocity];
    let matrices = [placement.gradient, velocity.gradient_rate, contraction.unwrap_or_default()];
    vectors.iter().flatten().chain(matrices.iter().flatten()).all(|number| number.is_finite())
}

/// The refusal of a contraction that a body cannot have; none if it has it to rounding.
fn contraction_left_out(model: &Model, body: usize, asked: &Mat3, found: &Mat3) -> Option<Refusal> {
    let off = (asked - found).norm();
    let impossible = || Refusal::Impossible { body: model.name(body).to_owned(), quantity: "G", off };
    (off.is_nan() || off > ROUNDING * asked.norm()).then(impossible)
}

/// The refusal of a motion that a body cannot have; none if it has it to rounding.
fn left_out(model: &Model, body: usize, asked: &BodyMotion, found: &BodyMotion, speed: f64) -> Option<Refusal> {
    let about = &model.bodies[body];
    let size = about.size;
    let length = size + asked.placement.position.norm();
    let fastest = speed + asked.velocity.velocity.norm() + size * asked.velocity.gradient_rate.norm();
    let off = |asked: Vec3, found: Vec3| (asked - found).norm();
    let matrix_off = |asked: Mat3, found: Mat3| (asked - found).norm();
    let places = [
        ("position", off(asked.placement.position, found.placement.position), length),
        ("P", matrix_off(asked.placement.gradient, found.placement.gradient), asked.placement.gradient.norm()),
    ];
    let velocities = [
        ("velocity", off(asked.velocity.velocity, found.velocity.velocity), fastest),
        ("Pdot", matrix_off(asked.velocity.gradient_rate, found.velocity.gradient_rate), fastest / size),
    ];
    // The velocities of a body without inertia are none of its state.
    let velocities = velocities.into_iter().filter(|_| about.has_inertia());
    let beyond = |(_, off, scale): &(&str, f64, f64)| off.is_nan() || *off > ROUNDING * scale;
    let (quantity, off, _) = places.into_iter().chain(velocities).find(beyond)?;
    Some(Refusal::Impossible { body: model.name(body).to_owned(), quantity, off })
}
