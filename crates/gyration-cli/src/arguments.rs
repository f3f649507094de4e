//! What may be written after `gyration`.

mod bands;
mod bench;
mod fields;
mod orbit;
mod spectrum;

pub use bands::Bands;
pub use bench::BenchArguments;
pub use fields::FieldArguments;
pub use orbit::OrbitArguments;
pub use spectrum::SpectrumArguments;

use clap::builder::styling::{AnsiColor, Styles};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use clap_complete::Shell;
use clap_complete::engine::{ArgValueCompleter, CompletionCandidate, PathCompleter, ValueCompleter};
#[cfg(feature = "study")]
use gyration_plot::study::PlotKind;
use gyration_plot::{PlotQuantity, TimeSpan};
use gyration_sim::modes::bands::ContinuumModel;
use gyration_sim::resistance::TRIANGLES_ALLOWED;
use std::ffi::OsStr;
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

/// `gyration resistance`
#[derive(Debug, Args)]
pub struct ResistanceArguments {
    /// Path of a scene, or its name in the gallery; behind a colon one body of it
    #[arg(value_name = "SCENE[:BODY]", value_hint = ValueHint::FilePath, add = completer(scenes))]
    pub scene: String,
    /// Change a value of the scene
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// By boundary elements also where there is a closed form
    #[arg(long)]
    pub elements: bool,
    /// About how many triangles boundary elements take [default: 1280]
    #[arg(long, value_name = "N", value_parser = triangles())]
    pub triangles: Option<u32>,
    /// Near a wall without slip: the plane of this support
    #[arg(long, value_name = "SUPPORT")]
    pub wall: Option<String>,
    /// Small vibrations of this frequency [Hz], of spheres in a fluid with a density
    #[arg(long, value_name = "HZ", conflicts_with_all = ["elements", "triangles", "wall"])]
    pub frequency: Option<f64>,
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
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub at: Option<f64>,
    /// Show it from this time on [s] (gif, mp4)
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub from: Option<f64>,
    /// Show it up to this time [s] (gif, mp4)
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
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

/// `gyration plot`
#[derive(Debug, Args)]
pub struct Plot {
    /// Directory of a recording, a scene, or the table of a study
    #[arg(value_name = "DIR|SCENE", value_hint = ValueHint::AnyPath, add = completer(scenes))]
    pub source: String,
    /// What to draw, below each other [default: overview of a recording, laws of a scene]
    #[arg(value_name = "WHAT", value_parser = quantity())]
    pub what: Vec<PlotQuantity>,
    /// File to write: .svg, .png, .pdf or .gif; - writes SVG to stdout [default: STEM-WHAT.svg in the current folder]
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: Option<PathBuf>,
    /// The two measures of `stroke`, to the right and upwards, as columns of the CSV without the body, V_xx and Q_xx
    /// besides: G_xz,G_zz or G_zz,P_zz [default: entries of G that enclose most]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub measures: Vec<String>,
    /// Columns of the CSV over time: die.vx,*.gap or joint.*.angle; * stands for any letters
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub columns: Vec<String>,
    /// Show it from this time on [s]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub from: Option<f64>,
    /// Show it up to this time [s]
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub to: Option<f64>,
    /// Change a value of the scene before its laws are drawn
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
}

impl Plot {
    /// From when to when it is shown.
    pub fn span(&self) -> TimeSpan {
        TimeSpan { from: self.from, to: self.to }
    }
}

impl Export {
    /// From when to when it is shown.
    pub fn span(&self) -> TimeSpan {
        TimeSpan { from: self.from, to: self.to }
    }
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

/// `gyration study`
#[cfg(feature = "study")]
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
#[cfg(feature = "study")]
#[derive(Debug, Subcommand)]
pub enum StudyAction {
    /// Join the shards of a study into one table
    Merge,
    /// Draw the table of a study: counts, curves with intervals, maps, dots
    Plot(StudyPlot),
}

/// `gyration study STUDY plot`
#[cfg(feature = "study")]
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

fn completer(candidates: fn(&OsStr) -> Vec<CompletionCandidate>) -> ArgValueCompleter {
    ArgValueCompleter::new(candidates)
}

/// Names of the gallery that begin so.
fn names_of_scenes(begun: &OsStr) -> Vec<CompletionCandidate> {
    named(gyration_scene::gallery().iter().map(|(name, _)| *name), begun)
}

/// Names of the gallery and paths that begin so.
fn scenes(begun: &OsStr) -> Vec<CompletionCandidate> {
    let mut all = names_of_scenes(begun);
    all.extend(PathCompleter::any().complete(begun));
    all
}

/// Names of ready studies and paths that begin so.
#[cfg(feature = "study")]
fn studies(begun: &OsStr) -> Vec<CompletionCandidate> {
    let mut all = named(gyration_study::studies().iter().map(|(name, _)| *name), begun);
    all.extend(PathCompleter::any().complete(begun));
    all
}

fn named<'a>(names: impl Iterator<Item = &'a str>, begun: &OsStr) -> Vec<CompletionCandidate> {
    let begun = begun.to_string_lossy();
    names.filter(|name| name.starts_with(&*begun)).map(CompletionCandidate::new).collect()
}

/// Reads the name of a quantity; help lists all of them.
fn quantity() -> impl TypedValueParser<Value = PlotQuantity> {
    let named = |quantity: PlotQuantity| PossibleValue::new(quantity.name()).help(quantity.description());
    PossibleValuesParser::new(PlotQuantity::ALL.map(named)).try_map(|name| PlotQuantity::of_name(&name))
}

/// Reads how many triangles boundary elements take.
fn triangles() -> impl TypedValueParser<Value = u32> {
    clap::value_parser!(u32).range(i64::from(*TRIANGLES_ALLOWED.start())..=i64::from(*TRIANGLES_ALLOWED.end()))
}
