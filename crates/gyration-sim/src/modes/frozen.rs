//! A frozen body: one body alone, with supports, loads and drive as they are at the start; its contraction is held, or
//! moves by its law.

use crate::projection::normalize;
use gyration::balance::observe;
use gyration::body::{Body, BodyKind, Slots, matrix};
use gyration::contact::{Action, Term};
use gyration::contractile::ContractionSource;
use gyration::dynamics::{Workspace, jacobian, rates};
use gyration::fluid::Fluid;
use gyration::model::Model;
use gyration::signal::Signal;
use gyration::state::{BodyMotion, State};
use gyration::support::SupportMotion;
use gyration::tensor::{Mat3, Vec3};
use gyration::{Inadmissible, Quantity};
use nalgebra::DMatrix;
use std::ops::Range;

/// A body and what acts on it at one instant.
#[derive(Debug)]
pub(super) struct FrozenBody {
    model: Model,
    workspace: Workspace,
    time: f64,
    /// Its index in the scene.
    index: usize,
    /// The numbers in the scene of the springs that hold it.
    springs: Vec<usize>,
    /// Its block of the state at the start, without velocities.
    pub start: Vec<f64>,
    evaluations: usize,
}

/// What the contraction of a frozen body does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FrozenContraction {
    /// It stays what it is at the start.
    Held,
    /// It follows its law under the drive of the start, and what feedback adds.
    Driven,
}

