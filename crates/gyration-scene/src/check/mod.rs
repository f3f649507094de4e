//! The checks of a scene: first what its structure must be, then what its values must be, all that is wrong together.
//!
//! `structure` walks the tree along `rule`, which is the JSON Schema of the file's types in a form that is quick to
//! walk. Each section, support, contact and body that passes is deserialized into a [`PartialScene`] and goes on to
//! `values` and to `assemble`, so that a misspelt key in one body does not hide a missing support of another.

mod partial;
mod rule;
mod structure;
mod values;

pub(crate) use partial::{PartialScene, Placed};
pub(crate) use rule::{RULES, Rules};
pub(crate) use structure::structure;
pub(crate) use values::{direction, values};

use crate::document::{Diagnostics, Document};
use crate::key::Key;

/// Reports diagnostics by the keys of a document.
pub(crate) struct Reporter<'a> {
    pub(crate) document: &'a Document,
    pub(crate) diagnostics: &'a mut Diagnostics,
}

impl Reporter<'_> {
    /// Notes what is wrong at a key, or around it if it is absent, and what to do.
    pub(crate) fn note(&mut self, key: &Key, message: impl Into<String>, help: impl Into<String>) {
        self.diagnostics.at(key.span(&self.document.root), key, message, help);
    }
}
