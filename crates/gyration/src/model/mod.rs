//! The model: gravity, supports and bodies, frozen for a run.
//!
//! A model and a [`State`](crate::state::State) hold all there is: everything else can be recomputed from them.

mod build;
mod chains;
mod deformed;
mod driven;
mod ledger;
mod negligible;
mod part;
mod parties;

pub use chains::Cutoff;

use crate::acting::{Interacting, Load, PairAt};
use crate::body::{Body, Slots};
use crate::contact::Contact;
use crate::fluid::{Fluid, ImmersedSpheres};
use crate::joint::{Joint, JointEnd, JointGraph};
use crate::lattice::Lattice;
use crate::ledger::{Energy, Work};
use crate::load::{Applied, Bond, BondEnd, Interactions, Spring, SpringEnd};
use crate::neighbours::{ImagePairs, Pair, PairRules};
use crate::solid_support::SolidSupport;
use crate::support::Support;
use crate::tensor::Vec3;
use std::ops::Range;
use std::sync::Arc;

/// What moves, what it meets, and what pulls at it.
#[derive(Debug, Clone)]
pub struct Model {
    /// g, the acceleration of gravity [m/s²].
    pub gravity: Vec3,
    /// The planes.
    pub supports: Arc<[Support]>,
    /// The supports with a shape.
    pub solid_supports: Arc<[SolidSupport]>,
    /// The bodies, which the [parts](Self::part) of a model share with it.
    pub bodies: Vec<Arc<Body>>,
    /// What they are called.
    names: Vec<Arc<str>>,
    /// The fluid around them; those that are no inclusions do not feel it.
    pub fluid: Option<Arc<Fluid>>,
    /// Those that feel one another through it; none of fewer than two.
    spheres: Option<Arc<ImmersedSpheres>>,
    /// The cells of which they are; no vectors where there is no lattice.
    pub lattice: Arc<Lattice>,
    /// Where the cell of each body is [m]; empty without a lattice.
    origins: Arc<[Vec3]>,
    /// Where each body is at rest, in its cell [m]; empty where that is not known.
    at_rest: Arc<[Vec3]>,
    contacts: Interactions<Contact>,
    springs: Interactions<Spring>,
    bonds: Interactions<Bond>,
    joints: Interactions<Joint>,
    /// Who hangs together through joints; none without any.
    joint_graph: Option<Arc<JointGraph>>,
    rules: PairRules,
    /// The pairs across cells; none where no bodies of a lattice meet.
    images: Option<ImagePairs>,
    /// The pairs with supports that have a shape.
    with_supports: Arc<[Pair]>,
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
        let (contacts, springs, bonds) = (Interactions::default(), Interactions::default(), Interactions::default());
        let (fluid, rules, spheres) = (None, PairRules::default(), immersed_spheres(&bodies));
        let model = Self {
            gravity,
            supports,
            solid_supports: Arc::from([]),
            names: vec![Arc::from("body"); bodies.len()],
            bodies,
            fluid,
            spheres,
            lattice: Arc::default(),
            origins: Arc::from([]),
            at_rest: Arc::from([]),
            contacts,
            springs,
            bonds,
            joints: Interactions::default(),
            joint_graph: None,
            rules,
            images: None,
            with_supports: Arc::from([]),
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

    /// Where a body is at rest [m], in its own cell; none where that is not known.
    pub fn rest_place(&self, body: usize) -> Option<Vec3> {
        self.at_rest.get(body).copied()
    }

    /// The name of a body.
    pub fn name(&self, body: usize) -> &str {
        &self.names[body]
    }

    /// The names of its bodies, in their order.
    pub fn names(&self) -> impl ExactSizeIterator<Item = &str> + Clone {
        self.names.iter().map(|name| &**name)
    }

    /// The body of a name.
    pub fn find_body(&self, name: &str) -> Option<usize> {
        self.names().position(|known| known == name)
    }

    /// The place in space [m] of one in the cell of a body.
    pub fn in_space(&self, body: usize, place: &Vec3) -> Vec3 {
        self.origins.get(body).map_or(*place, |origin| place + origin)
    }

    /// The place in the cell of a body [m] of one in space.
    pub fn in_cell(&self, body: usize, place: &Vec3) -> Vec3 {
        self.origins.get(body).map_or(*place, |origin| place - origin)
    }

    /// The pairs across cells; none where no bodies of a lattice meet.
    pub fn images(&self) -> Option<&ImagePairs> {
        self.images.as_ref()
    }

    /// Whether an evaluation would be given up now: of few pairs none is, since it ends soon.
    pub fn is_given_up(&self) -> bool {
        self.pairs[0] >= PATIENCE && self.given_up.is_some_and(|given_up| given_up())
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

    /// Its bonds.
    pub fn bonds(&self) -> &[Bond] {
        self.bonds.all()
    }

    /// Those of a body, in order.
    pub fn bonds_of(&self, body: usize) -> impl Iterator<Item = BondEnd<'_>> + Clone {
        self.bonds.of(body)
    }

    /// Its joints.
    pub fn joints(&self) -> &[Joint] {
        self.joints.all()
    }

    /// Those of a body, in order.
    pub fn joints_of(&self, body: usize) -> impl Iterator<Item = JointEnd<'_>> + Clone {
        self.joints.of(body)
    }

