//! The arguments of `gyration export`.

use super::number::finite;
use clap::{Args, ValueEnum, ValueHint};
use gyration_plot::TimeSpan;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// `gyration export`
#[derive(Debug, Args)]
pub struct Export {
    /// Directory of the recording
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub recording: PathBuf,
    /// What to write [default: by the ending of -o]
    #[arg(long)]
    pub format: Option<ExportFormat>,
    /// File to write; - writes csv to stdout [default: STEM.csv, .npz, .pvd, .glb, .gif … in the current folder]
    #[arg(short, long, value_name = "PATH", value_hint = ValueHint::FilePath)]
    pub output: Option<PathBuf>,
    /// Take each N-th sample, and the last (vtk, xyz)
    #[arg(long, value_name = "N")]
    pub every: Option<NonZeroUsize>,
    /// The time of the picture [s] (png) [default: the end]
    #[arg(long, value_name = "TIME", value_parser = finite, allow_hyphen_values = true)]
    pub at: Option<f64>,
    /// Show it from this time on [s] (gif, mp4)
    #[arg(long, value_name = "TIME", value_parser = finite, allow_hyphen_values = true)]
    pub from: Option<f64>,
    /// Show it up to this time [s] (gif, mp4)
    #[arg(long, value_name = "TIME", value_parser = finite, allow_hyphen_values = true)]
    pub to: Option<f64>,
    /// Write what acts between two, a row a sample and pair (csv of a scene with record = { pairs = true })
    #[arg(long)]
    pub pairs: bool,
}

/// Formats of an export.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ExportFormat {
    /// One row a sample, 17 digits
    Csv,
    /// All arrays, for numpy.load
    Npz,
    /// Surfaces with tractions and stresses, for ParaView: STEM.pvd, with the data in STEM-vtp beside it
    Vtk,
    /// A line a body, for OVITO and whatever reads extended XYZ
    Xyz,
    /// The motion as an animation, for viewers and modellers: STEM.glb
    Gltf,
    /// The motion as pictures in one file: STEM.gif
    Gif,
    /// The motion as a film, by the program ffmpeg: STEM.mp4
    Mp4,
    /// The bodies at one time, --at: STEM.png
    Png,
}

impl Export {
    /// From when to when it is shown.
    pub fn span(&self) -> TimeSpan {
        TimeSpan { from: self.from, to: self.to }
    }
}
