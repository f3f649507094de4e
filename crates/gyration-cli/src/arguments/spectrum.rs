//! The arguments of `gyration spectrum`.

use clap::{Args, ValueHint};
use std::path::PathBuf;

/// `gyration spectrum`
#[derive(Debug, Args)]
pub struct SpectrumArguments {
    /// Directory of the recording, of a lattice with periodic ends
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub recording: PathBuf,
    /// Add the energy of each branch at each sample to the JSON
    #[arg(long, requires = "json")]
    pub energies: bool,
    /// Draw the branches, with dots that tell how much energy is in each: SVG, PNG or PDF by the ending
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub plot: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}
