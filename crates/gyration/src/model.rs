//! The model: gravity, supports and bodies, frozen for a run.
//!
//! A model and a [`State`](crate::state::State) hold all there is: everything else can be recomputed from them.

use crate::acting::{Interacting, Load, PAIR_ENERGY, PairAt, pair_works};
use crate::body::{Body, Slots, Solid};
use crate::contact::{AreaMeasure, Contact};
use crate::fluid::Fluid;
use crate::ledger::{Energy, Work};
use crate::load::{Applied, Interactions, Spring, SpringEnd};
use crate::neighbours::{BodyPair, Pair, PairRule, PairRules};
use crate::pair::cutoff;
use crate::support::Support;
use crate::tensor::Vec3;
use std::convert::Infallible;
use std::ops::Range;
use std::sync::Arc;

/// What moves, what it meets, and what pulls at it.
#[derive(Debug, Clone)]
pub struct Model {
    /// g, the acceleration of gravity [m/s²].
    pub gravity: Vec3,
    /// The planes.
    pub supports: Arc<[Support]>,
    /// The bodies, which the [parts](Self::part) of a model share with it.
    pub bodies: Vec<Arc<Body>>,
    /// The fluid around them; those that are no inclusions do not feel it.
    pub fluid: Option<Arc<Fluid>>,
    contacts: Interactions<Contact>,
    springs: Interactions<Spring>,
    rules: PairRules,
    /// How many pairs these join, and how many of them however far they are.
    pairs: [usize; 2],
    /// The bodies without inertia, ascending.
    inertialess: Vec<usize>,
    slots: Vec<Slots>,
    blocks: Vec<Range<usize>>,
    works: Vec<Work>,
    energies: Vec<Energy>,
    /// Whether all repulsion and adhesion of the whole model derive from a potential.
    has_potential: bool,
    /// What a controller applies to each body; empty without one.
    applied: Vec<Applied>,
    /// Tells whether nobody waits any longer; the mechanics itself has no clock.
    given_up: Option<fn() -> bool>,
}

/// So many pairs of bodies are looked at, at most, before one asks whether to go on.
pub(crate) const PATIENCE: usize = 1000;

impl Model {
    /// Freezes a model: lays out the state and decides which entries the ledger has.
    pub fn new(
        gravity: Vec3,
        supports: impl Into<Arc<[Support]>>,
        bodies: impl IntoIterator<Item: Into<Arc<Body>>>,
    ) -> Self {
        let supports = supports.into();
        let bodies: Vec<Arc<Body>> = bodies.into_iter().map(Into::into).collect();
        let slots = layout(&bodies);
        let (blocks, inertialess) = (slots.iter().map(Slots::block).collect(), without_inertia(&bodies));
        let (works, energies, applied) = (Vec::new(), Vec::new(), Vec::new());
        let (contacts, springs) = (Interactions::default(), Interactions::default());
        let (fluid, rules) = (None, PairRules::default());
        let model = Self {
            gravity,
            supports,
            bodies,
            fluid,
            contacts,
            springs,
            rules,
            pairs: [0, 0],
            inertialess,
            slots,
            blocks,
            works,
            energies,
            has_potential: true,
            applied,
            given_up: None,
        };
        model.with_ledger()
    }

    /// The model with other bodies in the places of its own, which meet and are held as these were.
    ///
    /// # Panics
    /// If there are more or fewer.
    #[must_use]
    pub fn with_bodies(self, bodies: impl IntoIterator<Item: Into<Arc<Body>>>) -> Self {
        let bodies: Vec<Arc<Body>> = bodies.into_iter().map(Into::into).collect();
        assert_eq!(bodies.len(), self.bodies.len(), "each body has one in its place");
        let slots = layout(&bodies);
        let (blocks, pairs) = (slots.iter().map(Slots::block).collect(), self.rules.count(&bodies));
        let inertialess = without_inertia(&bodies);
        let mut model = Self { bodies, inertialess, slots, blocks, pairs, ..self };
        model.has_potential = model.find_potential();
        model.with_ledger()
    }

