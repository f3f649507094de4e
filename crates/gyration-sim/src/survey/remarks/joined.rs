//! Two bodies that a rule joins, in a lattice in cells beside one another.

use gyration::lattice::Cell;
use gyration::model::Model;
use gyration::neighbours::{ImagePair, Pair};
use gyration::state::{BodyMotion, State};
use gyration::tensor::Vec3;

/// Two bodies that meet by a rule.
#[derive(Debug, Clone, Copy)]
pub(super) struct Joined {
    rule: usize,
    /// The two.
    pub bodies: [usize; 2],
    /// The cell of the second as seen from that of the first, in a lattice.
    cell: Option<Cell>,
}

impl Joined {
    /// Two bodies in space.
    pub fn in_space(rule: usize, bodies: [usize; 2]) -> Self {
        Self { rule, bodies, cell: None }
    }

    fn of_image(image: &ImagePair) -> Self {
        Self { rule: image.pair.rule, bodies: image.pair.bodies, cell: Some(image.cell) }
    }

    /// All of a rule: in a lattice those that may come within reach.
    pub fn of_rule(model: &Model, rule: usize) -> Box<dyn Iterator<Item = Self> + '_> {
        match model.images() {
            None => Box::new(model.rules().all()[rule].pairs().map(move |bodies| Self::in_space(rule, bodies))),
            Some(images) => {
                Box::new(images.all().iter().filter(move |image| image.pair.rule == rule).map(Self::of_image))
            }
        }
    }

    /// The pairs of their parts.
    pub fn pairs<'a>(&self, model: &'a Model) -> impl Iterator<Item = Pair> + use<'a> {
        model.pairs_between(self.rule, self.bodies)
    }

    /// How they move at the start, as seen from the cell of the first.
    pub fn motions(&self, model: &Model, start: &State) -> [BodyMotion; 2] {
        let Some(cell) = self.cell else { return self.bodies.map(|body| start.motion_in_space(model, body)) };
        let mut motions = self.bodies.map(|body| start.motion(model, body));
        motions[1].placement.position += model.lattice.place(cell);
        motions
    }

    /// Place [m] and velocity [m/s] of the first of two centres from the second.
    pub fn apart(&self, model: &Model, start: &State) -> (Vec3, Vec3) {
        let [one, other] = self.motions(model, start);
        (one.placement.position - other.placement.position, one.velocity.velocity - other.velocity.velocity)
    }
}
