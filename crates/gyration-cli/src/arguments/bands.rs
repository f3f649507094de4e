//! What may be written after `gyration bands`.

use super::SceneArguments;
use clap::{Args, ValueHint};
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// `gyration bands`
#[derive(Debug, Args)]
pub struct Bands {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Vertices κ of the path, k = Σ κ_i b_i: "0,0,0 0.5,0,0 | G=0.5,0.5,0 X=1/3,1/3,0"; a bar breaks it [default:
    /// through the ends of the zone along each periodic direction]
    #[arg(long, value_name = "PATH", allow_hyphen_values = true)]
    pub path: Option<String>,
    /// Wave vectors a segment, both ends included
    #[arg(long, value_name = "N", default_value = "101")]
    pub points: NonZeroUsize,
    /// Look at a mesh of so many wave vectors along each direction as well, for gaps and the density of states
    #[arg(long, value_name = "N")]
    pub mesh: Option<NonZeroUsize>,
    /// Add the shapes of the waves to the JSON, and to the file of --yaml
    #[arg(long)]
    pub shapes: bool,
    /// Deform the cell first, its vectors becoming F̄ a, F̄ = 1 + these components: "xx=-0.05,xy=0.01"
    #[arg(long, value_name = "STRAIN", allow_hyphen_values = true)]
    pub strain: Option<String>,
    /// Add ∂ω by these numbers of the scene, dotted keys as of --set, the rest moving with them: "constants.k
    /// body.a.density"
    #[arg(long, value_name = "KEYS", conflicts_with_all = ["complex", "along"])]
    pub derivatives: Option<String>,
    /// Add by how much ω may be off
    #[arg(long, conflicts_with_all = ["complex", "along"])]
    pub bound: bool,
    /// Zak phases and Chern numbers instead, of a mesh of --mesh [default: 24] wave vectors along each direction; for
    /// Zak phases the other κ are those of the path's first point
    #[arg(long, conflicts_with_all = ["complex", "along", "shapes", "derivatives", "bound", "plot", "yaml"])]
    pub topology: bool,
    /// All complex κ of frequencies instead, of waves that run and of waves that die out: e^(−2π|Im κ|) a cell
    #[arg(long, conflicts_with_all = ["mesh", "shapes", "along"])]
    pub complex: bool,
    /// The direction of complex bands: 1, 2 or 3; the other κ are those of the path's first point
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u8).range(1..=3))]
    pub direction: u8,
    /// Frequencies of complex bands [rad/s], --points of them: 0..20 [default: a tenth more than those of the path]
    #[arg(long, value_name = "FROM..TO", requires = "complex")]
    pub omega: Option<String>,
    /// Deform the cell along a path of strains instead, its bodies following, and look for what becomes unstable first:
    /// "xx=0..-0.1,yy=0..0.05"
    #[arg(long, value_name = "STRAINS", conflicts_with_all = ["shapes", "strain", "path"])]
    pub along: Option<String>,
    /// Draw the bands: SVG, PNG or PDF by the ending
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, conflicts_with_all = ["complex", "along"])]
    pub plot: Option<PathBuf>,
    /// Write the bands as `band.yaml` of phonopy, with the shapes if --shapes asks for them
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, conflicts_with_all = ["complex", "along"])]
    pub yaml: Option<PathBuf>,
    /// Values of that path, both ends included
    #[arg(long, value_name = "N", default_value = "21")]
    pub steps: NonZeroUsize,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}
