//! Pictures: of recordings, of contact laws, of bands, of fields, of the tables of studies, of fits to measurements.
//!
//! ```text
//! recording, scene → show (which quantities) → figure: charts and strips (how they are laid out)
//!   → draw (marks on a page) → SVG, PNG, PDF
//! table of a study → study (how often, how on average, where) ↗
//! ```
//!
//! The same recording gives the same bytes: there are neither dates nor names of machines in a picture. Nothing is
//! written but where [`leave_overview`] is asked to.

#![forbid(unsafe_code)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod attributes;
mod bands;
#[cfg(feature = "study")]
pub mod calibration;
mod classes;
// Without studies nobody fills areas or names places of an axis.
#[cfg_attr(not(feature = "study"), allow(dead_code, unused_imports))]
mod chart;
mod cycle;
mod draw;
mod error;
mod fields;
mod figure;
mod floors;
mod recorded;
mod show;
mod solids;
mod spectrum;
mod strip;
#[cfg(feature = "study")]
pub mod study;
mod thin;

pub use bands::{bands, continuum};
pub use draw::{Film, FilmFrame, Format};
pub use error::PlotError;
pub use fields::fields;
pub use figure::Figure;
pub use floors::{FloorBar, floors};
pub use recorded::TimeSpan;
pub use show::{Asked, OVERVIEW, PlotQuantity, bodies_at, laws, leave_overview, of_recording};
pub use spectrum::spectrum;
