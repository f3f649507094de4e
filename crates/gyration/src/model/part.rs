//! The model of some of the bodies of another.

use super::{Model, immersed_spheres, layout, without_inertia};
use crate::body::{Body, Slots};
use crate::contact::Contact;
use crate::joint::{Joint, JointGraph};
use crate::load::{Bond, Spring};
use std::sync::Arc;

impl Model {
    /// The model of some of its bodies, whose indices ascend: as if there were no others, but with the ledger of all,
    /// as far as it concerns them.
    #[must_use]
    pub fn part(&self, members: &[usize]) -> Self {
        let bodies: Vec<Arc<Body>> = members.iter().map(|body| self.bodies[*body].clone()).collect();
        let slots = layout(&bodies);
        let mut part = Self {
            gravity: self.gravity,
            supports: self.supports.clone(),
            solid_supports: self.solid_supports.clone(),
            blocks: slots.iter().map(Slots::block).collect(),
            slots,
            inertialess: without_inertia(&bodies),
            spheres: immersed_spheres(&bodies),
            bodies,
            names: members.iter().map(|body| self.names[*body].clone()).collect(),
            fluid: self.fluid.clone(),
            lattice: Arc::clone(&self.lattice),
            origins: members.iter().filter_map(|body| self.origins.get(*body)).copied().collect(),
            at_rest: members.iter().filter_map(|body| self.at_rest.get(*body)).copied().collect(),
            contacts: self.contacts.among(members, Contact::of_parties),
            springs: self.springs.among(members, Spring::of_parties),
            bonds: self.bonds.among(members, Bond::of_parties),
            joints: self.joints.among(members, Joint::of_parties),
            joint_graph: None,
            rules: match self.images {
                None => self.rules.among(members),
                Some(_) => self.rules.of_images(members),
            },
            images: self.images.as_ref().map(|images| images.among(members)),
            with_supports: Arc::from([]),
            pairs: [0, 0],
            works: Vec::new(),
            energies: Vec::new(),
            has_potential: self.has_potential,
            applied: members.iter().filter_map(|body| self.applied.get(*body)).copied().collect(),
            given_up: self.given_up,
        };
        part.find_pairs();
        part.joint_graph = JointGraph::of(part.joints()).map(Arc::new);
        part.enter_ledger();
        part
    }
}
