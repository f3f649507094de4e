//! The numbers to find: read, with their starts, bounds and scales.

use super::FreeNumber;
use super::file;
use super::scale::Scale;
use crate::written::measured;
use gyration_scene::input::InputFile;
use gyration_scene::{Override, Template};
use serde_json::Value as Json;

/// The number at a dotted key of a scene.
pub(super) fn number_at(resolved: &Json, key: &str) -> Option<f64> {
    let step = |at: &Json, word: &str| -> Option<Json> {
        match at {
            Json::Array(items) => {
                let named = items.iter().find(|item| item.get("name").and_then(Json::as_str) == Some(word));
                named.or_else(|| items.get(word.parse::<usize>().ok()?)).cloned()
            }
            _ => at.get(word).cloned(),
        }
    };
    key.split('.').try_fold(resolved.clone(), |at, word| step(&at, word.trim()))?.as_f64()
}

/// Notes a number of a law that follows from what is said of its contact: alone it is no law.
pub(super) fn is_written(
    input: &mut InputFile,
    number: &FreeNumber,
    template: &Template,
    settings: &[Override],
    numbers: &Json,
) {
    let written = template.written();
    for key in &number.keys {
        let words: Vec<&str> = key.split('.').map(str::trim).collect();
        let ["contact", contact, law, ..] = words[..] else { continue };
        let place = contact.parse::<usize>().unwrap_or_default();
        let is_said = numbers["contact"][place].get("from").is_some() && law != "from";
        let is_set =
            settings.iter().any(|setting| setting.to_string().starts_with(&format!("contact.{contact}.{law}")));
        if is_said && written["contact"][place].get(law).is_none() && !is_set {
            let message = format!("`{law}` of this contact follows from its `from`");
            let said: Vec<String> = numbers["contact"][place]["from"]
                .as_object()
                .map(|said| said.keys().map(|word| format!("contact.{contact}.from.{word}")).collect())
                .unwrap_or_default();
            let help = format!("fit one of {}, or write `{law}` as `gyration check` prints it", said.join(", "));
            input.note(&["fit", &number.name], message, help);
        }
    }
}

/// Reads a number; what is wrong with it is noted.
pub(super) fn number(input: &mut InputFile, name: &str, resolved: Option<&Json>) -> Option<FreeNumber> {
    let place = ["fit", name];
    let written: file::Fit = input.take(&place)?;
    let keys = match (written.key, written.keys) {
        (Some(key), None) => vec![key],
        (None, Some(keys)) if !keys.is_empty() => keys,
        _ => {
            input.note(&place, "expected one of `key` and `keys`", "write key = \"contact.0.repulsion.alpha\"");
            return None;
        }
    };
    let mut own = None;
    for key in &keys {
        let found = resolved.and_then(|resolved| number_at(resolved, key));
        if resolved.is_some() && found.is_none() {
            let help = "write the dotted key of a number, as of --set: contact.0.repulsion.alpha";
            input.note(&place, format!("the scene has no number at `{key}`"), help);
            return None;
        }
        // How a run is computed and recorded is nothing to be measured.
        if ["time.", "solver.", "record."].iter().any(|table| key.starts_with(table)) {
            let help = "fit numbers of bodies, supports and laws";
            input.note(&place, format!("`{key}` says how the scene is run, and no measurement tells it"), help);
            return None;
        }
        own = own.or(found);
    }
    let mut given = |word: &str, value: Option<Json>| match value.map(|value| measured(&value, &keys[0])) {
        Some(Err((message, help))) => {
            input.note(&[place[0], place[1], word], message, help);
            None
        }
        Some(Ok(number)) => Some(number),
        None => None,
    };
    let start = given("start", written.start).or(own)?;
    let bounds = [given("from", written.from), given("to", written.to)];
    if let [Some(low), Some(high)] = bounds
        && low >= high
    {
        let help = if low > high { "swap the two bounds" } else { "write a greater `to`" };
        let message = format!("the bound to = {high:?} is not greater than from = {low:?}");
        input.note(&[place[0], place[1], "to"], message, help);
        return None;
    }
    let kind = written.scale.unwrap_or(if start > 0.0 { file::Scale::Log } else { file::Scale::Linear });
    let size = match bounds {
        [Some(low), Some(high)] => high - low,
        _ => start.abs(),
    };
    if size == 0.0 {
        let help = "write `start`, or `from` and `to`";
        input.note(&place, "the search begins at zero, and nothing says how large the number may be", help);
        return None;
    }
    let bounds = match bounds {
        [None, None] => None,
        [Some(low), Some(high)] if low < start && start < high => Some([low, high]),
        [Some(_), Some(_)] => {
            let message = format!("the start, {start:?}, does not lie between the bounds");
            input.note(&place, message, "write from < start < to");
            return None;
        }
        _ => {
            input.note(&place, "a bound stands alone", "write both `from` and `to`");
            return None;
        }
    };
    if kind == file::Scale::Log && (start <= 0.0 || bounds.is_some_and(|[low, _]| low <= 0.0)) {
        input.note(
            &place,
            "a number on a log scale is greater than zero",
            "write scale = \"linear\", or other numbers",
        );
        return None;
    }
    Some(FreeNumber { name: name.to_owned(), keys, start, scale: Scale { kind, size, bounds } })
}
