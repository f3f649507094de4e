//! What the guide of a body makes of its accelerations, and the force that it takes.
//!
//!   p̈₀ = Π_c a,   Ω̇ = Π_t α,   P̈ = H A = Π A + λ ΠY,   λ = c·(A − ΠA)/(c·ΠY)
//!
//! a, α, A are the accelerations without the guide. λ is what the pressure of an incompressible body grows by, so that
//! tr(P̈ P⁻¹) = c·P̈ stays what it has to be: c = P⁻ᵀ, Y = P⁻ᵀJ⁻¹. H is linear, and serves changes of A as well; its
//! own change along δP is that of c and Y,
//!
//!   δH A = λ Πδ(Y) + ΠY (δc·(A − P̈) − λ c·Πδ(Y))/(c·ΠY)
//!
//! The reaction is (P̈ − A − λY) J, orthogonal to all that the body can do. Source: `docs/theory-affine.md`.

use super::Scratch;
use super::affine::moment;
use super::contractile::ContractileMotion;
use super::loads::Acting;
use super::rigid;
use crate::affine::{AffineBody, Gyration, StrainGuide};
use crate::body::{Guide, Slots};
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt, MotionAt};
use crate::load::Loads;
use crate::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::DMatrix;

/// How a body that deforms is kept to its gradients at an instant.
#[derive(Debug)]
pub(super) struct GuidedStrain<'a> {
    strain: &'a StrainGuide,
    volume: Option<GuidedVolume>,
}

/// What keeps tr(P̈ P⁻¹).
#[derive(Debug)]
struct GuidedVolume {
    /// P⁻¹.
    inverse: Mat3,
    /// J⁻¹.
    mobility: Mat3,
    /// ΠY.
    way: Mat3,
    /// 1/(c·ΠY).
    compliance: f64,
}

impl<'a> GuidedStrain<'a> {
    /// Of a body whose pressure keeps the second derivative of det P, or has no such pressure; none without a guide.
    pub fn of(interior: &'a AffineBody, gyration: &Gyration, keeps_volume: bool) -> Option<Self> {
        let strain = interior.guide.as_deref()?;
        let volume = keeps_volume.then(|| {
            let (inverse, way) = (gyration.inverse, interior.way(&gyration.inverse));
            let compliance = 1.0 / way.dot(&inverse.transpose());
            GuidedVolume { inverse, mobility: interior.inverse, way, compliance }
        });
        Some(Self { strain, volume })
    }

    /// Of a body at an instant; none of one that is rigid or has no guide.
    fn at(at: &MotionAt<'a>) -> Option<Self> {
        match at.kind() {
            KindAt::Rigid(..) => None,
            KindAt::Affine(affine, gyration) => {
                Self::of(&affine.interior, gyration, affine.interior.is_incompressible())
            }
            KindAt::Contractile(contractile, gyration, _) => {
                let interior = &contractile.affine.interior;
                let keeps_volume = interior.is_incompressible() && !contractile.contraction.gives_pressure();
                Self::of(interior, gyration, keeps_volume)
            }
        }
    }

    /// H A, and λ.
    pub fn hold(&self, acceleration: &Mat3) -> (Mat3, f64) {
        let within = self.strain.within(acceleration);
        let Some(GuidedVolume { inverse, way, compliance, .. }) = &self.volume else { return (within, 0.0) };
        let push = (acceleration - within).dot(&inverse.transpose()) * compliance;
        (within + way * push, push)
    }

    /// δH A along δP_jB, given A.
    fn along(&self, (j, b): (usize, usize), acceleration: &Mat3) -> Mat3 {
        let Some(GuidedVolume { inverse, mobility, way, compliance }) = &self.volume else { return Mat3::zeros() };
        let (held, push) = self.hold(acceleration);
        // δP = e_j ⊗ e_B: δ(P⁻ᵀ) = −P⁻ᵀ δPᵀ P⁻ᵀ.
        let turned = -(inverse.row(b).transpose() * inverse.column(j).transpose());
        let change = push * self.strain.within(&(turned * mobility));
        let missing = turned.dot(&(acceleration - held)) - change.dot(&inverse.transpose());
        change + way * (missing * compliance)
    }
}

/// The guide of a body at an instant, for changes of its accelerations.
#[derive(Debug)]
pub(super) struct Guided<'a> {
    guide: &'a Guide,
    strain: Option<GuidedStrain<'a>>,
    slots: Slots,
}

impl<'a> Guided<'a> {
    /// None of a body without a guide.
    pub fn at(at: &MotionAt<'a>) -> Option<Self> {
        let guide = at.body.guide.as_deref()?;
        Some(Self { guide, strain: GuidedStrain::at(at), slots: Slots::with_inertia(at.body, 0) })
    }

