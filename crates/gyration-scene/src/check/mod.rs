//! The checks of a scene: first what its structure must be, then what its values must be, all findings together.
//!
//! `structure` walks the tree along `rule`, which is the JSON Schema of the file's types in a form that is quick to
//! walk. Each section, support, contact and body that passes is deserialized into a [`Draft`] and goes on to `values`
//! and to `assemble`, so that a misspelt key in one body does not hide a missing support of another.

mod draft;
mod rule;
mod structure;
mod values;

pub(crate) use draft::{Draft, Placed};
pub(crate) use rule::{RULES, Rules};
pub(crate) use structure::structure;
pub(crate) use values::{direction, values};

use crate::document::{Document, Findings};
use crate::key::Key;

/// Notes findings by the keys of a document.
pub(crate) struct Judge<'a> {
    pub(crate) document: &'a Document,
    pub(crate) findings: &'a mut Findings,
}

impl Judge<'_> {
    /// Notes what is wrong at a key, or around it if it is absent, and what to do.
    pub(crate) fn note(&mut self, key: &Key, message: impl Into<String>, help: impl Into<String>) {
        self.findings.at(key.span(&self.document.root), key, message, help);
    }
}
