//! `copies` of `[[body]]`: many equal bodies, each at a place of its own.

use super::Seed;
use crate::quantity::{Length, NonNegative};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Equal bodies in the place of one, named `NAME-0`, `NAME-1`, …, all in the group `NAME`.
///
/// What a place says comes on top of what the body says: positions, velocities and spins add, rotations follow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Copies {
    /// On a grid, the first at `position`, x fastest.
    Grid(CopyGrid),
    /// A CSV file with a header: x, y, z (m), optionally qw, qx, qy, qz, and vx, vy, vz (m/s), and wx, wy, wz (rad/s);
    /// the path is relative to the scene.
    Places(String),
    /// At random, apart from one another.
    Random(RandomCopies),
}

/// Places on a grid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CopyGrid {
    /// How many along x, y and z.
    pub count: [CopyCount; 3],
    /// From one to the next along x, y and z (m).
    pub spacing: [Length; 3],
}

/// Places at random.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RandomCopies {
    /// How many.
    pub count: CopyCount,
    /// Two opposite corners of the box in which their centres of mass are, from `position` (m), the least first.
    #[serde(rename = "box")]
    pub bounds: [[Length; 3]; 2],
    /// The least distance of their bounding spheres to one another and to what they have contacts with (m).
    #[serde(default)]
    pub gap: NonNegative<Length>,
    /// Whether each is turned at random, every rotation being as likely.
    #[serde(default)]
    pub turn: bool,
    /// The seed of the random numbers.
    pub seed: Seed,
}

/// A number of copies.
// Numbers of a scene are read as reals; the structure is checked to hold a whole one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct CopyCount(#[schemars(with = "u32", range(min = 1, max = 1_000_000))] pub f64);