    /// Who hangs together through joints; none without any.
    pub fn joint_graph(&self) -> Option<&Arc<JointGraph>> {
        self.joint_graph.as_ref()
    }

    /// The bodies that feel one another through the fluid, if there are any.
    pub fn spheres(&self) -> Option<&ImmersedSpheres> {
        self.spheres.as_deref().filter(|_| self.fluid.is_some())
    }

    /// The bodies that a body feels through the fluid.
    pub fn felt_in_fluid(&self, body: usize) -> impl Iterator<Item = usize> + '_ {
        let spheres = self.spheres().filter(|spheres| spheres.place(body).is_some());
        spheres.into_iter().flat_map(ImmersedSpheres::bodies).copied().filter(move |other| *other != body)
    }

    /// The pairs of bodies that springs, bonds and joints join.
    pub fn joined(&self) -> impl Iterator<Item = [usize; 2]> {
        let springs = self.springs().iter().filter_map(Spring::bodies);
        let bonds = self.bonds().iter().map(|bond| bond.bodies);
        springs.chain(bonds).chain(self.joints().iter().filter_map(Joint::bodies))
    }

    /// Who of its bodies meets whom.
    pub fn rules(&self) -> &PairRules {
        &self.rules
    }

    /// All pairs of bodies that there are, in order: of N bodies some N².
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

    /// Whether a body has a contact, with a support or another body.
    pub fn has_contact(&self, body: usize) -> bool {
        self.contacts.of(body).next().is_some() || self.has_pairs(body)
    }

    /// Whether a body meets others.
    pub fn meets_bodies(&self, body: usize) -> bool {
        self.images.as_ref().map_or_else(|| !self.rules.of(body).is_empty(), |images| images.meets(body))
    }

    /// Whether other bodies act on a body; springs without stiffness and damping do not.
    pub fn is_joined(&self, body: usize) -> bool {
        let acts = |end: SpringEnd| end.other().body().is_some() && end.interaction.law.acts();
        let is_linked = self.joints.of(body).any(|end| end.other().body().is_some());
        let is_felt = self.felt_in_fluid(body).next().is_some();
        let is_bound = self.springs.of(body).any(acts) || self.bonds.of(body).next().is_some();
        is_bound || is_linked || is_felt || self.meets_bodies(body)
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
        mut each: impl FnMut(Load<'a>) -> Result<(), E>,
    ) -> Result<(), E> {
        let (body, fluid) = (&self.bodies[index], self.fluid.as_deref());
        let (contacts, springs, bonds) = (self.contacts_of(index), self.springs_of(index), self.bonds_of(index));
        let joints = self.joints_of(index);
        let interactions = Interacting { contacts, springs, bonds, pairs, joints };
        Load::try_each(body, interactions, fluid, self.applied(index), &mut each)?;
        // What most bodies know without a look at the list.
        let neighbours = body.inclusion.as_ref().and_then(|inclusion| inclusion.neighbours);
        match self.spheres().filter(|_| neighbours.is_some()).and_then(|spheres| spheres.place(index)) {
            Some(place) => each(Load::Neighbours(place)),
            None => Ok(()),
        }
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
}

/// The spheres that feel one another through a fluid.
fn immersed_spheres(bodies: &[Arc<Body>]) -> Option<Arc<ImmersedSpheres>> {
    let radius = |(index, body): (usize, &Arc<Body>)| Some((index, body.inclusion.as_ref()?.neighbours?));
    ImmersedSpheres::of(bodies.iter().enumerate().filter_map(radius)).map(Arc::new)
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
