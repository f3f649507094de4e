//! Opens the scene of the first run, and says which key of the study is wrong if that fails.

use super::Read;
use gyration_scene::input::InputFile;
use gyration_scene::{ErrorKind, Override, Scene, SceneErrors, Template};
use std::collections::BTreeSet;

/// The scene of the first run; if a value of it is not possible, that of the scene alone, and without what the study
/// sets wrongly.
///
/// A value that is not possible may be meant: that run fails alone. A key, a kind of value or a unit is wrong in all
/// runs.
///
/// # Errors
/// What is wrong with the scene itself. What is wrong with the study is noted in the input, and there is no scene.
pub(crate) fn probe(
    template: &Template,
    read: &Read,
    overrides: &[Override],
    input: &mut InputFile,
) -> Result<Option<Scene>, SceneErrors> {
    let errors = match template.scene(overrides) {
        Ok(scene) => return Ok(Some(scene)),
        Err(errors) => errors,
    };
    let mut blamed = BTreeSet::new();
    for error in errors.as_slice().iter().filter(|error| error.fault != ErrorKind::Value) {
        let Some(index) = error.overriding else { continue };
        let (place, key) = owner(read, index);
        let place: Vec<&str> = place.iter().map(String::as_str).collect();
        let key = if error.key.is_empty() { key } else { error.key.clone() };
        input.note(&place, format!("{key}: {}", error.message), error.help.clone());
        blamed.insert(index);
    }
    if !blamed.is_empty() {
        let rest = overrides.iter().enumerate().filter(|(index, _)| !blamed.contains(index));
        return Ok(template.scene(&rest.map(|(_, one)| one.clone()).collect::<Vec<_>>()).ok());
    }
    let settings = &overrides[..read.settings.len()];
    match template.scene(settings) {
        Ok(scene) if errors.as_slice().iter().all(|error| error.fault == ErrorKind::Value) => Ok(Some(scene)),
        Ok(_) => Err(errors),
        Err(alone) => Err(alone),
    }
}

/// The place in the study of an override of the first run, and the key of the scene that it sets.
fn owner(read: &Read, index: usize) -> (Vec<String>, String) {
    if let Some((key, _)) = read.settings.get(index) {
        return (vec!["set".into(), key.clone()], key.clone());
    }
    let keys = read.parameters.iter().flat_map(|parameter| parameter.keys.iter().map(move |key| (parameter, key)));
    match keys.clone().nth(index - read.settings.len()) {
        Some((parameter, key)) => {
            let word = if parameter.keys.len() == 1 { "key" } else { "keys" };
            (vec!["parameter".into(), parameter.name.clone(), word.into()], key.clone())
        }
        None => (Vec::new(), String::new()),
    }
}