    /// The model in a fluid.
    #[must_use]
    pub fn in_fluid(mut self, fluid: impl Into<Arc<Fluid>>) -> Self {
        self.fluid = Some(fluid.into());
        self.with_ledger()
    }

    /// The model with laws between its bodies and its supports.
    ///
    /// To be called when all bodies are what they are to be.
    ///
    /// # Panics
    /// If a contact is not of a body and a support of the model.
    #[must_use]
    pub fn with_contacts(mut self, contacts: Vec<Contact>) -> Self {
        let count = self.supports.len();
        assert!(contacts.iter().all(|contact| contact.support < count), "a contact is with one of {count} supports");
        self.contacts = Interactions::new(self.bodies.len(), contacts);
        self.has_potential = self.find_potential();
        self.with_ledger()
    }

    /// The model with springs, to anchors or between its bodies.
    ///
    /// To be called when all bodies are what they are to be.
    ///
    /// # Panics
    /// If one end of a spring is no body of the model, or the other neither another body nor an anchor.
    #[must_use]
    pub fn with_springs(mut self, springs: Vec<Spring>) -> Self {
        self.springs = Interactions::new(self.bodies.len(), springs);
        self.with_ledger()
    }

    /// The model with bodies that meet.
    ///
    /// To be called when all bodies are what they are to be.
    ///
    /// # Panics
    /// If a rule is not of bodies of the model.
    #[must_use]
    pub fn meeting(mut self, rules: Vec<PairRule>) -> Self {
        self.rules = PairRules::new(self.bodies.len(), rules);
        self.pairs = self.rules.count(&self.bodies);
        self.has_potential = self.find_potential();
        self.with_ledger()
    }

    /// The model under a controller: loads may be applied to its bodies, and the ledger has their work.
    #[must_use]
    pub fn under_control(mut self) -> Self {
        self.applied = vec![Applied::default(); self.bodies.len()];
        self.with_ledger()
    }

    /// The model that asks now and then, where an evaluation takes long, whether it is to be given up.
    #[must_use]
    pub fn asking(mut self, given_up: fn() -> bool) -> Self {
        self.given_up = Some(given_up);
        self
    }

    /// Whether an evaluation would be given up now: of few pairs none is, since it ends soon.
    pub fn is_given_up(&self) -> bool {
        self.pairs[0] >= PATIENCE && self.given_up.is_some_and(|given_up| given_up())
    }

    /// The model of some of its bodies, whose indices ascend: as if there were no others, but with the ledger of all,
    /// as far as it concerns them.
    #[must_use]
    pub fn part(&self, members: &[usize]) -> Self {
        let bodies: Vec<Arc<Body>> = members.iter().map(|body| self.bodies[*body].clone()).collect();
        let slots = layout(&bodies);
        let mut part = Self {
            gravity: self.gravity,
            supports: self.supports.clone(),
            blocks: slots.iter().map(Slots::block).collect(),
            slots,
            inertialess: without_inertia(&bodies),
            bodies,
            fluid: self.fluid.clone(),
            contacts: self.contacts.among(members, Contact::of_parties),
            springs: self.springs.among(members, Spring::of_parties),
            rules: self.rules.among(members),
            pairs: [0, 0],
            works: Vec::new(),
            energies: Vec::new(),
            has_potential: self.has_potential,
            applied: members.iter().filter_map(|body| self.applied.get(*body)).copied().collect(),
            given_up: self.given_up,
        };
        part.pairs = part.rules.count(&part.bodies);
        part.enter_ledger();
        part
    }

    /// The laws between its bodies and its supports.
    pub fn contacts(&self) -> &[Contact] {
        self.contacts.all()
    }

    /// Those of a body, in order.
    pub fn contacts_of(&self, body: usize) -> impl Iterator<Item = &Contact> + Clone {
        self.contacts.of(body).map(|end| end.interaction)
    }

