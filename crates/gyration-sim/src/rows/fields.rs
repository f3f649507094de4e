//! The quantities that are recorded of every body: names, units, columns, values.
//!
//! One list serves the layout and the filling of a row, so that the two cannot disagree. The order is that of the CSV.

use gyration::balance::BodyObservation;
use gyration::dynamics::{ContactParts, LoadsByKind};
use gyration::homogeneous::HomogeneousObservation;
use gyration::immersion::ImmersionObservation;
use gyration::tensor::{Mat3, Vec3};

/// A quantity recorded for every body.
pub(super) struct BodyField {
    pub name: &'static str,
    pub units: &'static str,
    pub description: &'static str,
    pub rank: Rank,
    /// Suffixes of the CSV columns, in row-major order; none: not in the CSV.
    pub suffixes: &'static [&'static str],
    pub value: fn(&BodyContext) -> FieldValue,
}

/// How many numbers a quantity has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rank {
    Scalar,
    Vector,
    Matrix,
}

/// What is known of a body.
pub(super) struct BodyContext<'a> {
    pub body: &'a BodyObservation,
    /// Where it was asked for.
    pub homogeneous: Option<&'a HomogeneousObservation>,
    /// Where they were asked for.
    pub contacts: Option<&'a ContactParts>,
    /// Where they were asked for.
    pub loads: Option<&'a LoadsByKind>,
    /// Where it was asked for, and a rest is known.
    pub displacement: Option<Vec3>,
    /// Where it was asked for, of a body with a guide.
    pub reaction: Option<&'a Reaction>,
    /// What its contacts have pushed with since the last sample [N s], where it was asked for.
    pub impulse: Option<Vec3>,
    /// Their largest force since then [N], where it was asked for.
    pub peak_force: Option<f64>,
    /// If it is immersed in a fluid.
    pub immersed: Option<&'a ImmersionObservation>,
}

/// How a guide keeps a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reaction {
    /// The force on its centre \[N\].
    pub force: Vec3,
    /// N = P Mᵀ \[N m\].
    pub moment: Mat3,
}

pub(super) enum FieldValue {
    Scalar(f64),
    Vector(Vec3),
    Matrix(Mat3),
}

const PLACEMENT: [&str; 9] = ["P_xx", "P_xy", "P_xz", "P_yx", "P_yy", "P_yz", "P_zx", "P_zy", "P_zz"];
const RATE: [&str; 9] =
    ["Pdot_xx", "Pdot_xy", "Pdot_xz", "Pdot_yx", "Pdot_yy", "Pdot_yz", "Pdot_zx", "Pdot_zy", "Pdot_zz"];

/// The fields of every recording, in the order of the CSV.
pub(super) static BODY_FIELDS: [BodyField; 13] = [
    BodyField {
        name: "position",
        units: "m",
        description: "position of the centre of mass",
        rank: Rank::Vector,
        suffixes: &["x", "y", "z"],
        value: |context| FieldValue::Vector(context.body.motion.placement.position),
    },
    BodyField {
        name: "placement_gradient",
        units: "1",
        description: "placement gradient P; a rotation for a rigid body",
        rank: Rank::Matrix,
        suffixes: &PLACEMENT,
        value: |context| FieldValue::Matrix(context.body.motion.placement.gradient),
    },
    BodyField {
        name: "velocity",
        units: "m/s",
        description: "velocity of the centre of mass",
        rank: Rank::Vector,
        suffixes: &["vx", "vy", "vz"],
        value: |context| FieldValue::Vector(context.body.motion.velocity.velocity),
    },
    BodyField {
        name: "gradient_rate",
        units: "1/s",
        description: "rate of the placement gradient",
        rank: Rank::Matrix,
        suffixes: &RATE,
        value: |context| FieldValue::Matrix(context.body.motion.velocity.gradient_rate),
    },
    BodyField {
        name: CONTRACTION,
        units: "1",
        description: "contraction G of a contractile body; NaN for any other",
        rank: Rank::Matrix,
        suffixes: &["G_xx", "G_xy", "G_xz", "G_yx", "G_yy", "G_yz", "G_zx", "G_zy", "G_zz"],
        value: |context| FieldValue::Matrix(context.body.effort.map_or(NO_MATRIX, |effort| effort.contraction)),
    },
    BodyField {
        name: PRESSURE,
        units: "Pa",
        description: "pressure of an incompressible body; NaN for any other",
        rank: Rank::Scalar,
        suffixes: &["pressure"],
        value: |context| FieldValue::Scalar(context.body.pressure.unwrap_or(f64::NAN)),
    },
    BodyField {
        name: GAP,
        units: "m",
        description: "smallest gap to anything the body has a contact with",
        rank: Rank::Scalar,
        suffixes: &["gap"],
        value: |context| FieldValue::Scalar(context.body.gap),
    },
    BodyField {
        name: CONTACT_FORCE,
        units: "N",
        description: "force of all contacts",
        rank: Rank::Vector,
        suffixes: &["fx", "fy", "fz"],
        value: |context| FieldValue::Vector(context.body.contact_force),
    },
    BodyField {
        name: "linear_momentum",
        units: "kg m/s",
        description: "linear momentum",
        rank: Rank::Vector,
        suffixes: &[],
        value: |context| FieldValue::Vector(context.body.linear_momentum),
    },
    BodyField {
        name: "angular_momentum",
        units: "kg m2/s",
        description: "angular momentum about the origin",
        rank: Rank::Vector,
        suffixes: &[],
        value: |context| FieldValue::Vector(context.body.angular_momentum),
    },
    BodyField {
        name: "affine_momentum",
        units: "kg m2/s",
        description: "affine momentum K = P J Pdot^T about the centre of mass",
        rank: Rank::Matrix,
        suffixes: &[],
        value: |context| FieldValue::Matrix(context.body.affine_momentum),
    },
    BodyField {
        name: CONTRACTION_VELOCITY,
        units: "1/s",
        description: "contraction velocity V_G = Gdot G^-1",
        rank: Rank::Matrix,
        suffixes: &[],
        value: |context| FieldValue::Matrix(context.body.effort.map_or(NO_MATRIX, |effort| effort.velocity)),
    },
    BodyField {
        name: DRIVE,
        units: "Pa",
        description: "drive Q; what it takes, where the contraction is prescribed",
        rank: Rank::Matrix,
        suffixes: &[],
        value: |context| FieldValue::Matrix(context.body.effort.map_or(NO_MATRIX, |effort| effort.drive)),
    },
];

