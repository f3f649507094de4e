//! The one loop over what acts on a body: f, M and powers, their derivatives, and stored energies.
//!
//! Each load answers in the coordinates (p₀ | P) common to all kinds, Q = (f | M). A rigid body is told of a contact
//! and of the fluid in its own ten numbers instead, since normal and tangential parts must not be mixed
//! (`contact/wrench`); every other load reaches it through Q.

use super::Scratch;
use super::contacts::{carrying, meet, turning_of};
use super::immersed::{RigidImmersion, beside_walls, immersion};
use super::powers::Powers;
use crate::acting::{Load, PairAt};
use crate::contact::{ContactLoads, ContactSlopes, LawKind, contact_potential};
use crate::inadmissible::{FormulaOf, Inadmissible, Quantity};
use crate::instant::{BodyAt, MotionAt};
use crate::kinematics::Velocity;
use crate::ledger::{Energy, Work};
use crate::load::{LoadSlopes, Loads, Party};
use crate::pair::PairSlopes;
use crate::tensor::{Vec3, cross_matrix};
use gyration_expression::Undefined;

/// What acts on a body, gravity aside.
#[derive(Debug, Clone, Copy, Default)]
pub struct Acting {
    /// f and M of the contacts.
    pub contact: Loads,
    /// f and M of all loads.
    pub total: Loads,
    /// The powers of their works.
    pub(crate) powers: Powers,
}

/// f and M of all loads on a body, and the powers of their works.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn acting(at: &BodyAt, scratch: &mut Scratch) -> Result<Acting, Inadmissible> {
    let mut sum = Acting::default();
    sum.add_all(at, scratch)?;
    Ok(sum)
}

/// f of all contacts of a body, with supports and other bodies [N].
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub(super) fn contact_force(at: &BodyAt, scratch: &mut Scratch) -> Result<Vec3, Inadmissible> {
    let mut sum = Acting::default();
    at.try_each_load(|load| match load {
        Load::Contact(_) | Load::Pair(_) => sum.add(&load, at, scratch),
        _ => Ok(()),
    })?;
    Ok(sum.contact.force)
}

impl Acting {
    /// Adds all loads on a body.
    #[inline]
    pub(super) fn add_all(&mut self, at: &BodyAt, scratch: &mut Scratch) -> Result<(), Inadmissible> {
        at.try_each_load(|load| self.add(&load, at, scratch))
    }

