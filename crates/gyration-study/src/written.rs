//! Values as TOML and as numbers.

use gyration_scene::unit_of;
use gyration_scene::units::{parse_quantity, parse_unit};
use serde_json::Value as Json;

/// A value as TOML that fits a line.
pub(crate) fn toml(value: &Json) -> String {
    match value {
        Json::Null => "\"\"".to_owned(),
        // The escapes of JSON are all of TOML.
        Json::Bool(_) | Json::String(_) => value.to_string(),
        Json::Number(number) => number.as_f64().map_or_else(|| number.to_string(), |number| format!("{number:?}")),
        Json::Array(items) => format!("[{}]", items.iter().map(toml).collect::<Vec<_>>().join(", ")),
        Json::Object(entries) => {
            let entries = entries.iter().map(|(key, value)| format!("{} = {}", Json::from(key.as_str()), toml(value)));
            format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
        }
    }
}

/// A number in SI units.
///
/// # Errors
/// Message and fix, if it is neither a number nor a string with a unit that suits a dotted key of a scene.
pub(crate) fn measured(value: &Json, key: &str) -> Result<f64, (String, String)> {
    measured_in(value, key, unit_of(key))
}

/// A number in SI units, of something that messages call `what`.
///
/// # Errors
/// Message and fix, if it is neither a number nor a string with a unit of the dimension of `symbol`.
pub(crate) fn measured_in(value: &Json, what: &str, symbol: Option<&str>) -> Result<f64, (String, String)> {
    match value {
        Json::Number(number) => Ok(number.as_f64().unwrap_or(f64::NAN)),
        // What is beyond the range of numbers has no JSON.
        Json::Null => Err(("expected a finite number".into(), "write a finite number".into())),
        Json::String(text) => in_unit(text, what, symbol),
        _ => Err(("expected a number".into(), "write a number in SI units, or a string with a unit, \"2 cm\"".into())),
    }
}

fn in_unit(text: &str, what: &str, symbol: Option<&str>) -> Result<f64, (String, String)> {
    let (number, unit) = parse_quantity(text)
        .map_err(|error| (error.to_string(), "write a number in SI units, or a string such as \"2 cm\"".to_owned()))?;
    let value = number * unit.size;
    match symbol.and_then(|symbol| Some((symbol, parse_unit(symbol).ok()?))) {
        Some((_, wanted)) if wanted.dimension == unit.dimension && value.is_finite() => Ok(value),
        Some((symbol, wanted)) => {
            let message = format!("\"{text}\" is in {}, and {what} in {symbol} ({})", unit.dimension, wanted.dimension);
            Err((message, format!("write a number in {symbol}")))
        }
        None => {
            let help = "write a plain number; or mend the key, if it is one that has a unit";
            Err((format!("\"{text}\" has a unit, and {what} has none"), help.into()))
        }
    }
}

/// The SI unit at a key, or of the items of the array there.
pub(crate) fn unit_at(key: &str) -> Option<&'static str> {
    unit_of(key).or_else(|| unit_of(&format!("{key}.0")))
}
