//! The motion of every body at one time and state: the first stage of an instant, and what follows from it alone.
//!
//! Beside (p₀, P) and (ṗ₀, Ṗ) it holds what each kind of body needs of them more than once: the quaternion and spin of
//! a rigid body, P⁻¹ and L of one that deforms, F = P G⁻¹ of one that contracts. Reading allocates only the first time.
//! A body without inertia is still until `dynamics::inertialess` gives it the velocities of its balance.

use crate::acting::PairEnd;
use crate::affine::Gyration;
use crate::body::{Affine, Body, BodyKind, Contractile, RigidInertia, Slots};
use crate::contact::Deformation;
use crate::contractile::Decomposition;
use crate::extended::{Extended, ExtendedVec3, Numbers};
use crate::inadmissible::{Inadmissible, Quantity};
use crate::kinematics::{Placement, Quaternion, Velocity};
use crate::lattice::{Cell, HERE};
use crate::model::Model;
use crate::neighbours::{Extent, NeighbourList};
use crate::state::{BodyMotion, Turn, contraction_at};
use crate::tensor::{Mat3, Vec3};

/// The motion of every body at one time and state.
#[derive(Debug, Clone, Default)]
pub(crate) struct Motions {
    time: f64,
    state: Vec<f64>,
    /// What the state lacks of twice its digits; empty where that is not known.
    low: Vec<f64>,
    bodies: Vec<BodyInstant>,
    /// Of the supports with a shape.
    pub(super) supports: Vec<BodyMotion>,
    near: NeighbourList,
    /// By the number of a listed pair: its place among those whose bodies are within reach of each other.
    pub(super) within: Vec<Option<usize>>,
    /// The numbers of these.
    pub(super) reached: Vec<usize>,
}

/// The motion of one body.
#[derive(Debug, Clone, Copy)]
struct BodyInstant {
    motion: BodyMotion,
    attitude: Attitude,
}

/// What a kind of body needs of its motion more than once.
#[expect(clippy::large_enum_variant, reason = "read once an evaluation into memory that is kept")]
#[derive(Debug, Clone, Copy)]
enum Attitude {
    Rigid(Turn),
    Affine(Gyration),
    Contractile(Gyration, Decomposition),
}

/// A body of a model and its motion at a time.
#[derive(Debug, Clone, Copy)]
pub struct MotionAt<'a> {
    /// The model.
    pub model: &'a Model,
    /// t [s].
    pub time: f64,
    /// The index of the body.
    pub index: usize,
    /// The body.
    pub body: &'a Body,
    /// p₀, P, ṗ₀, Ṗ.
    pub motion: &'a BodyMotion,
    /// The state of all bodies.
    pub(crate) numbers: Numbers<'a>,
    attitude: &'a Attitude,
    /// Where the other bodies are found.
    pub(super) motions: &'a Motions,
}

/// The kind of a body, with what it needs of its motion more than once.
#[derive(Debug, Clone, Copy)]
pub(crate) enum KindAt<'a> {
    Rigid(&'a RigidInertia, &'a Turn),
    Affine(&'a Affine, &'a Gyration),
    Contractile(&'a Contractile, &'a Gyration, &'a Decomposition),
}

impl BodyInstant {
    /// Room for a body.
    const EMPTY: Self = Self {
        motion: BodyMotion {
            placement: Placement { position: ZEROS, gradient: NO_MATRIX },
            velocity: Velocity { velocity: ZEROS, gradient_rate: NO_MATRIX },
        },
        attitude: Attitude::Rigid(Turn { quaternion: Quaternion::IDENTITY, spin: ZEROS }),
    };

    /// Reads the slots of a body in a state, in place: what a kind does not have is not touched.
    ///
    /// # Errors
    /// [`Inadmissible`] where det P ≤ 0 or det G ≤ 0.
    #[inline]
    fn read(
        &mut self,
        body: &Body,
        index: usize,
        slots: &Slots,
        (time, state): (f64, &[f64]),
    ) -> Result<(), Inadmissible> {
        if let BodyKind::Rigid(_) = &body.kind {
            let turn = Turn::read(slots, state);
            self.motion = BodyMotion::of_turn(body, slots, state, &turn);
            self.attitude = Attitude::Rigid(turn);
            return Ok(());
        }
        self.motion = BodyMotion::read(body, slots, state);
        let (p, rate) = (&self.motion.placement.gradient, &self.motion.velocity.gradient_rate);
        let outside = |quantity| move |value| Inadmissible { body: index, quantity, value };
        let gyration = Gyration::of(p, rate).map_err(outside(Quantity::Volume))?;
        self.attitude = match body.contraction() {
            None => Attitude::Affine(gyration),
            Some(contraction) => {
                let contraction = contraction_at(contraction, time, &state[slots.extra()]);
                let decomposition = Decomposition::of(p, &contraction).map_err(outside(Quantity::Contraction))?;
                Attitude::Contractile(gyration, decomposition)
            }
        };
        Ok(())
    }
}

