//! In what the text that something was made from differs from the one that is to go on with it: keys, with both values.

use gyration_scene::units::without_rounding;
use serde_json::Value;
use std::collections::BTreeSet;

/// Keys that are told at most.
const MOST_KEYS: usize = 12;
/// Letters of a value that are told at most.
const MOST_LETTERS: usize = 60;

/// One line for each key whose values differ, `KEY: A there, B here`; none if all are the same.
pub fn differences(there: &Value, here: &Value) -> Vec<String> {
    let mut lines = Vec::new();
    compare("", Some(there), Some(here), &mut lines);
    let more = lines.len().saturating_sub(MOST_KEYS);
    if more > 0 {
        lines.truncate(MOST_KEYS);
        lines.push(format!("and {more} keys more"));
    }
    lines
}

fn compare(key: &str, there: Option<&Value>, here: Option<&Value>, lines: &mut Vec<String>) {
    let within = |part: &str| if key.is_empty() { part.to_owned() } else { format!("{key}.{part}") };
    match (there, here) {
        (Some(Value::Object(a)), Some(Value::Object(b))) => {
            for part in a.keys().chain(b.keys()).collect::<BTreeSet<_>>() {
                compare(&within(part), a.get(part), b.get(part), lines);
            }
        }
        (Some(Value::Array(a)), Some(Value::Array(b))) if a.iter().chain(b).all(Value::is_object) => {
            for index in 0..a.len().max(b.len()) {
                let (a, b) = (a.get(index), b.get(index));
                compare(&within(&label(a, b, index)), a, b, lines);
            }
        }
        _ if there == here => {}
        _ => {
            let rounded = [there, here].map(|value| shown(value.map(without_rounding_within).as_ref()));
            // What differs by rounding alone is told as it is.
            let [there, here] = if rounded[0] == rounded[1] { [there, here].map(shown) } else { rounded };
            lines.push(format!("{key}: {there} there, {here} here"));
        }
    }
}

/// A number without what a change of units has left in its last digit; anything else as it is.
fn without_rounding_within(value: &Value) -> Value {
    match value.as_f64().filter(|_| value.is_f64()) {
        Some(number) => Value::from(without_rounding(number)),
        None => value.clone(),
    }
}

/// How an override calls a part of a list: by the name that it has on both sides, else by its number.
fn label(there: Option<&Value>, here: Option<&Value>, index: usize) -> String {
    let name = |part: Option<&Value>| part?.get("name")?.as_str().map(String::from);
    let same = name(there).filter(|found| here.is_none() || name(here).as_ref() == Some(found));
    same.or_else(|| name(here).filter(|_| there.is_none())).unwrap_or_else(|| index.to_string())
}

fn shown(value: Option<&Value>) -> String {
    let text = value.map_or_else(|| "nothing".to_owned(), Value::to_string);
    if text.chars().count() <= MOST_LETTERS {
        return text;
    }
    text.chars().take(MOST_LETTERS).chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn keys_are_told_by_the_names_of_bodies_with_both_values() {
        let scene = |end: f64, density: f64| {
            let die = json!({ "name": "die", "density": density });
            json!({ "time": { "end": end, "sample": 0.1 }, "body": [die] })
        };
        assert!(differences(&scene(1.0, 2.0), &scene(1.0, 2.0)).is_empty());
        let told = differences(&scene(1.0, 2.0), &scene(3.0, 4.0));
        assert_eq!(told, ["body.die.density: 2.0 there, 4.0 here", "time.end: 1.0 there, 3.0 here"]);
        assert_eq!(differences(&json!({}), &json!({ "spin": "full" })), ["spin: nothing there, \"full\" here"]);
        // 1.25 g/cm3 is that in kg/m3.
        let told = differences(&scene(1.0, 1249.9999999999998), &scene(1.0, 1000.0));
        assert_eq!(told, ["body.die.density: 1250.0 there, 1000.0 here"]);
        let told = differences(&scene(1.0, 1249.9999999999998), &scene(1.0, 1250.0));
        assert_eq!(told, ["body.die.density: 1249.9999999999998 there, 1250.0 here"]);
        let body = |k: usize| json!({ "name": format!("b{k}") });
        let bodies = |count: usize| json!({ "body": (0..count).map(body).collect::<Vec<_>>() });
        assert_eq!(differences(&bodies(1), &bodies(2)), ["body.b1: nothing there, {\"name\":\"b1\"} here"]);
        assert_eq!(differences(&bodies(0), &bodies(20)).len(), MOST_KEYS + 1);
    }
}
