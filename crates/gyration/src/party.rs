//! Who something acts between: bodies, supports, space.

use std::fmt;

/// One of the two between which something acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Party {
    /// The body of this index.
    Body(usize),
    /// The plane support of this index.
    Support(usize),
    /// The support with a shape of this index.
    SolidSupport(usize),
    /// Space itself, where anchors are.
    Space,
}

impl fmt::Display for Party {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Body(index) => write!(f, "body {index}"),
            Self::Support(index) => write!(f, "support {index}"),
            Self::SolidSupport(index) => write!(f, "support {index} with a shape"),
            Self::Space => f.write_str("space"),
        }
    }
}

impl Party {
    /// The index of a body; none of what is no body.
    pub fn body(self) -> Option<usize> {
        match self {
            Self::Body(index) => Some(index),
            Self::Support(_) | Self::SolidSupport(_) | Self::Space => None,
        }
    }
}