const ZEROS: Vec3 = Vec3::new(0.0, 0.0, 0.0);
const NO_MATRIX: Mat3 = Mat3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);

impl Motions {
    /// Reads a state; bodies without inertia are taken to be still.
    ///
    /// # Errors
    /// [`Inadmissible`] where det P ≤ 0 or det G ≤ 0.
    pub fn read(&mut self, model: &Model, time: f64, numbers: Numbers) -> Result<(), Inadmissible> {
        let state = numbers.high;
        self.time = time;
        for (kept, given) in [(&mut self.state, state), (&mut self.low, numbers.low)] {
            kept.clear();
            kept.extend_from_slice(given);
        }
        self.bodies.resize(model.bodies.len(), BodyInstant::EMPTY);
        for (index, (body, instant)) in model.bodies.iter().zip(&mut self.bodies).enumerate() {
            instant.read(body, index, model.slots(index), (time, state))?;
        }
        self.supports.clear();
        self.supports.extend(model.solid_supports.iter().map(|support| support.at(time)));
        let Self { bodies, near, .. } = self;
        let place = |index: usize| bodies[index].motion.placement.position;
        let extent = |index: usize| Extent {
            place: place(index),
            radius: model.bodies[index].radius_at(&bodies[index].motion.placement),
        };
        if let Some((body, value)) = model.images().and_then(|images| images.strayed(extent)) {
            return Err(Inadmissible { body, quantity: Quantity::Stray, value });
        }
        near.update((model.rules(), model.pairs_with_supports()), model.images(), &model.bodies, place);
        self.find_reached(model);
        Ok(())
    }

    /// The place of a listed pair among those within reach, if it is one of them.
    pub fn place(&self, number: usize) -> Option<usize> {
        self.within[number]
    }

    /// The numbers of the listed pairs within reach, ascending.
    pub fn reached(&self) -> &[usize] {
        &self.reached
    }

    /// Reads one body again from numbers of its own.
    ///
    /// # Errors
    /// [`Inadmissible`] where det P ≤ 0 or det G ≤ 0.
    pub fn read_body(&mut self, body: &Body, index: usize, slots: &Slots, numbers: &[f64]) -> Result<(), Inadmissible> {
        self.bodies[index].read(body, index, slots, (self.time, numbers))
    }

    /// The numbers that were read.
    pub fn state(&self) -> &[f64] {
        &self.state
    }

    /// The pairs of bodies that may act on one another.
    pub fn near(&self) -> &NeighbourList {
        &self.near
    }

    /// t [s].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// How a body moves; one without inertia is still until its balance is solved.
    #[inline]
    pub fn motion(&self, index: usize) -> &BodyMotion {
        &self.bodies[index].motion
    }

    /// A body of the model from whose state this was read.
    #[inline]
    pub fn at<'a>(&'a self, model: &'a Model, index: usize) -> MotionAt<'a> {
        let BodyInstant { motion, attitude } = &self.bodies[index];
        let numbers = Numbers { high: &self.state, low: &self.low };
        MotionAt { model, time: self.time, index, body: &model.bodies[index], motion, numbers, attitude, motions: self }
    }
}

