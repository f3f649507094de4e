//! A frozen system: some bodies of a model alone with what acts between them, supports, loads and drives as they are at
//! the start; contractions are held, or move by their laws.

use super::slopes::SystemSlopes;
use crate::projection::{normalize, restore_guided};
use gyration::balance::observe;
use gyration::body::{Body, BodyKind, Slots, matrix};
use gyration::contact::{Action, Term};
use gyration::contractile::ContractionSource;
use gyration::dynamics::{Held, JointEquation, Workspace, jacobian, rates};
use gyration::fluid::Fluid;
use gyration::instant::PairGaps;
use gyration::lattice::Cell;
use gyration::load::{Interaction, Party};
use gyration::model::Model;
use gyration::signal::Signal;
use gyration::state::{BodyMotion, State};
use gyration::tensor::{Mat3, Vec3};
use gyration::{FormulaOf, Inadmissible, Quantity};
use std::ops::Range;
use std::sync::Arc;

/// Bodies and what acts on them at one instant.
#[derive(Debug)]
pub(super) struct FrozenSystem {
    model: Model,
    workspace: Workspace,
    time: f64,
    /// The indices of the bodies in the scene.
    members: Vec<usize>,
    /// The numbers in the scene of the springs of the system.
    springs: Vec<usize>,
    /// The numbers in the scene of its bonds.
    bonds: Vec<usize>,
    /// The numbers in the scene of its joints.
    joints: Vec<usize>,
    /// The numbers of the state at the start, without velocities.
    pub start: Vec<f64>,
    /// Whether each body has no inertia in the scene: here all have, which rests do not feel.
    weightless: Vec<bool>,
    evaluations: usize,
}

/// Places are put back to joints and bodies in turn so often at most: each time squares what is left.
const HOLDS: usize = 10;
/// Joints hold to this part of the smallest body, as at a start.
const HELD: f64 = 1e-9;

/// The gaps of a body.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BodyGaps {
    /// The smallest distances to the supports that push or pull at it [m].
    pub to_supports: Vec<f64>,
    /// The smallest slab between it and what it meets besides, infinite if there is none within reach [m].
    pub to_others: f64,
}

impl BodyGaps {
    /// The smallest of all; infinite if there is none [m].
    pub fn least(&self) -> f64 {
        self.to_supports.iter().copied().fold(self.to_others, f64::min)
    }
}

/// What the contractions of a frozen system do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FrozenContraction {
    /// They stay what they are at the start.
    Held,
    /// They follow their laws under the drives of the start, and what feedback adds.
    Driven,
}

impl FrozenSystem {
    /// Of bodies whose indices ascend.
    pub fn new(model: &Model, start: &State, members: &[usize], contraction: FrozenContraction) -> Self {
        let mut alone = model.part(members);
        alone.supports = model.supports.iter().map(|support| support.held_at(start.time)).collect();
        alone.solid_supports = model.solid_supports.iter().map(|support| support.held_at(start.time)).collect();
        let (mut bodies, mut numbers) = (Vec::new(), Vec::new());
        for member in members {
            let (body, block) = frozen(model, start, *member, contraction);
            bodies.push(body);
            numbers.extend(block);
        }
        let springs = alone.springs().iter().map(|spring| spring.clone().held_at(start.time)).collect();
        let joints = alone.joints().iter().map(|joint| joint.clone().held_at(start.time)).collect();
        let mut alone = alone.with_bodies(bodies).with_springs(springs).with_joints(joints);
        if let Some(fluid) = &model.fluid {
            let [velocity, gradient] = fluid.signals().map(|signal| Signal::Constant(signal.at(start.time)));
            alone = alone.in_fluid(Fluid { velocity, gradient, ..(**fluid).clone() });
        }
        Self {
            model: alone,
            workspace: Workspace::default(),
            time: start.time,
            members: members.to_vec(),
            springs: numbers_among(model.springs(), members),
            bonds: numbers_among(model.bonds(), members),
            joints: numbers_among(model.joints(), members),
            start: numbers,
            weightless: members.iter().map(|member| !model.bodies[*member].has_inertia()).collect(),
            evaluations: 0,
        }
    }

    /// Whether a body has no inertia in the scene.
    pub fn is_weightless(&self, body: usize) -> bool {
        self.weightless[body]
    }

