//! Classes of bodies, by which they are coloured: each a class of its own as long as there are few; of more, those of a
//! group are a class, or where the scene names no group, those of a sort.
//!
//! Group and sort are taken from the scene as it was resolved: the first word of `group`, the kind and the word of the
//! shape. Copies of a body, and those of a lattice, are described by it, and copies are a group. The viewer's page has
//! the same classes (`viewer/src/data/classes.ts`).

use serde_json::Value;
use std::collections::HashMap;

/// Bodies of which each has a colour of its own.
pub const MOST_ALONE: usize = 7;
/// Bodies without a group, where others have one.
const WITHOUT_GROUP: &str = "without a group";

/// Classes of bodies.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodyClasses {
    /// Names of the classes, in the order of their first bodies.
    pub names: Vec<String>,
    /// The class of each body.
    pub of_body: Vec<usize>,
}

impl BodyClasses {
    /// Of bodies by name and kind, and the resolved scene.
    pub fn of<'a>(bodies: impl ExactSizeIterator<Item = (&'a str, &'a str)> + Clone, resolved: &Value) -> Self {
        if bodies.len() <= MOST_ALONE {
            return Self {
                names: bodies.clone().map(|(name, _)| name.to_owned()).collect(),
                of_body: (0..bodies.len()).collect(),
            };
        }
        let described = resolved["body"].as_array().map_or(&[][..], Vec::as_slice);
        let by_name: HashMap<&str, &Value> =
            described.iter().filter_map(|body| Some((body["name"].as_str()?, body))).collect();
        let described = |name: &str| {
            let of_copy =
                || by_name.get(name.trim_end_matches(|digit: char| digit.is_ascii_digit()).strip_suffix('-')?);
            by_name.get(name).or_else(of_copy).copied()
        };
        let groups: Vec<Option<&str>> = bodies.clone().map(|(name, _)| group(described(name)?)).collect();
        let is_grouped = groups.iter().any(Option::is_some);
        let words = bodies.zip(&groups).map(|((name, kind), group)| match group {
            Some(group) => (*group).to_owned(),
            None if is_grouped => WITHOUT_GROUP.to_owned(),
            None => sort(kind, described(name)),
        });
        let mut classes = Self::default();
        let mut known = HashMap::new();
        for word in words {
            let class = *known.entry(word.clone()).or_insert(classes.names.len());
            if class == classes.names.len() {
                classes.names.push(word);
            }
            classes.of_body.push(class);
        }
        classes
    }

    /// Whether each body is a class of its own.
    pub fn are_bodies(&self) -> bool {
        self.of_body.len() <= MOST_ALONE
    }

    /// How many bodies are of a class.
    pub fn count(&self, class: usize) -> usize {
        self.of_body.iter().filter(|of| **of == class).count()
    }

    /// A class in a legend: its name, and how many of so many bodies are of it.
    pub fn label(&self, class: usize) -> String {
        let name = &self.names[class];
        if self.are_bodies() { name.clone() } else { format!("{name} ({})", self.count(class)) }
    }
}

/// The first word of a body's group; its name, if it has copies and no other.
fn group(body: &Value) -> Option<&str> {
    let group = &body["group"];
    let of_copies = || body.get("copies").and_then(|_| body["name"].as_str());
    group.as_str().or_else(|| group.get(0)?.as_str()).or_else(of_copies)
}

/// Kind and shape in words.
fn sort(kind: &str, body: Option<&Value>) -> String {
    let shape = body.and_then(|body| body["shape"].as_object()?.keys().next());
    shape.map_or_else(|| format!("{kind} bodies"), |shape| format!("{kind}, {}", shape.replace('_', " ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn classes(count: usize, describe: impl Fn(usize) -> Value) -> BodyClasses {
        let names: Vec<String> = (0..count).map(|k| format!("b{k}")).collect();
        let bodies = names.iter().enumerate().map(|(k, name)| {
            let mut body = describe(k);
            body["name"] = json!(name);
            body
        });
        let resolved = json!({ "body": bodies.collect::<Vec<_>>() });
        BodyClasses::of(names.iter().map(|name| (name.as_str(), "rigid")), &resolved)
    }

    #[test]
    fn few_bodies_are_classes_of_their_own() {
        let few = classes(MOST_ALONE, |_| json!({ "group": "grains" }));
        assert_eq!((few.names.len(), few.label(6)), (MOST_ALONE, "b6".to_owned()));
    }

    #[test]
    fn many_bodies_are_classed_by_group_else_by_sort() {
        let grouped = classes(9, |k| match k {
            0 => json!({}),
            k if k % 2 == 0 => json!({ "group": "grains" }),
            _ => json!({ "group": ["steel", "grains"] }),
        });
        assert_eq!(grouped.names, ["without a group", "steel", "grains"]);
        assert_eq!([0, 1, 2].map(|class| grouped.count(class)), [1, 4, 4]);
        assert_eq!(grouped.label(1), "steel (4)");
        let sorted = classes(8, |k| if k < 3 { json!({ "shape": { "sphere": {} } }) } else { json!({}) });
        assert_eq!(sorted.names, ["rigid, sphere", "rigid bodies"]);
    }

    #[test]
    fn copies_are_a_class() {
        let resolved = json!({ "body": [
            { "name": "a", "copies": { "grid": {} } },
            { "name": "b", "copies": { "grid": {} }, "group": "steel" },
        ] });
        let names: Vec<String> = (0..12).map(|k| format!("{}-{}", ["a", "b"][k % 2], k / 2)).collect();
        let classes = BodyClasses::of(names.iter().map(|name| (name.as_str(), "rigid")), &resolved);
        assert_eq!(classes.names, ["a", "steel"]);
    }
}
