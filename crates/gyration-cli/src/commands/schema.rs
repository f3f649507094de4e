//! `gyration schema`: the JSON Schema of a scene.

use crate::error::{CliError, code};
use crate::output;

/// Prints the schema.
pub fn execute() -> Result<u8, CliError> {
    output::print(&format!("{:#}\n", gyration_scene::schema()))?;
    Ok(code::DONE)
}