    /// The block of a body as the state of the scene has it.
    pub fn block(&self, numbers: &[f64], body: usize) -> Vec<f64> {
        let slots = self.slots(body);
        let [block, velocities] = [slots.block(), slots.velocities()];
        let left_out = if self.weightless[body] { velocities } else { block.start..block.start };
        block.filter(|place| !left_out.contains(place)).map(|place| numbers[place]).collect()
    }

    /// The block of a body here, at rest, given that of the state of the scene, which may end before G.
    pub fn at_rest(&self, body: usize, block: &[f64]) -> Vec<f64> {
        if self.weightless[body] { standing(&self.model.bodies[body], block) } else { block.to_vec() }
    }

    /// How often forces or their derivatives have been computed.
    pub fn evaluations(&self) -> usize {
        self.evaluations
    }

    /// How many bodies there are.
    pub fn count(&self) -> usize {
        self.model.bodies.len()
    }

    pub fn bodies(&self) -> &[Arc<Body>] {
        &self.model.bodies
    }

    /// The bodies alone.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The instant at which all is frozen [s].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The slabs between bodies that were found last.
    pub fn found_gaps(&self) -> &PairGaps {
        self.workspace.found_gaps()
    }

    /// What leads to other cells: the cell, and the force on the body in this one [N].
    pub fn across_cells(&mut self, numbers: &[f64]) -> Result<Vec<(Cell, Vec3)>, Inadmissible> {
        let state = self.state(numbers);
        let read = self.workspace.read(&self.model, &state);
        let found = read.map(|(instant, _)| instant.across_cells());
        found.map_err(|left| self.outside(left))
    }

    /// The numbers as a state of the model.
    fn state(&self, numbers: &[f64]) -> State {
        State { time: self.time, bodies: numbers.to_vec(), low: Vec::new(), works: vec![0.0; self.model.works().len()] }
    }

    /// The place in space [m] of one in the cell of a body.
    pub fn in_space(&self, body: usize, place: &Vec3) -> Vec3 {
        self.model.in_space(body, place)
    }

    /// Whether a pin, a joint to space, a spring to an anchor, a support with a shape or a force of its own may hold
    /// one of them.
    pub fn is_anchored(&self) -> bool {
        let is_carried = !self.model.pairs_with_supports().is_empty();
        let is_held = self.model.springs().iter().any(|spring| spring.law.stiffness > 0.0 && spring.bodies().is_none());
        let is_linked = self.model.joints().iter().any(|joint| joint.bodies().is_none());
        is_held || is_linked || is_carried || self.model.bodies.iter().any(|body| body.pin.is_some() || body.own.hold())
    }

    pub fn gravity(&self) -> Vec3 {
        self.model.gravity
    }

    /// What is outside of the model, as the scene numbers it.
    fn outside(&self, left: Inadmissible) -> Inadmissible {
        let quantity = match left.quantity {
            Quantity::SpringLength { spring } => Quantity::SpringLength { spring: self.springs[spring] },
            Quantity::BondLength { bond } => Quantity::BondLength { bond: self.bonds[bond] },
            Quantity::Formula { of: FormulaOf::Bond(bond), undefined } => {
                Quantity::Formula { of: FormulaOf::Bond(self.bonds[bond]), undefined }
            }
            Quantity::Formula { of: FormulaOf::Joint(joint), undefined } => {
                Quantity::Formula { of: FormulaOf::Joint(self.joints[joint]), undefined }
            }
            Quantity::FluidGap { other } => Quantity::FluidGap { other: self.members[other] },
            Quantity::JointLimit { joint } => Quantity::JointLimit { joint: self.joints[joint] },
            Quantity::Joints { joint } => Quantity::Joints { joint: self.joints[joint] },
            Quantity::PairGap { other, rule } => Quantity::PairGap { other: self.in_scene(other), rule },
            Quantity::PairPlane { other, rule } => Quantity::PairPlane { other: self.in_scene(other), rule },
            other => other,
        };
        Inadmissible { body: self.members[left.body], quantity, ..left }
    }

    /// A party as the scene numbers it.
    fn in_scene(&self, party: Party) -> Party {
        match party {
            Party::Body(body) => Party::Body(self.members[body]),
            Party::Support(_) | Party::SolidSupport(_) | Party::Space => party,
        }
    }

    /// The rates of the numbers.
    pub fn rates(&mut self, numbers: &[f64]) -> Result<Vec<f64>, Inadmissible> {
        self.evaluations += 1;
        let mut slopes = vec![0.0; numbers.len()];
        let mut powers = vec![0.0; self.model.works().len()];
        let done = rates(&self.model, &mut self.workspace, self.time, numbers.into(), &mut slopes, &mut powers);
        done.map_err(|left| self.outside(left))?;
        Ok(slopes)
    }

