//! The rates of the state: the function to read first.
//!
//!   m p̈₀ = m g + f                        f = ∫_∂D q dA
//!   P̈ J = M − V S                         M = ∫_∂D q ⊗ X dA            (affine)
//!   μ_γ Ġ G⁻¹ = Fᵀ S Gᵀ − det G φ I + Q   P = F G                       (contractile)
//!   I Ω̇ = τ − Ω × IΩ                      τ = ∫_∂D X × Rᵀq dA          (rigid, body axes)
//!
//! per body: kinematics → contact → loads → balance solved for the rates, and the powers whose integrals are the
//! works of the ledger. A body without inertia takes the velocities at which all of this is in balance (`settled`). A pinned body takes everything about its pin, r = X_p − X₀: τ_p = τ − r × Rᵀ(f + m g),
//! M_p = M − (f + m g) ⊗ r. Source: `physics.md` §2.

mod affine;
mod contractile;
mod remembered;
mod rigid;
mod settled;

use crate::body::{Body, BodyKind};
use crate::contact::{Contact, ContactScratch, Deformation, Meeting, RelativeMotion};
use crate::contractile::Nearest;
use crate::inadmissible::{Inadmissible, Quantity};
use crate::ledger::Work;
use crate::load::SpringLoads;
use crate::model::Model;
use crate::state::{BodyMotion, Turn};
use crate::surface::{GapClosed, GapField};

pub(crate) use affine::{AffineLoads, AffineMotion};
pub(crate) use contractile::ContractileMotion;
pub(crate) use remembered::RigidMemory;
pub(crate) use rigid::RigidImmersion;
pub use settled::settled_motion;
pub(crate) use settled::settled_slopes;

/// Scratch of the mechanics, reused from call to call.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    pub(crate) contact: ContactScratch,
    pub(crate) settling: settled::Settling,
}

/// The rates of all bodies and the powers of all works at time t.
///
/// `bodies` and `rates` are laid out as `Model::blocks`, `powers` [W] as `Model::works`.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model: a gap or a spring's length not above zero.
pub fn rates(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    bodies: &[f64],
    rates: &mut [f64],
    powers: &mut [f64],
) -> Result<(), Inadmissible> {
    powers.fill(0.0);
    for (index, (body, block)) in model.bodies.iter().zip(model.blocks()).enumerate() {
        let (state, rates) = (&bodies[block.clone()], &mut rates[block.clone()]);
        let done = match body.has_inertia() {
            true => body_rates(model, workspace, time, (index, state), rates)?,
            false => settled::fill(model, workspace, time, (index, state), rates)?,
        };
        for (work, power) in model.works().iter().zip(powers.iter_mut()) {
            *power += done.of(*work);
        }
    }
    Ok(())
}

/// The rates of one body from its places, velocities and contraction, and the powers of the works done on it.
pub(crate) fn body_rates(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    (index, state): (usize, &[f64]),
    rates: &mut [f64],
) -> Result<Powers, Inadmissible> {
    let body = &model.bodies[index];
    match &body.kind {
        BodyKind::Rigid(inertia) => {
            let turn = Turn::unpack(body, state);
            let motion = turn.motion(body, state);
            let (wrench, mut done) = rigid::wrench(model, workspace, time, index, (&motion, &turn))?;
            match RigidMemory::of(model, time, index, (&motion, &turn, state)) {
                None => rigid::fill(model, body, inertia, (&motion, &turn), &wrench, rates),
                Some(memory) => done.fluid += memory.fill(model, inertia, &wrench, rates),
            }
            Ok(done)
        }
        BodyKind::Affine(affine) => {
            let motion = BodyMotion::unpack(body, state);
            let moving = AffineMotion::new(index, affine, &motion)?;
            let mut loads = moving.loads(model, workspace, time)?;
            moving.fill(model, &mut loads, rates);
            Ok(loads.powers)
        }
        BodyKind::Contractile(contractile) => {
            let motion = BodyMotion::unpack(body, state);
            let moving = ContractileMotion::new(index, contractile, (&motion, time, state))?;
            let mut loads = moving.pulled.loads(model, workspace, time)?;
            moving.fill(model, &mut loads, rates);
            Ok(loads.powers)
        }
    }
}

/// The powers [W] of the works done on one body.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Powers {
    repulsion: f64,
    damping: f64,
    friction: f64,
    adhesion: f64,
    viscosity: f64,
    contraction: f64,
    drive: f64,
    load: f64,
    support: f64,
    fluid: f64,
    constraint: f64,
}

