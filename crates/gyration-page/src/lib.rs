//! What a page that shows recordings and runs is told, whoever carries it there.
//!
//! ```text
//! recording ─→ header (JSON), blobs (arrays)             carried by a server, or in the page itself
//! scene ─→ WatchedRun ─→ Store ─→ messages of a cursor   carried by a websocket, or by a worker of the page
//!                    └→ KeptRun ─→ files                 of a page alone
//! ```
//!
//! [`header`] says what a recording is, [`blob`] how the numbers are laid out, [`store`] what a run has published. No
//! server, no thread, no clock; no mechanics.

#![forbid(unsafe_code)]

pub mod besides;
pub mod binary;
pub mod blob;
pub mod header;
mod kept;
mod places;
pub mod store;
mod watched;

pub use kept::{FileFormat, KeptRun};
pub use watched::{NetworkTeller, SceneHash, WatchedRun, finish, progress};
