//! The scene as a tree of values that remember where they were written.
//!
//! TOML and JSON are both read into it, `--set` changes it, the checker walks it. It knows nothing of scenes. All
//! numbers of the format are real, so that integers are read as such.

use std::collections::BTreeMap;

/// A piece of one of the document's texts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) struct Span {
    /// Which text: 0 is the file, k the k-th override.
    pub(crate) text: usize,
    /// First byte.
    pub(crate) start: usize,
    /// One behind the last byte.
    pub(crate) end: usize,
}

/// A value and its place.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Node {
    pub(crate) value: Value,
    pub(crate) span: Span,
}

/// What a scene file can hold.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Value {
    /// JSON's null.
    Null,
    /// A date or time of TOML.
    Date,
    Boolean(bool),
    /// A number; infinite if its text does not fit.
    Number(f64),
    Text(String),
    Array(Vec<Node>),
    Table(Table),
}

/// Keys with their places and values.
pub(crate) type Table = BTreeMap<String, Entry>;

/// The value of a key and the place of the key.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    pub(crate) key_span: Span,
    pub(crate) node: Node,
}

impl Value {
    /// What a message calls a value of this kind.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Null => "null",
            Self::Date => "a date",
            Self::Boolean(_) => "a boolean",
            Self::Number(_) => "a number",
            Self::Text(_) => "a string",
            Self::Array(_) => "an array",
            Self::Table(_) => "a table",
        }
    }
}

impl Node {
    /// The value of a key, if this is a table that has it.
    pub(crate) fn get(&self, key: &str) -> Option<&Node> {
        self.entry(key).map(|entry| &entry.node)
    }

    /// The key and its value, if this is a table that has it.
    pub(crate) fn entry(&self, key: &str) -> Option<&Entry> {
        match &self.value {
            Value::Table(table) => table.get(key),
            _ => None,
        }
    }

    /// The items, if this is an array; none otherwise.
    pub(crate) fn items(&self) -> &[Node] {
        match &self.value {
            Value::Array(items) => items,
            _ => &[],
        }
    }

    /// The string, if this is one.
    pub(crate) fn text(&self) -> Option<&str> {
        match &self.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The same value without places. Numbers must be finite, or they become null.
    pub(crate) fn to_json(&self) -> serde_json::Value {
        match &self.value {
            Value::Null | Value::Date => serde_json::Value::Null,
            Value::Boolean(value) => (*value).into(),
            Value::Number(value) => (*value).into(),
            Value::Text(value) => value.as_str().into(),
            Value::Array(items) => items.iter().map(Node::to_json).collect(),
            Value::Table(table) => table.iter().map(|(key, entry)| (key.clone(), entry.node.to_json())).collect(),
        }
    }
}
