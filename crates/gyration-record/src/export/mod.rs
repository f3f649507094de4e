//! Exports of a recording to formats that everything reads.
//!
//! They pass chunk by chunk, so that a long run needs no more memory than a short one.

mod csv;
mod npz;

pub use csv::csv;
pub use npz::npz;
