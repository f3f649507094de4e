//! Other files of the program, studies and measurements, read with the same care as a scene.
//!
//! ```text
//! text → tree, with places → structure by a JSON Schema → parts, each deserialized → notes of the caller
//! ```
//!
//! Everything that is wrong comes at once, with file, line, column, dotted key and fix. A place is the keys that lead
//! to it, an index from zero for an item of an array.

use crate::check::{Rules, structure};
use crate::document::{Diagnostics, Document};
use crate::error::{ErrorKind, LoadError, SceneErrors};
use crate::key::Key;
use crate::overriding::Override;
use crate::read;
use crate::suggest;
use crate::tree::{Node, Value};
use serde::de::DeserializeOwned;
use std::path::Path;

/// What a kind of file may hold.
#[derive(Debug)]
pub struct InputRules(Rules);

impl InputRules {
    /// The rules of the files that a JSON Schema describes.
    pub fn new(schema: &serde_json::Value) -> Self {
        Self(Rules::new(schema))
    }
}

/// A file and what has been found wrong with it.
#[derive(Debug)]
pub struct InputFile {
    document: Document,
    diagnostics: Diagnostics,
}

impl InputFile {
    /// Reads a file, applies overrides as of a scene, and checks its structure.
    ///
    /// # Errors
    /// `Read` if it cannot be read, `Content` with all errors of its syntax.
    pub fn load(path: &Path, rules: &InputRules, overrides: &[String]) -> Result<Self, LoadError> {
        let (name, text) = read::text(path)?;
        Ok(Self::parse(&name, &text, rules, overrides)?)
    }

    /// Reads a text, applies overrides as of a scene, and checks its structure; `name` is what messages call it. TOML,
    /// or JSON as of a scene.
    ///
    /// # Errors
    /// All errors of its syntax.
    pub fn parse(name: &str, text: &str, rules: &InputRules, overrides: &[String]) -> Result<Self, SceneErrors> {
        let mut document = read::document(name, text)?;
        let mut diagnostics = Diagnostics::of(ErrorKind::Structure);
        read::apply(&mut document, &Override::parse_all(overrides), &mut diagnostics);
        structure(&document.root, &rules.0, &mut diagnostics);
        Ok(Self { document, diagnostics })
    }

    /// Its text, verbatim.
    pub fn text(&self) -> &str {
        self.document.texts.first().map_or("", |text| &text.content)
    }

    /// The keys of the table at a place, in the order in which they are written; none where there is no table.
    pub fn keys(&self, place: &[&str]) -> Vec<String> {
        let Some(Value::Table(table)) = self.node(place).map(|node| &node.value) else { return Vec::new() };
        let mut keys: Vec<_> = table.iter().map(|(name, entry)| (entry.key_span, name.clone())).collect();
        keys.sort();
        keys.into_iter().map(|(_, name)| name).collect()
    }

    /// The value at a place, as it is written.
    pub fn value(&self, place: &[&str]) -> Option<serde_json::Value> {
        self.node(place).map(Node::to_json)
    }

    /// The value at a place, if it is there and nothing has been found wrong within it.
    pub fn take<T: DeserializeOwned>(&mut self, place: &[&str]) -> Option<T> {
        let key = self.key(place);
        let json = self.node(place)?.to_json();
        if self.diagnostics.iter().any(|diagnostic| key.holds(&diagnostic.key)) {
            return None;
        }
        serde_json::from_value(json).map_err(|error| self.note(place, error.to_string(), "see the reference")).ok()
    }

    /// Notes what is wrong at a place, or around it if nothing stands there, and what to do.
    pub fn note(&mut self, place: &[&str], message: impl Into<String>, help: impl Into<String>) {
        let key = self.key(place);
        self.diagnostics.at(key.span(&self.document.root), &key, message, help);
    }

    /// Whether nothing has been found wrong.
    pub fn is_sound(&self) -> bool {
        self.diagnostics.is_empty()
    }

    /// Ends the reading.
    ///
    /// # Errors
    /// Everything that has been found wrong, in the order of the text.
    pub fn finish(self) -> Result<(), SceneErrors> {
        if self.diagnostics.is_empty() { Ok(()) } else { Err(self.refused()) }
    }

    /// Everything that has been found wrong with an input that is not sound, in the order of the text.
    pub fn refused(self) -> SceneErrors {
        self.document.errors(self.diagnostics)
    }

    fn node(&self, place: &[&str]) -> Option<&Node> {
        place.iter().try_fold(&self.document.root, |node, word| match &node.value {
            Value::Array(items) => items.get(word.parse::<usize>().ok()?),
            _ => node.get(word),
        })
    }

    fn key(&self, place: &[&str]) -> Key {
        let mut key = Key::root();
        for (depth, word) in place.iter().enumerate() {
            let is_array = matches!(self.node(&place[..depth]), Some(Node { value: Value::Array(_), .. }));
            key = match word.parse() {
                Ok(index) if is_array => key.index(index),
                _ => key.key(word),
            };
        }
        key
    }
}

/// The fix for a word that is not among the known ones: the nearest, or all of them if they are few; `what` says what
/// they are.
pub fn fix<'a>(word: &str, known: impl IntoIterator<Item = &'a str> + Clone, what: &str) -> String {
    suggest::fix(word, known, what)
}