impl<'a> MotionAt<'a> {
    /// Its kind.
    #[inline]
    pub(crate) fn kind(&self) -> KindAt<'a> {
        match (&self.body.kind, self.attitude) {
            (BodyKind::Rigid(inertia), Attitude::Rigid(turn)) => KindAt::Rigid(inertia, turn),
            (BodyKind::Affine(affine), Attitude::Affine(gyration)) => KindAt::Affine(affine, gyration),
            (BodyKind::Contractile(contractile), Attitude::Contractile(gyration, decomposition)) => {
                KindAt::Contractile(contractile, gyration, decomposition)
            }
            _ => unreachable!("an instant belongs to the model that it was read from"),
        }
    }

    /// P and what follows from it; none of a rigid body.
    #[inline]
    pub(crate) fn gyration(&self) -> Option<&'a Gyration> {
        match self.attitude {
            Attitude::Rigid(_) => None,
            Attitude::Affine(gyration) | Attitude::Contractile(gyration, _) => Some(gyration),
        }
    }

    /// P⁻¹.
    #[inline]
    pub(crate) fn inverse(&self) -> Mat3 {
        self.gyration().map_or_else(|| self.motion.placement.gradient.transpose(), |gyration| gyration.inverse)
    }

    /// How it takes its surface along; none of a rigid body.
    #[inline]
    pub(crate) fn deformation(&self) -> Option<Deformation> {
        let Gyration { inverse, volume_ratio, .. } = self.gyration()?;
        Some(Deformation { inverse: *inverse, cofactor: *volume_ratio * inverse.transpose() })
    }

    /// The pairs of bodies that may act on one another.
    pub(crate) fn near(&self) -> &'a NeighbourList {
        self.motions.near()
    }

    /// The place of a listed pair among those within reach, if it is one of them.
    pub(crate) fn place(&self, end: &PairEnd) -> Option<usize> {
        self.motions.place(end.number)
    }

    /// Another body at the same time.
    pub(crate) fn beside(&self, index: usize) -> Self {
        self.motions.at(self.model, index)
    }

    /// How a support with a shape moves at this time.
    pub(crate) fn support_motion(&self, index: usize) -> &'a BodyMotion {
        &self.motions.supports[index]
    }

    /// The place of its centre of mass from that of another body [m], to all the digits of the state: p₀ − p₀′ has
    /// those of the difference, wherever the origin is. A pinned body has those of one number.
    #[inline]
    pub(crate) fn from(&self, other: &Self) -> Vec3 {
        if self.numbers.low.is_empty() || self.body.pin.is_some() || other.body.pin.is_some() {
            return self.motion.placement.position - other.motion.placement.position;
        }
        let [own, there] = [self, other].map(|at| at.model.slots(at.index).position().start);
        Vec3::from_fn(|i, _| (self.numbers.at(own + i) - self.numbers.at(there + i)).value())
    }

    /// The place of a point of space from its centre of mass [m], to all the digits of the state.
    pub(crate) fn place_from_center(&self, place: &Vec3) -> Vec3 {
        if self.body.pin.is_some() {
            return place - self.motion.placement.position;
        }
        let start = self.model.slots(self.index).position().start;
        self.numbers.behind(&[0, 1, 2].map(|i| Extended::from(place[i])), start)
    }

    /// The place of its centre of mass from a point of space [m], as `from` another body.
    #[inline]
    pub(super) fn place_from(&self, point: &Vec3) -> Vec3 {
        if self.numbers.low.is_empty() || self.body.pin.is_some() {
            return self.motion.placement.position - point;
        }
        let own = self.model.slots(self.index).position().start;
        Vec3::from_fn(|i, _| (self.numbers.at(own + i) - Extended::from(point[i])).value())
    }

    /// The place of the image of another body in a cell, from that of this one [m].
    #[inline]
    pub(crate) fn apart(&self, other: &Self, cell: Cell) -> Vec3 {
        match cell {
            HERE => other.from(self),
            cell => other.from(self) + self.model.lattice.place(cell),
        }
    }

    /// ṗ₀, to all the digits of the state; of a pinned body to those of one number.
    pub(crate) fn velocity(&self) -> ExtendedVec3 {
        let given = self.motion.velocity.velocity;
        match self.body.pin {
            Some(_) => [0, 1, 2].map(|i| Extended::from(given[i])),
            None => {
                debug_assert!(self.body.has_inertia(), "a body without inertia has no velocity in its state");
                let start = self.model.slots(self.index).velocity().start;
                [0, 1, 2].map(|i| self.numbers.at(start + i))
            }
        }
    }

    /// What stands in its slot `extra`, to all the digits of the state.
    pub(crate) fn extra(&self) -> Numbers<'a> {
        let slot = self.model.slots(self.index).extra();
        let Numbers { high, low } = self.numbers;
        Numbers { high: &high[slot.clone()], low: low.get(slot).unwrap_or_default() }
    }

    /// A state outside the model.
    pub(crate) fn outside(&self, quantity: Quantity, value: f64) -> Inadmissible {
        Inadmissible { body: self.index, quantity, value }
    }
}
