//! What may be written after `gyration`.

mod bands;
mod bench;
mod completion;
mod continuum;
mod export;
mod fields;
mod number;
mod orbit;
mod plot;
mod resistance;
mod spectrum;
#[cfg(feature = "study")]
mod study;

pub use bands::Bands;
pub use bench::BenchArguments;
pub use continuum::ContinuumArguments;
pub use export::{Export, ExportFormat};
pub use fields::FieldArguments;
pub use orbit::OrbitArguments;
pub use plot::Plot;
pub use resistance::ResistanceArguments;
pub use spectrum::SpectrumArguments;
#[cfg(feature = "study")]
pub use study::{StudyAction, StudyArguments, StudyPlot};

use clap::builder::styling::{AnsiColor, Styles};
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use clap_complete::Shell;
use completion::{completer, names_of_scenes, scenes};
use std::num::NonZeroUsize;
use std::path::PathBuf;

const STYLES: Styles =
    Styles::styled().header(AnsiColor::Green.on_default().bold()).usage(AnsiColor::Green.on_default().bold());

const AFTER: &str = "SCENE is a path or the name of a scene of the gallery (see `gyration scenes`).

Exit codes: 0 done, also when it ended at rest; 1 the run ended early; 2 bad arguments or a bad scene;
3 the scene file or the recording cannot be read or written; 4 done, but the energy balance is open;
130 interrupted.";

/// The program's arguments.
#[derive(Debug, Parser)]
#[command(name = "gyration", version, styles = STYLES, after_help = AFTER, max_term_width = 100)]
#[command(about = "Simulates bodies that move by homogeneous deformations and meet force fields of supports.")]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scene into a recording
    Run(RunArguments),
    /// Show what a scene says before it runs: mass, rest gaps, time scales, whether laws forbid touching, resolved form
    Check(Check),
    /// Print the rest state of each body, or of bodies that are joined, and frequencies, decay rates and shapes of the
    /// small motions about it
    Modes(Modes),
    /// Print the waves that run through a lattice: frequencies and decay rates along a path of wave vectors, gaps
    Bands(Bands),
    /// Print what a lattice is as a continuum: matrices, moduli, and the wavelengths at which a model of it ends
    Continuum(ContinuumArguments),
    /// Print micromorphic fields of a recording: density, momenta, stresses, and how well their balances close
    Fields(FieldArguments),
    /// Print how much energy of a ring is in each wave of its cell, with measured frequencies and widths
    Spectrum(SpectrumArguments),
    /// Print a motion that repeats itself: period, start, multipliers, whether it is stable
    Orbit(OrbitArguments),
    /// Print the resistance of bodies in a viscous fluid: the matrix from velocity and velocity gradient to force and
    /// moment
    Resistance(ResistanceArguments),
    /// List the built-in gallery, or print one of its scenes
    Scenes(Scenes),
    /// Write a commented scene to start from, and the schema by which editors complete its keys
    New(New),
    /// Make a scene of a robot's file, URDF or MJCF; what has no counterpart is listed
    Import(ImportArguments),
    /// Turn a recording into a table or a file for other programs
    Export(Export),
    /// Draw a recording, or the contact laws of a scene
    Plot(Plot),
    /// Write a recording as one HTML file: playback, plots, ledger, scene; readable without network
    #[cfg(feature = "view")]
    Report(ReportArguments),
    /// Show a recording, or a scene that runs as it is watched, in a browser
    #[cfg(feature = "view")]
    View(ViewArguments),
    /// Run a scene many times, with other numbers each, into one table
    #[cfg(feature = "study")]
    Study(StudyArguments),
    /// Find numbers of a scene, as α, β, ν of its contact laws, from measurements
    #[cfg(feature = "study")]
    Calibrate(Calibrate),
    /// Measure how fast this machine runs throws, cubes and crowds, each beside its floor
    Bench(BenchArguments),
    /// Print the JSON Schema of a scene, a study or a file of measurements
    Schema {
        /// Of which files
        #[arg(default_value = "scene")]
        of: SchemaOf,
    },
    /// Print the completions of a shell, of the names of scenes and studies too: `source <(gyration completions bash)`
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Write the manual pages
    Man {
        /// Folder to write them into [default: the main page to stdout]
        #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
        folder: Option<PathBuf>,
    },
}

