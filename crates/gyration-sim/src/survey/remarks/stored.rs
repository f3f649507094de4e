//! Energy that contacts store at the start and that dwarfs all other: bodies that begin too near are shot apart, unless
//! others hold them.

use super::joined::Joined;
use super::trial::stored;
use crate::format::significant;
use crate::survey::{Approach, Encounter};
use gyration::Party;
use gyration::body::Body;
use gyration::contact::{ContactLaw, LawKind};
use gyration::dynamics::{Workspace, rates};
use gyration::model::Model;
use gyration::neighbours::{Pair, Sphere, each_near};
use gyration::state::{BodyMotion, State};
use gyration::tensor::{Mat3, Vec3};
use std::ops::ControlFlow;
use std::sync::Arc;

/// Beyond one size what a contact stores is told where nothing else holds the body, to so many sizes: farther away it
/// may take longer than a run to matter.
const FAR: f64 = 10.0;
/// So many times all other energy is no start that was meant.
const DWARFS: f64 = 1e3;
/// The gap, in sizes, below which energy is told where there is no other to compare it with.
const TINY: f64 = 1e-6;
/// A force beside which what is left of all is small.
const HELD: f64 = 0.1;
/// Pairs whose energy is looked at.
const MOST_PAIRS: usize = 10_000;
/// Fewer of them are all looked at, however far apart they are.
const FEW_PAIRS: usize = 300;

/// What must be told of the contact that stores most.
pub(super) fn warning(model: &Model, start: &State) -> Option<String> {
    let meeting = meeting(model, start);
    let pairs = meeting.iter().flat_map(|two| two.pairs(model).map(move |pair| (two, pair)));
    let pairs = pairs.filter_map(|(two, pair)| Near::of_pair(model, start, two, &pair));
    let bodies = (0..model.bodies.len()).filter(|body| model.contacts_of(*body).next().is_some()).take(MOST_PAIRS);
    let planes = bodies.flat_map(|index| {
        (0..model.supports.len()).filter_map(move |support| Near::of_support(model, start, (index, support)))
    });
    let solids = model.pairs_with_supports().iter().take(MOST_PAIRS);
    let solids = solids.filter_map(|pair| Near::of_solid_support(model, start, pair));
    let mut found: Vec<Near> = pairs.chain(planes).chain(solids).collect();
    found.sort_by(|one, other| other.energy.total_cmp(&one.energy));
    if !found.first()?.dwarfs(model, start) {
        return None;
    }
    let pushed = forces(model, start);
    let counts = |near: &&Near| !near.is_held(&pushed) && near.may_matter(model, &pushed);
    let most = found.iter().find(counts).filter(|near| near.dwarfs(model, start))?;
    let other = most.other_energy(model, start);
    let (energy, gap) = (significant(most.energy, 3), significant(most.gap, 3));
    let times = match other > 0.0 {
        true => format!(", {} times all other energy there", significant(most.energy / other, 2)),
        false => String::new(),
    };
    Some(format!(
        "{} begin {gap} m apart, and the contact between them stores {energy} J{times}: they are shot apart",
        most.names
    ))
}

/// Two that meet, with what their repulsion stores.
struct Near {
    names: String,
    /// The bodies among them.
    bodies: [Option<usize>; 2],
    gap: f64,
    energy: f64,
}

/// The force that is left of all that acts on each body [N]; none of one that is pinned, infinite without inertia.
fn forces(model: &Model, start: &State) -> Vec<f64> {
    let (mut slopes, mut powers) = (vec![0.0; model.dimension()], vec![0.0; model.works().len()]);
    let numbers = start.numbers();
    let found = rates(model, &mut Workspace::default(), start.time, numbers, &mut slopes, &mut powers);
    let force = |(index, body): (usize, &Arc<Body>)| match slopes.get(model.slots(index).velocity()) {
        Some(acceleration) if found.is_ok() && !acceleration.is_empty() => {
            body.solid.mass.mass * Vec3::from_column_slice(acceleration).norm()
        }
        _ if body.pin.is_some() => 0.0,
        _ => f64::INFINITY,
    };
    model.bodies.iter().enumerate().map(force).collect()
}

