//! The state: time, the numbers of every body, and the works done so far. Minimal: the rest follows from the model.

use crate::body::{Body, BodyKind};
use crate::kinematics::{Placement, Quaternion, Velocity, rigid_gradient_rate};
use crate::model::Model;
use crate::tensor::Vec3;

/// Time, configuration and velocities, and the work integrals of the ledger.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// t [s].
    pub time: f64,
    /// The numbers of the bodies, block by block (`Model::blocks`).
    pub bodies: Vec<f64>,
    /// The works since t = 0 [J], in the order of `Model::works`.
    pub works: Vec<f64>,
}

/// How a body starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidStart {
    /// p₀ of the centre of mass [m].
    pub position: Vec3,
    /// Rotation.
    pub orientation: Quaternion,
    /// ṗ₀ of the centre of mass [m/s]; a pinned body's follows from its spin.
    pub velocity: Vec3,
    /// ω in spatial axes [rad/s].
    pub angular_velocity: Vec3,
}

/// The motion of one body, unpacked from its block of the state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMotion {
    /// p₀ and P.
    pub placement: Placement,
    /// ṗ₀ and Ṗ.
    pub velocity: Velocity,
    /// The quaternion as it stands, not normalised.
    pub quaternion: Quaternion,
    /// Ω, angular velocity in body axes [rad/s].
    pub spin: Vec3,
}

impl State {
    /// The state at t = 0 from the start of each body, in order.
    pub fn start(model: &Model, starts: &[RigidStart]) -> Self {
        let mut bodies = Vec::with_capacity(model.dimension());
        for (body, start) in model.bodies.iter().zip(starts) {
            let quaternion = start.orientation.normalized();
            let spin = quaternion.rotation().tr_mul(&start.angular_velocity);
            if body.pin.is_none() {
                bodies.extend(start.position.iter());
            }
            bodies.extend(quaternion.0);
            if body.pin.is_none() {
                bodies.extend(start.velocity.iter());
            }
            bodies.extend(spin.iter());
        }
        Self { time: 0.0, bodies, works: vec![0.0; model.works().len()] }
    }

    /// The motion of one body.
    pub fn motion(&self, model: &Model, body: usize) -> BodyMotion {
        BodyMotion::unpack(&model.bodies[body], &self.bodies[model.blocks()[body].clone()])
    }
}

fn vector(numbers: &[f64]) -> Vec3 {
    Vec3::new(numbers[0], numbers[1], numbers[2])
}

impl BodyMotion {
    /// Reads a body's block of the state.
    pub fn unpack(body: &Body, block: &[f64]) -> Self {
        match body.kind {
            BodyKind::Rigid(_) => Self::unpack_rigid(body, block),
        }
    }

    fn unpack_rigid(body: &Body, block: &[f64]) -> Self {
        let free = body.pin.is_none();
        let at = if free { 3 } else { 0 };
        let quaternion = Quaternion([block[at], block[at + 1], block[at + 2], block[at + 3]]);
        let rotation = quaternion.rotation();
        let spin = vector(&block[if free { 10 } else { 4 }..]);
        let gradient_rate = rigid_gradient_rate(&rotation, &spin);
        // A pinned body's centre goes around the pin: p₀ = a − R r, ṗ₀ = −Ṙ r.
        let (position, velocity) = match body.pin {
            None => (vector(block), vector(&block[7..])),
            Some(pin) => (pin.anchor - rotation * pin.point, -(gradient_rate * pin.point)),
        };
        Self {
            placement: Placement { position, gradient: rotation },
            velocity: Velocity { velocity, gradient_rate },
            quaternion,
            spin,
        }
    }

    /// ω = R Ω in spatial axes [rad/s].
    pub fn angular_velocity(&self) -> Vec3 {
        self.placement.gradient * self.spin
    }
}
