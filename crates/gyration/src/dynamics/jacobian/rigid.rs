//! The block of a rigid body: how the wrench on it changes with its motion, and its balance with that.
//!
//! The increments are those of the place δp₀, the turn δθ (δR = R[δθ]×), the velocity δṗ₀ and the spin δΩ. With them
//!
//!   contact   δg₀ = n·δp₀,   δw₀ = δṗ₀
//!   pin       δp₀ = R(r×δθ),   δṗ₀ = R((Ω×r)×δθ + r×δΩ),   τ_p = τ − r×Rᵀ(f + m g)
//!   balance   m p̈₀ = m g + f,   I Ω̇ = τ − Ω × IΩ,   δ(Ω × IΩ) = ([Ω]× I − [IΩ]×) δΩ
//!
//! Columns of the quaternion come from those of δθ by δθ = 2 vec(q⁻¹ ∘ δq).

use super::super::Scratch;
use super::super::contacts::{meet, turning_of};
use super::super::immersed::RigidImmersion;
use super::super::loads::add_slopes;
use super::super::rigid::{is_negligible, relative_motion};
use crate::acting::Load;
use crate::body::{Body, RigidInertia, Slots};
use crate::contact::{ContactWrench, Meeting, RigidMotion};
use crate::inadmissible::Inadmissible;
use crate::instant::BodyAt;
use crate::load::{LoadSlopes, Loads, Wrench, WrenchSlope};
use crate::state::Turn;
use crate::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::{DMatrix, SMatrix};
use std::ops::Range;

/// The wrench and its derivatives by the twelve increments.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RigidSlopes {
    pub wrench: Wrench,
    pub by_place: WrenchSlope,
    pub by_turn: WrenchSlope,
    pub by_velocity: WrenchSlope,
    pub by_spin: WrenchSlope,
}

/// How contacts and the fluid act, about the pin if there is one; and what other loads do, by (p₀ | P).
pub(super) fn slopes(
    at: &BodyAt,
    turn: &Turn,
    scratch: &mut Scratch,
) -> Result<(RigidSlopes, Option<LoadSlopes>), Inadmissible> {
    let mut slopes = RigidSlopes::default();
    let others = slopes.add_all(at, turn, scratch)?;
    if let Some(pin) = &at.body.pin {
        let weight = at.body.solid.mass.mass * at.model.gravity;
        slopes.tie_to_pin(&pin.point, &weight, &at.motion.placement.gradient, turn);
    }
    Ok((slopes, others))
}

/// Writes a matrix into a block at the rows and columns of two slots.
pub(super) fn write<const ROWS: usize, const COLUMNS: usize>(
    block: &mut DMatrix<f64>,
    (rows, columns): (Range<usize>, Range<usize>),
    part: &SMatrix<f64, ROWS, COLUMNS>,
) {
    block.fixed_view_mut::<ROWS, COLUMNS>(rows.start, columns.start).copy_from(part);
}

/// ∂(Ω × IΩ)/∂Ω.
pub(super) fn gyroscopic(body: &Body, inertia: &RigidInertia, turn: &Turn) -> Mat3 {
    if !body.has_inertia() {
        return Mat3::zeros();
    }
    cross_matrix(&turn.spin) * inertia.tensor - cross_matrix(&(inertia.tensor * turn.spin))
}

impl RigidSlopes {
    /// Adds contacts and the fluid; returns what other loads do, whose derivatives are those by (p₀ | P).
    fn add_all(&mut self, at: &BodyAt, turn: &Turn, scratch: &mut Scratch) -> Result<Option<LoadSlopes>, Inadmissible> {
        let rotation = &at.motion.placement.gradient;
        let mut others: Option<LoadSlopes> = None;
        at.try_each_load(|load| {
            match &load {
                Load::Contact(contact) if is_negligible(at, turn, contact) => {}
                Load::Contact(contact) => {
                    let integrated = meet(at, contact, |meeting| {
                        let Meeting { surface, field, .. } = meeting;
                        let relative = relative_motion(at, turn, contact, &meeting.motion);
                        let wrench = ContactWrench::integrate(
                            &contact.law_set,
                            surface,
                            field,
                            &relative,
                            &mut scratch.contact,
                        )?;
                        Ok((wrench, relative))
                    })?;
                    if let Some((wrench, relative)) = integrated {
                        self.add_contact(&wrench, &relative);
                        if let Some(spin) = turning_of(at, contact) {
                            self.carry(&wrench, &spin, rotation);
                        }
                    }
                }
                Load::Fluid(..) => {
                    if let Some(immersed) = RigidImmersion::of(at) {
                        self.add_fluid(&immersed);
                    }
                }
                load => add_slopes(load, at, scratch, others.get_or_insert_default())?,
            }
            Ok(())
        })?;
        if let Some(others) = &others {
            self.add_loads(&others.loads, rotation);
        }
        Ok(others)
    }

