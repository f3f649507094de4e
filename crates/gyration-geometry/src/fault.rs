//! What can be wrong at a place of a mesh file.

use std::fmt;

/// A place in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilePlace {
    /// A line of a text, counted from 1.
    Line(usize),
    /// A byte of a binary file, counted from 0.
    Byte(usize),
}

impl fmt::Display for FilePlace {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(formatter, "line {line}"),
            Self::Byte(byte) => write!(formatter, "byte {byte}"),
        }
    }
}

/// Something wrong at a place of a mesh file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{place}: {trouble}")]
pub struct FileFault {
    /// Where.
    pub place: FilePlace,
    /// What.
    pub trouble: Trouble,
}

/// What may be wrong at a place of a mesh file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Trouble {
    /// The file ends too early.
    #[error("the file ends where {expected} should follow; export it again")]
    Truncated {
        /// What is missing.
        expected: &'static str,
    },
    /// A header announces more than the file holds.
    #[error("{announced} {what} are announced, more than the {bytes} bytes that follow can hold; export it again")]
    Announced {
        /// The number.
        announced: u64,
        /// Of what.
        what: String,
        /// How many bytes there are for them.
        bytes: usize,
    },
    /// Something else than what the format asks for.
    #[error("expected {expected}, found `{found}`")]
    Unexpected {
        /// What the format asks for.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// A coordinate is infinite or not a number.
    #[error("the coordinate {value} is not finite")]
    NotFinite {
        /// The coordinate.
        value: f64,
    },
    /// A face refers to no vertex.
    #[error("a face refers to vertex {index}, but {count} are defined so far")]
    NoSuchVertex {
        /// As it stands in the file.
        index: f64,
        /// How many vertices there are.
        count: usize,
    },
    /// A face has fewer than three corners.
    #[error("a face has {corners} corners: it needs at least 3")]
    FewCorners {
        /// How many.
        corners: usize,
    },
    /// A polygon that no fan of triangles covers.
    #[error("a face of {corners} corners is too far from convex to be split into a fan: export triangles")]
    Polygon {
        /// How many corners.
        corners: usize,
    },
}

impl Trouble {
    /// The trouble at a place.
    pub(crate) fn at(self, place: FilePlace) -> FileFault {
        FileFault { place, trouble: self }
    }

    /// Something unexpected; long text is cut.
    pub(crate) fn unexpected(expected: &'static str, found: &str) -> Self {
        Self::Unexpected { expected, found: found.chars().take(40).collect() }
    }
}

/// The finite number that a word of a text stands for.
pub(crate) fn coordinate(word: Option<&str>, place: FilePlace) -> Result<f64, FileFault> {
    let word = word.ok_or(Trouble::Truncated { expected: "a coordinate" }.at(place))?;
    let value = word.parse().map_err(|_| Trouble::unexpected("a number", word).at(place))?;
    finite(value, place)
}

/// The value, if it is finite.
pub(crate) fn finite(value: f64, place: FilePlace) -> Result<f64, FileFault> {
    if value.is_finite() { Ok(value) } else { Err(Trouble::NotFinite { value }.at(place)) }
}
