//! The two of `between` in a section of the file, well formed or not.

use super::Reporter;
use crate::key::Key;
use crate::tree::Node;

/// One of the two that something stands between.
pub(super) struct End<'a> {
    /// What stands between them.
    pub item: &'a Node,
    /// What it is called.
    pub name: &'a str,
    /// What those before it are called.
    pub before: &'a [Option<&'a str>],
}

impl End<'_> {
    /// Whether the other has the same name.
    pub fn is_twice(&self) -> bool {
        self.before.contains(&Some(self.name))
    }
}

/// Notes what is wrong with the ends of a section, which is told with its fix.
pub(super) fn check_ends(
    section: &str,
    reporter: &mut Reporter<'_>,
    mut fault: impl FnMut(&End<'_>) -> Option<(String, String)>,
) {
    let document = reporter.document;
    let items = document.root.get(section).map(Node::items).unwrap_or_default();
    for (index, item) in items.iter().enumerate() {
        let key = Key::root().key(section).index(index).key("between");
        let ends = item.get("between").map(Node::items).unwrap_or_default();
        let names: Vec<Option<&str>> = ends.iter().map(Node::text).collect();
        for (end, (node, name)) in ends.iter().zip(&names).enumerate() {
            if reporter.diagnostics.is_full() {
                return;
            }
            let found = name.and_then(|name| fault(&End { item, name, before: &names[..end] }));
            if let Some((message, help)) = found {
                reporter.diagnostics.at(node.span, &key.index(end), message, help);
            }
        }
    }
}
