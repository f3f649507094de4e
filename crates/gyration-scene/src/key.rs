//! Dotted keys: how a place in a scene is addressed, `body.die.velocity`, `contact.0.friction.beta`.
//!
//! An item of an array is addressed by its `name`, if it has one, else by its index from zero.

use crate::tree::{Entry, Node, Span, Value};

/// A place in a scene: keys and indices from the root.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Key(Vec<Segment>);

/// One step from a table or an array to what it holds.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Segment {
    Name(String),
    Index(usize),
}

impl Key {
    /// The root of the scene.
    pub(crate) fn root() -> Self {
        Self::default()
    }

    /// The place of a key of the table that stands here.
    pub(crate) fn key(&self, name: &str) -> Self {
        self.with(Segment::Name(name.to_owned()))
    }

    /// The place of an item of the array that stands here.
    pub(crate) fn index(&self, index: usize) -> Self {
        self.with(Segment::Index(index))
    }

    fn with(&self, segment: Segment) -> Self {
        let mut segments = self.0.clone();
        segments.push(segment);
        Self(segments)
    }

    /// Whether this is an item of the array of this name at the root.
    pub(crate) fn is_item_of(&self, array: &str) -> bool {
        matches!(&self.0[..], [Segment::Name(name), Segment::Index(_)] if name == array)
    }

    /// The key at the root under which this is.
    pub(crate) fn section(&self) -> Option<&str> {
        match self.0.first()? {
            Segment::Name(name) => Some(name),
            Segment::Index(_) => None,
        }
    }

    /// Whether the other place is this one or lies inside of it.
    pub(crate) fn holds(&self, other: &Self) -> bool {
        other.0.starts_with(&self.0)
    }

    /// The names in it, without the indices.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().filter_map(|segment| match segment {
            Segment::Name(name) => Some(name.as_str()),
            Segment::Index(_) => None,
        })
    }

    /// The dotted form, with items of arrays by name where they have one.
    pub(crate) fn dotted(&self, root: &Node) -> String {
        let mut words: Vec<String> = Vec::with_capacity(self.0.len());
        let mut at = Some(root);
        for segment in &self.0 {
            let next = at.and_then(|node| step(node, segment));
            words.push(match segment {
                Segment::Name(name) => name.clone(),
                Segment::Index(index) => next.and_then(name_of).map_or_else(|| index.to_string(), str::to_owned),
            });
            at = next;
        }
        words.join(".")
    }

    /// Where the value at this place is written; if there is none, where the nearest table or array around it is.
    pub(crate) fn span(&self, root: &Node) -> Span {
        let mut at = root;
        for segment in &self.0 {
            match step(at, segment) {
                Some(next) => at = next,
                None => break,
            }
        }
        at.span
    }

    /// What the scene has at this place.
    pub(crate) fn find<'a>(&self, root: &'a Node) -> Option<&'a Node> {
        self.0.iter().try_fold(root, step)
    }

    /// Whether the scene has something at this place.
    pub(crate) fn is_written(&self, root: &Node) -> bool {
        self.find(root).is_some()
    }
}

fn step<'a>(node: &'a Node, segment: &Segment) -> Option<&'a Node> {
    match (segment, &node.value) {
        (Segment::Name(name), Value::Table(table)) => table.get(name).map(|Entry { node, .. }| node),
        (Segment::Index(index), Value::Array(items)) => items.get(*index),
        _ => None,
    }
}

/// The name of an item of an array, if it can be used in a dotted key.
pub(crate) fn name_of(item: &Node) -> Option<&str> {
    item.get("name").and_then(Node::text).filter(|name| is_name(name))
}

/// The body of which this would be the name of a copy, and its number.
pub(crate) fn split_copy(name: &str) -> Option<(&str, usize)> {
    let (of, number) = name.rsplit_once('-')?;
    let number = number.parse().ok().filter(|parsed: &usize| parsed.to_string() == number)?;
    Some((of, number))
}

/// Whether a text matches `[A-Za-z0-9_-]+`.
pub(crate) fn is_name(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-')
}
