//! What is wrong with a scene, and where: every error of a file at once, each with its place and its fix.
//!
//! [`ReadError`] is for a file that cannot be read at all (exit code 3 of the program), [`SceneErrors`] for its content
//! and for whatever a scene refers to (exit code 2).

use gyration_files::in_words;
use std::fmt;
use std::path::PathBuf;

/// One thing wrong with a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SceneError {
    /// The file as it was named, or `--set` for an override.
    pub file: String,
    /// Line, from one.
    pub line: usize,
    /// Column in characters, from one.
    pub column: usize,
    /// The dotted key, `body.die.mass`; empty where none applies.
    pub key: String,
    /// What is wrong.
    pub message: String,
    /// What to do about it; may be empty.
    pub help: String,
    /// Whether it is the text, a place in it, or a value.
    pub fault: ErrorKind,
    /// Which override it stands in, from zero; none for the file.
    pub overriding: Option<usize>,
    /// The line of the file, cut to a readable width, with its marks.
    pub(crate) excerpt: Excerpt,
}

/// What an error is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum ErrorKind {
    /// The text: its syntax.
    Syntax,
    /// The structure: a key that is not known or missing, another kind of value, another unit. No other number mends
    /// it.
    Structure,
    /// A value: out of its limits, or at odds with others. Another number may do.
    #[default]
    Value,
    /// Nothing that is known to be wrong: to find out took too long.
    Interrupted,
}

/// The text around an error and which part of it is marked.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Excerpt {
    /// The line, or a window of it.
    pub(crate) text: String,
    /// Characters before the mark.
    pub(crate) before: usize,
    /// Characters marked, one at least.
    pub(crate) marked: usize,
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: ", self.file, self.line, self.column)?;
        if !self.key.is_empty() {
            write!(f, "{}: ", self.key)?;
        }
        f.write_str(&self.message)?;
        let Excerpt { text, before, marked } = &self.excerpt;
        if !text.is_empty() {
            let number = self.line.to_string();
            let margin = " ".repeat(number.len());
            write!(f, "\n  {number} | {text}\n  {margin} | {}{}", " ".repeat(*before), "^".repeat(*marked))?;
        }
        if !self.help.is_empty() {
            write!(f, "\n  fix: {}", self.help)?;
        }
        Ok(())
    }
}

/// Everything that is wrong with a scene, in the order of the file; never empty.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SceneErrors {
    errors: Vec<SceneError>,
    omitted: usize,
    has_more: bool,
}

impl SceneErrors {
    pub(crate) fn new(errors: Vec<SceneError>, omitted: usize, has_more: bool) -> Self {
        Self { errors, omitted, has_more }
    }

    /// The errors, in the order of the file, those of overrides last; of very many, the first ones.
    pub fn as_slice(&self) -> &[SceneError] {
        &self.errors
    }

    /// Whether nothing is known to be wrong, but something was given up before it was known.
    pub fn is_interrupted(&self) -> bool {
        self.errors.iter().any(|error| error.fault == ErrorKind::Interrupted)
    }

    /// How many were found; after some thousands the search ends.
    pub fn count(&self) -> usize {
        self.errors.len() + self.omitted
    }
}

impl<'a> IntoIterator for &'a SceneErrors {
    type Item = &'a SceneError;
    type IntoIter = std::slice::Iter<'a, SceneError>;

    fn into_iter(self) -> Self::IntoIter {
        self.errors.iter()
    }
}

impl fmt::Display for SceneErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // More than a person reads at once; the first ones explain the rest.
        const SHOWN: usize = 50;
        for (index, error) in self.errors.iter().take(SHOWN).enumerate() {
            let separator = if index == 0 { "" } else { "\n" };
            write!(f, "{separator}{error}")?;
        }
        let more = if self.has_more { " or more" } else { "" };
        match self.count() {
            0 | 1 => Ok(()),
            count if count > SHOWN => write!(f, "\n{count}{more} errors, of which {SHOWN} are shown"),
            count => write!(f, "\n{count} errors"),
        }
    }
}

impl std::error::Error for SceneErrors {}

/// A scene file that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// Neither a file nor a scene of the gallery.
    #[error("{path}: no such file, nor a scene of the gallery; {help}", path = path.display())]
    NotFound {
        /// The path or name asked for.
        path: PathBuf,
        /// The nearest name of the gallery, or all of them.
        help: String,
    },
    /// No file, where nothing else could be meant.
    #[error("{path}: no such file, {help}", path = path.display())]
    Missing {
        /// The path asked for.
        path: PathBuf,
        /// What else was looked for, and the nearest names.
        help: String,
    },
    /// The system refused.
    #[error("{path}: cannot be read: {}", in_words(source), path = path.display())]
    Io {
        /// The path.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// Too large to be a scene.
    #[error("{path}: {size} bytes are too large for a scene (at most {limit}); put meshes into files of their own", path = path.display())]
    TooLarge {
        /// The path.
        path: PathBuf,
        /// Its size in bytes.
        size: u64,
        /// The largest size in bytes.
        limit: u64,
    },
}

/// Why there is no scene: the file, or what stands in it.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The file cannot be read (exit code 3).
    #[error(transparent)]
    Read(#[from] ReadError),
    /// What stands in it is wrong (exit code 2).
    #[error(transparent)]
    Content(#[from] SceneErrors),
}

/// The resolved scene has no form in TOML.
#[derive(Debug, thiserror::Error)]
#[error("the resolved scene cannot be written as TOML\n  fix: take it from `gyration check SCENE --json`")]
pub struct NotToml(#[from] toml::ser::Error);
