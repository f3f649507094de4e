//! What keeps the program from doing what it was asked, with the exit code that tells it to scripts ([`code`]).

use gyration_files::in_words;
use gyration_plot::PlotError;
use gyration_record::RecordError;
use gyration_robots::ImportError;
use gyration_scene::{LoadError, NotInGallery, NotToml};
use gyration_sim::resistance::NoSuchResistance;
use gyration_sim::{Reason, RunError};
#[cfg(feature = "study")]
use gyration_study::calibration::CalibrationError;
use gyration_threads::Threads;
#[cfg(feature = "view")]
use gyration_view::ViewError;
use std::io;
use std::path::PathBuf;

/// A failure of the program.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// There is no scene.
    #[error(transparent)]
    Scene(#[from] LoadError),
    /// The recording cannot be read or written.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The run could not begin or go on.
    #[error(transparent)]
    Run(#[from] RunError),
    /// There is no picture.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// No numbers were found.
    #[cfg(feature = "study")]
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// Nothing can be shown.
    #[cfg(feature = "view")]
    #[error(transparent)]
    View(#[from] ViewError),
    /// The table of a study cannot be made.
    #[cfg(feature = "study")]
    #[error(transparent)]
    Study(#[from] gyration_study::StudyError),
    /// The arguments ask for something that is not to be had.
    #[error("{problem}\n  fix: {fix}")]
    Arguments {
        /// What is wrong.
        problem: String,
        /// What to do.
        fix: String,
    },
    /// The file of a robot gives no scene.
    #[error(transparent)]
    Import(#[from] ImportError),
    /// A file cannot be written.
    #[error("cannot write {path}: {}", in_words(source), path = path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// There is no such scene in the gallery.
    #[error(transparent)]
    Gallery(#[from] NotInGallery),
    /// There is no such resistance.
    #[error(transparent)]
    Resistance(#[from] NoSuchResistance),
    /// The resolved scene has no form in TOML.
    #[error(transparent)]
    Resolved(#[from] NotToml),
    /// Stdout cannot be written; a closed pipe is no error.
    #[error("cannot write to stdout: {}", in_words(.0))]
    Stdout(#[from] io::Error),
    /// The handler of Ctrl-C cannot be set.
    #[error("the system does not let the program listen for Ctrl-C")]
    Signal(#[from] ctrlc::Error),
}

/// Exit codes of the program; `docs/exit-codes.md` is this list.
pub mod code {
    /// Done.
    pub const DONE: u8 = 0;
    /// The run ended early, for a physical or numerical reason or at `max_wall_time`; whatever its ledger.
    pub const ENDED_EARLY: u8 = 1;
    /// Bad arguments or scene.
    pub const BAD_INPUT: u8 = 2;
    /// The scene file or the recording cannot be read or written.
    pub const BAD_FILE: u8 = 3;
    /// Done, but the energy balance is open, by any amount: of a run, or of one run of a study.
    pub const OPEN: u8 = 4;
    /// Interrupted, as shells count it: 128 + SIGINT.
    pub const INTERRUPTED: u8 = 130;
}

impl From<Threads> for CliError {
    fn from(wrong: Threads) -> Self {
        Self::arguments(wrong.to_string(), wrong.fix())
    }
}

impl CliError {
    /// Arguments that cannot be met, and what to do instead.
    pub fn arguments(problem: impl Into<String>, fix: impl Into<String>) -> Self {
        Self::Arguments { problem: problem.into(), fix: fix.into() }
    }

    /// The exit code that tells it to scripts.
    pub fn code(&self) -> u8 {
        match self {
            Self::Scene(LoadError::Content(errors)) if errors.is_interrupted() => code::ENDED_EARLY,
            Self::Run(RunError::Interrupted(stop)) => match stop.reason {
                Reason::Interrupted => code::INTERRUPTED,
                _ => code::ENDED_EARLY,
            },
            Self::Scene(LoadError::Content(_)) | Self::Arguments { .. } => code::BAD_INPUT,
            Self::Import(ImportError::Content(_)) => code::BAD_INPUT,
            Self::Gallery(_) | Self::Resistance(_) | Self::Resolved(_) => code::BAD_INPUT,
            Self::Run(RunError::Start(_) | RunError::OtherScene { .. }) => code::BAD_INPUT,
            Self::Plot(PlotError::Nothing { .. } | PlotError::Measure { .. } | PlotError::Arguments { .. }) => {
                code::BAD_INPUT
            }
            Self::Record(RecordError::AlreadyExists { .. }) => code::BAD_INPUT,
            #[cfg(feature = "study")]
            Self::Study(error) if error.is_bad_input() => code::BAD_INPUT,
            #[cfg(feature = "study")]
            Self::Study(_) => code::BAD_FILE,
            #[cfg(feature = "study")]
            Self::Calibration(CalibrationError::Load(LoadError::Read(_))) => code::BAD_FILE,
            #[cfg(feature = "study")]
            Self::Calibration(CalibrationError::Search(_) | CalibrationError::Interrupted { .. }) => code::ENDED_EARLY,
            #[cfg(feature = "study")]
            Self::Calibration(_) => code::BAD_INPUT,
            #[cfg(feature = "view")]
            Self::View(ViewError::Port { .. } | ViewError::NoPage { .. }) => code::BAD_INPUT,
            #[cfg(feature = "view")]
            Self::View(_) => code::BAD_FILE,
            Self::Scene(LoadError::Read(_))
            | Self::Record(_)
            | Self::Run(_)
            | Self::Plot(_)
            | Self::Import(_)
            | Self::Write { .. }
            | Self::Stdout(_)
            | Self::Signal(_) => code::BAD_FILE,
        }
    }

    /// Whether the reader of stdout has gone, as `head` does: then there is nobody to tell anything.
    pub fn is_closed_pipe(&self) -> bool {
        match self {
            Self::Stdout(source) => source.kind() == io::ErrorKind::BrokenPipe,
            Self::Record(RecordError::Io { source, .. }) => source.kind() == io::ErrorKind::BrokenPipe,
            _ => false,
        }
    }
}
