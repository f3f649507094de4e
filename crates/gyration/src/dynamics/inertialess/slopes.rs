//! The derivatives of the rates that the balance of bodies without inertia gives, theirs and those of bodies that feel
//! their velocities. Differentiated as it stands, with the same matrix on the left, the balance gives
//!
//!   A_v δv − Y δλ = −A_q δq − A_G δG + λ δY,   P⁻ᵀ·δṖ = tr(Ṗ P⁻¹ δP P⁻¹)
//!
//! for the numbers of each body of the group and of each other that acts on one of them.

use super::super::Scratch;
use super::super::jacobian::{Blocks, Coupling, Lift, Lower, add_interactions};
use super::factors::{Factors, Together};
use super::{Balances, Group, Member, factors, felt, give_back, without_resistance};
use crate::body::{Slots, matrix};
use crate::inadmissible::Inadmissible;
use crate::instant::Instant;

/// How one body feels another.
#[derive(Debug, Clone)]
struct Influence {
    /// The body that feels it.
    on: usize,
    /// The body that it comes from.
    of: usize,
    coupling: Coupling,
    lower: Lower,
    lift: Lift,
}

/// Who feels whom, as far as a group is concerned.
#[derive(Debug, Clone, Default)]
pub(super) struct Influences {
    /// What the bodies of the group feel.
    own: Vec<Influence>,
    /// What bodies with inertia feel of the velocities of the group.
    others: Vec<Influence>,
    /// The bodies on whose numbers the velocities of the group depend, ascending.
    sources: Vec<usize>,
    /// The pairs (i, j) of bodies of which j acts on i through velocities of a group.
    joins: Vec<(usize, usize)>,
    /// The bodies with inertia that feel the velocities of the group, ascending.
    receivers: Vec<usize>,
}

/// Subtracts ∂A_i/∂v_j of all i ≠ j of a group from the blocks of its matrix.
pub(super) fn add_velocities(instant: &Instant, bodies: &[usize], together: &mut Together) {
    for (row, body) in bodies.iter().enumerate() {
        add_interactions(&instant.at(*body), |(other, _), coupling, lower, lift| {
            let Some(column) = bodies.binary_search(&other).ok().filter(|_| coupling.by_rate.is_some()) else { return };
            let Some(block) = together.block(row, column) else { return };
            for velocity in 0..Slots::with_inertia(&instant.model().bodies[other], 0).velocities().len() {
                let change = coupling.by_velocity(lower, lift, velocity);
                block.column_mut(velocity).iter_mut().zip(&change).for_each(|(entry, change)| *entry -= change);
            }
        });
    }
}

/// The pairs (i, j) of bodies of which j acts on i through the velocities of bodies without inertia, which are those of
/// their balance.
pub(in super::super) fn joins<'a>(instant: &Instant, scratch: &'a mut Scratch) -> &'a [(usize, usize)] {
    let Balances { groups, influences, .. } = &mut scratch.balances;
    influences.joins.clear();
    for group in groups {
        influences.find_parties(instant, group);
        let Influences { sources, receivers, joins, .. } = influences;
        for row in group.bodies.iter().chain(&*receivers) {
            joins.extend(sources.iter().filter(|of| *of != row).map(|of| (*row, *of)));
        }
    }
    &influences.joins
}

/// Adds the derivatives of the rates of bodies without inertia, whose velocities are those of their balance, and of
/// what others feel of these.
pub(in super::super) fn add_jacobian(
    instant: &Instant,
    scratch: &mut Scratch,
    blocks: &mut (impl Blocks + ?Sized),
) -> Result<(), Inadmissible> {
    if instant.model().inertialess().is_empty() {
        return Ok(());
    }
    let mut balances = std::mem::take(&mut scratch.balances);
    let added = balances.add_jacobian(instant, scratch, blocks);
    scratch.balances = balances;
    added
}

impl Balances {
    fn add_jacobian(
        &mut self,
        instant: &Instant,
        scratch: &mut Scratch,
        blocks: &mut (impl Blocks + ?Sized),
    ) -> Result<(), Inadmissible> {
        let Self { groups, members, side, influences, .. } = self;
        for group in groups {
            give_back(members, scratch);
            for body in &group.bodies {
                members.push(Member::at(&instant.at(*body), scratch)?);
            }
            influences.find(instant, group);
            group.begin(side);
            let nothing_resists = without_resistance(group.bodies[0]);
            let Group { bodies, ranges, together, .. } = group;
            let mut factors = factors(together, instant, bodies, members).ok_or(nothing_resists)?;
            for source in &influences.sources {
                let slots = Slots::of(&instant.model().bodies[*source], 0);
                let felt = influences.own_of(*source);
                for column in slots.block() {
                    let mut changes = Changes { members, ranges, side, felt, others: &influences.others };
                    changes.find(instant, &mut factors, (*source, column)).ok_or(nothing_resists)?;
                    changes.add_to(blocks, (*source, column));
                }
            }
        }
        Ok(())
    }
}

