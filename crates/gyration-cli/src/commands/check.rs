//! `gyration check`: what a scene says before it runs.

use crate::arguments::Check;
use crate::error::{CliError, code};
use crate::input::open;
use crate::output;
use crate::waiting::waiting;
use gyration_scene::LoadError;
use gyration_sim::survey::Survey;
use serde_json::json;

/// Prints what can be said of the scene.
pub fn execute(arguments: &Check) -> Result<u8, CliError> {
    let name = &arguments.scene.scene;
    let scene = waiting(format!("opening {name}"), true, || open(&arguments.scene))?;
    let survey = waiting(format!("surveying {name}"), true, || Survey::of(&scene)).map_err(LoadError::from)?;
    let text = if arguments.json {
        let mut value = json!({ "scene": scene.name(), "resolved": scene.resolved(), "bodies": survey.bodies });
        if !survey.springs.is_empty() {
            value["springs"] = json!(survey.springs);
        }
        if !survey.meetings.is_empty() {
            value["meetings"] = json!(survey.meetings);
        }
        for (name, told) in [("notes", &survey.remarks.notes), ("warnings", &survey.remarks.warnings)] {
            if !told.is_empty() {
                value[name] = json!(told);
            }
        }
        format!("{value:#}\n")
    } else {
        survey.text(&scene)?
    };
    output::print(&text)?;
    Ok(code::DONE)
}
