//! The table of a study on disk, written as runs finish.
//!
//! ```text
//! NAME.study/
//!     study.json                the study, its scene, its fingerprint, its columns
//!     rows/000012.parquet       a finished chunk: consecutive runs of this table
//!     rows/_000012.jsonl        the journal of an open chunk; gone when its .parquet is there
//!     recordings/run-000012.gyr
//!     table.parquet             at the end: all rows in order; then rows/ is gone
//!     shard-3-of-8/             a shard: the same layout inside
//! ```
//!
//! Every file carries a checksum. What is told of runs that are done is told when the disk has their rows. Whatever
//! interrupts the writing, each run is there once or not at all. The bytes of `table.parquet` depend on the rows alone:
//! not on the order in which they came, nor on chunks, threads or shards.

mod describe;
mod digest;
mod disk;
mod frame;
mod journal;
mod lock;
mod merge;
mod other;
mod parquet;
mod seal;
mod shard;
mod writer;

pub use digest::{Digest, Spread};
pub use frame::{Data, DataFrame, Described, FrameColumn};
pub use lock::TableLock;
pub use merge::merge;
pub use shard::Shard;
pub use writer::Table;

const TABLE: &str = "table.parquet";
const ROWS: &str = "rows";
const LOCK: &str = "lock";
const RECORDINGS: &str = "recordings";
/// Rows that are read at a time.
const PORTION: usize = 1 << 12;
