//! The JSON Schema of a scene, generated from the file's types.
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

/// The schema, made once.
#[cfg(not(written_schema))]
pub(crate) static SCHEMA: LazyLock<Value> = LazyLock::new(schema_of::<crate::file::SceneFile>);

/// The schema, as the program has written it before this was built.
#[cfg(written_schema)]
pub(crate) static SCHEMA: LazyLock<Value> =
    LazyLock::new(|| serde_json::from_str(include_str!(env!("GYRATION_SCHEMA"))).unwrap_or_default());

/// The JSON Schema (draft 2020-12) of a type of file, in the manner of that of a scene.
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
