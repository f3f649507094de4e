//! The state: time, the numbers of every body, and the works done so far. Minimal: the rest follows from the model.

use crate::body::{Body, BodyKind, Pin};
use crate::contractile::{Contraction, Source};
use crate::fluid::Memory;
use crate::kinematics::{Placement, Quaternion, Velocity, rigid_gradient_rate};
use crate::model::Model;
use crate::tensor::{Mat3, Vec3, axial};

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
pub enum Start {
    /// A rigid body.
    Rigid(RigidStart),
    /// A body that deforms: any placement and velocity. Those of a pinned body's centre follow from P and Ṗ.
    Affine(Placement, Velocity),
    /// A body that contracts: the same, and G, which is left aside where it is prescribed.
    Contractile(Placement, Velocity, Mat3),
}

/// How a rigid body starts.
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

/// The motion of one body of any kind, unpacked from its block of the state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMotion {
    /// p₀ and P.
    pub placement: Placement,
    /// ṗ₀ and Ṗ.
    pub velocity: Velocity,
}

/// What the block of a rigid body holds of its rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// The quaternion as it stands, not normalised.
    pub quaternion: Quaternion,
    /// Ω, angular velocity in body axes [rad/s].
    pub spin: Vec3,
}

impl From<RigidStart> for Start {
    fn from(start: RigidStart) -> Self {
        Self::Rigid(start)
    }
}

impl Start {
    /// Appends the body's block of the state.
    fn pack(&self, body: &Body, numbers: &mut Vec<f64>) {
        let (free, moving) = (body.pin.is_none(), body.has_inertia());
        match self {
            Self::Rigid(start) => {
                let mut push = |part: &[f64], kept: bool| numbers.extend(part.iter().filter(|_| kept));
                let quaternion = start.orientation.normalized();
                let spin = quaternion.rotation().tr_mul(&start.angular_velocity);
                push(start.position.as_slice(), free);
                push(&quaternion.0, true);
                push(start.velocity.as_slice(), free && moving);
                push(spin.as_slice(), moving);
                numbers.extend(std::iter::repeat_n(0.0, body.memory().map_or(0, Memory::dimension)));
            }
            Self::Affine(placement, velocity) | Self::Contractile(placement, velocity, _) => {
                let mut push = |part: &[f64], kept: bool| numbers.extend(part.iter().filter(|_| kept));
                push(placement.position.as_slice(), free);
                push(placement.gradient.as_slice(), true);
                push(velocity.velocity.as_slice(), free && moving);
                push(velocity.gradient_rate.as_slice(), moving);
                if let Self::Contractile(_, _, contraction) = self {
                    push(contraction.as_slice(), body.contraction().is_some_and(Contraction::is_driven));
                }
            }
        }
    }
}

impl State {
    /// The state at t = 0 from the start of each body, in order; each of the kind of its body.
    pub fn start(model: &Model, starts: &[Start]) -> Self {
        let mut bodies = Vec::with_capacity(model.dimension());
        for (body, start) in model.bodies.iter().zip(starts) {
            start.pack(body, &mut bodies);
        }
        debug_assert_eq!(bodies.len(), model.dimension(), "each start is of the kind of its body");
        Self { time: 0.0, bodies, works: vec![0.0; model.works().len()] }
    }

    /// G of a body that contracts.
    pub fn contraction(&self, model: &Model, body: usize) -> Option<Mat3> {
        let block = &self.bodies[model.blocks()[body].clone()];
        Some(contraction(model.bodies[body].contraction()?, self.time, block))
    }

    /// The motion of one body; of one without inertia as if it were still: [`settled_motion`](crate::rates::settled_motion).
    pub fn motion(&self, model: &Model, body: usize) -> BodyMotion {
        BodyMotion::unpack(&model.bodies[body], &self.bodies[model.blocks()[body].clone()])
    }
}

/// G from the block of a body that contracts, or as it is prescribed at a time [s].
pub(crate) fn contraction(contraction: &Contraction, time: f64, block: &[f64]) -> Mat3 {
    match &contraction.source {
        Source::Driven { .. } => Mat3::from_column_slice(&block[block.len() - 9..]),
        Source::Prescribed(signal) => signal.at(time),
    }
}

/// Whether a block has no velocities.
fn is_still(body: &Body, block: &[f64]) -> bool {
    !body.has_inertia() && block.len() < body.parts().all()
}