    /// The exact Jacobian.
    pub fn slopes(&mut self, numbers: &[f64]) -> Result<SystemSlopes, Inadmissible> {
        self.evaluations += 1;
        let mut slopes = SystemSlopes::new(self.model.blocks());
        let done = jacobian(&self.model, &mut self.workspace, self.time, numbers.into(), &mut slopes);
        done.map_err(|left| self.outside(left))?;
        Ok(slopes)
    }

    /// The equations of the joints at a configuration.
    pub fn joint_equations(&mut self, numbers: &[f64]) -> Result<Vec<JointEquation>, Inadmissible> {
        if self.model.joints().is_empty() {
            return Ok(Vec::new());
        }
        let state = self.state(numbers);
        let found = self.workspace.joint_equations(&self.model, &state);
        found.map_err(|left| self.outside(left))
    }

    pub fn motion(&self, numbers: &[f64], body: usize) -> BodyMotion {
        BodyMotion::read(&self.model.bodies[body], self.slots(body), numbers)
    }

    /// P⁻¹ of a body.
    pub fn inverse(&self, numbers: &[f64], body: usize) -> Mat3 {
        self.motion(numbers, body).placement.gradient.try_inverse().unwrap_or_else(Mat3::identity)
    }

    /// π of an incompressible body.
    pub fn pressure(&mut self, numbers: &[f64], body: usize) -> Option<f64> {
        let state = self.state(numbers);
        observe(&self.model, &mut self.workspace, &state, body).ok()?.pressure
    }

    /// The supports that push or pull at a body while it stands still.
    fn holding(&self, body: usize) -> impl Iterator<Item = usize> {
        let pushes = |term: Term| term.action == Action::Central && term.coefficient != 0.0;
        let contacts = self
            .model
            .contacts_of(body)
            .filter(move |contact| contact.law_set.laws().iter().flat_map(|law| law.terms()).flatten().any(pushes));
        contacts.map(|contact| contact.support)
    }

    /// The normals of the supports that push or pull, and the directions in which guides keep centres.
    pub fn normals(&self) -> Vec<Vec3> {
        let holding = (0..self.count()).flat_map(|body| self.holding(body));
        let guides = self.model.bodies.iter().filter_map(|body| body.guide.as_ref()?.center);
        let kept = guides.flat_map(|center| (0..3).map(move |axis| Vec3::ith(axis, 1.0) - center.column(axis)));
        holding.map(|support| self.model.supports[support].normal).chain(kept).collect()
    }

    /// The gaps of each body.
    pub fn gaps(&mut self, numbers: &[f64]) -> Vec<BodyGaps> {
        let Self { model, workspace, time, .. } = self;
        let is_found = !model.rules().is_empty() && workspace.pair_gaps(model, *time, numbers.into()).is_ok();
        let gaps = |body: usize| {
            let apart = is_found.then(|| self.workspace.found_gaps().of(body).map(|slab| slab.gap));
            let to_others = apart.into_iter().flatten().fold(f64::INFINITY, f64::min);
            BodyGaps { to_supports: self.support_gaps(numbers, body).collect(), to_others }
        };
        (0..self.count()).map(gaps).collect()
    }

    fn support_gaps(&self, numbers: &[f64], body: usize) -> impl Iterator<Item = f64> {
        let motion = self.motion(numbers, body);
        let supports = &self.model.supports;
        let surface = self.model.bodies[body].solid.surface.as_ref();
        surface.into_iter().flat_map(move |surface| {
            let gap =
                move |index: usize| surface.smallest_gap(&supports[index].gap_field(&motion.placement, self.time)).0;
            self.holding(body).map(gap)
        })
    }

    /// Puts quaternions, P and G back to where they belong, and places to the joints; false where that is too far.
    pub fn project(&mut self, numbers: &mut [f64]) -> bool {
        self.project_bodies(numbers);
        if self.model.joints().is_empty() {
            return true;
        }
        let size = self.model.bodies.iter().map(|body| body.size).fold(f64::INFINITY, f64::min);
        let mut last = f64::INFINITY;
        for _ in 0..HOLDS {
            let mut held = Held { time: self.time, high: &mut *numbers, low: &mut [] };
            let Ok(misfit) = self.workspace.hold_places(&self.model, &mut held) else { return false };
            // What bodies themselves keep leaves to second order what joints do.
            self.project_bodies(numbers);
            if misfit >= 0.5 * last || misfit == 0.0 {
                return misfit <= HELD * size;
            }
            last = misfit;
        }
        false
    }

