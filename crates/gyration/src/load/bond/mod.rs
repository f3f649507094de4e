//! Bonds: what joins two bodies by a potential of how they stand to each other, and dashpots that need no direction.
//!
//!   Δ = p_j + R + P_j Y − p_i − P_i X,   V(l, t) of l = |Δ|,   or V of
//!   d = P_iᵀ Δ,   H = P_iᵀ P_j,   C = P_iᵀ P_i,   D = P_jᵀ P_j
//!
//! These invariants are products of seven vectors, Δ and the columns of P_i and P_j, and all that a turn and a shift of
//! space leave alone: whatever V is, momentum and angular momentum hold. `gram` has V of such products and its
//! derivatives, `stiffness` the potential of a 6×6 matrix, `dashpot` the resistance. Source: `docs/theory-lattices.md`.

mod dashpot;
mod gram;
mod stiffness;

pub use dashpot::Dashpot;
pub use gram::{INVARIANT_NAMES, InvariantPotential};
pub use stiffness::{BondAxes, BondStiffness, Stiffness6};

use super::interactions::{Interaction, InteractionEnd};
use super::resistance::Mat12;
use super::{LoadSlopes, Loads};
use crate::kinematics::BodyMotion;
use crate::lattice::{Cell, HERE};
use crate::party::Party;
use crate::tensor::{Mat3, Vec3};
use gram::{Span, SpanSlopes};
use gyration_expression::{Expression, Scratch, Undefined};
use std::sync::Arc;

/// A bond between material points of two bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Bond {
    /// The indices of the bodies.
    pub bodies: [usize; 2],
    /// X and Y, each from its centre of mass [m].
    pub points: [Vec3; 2],
    /// The cell of the second as seen from that of the first.
    pub cell: Cell,
    /// What it stores; nothing of a mere dashpot.
    pub law: Option<BondLaw>,
    /// What it dissipates.
    pub damping: Option<Dashpot>,
}

/// The potential of a bond.
#[derive(Debug, Clone, PartialEq)]
pub enum BondLaw {
    /// V of l and t.
    Distance(Arc<Expression>),
    /// V of the invariants and t.
    Invariants(Arc<InvariantPotential>),
    /// ½ zᵀ S z.
    Stiffness(Arc<BondStiffness>),
}

/// The variables of V(l, t).
pub const DISTANCE_NAMES: [&str; 2] = ["l", "t"];

/// A bond as one of its bodies sees it.
pub type BondEnd<'a> = InteractionEnd<'a, Bond>;

/// What a bond does to its bodies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BondLoads {
    /// (f | M) on each.
    pub on: [Loads; 2],
    /// The power of what it dissipates, and of a potential that changes in time [W].
    pub power: f64,
    /// V [J], of a potential that does not change in time.
    pub energy: f64,
    /// l [m].
    pub length: f64,
}

/// The derivatives of what a bond does.
#[derive(Debug, Clone, PartialEq)]
pub struct BondSlopes {
    /// ∂Q_i/∂q_j, i first.
    pub by_place: [[Mat12; 2]; 2],
    /// ∂Q_i/∂q̇_j; none of one that does not feel velocities.
    pub by_rate: Option<[[Mat12; 2]; 2]>,
}

/// Why a bond has no loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BondFault {
    /// The points coincide, where V has no derivative.
    NoLength,
    /// The formula is undefined.
    Undefined(Undefined),
}

/// The two bodies of a bond as it sees them.
#[derive(Debug, Clone, Copy)]
pub struct BondPlace<'a> {
    /// How they move in their cells.
    pub motions: [&'a BodyMotion; 2],
    /// P⁻¹ of each.
    pub inverses: [Mat3; 2],
    /// Whether each can turn: mass points do not.
    pub turn: [bool; 2],
    /// R [m].
    pub shift: Vec3,
    /// t [s].
    pub time: f64,
}

impl Interaction for Bond {
    fn parties(&self) -> [Party; 2] {
        self.bodies.map(Party::Body)
    }