impl Influences {
    fn find(&mut self, instant: &Instant, group: &Group) {
        self.find_parties(instant, group);
        self.own.clear();
        for body in &group.bodies {
            add_interactions(&instant.at(*body), |(of, _), coupling, lower, lift| {
                self.own.push(Influence { on: *body, of, coupling: *coupling, lower: *lower, lift: *lift });
            });
        }
        // Those of each body together; the sort keeps the order in which they are summed.
        self.own.sort_by_key(|influence| influence.of);
        self.others.clear();
        for body in &self.receivers {
            add_interactions(&instant.at(*body), |(of, _), coupling, lower, lift| {
                if coupling.by_rate.is_some() && group.bodies.binary_search(&of).is_ok() {
                    self.others.push(Influence { on: *body, of, coupling: *coupling, lower: *lower, lift: *lift });
                }
            });
        }
    }

    /// What the bodies of the group feel of one body.
    fn own_of(&self, source: usize) -> &[Influence] {
        let first = self.own.partition_point(|influence| influence.of < source);
        &self.own[first..self.own.partition_point(|influence| influence.of <= source)]
    }

    /// Finds who acts on a group, and who feels its velocities.
    fn find_parties(&mut self, instant: &Instant, group: &Group) {
        let Self { sources, receivers, .. } = self;
        sources.clear();
        receivers.clear();
        sources.extend(&group.bodies);
        for body in &group.bodies {
            sources.extend(instant.partners(*body));
            receivers.extend(felt(&instant.at(*body)).filter(|other| instant.model().bodies[*other].has_inertia()));
        }
        for found in [sources, receivers] {
            found.sort_unstable();
            found.dedup();
        }
    }
}

/// The changes of the velocities of a group with one number of one body.
struct Changes<'a> {
    members: &'a [Member],
    ranges: &'a [std::ops::Range<usize>],
    side: &'a mut [f64],
    /// What the bodies of the group feel of the one that changes.
    felt: &'a [Influence],
    others: &'a [Influence],
}

impl Changes<'_> {
    /// Finds them; none if the balance cannot be solved.
    #[must_use]
    fn find(&mut self, instant: &Instant, factors: &mut Factors, (source, column): (usize, usize)) -> Option<()> {
        for (member, range) in self.members.iter().zip(self.ranges) {
            let (slots, velocities) = (&member.slots, member.slots.velocities());
            let mut accelerations = [0.0; super::factors::UNKNOWNS];
            let accelerations = &mut accelerations[..velocities.len()];
            let mut growth = 0.0;
            if member.index == source {
                let from = member.with_inertia(column);
                for (acceleration, row) in accelerations.iter_mut().zip(velocities) {
                    *acceleration = member.jacobian[(row, from)];
                }
                let at = instant.at(source);
                let (rate, acceleration) = (&at.motion.velocity.gradient_rate, || matrix(&member.rates[slots.rate()]));
                let turned = member.kept.as_ref().and_then(|kept| kept.along(slots, from, rate, acceleration));
                if let Some((change, grown)) = turned {
                    let first = slots.velocity().len();
                    let changed = accelerations[first..].iter_mut().zip(change.iter());
                    changed.for_each(|(acceleration, change)| *acceleration -= change);
                    growth = grown;
                }
            }
            let own = self.felt.iter().filter(|influence| influence.on == member.index);
            for Influence { coupling, lower, lift, .. } in own {
                let Some(change) = coupling.along(lower, lift, column) else { continue };
                accelerations.iter_mut().zip(change.iter()).for_each(|(sum, change)| *sum += change);
            }
            member.bordered.side(accelerations, growth, &mut self.side[range.clone()]);
        }
        factors.solve(self.side)
    }

    /// Adds what they do to the rates.
    fn add_to(&self, blocks: &mut (impl Blocks + ?Sized), (source, column): (usize, usize)) {
        for (member, range) in self.members.iter().zip(self.ranges) {
            let Some(block) = blocks.block(member.index, source) else { continue };
            let velocities = member.slots.velocities();
            for row in 0..block.nrows() {
                let into = member.with_inertia(row);
                let along = velocities.clone().zip(&self.side[range.clone()]);
                let through: f64 = along.map(|(velocity, change)| member.jacobian[(into, velocity)] * change).sum();
                let own =
                    if member.index == source { member.jacobian[(into, member.with_inertia(column))] } else { 0.0 };
                if member.index == source {
                    block[(row, column)] = own + through;
                } else {
                    block[(row, column)] += through;
                }
            }
        }
        for Influence { on, of, coupling, lower, lift } in self.others {
            let Some(block) = blocks.block(*on, source) else { continue };
            let Some(place) = self.members.iter().position(|member| member.index == *of) else { continue };
            let velocities = self.members[place].slots.velocities().len();
            let change = coupling.along_velocities(lower, lift, &self.side[self.ranges[place].clone()][..velocities]);
            lower.add_to(&mut block.column_mut(column), &change);
        }
    }
}

impl Member {
    /// Where a number of the body stands in the block that it has with inertia.
    fn with_inertia(&self, number: usize) -> usize {
        if number < self.slots.places().len() { number } else { number + self.slots.velocities().len() }
    }
}
