//! Bodies without inertia: the velocities at which everything that acts on them is in balance.
//!
//!   A_i(q, v, G) = λ_i Y_i,   tr(Ṗ_i P_i⁻¹) = θ_i,      q̇ = B(q) v,   Ġ = V_G G
//!
//! A are the accelerations that a body with inertia would have, which vanish when the loads do. Where they are linear
//! in the velocities v, one solution with the matrix of the exact Jacobian gives these; else it begins Newton's method.
//! Where the pressure of an incompressible body keeps det P, A is known but for a multiple λ of Y = P⁻ᵀJ⁻¹, and the
//! growth θ of its volume takes the place of that equation (zero, or that of a contraction that is prescribed). Bodies
//! that feel one another's velocities, through dashpots or through damping and friction where they meet, are balanced
//! together. Masses only weigh the equations: nothing depends on them but the weight of the body. Source:
//! `docs/theory-fluid.md`.
//!
//! | file      | what                                                              |
//! |-----------|-------------------------------------------------------------------|
//! | `volume`  | the constraint of an incompressible body                          |
//! | `factors` | the matrix of one body or several, and its factors                |
//! | `newton`  | the balance under loads that are not linear in the velocities     |
//! | `slopes`  | the derivatives of the rates                                      |

mod factors;
mod newton;
mod slopes;
mod volume;

use super::Scratch;
use super::body_rates::body_rates;
use super::jacobian::body_jacobian;
use super::powers::Powers;
use crate::body::Slots;
use crate::inadmissible::{Inadmissible, Quantity};
use crate::instant::{BodyAt, Instant};
use crate::model::Model;
use factors::{Bordered, Factors, Together};
use gyration_blocks::Components;
use nalgebra::DMatrix;
use slopes::Influences;
pub(super) use slopes::{add_jacobian, joins};
use std::ops::Range;
use volume::KeptVolume;

/// The most numbers that a body has.
const NUMBERS: usize = 33;

/// The balances of the bodies without inertia; kept from one instant to the next.
#[derive(Debug, Clone, Default)]
pub(crate) struct Balances {
    links: Links,
    /// Those of the last instant, from which the groups are.
    last: Links,
    groups: Vec<Group>,
    members: Vec<Member>,
    /// A right-hand side, and the solution.
    side: Vec<f64>,
    influences: Influences,
}

/// Who feels the velocity of whom among the bodies without inertia.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
struct Links {
    /// The bodies, ascending.
    bodies: Vec<usize>,
    /// How many unknowns each has.
    sizes: Vec<usize>,
    /// (i, j) of places among these: i feels the velocity of j.
    pairs: Vec<(usize, usize)>,
}

/// Bodies that are balanced together.
#[derive(Debug, Clone)]
struct Group {
    /// Their indices, ascending.
    bodies: Vec<usize>,
    /// Where the unknowns of each stand.
    ranges: Vec<Range<usize>>,
    /// The matrix of several.
    together: Option<Together>,
    /// What was found last: their velocities and λ.
    velocities: Vec<f64>,
    /// Room for a step of Newton's method, and from where it goes.
    start: Vec<f64>,
    step: Vec<f64>,
}

/// A body of a group at an instant, as if it had inertia.
#[derive(Debug, Clone)]
struct Member {
    index: usize,
    slots: Slots,
    rates: [f64; NUMBERS],
    jacobian: DMatrix<f64>,
    kept: Option<KeptVolume>,
    bordered: Bordered,
}

impl Scratch {
    /// A matrix of zeros of so many rows.
    pub(super) fn take(&mut self, size: usize) -> DMatrix<f64> {
        match self.matrices.iter().position(|matrix| matrix.nrows() == size) {
            Some(place) => {
                let mut matrix = self.matrices.swap_remove(place);
                matrix.fill(0.0);
                matrix
            }
            None => DMatrix::zeros(size, size),
        }
    }
}

/// Gives the bodies without inertia of an instant the velocities of their balance, and finds again what feels them.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model, or where nothing resists a motion.
pub(super) fn solve(instant: &mut Instant, scratch: &mut Scratch) -> Result<(), Inadmissible> {
    if instant.model().inertialess().is_empty() {
        return Ok(());
    }
    let mut balances = std::mem::take(&mut scratch.balances);
    let solved = balances.solve(instant, scratch);
    scratch.balances = balances;
    solved
}

/// Fills the rates of a body whose velocities are those of its balance.
pub(super) fn fill(at: &BodyAt, scratch: &mut Scratch, rates: &mut [f64]) -> Result<Powers, Inadmissible> {
    let from = Slots::with_inertia(at.body, 0);
    let mut found = [0.0; NUMBERS];
    let done = body_rates(at, &from, scratch, &mut found)?;
    let slots = at.model.slots(at.index);
    rates[slots.places()].copy_from_slice(&found[from.places()]);
    rates[slots.extra()].copy_from_slice(&found[from.extra()]);
    Ok(done)
}