/// Files that have a schema.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SchemaOf {
    /// Scenes
    Scene,
    /// Studies, `gyration study`
    #[cfg(feature = "study")]
    Study,
    /// Measurements, `gyration calibrate`
    #[cfg(feature = "study")]
    Calibration,
}

/// A scene, and what is changed in it.
#[derive(Debug, Args)]
pub struct SceneArguments {
    /// Path of a scene, or its name in the gallery
    #[arg(value_name = "SCENE", value_hint = ValueHint::FilePath, add = completer(scenes))]
    pub scene: String,
    /// Change a value of the scene, by name or by index from zero: body.die.velocity='[1,0,0]',
    /// contact.0.friction.beta=2
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
}

/// `gyration run`
#[derive(Debug, Args)]
pub struct RunArguments {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Directory of the recording [default: STEM.gyr in the current folder, then STEM-2.gyr, …]
    #[arg(short, long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub output: Option<PathBuf>,
    /// Go on with an interrupted recording (STEM.gyr without -o)
    #[arg(long, conflicts_with = "force")]
    pub resume: bool,
    /// Replace an existing recording (STEM.gyr without -o)
    #[arg(long)]
    pub force: bool,
    /// Threads that share the bodies out [default: all processors if there are more than a few bodies]
    #[arg(long, value_name = "N")]
    pub threads: Option<NonZeroUsize>,
    /// Neither progress nor summary; errors are still reported
    #[arg(short, long)]
    pub quiet: bool,
    /// Print the summary as JSON to stdout
    #[arg(long)]
    pub json: bool,
}

/// `gyration check`
#[derive(Debug, Args)]
pub struct Check {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Make the first N steps as well, and tell whether a run resumed after any of them is the same to the byte, planes
    /// between bodies are found alike, and momenta are kept
    #[arg(long, value_name = "N")]
    pub steps: Option<NonZeroUsize>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// `gyration modes`
#[derive(Debug, Args)]
pub struct Modes {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// `gyration new`
#[derive(Debug, Args)]
pub struct New {
    /// Name of the scene, with or without a folder and .toml
    #[arg(value_name = "NAME", default_value = "scene", value_hint = ValueHint::FilePath)]
    pub name: PathBuf,
}

/// `gyration scenes`
#[derive(Debug, Args)]
pub struct Scenes {
    /// Print the text of this scene
    #[arg(add = completer(names_of_scenes))]
    pub name: Option<String>,
    /// Print name and title of each as JSON
    #[arg(long, conflicts_with = "name")]
    pub json: bool,
}

/// `gyration import`
#[derive(Debug, Args)]
pub struct ImportArguments {
    /// File of the robot, URDF or MJCF
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Scene to write; - writes it to stdout [default: STEM.toml in the current folder]
    #[arg(short, long, value_name = "SCENE", value_hint = ValueHint::FilePath)]
    pub output: Option<PathBuf>,
    /// The root of a URDF stands still, whatever its name and mass
    #[arg(long)]
    pub fixed_base: bool,
    /// Replace an existing scene
    #[arg(long)]
    pub force: bool,
    /// Do not say what was left out and what was chosen; both stand at the head of the scene
    #[arg(short, long)]
    pub quiet: bool,
}

/// `gyration report`
#[cfg(feature = "view")]
#[derive(Debug, Args)]
pub struct ReportArguments {
    /// Directory of the recording
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub recording: PathBuf,
    /// File to write [default: STEM.html in the current folder]
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: Option<PathBuf>,
}

/// `gyration view`
#[cfg(feature = "view")]
#[derive(Debug, Args)]
pub struct ViewArguments {
    /// Directory of a recording, or a scene: its path or its name in the gallery
    #[arg(value_name = "DIR|SCENE", value_hint = ValueHint::AnyPath, add = completer(scenes))]
    pub source: String,
    /// Port of 127.0.0.1 to listen on [default: a free one]
    #[arg(long, value_name = "N")]
    pub port: Option<u16>,
    /// Do not start a browser; the address is printed in any case
    #[arg(long)]
    pub no_open: bool,
    /// Change a value of the scene
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
}

/// `gyration calibrate`
#[cfg(feature = "study")]
#[derive(Debug, Args)]
pub struct Calibrate {
    /// File of measurements
    #[arg(value_name = "DATA", value_hint = ValueHint::FilePath)]
    pub data: PathBuf,
    /// File of the drawing of the fit: .svg, .png, .pdf or .gif [default: STEM-fit.svg in the current folder]
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}
