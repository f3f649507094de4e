//! Joints: the forces that keep bodies joined, and their derivatives.
//!
//!   C(q) = 0,   C̈ = G q̈ + Ġ q̇ = 0,   v̇ = a + B Gᵀλ,   q̈ = A v̇ + Ȧ v   ⇒   (G A B Gᵀ) λ = −C̈(a)
//!
//! a are the accelerations without joints, B and A those of `jacobian/coupling`, so that each kind of body answers as
//! it does to any load: an incompressible one within det P = 1, one with a guide within that. G A B Gᵀ is symmetric and
//! sparse: it couples joints that share a body, and is eliminated block by block. Forces that joints exert are loads
//! like others, of which rates and diagnostics are found once more. Source: `docs/theory-rigid.md`.
//!
//! | file      | what                                                          |
//! |-----------|---------------------------------------------------------------|
//! | `member`  | a body with joints, from its rates to q̈                       |
//! | `slopes`  | the derivatives of the rates through λ                        |
//! | `hold`    | puts places and velocities back to C = 0, Ċ = 0               |
//! | `rank`    | equations that follow from others                             |
//! | `observe` | what is recorded of a joint                                   |
//! | `tangent` | the velocities that the joints of a configuration leave       |

mod hold;
mod member;
mod observe;
mod rank;
mod slopes;
mod tangent;

pub use hold::{Held, JointMisfit};
pub use observe::{JointObservation, observe_joint};
pub use rank::DependentJoint;
pub(super) use slopes::add_jacobian;
pub use tangent::JointEquation;

use super::Scratch;
use super::body_rates::body_rates;
use crate::inadmissible::Inadmissible;
use crate::instant::{Instant, MotionAt, second};
use crate::joint::{Jet, Joint, JointGraph};
use crate::load::Interaction;
use crate::model::Model;
use gyration_blocks::{BlockLu, BlockMatrix, Real};
use member::Member;
use nalgebra::SVector;
use std::sync::Arc;

type Vec12 = SVector<f64, 12>;

/// The equations of the joints of a model at an instant; kept from one to the next.
#[derive(Debug, Clone, Default)]
pub(crate) struct JointEquations {
    room: Option<Room>,
    members: Vec<Member>,
    rows: Vec<RowAt>,
    /// A right-hand side, and the solution.
    side: Vec<f64>,
    sources: slopes::Sources,
}

/// The matrix of the multipliers and its factors, of one graph.
#[derive(Debug, Clone)]
struct Room {
    graph: Arc<JointGraph>,
    matrix: BlockMatrix,
    factors: BlockLu<Real>,
}

/// One equation at an instant; zero on what is no body.
#[derive(Debug, Clone, Copy)]
struct RowAt {
    /// Aᵀ Gᵀ of both parties, on the rates of (velocity, rate).
    pull: [Vec12; 2],
    /// B Gᵀ of both, the rates that a multiplier one gives.
    response: [Vec12; 2],
}

/// Solves for the forces of the joints of an instant.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model, or where equations of joints become dependent.
pub(super) fn solve(instant: &mut Instant, scratch: &mut Scratch) -> Result<(), Inadmissible> {
    if instant.model().joints().is_empty() {
        return Ok(());
    }
    let mut equations = std::mem::take(&mut scratch.joints);
    let solved = equations.solve(instant, scratch);
    scratch.joints = equations;
    solved
}

/// q, q̇, q̈ of both parties of a joint, from the centre of the first, given what the second adds to that of its body.
fn jets(joint: &Joint, members: &[Member], graph: &JointGraph, second: Jet) -> [Jet; 2] {
    let of = |end: usize| joint.parties()[end].body().and_then(|body| graph.place(body));
    let mut jets = [0, 1].map(|end| of(end).map_or_else(Jet::zeros, |place| members[place].jet));
    jets[1] += second;
    jets
}

impl JointEquations {
    fn solve(&mut self, instant: &mut Instant, scratch: &mut Scratch) -> Result<(), Inadmissible> {
        let model = instant.model();
        self.read(model, |body| instant.motions().at(model, body), instant.has_slopes());
        let mut rates = scratch.take_numbers(model.dimension());
        for member in &mut self.members {
            let slots = model.slots(member.index);
            body_rates(&instant.at(member.index), slots, scratch, &mut rates)?;
            member.accelerate(&rates[slots.velocities()]);
        }
        scratch.give_back(rates);
        self.factorize(model)?;
        self.fill_side(model, |body| instant.motions().at(model, body), |row, jets| -row.second_rate(jets));
        self.solve_side();
        let Self { room: Some(Room { graph, .. }), members, side, .. } = self else { return Ok(()) };
        for number in 0..instant.model().joints().len() {
            let model = instant.model();
            let joint = &model.joints()[number];
            let second = second(joint, |body| instant.motions().at(model, body));
            let mut loads = *instant.joint(number);
            joint.keep(&jets(joint, members, graph, second), &side[graph.ranges[number].clone()], &mut loads);
            instant.set_joint(number, loads);
        }
        self.accelerate_members();
        Ok(())
    }