fn vector(numbers: &[f64]) -> Vec3 {
    Vec3::new(numbers[0], numbers[1], numbers[2])
}

impl Turn {
    /// Reads the block of a rigid body.
    pub fn unpack(body: &Body, block: &[f64]) -> Self {
        let (at, spin) = if body.pin.is_none() { (3, 10) } else { (0, 4) };
        let quaternion = Quaternion([block[at], block[at + 1], block[at + 2], block[at + 3]]);
        Self { quaternion, spin: if is_still(body, block) { Vec3::zeros() } else { vector(&block[spin..]) } }
    }

    /// Reads the block of a rigid body without inertia, its spin from the rates of the block.
    pub fn of_rates(body: &Body, block: &[f64], rates: &[f64]) -> Self {
        let Self { quaternion, .. } = Self::unpack(body, block);
        let at = if body.pin.is_none() { 3 } else { 0 };
        let rate = nalgebra::Vector4::from_column_slice(&rates[at..at + 4]);
        Self { quaternion, spin: quaternion.turn_by_component() * rate }
    }

    /// The motion that goes with it, the rest being read from the block.
    pub fn motion(&self, body: &Body, block: &[f64]) -> BodyMotion {
        let rotation = self.quaternion.rotation();
        let gradient_rate = rigid_gradient_rate(&rotation, &self.spin);
        let velocity = || if is_still(body, block) { Vec3::zeros() } else { vector(&block[7..]) };
        BodyMotion::of(body.pin.as_ref(), rotation, gradient_rate, || (vector(block), velocity()))
    }
}

impl BodyMotion {
    /// Reads a body's block of the state; one without inertia is taken to be still.
    pub fn unpack(body: &Body, block: &[f64]) -> Self {
        match body.kind {
            BodyKind::Rigid(_) => Turn::unpack(body, block).motion(body, block),
            BodyKind::Affine(_) | BodyKind::Contractile(_) => {
                let (gradient, rate) = if body.pin.is_none() { (3, 15) } else { (0, 9) };
                let matrix = |at: usize| Mat3::from_column_slice(&block[at..at + 9]);
                let still = is_still(body, block);
                let center = || (vector(block), if still { Vec3::zeros() } else { vector(&block[12..]) });
                let rate = if still { Mat3::zeros() } else { matrix(rate) };
                Self::of(body.pin.as_ref(), matrix(gradient), rate, center)
            }
        }
    }

    /// The motion of a body without inertia, given the rates of its block.
    pub fn of_rates(body: &Body, block: &[f64], rates: &[f64]) -> Self {
        let pin = body.pin.as_ref();
        let center = || (vector(block), vector(rates));
        match body.kind {
            BodyKind::Rigid(_) => {
                let turn = Turn::of_rates(body, block, rates);
                let rotation = turn.quaternion.rotation();
                Self::of(pin, rotation, rigid_gradient_rate(&rotation, &turn.spin), center)
            }
            BodyKind::Affine(_) | BodyKind::Contractile(_) => {
                let at = if pin.is_none() { 3 } else { 0 };
                let matrix = |numbers: &[f64]| Mat3::from_column_slice(&numbers[at..at + 9]);
                Self::of(pin, matrix(block), matrix(rates), center)
            }
        }
    }

    /// The motion of P and Ṗ. A pinned body's centre follows the pin: p₀ = a − P r, ṗ₀ = −Ṗ r.
    fn of(pin: Option<&Pin>, gradient: Mat3, gradient_rate: Mat3, center: impl FnOnce() -> (Vec3, Vec3)) -> Self {
        let (position, velocity) = match pin {
            None => center(),
            Some(pin) => (pin.anchor - gradient * pin.point, -(gradient_rate * pin.point)),
        };
        Self { placement: Placement { position, gradient }, velocity: Velocity { velocity, gradient_rate } }
    }

    /// ω of a rigid body, half the vorticity ½ rot ẋ of any other, in spatial axes [rad/s].
    pub fn angular_velocity(&self) -> Vec3 {
        match self.placement.gradient.try_inverse() {
            Some(inverse) => 0.5 * axial(&(self.velocity.gradient_rate * inverse)),
            None => Vec3::from_element(f64::NAN),
        }
    }
}