    fn cell(&self) -> Cell {
        self.cell
    }
}

impl BondLaw {
    /// Whether it is an energy: V does not mention t.
    pub fn is_energy(&self) -> bool {
        match self {
            Self::Distance(expression) => !expression.uses(1),
            Self::Invariants(potential) => !potential.uses_time(),
            Self::Stiffness(_) => true,
        }
    }
}

impl Bond {
    /// In the same cell.
    pub fn new(bodies: [usize; 2], points: [Vec3; 2], law: Option<BondLaw>, damping: Option<Dashpot>) -> Self {
        Self { bodies, points, cell: HERE, law, damping }
    }

    /// The same bond between bodies that have other indices.
    pub(crate) fn of_parties(&self, parties: [Party; 2]) -> Self {
        let index = |end: usize| parties[end].body().unwrap_or(self.bodies[end]);
        Self { bodies: [0, 1].map(index), ..self.clone() }
    }

    /// Whether it has a potential that does not change in time.
    pub fn is_energy(&self) -> bool {
        self.law.as_ref().is_none_or(BondLaw::is_energy)
    }

    /// How stiff its law is where its bodies are, the largest of ∂²V/∂Δ² [N/m]; zero where it has no derivative.
    pub fn stiffness(&self, motions: [&BodyMotion; 2], shift: &Vec3, time: f64) -> f64 {
        let slopes = self.law_slopes(&self.span(motions, shift), time, &mut Scratch::default());
        slopes.map_or(0.0, |by_place| by_place[0][0].fixed_view::<3, 3>(0, 0).amax())
    }

    /// Whether it may do work: it dissipates, or its potential changes in time.
    pub fn works(&self) -> bool {
        self.damping.is_some() || !self.is_energy()
    }

    fn span(&self, motions: [&BodyMotion; 2], shift: &Vec3) -> Span {
        let [one, other] = motions.map(|motion| &motion.placement);
        let [first, second] = motions.map(|motion| &motion.velocity);
        Span {
            apart: other.place(&self.points[1]) + shift - one.place(&self.points[0]),
            rate: second.at(&self.points[1]) - first.at(&self.points[0]),
            gradients: [one.gradient, other.gradient],
            gradient_rates: [first.gradient_rate, second.gradient_rate],
        }
    }

    /// What it does to its bodies.
    ///
    /// # Errors
    /// [`BondFault`].
    pub fn loads(&self, at: &BondPlace, scratch: &mut Scratch) -> Result<BondLoads, BondFault> {
        let span = self.span(at.motions, &at.shift);
        let mut found = BondLoads { length: span.apart.norm(), ..BondLoads::default() };
        if let Some(law) = &self.law {
            let (energy, stored) = match law {
                BondLaw::Distance(expression) => {
                    let (energy, force) = distance_force(expression, &span, at.time, scratch)?;
                    (energy, span.of_force(&self.points, &force))
                }
                BondLaw::Invariants(potential) => potential.loads(&self.points, &span, at.time, scratch)?,
                BondLaw::Stiffness(stiffness) => stiffness.loads(&self.points, &span),
            };
            found.add(&stored);
            match law.is_energy() {
                true => found.energy = energy,
                false => found.power += power(&stored, at),
            }
        }
        if let Some(damping) = &self.damping {
            let resisted = damping.loads(&self.points, &span, at);
            found.power += power(&resisted, at);
            found.add(&resisted);
        }
        Ok(found)
    }

    /// The derivatives of that.
    ///
    /// # Errors
    /// [`BondFault`].
    pub fn slopes(&self, at: &BondPlace, scratch: &mut Scratch) -> Result<BondSlopes, BondFault> {
        let span = self.span(at.motions, &at.shift);
        let mut by_place = self.law_slopes(&span, at.time, scratch)?;
        let by_rate = self.damping.as_ref().map(|damping| {
            let mut by_rate = [[Mat12::zeros(); 2]; 2];
            damping.add_slopes(&self.points, &span, at, (&mut by_place, &mut by_rate));
            by_rate
        });
        Ok(BondSlopes { by_place, by_rate })
    }

