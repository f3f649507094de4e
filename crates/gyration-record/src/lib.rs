//! Recordings on disk: named arrays with units that grow with time, written so that a crash loses little and a resumed
//! run leaves the same bytes as an uninterrupted one. No mechanics here.
//!
//! A recording is a directory: a Zarr v3 group, uncompressed, that `xarray.open_zarr` opens as it is.
//!
//! ```text
//! NAME.gyr/zarr.json             attributes and the metadata of every array: the commit point of the data
//!          ARRAY/zarr.json       the same metadata again, for readers that do not consolidate
//!          GROUP/ARRAY/…         arrays of which each sample has as many entries as it needs; `start` tells where they begin
//!          ARRAY/c.K.0…          rows K·C to (K+1)·C − 1, little-endian f64, padded with NaN; C = chunk_rows; CRC-32C
//!          state/checkpoint      what a resumed run starts from, with the number of rows it belongs to; written last
//!          state/lock            held by the one process that writes
//! ```
//!
//! [`Writer`] appends, [`Recording`] reads with bounded memory, [`export`] turns a recording into CSV or NPZ. The crate
//! zarrs would do the Zarr part and more, but takes longer to compile (70 s) than all the rest of this crate.

#![forbid(unsafe_code)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod array;
mod checkpoint;
mod chunks;
mod columns;
mod disk;
mod error;
mod event;
pub mod export;
mod file;
mod fnv;
mod identity;
mod layout;
mod memory;
mod metadata;
mod names;
mod recording;
mod row_hash;
mod stream;
mod writer;
mod zarr;

#[cfg(test)]
mod crash_tests;

pub use array::ArrayInfo;
pub use disk::remove;
pub use error::RecordError;
pub use event::Event;
pub use file::{cannot_write, replace_file, write_file};
pub use fnv::word_of;
pub use layout::{ArraySpec, Dimension, FixedArray, Layout, Ragged, RaggedArray, chunk_rows_for};
pub use memory::Rows;
pub use recording::{Array, Recording};
pub use row_hash::RowHash;
pub use writer::{Resumed, Writer};

/// Attributes of a recording: what JSON can hold.
pub type Attributes = serde_json::Map<String, serde_json::Value>;