impl FrozenBody {
    pub fn new(model: &Model, start: &State, index: usize, contraction: FrozenContraction) -> Self {
        let mut supports = model.supports.to_vec();
        for support in &mut supports {
            support.origin += support.motion.displacement(start.time);
            support.motion = SupportMotion::Fixed;
        }
        let mut body = (*model.bodies[index]).clone();
        let slots = model.slots(index);
        let mut still = start.bodies.clone();
        still[slots.velocities()].fill(0.0);
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
            still[slots.extra()].fill(0.0);
        }
        let mut block = still[slots.block()].to_vec();
        block.truncate(body.dimension());
        let alone = model.part(&[index]);
        let frozen = Model::new(model.gravity, supports, vec![body]);
        let mut frozen = frozen.with_contacts(alone.contacts().to_vec()).with_springs(alone.springs().to_vec());
        if let Some(fluid) = &model.fluid {
            let [velocity, gradient] = fluid.signals().map(|signal| Signal::Constant(signal.at(start.time)));
            frozen = frozen.in_fluid(Fluid { velocity, gradient, ..(**fluid).clone() });
        }
        let held = model.springs_of(index).filter(|end| end.other().body().is_none());
        let springs = held.map(|end| end.number).collect();
        let model = frozen;
        Self { model, workspace: Workspace::default(), time: start.time, index, springs, start: block, evaluations: 0 }
    }

    /// How often forces or their derivatives have been computed.
    pub fn evaluations(&self) -> usize {
        self.evaluations
    }

    pub fn body(&self) -> &Body {
        &self.model.bodies[0]
    }

    /// Whether a spring to an anchor holds it.
    pub fn is_sprung(&self) -> bool {
        self.model.springs().iter().any(|spring| spring.law.stiffness > 0.0)
    }

    pub fn gravity(&self) -> Vec3 {
        self.model.gravity
    }

    /// What is outside of the model, as the scene numbers it.
    fn outside(&self, left: Inadmissible) -> Inadmissible {
        let quantity = match left.quantity {
            Quantity::SpringLength { spring } => Quantity::SpringLength { spring: self.springs[spring] },
            other => other,
        };
        Inadmissible { body: self.index, quantity, ..left }
    }

    /// The velocities' rates.
    pub fn accelerations(&mut self, block: &[f64]) -> Result<Vec<f64>, Inadmissible> {
        let rates = self.rates(block)?;
        Ok(rates[self.slots().velocities()].to_vec())
    }

    /// The rates of the block.
    pub fn rates(&mut self, block: &[f64]) -> Result<Vec<f64>, Inadmissible> {
        self.evaluations += 1;
        let mut slopes = vec![0.0; block.len()];
        let mut powers = vec![0.0; self.model.works().len()];
        let done = rates(&self.model, &mut self.workspace, self.time, block.into(), &mut slopes, &mut powers);
        done.map_err(|left| self.outside(left))?;
        Ok(slopes)
    }

    /// The exact Jacobian.
    pub fn slopes(&mut self, block: &[f64]) -> Result<DMatrix<f64>, Inadmissible> {
        self.evaluations += 1;
        let mut blocks = [DMatrix::zeros(block.len(), block.len())];
        let done = jacobian(&self.model, &mut self.workspace, self.time, block.into(), &mut blocks[..]);
        done.map_err(|left| self.outside(left))?;
        let [slopes] = blocks;
        Ok(slopes)
    }

    pub fn motion(&self, block: &[f64]) -> BodyMotion {
        BodyMotion::read(self.body(), self.slots(), block)
    }

    /// π of an incompressible body.
    pub fn pressure(&mut self, block: &[f64]) -> Option<f64> {
        let state = State {
            time: self.time,
            bodies: block.to_vec(),
            low: Vec::new(),
            works: vec![0.0; self.model.works().len()],
        };
        observe(&self.model, &mut self.workspace, &state, 0).ok()?.pressure
    }

    /// The supports that push or pull at the body while it stands still.
    fn holding(&self) -> impl Iterator<Item = usize> {
        let pushes = |term: Term| term.action == Action::Central && term.coefficient != 0.0;
        let contacts = self
            .model
            .contacts()
            .iter()
            .filter(move |contact| contact.law_set.laws().iter().flat_map(|law| law.terms()).flatten().any(pushes));
        contacts.map(|contact| contact.support)
    }

    /// The normals of the supports that push or pull.
    pub fn normals(&self) -> Vec<Vec3> {
        self.holding().map(|support| self.model.supports[support].normal).collect()
    }

    /// The smallest distances to the supports that push or pull [m].
    pub fn gaps(&self, block: &[f64]) -> Vec<f64> {
        let motion = self.motion(block);
        let Some(surface) = &self.body().solid.surface else { return Vec::new() };
        let supports = &self.model.supports;
        let gap = |index: usize| surface.smallest_gap(&supports[index].gap_field(&motion.placement, self.time)).0;
        self.holding().map(gap).collect()
    }

    /// Puts quaternion, P and G back to where they belong.
    pub fn project(&self, block: &mut [f64]) {
        let own = matches!(&self.body().kind, BodyKind::Contractile(it) if it.contraction.is_driven())
            .then(|| matrix(&block[self.contraction()]));
        let attitude = &mut block[self.slots().attitude()];
        let still = Mat3::zeros();
        match &self.body().kind {
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
                    block[self.contraction()].copy_from_slice(restored.contraction.as_slice());
                }
            }
        }
    }

    /// Where P stands in the block.
    pub fn attitude(&self) -> Range<usize> {
        self.slots().attitude()
    }

    /// Where G stands in the block, if the contraction moves.
    pub fn contraction(&self) -> Range<usize> {
        self.slots().extra()
    }

    /// G, if the contraction moves.
    pub fn contraction_at(&self, block: &[f64]) -> Mat3 {
        matrix(&block[self.contraction()])
    }

    /// V_G [1/s], if the contraction moves.
    pub fn contraction_velocity(&mut self, block: &[f64]) -> Result<Mat3, Inadmissible> {
        let rate = matrix(&self.rates(block)?[self.contraction()]);
        let inverse = self.contraction_at(block).try_inverse();
        Ok(inverse.map_or(rate, |inverse| rate * inverse))
    }

    /// Where the numbers of the block stand.
    fn slots(&self) -> &Slots {
        self.model.slots(0)
    }
}