    /// Reads bodies and equations; velocities are taken not to change.
    fn read<'a>(&mut self, model: &'a Model, at: impl Fn(usize) -> MotionAt<'a>, wants_slopes: bool) {
        self.prepare(model);
        let Self { room: Some(Room { graph, .. }), members, rows, side, .. } = self else { return };
        members.clear();
        members.extend(graph.bodies.iter().map(|body| Member::of(&at(*body), wants_slopes)));
        rows.clear();
        for joint in model.joints() {
            let jets = jets(joint, members, graph, second(joint, &at));
            let of = |end: usize| joint.parties()[end].body().and_then(|body| graph.place(body));
            rows.extend(joint.rows().iter().map(|row| {
                let mut own = RowAt { pull: [Vec12::zeros(); 2], response: [Vec12::zeros(); 2] };
                for end in 0..2 {
                    let Some(place) = of(end) else { continue };
                    [own.pull[end], own.response[end]] = members[place].pull_and_response(&row.gradient(&jets, end));
                }
                own
            }));
        }
        side.clear();
        side.resize(graph.equations(), 0.0);
    }

    /// Has room for the graph of a model.
    fn prepare(&mut self, model: &Model) {
        let Some(graph) = model.joint_graph() else { return };
        if self.room.as_ref().is_none_or(|room| !Arc::ptr_eq(&room.graph, graph)) {
            let matrix = BlockMatrix::new(&graph.ranges);
            self.room = Some(Room { graph: graph.clone(), matrix, factors: BlockLu::new(&graph.analysis) });
        }
    }

    /// Factorizes G A B Gᵀ.
    fn factorize(&mut self, model: &Model) -> Result<(), Inadmissible> {
        let Self { room: Some(Room { graph, matrix, factors }), rows, .. } = self else { return Ok(()) };
        matrix.clear();
        matrix.arrange(&graph.pattern);
        for own in &graph.joints_of {
            for (one, end) in own {
                for (other, there) in own {
                    // What is factorized is 0 − matrix.
                    let Some(block) = matrix.block_mut(*one, *other) else { continue };
                    let (first, second) = (&rows[graph.ranges[*one].clone()], &rows[graph.ranges[*other].clone()]);
                    for (j, column) in second.iter().enumerate() {
                        for (i, row) in first.iter().enumerate() {
                            block[(i, j)] -= row.pull[*end].dot(&column.response[*there]);
                        }
                    }
                }
            }
        }
        factors.factorize(&graph.analysis, 0.0, matrix).map_err(|_| self.singular(model))
    }

    /// Fills the right-hand side, equation by equation.
    fn fill_side<'a>(
        &mut self,
        model: &Model,
        at: impl Fn(usize) -> MotionAt<'a>,
        value: impl Fn(&crate::joint::Row, &[Jet; 2]) -> f64,
    ) {
        let Self { room: Some(Room { graph, .. }), members, side, .. } = self else { return };
        for (joint, range) in model.joints().iter().zip(&graph.ranges) {
            let jets = jets(joint, members, graph, second(joint, &at));
            for (row, out) in joint.rows().iter().zip(&mut side[range.clone()]) {
                *out = value(row, &jets);
            }
        }
    }

    /// Solves in place.
    fn solve_side(&mut self) {
        let Self { room: Some(Room { graph, factors, .. }), side, .. } = self else { return };
        factors.solve(&graph.analysis, &mut [side]);
    }

    /// What the multipliers at hand give a member: the change of the rates of (velocity, rate).
    fn response(&self, place: usize) -> Vec12 {
        let Self { room: Some(Room { graph, .. }), rows, side, .. } = self else { return Vec12::zeros() };
        let mut change = Vec12::zeros();
        for (joint, end) in &graph.joints_of[place] {
            for number in graph.ranges[*joint].clone() {
                change += side[number] * rows[number].response[*end];
            }
        }
        change
    }

    /// Accelerates the members by the multipliers at hand.
    fn accelerate_members(&mut self) {
        for place in 0..self.members.len() {
            let change = self.response(place);
            self.members[place].accelerate_by(&change);
        }
    }
    /// Equations of joints have become dependent.
    fn singular(&self, model: &Model) -> Inadmissible {
        rank::dependent(model, self.least_independent())
    }
}
