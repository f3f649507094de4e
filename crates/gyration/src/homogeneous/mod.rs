//! The quantities of the theory of homogeneous strains, and the audit of its balance law.
//!
//!   K = P J Ṗᵀ,   K_o = K + (p₀ − o) ⊗ m ṗ₀,   N = P Mᵀ,   N_o = N + (p₀ − o) ⊗ f,   Ω = Ṗ P⁻¹,   power tr(N Ω)
//!   dK/dt = Ṗ J Ṗᵀ + N − V (S Pᵀ)ᵀ,   S Pᵀ symmetric
//!   T = ½ m|ṗ₀|² + ½ tr(Ṗ J Ṗᵀ),   ∂T/∂Ṗ = Ṗ J,   2 ∂T/∂g = Ṗ J Ṗᵀ
//!
//! M is that of all loads, about the centre of mass or the pin, and so is J; about the pin N has the moment of the
//! weight too. The balance takes the reaction of a guide with it. The mean stress of a rigid body is the one that its
//! balance asks for, S = (M − P̈ J)/V: its S Pᵀ is then symmetric as well. Of a body without inertia T and its
//! derivative by the metric are zero, as P̈ is; its momenta are told all the same. `elasticity` has what the material
//! does, `two_polar` how the frames of P = L D Rᵀ turn. Source: Sławianowski (1975), 2.7–3.9, 4.6–4.13;
//! `docs/theory-affine.md`, `docs/equations.md`.

mod elasticity;
mod interior;
mod local;
mod two_polar;

pub use elasticity::Elasticity;
pub use local::BodyBalance;

use crate::body::Body;
use crate::dynamics::{Acting, Scratch, about_pin, linear_friction, of_history, reaction};
use crate::inadmissible::Inadmissible;
use crate::instant::BodyAt;
use crate::tensor::{Mat3, Polar, Vec3};
use interior::Interior;
use two_polar::spin_and_vorticity;

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
    /// [ω]× = L̇ Lᵀ of P = L D Rᵀ, in the axes of space [rad/s]; NaN where two principal stretches meet.
    pub spin: Vec3,
    /// [ϑ]× = Ṙ Rᵀ, in the axes of the reference placement [rad/s]; NaN where two principal stretches meet.
    pub vorticity: Vec3,
    /// S, first Piola stress with the pressure [Pa]; NaN without a volume.
    pub stress: Mat3,
    /// σ = S Pᵀ/det P [Pa]; NaN without a volume.
    pub cauchy_stress: Mat3,
    /// f of all loads, the weight and the reaction of a pin aside [N].
    pub total_force: Vec3,
    /// M of the same loads [N m].
    pub total_moment: Mat3,
    /// N_o of the same loads, internal and orbital, about the origin asked for [N m].
    pub total_affine_moment: Mat3,
    /// D, the affine moment of all friction but that of contacts: P Mᵀ of linear friction − V τ of internal [N m].
    pub friction_moment: Mat3,
    /// Ṗ J Ṗᵀ [J].
    pub kinetic_tensor: Mat3,
    /// Ṗ J, conjugate to P [kg m²/s].
    pub canonical_momentum: Mat3,
    /// ½ m|ṗ₀|² [J].
    pub kinetic_energy_of_centre: f64,
    /// ½ tr(Ṗ J Ṗᵀ), J about the centre of mass [J].
    pub internal_kinetic_energy: f64,
    /// What the material does.
    pub elasticity: Elasticity,
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
    let mut loads = acting.total;
    loads += of_history(at, scratch)?;
    let guided = reaction(at, acting, scratch)?.map_or_else(Mat3::zeros, |reaction| reaction.moment);
    let interior = Interior::of(at, (&loads, &guided), scratch)?;
    let Interior { euler_tensor, moment, acceleration, stress, .. } = interior;
    let balanced = moment + guided;
    let elasticity = Elasticity::of(at, &interior);
    let about = about_pin(at, &loads);
    let friction = p * linear_friction(at, scratch)?.moment.transpose();
    // A body without inertia takes no part in T.
    let inertia = if body.has_inertia() { 1.0 } else { 0.0 };
    let polar = Polar::of(p);
    let inverse = p.try_inverse().unwrap_or(Mat3::from_element(f64::NAN));
    let velocity_gradient = rate * inverse;
    let [spin, vorticity] = spin_and_vorticity(p, rate);
    let affine_moment = p * moment.transpose();
    let momentum = body.affine_momentum(p, rate);
    let arm = at.model.in_space(at.index, &motion.placement.position) - origin;
    let stretches = polar.stretch.symmetric_eigenvalues();
    let mut stretches: [f64; 3] = stretches.into();
    stretches.sort_by(|a, b| b.total_cmp(a));
    let [kinetic_tensor, momentum_rate] = momentum_changes(at, &euler_tensor, &acceleration);
    let canonical_momentum = match body.kinetic() {
        Some(_) => body.canonical_momentum(p, rate),
        None => rate * euler_tensor,
    };
    let tension = body.solid.mass.volume * (stress * p.transpose()).transpose();
    Ok(HomogeneousObservation {
        velocity_gradient,
        total_affine_momentum: momentum + body.solid.mass.mass * arm * motion.velocity.velocity.transpose(),
        comoving_affine_momentum: body.kinetic().map_or_else(
            || body.solid.mass.euler_tensor * (inverse * rate).transpose(),
            |_| inverse * momentum * inverse.transpose(),
        ),
        affine_moment,
        moment_power: affine_moment.dot(&velocity_gradient.transpose()),
        momentum_residual: residual(body, &(momentum_rate - p * balanced.transpose()), &tension),
        principal_stretches: stretches.into(),
        rotation: polar.rotation,
        spin,
        vorticity,
        stress,
        cauchy_stress: stress * p.transpose() / p.determinant(),
        total_force: loads.force,
        total_moment: about.moment,
        total_affine_moment: p * loads.moment.transpose() + arm * loads.force.transpose(),
        friction_moment: friction - body.solid.mass.volume * elasticity.friction,
        kinetic_tensor: inertia * kinetic_tensor,
        canonical_momentum,
        kinetic_energy_of_centre: inertia * 0.5 * body.solid.mass.mass * motion.velocity.velocity.norm_squared(),
        internal_kinetic_energy: inertia * 0.5 * body.canonical_momentum(p, rate).dot(rate),
        elasticity,
    })
}

/// What dK/dt is made of: Ṗ J Ṗᵀ and P J P̈ᵀ; zero and dK/dt of a kinetic energy of the co-moving rates, which does not
/// depend on the metric of space.
fn momentum_changes(at: &BodyAt, euler_tensor: &Mat3, acceleration: &Mat3) -> [Mat3; 2] {
    let (p, rate) = (&at.motion.placement.gradient, &at.motion.velocity.gradient_rate);
    match (at.body.kinetic(), at.gyration()) {
        (Some(kinetic), Some(gyration)) => {
            [Mat3::zeros(), kinetic.affine_momentum_rate(gyration, acceleration, euler_tensor)]
        }
        _ => [rate * euler_tensor * rate.transpose(), p * euler_tensor * acceleration.transpose()],
    }
}

/// Without a volume there is no stress to balance anything.
fn residual(body: &Body, unbalanced: &Mat3, tension: &Mat3) -> Mat3 {
    if body.solid.mass.volume > 0.0 { unbalanced + tension } else { *unbalanced }
}
