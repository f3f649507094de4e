//! The JSON Schema of a scene: `schema/scene.json`.
//!
//! A test derives it from the file's types and compares; `GYRATION_SCHEMA=write` has it written anew. So the program
//! does without what derives it, a megabyte, and a change of what people may write is seen where changes are read.
//!
//! Besides the standard keywords it has `unit` (the SI unit of a quantity; a string must have a unit of the same
//! dimension).

use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use schemars::{JsonSchema, Schema};
use serde_json::Value;
use std::sync::LazyLock;

/// The JSON Schema (draft 2020-12) of a scene.
pub fn schema() -> Value {
    SCHEMA.clone()
}

/// The schema, read once.
pub(crate) static SCHEMA: LazyLock<Value> = LazyLock::new(|| written_schema(include_str!("../schema/scene.json")));

/// A schema that stands in a file; null if that is no JSON, which the tests of its owner exclude.
pub fn written_schema(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_default()
}

/// The JSON Schema (draft 2020-12) of a type of file, in the manner of that of a scene: what tests compare with the
/// written one.
pub fn schema_of<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft2020_12().with_transform(WithoutNull);
    settings.into_generator().into_root_schema_for::<T>().to_value()
}

/// Removes null from what an optional key may hold: a key that is not wanted is left out.
#[derive(Debug, Clone)]
struct WithoutNull;

impl Transform for WithoutNull {
    fn transform(&mut self, schema: &mut Schema) {
        transform_subschemas(self, schema);
        let Some(object) = schema.as_object_mut() else { return };
        if let Some(Value::Array(types)) = object.get_mut("type") {
            types.retain(|kind| kind != "null");
            if types.len() == 1 {
                let only = types.remove(0);
                object.insert("type".to_owned(), only);
            }
        }
        if let Some(Value::Array(choices)) = object.get_mut("anyOf") {
            choices.retain(|choice| choice.get("type").is_none_or(|kind| kind != "null"));
            if choices.len() == 1
                && let Value::Object(only) = choices.remove(0)
            {
                object.remove("anyOf");
                object.extend(only);
            }
        }
        if object.get("default").is_some_and(Value::is_null) {
            object.remove("default");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::SceneFile;

    #[test]
    fn the_written_schema_is_that_of_the_types() {
        let derived = schema_of::<SceneFile>();
        if std::env::var_os("GYRATION_SCHEMA").is_some() {
            let path = concat!(env!("CARGO_MANIFEST_DIR"), "/schema/scene.json");
            std::fs::write(path, format!("{derived:#}\n")).unwrap();
        } else {
            assert!(
                schema() == derived,
                "not that of the types; GYRATION_SCHEMA=write cargo test -p gyration-scene --lib schema"
            );
        }
    }
}
