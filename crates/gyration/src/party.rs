//! Who something acts between: bodies, supports, space.

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

impl Party {
    /// The index of a body; none of what is no body.
    pub fn body(self) -> Option<usize> {
        match self {
            Self::Body(index) => Some(index),
            Self::Support(_) | Self::SolidSupport(_) | Self::Space => None,
        }
    }
}
