//! One body alone, with supports, loads and contraction held as they are at the start.

use gyration::Inadmissible;
use gyration::balance::observe;
use gyration::body::{Body, BodyKind};
use gyration::contact::{Action, Term};
use gyration::contractile::Source;
use gyration::fluid::Fluid;
use gyration::jacobian::jacobian;
use gyration::model::Model;
use gyration::rates::{Workspace, meet, rates};
use gyration::signal::Signal;
use gyration::state::{BodyMotion, State};
use gyration::support::SupportMotion;
use gyration::tensor::{Mat3, Vec3};
use nalgebra::DMatrix;

/// A body and what acts on it at one instant.
#[derive(Debug)]
pub(super) struct Held {
    model: Model,
    workspace: Workspace,
    time: f64,
    /// Its index in the scene.
    index: usize,
    /// Its block of the state at the start, without velocities.
    pub start: Vec<f64>,
}

impl Held {
    pub fn new(model: &Model, start: &State, index: usize) -> Self {
        let mut supports = model.supports.clone();
        for support in &mut supports {
            support.origin += support.motion.displacement(start.time);
            support.motion = SupportMotion::Fixed;
        }
        let mut body = model.bodies[index].clone();
        let at_rates = places(&body);
        let mut block = start.bodies[model.blocks()[index].clone()].to_vec();
        block[at_rates..].fill(0.0);
        if let (BodyKind::Contractile(contractile), Some(contraction)) =
            (&mut body.kind, start.contraction(model, index))
        {
            contractile.contraction.source = Source::Prescribed(Signal::Constant(contraction));
        }
        block.truncate(body.dimension());
        let mut held = Model::new(model.gravity, supports, vec![body]);
        held.fluid = model.fluid.as_ref().map(|fluid| {
            let [velocity, gradient] = fluid.signals().map(|signal| Signal::Constant(signal.at(start.time)));
            Fluid { velocity, gradient, ..*fluid }
        });
        let model = held;
        Self { model, workspace: Workspace::default(), time: start.time, index, start: block }
    }

    pub fn body(&self) -> &Body {
        &self.model.bodies[0]
    }

    pub fn gravity(&self) -> Vec3 {
        self.model.gravity
    }

    /// The velocities' rates.
    pub fn accelerations(&mut self, block: &[f64]) -> Result<Vec<f64>, Inadmissible> {
        let mut slopes = vec![0.0; block.len()];
        let mut powers = vec![0.0; self.model.works().len()];
        let done = rates(&self.model, &mut self.workspace, self.time, block, &mut slopes, &mut powers);
        done.map_err(|left| Inadmissible { body: self.index, ..left })?;
        Ok(slopes.split_off(places(self.body())))
    }

    /// The exact Jacobian.
    pub fn slopes(&mut self, block: &[f64]) -> Result<DMatrix<f64>, Inadmissible> {
        let mut blocks = [DMatrix::zeros(block.len(), block.len())];
        let done = jacobian(&self.model, &mut self.workspace, self.time, block, &mut blocks);
        done.map_err(|left| Inadmissible { body: self.index, ..left })?;
        let [slopes] = blocks;
        Ok(slopes)
    }

    pub fn motion(&self, block: &[f64]) -> BodyMotion {
        BodyMotion::unpack(self.body(), block)
    }

    /// π of an incompressible body.
    pub fn pressure(&mut self, block: &[f64]) -> Option<f64> {
        let state = State { time: self.time, bodies: block.to_vec(), works: vec![0.0; self.model.works().len()] };
        observe(&self.model, &mut self.workspace, &state, 0).ok()?.pressure
    }

    /// The supports that push or pull at the body while it stands still.
    fn holding(&self) -> impl Iterator<Item = usize> {
        let pushes = |term: Term| term.action == Action::Central && term.coefficient != 0.0;
        let contacts = self
            .body()
            .contacts
            .iter()
            .filter(move |contact| contact.laws().iter().flat_map(|law| law.terms()).flatten().any(pushes));
        contacts.map(|contact| contact.support)
    }

    /// The normals of the supports that push or pull.
    pub fn normals(&self) -> Vec<Vec3> {
        self.holding().map(|support| self.model.supports[support].normal).collect()
    }

    /// The smallest distances to the supports that push or pull [m].
    pub fn gaps(&self, block: &[f64]) -> Vec<f64> {
        let motion = self.motion(block);
        let Some(surface) = &self.body().surface else { return Vec::new() };
        let gap = |support| surface.smallest_gap(&meet(&self.model, support, self.time, &motion).0).0;
        self.holding().map(gap).collect()
    }

    /// Puts quaternion or P back to where they belong.
    pub fn project(&self, block: &mut [f64]) {
        let body = self.body();
        let at = if body.pin.is_some() { 0 } else { 3 };
        match &body.kind {
            BodyKind::Rigid(_) => {
                let quaternion = &mut block[at..at + 4];
                let norm = quaternion.iter().map(|c| c * c).sum::<f64>().sqrt();
                quaternion.iter_mut().for_each(|c| *c /= norm);
            }
            BodyKind::Affine(affine) => {
                let gradient = Mat3::from_column_slice(&block[at..at + 9]);
                let corrected = affine.interior.project(&gradient, &Mat3::zeros());
                block[at..at + 9].copy_from_slice(corrected.gradient.as_slice());
            }
            BodyKind::Contractile(contractile) => {
                let gradient = Mat3::from_column_slice(&block[at..at + 9]);
                let restored = contractile.restore(self.time, (&gradient, &Mat3::zeros(), &Mat3::identity()));
                block[at..at + 9].copy_from_slice(restored.gradient.as_slice());
            }
        }
    }
}

/// How many numbers of a body's block are places; the rest are velocities.
pub(super) fn places(body: &Body) -> usize {
    match (&body.kind, &body.pin) {
        (BodyKind::Rigid(_), None) => 7,
        (BodyKind::Rigid(_), Some(_)) => 4,
        (BodyKind::Affine(_) | BodyKind::Contractile(_), None) => 12,
        (BodyKind::Affine(_) | BodyKind::Contractile(_), Some(_)) => 9,
    }
}
