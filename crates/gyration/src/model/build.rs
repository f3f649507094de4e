//! A model piece by piece: what stands between its bodies, and what surrounds them.

use super::{Model, immersed_spheres, layout, without_inertia};
use crate::body::{Body, Slots};
use crate::contact::Contact;
use crate::fluid::Fluid;
use crate::joint::{Joint, JointGraph};
use crate::lattice::Lattice;
use crate::load::{Applied, Bond, Interaction, Interactions, Party, Spring};
use crate::neighbours::{ImagePairs, PairRule, PairRules};
use crate::solid_support::SolidSupport;
use crate::tensor::Vec3;
use std::sync::Arc;

impl Model {
    /// The model whose bodies rest at these places [m], each in its own cell.
    #[must_use]
    pub fn resting_at(self, places: impl Into<Arc<[Vec3]>>) -> Self {
        Self { at_rest: places.into(), ..self }
    }

    /// The model with names for its bodies, which are all called "body" else.
    ///
    /// # Panics
    /// If there are more or fewer.
    #[must_use]
    pub fn named(mut self, names: impl IntoIterator<Item: Into<Arc<str>>>) -> Self {
        self.names = names.into_iter().map(Into::into).collect();
        assert_eq!(self.names.len(), self.bodies.len(), "each body has a name");
        self
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
        let blocks = slots.iter().map(Slots::block).collect();
        let (inertialess, spheres) = (without_inertia(&bodies), immersed_spheres(&bodies));
        let mut model = Self { bodies, inertialess, spheres, slots, blocks, ..self };
        model.find_pairs();
        model.has_potential = model.find_potential();
        model.with_ledger()
    }

    /// The model with supports that have a shape, which rules may name.
    #[must_use]
    pub fn with_solid_supports(self, supports: impl Into<Arc<[SolidSupport]>>) -> Self {
        Self { solid_supports: supports.into(), ..self }
    }

    /// The model in a fluid.
    #[must_use]
    pub fn in_fluid(mut self, fluid: impl Into<Arc<Fluid>>) -> Self {
        self.fluid = Some(fluid.into());
        self.with_ledger()
    }

    /// The model in a lattice.
    #[must_use]
    pub fn in_lattice(self, lattice: impl Into<Arc<Lattice>>) -> Self {
        Self { lattice: lattice.into(), ..self }
    }

    /// The model whose bodies have their places in cells that begin there [m].
    ///
    /// # Panics
    /// If there are neither none nor as many as bodies.
    #[must_use]
    pub fn beginning_at(self, origins: impl Into<Arc<[Vec3]>>) -> Self {
        let origins = origins.into();
        assert!(origins.is_empty() || origins.len() == self.bodies.len(), "each body is in a cell");
        Self { origins, ..self }
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

    /// The model with bonds between its bodies.
    ///
    /// To be called when all bodies are what they are to be.
    ///
    /// # Panics
    /// If one end of a bond is no body of the model, or has no inertia, or both are one in the same cell.
    #[must_use]
    pub fn with_bonds(mut self, bonds: Vec<Bond>) -> Self {
        // A balance without inertia does not ask bonds again.
        let moves = |body: &usize| self.bodies[*body].has_inertia();
        assert!(bonds.iter().flat_map(|bond| &bond.bodies).all(moves), "bodies with bonds have inertia");
        self.bonds = Interactions::new(self.bodies.len(), bonds);
        self.with_ledger()
    }

    /// The model with joints, to space or between its bodies.
    ///
    /// To be called when all bodies are what they are to be.
    ///
    /// # Panics
    /// If the first party of a joint is no body of the model, or the second neither another body nor space, or one has
    /// no inertia.
    #[must_use]
    pub fn with_joints(mut self, joints: Vec<Joint>) -> Self {
        let moves = |body: &usize| self.bodies[*body].has_inertia();
        let bodies = joints.iter().flat_map(|joint| joint.parties().into_iter().filter_map(Party::body));
        assert!(bodies.collect::<Vec<_>>().iter().all(moves), "bodies with joints have inertia");
        self.joint_graph = JointGraph::of(&joints).map(Arc::new);
        self.joints = Interactions::new(self.bodies.len(), joints);
        self.with_ledger()
    }

    /// The model with bodies that meet.
    ///
    /// To be called when all bodies are what they are to be.
    ///
    /// # Panics
    /// If a rule is not of bodies and supports of the model.
    #[must_use]
    pub fn meeting(mut self, rules: Vec<PairRule>) -> Self {
        self.rules = PairRules::new(self.bodies.len(), rules);
        self.find_pairs();
        self.has_potential = self.find_potential();
        self.with_ledger()
    }

    /// The model whose bodies meet by these rules across the cells of its lattice, those that are listed and no others.
    ///
    /// # Panics
    /// If a rule is not of bodies of the model.
    #[must_use]
    pub fn meeting_images(self, rules: Vec<PairRule>, images: ImagePairs) -> Self {
        Self { images: Some(images), ..self }.meeting(rules)
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
}
