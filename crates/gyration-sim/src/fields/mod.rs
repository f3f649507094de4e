//! Micromorphic fields of many bodies: Gaussian means of what each does, with the exact local balances.
//!
//! A body is a granule with mass, momentum and affine momentum at its centre; what is between two acts along the line
//! from centre to centre. The balances of the means hold at every point and instant, for any width: what is left of
//! them is rounding (`docs/fields.md`). `local` has the fields, `weight` the means, `granules` what is averaged,
//! `scalars` what pictures show; `field_samples` has those of a recording.

mod granules;
mod local;
mod recorded;
mod scalars;
mod weight;

pub use local::{LocalFields, Third};
pub use scalars::{FIELD_SCALARS, FieldScalar};

pub(crate) use granules::Granules;
pub(crate) use recorded::RecordedPair;
pub(crate) use weight::Weight;
