//! The arguments of `gyration continuum`.

use super::SceneArguments;
use clap::{Args, ValueEnum, ValueHint};
use gyration_sim::modes::bands::ContinuumModel;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// `gyration continuum`
#[derive(Debug, Args)]
pub struct ContinuumArguments {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// What of the series in k is kept
    #[arg(long, value_name = "MODEL", default_value = "mindlin")]
    pub model: ModelOfContinuum,
    /// Vertices κ of the path along which its waves stand beside those of the lattice, as of `gyration bands`
    #[arg(long, value_name = "PATH", allow_hyphen_values = true)]
    pub path: Option<String>,
    /// Wave vectors a segment, both ends included
    #[arg(long, value_name = "N", default_value = "101")]
    pub points: NonZeroUsize,
    /// Draw both, and how far the model is off: SVG, PNG or PDF by the ending
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub plot: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// The models of a continuum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ModelOfContinuum {
    /// Displacement and what granules do, to first order of what joins them
    First,
    /// The same with double stresses
    Mindlin,
    /// Moduli of strains, of granules and between them
    Relaxed,
    /// Mindlin's, of granules that turn and do not deform
    Cosserat,
    /// Displacement alone, to k²
    Cauchy,
    /// Displacement alone, to k⁴
    Gradient,
}

impl ModelOfContinuum {
    /// The model.
    pub fn model(self) -> ContinuumModel {
        match self {
            Self::First => ContinuumModel::First,
            Self::Mindlin => ContinuumModel::Mindlin,
            Self::Relaxed => ContinuumModel::Relaxed,
            Self::Cosserat => ContinuumModel::Cosserat,
            Self::Cauchy => ContinuumModel::Cauchy,
            Self::Gradient => ContinuumModel::Gradient,
        }
    }
}
