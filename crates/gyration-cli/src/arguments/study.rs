//! The arguments of `gyration study`.

use super::completion::{completer, studies};
use clap::{Args, Subcommand, ValueHint};
use gyration_plot::study::PlotKind;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// `gyration study`
#[derive(Debug, Args)]
pub struct StudyArguments {
    /// Path of a study, or the name of a ready one; without it, the ready ones are listed
    #[arg(value_name = "STUDY", value_hint = ValueHint::FilePath, add = completer(studies))]
    pub study: Option<String>,
    /// What to do with its table instead of making it.
    #[command(subcommand)]
    pub action: Option<StudyAction>,
    /// Folder of the table [default: STEM.study in the current folder]; of `plot` the picture, .svg, .png, .pdf or -
    /// [default: STEM.svg]
    #[arg(short, long, value_name = "PATH", value_hint = ValueHint::AnyPath, global = true)]
    pub output: Option<PathBuf>,
    /// Make part K of N only, into DIR/shard-K-of-N; `merge` joins the parts
    #[arg(long, value_name = "K/N")]
    pub shard: Option<String>,
    /// Make what is missing in a table
    #[arg(long, conflicts_with = "force")]
    pub resume: bool,
    /// Replace an existing table
    #[arg(long, global = true)]
    pub force: bool,
    /// Threads [default: as many as there are processors]
    #[arg(long, value_name = "N")]
    pub threads: Option<NonZeroUsize>,
    /// Change a value of the study: repetitions=100, parameter.height.uniform.to=0.5
    #[arg(long = "set", value_name = "KEY=VALUE", global = true)]
    pub overrides: Vec<String>,
    /// Neither progress nor summary; errors are still reported
    #[arg(short, long, global = true)]
    pub quiet: bool,
    /// Print the summary, or the list of the ready studies, as JSON to stdout
    #[arg(long)]
    pub json: bool,
}

/// `gyration study STUDY …`
#[derive(Debug, Subcommand)]
pub enum StudyAction {
    /// Join the shards of a study into one table
    Merge,
    /// Draw the table of a study: counts, curves with intervals, maps, dots
    Plot(StudyPlot),
}

/// `gyration study STUDY plot`
#[derive(Debug, Args)]
pub struct StudyPlot {
    /// Column of the axis to the right [default: what the study says, or the first axis of its grid]
    #[arg(long, value_name = "COLUMN")]
    pub x: Option<String>,
    /// Column of the axis upwards; face=+z,-z: the share of the runs with one of these values, or of those of another
    /// column
    #[arg(long, value_name = "COLUMN[=VALUE,…]")]
    pub y: Option<String>,
    /// Column that colours tell apart
    #[arg(long, visible_alias = "color", value_name = "COLUMN")]
    pub colour: Option<String>,
    /// Kind of picture; with this, --x or --y the study's own columns no longer count [default: what the study says, or
    /// by the columns]
    #[arg(long, value_parser = PlotKind::WORDS)]
    pub kind: Option<String>,
}