    /// ∂²V/∂q_i∂q_j, with the sign of loads.
    fn law_slopes(&self, span: &Span, time: f64, scratch: &mut Scratch) -> Result<[[Mat12; 2]; 2], BondFault> {
        let mut by_place = [[Mat12::zeros(); 2]; 2];
        match &self.law {
            None => {}
            Some(BondLaw::Distance(expression)) => {
                let slope = distance_slope(expression, span, time, scratch)?;
                SpanSlopes::of_apart(&slope).add_to(&self.points, &mut by_place);
            }
            Some(BondLaw::Invariants(potential)) => {
                potential.slopes(span, time, scratch)?.add_to(&self.points, &mut by_place);
            }
            Some(BondLaw::Stiffness(stiffness)) => stiffness.slopes(span).add_to(&self.points, &mut by_place),
        }
        Ok(by_place)
    }
}

impl BondLoads {
    fn add(&mut self, loads: &[Loads; 2]) {
        self.on.iter_mut().zip(loads).for_each(|(sum, loads)| *sum += *loads);
    }
}

impl BondEnd<'_> {
    /// Which body is the other one.
    pub fn other_body(&self) -> usize {
        self.interaction.bodies[1 - self.end]
    }
}

impl LoadSlopes {
    /// Adds a bond on one of its bodies, while the other stays.
    pub fn add_bond(&mut self, end: &BondEnd, loads: &BondLoads, slopes: &BondSlopes) {
        let own = end.end;
        self.loads += loads.on[own];
        self.by_place += slopes.by_place[own][own];
        if let Some(by_rate) = &slopes.by_rate {
            self.by_rate += by_rate[own][own];
        }
    }
}

/// The power of loads on both bodies [W].
fn power(on: &[Loads; 2], at: &BondPlace) -> f64 {
    let of = |end: usize| {
        let velocity = &at.motions[end].velocity;
        on[end].power(&velocity.velocity, &velocity.gradient_rate)
    };
    of(0) + of(1)
}

/// e = Δ/l; none where the points coincide and V′ = 0.
fn direction(span: &Span, first: f64) -> Result<Option<Vec3>, BondFault> {
    match span.apart.try_normalize(0.0) {
        None if first != 0.0 => Err(BondFault::NoLength),
        direction => Ok(direction),
    }
}

/// What lacks a value or a derivative: where the points coincide, the law has none there.
fn undefined(length: f64) -> impl Fn(Undefined) -> BondFault {
    move |undefined| if length == 0.0 { BondFault::NoLength } else { BondFault::Undefined(undefined) }
}

/// V of the distance and ∂V/∂Δ = V′ e.
fn distance_force(law: &Expression, span: &Span, time: f64, scratch: &mut Scratch) -> Result<(f64, Vec3), BondFault> {
    let (length, mut gradient) = (span.apart.norm(), [0.0; 2]);
    let value = law.gradient(&[length, time], scratch, &mut gradient).map_err(undefined(length))?;
    let e = direction(span, gradient[0])?;
    Ok((value, gradient[0] * e.unwrap_or_else(Vec3::zeros)))
}

/// ∂²V/∂Δ² = V″ e⊗e + (V′/l)(1 − e⊗e); V″ 1 where the points coincide.
fn distance_slope(law: &Expression, span: &Span, time: f64, scratch: &mut Scratch) -> Result<Mat3, BondFault> {
    let (length, mut gradient, mut hessian) = (span.apart.norm(), [0.0; 2], [0.0; 4]);
    law.hessian(&[length, time], scratch, &mut gradient, &mut hessian).map_err(undefined(length))?;
    let (first, second) = (gradient[0], hessian[0]);
    let Some(e) = direction(span, first)? else { return Ok(Mat3::from_diagonal_element(second)) };
    let ee = e * e.transpose();
    Ok(second * ee + (first / length) * (Mat3::identity() - ee))
}
