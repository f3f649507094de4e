//! The quantities of the theory of homogeneous strains, and the audit of its balance law.
//!
//!   K = P J Ṗᵀ,   K_o = K + (p₀ − o) ⊗ m ṗ₀,   N = P Mᵀ,   Ω = Ṗ P⁻¹,   power tr(N Ω)
//!   dK/dt = Ṗ J Ṗᵀ + N − V (S Pᵀ)ᵀ,   S Pᵀ symmetric
//!
//! M is that of all loads, about the centre of mass or the pin, and so is J; the balance takes the reaction of a guide
//! with it. The mean stress of a rigid body is the one that its balance asks for, S = (M − P̈ J)/V: its S Pᵀ is then
//! symmetric as well. Source: Sławianowski (1975), 2.7–3.9; `docs/theory-affine.md`.

use crate::body::{Body, Slots};
use crate::dynamics::{Acting, ContractileMotion, Scratch, affine_balance, body_rates, moment, reaction};
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt};
use crate::tensor::{Mat3, Polar, Vec3, cross_matrix};

/// What the theory of homogeneous strains tells of one body at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HomogeneousObservation {
    /// Ω = L = Ṗ P⁻¹ [1/s].
    pub velocity_gradient: Mat3,
    /// K_o, internal and orbital, about the origin asked for [kg m²/s].
    pub total_affine_momentum: Mat3,
    /// J Ṗᵀ P⁻ᵀ: the co-moving components P⁻¹ K P⁻ᵀ of K [kg m²/s].
    pub comoving_affine_momentum: Mat3,
    /// N [N m].
    pub affine_moment: Mat3,
    /// tr(N Ω) [W].
    pub moment_power: f64,
    /// What is left of the balance of K, P J P̈ᵀ − N + V (S Pᵀ)ᵀ [N m]: rounding.
    pub momentum_residual: Mat3,
    /// The eigenvalues of U = √(PᵀP), descending.
    pub principal_stretches: Vec3,
    /// R, P = R U.
    pub rotation: Mat3,
    /// S, first Piola stress with the pressure [Pa]; NaN without a volume.
    pub stress: Mat3,
    /// σ = S Pᵀ/det P [Pa]; NaN without a volume.
    pub cauchy_stress: Mat3,
}

/// Observes one body, given what acts on it; K_o is about `origin` [m].
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn observe_homogeneous(
    at: &BodyAt,
    acting: &Acting,
    scratch: &mut Scratch,
    origin: &Vec3,
) -> Result<HomogeneousObservation, Inadmissible> {
    let (body, motion) = (at.body, at.motion);
    let (p, rate) = (&motion.placement.gradient, &motion.velocity.gradient_rate);
    let Interior { euler_tensor, moment, balanced, acceleration, stress } = Interior::of(at, acting, scratch)?;
    let polar = Polar::of(p);
    let inverse = p.try_inverse().unwrap_or(Mat3::from_element(f64::NAN));
    let velocity_gradient = rate * inverse;
    let affine_moment = p * moment.transpose();
    let momentum = p * body.solid.mass.euler_tensor * rate.transpose();
    let arm = at.model.in_space(at.index, &motion.placement.position) - origin;
    let stretches = polar.stretch.symmetric_eigenvalues();
    let mut stretches: [f64; 3] = stretches.into();
    stretches.sort_by(|a, b| b.total_cmp(a));
    let tension = body.solid.mass.volume * (stress * p.transpose()).transpose();
    Ok(HomogeneousObservation {
        velocity_gradient,
        total_affine_momentum: momentum + body.solid.mass.mass * arm * motion.velocity.velocity.transpose(),
        comoving_affine_momentum: body.solid.mass.euler_tensor * (inverse * rate).transpose(),
        affine_moment,
        moment_power: affine_moment.dot(&velocity_gradient.transpose()),
        momentum_residual: residual(
            body,
            &(p * euler_tensor * acceleration.transpose() - p * balanced.transpose()),
            &tension,
        ),
        principal_stretches: stretches.into(),
        rotation: polar.rotation,
        stress,
        cauchy_stress: stress * p.transpose() / p.determinant(),
    })
}

/// Without a volume there is no stress to balance anything.
fn residual(body: &Body, unbalanced: &Mat3, tension: &Mat3) -> Mat3 {
    if body.solid.mass.volume > 0.0 { unbalanced + tension } else { *unbalanced }
}

/// What the balance of P is made of, about the centre of mass or the pin.
struct Interior {
    euler_tensor: Mat3,
    moment: Mat3,
    /// With the reaction of a guide.
    balanced: Mat3,
    acceleration: Mat3,
    stress: Mat3,
}

impl Interior {
    fn of(at: &BodyAt, acting: &Acting, scratch: &mut Scratch) -> Result<Self, Inadmissible> {
        let loads = &acting.total;
        let moment = moment(at, loads);
        let balanced = reaction(at, acting, scratch)?.map_or(moment, |reaction| moment + reaction.moment);
        // P̈ takes nothing of a body without inertia.
        let inertial = |acceleration| if at.body.has_inertia() { acceleration } else { Mat3::zeros() };
        let (euler_tensor, acceleration, stress) = match at.kind() {
            KindAt::Affine(affine, gyration) => {
                let balance = affine_balance(at, affine, gyration, loads);
                (affine.interior.euler_tensor, inertial(balance.acceleration), balance.stress)
            }
            KindAt::Contractile(contractile, gyration, decomposition) => {
                let balance = ContractileMotion { at, contractile, gyration, decomposition }.balance(loads);
                (contractile.affine.interior.euler_tensor, inertial(balance.acceleration), balance.stress)
            }
            KindAt::Rigid(_, turn) => {
                let acceleration = inertial(rigid_acceleration(at, &turn.spin, scratch)?);
                let euler_tensor = euler_tensor(at.body);
                (euler_tensor, acceleration, (balanced - acceleration * euler_tensor) / at.body.solid.mass.volume)
            }
        };
        Ok(Self { euler_tensor, moment, balanced, acceleration, stress })
    }
}

/// J about the pin, if there is one.
fn euler_tensor(body: &Body) -> Mat3 {
    let own = body.solid.mass.euler_tensor;
    body.pin.as_ref().map_or(own, |pin| own + body.solid.mass.mass * pin.point * pin.point.transpose())
}

/// P̈ = R ([Ω̇]× + [Ω]×²).
fn rigid_acceleration(at: &BodyAt, spin: &Vec3, scratch: &mut Scratch) -> Result<Mat3, Inadmissible> {
    let slots = Slots::with_inertia(at.body, 0);
    let mut rates = scratch.take_numbers(slots.block().len());
    let done = body_rates(at, &slots, scratch, &mut rates);
    let turning = cross_matrix(&Vec3::from_column_slice(&rates[slots.rate()]));
    scratch.give_back(rates);
    done?;
    let spin = cross_matrix(spin);
    Ok(at.motion.placement.gradient * (turning + spin * spin))
}