/// The bodies that meet; of many those that are not farther apart than they are large, and some others.
fn meeting(model: &Model, start: &State) -> Vec<Joined> {
    let all = (0..model.rules().all().len()).flat_map(|rule| Joined::of_rule(model, rule));
    let most = if model.images().is_some() { MOST_PAIRS } else { FEW_PAIRS };
    let found: Vec<Joined> = all.take(most).collect();
    if model.images().is_some() || found.len() < FEW_PAIRS {
        return found;
    }
    let sphere = |(index, body): (usize, &Arc<Body>)| {
        let Some(radius) = body.solid.radius() else { return Sphere::NOWHERE };
        let placement = start.motion_in_space(model, index).placement;
        Sphere::new(placement.position, 2.0 * placement.gradient.norm() * radius)
    };
    let spheres: Vec<Sphere> = model.bodies.iter().enumerate().map(sphere).collect();
    let mut found = Vec::new();
    let _ = each_near(
        model.rules(),
        &spheres,
        |_| Some(0.0),
        |pair| {
            found.push(Joined::in_space(pair.rule, pair.bodies));
            if found.len() < MOST_PAIRS { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        },
    );
    found
}

impl Near {
    /// All other energy of its bodies [J].
    fn other_energy(&self, model: &Model, start: &State) -> f64 {
        self.bodies.iter().flatten().map(|body| other_energy(model, start, *body)).sum()
    }

    /// Whether the energy is more than a start can mean.
    fn dwarfs(&self, model: &Model, start: &State) -> bool {
        let other = self.other_energy(model, start);
        let sizes = self.bodies.iter().flatten().map(|body| model.bodies[*body].size);
        if other > 0.0 { self.energy > DWARFS * other } else { self.gap < TINY * sizes.fold(f64::INFINITY, f64::min) }
    }

    /// Whether what else acts on its bodies holds the force that stores the energy, given what is left of all [N].
    fn is_held(&self, left: &[f64]) -> bool {
        // A force F ∝ d^−ν stores at most F d/(ν − 1), and ν ≥ 2.
        let force = self.energy / self.gap;
        self.bodies.iter().flatten().all(|body| left[*body] < HELD * force)
    }

    /// Whether it is near, or far with nothing else that could hold one of its bodies.
    fn may_matter(&self, model: &Model, left: &[f64]) -> bool {
        let bodies = || self.bodies.iter().flatten();
        let size = bodies().map(|body| model.bodies[*body].size).fold(f64::INFINITY, f64::min);
        let is_free = |body: &usize| {
            let about = &model.bodies[*body];
            let is_held = about.inclusion.is_some() || about.pin.is_some() || model.springs_of(*body).next().is_some();
            !is_held && left[*body] >= self.energy / self.gap
        };
        self.gap <= size || (self.gap <= FAR * size && bodies().any(is_free))
    }

    /// A pair at the start.
    fn of_pair(model: &Model, start: &State, two: &Joined, pair: &Pair) -> Option<Self> {
        let bodies: [&Body; 2] = two.bodies.map(|body| &*model.bodies[body]);
        let motions = two.motions(model, start);
        let loads = stored((&pair.form, pair.parts), bodies, &motions)?;
        let [one, other] = two.bodies.map(|body| model.name(body));
        let names = format!("\"{one}\" and \"{other}\"");
        Some(Self { names, bodies: two.bodies.map(Some), gap: loads.gap, energy: loads.energy })
    }

    /// A body and a support with a shape at the start.
    fn of_solid_support(model: &Model, start: &State, pair: &Pair) -> Option<Self> {
        let encounter = Encounter::new(model, start, pair)?;
        let gap = encounter.initial_gap;
        // As of a support that is a plane.
        let [_, force] = encounter.at(gap)?;
        let energy = force * gap / (pair.form.laws.repulsion.exponent - 1.0);
        let [one, other] = pair.parties.map(|party| model.party_name(party));
        let names = format!("\"{one}\" and the support \"{other}\"");
        Some(Self { names, bodies: pair.parties.map(Party::body), gap, energy })
    }

    /// A body and a support at the start.
    fn of_support(model: &Model, start: &State, (body, support): (usize, usize)) -> Option<Self> {
        let approach = Approach::new(model, start, body, support)?;
        let exponent_of = |kind: LawKind| {
            let laws = model.contacts_of(body).filter(|contact| contact.support == support);
            let laws = laws.flat_map(|contact| contact.law_set.laws()).filter(|law| law.kind() == kind);
            laws.map(ContactLaw::leading_exponent).fold(1.0, f64::max)
        };
        // Without a repulsion the repulsive part of adhesion pushes.
        let exponent = match exponent_of(LawKind::Repulsion) {
            none if none <= 1.0 => exponent_of(LawKind::Adhesion),
            exponent => exponent,
        };
        let gap = approach.initial_gap;
        if exponent <= 1.0 {
            return None;
        }
        // Of a face the force F ∝ d^−ν stores F d/(ν − 1), of what is sharper a little more.
        let energy = approach.force(gap)? * gap / (exponent - 1.0);
        let names = format!("\"{}\" and the support \"{}\"", model.name(body), model.supports[support].name);
        Some(Self { names, bodies: [Some(body), None], gap, energy })
    }
}

/// Kinetic energy of a body, its weight over its size, and the energy of its material at a strain of a half [J].
fn other_energy(model: &Model, start: &State, body: usize) -> f64 {
    let BodyMotion { velocity, .. } = start.motion_in_space(model, body);
    let body = &model.bodies[body];
    let mass = &body.solid.mass;
    let rate = &velocity.gradient_rate;
    let spin = 0.5 * (rate * mass.euler_tensor * rate.transpose()).trace();
    let kinetic = 0.5 * mass.mass * velocity.velocity.norm_squared() + spin;
    let weight = mass.mass * model.gravity.norm() * body.size;
    let elastic = body.affine().and_then(|affine| {
        let material = affine.interior.material.as_ref()?;
        let strained = Mat3::from_diagonal(&Vec3::new(1.5, 1.0, 1.0 / 1.5));
        Some(affine.interior.volume * material.response(&strained).energy.abs())
    });
    kinetic + weight + elastic.unwrap_or(0.0)
}
