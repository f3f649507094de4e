//! The names of what a section of the file has, well formed or not.

use super::copies::{Copies, CopyNames};
use super::{PartialScene, Reporter};
use crate::key::{Key, is_name};
use crate::tree::Node;
use std::collections::BTreeSet;

/// The names of an array of tables, well formed or not.
pub(super) struct Named {
    pub(super) names: BTreeSet<String>,
    /// Whether each of them has one: a name that cannot be read may be any.
    pub(super) are_known: bool,
    /// Those of copies.
    copies: CopyNames,
}

impl Named {
    /// Those of a section; notes those that are no names or occur twice.
    pub(super) fn of(section: &str, reporter: &mut Reporter<'_>) -> Self {
        let key = Key::root().key(section);
        let document = reporter.document;
        let items = document.root.get(section).map(Node::items).unwrap_or_default();
        let mut named = Self { names: BTreeSet::new(), are_known: true, copies: CopyNames::default() };
        for (index, item) in items.iter().enumerate() {
            let Some((node, name)) = item.get("name").and_then(|node| Some((node, node.text()?))) else {
                named.are_known = false;
                continue;
            };
            let place = key.index(index).key("name");
            let is_new = named.names.insert(name.to_owned());
            if !is_name(name) {
                let help = "use letters A to Z and a to z, digits, `_` and `-`";
                reporter.diagnostics.at(node.span, &place, format!("\"{name}\" is not a name"), help);
            } else if !is_new {
                let message = format!("the {section} \"{name}\" occurs twice");
                reporter.diagnostics.at(node.span, &place, message, "give each a name of its own");
            }
        }
        named
    }

    /// Those of the bodies of a scene, with their copies; notes a body that is called as a copy of another is.
    pub(super) fn of_bodies(partial: &PartialScene, reporter: &mut Reporter<'_>) -> Self {
        let mut named = Self::of("body", reporter);
        named.copies = partial.copy_names.clone();
        named.are_known &= !partial.copies.contains(&Copies::Unknown);
        for body in partial.bodies.iter().filter(|body| named.copies.find(&body.value.name).is_some()) {
            let name = &body.value.name;
            let message = format!("\"{name}\" is the name of a copy of another body");
            reporter.note(&body.key.key("name"), message, "give each a name of its own");
        }
        named
    }

    /// Whether one has this name.
    pub(super) fn has(&self, name: &str) -> bool {
        self.names.contains(name) || self.copies.find(name).is_some()
    }

    /// Whether nothing has this name.
    pub(super) fn lacks(&self, name: &str) -> bool {
        self.are_known && !self.has(name)
    }

    /// What is wrong with a name that must be of one, and the fix, where it is of all copies of a body.
    pub(super) fn many(&self, name: &str) -> Option<(String, String)> {
        let last = self.copies.count(name)? - 1;
        let message = format!("\"{name}\" is the group of the copies \"{name}-0\" to \"{name}-{last}\"");
        Some((message, format!("name one of them, \"{name}-0\"")))
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &str> + Clone {
        self.names.iter().map(String::as_str)
    }
}
