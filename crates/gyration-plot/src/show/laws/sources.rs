//! The different laws of a model, and the names of who has them: a support, two bodies, or two groups of bodies.

use gyration::contact::{Contact, ContactLaw};
use gyration::model::Model;
use serde_json::Value;
use std::collections::BTreeMap;

/// Pairs by which two groups are recognized.
const MOST_PAIRS: usize = 2000;
/// Words of groups that are tried.
const MOST_WORDS: usize = 24;

/// Laws that act between somebody.
#[derive(Debug, Clone, PartialEq)]
pub struct LawSource<'a> {
    /// Who has them.
    pub name: String,
    /// The laws.
    pub laws: &'a [ContactLaw],
    /// Whether no support is among those that have them.
    pub is_between_bodies: bool,
}

impl<'a> LawSource<'a> {
    /// The different laws of a model, each once.
    pub fn all(model: &'a Model, resolved: &Value) -> Vec<Self> {
        let mut contacts: Vec<&Contact> = Vec::new();
        for contact in (0..model.bodies.len()).flat_map(|body| model.contacts_of(body)) {
            let is_same = |known: &&Contact| (known.support, &known.law_set) == (contact.support, &contact.law_set);
            if !contacts.iter().any(is_same) {
                contacts.push(contact);
            }
        }
        let of_support = contacts.into_iter().map(|contact| Self {
            name: model.supports[contact.support].name.clone(),
            laws: contact.law_set.laws(),
            is_between_bodies: false,
        });
        let groups = Groups::of(model, resolved);
        let of_pairs = model.rules().all().iter().map(|rule| Self {
            name: match &rule.supports[..] {
                [] => groups.name(model, rule.count(), rule.pairs()),
                supports => names_of(model, supports),
            },
            laws: rule.laws.laws(),
            is_between_bodies: true,
        });
        of_support.chain(of_pairs).collect()
    }
}

/// The names of supports with a shape.
fn names_of(model: &Model, supports: &[usize]) -> String {
    let names: Vec<&str> = supports.iter().map(|support| model.solid_supports[*support].name.as_str()).collect();
    names.join(", ")
}

/// The bodies of each word by which contacts name many.
#[derive(Debug, Clone, Default)]
pub struct Groups(BTreeMap<String, Vec<bool>>);

impl Groups {
    /// Of the bodies of a model, by the resolved scene.
    pub fn of(model: &Model, resolved: &Value) -> Self {
        let mut groups: BTreeMap<String, Vec<bool>> = BTreeMap::new();
        let count = model.bodies.len();
        for described in resolved["body"].as_array().into_iter().flatten() {
            let Some(index) = model.names().position(|name| described["name"] == name) else {
                continue;
            };
            let group = &described["group"];
            let words = group.as_array().map_or(std::slice::from_ref(group), Vec::as_slice);
            for word in words.iter().filter_map(Value::as_str) {
                groups.entry(word.to_owned()).or_insert_with(|| vec![false; count])[index] = true;
            }
        }
        Self(groups)
    }

    /// Who is in so many pairs of bodies: the two of a single one, two groups that hold all of them, or the first two
    /// and how many pairs besides.
    pub fn name(&self, model: &Model, count: usize, pairs: impl Iterator<Item = [usize; 2]>) -> String {
        let pairs: Vec<[usize; 2]> = pairs.take(MOST_PAIRS).collect();
        let Some(first) = pairs.first() else { return String::new() };
        let [one, other] = first.map(|body| model.name(body));
        let more = count.saturating_sub(1);
        match self.holding(&pairs).filter(|_| more > 0) {
            _ if more == 0 => format!("{one} – {other}"),
            Some((first, second)) => format!("{first} – {second}"),
            None => format!("{one} – {other}, {more} more {}", if more == 1 { "pair" } else { "pairs" }),
        }
    }

    /// Two groups of which each pair has a body each.
    fn holding(&self, pairs: &[[usize; 2]]) -> Option<(&str, &str)> {
        let words: Vec<_> = self.0.iter().take(MOST_WORDS).collect();
        let holds = |first: &[bool], second: &[bool]| {
            pairs.iter().all(|[one, other]| (first[*one] && second[*other]) || (first[*other] && second[*one]))
        };
        let mut all =
            words.iter().enumerate().flat_map(|(k, first)| words[k..].iter().map(move |second| (first, second)));
        let (first, second) = all.find(|((_, first), (_, second))| holds(first, second))?;
        Some((first.0.as_str(), second.0.as_str()))
    }
}
