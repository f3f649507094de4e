//! Looking at recordings and runs in a browser: the local server and the report.
//!
//! ```text
//! recording ─→ Stored ──┬─→ report: one HTML file with everything in it
//!                       └─→ Server ─→ page: header (JSON), blobs (arrays)
//! scene ─→ Live (a thread that runs it) ─→ Server ─→ page: websocket
//! lattice ─→ Waves ─→ Server ─→ page: bands, a wave as rows of one period
//! recording ─→ fields ─→ Server ─→ page: a map of a sample
//! ```
//!
//! The page is built from `viewer/` and embedded ([`page`]); it knows recordings only: `gyration-page` says what one is
//! given, and how the numbers are laid out. The server listens on 127.0.0.1 and answers who has its address, with the
//! token in it, and nobody else. No mechanics here.

#![forbid(unsafe_code)]

mod computed;
mod error;
mod fields;
mod live;
pub mod page;
mod report;
mod server;
mod stored;
mod waves;

pub use error::ViewError;
pub use live::{Live, Wish};
pub use report::{Report, report};
pub use server::{Limits, PageSource, Server};
pub use stored::Stored;
