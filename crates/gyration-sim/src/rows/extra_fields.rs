//! The quantities that are recorded on request: the word of the scene that asks for each, and what it is made of.
//!
//! A word may ask for several: those told kind by kind are an array a kind, as energies and works are.

use super::fields::{BodyField, FieldValue, IMPULSE, NO_MATRIX, NO_VECTOR, PEAK_FORCE, Rank};
use gyration::acting::LoadKind;
use gyration_scene::Recorded;

/// A field that is recorded on request.
pub(super) struct ExtraField {
    /// The word that asks for it.
    pub word: Recorded,
    /// What has to be observed for it.
    pub source: Source,
    pub field: BodyField,
}

/// What a field is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Source {
    /// The observation of homogeneous strain.
    Strain,
    /// The contact force by its parts.
    Contacts,
    /// What acts, kind by kind.
    Loads,
    /// The place at rest.
    Rest,
    /// The reaction of a guide.
    Guide,
    /// What has come of the interval that ends with the row.
    Interval,
}

/// What stands where nothing was observed.
macro_rules! nothing {
    (Scalar) => {
        f64::NAN
    };
    (Vector) => {
        NO_VECTOR
    };
    (Matrix) => {
        NO_MATRIX
    };
}

/// The columns of a vector.
macro_rules! vector {
    ($name:literal) => {
        &[concat!($name, "_x"), concat!($name, "_y"), concat!($name, "_z")]
    };
}

/// The columns of a matrix.
macro_rules! matrix {
    ($name:literal) => {
        &[
            concat!($name, "_xx"),
            concat!($name, "_xy"),
            concat!($name, "_xz"),
            concat!($name, "_yx"),
            concat!($name, "_yy"),
            concat!($name, "_yz"),
            concat!($name, "_zx"),
            concat!($name, "_zy"),
            concat!($name, "_zz"),
        ]
    };
}

/// A field of what is observed: NaN where it was not.
macro_rules! extra {
    ($word:ident, $source:ident, $name:expr, $units:literal, $description:expr, $rank:ident, $suffixes:expr,
     $context:ident => $found:expr) => {
        ExtraField {
            word: Recorded::$word,
            source: Source::$source,
            field: BodyField {
                name: $name,
                units: $units,
                description: $description,
                rank: Rank::$rank,
                suffixes: $suffixes,
                value: |$context| FieldValue::$rank($found),
            },
        }
    };
}

/// A field of the observation of homogeneous strain.
macro_rules! strain {
    ($word:ident, $name:literal, $units:literal, $description:literal, $rank:ident,
     $suffixes:expr, $($found:ident).+) => {
        extra!($word, Strain, $name, $units, $description, $rank, $suffixes,
            context => context.homogeneous.map_or(nothing!($rank), |strain| strain.$($found).+))
    };
}

/// A field of the contact force by its parts.
macro_rules! contact {
    ($word:ident, $name:literal, $description:literal, $rank:ident, $found:ident) => {
        extra!($word, Contacts, $name, "N", $description, $rank, &[],
            context => context.contacts.map_or(nothing!($rank), |contacts| contacts.$found))
    };
}

/// Force and moment of a kind of loads.
macro_rules! by_kind {
    ($kind:ident, $force:literal, $moment:literal, $whose:literal) => {
        [
            extra!(ForceByKind, Loads, $force, "N", concat!("force of ", $whose), Vector, vector!($force),
                context => context.loads.map_or(NO_VECTOR, |loads| loads.of(LoadKind::$kind).force)),
            extra!(MomentByKind, Loads, $moment, "N m", concat!("affine moment M of ", $whose), Matrix,
                matrix!($moment), context => context.loads.map_or(NO_MATRIX, |loads| loads.of(LoadKind::$kind).moment)),
        ]
    };
}

