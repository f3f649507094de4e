//! `[lattice]`: the bodies of the scene are what one cell holds.

use super::contractile::OneOrMany;
use crate::quantity::{AnyQuantity, DecayRate, Energy, Length, NonNegative, Positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A lattice of cells, each of which holds the bodies of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lattice {
    /// One to three primitive vectors (m).
    #[schemars(length(min = 1, max = 3))]
    pub cell: Vec<[Length; 3]>,
    /// How many cells a run has along each.
    #[serde(default = "once")]
    pub repeat: [CellCount; 3],
    /// Whether the ends are neighbours, of all directions or of each.
    #[serde(default = "periodic")]
    pub periodic: OneOrMany<bool>,
    /// What seeks its rest before bands are computed.
    #[serde(default)]
    pub relax: Vec<Relaxed>,
    /// The nominal stress under which the cell rests (Pa; of a sheet N/m, of a chain N), row by row; none if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stress: Option<[[AnyQuantity; 3]; 3]>,
    /// The pressure under which it rests instead (the same).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pressure: Option<AnyQuantity>,
    /// Waves with which a run starts, one or several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wave: Option<OneOrMany<LatticeWave>>,
    /// What swallows waves at the free ends of a run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absorb: Option<AbsorbingEnds>,
}

/// Friction in proportion to the mass in the last cells before each free end: γ = γ₁ (i/n)^p in the i-th of n.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AbsorbingEnds {
    /// n, how many cells of each end have it.
    pub cells: CellCount,
    /// γ₁, that of the last cell (1/s).
    pub rate: Positive<DecayRate>,
    /// p, how it grows towards the end.
    #[serde(default = "cubic")]
    pub power: NonNegative<f64>,
}

/// A wave, a packet of waves, or all waves at random phases.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LatticeWave {
    /// κ: k = Σ κ_a b_a.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kappa: Option<[f64; 3]>,
    /// Which branch, from 0, ascending.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub branch: Option<BranchNumber>,
    /// How far the fastest coordinate goes (m); strains and turns count times the size of the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub amplitude: Option<Positive<Length>>,
    /// The middle of a packet, in cells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<[f64; 3]>,
    /// The width of a packet, in cells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<Positive<f64>>,
    /// Every wave of the cells, instead of one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub random: Option<RandomWaves>,
}

/// Every wave with the same energy and a phase of its own.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RandomWaves {
    /// The energy of each (J).
    pub energy: Positive<Energy>,
    /// The seed of the phases.
    pub seed: Seed,
}

/// The number of a branch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct BranchNumber(#[schemars(with = "u32", range(min = 0, max = 1_000_000))] pub f64);

/// The seed of random numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Seed(#[schemars(with = "u64", range(min = 0, max = 9_007_199_254_740_991_u64))] pub f64);

/// A number of cells.
// Numbers of a scene are read as reals; the structure is checked to hold a whole one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct CellCount(#[schemars(with = "u32", range(min = 1, max = 1_000_000))] pub f64);

/// How many cells away something is along a cell vector.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct CellOffset(#[schemars(with = "i32", range(min = -1_000_000, max = 1_000_000))] pub f64);

/// What seeks its rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Relaxed {
    /// The bodies, within the cell as it is written.
    Granules,
    /// The bodies, and the cell vectors too: a symmetric deformation of them.
    Cell,
}

fn once() -> [CellCount; 3] {
    [CellCount(1.0); 3]
}

fn cubic() -> NonNegative<f64> {
    NonNegative(3.0)
}

fn periodic() -> OneOrMany<bool> {
    OneOrMany::One(true)
}
