//! Leaving the domain of the model is a value, never a clamp, an infinity or a panic.

use crate::party::Party;
use gyration_expression::Undefined;
use std::fmt;

/// The force that a formula stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FormulaOf {
    /// V of a body.
    Potential,
    /// A component of b.
    BodyForce,
    /// A component of F at a point.
    PointForce,
    /// The scale or an entry of a friction.
    Friction,
    /// The bond of this index.
    Bond(usize),
    /// The drive of the joint of this index.
    Joint(usize),
}

/// What left its domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// The smallest gap to the support of this index, which must be > 0 [m].
    Gap {
        /// Index of the support.
        support: usize,
    },
    /// The length of the spring of this index, which must be > 0 [m].
    SpringLength {
        /// Index of the spring in the model.
        spring: usize,
    },
    /// The distance of the points of the bond of this index, at which its potential must have a derivative [m].
    BondLength {
        /// Index of the bond in the model.
        bond: usize,
    },
    /// The width of the slab between this body and another, or a support with a shape, which must be > 0 [m].
    PairGap {
        /// The other.
        other: Party,
        /// Number of the rule by which they meet.
        rule: usize,
    },
    /// The squared Newton decrement with which the search for the plane between this body and another, or a support
    /// with a shape, ended, which must be rounding; NaN where no plane has a potential, or a law no balance on it.
    PairPlane {
        /// The other.
        other: Party,
        /// Number of the rule by which they meet.
        rule: usize,
    },
    /// The distance of the surfaces of this sphere and another that it feels through the fluid, which must be > 0
    /// \[m\].
    FluidGap {
        /// Index of the other body.
        other: usize,
    },
    /// How far a body of a lattice has come away from its start in its cell, beside the first body, which must be less
    /// than what the pairs across cells were listed for [m].
    Stray,
    /// The way that is left to a limit of the joint of this index, which must be > 0 [rad] or [m].
    JointLimit {
        /// Index of the joint in the model.
        joint: usize,
    },
    /// The least pivot of the equations of joints, which must be independent: a linkage is stretched out, folded or
    /// flat.
    Joints {
        /// Index in the model of the joint whose equations follow from those of others.
        joint: usize,
    },
    /// det P, which must be > 0: the body is not turned inside out.
    Volume,
    /// det G, which must be > 0: the relaxed body has a volume.
    Contraction,
    /// The resistance to the motion of a body without inertia, which must be > 0.
    Resistance,
    /// The last step towards the velocities of a body without inertia, as a part of these, which must be small:
    /// friction with a bound is not linear in them.
    Balance,
    /// The ratio of the longest to the shortest semi-axis of an inclusion, which must be below [`MOST_SLENDER`].
    ///
    /// [`MOST_SLENDER`]: crate::fluid::MOST_SLENDER
    Slenderness,
    /// The estimated relative error of the boundary elements around a body that deforms, which must be small; NaN where
    /// none can be had.
    Elements,
    /// The relative error of the resistance of such a body between the forms for which it was computed, which must be
    /// below the tolerance.
    Interpolation,
    /// A formula of the body has no finite value, or not the derivative that is needed, at the numbers that its
    /// variables have; the value is the argument of the operation.
    Formula {
        /// Force that the formula stands for.
        of: FormulaOf,
        /// The operation, its column, what it lacks.
        undefined: Undefined,
    },
    /// The resistance of such a body, or what very many pairs of bodies do, was given up before it was known: no
    /// property of the state, and no value.
    Interruption,
}

impl fmt::Display for FormulaOf {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Potential => f.write_str("its potential"),
            Self::BodyForce => f.write_str("the force on its volume"),
            Self::PointForce => f.write_str("the force at one of its points"),
            Self::Friction => f.write_str("its friction"),
            Self::Bond(bond) => write!(f, "bond {bond}"),
            Self::Joint(joint) => write!(f, "the drive of joint {joint}"),
        }
    }
}

/// In words, with indices of the model in the place of names.
impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Gap { support } => write!(f, "the smallest gap to support {support} [m]"),
            Self::SpringLength { spring } => write!(f, "the length of spring {spring} [m]"),
            Self::BondLength { bond } => write!(f, "the length of bond {bond} [m]"),
            Self::PairGap { other, .. } => write!(f, "the gap to {other} [m]"),
            Self::PairPlane { other, .. } => write!(f, "the decrement with which no plane was found to {other}"),
            Self::FluidGap { other } => write!(f, "the distance in the fluid to body {other} [m]"),
            Self::Stray => f.write_str("how far it has come away in its cell [m]"),
            Self::JointLimit { joint } => write!(f, "the way left to a limit of joint {joint}"),
            Self::Joints { joint } => write!(f, "the pivot of joint {joint}, whose equations follow from others,"),
            Self::Volume => f.write_str("det P"),
            Self::Contraction => f.write_str("det G"),
            Self::Resistance => f.write_str("the resistance to its motion"),
            Self::Balance => f.write_str("what is left of its balance"),
            Self::Slenderness => f.write_str("its ratio of semi-axes"),
            Self::Elements => f.write_str("the error of its boundary elements"),
            Self::Interpolation => f.write_str("the error of its interpolated resistance"),
            Self::Formula { of, undefined } => write!(f, "{of} is undefined ({undefined}), whose argument"),
            Self::Interruption => f.write_str("the search for its forces was given up; its value"),
        }
    }
}

/// A state outside the model: which body, which quantity, its value.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("body {body}: {quantity} is {value:e}")]
pub struct Inadmissible {
    /// Index of the body.
    pub body: usize,
    /// What left its domain.
    pub quantity: Quantity,
    /// Its value.
    pub value: f64,
}