    /// H of changes of the rates of (velocity, rate).
    pub fn hold(&self, changes: &mut [f64]) {
        let (linear, own) = changes.split_at_mut(self.slots.velocity().len());
        if let (Some(center), false) = (&self.guide.center, linear.is_empty()) {
            linear.copy_from_slice((center * Vec3::from_column_slice(linear)).as_slice());
        }
        if let Some(strain) = &self.strain {
            own.copy_from_slice(strain.hold(&Mat3::from_column_slice(own)).0.as_slice());
        } else if let Some(turn) = &self.guide.turn {
            own.copy_from_slice(turn.within(&Vec3::from_column_slice(own)).as_slice());
        }
    }
}

/// Takes the block of a body with a guide, as it would be without, to that with it.
pub(super) fn hold_block(at: &BodyAt, scratch: &mut Scratch, block: &mut DMatrix<f64>) -> Result<(), Inadmissible> {
    let Some(guided) = Guided::at(at) else { return Ok(()) };
    let rows = guided.slots.velocities();
    for mut column in block.column_iter_mut() {
        guided.hold(&mut column.as_mut_slice()[rows.clone()]);
    }
    let Some(strain) = guided.strain.as_ref().filter(|strain| strain.volume.is_some()) else { return Ok(()) };
    let acceleration = free_acceleration(at, &super::acting(at, scratch)?.total);
    for (entry, column) in guided.slots.attitude().enumerate() {
        let change = strain.along((entry % 3, entry / 3), &acceleration);
        let mut column = block.column_mut(column);
        column.rows_mut(guided.slots.rate().start, 9).iter_mut().zip(&change).for_each(|(sum, part)| *sum += part);
    }
    Ok(())
}

/// A of a body that deforms under some loads \[1/s²\].
fn free_acceleration(at: &MotionAt, loads: &Loads) -> Mat3 {
    match at.kind() {
        KindAt::Rigid(..) => Mat3::zeros(),
        KindAt::Affine(affine, gyration) => affine.interior.balance(gyration, &moment(at, loads)).acceleration,
        KindAt::Contractile(contractile, gyration, decomposition) => {
            ContractileMotion { at, contractile, gyration, decomposition }.free_balance(loads).acceleration
        }
    }
}

/// The force \[N\] and the affine moment \[N m\] by which a guide keeps a body, about its centre or its pin; of a rigid
/// body M = ½ R [τ]×, τ the torque in its own axes. None of a body without a guide.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn reaction(at: &BodyAt, acting: &Acting, scratch: &mut Scratch) -> Result<Option<Loads>, Inadmissible> {
    let Some(guide) = at.body.guide.as_deref() else { return Ok(None) };
    let mass = at.body.solid.mass.mass;
    let moves = if at.body.has_inertia() { 1.0 } else { 0.0 };
    let load = mass * at.model.gravity + acting.total.force;
    let force = guide.center.filter(|_| at.body.pin.is_none()).map_or_else(Vec3::zeros, |center| center * load - load);
    let moment = match at.kind() {
        KindAt::Rigid(inertia, turn) => {
            let Some(guide) = &guide.turn else { return Ok(Some(Loads { force, moment: Mat3::zeros() })) };
            let (wrench, _) = rigid::wrench(at, turn, scratch)?;
            let torque = rigid::unbalanced(at, inertia, turn, &wrench);
            let held = inertia.tensor * guide.within(&(inertia.inverse * torque)) - torque;
            at.motion.placement.gradient * (0.5 * cross_matrix(&held))
        }
        KindAt::Affine(affine, gyration) => {
            let interior = &affine.interior;
            strain_reaction(at, (interior, gyration), &free_acceleration(at, &acting.total), moves)
        }
        KindAt::Contractile(contractile, gyration, _) => {
            let interior = &contractile.affine.interior;
            strain_reaction(at, (interior, gyration), &free_acceleration(at, &acting.total), moves)
        }
    };
    Ok(Some(Loads { force, moment }))
}

/// (P̈ − A − λY) J, `moves` being one of a body with inertia; one without does not accelerate, and its pressure takes
/// the rest.
fn strain_reaction(at: &MotionAt, (interior, gyration): (&AffineBody, &Gyration), free: &Mat3, moves: f64) -> Mat3 {
    let Some(strain) = GuidedStrain::at(at) else { return Mat3::zeros() };
    let (held, push) = strain.hold(free);
    let across = gyration.inverse.transpose();
    let left = match &strain.volume {
        Some(GuidedVolume { way, .. }) => (1.0 - moves) * held.dot(&across) / way.dot(&across),
        None => 0.0,
    };
    (moves * held - free) * interior.euler_tensor - (push - left) * across
}
