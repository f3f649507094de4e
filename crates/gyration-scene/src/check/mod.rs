//! The checks of a scene: first what its structure must be, then what its values must be, all that is wrong together.
//!
//! `structure` walks the tree along `rule`, which is the JSON Schema of the file's types in a form that is quick to
//! walk. Each section, support, contact and body that passes is deserialized into a [`PartialScene`] and goes on to
//! `values` and to `assemble`, so that a misspelt key in one body does not hide a missing support of another.

mod copies;
mod ends;
mod fixed;
mod joints;
mod meant;
mod named;
mod partial;
mod placed;
mod rule;
mod signal_help;
mod structure;
mod values;

pub(crate) use copies::{Copies, CopyNames};
pub(crate) use joints::SPACE;
pub(crate) use partial::PartialScene;
pub(crate) use placed::Placed;
pub(crate) use rule::{RULES, Rules};
pub(crate) use structure::structure;
pub(crate) use values::{direction, values};

use crate::document::{Diagnostics, Document};
use crate::file_sum::FileSum;
use crate::key::Key;

/// Reports diagnostics, and files that were read, by the keys of a document.
pub(crate) struct Reporter<'a> {
    pub(crate) document: &'a Document,
    pub(crate) diagnostics: &'a mut Diagnostics,
    /// The copy of a body that is at fault, of which a message begins to tell.
    copy: Option<(&'a str, usize)>,
}

impl<'a> Reporter<'a> {
    pub(crate) fn new(document: &'a Document, diagnostics: &'a mut Diagnostics) -> Self {
        Self { document, diagnostics, copy: None }
    }

    /// The same for a copy of a body.
    pub(crate) fn of_copy<'b>(&'b mut self, body: &'b str, number: usize) -> Reporter<'b> {
        Reporter { document: self.document, diagnostics: self.diagnostics, copy: Some((body, number)) }
    }

    fn told(&self, message: impl Into<String>) -> String {
        let message = message.into();
        self.copy.map_or(message.clone(), |(body, number)| format!("the copy \"{body}-{number}\": {message}"))
    }

    /// Notes what is wrong at a key, or around it if it is absent, and what to do.
    pub(crate) fn note(&mut self, key: &Key, message: impl Into<String>, help: impl Into<String>) {
        self.diagnostics.at(key.span(&self.document.root), key, self.told(message), help);
    }

    /// The same at a column, counted in characters from 1, of the text that stands at the key.
    pub(crate) fn note_within(
        &mut self,
        key: &Key,
        (text, column): (&str, usize),
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        let mut span = key.span(&self.document.root);
        let written = self.document.texts.get(span.text).and_then(|named| named.content.get(span.start..span.end));
        // A text with escapes is marked as a whole.
        if let Some(from) = written.and_then(|written| written.find(text)).filter(|_| !text.is_empty()) {
            let (before, rest) = match text.char_indices().nth(column.saturating_sub(1)) {
                Some((at, letter)) => (at, letter.len_utf8()),
                None => (text.len(), 1),
            };
            span.start += from + before;
            span.end = span.start + rest;
        }
        self.diagnostics.at(span, key, self.told(message), help);
    }

    /// Keeps the checksum of a file that the scene names at a key.
    pub(crate) fn read(&mut self, key: &Key, file: &str, sum: String) {
        let key = key.dotted(&self.document.root);
        self.diagnostics.add_file(FileSum { key, file: file.to_owned(), sum });
    }
}
