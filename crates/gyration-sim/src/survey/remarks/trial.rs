//! Two bodies that meet, moved along the way between them without turning: what their repulsion stores at a gap, and
//! the gap at which they turn back.
//!
//! They turn back where it stores ½μv² + Wd/(ν−1): v is the relative velocity of their centres, μ their reduced mass, W
//! the weight of the lighter one, which then rests at a gap d of about that size.

use super::joined::Joined;
use crate::survey::balance::TrialGaps;
use gyration::body::Body;
use gyration::contact::Deformation;
use gyration::model::Model;
use gyration::neighbours::Pair;
use gyration::pair::{PairForm, PairLoads, PairScratch, Side};
use gyration::state::{BodyMotion, State};
use gyration::surface::GapField;
use gyration::tensor::{Mat3, Vec3};
use std::sync::Arc;

/// Gaps between these fractions of the size are tried.
const TRIED: (f64, f64) = (1e-11, 10.0);

/// A pair without a reach, and where its bodies are.
pub(super) struct TrialPair<'a> {
    form: PairForm,
    parts: [usize; 2],
    bodies: [&'a Body; 2],
    motions: [BodyMotion; 2],
    gravity: f64,
}

impl<'a> TrialPair<'a> {
    /// A pair of the parts of two bodies of a model.
    pub fn of(model: &'a Model, start: &State, two: &Joined, pair: &Pair) -> Self {
        let bodies = two.bodies.map(|body| &*model.bodies[body]);
        let surfaces = [0, 1].map(|end| bodies[end].solid.part(pair.parts[end]));
        let motions = two.motions(model, start);
        let form = PairForm::new(Arc::clone(&pair.form.laws), None, surfaces);
        Self { form, parts: pair.parts, bodies, motions, gravity: model.gravity.norm() }
    }

    /// The size of the smaller one [m].
    pub fn size(&self) -> f64 {
        self.bodies[0].size.min(self.bodies[1].size)
    }

    /// The width of the slab between the two along a direction from the second to the first [m].
    fn width(&self, normal: &Vec3) -> f64 {
        let [above, below] = [0, 1].map(|end| {
            let sign = if end == 0 { 1.0 } else { -1.0 };
            let place = &self.motions[end].placement;
            let field = GapField::new(0.0, sign * place.gradient.tr_mul(normal));
            self.bodies[end].solid.part(self.parts[end]).smallest_gap(&field).0
        });
        let between = self.motions[0].placement.position - self.motions[1].placement.position;
        between.dot(normal) + above + below
    }

    /// The width of the slab along the line of the centres at the start [m]; none where it is not open.
    pub fn gap(&self) -> Option<f64> {
        let between = self.motions[0].placement.position - self.motions[1].placement.position;
        Some(self.width(&between.try_normalize(0.0)?)).filter(|width| *width > 0.0)
    }

    /// What the two store where the slab has a width [J]; none where that cannot be told.
    fn stored_at(&self, gap: f64, normal: &Vec3) -> Option<f64> {
        let mut motions = self.motions;
        motions[0].placement.position += (gap - self.width(normal)) * normal;
        stored((&self.form, self.parts), self.bodies, &motions).map(|loads| loads.energy)
    }

    /// The part of the energy that holds the two together which they still have where the slab is as wide as a reach
    /// [m]; none without adhesion, or where that cannot be told.
    pub fn held_beyond(&self, reach: f64) -> Option<f64> {
        let [one, other] = &self.motions;
        let normal = (one.placement.position - other.placement.position).try_normalize(0.0)?;
        let held = self.stored_at(self.form.laws.held_gap()?, &normal)?;
        let left = self.stored_at(reach, &normal)?;
        (held < 0.0).then(|| left / held)
    }

    /// The smallest gap that the two come to [m]: what they begin at, if they turn back farther out; none where nothing
    /// brings them together.
    pub fn least_gap(&self) -> Option<f64> {
        let turning = self.turning_gap()?;
        Some(self.gap().map_or(turning, |gap| gap.min(turning)))
    }

    /// The gap at which the two turn back [m], the largest that is tried if it is none of those; none where nothing
    /// brings them together.
    pub fn turning_gap(&self) -> Option<f64> {
        let [one, other] = &self.motions;
        let normal = (one.placement.position - other.placement.position).try_normalize(0.0)?;
        let masses = self.bodies.map(|body| body.solid.mass.mass);
        let speed = (one.velocity.velocity - other.velocity.velocity).norm();
        let kinetic = 0.5 * masses[0] * masses[1] / (masses[0] + masses[1]) * speed * speed;
        let weight = masses[0].min(masses[1]) * self.gravity;
        if kinetic + weight <= 0.0 {
            return None;
        }
        let falling = weight / (self.form.laws.repulsion.exponent - 1.0);
        let balance = |gap: f64| Some(self.stored_at(gap, &normal)? - kinetic - falling * gap);
        let [closest, farthest] = [TRIED.0, TRIED.1].map(|part| part * self.size());
        let found = TrialGaps::between(closest, farthest).root_of_falling(balance).first().copied();
        // Bodies that are slow beside what a repulsion still stores there turn back farther out.
        found.or_else(|| (balance(farthest)? > 0.0).then_some(farthest))
    }
}

/// What a pair does at these places; none where no plane separates them.
pub(super) fn stored(
    (form, parts): (&PairForm, [usize; 2]),
    bodies: [&Body; 2],
    motions: &[BodyMotion; 2],
) -> Option<PairLoads> {
    /// A gap that cannot be told from zero, relative to size and distance.
    const RESOLUTION: f64 = 64.0 * f64::EPSILON;
    let apart = (motions[0].placement.position - motions[1].placement.position).norm();
    let [one, other] = [0, 1].map(|end| {
        let placement = &motions[end].placement;
        Side {
            surface: bodies[end].solid.part(parts[end]),
            placement,
            from_first: placement.position - motions[0].placement.position,
            velocity: &motions[end].velocity,
            inverse: placement.gradient.try_inverse().unwrap_or_else(Mat3::identity),
            deformation: bodies[end].affine().and_then(|_| Deformation::of(&placement.gradient)),
            least_gap: RESOLUTION * (bodies[end].size + apart),
        }
    });
    PairLoads::integrate(form, [&one, &other], None, &mut PairScratch::default()).ok()
}
