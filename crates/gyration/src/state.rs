//! The state: time, the numbers of every body, and the works done so far. Minimal: the rest follows from the model.

use crate::body::{Body, BodyKind, Slots, matrix, vector};
use crate::contractile::{Contraction, ContractionSource};
use crate::extended::Numbers;
pub use crate::kinematics::BodyMotion;
use crate::kinematics::{Placement, Quaternion, Velocity, rigid_gradient_rate};
use crate::lattice::Lattice;
use crate::model::Model;
use crate::tensor::{Mat3, Vec3, axial};
use std::ops::Range;

/// Time, configuration and velocities, and the work integrals of the ledger.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// t [s].
    pub time: f64,
    /// The numbers of the bodies, block by block (`Model::blocks`).
    pub bodies: Vec<f64>,
    /// What these numbers lack of twice their digits; empty where that is not known.
    pub low: Vec<f64>,
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
    /// Writes the numbers of a body into the state.
    fn write(&self, body: &Body, slots: &Slots, state: &mut [f64]) {
        let mut write = |slot: Range<usize>, numbers: &[f64]| {
            // A slot that the body does not have is empty.
            let count = slot.len();
            state[slot].copy_from_slice(&numbers[..count]);
        };
        match self {
            Self::Rigid(start) => {
                let quaternion = start.orientation.normalized();
                let spin = quaternion.rotation().tr_mul(&start.angular_velocity);
                write(slots.position(), start.position.as_slice());
                write(slots.attitude(), &quaternion.0);
                write(slots.velocity(), start.velocity.as_slice());
                write(slots.rate(), spin.as_slice());
            }
            Self::Affine(placement, velocity) | Self::Contractile(placement, velocity, _) => {
                write(slots.position(), placement.position.as_slice());
                write(slots.attitude(), placement.gradient.as_slice());
                write(slots.velocity(), velocity.velocity.as_slice());
                write(slots.rate(), velocity.gradient_rate.as_slice());
            }
        }
        if let (Self::Contractile(_, _, contraction), Some(_)) = (self, body.contraction()) {
            write(slots.extra(), contraction.as_slice());
        }
    }
}

impl State {
    /// The state at t = 0 from the start of each body, in order; each of the kind of its body.
    pub fn start(model: &Model, starts: &[Start]) -> Self {
        let mut bodies = vec![0.0; model.dimension()];
        for (index, start) in starts.iter().enumerate() {
            start.write(&model.bodies[index], model.slots(index), &mut bodies);
        }
        Self { time: 0.0, bodies, low: Vec::new(), works: vec![0.0; model.works().len()] }
    }

    /// Puts one body to a start; the others, and what the fluid remembers of it, stay.
    pub fn put(&mut self, model: &Model, body: usize, start: &Start) {
        start.write(&model.bodies[body], model.slots(body), &mut self.bodies);
        if let Some(lacking) = self.low.get_mut(model.blocks()[body].clone()) {
            lacking.fill(0.0);
        }
    }

    /// The numbers of the bodies to all their digits.
    pub fn numbers(&self) -> Numbers<'_> {
        Numbers { high: &self.bodies, low: &self.low }
    }

    /// G of a body that contracts.
    pub fn contraction(&self, model: &Model, body: usize) -> Option<Mat3> {
        let contraction = model.bodies[body].contraction()?;
        Some(contraction_at(contraction, self.time, &self.bodies[model.slots(body).extra()]))
    }

    /// The motion of one body; of one without inertia as if it were still.
    pub fn motion(&self, model: &Model, body: usize) -> BodyMotion {
        BodyMotion::read(&model.bodies[body], model.slots(body), &self.bodies)
    }

    /// Cells of these vectors that have gone to F x, and the state of their bodies, whose centres move along.
    #[must_use]
    pub fn carried(&self, model: &Model, strain: &Mat3, lattice: Lattice) -> (Model, Self) {
        let model = model.clone().with_cells_deformed(strain, lattice);
        let mut state = Self { low: Vec::new(), ..self.clone() };
        for body in 0..model.bodies.len() {
            let place = &mut state.bodies[model.slots(body).position()];
            if let [x, y, z] = *place {
                place.copy_from_slice((strain * Vec3::new(x, y, z)).as_slice());
            }
        }
        (model, state)
    }

    /// The same with the place in space of a body of a lattice, where its own is that in its cell.
    pub fn motion_in_space(&self, model: &Model, body: usize) -> BodyMotion {
        let mut motion = self.motion(model, body);
        motion.placement.position = model.in_space(body, &motion.placement.position);
        motion
    }
}