    /// Adds a load.
    #[inline]
    pub(super) fn add(&mut self, load: &Load, at: &BodyAt, scratch: &mut Scratch) -> Result<(), Inadmissible> {
        let velocity = &at.motion.velocity;
        match load {
            Load::Contact(contact) => {
                let integrated =
                    meet(at, contact, |it| ContactLoads::integrate(&contact.law_set, it, &mut scratch.contact))?;
                let Some(loads) = integrated else { return Ok(()) };
                let total = loads.total();
                for law in LawKind::ALL {
                    self.powers.add(law, loads.relative_power(law));
                }
                let carried = carrying(at, contact);
                self.powers[Work::Support] += total.force.dot(&carried.at(&at.motion.placement.position));
                if let Some(spin) = &carried.spin {
                    self.powers[Work::Support] +=
                        total.moment.dot(&(cross_matrix(spin) * at.motion.placement.gradient));
                }
                self.contact += total;
                self.total += total;
            }
            Load::Spring(end) => {
                let spring = at.spring(end);
                if end.counts() {
                    self.powers[Work::Load] += spring.dashpot_power;
                    self.powers[Work::Support] += spring.anchor_power;
                }
                self.total += end.loads(spring);
            }
            Load::Bond(end) => {
                let bond = at.bond(end);
                if end.counts() {
                    self.powers[Work::Load] += bond.power;
                }
                self.total += bond.on[end.end];
            }
            Load::Pair(pair) => {
                if pair.end.counts() {
                    for law in LawKind::ALL {
                        self.powers.add(law, pair.loads.powers[law as usize]);
                    }
                    if let Party::SolidSupport(support) = pair.other() {
                        // What pushes the support does the work that its own load takes.
                        let Velocity { velocity, gradient_rate } = &at.support_motion(support).velocity;
                        self.powers[Work::Support] -= pair.loads.on[1].power(velocity, gradient_rate);
                    }
                }
                self.contact += *pair.on_body();
                self.total += *pair.on_body();
            }
            Load::Joint(end) => {
                let joint = at.joint(end);
                self.powers[Work::Constraint] += joint.kept[end.end].power(&velocity.velocity, &velocity.gradient_rate);
                if end.counts() {
                    self.powers[Work::Load] += joint.motor.power;
                    if let Some([kept, all]) = end.interaction.powers_on_support(at.time, joint) {
                        self.powers[Work::Constraint] += kept;
                        self.powers[Work::Support] -= all;
                    }
                }
                self.total += joint.on(end.end);
            }
            Load::Couple(couple) => {
                let moment = couple.moment(at.time, &at.inverse());
                self.powers[Work::Load] += moment.dot(&velocity.gradient_rate);
                self.total.moment += moment;
            }
            Load::Applied(applied) => {
                let loads = applied.loads(&at.inverse());
                self.powers[Work::Load] += loads.power(&velocity.velocity, &velocity.gradient_rate);
                self.total += loads;
            }
            Load::Resistance(resistance) => {
                let loads = resistance.loads(&at.motion.placement.gradient, &at.inverse(), velocity);
                if resistance.dissipates() {
                    self.powers[Work::Viscosity] += loads.power(&velocity.velocity, &velocity.gradient_rate);
                }
                self.total += loads;
            }
            Load::Potential(potential) => {
                let loads = potential.loads(&at.motion.placement, at.time, &mut scratch.formulas);
                let loads = loads.map_err(undefined(at, FormulaOf::Potential))?;
                if !potential.is_energy() {
                    self.powers[Work::Load] += loads.power(&velocity.velocity, &velocity.gradient_rate);
                }
                self.total += loads;
            }
            Load::BodyForce(body_force) => {
                let loads = body_force.loads(&at.motion.placement, at.time, &mut scratch.formulas);
                let loads = loads.map_err(undefined(at, FormulaOf::BodyForce))?;
                self.powers[Work::Load] += loads.power(&velocity.velocity, &velocity.gradient_rate);
                self.total += loads;
            }
            Load::PointForce(point_force) => {
                let loads = point_force.loads(&at.motion.placement, at.time, &mut scratch.formulas);
                let loads = loads.map_err(undefined(at, FormulaOf::PointForce))?;
                self.powers[Work::Load] += loads.power(&velocity.velocity, &velocity.gradient_rate);
                self.total += loads;
            }
            Load::OwnFriction(friction) => {
                let place = (&at.motion.placement, at.time);
                let loads = friction.loads(place, &at.inverse(), velocity, &mut scratch.formulas);
                let loads = loads.map_err(undefined(at, FormulaOf::Friction))?;
                self.powers[Work::Viscosity] += loads.power(&velocity.velocity, &velocity.gradient_rate);
                self.total += loads;
            }
            Load::MassFriction(friction) => {
                let loads = friction.loads(&at.body.solid.mass, velocity);
                self.powers[Work::Viscosity] += loads.power(&velocity.velocity, &velocity.gradient_rate);
                self.total += loads;
            }
            Load::SelfGravity(gravity) => self.total.moment += gravity.moment(&at.motion.placement.gradient),
            Load::Fluid(..) => {
                let Some(loads) = fluid(at)? else { return Ok(()) };
                self.powers[Work::Fluid] += loads.power(&velocity.velocity, &velocity.gradient_rate);
                self.total += loads;
            }
            Load::Walls(radius) => {
                let loads = beside_walls(at, *radius)?.loads(&at.motion.placement.gradient);
                self.powers[Work::Fluid] += loads.power(&velocity.velocity, &velocity.gradient_rate);
                self.total += loads;
            }
            Load::Neighbours(place) => {
                let loads = at.spheres().loads(*place, &at.motion.placement.gradient);
                self.powers[Work::Fluid] += loads.power(&velocity.velocity, &velocity.gradient_rate);
                self.total += loads;
            }
        }
        Ok(())
    }
}

/// A formula of a body that is undefined where the body is.
pub(super) fn undefined(at: &MotionAt, of: FormulaOf) -> impl Fn(Undefined) -> Inadmissible {
    move |undefined| at.outside(Quantity::Formula { of, undefined }, undefined.argument)
}

/// f and M of the fluid; none where its form does not go with the kind of the body.
#[inline]
fn fluid(at: &MotionAt) -> Result<Option<Loads>, Inadmissible> {
    match at.gyration() {
        None => Ok(RigidImmersion::of(at).map(|immersed| immersed.loads(&at.motion.placement.gradient))),
        Some(gyration) => Ok(immersion(at)?.map(|immersed| immersed.loads(gyration))),
    }
}