/// The fields that apply to some bodies only.
pub(super) const CONTRACTION: &str = "contraction";
pub(super) const CONTRACTION_VELOCITY: &str = "contraction_velocity";
pub(super) const DRIVE: &str = "drive";
pub(super) const PRESSURE: &str = "pressure";
pub(super) const GAP: &str = "gap";
pub(super) const CONTACT_FORCE: &str = "contact_force";
pub(super) const IMPULSE: &str = "impulse";
pub(super) const PEAK_FORCE: &str = "peak_force";

/// A field of bodies in a fluid: NaN for any other.
macro_rules! immersed {
    ($name:literal, $units:literal, $description:literal, $rank:ident, $nothing:expr, $value:expr) => {
        BodyField {
            name: $name,
            units: $units,
            description: $description,
            rank: Rank::$rank,
            suffixes: &[],
            value: |context| FieldValue::$rank(context.immersed.map_or($nothing, $value)),
        }
    };
}

/// The fields of a recording with a body in a fluid.
#[rustfmt::skip]
pub(super) static IMMERSED_FIELDS: [BodyField; 11] = [
    immersed!("drag", "N", "force of the fluid, without buoyancy", Vector, NO_VECTOR, |immersed| immersed.drag),
    immersed!("rotlet", "N m", "torque of the fluid about the centre of the \
        volume", Vector, NO_VECTOR, |immersed| immersed.rotlet),
    immersed!("stresslet", "N m", "stresslet", Matrix, NO_MATRIX, |immersed| immersed.stresslet),
    immersed!("particle_stress", "Pa", "particle stress, per volume of \
        particle", Matrix, NO_MATRIX, |immersed| immersed.particle_stress),
    immersed!("intrinsic_viscosity", "1", "increment of the viscosity of a dilute suspension, over that of the fluid \
        and the volume fraction", Scalar, f64::NAN, |immersed| immersed.intrinsic_viscosity),
    immersed!("normal_stress_1", "Pa", "first normal stress difference in simple shear, over the volume \
        fraction", Scalar, f64::NAN, |immersed| immersed.normal_stress_differences[0]),
    immersed!("normal_stress_2", "Pa", "second normal stress difference in simple shear, over the volume \
        fraction", Scalar, f64::NAN, |immersed| immersed.normal_stress_differences[1]),
    immersed!("dissipated_power", "W", "power that the disturbance of the flow turns into heat", Scalar, f64::NAN, |immersed| immersed.dissipated_power),
    immersed!("semi_axes", "m", "semi-axes of an ellipsoid, descending", Vector, NO_VECTOR, |immersed| immersed.semi_axes),
    immersed!("inclination", "rad", "angle of the longest axis from the direction of a simple shear", Scalar, f64::NAN, |immersed| immersed.inclination),
    immersed!("orbit_constant", "1", "C/(1 + C) of the orbit of a body of revolution in simple shear", Scalar, f64::NAN, |immersed| immersed.orbit_constant),
];

pub(super) const NO_VECTOR: Vec3 = Vec3::new(f64::NAN, f64::NAN, f64::NAN);
pub(super) const NO_MATRIX: Mat3 = Mat3::from_array_storage(nalgebra::ArrayStorage([[f64::NAN; 3]; 3]));