impl Powers {
    fn of(&self, work: Work) -> f64 {
        match work {
            Work::Repulsion => self.repulsion,
            Work::Damping => self.damping,
            Work::Friction => self.friction,
            Work::Adhesion => self.adhesion,
            Work::Viscosity => self.viscosity,
            Work::Contraction => self.contraction,
            Work::Drive => self.drive,
            Work::Load => self.load,
            Work::Support => self.support,
            Work::Fluid => self.fluid,
            Work::Constraint => self.constraint,
        }
    }
}

/// Hands each contact of a body to `each`, and says which support a closed gap belongs to.
pub(crate) fn for_each_contact(
    model: &Model,
    time: f64,
    index: usize,
    motion: &BodyMotion,
    each: impl FnMut(&Contact, &Meeting) -> Result<(), GapClosed>,
) -> Result<(), Inadmissible> {
    let body = &model.bodies[index];
    if body.contacts.is_empty() {
        return Ok(());
    }
    let deformation = body.affine().and_then(|_| Deformation::of(&motion.placement.gradient));
    Encounter { model, time, index, motion, deformation }.for_each_contact(each)
}

/// A body in its motion, about to meet its supports.
struct Encounter<'a> {
    model: &'a Model,
    time: f64,
    index: usize,
    motion: &'a BodyMotion,
    /// None for a rigid body.
    deformation: Option<Deformation>,
}

impl Encounter<'_> {
    /// Hands each contact to `each`, and says which support a closed gap belongs to.
    #[inline]
    fn for_each_contact(
        &self,
        mut each: impl FnMut(&Contact, &Meeting) -> Result<(), GapClosed>,
    ) -> Result<(), Inadmissible> {
        let body = &self.model.bodies[self.index];
        let Some(surface) = &body.surface else {
            return Ok(());
        };
        for contact in &body.contacts {
            let (field, relative) = meet(self.model, contact.support, self.time, self.motion);
            let meeting = Meeting { surface, field, motion: relative, deformation: self.deformation };
            let result = if surface.is_above(&field, body.least_gap(&field)) {
                each(contact, &meeting)
            } else {
                Err(GapClosed { gap: surface.smallest_gap(&field).0 })
            };
            result.map_err(|closed| {
                let quantity = Quantity::Gap { support: contact.support };
                Inadmissible { body: self.index, quantity, value: closed.gap }
            })?;
        }
        Ok(())
    }
}

/// The gap field of a support over a body, d(X) = (p₀ − o)·n + (Pᵀn)·X, and the body's motion relative to it.
pub fn meet(model: &Model, support: usize, time: f64, motion: &BodyMotion) -> (GapField, RelativeMotion) {
    let support = &model.supports[support];
    let field = GapField {
        height: support.gap(&motion.placement.position, time),
        direction: motion.placement.gradient.tr_mul(&support.normal),
    };
    let relative = RelativeMotion {
        normal: support.normal,
        velocity: motion.velocity.velocity - support.motion.velocity(time),
        gradient_rate: motion.velocity.gradient_rate,
    };
    (field, relative)
}

/// The support next to a body's surface; none without supports or surface.
pub(crate) fn nearest(model: &Model, time: f64, index: usize, motion: &BodyMotion) -> Option<Nearest> {
    let surface = model.bodies[index].surface.as_ref()?;
    let near = (0..model.supports.len()).map(|support| {
        let (field, relative) = meet(model, support, time, motion);
        let (gap, point) = surface.smallest_gap(&field);
        Nearest { gap, normal: relative.normal, point }
    });
    near.min_by(|a, b| a.gap.total_cmp(&b.gap))
}

/// Hands the loads of each spring of a body to `each`.
pub(crate) fn spring_loads(
    index: usize,
    body: &Body,
    motion: &BodyMotion,
    mut each: impl FnMut(&SpringLoads),
) -> Result<(), Inadmissible> {
    for (number, spring) in body.springs.iter().enumerate() {
        let loads = spring.loads(&motion.placement, &motion.velocity).ok_or_else(|| {
            let quantity = Quantity::SpringLength { spring: number };
            Inadmissible { body: index, quantity, value: spring.length(&motion.placement) }
        })?;
        each(&loads);
    }
    Ok(())
}
