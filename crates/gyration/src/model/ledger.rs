//! Which entries the ledger of a model has.

use super::Model;
use crate::acting::{Load, PAIR_ENERGY, pair_works};
use crate::contact::AreaMeasure;
use crate::ledger::{Energy, Work};
use crate::neighbours::PairRule;
use std::convert::Infallible;

impl Model {
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

    /// Decides which entries the ledger has: those of kinds and loads, repulsion and adhesion either as an energy or as
    /// works.
    pub(super) fn with_ledger(mut self) -> Self {
        self.enter_ledger();
        self
    }

    /// Whether what acts along normals has a potential, and no work.
    pub(crate) fn has_potential(&self) -> bool {
        self.has_potential
    }

    /// Whether all repulsion and adhesion that act have a potential: on rigid bodies, and in two of the three measures.
    pub(super) fn find_potential(&self) -> bool {
        let deforms = |body: usize| self.bodies[body].affine().is_some();
        let contacts = self.contacts().iter().filter(|contact| deforms(contact.body)).all(|contact| {
            let acts = contact.law_set.laws().iter().any(|law| law.kind().is_central());
            contact.law_set.measure != AreaMeasure::DeformedArea || !acts
        });
        let is_rigid = |rule: &PairRule| !rule.members().any(deforms);
        let rules = self.rules.all();
        contacts && rules.iter().all(|rule| rule.laws.measure != AreaMeasure::DeformedArea || is_rigid(rule))
    }

    pub(super) fn enter_ledger(&mut self) {
        let potential = self.has_potential;
        let mut loads: Vec<Load> = Vec::new();
        for index in 0..self.bodies.len() {
            let Ok(()) = self.try_each_load(index, |load| {
                loads.push(load);
                Ok::<(), Infallible>(())
            });
        }
        let of_rules = self.rules.all().iter().flat_map(|rule| pair_works(rule, &self.solid_supports));
        let works = loads.iter().flat_map(|load| load.works(&self.supports)).chain(of_rules);
        let works = works.filter(|work| !(potential && matches!(work, Work::Repulsion | Work::Adhesion)));
        let works: Vec<Work> = works.chain(self.bodies.iter().flat_map(|body| body.kind.works())).collect();
        let of_rules = (!self.rules.is_empty()).then_some(PAIR_ENERGY);
        let energies = loads.iter().filter_map(Load::energy).chain(of_rules);
        let energies = energies.filter(|energy| potential || *energy != Energy::Contact);
        let elastic = self.bodies.iter().filter_map(|body| body.kind.energy());
        let energies: Vec<Energy> =
            [Energy::Kinetic, Energy::Gravity].into_iter().chain(energies).chain(elastic).collect();
        self.works = Work::ALL.into_iter().filter(|work| works.contains(work)).collect();
        self.energies = Energy::ALL.into_iter().filter(|energy| energies.contains(energy)).collect();
    }
}