/// Adds the derivatives of a load by (p₀ | P) and their rates, and the load itself.
pub(super) fn add_slopes(
    load: &Load,
    at: &BodyAt,
    scratch: &mut Scratch,
    slopes: &mut LoadSlopes,
) -> Result<(), Inadmissible> {
    match load {
        Load::Contact(contact) => {
            let integrated =
                meet(at, contact, |it| ContactSlopes::integrate(&contact.law_set, it, &mut scratch.contact))?;
            match (integrated, turning_of(at, contact)) {
                (None, _) => {}
                (Some(contact), None) => contact.add_to(slopes),
                (Some(contact), Some(spin)) => {
                    let mut own = LoadSlopes::default();
                    contact.add_to(&mut own);
                    slopes.add_turned(&own, &spin);
                }
            }
        }
        Load::Spring(end) => slopes.add_spring(end, at.spring(end)),
        Load::Bond(end) => slopes.add_bond(end, at.bond(end), at.bond_slopes(end)),
        Load::Pair(pair) => {
            let (own, found) = (pair.end.end, sloped(pair));
            slopes.loads += *pair.on_body();
            slopes.by_place += found.by_place[own][own];
            if let Some(by_rate) = &found.by_rate {
                slopes.by_rate += by_rate[own][own];
            }
        }
        Load::Joint(end) => {
            let loads = at.joint(end);
            slopes.loads += loads.on(end.end);
            slopes.by_place += end.interaction.slope(loads, [end.end, end.end]);
            if let Some(motor) = at.motor_slopes(end) {
                slopes.by_place += motor.by_place[end.end][end.end];
                slopes.by_rate += motor.by_rate[end.end][end.end];
            }
        }
        Load::Couple(couple) => {
            let inverse = at.inverse();
            slopes.add_couple(&couple.moment(at.time, &inverse), &inverse);
        }
        Load::Applied(applied) => slopes.add_applied(applied, &at.inverse()),
        Load::Resistance(resistance) => {
            slopes.add_resistance(resistance, (&at.motion.placement, &at.inverse(), &at.motion.velocity));
        }
        Load::Potential(potential) => {
            let placement = &at.motion.placement;
            let added = slopes.add_potential(potential, placement, at.time, &mut scratch.formulas);
            added.map_err(undefined(at, FormulaOf::Potential))?;
        }
        Load::BodyForce(body_force) => {
            let added = slopes.add_body_force(body_force, &at.motion.placement, at.time, &mut scratch.formulas);
            added.map_err(undefined(at, FormulaOf::BodyForce))?;
        }
        Load::PointForce(point_force) => {
            let added = slopes.add_point_force(point_force, &at.motion.placement, at.time, &mut scratch.formulas);
            added.map_err(undefined(at, FormulaOf::PointForce))?;
        }
        Load::OwnFriction(friction) => {
            let (place, velocity) = ((&at.motion.placement, at.time), &at.motion.velocity);
            let added = slopes.add_own_friction(friction, place, &at.inverse(), velocity, &mut scratch.formulas);
            added.map_err(undefined(at, FormulaOf::Friction))?;
        }
        Load::MassFriction(friction) => {
            slopes.add_mass_friction(friction, &at.body.solid.mass, &at.motion.velocity);
        }
        Load::SelfGravity(gravity) => slopes.add_self_gravity(gravity, &at.motion.placement.gradient),
        Load::Fluid(..) => {
            if let (Some(gyration), Some(immersed)) = (at.gyration(), immersion(at)?) {
                immersed.add_to(slopes, gyration);
            }
        }
        Load::Walls(radius) => {
            let gradient = &at.motion.placement.gradient;
            let walls = beside_walls(at, *radius)?;
            let [by_place, by_rate] = walls.slopes(gradient, (&at.inverse(), &at.motion.velocity.gradient_rate));
            slopes.loads += walls.loads(gradient);
            slopes.by_place += by_place;
            slopes.by_rate += by_rate;
        }
        Load::Neighbours(place) => {
            let gradient = &at.motion.placement.gradient;
            let moving = (&at.inverse(), &at.motion.velocity.gradient_rate);
            let [by_place, by_rate] = at.spheres().coupling([*place, *place], gradient, moving);
            slopes.loads += at.spheres().loads(*place, gradient);
            slopes.by_place += by_place;
            slopes.by_rate += by_rate;
        }
    }
    Ok(())
}

/// The derivatives of a pair at an instant of which they were asked.
pub(super) fn sloped<'a>(pair: &PairAt<'a>) -> &'a PairSlopes {
    pair.slopes.unwrap_or_else(|| unreachable!("a Jacobian is that of an instant with derivatives"))
}

/// The energy [J] that the loads of a body store in one column of the ledger.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn stored_energy(at: &BodyAt, scratch: &mut Scratch, energy: Energy) -> Result<f64, Inadmissible> {
    let mut total = 0.0;
    at.try_each_load(|load| {
        if load.energy() == Some(energy) {
            total += match load {
                Load::Contact(contact) => {
                    meet(at, contact, |it| contact_potential(&contact.law_set, it, &mut scratch.contact))?
                        .unwrap_or(0.0)
                }
                Load::Spring(end) if end.counts() => end.interaction.law.energy(at.spring(&end).length),
                Load::Bond(end) if end.counts() => at.bond(&end).energy,
                Load::Joint(end) if end.counts() => at.joint(&end).motor.energy,
                Load::Pair(pair) if pair.end.counts() => pair.loads.energy,
                Load::Potential(potential) => {
                    let energy = potential.energy(&at.motion.placement, at.time, &mut scratch.formulas);
                    energy.map_err(undefined(at, FormulaOf::Potential))?
                }
                Load::SelfGravity(gravity) => gravity.energy(&at.motion.placement.gradient),
                Load::Spring(_)
                | Load::Bond(_)
                | Load::Pair(_)
                | Load::Joint(_)
                | Load::Couple(_)
                | Load::Applied(_)
                | Load::Resistance(_)
                | Load::BodyForce(_)
                | Load::PointForce(_)
                | Load::OwnFriction(_)
                | Load::MassFriction(_)
                | Load::Fluid(..)
                | Load::Walls(_)
                | Load::Neighbours(_) => 0.0,
            };
        }
        Ok(())
    })?;
    Ok(total)
}
