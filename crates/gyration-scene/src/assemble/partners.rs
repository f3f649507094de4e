//! Who meets whom: the bodies and the support that the words of a contact name.

use super::body::AssembledBody;
use crate::check::{CopyNames, PartialScene, Reporter};
use crate::file::Contact;
use crate::key::Key;
use std::collections::{HashMap, HashSet};

/// Supports and groups by name.
pub(super) struct Names<'a> {
    supports: HashMap<&'a str, usize>,
    /// The bodies of a group, well formed or not, ascending; a body's own name is a group of one.
    groups: HashMap<&'a str, Vec<usize>>,
    /// The names of bodies, well formed or not.
    bodies: HashSet<&'a str>,
    copies: &'a CopyNames,
    /// Whether name and groups of every body are written as they must be.
    are_known: bool,
}

/// What a contact is between.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Partners {
    /// A support and bodies; `named` if they were named one by one, and so must be able to meet it.
    Support { support: usize, bodies: Vec<usize>, named: bool },
    /// Any two different bodies of these sets.
    Bodies([Vec<usize>; 2]),
    /// Two supports.
    Supports,
}

impl<'a> Names<'a> {
    /// Those of a scene.
    pub fn of(partial: &'a PartialScene) -> Self {
        let supports = partial.supports.iter().enumerate();
        let supports = supports.map(|(index, support)| (support.value.name.as_str(), index)).collect();
        let mut groups: HashMap<&str, Vec<usize>> = HashMap::new();
        for (index, body) in partial.roll.iter().enumerate() {
            for word in &body.words {
                let group = groups.entry(word).or_default();
                let bodies = partial.numbers.range(index);
                if group.last().is_none_or(|last| *last < bodies.start) {
                    group.extend(bodies);
                }
            }
        }
        let are_known = partial.roll.iter().all(|body| body.are_known);
        let bodies = partial.bodies.iter().map(|body| body.value.name.as_str()).collect();
        Self { supports, groups, bodies, copies: &partial.copy_names, are_known }
    }

    /// Whether it is known of every body which groups it is in.
    pub fn are_known(&self) -> bool {
        self.are_known
    }

    /// Whether a word names a group, and no body of that name.
    pub fn is_group(&self, word: &str) -> bool {
        self.groups.contains_key(word) && (!self.bodies.contains(word) || self.copies.has(word))
    }

    /// The bodies that a word names; none if it names none.
    pub fn group(&self, name: &str) -> Option<Vec<usize>> {
        self.groups.get(name).cloned().or_else(|| Some(vec![self.copies.find(name)?]))
    }

    /// The partners of a contact among so many bodies; none where a name is not known, which has been noted.
    pub fn partners(&self, contact: &Contact, count: usize) -> Option<Partners> {
        let Some([one, other]) = &contact.between else {
            let support = *self.supports.get(contact.support.as_deref()?)?;
            let (bodies, named) = match &contact.body {
                Some(name) => (self.group(name)?, true),
                None => ((0..count).collect(), false),
            };
            return Some(Partners::Support { support, bodies, named });
        };
        let support = |name: &String| self.supports.get(name.as_str()).copied();
        let group = |name: &String| self.group(name);
        match (group(one), group(other)) {
            (Some(one), Some(other)) => Some(Partners::Bodies([one, other])),
            (Some(bodies), None) => Some(Partners::Support { support: support(other)?, bodies, named: true }),
            (None, Some(bodies)) => Some(Partners::Support { support: support(one)?, bodies, named: true }),
            (None, None) => support(one).and(support(other)).map(|_| Partners::Supports),
        }
    }
}

/// Notes a body that cannot meet anything.
pub(super) fn without_surface(assembled: &AssembledBody, key: &Key, reporter: &mut Reporter<'_>) {
    let message = format!("\"{}\" has no surface", assembled.name);
    reporter.note(key, message, "name a body whose shape has a surface");
}
