//! `gyration schema`: the JSON Schemas by which editors complete and check files.

use crate::arguments::SchemaOf;
use crate::error::{CliError, code};
use crate::output;

/// Prints the schema.
pub fn execute(of: SchemaOf) -> Result<u8, CliError> {
    let schema = match of {
        SchemaOf::Scene => gyration_scene::schema(),
        #[cfg(feature = "study")]
        SchemaOf::Study => gyration_study::schema(),
        #[cfg(feature = "study")]
        SchemaOf::Calibration => gyration_study::calibration::schema(),
    };
    output::print(&format!("{schema:#}\n"))?;
    Ok(code::DONE)
}