/// The bodies whose velocities a body feels, some of them twice.
fn felt<'a>(at: &BodyAt<'a>) -> impl Iterator<Item = usize> + use<'a> {
    let model = at.model;
    let springs = model.springs_of(at.index).filter(|end| end.interaction.law.damping > 0.0);
    let pairs = at.pairs().filter(|pair| pair.acts() && pair.slopes.is_some_and(|slopes| slopes.by_rate.is_some()));
    let others = springs.filter_map(|end| end.other().body()).chain(pairs.filter_map(|pair| pair.other_body()));
    others.chain(model.felt_in_fluid(at.index))
}

/// The body would move for nothing: its resistance cannot be inverted.
fn without_resistance(index: usize) -> Inadmissible {
    Inadmissible { body: index, quantity: Quantity::Resistance, value: 0.0 }
}

impl Balances {
    fn solve(&mut self, instant: &mut Instant, scratch: &mut Scratch) -> Result<(), Inadmissible> {
        self.find_groups(instant);
        let Self { groups, members, side, .. } = self;
        for group in &mut *groups {
            give_back(members, scratch);
            for body in &group.bodies {
                members.push(Member::at(&instant.at(*body), scratch)?);
            }
            group.begin(side);
            let nothing_resists = without_resistance(group.bodies[0]);
            let Group { bodies, ranges, together, velocities, .. } = group;
            for (member, range) in members.iter().zip(&*ranges) {
                let growth = member.kept.as_ref().map_or(0.0, |kept| kept.growth);
                member.bordered.side(&member.rates[member.slots.velocities()], growth, &mut side[range.clone()]);
            }
            let mut factors = factors(together, instant, bodies, members).ok_or(nothing_resists)?;
            factors.solve(side).ok_or(nothing_resists)?;
            velocities.clone_from(side);
            for (member, range) in members.iter().zip(&*ranges) {
                member.move_at(instant, &velocities[range.clone()])?;
            }
        }
        instant.find_felt_pairs()?;
        let mut refined = false;
        for group in groups.iter_mut().filter(|group| group.together.is_some()) {
            group.refine(instant, scratch, side)?;
            refined = true;
        }
        if refined {
            instant.find_felt_pairs()?;
        }
        for group in groups {
            if !group.is_linear(instant) {
                group.converge(instant, scratch, members, side)?;
            }
        }
        Ok(())
    }

    /// Finds which bodies feel one another's velocities; what was found before stays if it is the same.
    fn find_groups(&mut self, instant: &Instant) {
        self.links.read(instant);
        if self.links == self.last {
            return;
        }
        let Links { bodies, pairs, .. } = &self.links;
        let joined = Components::joined(bodies.len(), pairs.iter().map(|(one, other)| [*one, *other]));
        self.groups = joined.iter().map(|places| Group::of(places, &self.links)).collect();
        self.last.clone_from(&self.links);
    }
}

impl Links {
    /// Finds them at an instant.
    fn read(&mut self, instant: &Instant) {
        let model = instant.model();
        let Self { bodies, sizes, pairs } = self;
        [&mut *bodies, &mut *sizes].into_iter().for_each(Vec::clear);
        bodies.extend(model.inertialess());
        sizes.extend(bodies.iter().map(|body| unknowns(model, *body)));
        pairs.clear();
        for (place, body) in bodies.iter().enumerate() {
            let others = felt(&instant.at(*body)).filter_map(|other| bodies.binary_search(&other).ok());
            pairs.extend(others.map(|other| (place, other)));
        }
    }
}

/// How many unknowns the balance of a body has.
fn unknowns(model: &Model, body: usize) -> usize {
    let body = &model.bodies[body];
    let keeps_volume = body.affine().is_some_and(|affine| affine.interior.is_incompressible())
        && !body.contraction().is_some_and(|contraction| contraction.gives_pressure());
    Slots::with_inertia(body, 0).velocities().len() + usize::from(keeps_volume)
}

/// Keeps the room of matrices for the next bodies.
fn give_back(members: &mut Vec<Member>, scratch: &mut Scratch) {
    scratch.matrices.extend(members.drain(..).map(|member| member.jacobian));
}

impl Group {
    /// Of bodies that hang together, by their places among all that are linked.
    fn of(places: &[usize], links: &Links) -> Self {
        let mut end = 0;
        let range = |place: &usize| {
            end += links.sizes[*place];
            end - links.sizes[*place]..end
        };
        let ranges: Vec<Range<usize>> = places.iter().map(range).collect();
        let own =
            |(one, other): &(usize, usize)| Some((places.binary_search(one).ok()?, places.binary_search(other).ok()?));
        let together = (places.len() > 1).then(|| Together::new(&ranges, links.pairs.iter().filter_map(own)));
        let bodies = places.iter().map(|place| links.bodies[*place]).collect();
        Self { bodies, ranges, together, velocities: Vec::new(), start: Vec::new(), step: Vec::new() }
    }

