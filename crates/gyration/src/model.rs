//! The model: gravity, supports and bodies, frozen for a run.
//!
//! A model and a [`State`](crate::state::State) hold all there is: everything else can be recomputed from them.

use crate::body::Body;
use crate::contact::{AreaMeasure, LawKind};
use crate::fluid::Fluid;
use crate::ledger::{Energy, Work};
use crate::load::Applied;
use crate::support::{Support, SupportMotion};
use crate::tensor::Vec3;
use std::ops::Range;

/// What moves, what it meets, and what pulls at it.
#[derive(Debug, Clone)]
pub struct Model {
    /// g, the acceleration of gravity [m/s²].
    pub gravity: Vec3,
    /// The planes.
    pub supports: Vec<Support>,
    /// The bodies.
    pub bodies: Vec<Body>,
    /// The fluid around them; those that are no inclusions do not feel it.
    pub fluid: Option<Fluid>,
    blocks: Vec<Range<usize>>,
    works: Vec<Work>,
    energies: Vec<Energy>,
    /// What a controller applies to each body; empty without one.
    applied: Vec<Applied>,
}

impl Model {
    /// Freezes a model: lays out the state and decides which entries the ledger has.
    pub fn new(gravity: Vec3, supports: Vec<Support>, bodies: Vec<Body>) -> Self {
        let blocks = layout(&bodies);
        let works = works(&supports, &bodies, false);
        let energies = energies(&bodies);
        Self { gravity, supports, bodies, fluid: None, blocks, works, energies, applied: Vec::new() }
    }

    /// The model in a fluid.
    #[must_use]
    pub fn in_fluid(mut self, fluid: Fluid) -> Self {
        self.fluid = Some(fluid);
        self
    }

    /// The model under a controller: loads may be applied to its bodies, and the ledger has their work.
    #[must_use]
    pub fn under_control(mut self) -> Self {
        self.works = works(&self.supports, &self.bodies, true);
        self.applied = vec![Applied::default(); self.bodies.len()];
        self
    }

    /// Whether loads may be applied to its bodies.
    pub fn is_controlled(&self) -> bool {
        !self.applied.is_empty()
    }

    /// What is applied to a body; none without a controller.
    pub fn applied(&self, body: usize) -> Option<&Applied> {
        self.applied.get(body)
    }

    /// Applies a load to a body until another is applied; whether there is a controller.
    #[must_use]
    pub fn apply(&mut self, body: usize, load: Applied) -> bool {
        self.applied.get_mut(body).map(|applied| *applied = load).is_some()
    }

    /// Where each body's numbers stand in the state.
    pub fn blocks(&self) -> &[Range<usize>] {
        &self.blocks
    }

    /// How many numbers the state has.
    pub fn dimension(&self) -> usize {
        self.blocks.last().map_or(0, |block| block.end)
    }

    /// The works that the ledger integrates, in the order of its columns.
    pub fn works(&self) -> &[Work] {
        &self.works
    }

    /// Whether repulsion and adhesion stand among the works, also those of rigid bodies: some body has no potential.
    pub(crate) fn central_laws_work(&self) -> bool {
        self.works.iter().any(|work| matches!(work, Work::Repulsion | Work::Adhesion))
    }

    /// The energies that the ledger has, in the order of its columns.
    pub fn energies(&self) -> &[Energy] {
        &self.energies
    }
}

fn layout(bodies: &[Body]) -> Vec<Range<usize>> {
    let mut start = 0;
    bodies
        .iter()
        .map(|body| {
            let block = start..start + body.dimension();
            start = block.end;
            block
        })
        .collect()
}

fn has_law(bodies: &[Body], kinds: &[LawKind]) -> bool {
    let mut laws = bodies.iter().flat_map(|body| &body.contacts).flat_map(|contact| contact.laws());
    laws.any(|law| kinds.contains(&law.kind()))
}

fn works(supports: &[Support], bodies: &[Body], controlled: bool) -> Vec<Work> {
    let moving = |index: usize| supports[index].motion != SupportMotion::Fixed;
    let dashpots = bodies.iter().flat_map(|body| &body.springs).any(|spring| spring.damping > 0.0);
    let carried = bodies.iter().flat_map(|body| &body.contacts).any(|contact| moving(contact.support));
    let affine = || bodies.iter().filter_map(Body::affine);
    let contracting = || bodies.iter().filter_map(Body::contraction);
    let resisted = affine().flat_map(|affine| &affine.resistances).any(|load| load.dissipates());
    let works_alone = !has_potential(bodies);
    [
        (Work::Repulsion, works_alone && has_law(bodies, &[LawKind::Repulsion])),
        (Work::Damping, has_law(bodies, &[LawKind::Damping])),
        (Work::Friction, has_law(bodies, &[LawKind::Friction])),
        (Work::Adhesion, works_alone && has_law(bodies, &[LawKind::Adhesion])),
        (Work::Viscosity, resisted || affine().any(|affine| affine.interior.dissipates())),
        (Work::Contraction, contracting().any(|contraction| contraction.viscosity > 0.0)),
        (Work::Drive, contracting().next().is_some()),
        (Work::Load, controlled || dashpots || affine().any(|affine| affine.couple.is_some())),
        (Work::Support, carried),
        (Work::Fluid, bodies.iter().any(|body| body.inclusion.is_some())),
        (Work::Constraint, affine().any(|affine| affine.interior.is_incompressible())),
    ]
    .into_iter()
    .filter_map(|(work, applies)| applies.then_some(work))
    .collect()
}

/// Whether all repulsion and adhesion that act have a potential: on rigid bodies, and in two of the three measures.
fn has_potential(bodies: &[Body]) -> bool {
    let central = [LawKind::Repulsion, LawKind::Adhesion];
    let deforming = bodies.iter().filter(|body| body.affine().is_some());
    let mut contacts = deforming.flat_map(|body| &body.contacts);
    contacts.all(|contact| {
        let acts = contact.laws().iter().any(|law| central.contains(&law.kind()));
        contact.measure != AreaMeasure::DeformedArea || !acts
    })
}

fn energies(bodies: &[Body]) -> Vec<Energy> {
    let springs = bodies.iter().any(|body| !body.springs.is_empty());
    let elastic = bodies.iter().filter_map(Body::affine).any(|affine| affine.interior.material.is_some());
    let central = has_law(bodies, &[LawKind::Repulsion, LawKind::Adhesion]);
    [
        (Energy::Kinetic, true),
        (Energy::Gravity, true),
        (Energy::Elastic, elastic),
        (Energy::Contact, central && has_potential(bodies)),
        (Energy::Load, springs),
    ]
    .into_iter()
    .filter_map(|(energy, applies)| applies.then_some(energy))
    .collect()
}
