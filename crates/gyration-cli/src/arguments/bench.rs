//! The arguments of `gyration bench`.

use clap::{Args, ValueHint};
use std::path::PathBuf;

/// `gyration bench`
#[derive(Debug, Args)]
pub struct BenchArguments {
    /// Smaller crowds and fewer throws
    #[arg(long)]
    pub quick: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Draw how many times its floor each piece of work takes (.svg, .png, .pdf)
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub plot: Option<PathBuf>,
}