    /// Solves once more for what the loads at the velocities that were found leave: what two bodies do to each other is
    /// opposite there to the last digit, however stiff it is beside the fluid, as the sums of a factorization are not.
    fn refine(
        &mut self,
        instant: &mut Instant,
        scratch: &mut Scratch,
        side: &mut Vec<f64>,
    ) -> Result<(), Inadmissible> {
        let Self { bodies, ranges, together, velocities, .. } = self;
        let Some(together) = together else { return Ok(()) };
        unbalanced(instant, scratch, bodies, ranges, side)?;
        together.factorized().solve(side).ok_or_else(|| without_resistance(bodies[0]))?;
        for (body, range) in bodies.iter().zip(&*ranges) {
            let slots = Slots::with_inertia(instant.at(*body).body, 0);
            for place in range.start..range.start + slots.velocities().len() {
                velocities[place] += side[place];
            }
        }
        move_all(instant, bodies, ranges, velocities)
    }

    /// Begins a right-hand side.
    fn begin(&self, side: &mut Vec<f64>) {
        begin(&self.ranges, side);
    }
}

/// Begins a right-hand side.
fn begin(ranges: &[Range<usize>], side: &mut Vec<f64>) {
    side.clear();
    side.resize(ranges.last().map_or(0, |range| range.end), 0.0);
}

/// Writes the right-hand side of what the loads at the velocities of an instant leave.
fn unbalanced(
    instant: &Instant,
    scratch: &mut Scratch,
    bodies: &[usize],
    ranges: &[Range<usize>],
    side: &mut Vec<f64>,
) -> Result<(), Inadmissible> {
    begin(ranges, side);
    for (body, range) in bodies.iter().zip(ranges) {
        let at = instant.at(*body);
        let slots = Slots::with_inertia(at.body, 0);
        let mut rates = [0.0; NUMBERS];
        body_rates(&at, &slots, scratch, &mut rates)?;
        let left = slots.velocities().zip(&mut side[range.clone()]);
        left.for_each(|(rate, out)| *out = -rates[rate]);
    }
    Ok(())
}

/// Gives the bodies of a group these velocities.
fn move_all(
    instant: &mut Instant,
    bodies: &[usize],
    ranges: &[Range<usize>],
    velocities: &[f64],
) -> Result<(), Inadmissible> {
    for (body, range) in bodies.iter().zip(ranges) {
        let slots = Slots::with_inertia(instant.at(*body).body, 0);
        move_at(instant, *body, &slots, &velocities[range.clone()])?;
    }
    Ok(())
}

/// The factors of the balance of the bodies of a group, in the room that several have; none if nothing resists the
/// motion.
fn factors<'a>(
    together: &'a mut Option<Together>,
    instant: &Instant,
    bodies: &[usize],
    members: &[Member],
) -> Option<Factors<'a>> {
    let Some(together) = together else { return Some(Factors::of_one(&members[0].bordered)) };
    together.begin();
    for (place, member) in members.iter().enumerate() {
        together.set(place, &member.bordered);
    }
    slopes::add_velocities(instant, bodies, together);
    together.factorize()
}

impl Member {
    /// A body at an instant.
    fn at(at: &BodyAt, scratch: &mut Scratch) -> Result<Self, Inadmissible> {
        let slots = Slots::with_inertia(at.body, 0);
        let mut rates = [0.0; NUMBERS];
        body_rates(at, &slots, scratch, &mut rates)?;
        let kept = KeptVolume::of(at);
        let mut jacobian = scratch.take(slots.block().len());
        body_jacobian(at, scratch, &mut jacobian)?;
        let within = at.body.guided_velocities();
        let bordered = Bordered::new(&slots, &jacobian, kept.as_ref(), within.as_ref());
        Ok(Self { index: at.index, slots, rates, jacobian, kept, bordered })
    }

    /// Gives the body these velocities.
    fn move_at(&self, instant: &mut Instant, velocities: &[f64]) -> Result<(), Inadmissible> {
        move_at(instant, self.index, &self.slots, velocities)
    }
}

/// Gives a body velocities, which stand as with inertia.
fn move_at(instant: &mut Instant, body: usize, slots: &Slots, velocities: &[f64]) -> Result<(), Inadmissible> {
    let own = *instant.model().slots(body);
    let mut numbers = [0.0; NUMBERS];
    numbers[slots.places()].copy_from_slice(&instant.state()[own.places()]);
    numbers[slots.extra()].copy_from_slice(&instant.state()[own.extra()]);
    numbers[slots.velocities()].copy_from_slice(&velocities[..slots.velocities().len()]);
    instant.set_motion(body, slots, &numbers)
}
