//! Which bodies of a model may act on one another, and from how far.

use super::Model;
use crate::body::Solid;
use crate::neighbours::{BodyPair, PairRule};
use crate::pair::cutoff;

impl Model {
    /// So few pairs of bodies that any two that may act on one another through any chain are joined through these.
    pub fn chain(&self) -> impl Iterator<Item = [usize; 2]> {
        self.held_together().chain(self.rules.all().iter().flat_map(PairRule::chain))
    }

    /// The same of those that act on one another wherever they are: joined, or felt through the fluid.
    fn held_together(&self) -> impl Iterator<Item = [usize; 2]> {
        let spheres = self.spheres().map_or(&[][..], |spheres| spheres.bodies());
        self.joined().chain(spheres.windows(2).map(|pair| [pair[0], pair[1]]))
    }

    /// The same of those that act on one another however far they are: through springs, rules without a reach, and
    /// bodies that deform.
    pub fn endless_chain(&self) -> impl Iterator<Item = [usize; 2]> {
        let deforms = |body: usize| self.bodies[body].affine().is_some();
        // Those of a lattice stay beside one another.
        let in_lattice = self.images.is_some();
        let rules = self.rules.all().iter().flat_map(move |rule| {
            let is_endless =
                move |pair: &[usize; 2]| in_lattice || rule.reach.is_none() || pair.iter().any(|body| deforms(*body));
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
        self.held_together().chain(rules)
    }

    /// Whether there are bodies that act on one another within a distance only.
    pub fn has_cutoffs(&self) -> bool {
        if self.images.is_some() {
            return false;
        }
        let is_rigid = |body: &&usize| self.bodies[**body].affine().is_none();
        self.rules.all().iter().filter(|rule| rule.reach.is_some()).any(|rule| {
            let [one, other] = [0, 1].map(|set| rule.bodies[set].iter().filter(is_rigid).take(2));
            one.flat_map(|one| other.clone().map(move |other| (one, other))).any(|(one, other)| one != other)
        })
    }

    /// From where on two bodies do nothing to each other by a rule; none if they do everywhere, as where one of them
    /// deforms.
    pub fn cutoff(&self, pair: &BodyPair) -> Option<Cutoff> {
        let bodies = pair.bodies.map(|body| &self.bodies[body]);
        if bodies.iter().any(|body| body.affine().is_some()) {
            return None;
        }
        let solids = bodies.map(|body| &*body.solid);
        let of_parts = |parts: [usize; 2]| {
            let surfaces = self.rules.all()[pair.rule].range_between(solids, parts)?;
            let centers = cutoff(surfaces, [0, 1].map(|end| solids[end].part_radius(parts[end])));
            Some(Cutoff { centers, surfaces })
        };
        let larger =
            |a: Cutoff, b: Cutoff| Cutoff { centers: a.centers.max(b.centers), surfaces: a.surfaces.max(b.surfaces) };
        Solid::parts_of(solids).filter_map(of_parts).reduce(larger)
    }
}

/// Two distances from each of which on two bodies do nothing to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cutoff {
    /// Of the centres of mass [m].
    pub centers: f64,
    /// Of the surfaces [m].
    pub surfaces: f64,
}
