//! Why there is no scene of a file: it cannot be read, or it describes no robot.

use gyration_files::in_words;
use std::fmt;
use std::path::PathBuf;

/// Largest file that is read \[bytes\]; meshes stand in files of their own.
pub(crate) const LARGEST: u64 = 64 << 20;

/// Why there is no scene of a file.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// The system refused.
    #[error("{path}: cannot be read: {}", in_words(source), path = path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// Too large to be read.
    #[error("{path}: more than the {LARGEST} bytes that are read; put meshes into files of their own", path = path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
    },
    /// What stands in it is wrong.
    #[error(transparent)]
    Content(#[from] Faults),
}

/// One thing wrong with a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The file as it was named.
    pub file: String,
    /// Line, from one.
    pub line: usize,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub fix: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}\n  fix: {}", self.file, self.line, self.message, self.fix)
    }
}

/// Everything that is wrong with a file, by line; never empty.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Faults(Vec<Fault>);

impl Faults {
    /// Those found, of which there is one at least.
    pub(crate) fn of(mut found: Vec<Fault>) -> Self {
        debug_assert!(!found.is_empty(), "a file is refused for a reason");
        found.sort_by_key(|fault| fault.line);
        Self(found)
    }

    /// The faults, by line.
    pub fn as_slice(&self) -> &[Fault] {
        &self.0
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // More than a person reads at once; the first ones explain the rest.
        const SHOWN: usize = 50;
        for (index, fault) in self.0.iter().take(SHOWN).enumerate() {
            let separator = if index == 0 { "" } else { "\n" };
            write!(f, "{separator}{fault}")?;
        }
        match self.0.len() {
            0 | 1 => Ok(()),
            count if count > SHOWN => write!(f, "\n{count} errors, of which {SHOWN} are shown"),
            count => write!(f, "\n{count} errors"),
        }
    }
}

impl std::error::Error for Faults {}
