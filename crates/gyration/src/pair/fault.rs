//! Why there is no plane between two bodies.

use crate::contact::LawKind;
use crate::surface::GapClosed;

/// Why there is no plane between two bodies.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PairFault {
    /// None separates them: they touch or overlap.
    #[error("no plane separates the bodies: smallest gap {gap:e} m")]
    Overlap {
        /// The smallest gap found [m], not above what digits tell.
        gap: f64,
    },
    /// That of least potential is beyond the digits of a number.
    #[error("the plane between the bodies is not found: squared Newton decrement {decrement:e}")]
    NotFound {
        /// The squared Newton decrement of log U where the search ended; NaN where U is no number.
        decrement: f64,
    },
    /// A law has no balance on it.
    #[error("the plane between the bodies has no balance of {0:?}")]
    Singular(LawKind),
}

impl PairFault {
    /// Of a gap [m] that is not open, or no number.
    pub(super) fn of_gap(gap: f64) -> Self {
        if gap.is_nan() { Self::NotFound { decrement: f64::NAN } } else { Self::Overlap { gap } }
    }
}

impl From<GapClosed> for PairFault {
    fn from(closed: GapClosed) -> Self {
        Self::of_gap(closed.gap)
    }
}
