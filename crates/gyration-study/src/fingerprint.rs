//! A word that tells a study from every other one with other rows: title, drawing, comments and layout of the files do
//! not count.

use crate::column::Column;
use crate::parameter::{AxisValues, Parameter, Variation};
use crate::random::hash;
use crate::read::Read;
use crate::value::Value;
use gyration_scene::{Scene, Template};
use serde_json::{Value as Json, json};
use std::path::Path;

/// Keys of a scene under which the name of a file stands.
const FILE_KEYS: [&str; 3] = ["file", "table", "places"];

/// The fingerprint, 32 hexadecimal digits: the numbers of runs, all that is varied and kept, the columns, the scene and
/// the files that it refers to, the version of the program.
pub(crate) fn fingerprint(read: &Read, columns: &[Column], template: &Template, scene: &Scene) -> String {
    let Read { seed, repetitions, sampling, recordings, max_steps, settings, parameters, axes, keeps, .. } = read;
    let mut files = Vec::new();
    let written = template.written();
    collect(&written, template.base(), &mut files);
    collect(&scene.resolved(), template.base(), &mut files);
    parameters.iter().for_each(|parameter| collect_listed(parameter, template.base(), &mut files));
    let told = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "seed": seed,
        "repetitions": repetitions,
        "sampling": sampling,
        "recordings": recordings,
        "max_steps": max_steps,
        "set": settings,
        "axes": axes,
        "parameters": format!("{parameters:?}"),
        "keeps": format!("{keeps:?}"),
        "columns": columns,
        "scene": written,
        "files": files,
    });
    format!("{:032x}", hash(told.to_string().as_bytes()))
}

/// Hashes of the files that values of an axis refer to: texts, or texts within tables, that are names of files.
fn collect_listed(parameter: &Parameter, base: &Path, files: &mut Vec<String>) {
    let Variation::Axis { steps: AxisValues::Listed(listed), .. } = &parameter.variation else { return };
    for text in listed.iter().flat_map(|(_, cells)| cells).filter_map(Value::text) {
        // A text stands alone, tables are written as TOML.
        for name in std::iter::once(text).chain(text.split('"').skip(1).step_by(2)) {
            if let Ok(bytes) = gyration_files::read(&base.join(name)) {
                files.push(format!("{name} {:032x}", hash(&bytes)));
            }
        }
    }
}

/// Hashes of the files that a scene refers to.
fn collect(value: &Json, base: &Path, files: &mut Vec<String>) {
    match value {
        Json::Object(entries) => {
            for (key, value) in entries {
                if let (true, Json::String(name)) = (FILE_KEYS.contains(&key.as_str()), value)
                    && let Ok(bytes) = gyration_files::read(&base.join(name))
                {
                    files.push(format!("{name} {:032x}", hash(&bytes)));
                }
                collect(value, base, files);
            }
        }
        Json::Array(items) => items.iter().for_each(|item| collect(item, base, files)),
        _ => {}
    }
}