    /// Puts quaternions, P and G back to where they belong.
    fn project_bodies(&self, numbers: &mut [f64]) {
        for (body, kind) in self.model.bodies.iter().map(|body| &body.kind).enumerate() {
            let slots = self.slots(body);
            if self.model.bodies[body].guide.is_some() {
                restore_guided(&self.model.bodies[body], slots, numbers, &mut []);
            }
            let own = matches!(kind, BodyKind::Contractile(it) if it.contraction.is_driven())
                .then(|| matrix(&numbers[slots.extra()]));
            let attitude = &mut numbers[slots.attitude()];
            let still = Mat3::zeros();
            match kind {
                BodyKind::Rigid(_) => {
                    normalize(attitude, &mut []);
                }
                BodyKind::Affine(affine) => {
                    let corrected = affine.interior.project(&matrix(attitude), &still);
                    attitude.copy_from_slice(corrected.gradient.as_slice());
                }
                BodyKind::Contractile(contractile) => {
                    let held = own.unwrap_or_else(Mat3::identity);
                    let restored = contractile.restore(self.time, (&matrix(attitude), &still, &held));
                    attitude.copy_from_slice(restored.gradient.as_slice());
                    if own.is_some() {
                        numbers[slots.extra()].copy_from_slice(restored.contraction.as_slice());
                    }
                }
            }
        }
    }

    /// Whether the contraction of a body moves.
    pub fn is_driven(&self, body: usize) -> bool {
        self.model.bodies[body].contraction().is_some_and(|law| law.is_driven())
    }

    /// Where G of a body stands, if its contraction moves.
    pub fn contraction(&self, body: usize) -> Range<usize> {
        self.slots(body).extra()
    }

    /// V_G of a body [1/s] among the rates of all numbers, if its contraction moves.
    pub fn contraction_velocity(&self, numbers: &[f64], rates: &[f64], body: usize) -> Mat3 {
        let at = self.contraction(body);
        let rate = matrix(&rates[at.clone()]);
        let inverse = matrix(&numbers[at]).try_inverse();
        inverse.map_or(rate, |inverse| rate * inverse)
    }

    /// Where the numbers of a body stand.
    pub fn slots(&self, body: usize) -> &Slots {
        self.model.slots(body)
    }
}

/// The numbers of what joins some bodies, or holds them.
fn numbers_among<J: Interaction>(all: &[J], members: &[usize]) -> Vec<usize> {
    let is_member = |party: Party| party.body().is_none_or(|body| members.binary_search(&body).is_ok());
    let is_among = |number: &usize| all[*number].parties().into_iter().all(is_member);
    (0..all.len()).filter(is_among).collect()
}

/// The block of a body that has inertia and stands, given one without velocities.
fn standing(body: &Body, block: &[f64]) -> Vec<f64> {
    let velocities = Slots::of(body, 0).velocities();
    let (places, extra) = block.split_at(velocities.start);
    [places, &vec![0.0; velocities.len()], extra].concat()
}

/// A body whose signals have the values of the start, and its numbers without velocities.
fn frozen(model: &Model, start: &State, index: usize, contraction: FrozenContraction) -> (Body, Vec<f64>) {
    let mut body = (*model.bodies[index]).clone();
    let slots = model.slots(index);
    let mut block = start.bodies[slots.block()].to_vec();
    if let (false, Some(inclusion)) = (body.has_inertia(), &mut body.inclusion) {
        inclusion.inertia = true;
        block = standing(&body, &block);
    }
    let own = Slots::of(&body, 0);
    block[own.velocities()].fill(0.0);
    if let BodyKind::Contractile(contractile) = &mut body.kind {
        match (&mut contractile.contraction.source, contraction) {
            (ContractionSource::Driven { drive, .. }, FrozenContraction::Driven) => {
                *drive = Signal::Constant(drive.at(start.time));
            }
            (source, _) => {
                if let Some(held) = start.contraction(model, index) {
                    *source = ContractionSource::Prescribed(Signal::Constant(held));
                }
            }
        }
    } else {
        block[own.extra()].fill(0.0);
    }
    block.truncate(body.dimension());
    (body, block)
}
