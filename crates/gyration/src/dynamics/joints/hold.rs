//! Puts places and velocities back to where joints keep them, by the shortest way in the metric of the mass.
//!
//!   (G A B Gᵀ) μ = −C,  δ = B Gᵀμ;   (G A B Gᵀ) ν = −Ċ,  δv = B Gᵀν
//!
//! δ is a displacement of (position, attitude) as v is their velocity: a quaternion becomes q ∘ (1, ½δθ). Places are
//! put back by Newton's method, to all digits that their numbers have.

use super::super::Workspace;
use super::{JointEquations, Vec12, jets};
use crate::body::{BodyKind, Slots};
use crate::extended::{Extended, Numbers};
use crate::inadmissible::Inadmissible;
use crate::instant::{Instants, second};
use crate::joint::{Jet, Row};
use crate::kinematics::Quaternion;
use crate::model::Model;
use crate::state::State;

/// Steps of Newton's method at most: what a step of the integrator leaves takes two.
const MOST_STEPS: usize = 6;

/// The numbers of a state that are put back.
#[derive(Debug)]
pub struct Held<'a> {
    /// t \[s\].
    pub time: f64,
    /// The numbers, rounded.
    pub high: &'a mut [f64],
    /// What they lack of twice their digits; empty where that is not known.
    pub low: &'a mut [f64],
}

/// By how much a joint is missed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointMisfit {
    /// The largest of its equations of lengths \[m\].
    pub place: f64,
    /// The largest of its equations of directions.
    pub turn: f64,
    /// The largest rate of those of lengths \[m/s\].
    pub velocity: f64,
    /// The largest rate of those of directions \[1/s\].
    pub spin: f64,
}

impl Workspace {
    /// Puts places back to the joints; returns the largest misfit before.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn hold_places(&mut self, model: &Model, held: &mut Held) -> Result<f64, Inadmissible> {
        let Self { instants, scratch, .. } = self;
        let mut equations = std::mem::take(&mut scratch.joints);
        let size = equations.hold_places(instants, model, held);
        scratch.joints = equations;
        size
    }

    /// Puts velocities back to the joints; returns the largest misfit before.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn hold_velocities(&mut self, model: &Model, held: &mut Held) -> Result<f64, Inadmissible> {
        let Self { instants, scratch, .. } = self;
        let mut equations = std::mem::take(&mut scratch.joints);
        let size = equations.hold_velocities(instants, model, held);
        scratch.joints = equations;
        size
    }

    /// By how much each joint of a model is missed in a state.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn joint_misfits(&mut self, model: &Model, state: &State) -> Result<Vec<JointMisfit>, Inadmissible> {
        let Self { instants, scratch, .. } = self;
        let motions = instants.motions(model, state.time, state.numbers())?;
        scratch.joints.read(model, |body| motions.at(model, body), false);
        let Some(graph) = model.joint_graph() else { return Ok(Vec::new()) };
        let misfit = |joint: &crate::joint::Joint| {
            let second = second(joint, |body| motions.at(model, body));
            let jets = jets(joint, &scratch.joints.members, graph, second);
            let mut most = JointMisfit::default();
            for row in joint.rows() {
                let (place, velocity) = match row.is_of_directions() {
                    true => (&mut most.turn, &mut most.spin),
                    false => (&mut most.place, &mut most.velocity),
                };
                *place = place.max(row.value(&jets).abs());
                *velocity = velocity.max(row.rate(&jets).abs());
            }
            most
        };
        Ok(model.joints().iter().map(misfit).collect())
    }
}

impl JointEquations {
    /// Fills the right-hand side with a function of the equations less what is its rounding; returns the largest.
    fn read_held(
        &mut self,
        instants: &mut Instants,
        (model, held): (&Model, &Held),
        value: impl Fn(&Row, &[Jet; 2]) -> f64,
        rounding: impl Fn(&Row, &[Jet; 2]) -> f64,
    ) -> Result<(f64, bool), Inadmissible> {
        let motions = instants.motions(model, held.time, Numbers { high: held.high, low: held.low })?;
        self.read(model, |body| motions.at(model, body), false);
        self.fill_side(model, |body| motions.at(model, body), |row, jets| -value(row, jets));
        let size = self.side.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let Some(graph) = model.joint_graph() else { return Ok((0.0, false)) };
        let is_off = model.joints().iter().zip(&graph.ranges).any(|(joint, range)| {
            let second = second(joint, |body| motions.at(model, body));
            let jets = jets(joint, &self.members, graph, second);
            let rows = joint.rows().iter().zip(&self.side[range.clone()]);
            rows.into_iter().any(|(row, value)| value.abs() > rounding(row, &jets))
        });
        Ok((size, is_off))
    }

    fn hold_places(&mut self, instants: &mut Instants, model: &Model, held: &mut Held) -> Result<f64, Inadmissible> {
        let mut first = None;
        for _ in 0..MOST_STEPS {
            let (size, is_off) = self.read_held(instants, (model, held), Row::value, Row::rounding)?;
            first.get_or_insert(size);
            if !is_off {
                break;
            }
            self.factorize(model)?;
            self.solve_side();
            for place in 0..self.members.len() {
                let change = self.response(place);
                displace(model, self.members[place].index, &change, held);
            }
        }
        Ok(first.unwrap_or(0.0))
    }

    fn hold_velocities(
        &mut self,
        instants: &mut Instants,
        model: &Model,
        held: &mut Held,
    ) -> Result<f64, Inadmissible> {
        let (size, is_off) = self.read_held(instants, (model, held), Row::rate, Row::rounding_of_rate)?;
        if !is_off {
            return Ok(size);
        }
        self.factorize(model)?;
        self.solve_side();
        for place in 0..self.members.len() {
            let (change, slots) = (self.response(place), model.slots(self.members[place].index));
            add(held, slots.velocities().zip(change.iter().copied()));
        }
        Ok(size)
    }
}

/// Adds changes to numbers, to all digits that are kept of them.
fn add(held: &mut Held, changes: impl Iterator<Item = (usize, f64)>) {
    for (number, change) in changes {
        match held.low.get_mut(number) {
            None => held.high[number] += change,
            Some(low) => {
                let sum = Extended { high: held.high[number], low: *low } + Extended::from(change);
                (held.high[number], *low) = (sum.high, sum.low);
            }
        }
    }
}

/// Moves a body by a displacement of (position, attitude).
fn displace(model: &Model, body: usize, change: &Vec12, held: &mut Held) {
    let slots: &Slots = model.slots(body);
    let free = slots.position().len();
    add(held, slots.position().zip(change.iter().copied()));
    let own = &change.as_slice()[free..];
    match &model.bodies[body].kind {
        BodyKind::Rigid(_) => {
            let quaternion = Quaternion::read(&held.high[slots.attitude()]);
            let turned = quaternion.times(&Quaternion([0.0, 0.5 * own[0], 0.5 * own[1], 0.5 * own[2]]));
            add(held, slots.attitude().zip(turned.0));
        }
        BodyKind::Affine(_) | BodyKind::Contractile(_) => {
            add(held, slots.attitude().zip(own.iter().copied()));
        }
    }
}
