//! `gyration new`: a scene to start from, and the schema by which editors complete its keys.

use crate::arguments::New;
use crate::error::{CliError, code};
use crate::input::{quoted, shown};
use crate::output;
use std::fs;
use std::path::PathBuf;

/// The scene, with words for its names.
const TEMPLATE: &str = include_str!("new.toml");
/// The file of the schema, beside the scene.
const SCHEMA: &str = "gyration.schema.json";

/// Writes both; the schema only if there is none yet.
pub fn execute(arguments: &New) -> Result<u8, CliError> {
    if arguments.name.to_string_lossy().chars().any(char::is_control) {
        return Err(CliError::arguments(
            "the name has a line break or another control character",
            "choose another name",
        ));
    }
    let path = match arguments.name.extension() {
        Some(ending) if ending == "toml" => arguments.name.clone(),
        // A dot in a name does not begin an ending.
        _ => PathBuf::from(format!("{}.toml", arguments.name.display())),
    };
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let file = quoted(&path.to_string_lossy());
    let title = toml_text(&name);
    let text = TEMPLATE.replace("SCHEMA", SCHEMA).replace("FILE", &file).replace("\"TITLE\"", &title);
    output::write_scene(&path, &text, false, "choose another name")?;
    output::say(&format!("wrote {}: `gyration run {file}` runs it", shown(&path)));
    let schema = path.with_file_name(SCHEMA);
    if !schema.exists() {
        let written = fs::write(&schema, format!("{:#}\n", gyration_scene::schema()));
        written.map_err(|source| CliError::Write { path: schema.clone(), source })?;
        output::say(&format!("wrote {}, by which editors complete keys", shown(&schema)));
    }
    Ok(code::DONE)
}

/// A text as TOML has it: what JSON escapes, TOML does in the same way.
fn toml_text(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
