//! What no file of measurements may say: what cannot be measured, numbers that are found and set at once, and starts
//! that the scene refuses.

use super::{ExperimentKind, FreeNumber};
use gyration_scene::input::InputFile;
use gyration_scene::{Override, Template};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// Whether anything could have been measured so: a rebound gives back no more than the drop, within three deviations,
/// and what slides at all does on a wall.
pub(super) fn is_possible(kind: ExperimentKind, condition: f64, measured: f64, deviation: f64) -> bool {
    let most = match kind {
        ExperimentKind::Drop => condition + 3.0 * deviation,
        ExperimentKind::Begins => FRAC_PI_2,
        ExperimentKind::Slope | ExperimentKind::Gap | ExperimentKind::PullOff | ExperimentKind::Dispersion => {
            f64::INFINITY
        }
    };
    measured > 0.0 && measured < most
}

/// Notes numbers of the scene that are found twice, or set by what was measured.
pub(super) fn keys_once(input: &mut InputFile, numbers: &[FreeNumber], template: &Template) {
    let mut seen: BTreeMap<String, &str> = BTreeMap::new();
    for number in numbers {
        for key in &number.keys {
            if let Some(other) = seen.insert(template.by_index(key), &number.name) {
                let place = ["fit", number.name.as_str()];
                input.note(&place, format!("`{key}` is already fitted as \"{other}\""), "keep one of the two");
            }
        }
    }
    let is_part =
        |one: &str, other: &str| one == other || one.strip_prefix(other).is_some_and(|rest| rest.starts_with('.'));
    for key in input.keys(&["set"]) {
        // A law may be set as a whole, of which a number is then fitted.
        if let Some(name) = seen.get(&template.by_index(&key)) {
            let message = format!("`{key}` is fitted as \"{name}\", and cannot be set too");
            input.note(&["set", &key], message, format!("write it as the `start` of fit.{name}, or do not fit it"));
        }
    }
    for kind in ExperimentKind::SECTIONS {
        let count = input.value(&[kind.word()]).and_then(|tables| tables.as_array().map(Vec::len)).unwrap_or(0);
        for index in (0..count).map(|index| index.to_string()) {
            let place = [kind.word(), index.as_str()];
            let mut own = input.keys(&[place[0], place[1], "set"]);
            own.extend(input.value(&[place[0], place[1], "key"]).and_then(|key| key.as_str().map(str::to_owned)));
            for key in own {
                let plain = template.by_index(&key);
                if let Some((_, name)) =
                    seen.iter().find(|(fitted, _)| is_part(fitted, &plain) || is_part(&plain, fitted))
                {
                    let message = format!("`{key}` is fitted as \"{name}\", and cannot be set for one table");
                    input.note(&place, message, "set it for none, or do not fit it");
                }
            }
        }
    }
}

/// Notes starts of a search that are no numbers of the scene, where they are written.
pub(super) fn starts(input: &mut InputFile, numbers: &[FreeNumber], template: &Template, settings: &[Override]) {
    let keys: Vec<(&FreeNumber, &String)> =
        numbers.iter().flat_map(|number| number.keys.iter().map(move |key| (number, key))).collect();
    let begun = keys.iter().map(|(number, key)| Override::new(*key, number.start));
    let overrides: Vec<Override> = settings.iter().cloned().chain(begun).collect();
    let Err(errors) = template.scene(&overrides) else { return };
    for error in errors.as_slice() {
        let at = error.overriding.and_then(|index| keys.get(index.checked_sub(settings.len())?));
        if let Some((number, key)) = at {
            let message = format!("the search cannot begin there, `{key}` of the scene {}", error.message);
            input.note(&["fit", number.name.as_str(), "start"], message, error.help.clone());
        }
    }
}
