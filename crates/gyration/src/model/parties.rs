//! Who meets supports with a shape, and what is known of any party.

use super::Model;
use crate::body::Solid;
use crate::load::Party;
use crate::neighbours::{Pair, solid_pairs};
use crate::pair::PairLaws;

impl Model {
    /// Finds the pairs with supports that have a shape, and how many of all there are.
    pub(super) fn find_pairs(&mut self) {
        self.with_supports = solid_pairs(&self.rules, &self.bodies, &self.solid_supports).into();
        let is_endless = |pair: &&Pair| {
            let deforms = |party: &Party| party.body().is_some_and(|body| self.bodies[body].affine().is_some());
            pair.form.reach.is_none() || pair.parties.iter().any(deforms)
        };
        let [all, endless] = self.rules.count(&self.bodies);
        self.pairs = [all + self.with_supports.len(), endless + self.with_supports.iter().filter(is_endless).count()];
    }

    /// The pairs of bodies with supports that have a shape, in order.
    pub fn pairs_with_supports(&self) -> &[Pair] {
        &self.with_supports
    }

    /// Whether a body meets others, or supports with a shape.
    pub fn has_pairs(&self, body: usize) -> bool {
        self.meets_bodies(body) || self.rules.with_supports_of(body).next().is_some()
    }

    /// The laws by which a body meets others, and supports with a shape.
    pub fn pair_laws_of(&self, body: usize) -> impl Iterator<Item = &PairLaws> {
        let of_bodies = self.rules.of(body).iter().map(|rule| &self.rules.all()[*rule]);
        of_bodies.chain(self.rules.with_supports_of(body)).map(|rule| &*rule.laws)
    }

    /// What a party is called; nothing of space.
    pub fn party_name(&self, party: Party) -> &str {
        match party {
            Party::Body(body) => self.name(body),
            Party::Support(support) => &self.supports[support].name,
            Party::SolidSupport(support) => &self.solid_supports[support].name,
            Party::Space => "",
        }
    }

    /// The solid of a party; none of a plane and of space.
    pub fn solid_of(&self, party: Party) -> Option<&Solid> {
        match party {
            Party::Body(body) => Some(&self.bodies[body].solid),
            Party::SolidSupport(support) => Some(&self.solid_supports[support].solid),
            Party::Support(_) | Party::Space => None,
        }
    }

    /// A length by which gaps to a party are judged [m]; none to a plane and to space.
    pub fn size_of(&self, party: Party) -> Option<f64> {
        match party {
            Party::Body(body) => Some(self.bodies[body].size),
            Party::SolidSupport(support) => Some(self.solid_supports[support].size),
            Party::Support(_) | Party::Space => None,
        }
    }
}
