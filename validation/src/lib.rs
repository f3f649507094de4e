//! Problems with a known answer.
//!
//! Each file `tests/rowNN_*.rs` holds a problem of the list of known answers, `tests/case_*.rs` a further one. A test
//! computes a number with the program, compares it with a closed form or an independent integration, and prints one
//! line, from which `cargo xtask validate` makes `docs/known-answers.md`:
//!
//!   validation: row=13 case="…" quantity="…" reference=… measured=… error=… tolerance=… source="…"
//!
//! [`published`] declares what other codes and laboratories publish, and runs it.
//!
//! [`Experiment`] runs a scene, or a model made by hand, in memory; [`Studied`] some runs of a ready study. Nothing
//! here computes a reference.

mod answer;
mod experiment;
mod facet;
mod meeting;
pub mod published;
mod studied;
mod tumbling;

pub use answer::{Answer, Case, largest};
pub use experiment::{Experiment, Run};
pub use facet::FacetBody;
pub use meeting::{momenta, wave};
pub use studied::{Studied, TWO};
pub use tumbling::{Turning, passage, threshold};