/// All but those told kind by kind, in the order in which they are recorded.
#[rustfmt::skip]
static FIELDS: [ExtraField; 31] = [
    strain!(VelocityGradient, "velocity_gradient", "1/s",
        "velocity gradient L = Pdot P^-1", Matrix, &[], velocity_gradient),
    strain!(AffineMomentumTotal, "affine_momentum_total", "kg m2/s",
        "affine momentum about the origin asked for", Matrix, &[], total_affine_momentum),
    strain!(AffineMoment, "affine_moment", "N m", "affine moment of forces N = P M^T", Matrix, &[], affine_moment),
    strain!(MomentPower, "moment_power", "W", "power tr(N L) of the affine moment", Scalar, &[], moment_power),
    strain!(ComovingMomentum, "comoving_momentum", "kg m2/s",
        "co-moving affine momentum P^-1 K P^-T", Matrix, &[], comoving_affine_momentum),
    strain!(MomentumResidual, "momentum_residual", "N m",
        "residual of the balance of affine momentum", Matrix, &[], momentum_residual),
    strain!(PrincipalStretches, "principal_stretches", "1",
        "principal stretches, descending", Vector, &[], principal_stretches),
    strain!(Rotation, "rotation", "1", "rotation R of P = R U", Matrix, &[], rotation),
    strain!(Spin, "spin", "rad/s",
        "angular velocity of L, P = L D R^T, in spatial axes", Vector, vector!("spin"), spin),
    strain!(Vorticity, "vorticity", "rad/s",
        "angular velocity of R, P = L D R^T, in reference axes", Vector, vector!("vorticity"), vorticity),
    strain!(CauchyStress, "cauchy_stress", "Pa", "Cauchy stress S P^T/det P", Matrix, &[], cauchy_stress),
    strain!(Stress, "stress", "Pa", "first Piola stress S; the mean stress of a rigid body", Matrix, &[], stress),
    contact!(NormalForce, "normal_force", "contact forces along their normals, summed", Scalar, normal),
    contact!(TangentialForce, "tangential_force", "contact forces across normals, summed", Scalar, tangential),
    contact!(PairForce, "pair_force", "force of all other bodies that it meets", Vector, of_bodies),
    extra!(Displacement, Rest, "displacement", "m", "position of the centre of mass less that at rest", Vector, &[],
        context => context.displacement.unwrap_or(NO_VECTOR)),
    extra!(ConstraintForce, Guide, "constraint_force", "N", "force of `keep` on the centre of mass", Vector, &[],
        context => context.reaction.map_or(NO_VECTOR, |reaction| reaction.force)),
    extra!(ConstraintMoment, Guide, "constraint_moment", "N m", "affine moment N = P M^T of `keep`", Matrix, &[],
        context => context.reaction.map_or(NO_MATRIX, |reaction| reaction.moment)),
    strain!(ForceTotal, "force_total", "N",
        "force of all loads, without weight and pin", Vector, vector!("force_total"), total_force),
    strain!(MomentTotal, "moment_total", "N m",
        "affine moment M of all loads, without weight and pin", Matrix, matrix!("moment_total"), total_moment),
    strain!(AffineMomentTotal, "affine_moment_total", "N m",
        "affine moment of all loads about the origin asked for", Matrix,
        matrix!("affine_moment_total"), total_affine_moment),
    strain!(FrictionMoment, "friction_moment", "N m",
        "affine moment D of internal and linear friction", Matrix, matrix!("friction_moment"), friction_moment),
    strain!(KineticTensor, "kinetic_tensor", "J", "Pdot J Pdot^T", Matrix, matrix!("kinetic_tensor"), kinetic_tensor),
    strain!(CanonicalMomentum, "canonical_momentum", "kg m2/s",
        "canonical momentum Pdot J", Matrix, matrix!("canonical_momentum"), canonical_momentum),
    strain!(KineticEnergy, "kinetic_energy_centre", "J",
        "kinetic energy of the centre of mass", Scalar, &["kinetic_energy_centre"], kinetic_energy_of_centre),
    strain!(KineticEnergy, "kinetic_energy_internal", "J",
        "kinetic energy about the centre of mass", Scalar, &["kinetic_energy_internal"], internal_kinetic_energy),
    strain!(ElasticGradient, "elastic_gradient", "1",
        "elastic gradient F = P G^-1", Matrix, matrix!("elastic_gradient"), elasticity.elastic_gradient),
    strain!(ElasticStress, "elastic_stress", "Pa",
        "elastic part of the first Piola stress; NaN of a rigid body", Matrix,
        matrix!("elastic_stress"), elasticity.elastic_stress),
    strain!(Eshelby, "eshelby", "Pa",
        "Eshelby's stress A = F^T S G^T - det G phi I; NaN of a rigid body", Matrix,
        matrix!("eshelby"), elasticity.eshelby),
    extra!(Impulse, Interval, IMPULSE, "N s", "impulse of the contact force since the last sample", Vector,
        vector!("impulse"), context => context.impulse.unwrap_or(NO_VECTOR)),
    extra!(PeakForce, Interval, PEAK_FORCE, "N", "largest contact force since the last sample", Scalar,
        &["peak_force"], context => context.peak_force.unwrap_or(f64::NAN)),
];

/// Those told kind by kind.
#[rustfmt::skip]
static KINDS: [[ExtraField; 2]; LoadKind::COUNT] = [
    by_kind!(Contact, "force_contact", "moment_contact", "supports"),
    by_kind!(Pair, "force_pair", "moment_pair", "other bodies that it meets"),
    by_kind!(Spring, "force_spring", "moment_spring", "springs and bonds"),
    by_kind!(Drag, "force_drag", "moment_drag", "the fluid, with buoyancy"),
    by_kind!(Friction, "force_friction", "moment_friction", "linear friction"),
    by_kind!(Load, "force_load", "moment_load",
        "couples, potentials, body forces, gyroscopic loads, its own gravity, and of a controller"),
];

/// Every field that can be asked for, in the order in which they are recorded.
pub(super) fn extra_fields() -> impl Iterator<Item = &'static ExtraField> {
    FIELDS.iter().chain(KINDS.as_flattened())
}
