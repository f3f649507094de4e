//! Thousands of runs of a scene into one table: grids, random parameters, shards.
//!
//! ```text
//! study.toml → Study          what is varied in a scene, and what is kept of each run
//! run number → Study::row     depends on the study and the number alone; failures are rows
//! rows → Table                a folder: rows as they come, one Parquet file at the end; resumed, sharded, joined
//! execute                     the rows that are missing, on the threads of one machine
//! table → Frame               columns in memory, for drawing
//! ```
//!
//! [`calibration`] finds numbers of a scene from measurements. Nothing in a table depends on clocks, threads, shards or
//! the order of the runs. No mechanics here: a run is one of `gyration-sim`.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod calibration;
mod column;
mod error;
mod execute;
mod extract;
mod file;
mod fingerprint;
mod gallery;
mod keep;
mod parameter;
mod random;
mod read;
mod run;
mod study;
mod table;
mod value;
mod written;

pub use column::{Column, ColumnKind};
pub use error::StudyError;
pub use execute::{StudyMonitor, StudyProgress, execute};
pub use gallery::studies;
pub use keep::{Keep, Pick, Statistic};
pub use parameter::{AxisValues, Distribution, Parameter, Variation};
pub use run::{FAILED, STEP_LIMIT, Worker};
pub use study::{Recordings, Sampling, Study, StudySource};
pub use table::{Data, DataFrame, Described, Digest, FrameColumn, Shard, Spread, Table, TableLock, merge};
pub use value::{Row, Value};

/// The JSON Schema of a study.
pub fn schema() -> serde_json::Value {
    gyration_scene::written_schema(include_str!("../schema/study.json"))
}

/// The JSON Schemas of a study and of a file of measurements as their types have them: what `schema/` is compared with.
pub fn derived_schemas() -> [(&'static str, serde_json::Value); 2] {
    let measurements = gyration_scene::schema_of::<calibration::file::CalibrationFile>();
    [("study", gyration_scene::schema_of::<file::StudyFile>()), ("calibration", measurements)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_written_schemas_are_those_of_the_types() {
        for ((name, derived), written) in derived_schemas().into_iter().zip([schema(), calibration::schema()]) {
            if std::env::var_os("GYRATION_SCHEMA").is_some() {
                let path = format!("{}/schema/{name}.json", env!("CARGO_MANIFEST_DIR"));
                std::fs::write(path, format!("{derived:#}\n")).unwrap();
            } else {
                assert!(
                    written == derived,
                    "{name}: not that of the types; GYRATION_SCHEMA=write cargo test -p gyration-study --lib schema"
                );
            }
        }
    }
}