    /// Its springs.
    pub fn springs(&self) -> &[Spring] {
        self.springs.all()
    }

    /// The pairs of bodies that springs join.
    pub fn joined_by_springs(&self) -> impl Iterator<Item = [usize; 2]> {
        self.springs().iter().filter_map(Spring::bodies)
    }

    /// Who of its bodies meets whom.
    pub fn rules(&self) -> &PairRules {
        &self.rules
    }

    /// All pairs that there are, in order: of N bodies some N².
    pub fn pairs(&self) -> impl Iterator<Item = Pair> {
        let rules = self.rules.all().iter().enumerate();
        rules.flat_map(move |(number, rule)| rule.pairs().flat_map(move |bodies| self.pairs_between(number, bodies)))
    }

    /// The pairs of the parts of two bodies that a rule joins, as it orders them.
    pub fn pairs_between(&self, rule: usize, bodies: [usize; 2]) -> impl Iterator<Item = Pair> {
        Pair::all_of(&self.rules, rule, bodies, bodies.map(|body| &self.bodies[body].solid))
    }

    /// How many pairs of parts of bodies meet, and how many of these are looked at however far they are: those of rules
    /// without a reach, and of bodies that deform.
    pub fn count_pairs(&self) -> [usize; 2] {
        self.pairs
    }