    /// Fills the block of a body that may be pinned: rows and columns of slots that it does not have are left out.
    pub fn fill(&self, block: &mut DMatrix<f64>, body: &Body, inertia: &RigidInertia, turn: &Turn) {
        let slots = Slots::with_inertia(body, 0);
        let turns = turn.quaternion.turn_by_component();
        let (attitude, rate) = (|| slots.attitude(), || slots.rate());
        write(block, (attitude(), attitude()), &turn.quaternion.rate_by_component(&turn.spin));
        write(block, (attitude(), rate()), &turn.quaternion.rate_by_spin());
        write(block, (rate(), attitude()), &(inertia.inverse * self.by_turn.torque * turns));
        write(block, (rate(), rate()), &(inertia.inverse * (self.by_spin.torque - gyroscopic(body, inertia, turn))));
        if body.pin.is_some() {
            return;
        }
        let mobility = 1.0 / body.solid.mass.mass;
        let (position, velocity) = (|| slots.position(), || slots.velocity());
        write(block, (position(), velocity()), &Mat3::identity());
        write(block, (velocity(), position()), &(self.by_place.force * mobility));
        write(block, (velocity(), attitude()), &(self.by_turn.force * mobility * turns));
        write(block, (velocity(), velocity()), &(self.by_velocity.force * mobility));
        write(block, (velocity(), rate()), &(self.by_spin.force * mobility));
        write(block, (rate(), position()), &(inertia.inverse * self.by_place.torque));
        write(block, (rate(), velocity()), &(inertia.inverse * self.by_velocity.torque));
    }

    /// Adds a contact.
    fn add_contact(&mut self, contact: &ContactWrench, motion: &RigidMotion) {
        let along = motion.normal.transpose();
        let Wrench { force, torque } = &contact.by_height;
        self.wrench += contact.wrench;
        self.by_place += WrenchSlope { force: force * along, torque: torque * along };
        self.by_turn += contact.by_turn;
        self.by_velocity += contact.by_velocity;
        self.by_spin += contact.by_spin;
    }

    /// Adds how the motion relative to a support that turns at ω changes with place and turn: δw₀ = −ω × δp₀, δ(Ω −
    /// Rᵀω) = −Rᵀω × δθ.
    fn carry(&mut self, contact: &ContactWrench, spin: &Vec3, rotation: &Mat3) {
        self.by_place += contact.by_velocity.times(&-cross_matrix(spin));
        self.by_turn += contact.by_spin.times(&-cross_matrix(&rotation.tr_mul(spin)));
    }

    /// Adds other loads and the change of their torque with the axes in which it is told, N = RᵀM: the rest is B ∂Q A.
    ///
    ///   δτ = axial(δRᵀ M) = (N − tr N 1) δθ
    fn add_loads(&mut self, loads: &Loads, rotation: &Mat3) {
        let seen = rotation.tr_mul(&loads.moment);
        self.wrench += loads.wrench(rotation);
        self.by_turn.torque += seen - Mat3::from_diagonal_element(seen.trace());
    }

    /// Adds the fluid.
    fn add_fluid(&mut self, immersed: &RigidImmersion) {
        let slopes = immersed.drag.slopes();
        self.wrench += immersed.wrench();
        self.by_place += slopes.by_place;
        self.by_turn += slopes.by_turn;
        self.by_turn += immersed.lift_by_turn();
        self.by_velocity += slopes.by_velocity;
        self.by_spin += slopes.by_spin;
    }

    /// Ties the place and the velocity to the turn and the spin about a pin at `arm` = r, and takes torques about it.
    ///
    /// `weight` is m g [N].
    fn tie_to_pin(&mut self, arm: &Vec3, weight: &Vec3, rotation: &Mat3, turn: &Turn) {
        let across = cross_matrix(arm);
        let (swing, sway) = (rotation * across, rotation * cross_matrix(&turn.spin.cross(arm)));
        self.by_turn += self.by_place.times(&swing);
        self.by_turn += self.by_velocity.times(&sway);
        self.by_spin += self.by_velocity.times(&swing);
        let force = rotation.tr_mul(&(self.wrench.force + weight));
        self.by_turn.torque -= across * (rotation.tr_mul(&self.by_turn.force) + cross_matrix(&force));
        self.by_spin.torque -= across * rotation.tr_mul(&self.by_spin.force);
    }
}