/// G from its slot, or as it is prescribed at a time [s].
pub fn contraction_at(contraction: &Contraction, time: f64, extra: &[f64]) -> Mat3 {
    match &contraction.source {
        ContractionSource::Driven { .. } => matrix(extra),
        ContractionSource::Prescribed(signal) => signal.at(time),
    }
}

/// What stands in a slot; zero where the body does not have it.
#[inline(always)]
fn read<T>(state: &[f64], slot: Range<usize>, from: impl Fn(&[f64]) -> T, zero: T) -> T {
    if slot.is_empty() { zero } else { from(&state[slot]) }
}

/// p₀ and ṗ₀ of a body that is not pinned.
#[inline(always)]
fn center(slots: &Slots, state: &[f64]) -> (Vec3, Vec3) {
    (vector(&state[slots.position()]), read(state, slots.velocity(), vector, Vec3::zeros()))
}

impl Turn {
    /// Reads the slots of a rigid body; one without inertia is taken to be still.
    #[inline(always)]
    pub fn read(slots: &Slots, state: &[f64]) -> Self {
        let quaternion = Quaternion::read(&state[slots.attitude()]);
        Self { quaternion, spin: read(state, slots.rate(), vector, Vec3::zeros()) }
    }

    /// Of a rigid body without inertia, given the rates of its places.
    pub fn of_rates(slots: &Slots, state: &[f64], rates: &[f64]) -> Self {
        let quaternion = Quaternion::read(&state[slots.attitude()]);
        let rate = nalgebra::Vector4::from_column_slice(&rates[slots.attitude()]);
        Self { quaternion, spin: quaternion.turn_by_component() * rate }
    }
}

impl BodyMotion {
    /// Reads the slots of a body; one without inertia is taken to be still.
    pub fn read(body: &Body, slots: &Slots, state: &[f64]) -> Self {
        if let BodyKind::Rigid(_) = body.kind {
            return Self::of_turn(body, slots, state, &Turn::read(slots, state));
        }
        let rate = read(state, slots.rate(), matrix, Mat3::zeros());
        Self::of(body, slots, state, matrix(&state[slots.attitude()]), rate)
    }

    /// The motion of a rigid body whose turn has been read.
    #[inline(always)]
    pub(crate) fn of_turn(body: &Body, slots: &Slots, state: &[f64], turn: &Turn) -> Self {
        let rotation = turn.quaternion.rotation();
        let rate = rigid_gradient_rate(&rotation, &turn.spin);
        Self::of(body, slots, state, rotation, rate)
    }

    /// The motion of a body without inertia, given the rates of its places.
    pub fn of_rates(body: &Body, slots: &Slots, state: &[f64], rates: &[f64]) -> Self {
        let (gradient, rate) = match body.kind {
            BodyKind::Rigid(_) => {
                let turn = Turn::of_rates(slots, state, rates);
                let rotation = turn.quaternion.rotation();
                (rotation, rigid_gradient_rate(&rotation, &turn.spin))
            }
            BodyKind::Affine(_) | BodyKind::Contractile(_) => {
                (matrix(&state[slots.attitude()]), matrix(&rates[slots.attitude()]))
            }
        };
        let mut motion = Self::of(body, slots, state, gradient, rate);
        if body.pin.is_none() {
            motion.velocity.velocity = vector(&rates[slots.position()]);
        }
        motion
    }

    /// The motion of P and Ṗ. A pinned body's centre follows the pin: p₀ = a − P r, ṗ₀ = −Ṗ r.
    #[inline(always)]
    fn of(body: &Body, slots: &Slots, state: &[f64], gradient: Mat3, gradient_rate: Mat3) -> Self {
        let (position, velocity) = match &body.pin {
            None => center(slots, state),
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