    /// The springs of a body, in order.
    pub fn springs_of(&self, body: usize) -> impl Iterator<Item = SpringEnd<'_>> + Clone {
        self.springs.of(body)
    }

    /// So few pairs of bodies that any two that may act on one another through any chain are joined through these.
    pub fn chain(&self) -> impl Iterator<Item = [usize; 2]> {
        self.joined_by_springs().chain(self.rules.all().iter().flat_map(PairRule::chain))
    }

    /// The same of those that act on one another however far they are: through springs, rules without a reach, and
    /// bodies that deform.
    pub fn endless_chain(&self) -> impl Iterator<Item = [usize; 2]> {
        let deforms = |body: usize| self.bodies[body].affine().is_some();
        let rules = self.rules.all().iter().flat_map(move |rule| {
            let is_endless = move |pair: &[usize; 2]| rule.reach.is_none() || pair.iter().any(|body| deforms(*body));
            // Beside one that deforms each other one of its set needs a single partner.
            let of_set = move |own: usize| {
                let deforming = rule.bodies[own].iter().copied().filter(move |body| deforms(*body));
                deforming.enumerate().flat_map(move |(k, body)| {
                    let partners = rule.bodies[1 - own].iter().map(move |other| [body, *other]);
                    partners.filter(|[one, other]| one != other).take(if k == 0 { usize::MAX } else { 1 })
                })
            };
            rule.chain().filter(is_endless).chain(of_set(0)).chain(of_set(1))
        });
        self.joined_by_springs().chain(rules)
    }

    /// Whether there are bodies that act on one another within a distance only.
    pub fn has_cutoffs(&self) -> bool {
        let is_rigid = |body: &&usize| self.bodies[**body].affine().is_none();
        self.rules.all().iter().filter(|rule| rule.reach.is_some()).any(|rule| {
            let [one, other] = [0, 1].map(|set| rule.bodies[set].iter().filter(is_rigid).take(2));
            one.flat_map(|one| other.clone().map(move |other| (one, other))).any(|(one, other)| one != other)
        })
    }

    /// The distance of the centres from which on two bodies do nothing to each other by a rule [m]; none if there is
    /// none, as where one of them deforms.
    pub fn cutoff(&self, pair: &BodyPair) -> Option<f64> {
        let bodies = pair.bodies.map(|body| &self.bodies[body]);
        if bodies.iter().any(|body| body.affine().is_some()) {
            return None;
        }
        let solids = bodies.map(|body| &*body.solid);
        let of_parts = |parts: [usize; 2]| {
            let reach = self.rules.all()[pair.rule].reach_between(solids, parts)?;
            Some(cutoff(reach, [0, 1].map(|end| solids[end].part_radius(parts[end]))))
        };
        Solid::parts_of(solids).filter_map(of_parts).reduce(f64::max)
    }

    /// Whether a body has a contact, with a support or another body.
    pub fn has_contact(&self, body: usize) -> bool {
        self.contacts.of(body).next().is_some() || self.meets_bodies(body)
    }

    /// Whether a body meets others.
    pub fn meets_bodies(&self, body: usize) -> bool {
        !self.rules.of(body).is_empty()
    }

    /// Whether other bodies act on a body; springs without stiffness and damping do not.
    pub fn is_joined(&self, body: usize) -> bool {
        let acts = |end: SpringEnd| end.other().body().is_some() && end.interaction.law.acts();
        self.springs.of(body).any(acts) || self.meets_bodies(body)
    }

    /// Hands what acts on a body beside those that it meets to `each`, in the order in which it is summed; stops at the
    /// first error.
    #[inline]
    pub fn try_each_load<'a, E>(&'a self, index: usize, each: impl FnMut(Load<'a>) -> Result<(), E>) -> Result<(), E> {
        self.try_each_load_with(index, std::iter::empty(), each)
    }

    /// The same with the pairs of the body at an instant.
    #[inline]
    pub(crate) fn try_each_load_with<'a, E>(
        &'a self,
        index: usize,
        pairs: impl Iterator<Item = PairAt<'a>>,
        each: impl FnMut(Load<'a>) -> Result<(), E>,
    ) -> Result<(), E> {
        let (body, fluid) = (&self.bodies[index], self.fluid.as_deref());
        let (contacts, springs) = (self.contacts_of(index), self.springs_of(index));
        Load::try_each(body, Interacting { contacts, springs, pairs }, fluid, self.applied(index), each)
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

    /// The indices of the bodies without inertia, ascending.
    pub fn inertialess(&self) -> &[usize] {
        &self.inertialess
    }

    /// Where the numbers of a body stand in the state.
    pub fn slots(&self, body: usize) -> &Slots {
        &self.slots[body]
    }

    /// Where each body's numbers stand in the state, as a whole.
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

    /// Decides which entries the ledger has: those of kinds and loads, repulsion and adhesion either as an energy or as
    /// works.
    fn with_ledger(mut self) -> Self {
        self.enter_ledger();
        self
    }

    /// Whether all repulsion and adhesion that act have a potential: on rigid bodies, and in two of the three measures.
    fn find_potential(&self) -> bool {
        let deforms = |body: usize| self.bodies[body].affine().is_some();
        let contacts = self.contacts().iter().filter(|contact| deforms(contact.body)).all(|contact| {
            let acts = contact.law_set.laws().iter().any(|law| law.kind().is_central());
            contact.law_set.measure != AreaMeasure::DeformedArea || !acts
        });
        let is_rigid = |rule: &PairRule| !rule.chain().flatten().any(deforms);
        let rules = self.rules.all();
        contacts && rules.iter().all(|rule| rule.laws.measure != AreaMeasure::DeformedArea || is_rigid(rule))
    }

    fn enter_ledger(&mut self) {
        let potential = self.has_potential;
        let mut loads: Vec<Load> = Vec::new();
        for index in 0..self.bodies.len() {
            let Ok(()) = self.try_each_load(index, |load| {
                loads.push(load);
                Ok::<(), Infallible>(())
            });
        }
        let of_rules = self.rules.all().iter().flat_map(|rule| pair_works(&rule.laws));
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

/// The bodies without inertia.
fn without_inertia(bodies: &[Arc<Body>]) -> Vec<usize> {
    (0..bodies.len()).filter(|body| !bodies[*body].has_inertia()).collect()
}

fn layout(bodies: &[Arc<Body>]) -> Vec<Slots> {
    let mut start = 0;
    let slots = bodies.iter().map(|body| {
        let slots = Slots::of(body, start);
        start = slots.block().end;
        slots
    });
    slots.collect()
}
