//! A body that is not to move: what to write for it.

use crate::key::Key;
use crate::tree::Table;
use serde_json::Value as Json;

/// What a body and a support with a shape have alike.
const SHARED: [&str; 4] = ["name", "shape", "position", "orientation"];

/// Words for it.
const WORDS: [&str; 5] = ["fixed", "static", "immovable", "kinematic", "anchored"];

/// Whether a key says that a body is fixed.
pub(super) fn says(table: &Key, name: &str) -> bool {
    WORDS.contains(&name) && table.is_item_of("body")
}

/// The support in its place, as it is to be written.
pub(super) fn help(word: &str, body: &Table) -> String {
    let is_false = body.get(word).is_some_and(|entry| entry.node.to_json() == Json::Bool(false));
    if is_false {
        return "leave it out: a body is free to move".to_owned();
    }
    let written = |name: &&str| Some(format!("{name} = {}", inline(&body.get(*name)?.node.to_json())));
    let keys: Vec<String> = SHARED.iter().filter_map(written).collect();
    format!("write a support: [[support]] with {}, and name it in contacts", keys.join(", "))
}

/// A value in TOML, on one line.
fn inline(value: &Json) -> String {
    match value {
        Json::Object(table) => {
            let keys: Vec<String> = table.iter().map(|(name, value)| format!("{name} = {}", inline(value))).collect();
            format!("{{ {} }}", keys.join(", "))
        }
        Json::Array(items) => format!("[{}]", items.iter().map(inline).collect::<Vec<_>>().join(", ")),
        Json::Null | Json::Bool(_) | Json::Number(_) | Json::String(_) => value.to_string(),
    }
}
