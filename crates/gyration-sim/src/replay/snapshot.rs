//! The bodies of a replay at one sample: gaps at points of their surfaces, and tractions over parts of these.
//!
//!   p = p₀ + P X,   ṗ = ṗ₀ + Ṗ X,   d = (p − o)·n
//!
//! A traction t is force per current area, whatever measure a contact has. What a law takes from the whole of a
//! surface, a bound on friction or the speed at which all of it recedes, is the same for each part, so that parts add
//! up. The tractions of pairs are those at their planes (`gyration::pair::PairTractions`). The surface tension of a
//! potential per deformed area is no traction and has no resultant force; it is left aside.

use super::cells::{Reached, SurfaceCells};
use super::error::ReplayError;
use gyration::contact::{
    Contact, ContactLaw, ContactLoads, ContactScratch, Deformation, Meeting, Overall, RelativeMotion,
};
use gyration::dynamics::{PairTractionsAt, Workspace, each_pair_traction};
use gyration::model::Model;
use gyration::state::{BodyMotion, State};
use gyration::surface::{GapClosed, GapField};
use gyration::tensor::Vec3;
use gyration::{Inadmissible, Quantity};

/// The bodies of a recording at one of its samples.
#[derive(Debug, Clone)]
pub struct Snapshot<'a> {
    model: &'a Model,
    row: usize,
    state: State,
    motions: Vec<BodyMotion>,
}

/// One of them.
#[derive(Debug, Clone)]
pub struct BodySnapshot<'a> {
    model: &'a Model,
    row: usize,
    time: f64,
    body: usize,
    motion: BodyMotion,
}

impl<'a> Snapshot<'a> {
    pub(super) fn new(model: &'a Model, row: usize, state: State) -> Self {
        let bodies = 0..model.bodies.len();
        // Of a state outside the model nothing better is known.
        let motions = match Workspace::default().read(model, &state) {
            Ok((instant, _)) => bodies.map(|body| *instant.at(body).motion).collect(),
            Err(_) => bodies.map(|body| state.motion(model, body)).collect(),
        };
        Self { model, row, state, motions }
    }

    /// The model.
    pub fn model(&self) -> &'a Model {
        self.model
    }

    /// The state.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// A body, by its index.
    pub fn body(&self, body: usize) -> BodySnapshot<'a> {
        let motion = self.motions[body];
        BodySnapshot { model: self.model, row: self.row, time: self.state.time, body, motion }
    }

    /// The mean traction over each triangle of the surfaces of all bodies, per current area \[Pa\], from its integral;
    /// empty of a body without a surface.
    ///
    /// Times the current area of the triangle it is the force of all contacts on the part of the true surface over it:
    /// they add up to the recorded force, to rounding if all faces are flat, to some thousandths if not.
    ///
    /// # Errors
    /// `Inadmissible` if a triangle reaches a support, or the plane between its body and another.
    pub fn mean_tractions(&self, surfaces: &[Option<&SurfaceCells>]) -> Result<Vec<Vec<Vec3>>, ReplayError> {
        let outside = |source| ReplayError::Inadmissible { row: self.row, source };
        let mut workspace = Workspace::default();
        let (instant, _) = workspace.read(self.model, &self.state).map_err(outside)?;
        let mut all = Vec::with_capacity(surfaces.len());
        for (index, cells) in surfaces.iter().enumerate() {
            let Some(cells) = cells else {
                all.push(Vec::new());
                continue;
            };
            let body = self.body(index);
            let mut forces = body.forces_of_planes(cells)?;
            each_pair_traction(&instant.at(index), |pair: PairTractionsAt| {
                let PairTractionsAt { pair, side, tractions, room } = pair;
                let (field, nearest) = tractions.gaps(side);
                let reached = Reached { field, exponent: tractions.steepest(), nearest };
                for cell in cells.of_part(pair.parts[side]) {
                    forces[cell] += tractions.force_on(side, &cells.over(cell, &reached), room)?;
                }
                Ok(())
            })
            .map_err(outside)?;
            body.divide_by_areas(cells, &mut forces);
            all.push(forces);
        }
        Ok(all)
    }
}

impl BodySnapshot<'_> {
    /// How it moves; of a body of a lattice in its own cell.
    pub fn motion(&self) -> &BodyMotion {
        &self.motion
    }

    /// The place in space \[m\] of a material point X (from the centre of mass).
    pub fn place(&self, point: &Vec3) -> Vec3 {
        self.model.in_space(self.body, &self.motion.placement.place(point))
    }

    /// The distance of a material point X (from the centre of mass) to the nearest support \[m\]; infinite without any.
    pub fn gap(&self, point: &Vec3) -> f64 {
        let place = self.motion.placement.place(point);
        let gaps = self.model.supports.iter().map(|support| support.gap(&place, self.time));
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// The force of all planes on the surface over each triangle \[N\].
    fn forces_of_planes(&self, cells: &SurfaceCells) -> Result<Vec<Vec3>, ReplayError> {
        let gradient = &self.motion.placement.gradient;
        let deformation = self.model.bodies[self.body].affine().and_then(|_| Deformation::of(gradient));
        let mut scratch = ContactScratch::default();
        let mut forces = vec![Vec3::zeros(); cells.len()];
        let Some(whole) = &self.model.bodies[self.body].solid.surface else { return Ok(forces) };
        for contact in self.contacts() {
            let (field, motion) = self.relative_to(contact);
            let exponent = contact.law_set.laws().iter().map(ContactLaw::leading_exponent).fold(0.0, f64::max);
            let reached = Reached { field, exponent, nearest: whole.smallest_gap(&field).0 };
            let laws = &contact.law_set;
            let outside = |closed: GapClosed| self.outside(contact, closed.gap);
            let all = Meeting { surface: whole, field, motion, deformation };
            let overall = Overall::integrate(laws, &all, &mut scratch).map_err(outside)?;
            for (cell, force) in forces.iter_mut().enumerate() {
                let part = Meeting { surface: &cells.over(cell, &reached), ..all };
                *force += ContactLoads::force_on_part(laws, &part, overall, &mut scratch).map_err(outside)?;
            }
        }
        Ok(forces)
    }

    /// Makes tractions of the forces on triangles.
    fn divide_by_areas(&self, cells: &SurfaceCells, forces: &mut [Vec3]) {
        let gradient = &self.motion.placement.gradient;
        let surface = cells.surface();
        for (triangle, force) in surface.triangles.iter().zip(forces) {
            let [a, b, c] = surface.corners(triangle).map(|corner| gradient * corner);
            let area = 0.5 * (b - a).cross(&(c - a)).norm();
            // A triangle without area bears nothing.
            *force = if area > 0.0 { *force / area } else { Vec3::zeros() };
        }
    }

    /// The gap to the support of a contact, and the motion relative to it.
    fn relative_to(&self, contact: &Contact) -> (GapField, RelativeMotion) {
        let support = &self.model.supports[contact.support];
        let field = support.gap_field(&self.motion.placement, self.time);
        (field, RelativeMotion::to(support, &self.motion, self.time))
    }

    fn contacts(&self) -> impl Iterator<Item = &Contact> {
        self.model.contacts_of(self.body)
    }

    fn outside(&self, contact: &Contact, gap: f64) -> ReplayError {
        let quantity = Quantity::Gap { support: contact.support };
        ReplayError::Inadmissible { row: self.row, source: Inadmissible { body: self.body, quantity, value: gap } }
    }
}
