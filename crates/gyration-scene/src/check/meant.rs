//! Words that are no keys where they stand: what is meant by them, or where else they are keys.

use super::rule::{FieldRule, Rule, Rules};
use crate::key::Key;
use std::collections::{BTreeMap, VecDeque};

/// Words that people write, the sections in which they do, and what to write there.
const MEANT: [(&[&str], &[&str], &str); 6] = [
    (
        &["rotation", "angle", "angles", "attitude"],
        &["body", "support"],
        "`orientation` says how it stands; `angular_velocity`, of a support `motion = { rotate = … }`, how it turns",
    ),
    (
        &["thickness", "width", "depth"],
        &["body", "support"],
        "a box has `size = [x, y, z]`, a plate is a box with a small side",
    ),
    (
        &["young", "youngs_modulus", "modulus", "elastic_modulus", "E", "stiffness", "poisson", "poissons_ratio"],
        &["body"],
        "it is of a material: `affine = { material = { neo_hookean = { youngs_modulus = …, poissons_ratio = … } } }`",
    ),
    (
        &["restitution", "bounciness", "friction", "mu", "repulsion", "damping", "adhesion"],
        &["body", "support"],
        "what two do to each other stands in a `[[contact]]`: `from = { rest_gap = …, restitution = …, at_speed = … }`",
    ),
    (
        &["stiffness", "young", "modulus"],
        &["contact"],
        "it is said of a layer: `from = { layer = { youngs_modulus = …, poissons_ratio = …, thickness = … } }`",
    ),
    (
        &["dt", "timestep", "time_step", "step", "steps", "substeps", "fps"],
        &["", "time", "solver", "world"],
        "the solver chooses its steps: `[solver] rtol` says how accurate, `[time] sample` how often it is recorded",
    ),
];

/// How deep tables are looked into.
const DEPTH: usize = 6;

/// How many places of a word are told.
const LISTED: usize = 4;

/// What is meant by a word in the table at this key.
pub(super) fn meant(word: &str, key: &Key) -> Option<String> {
    let section = key.section().unwrap_or_default();
    let is_here =
        |(words, sections, _): &&(&[&str], &[&str], &str)| words.contains(&word) && sections.contains(&section);
    MEANT.iter().find(is_here).map(|(.., help)| (*help).to_owned())
}

/// The tables of the same section, least deep, of which a word is a key.
pub(super) fn elsewhere(word: &str, key: &Key, rules: &Rules) -> Option<String> {
    let section = key.section()?;
    let mut found: Vec<Vec<String>> = Vec::new();
    let mut open = VecDeque::from([(vec![section.to_owned()], rules.fields(&rules.root)?.get(section)?)]);
    while let Some((path, field)) = open.pop_front() {
        let is_deeper = found.first().is_some_and(|first| path.len() > first.len());
        if is_deeper || found.len() == LISTED {
            break;
        }
        let Some(fields) = rules.fields(field) else { continue };
        if fields.contains_key(word) && path.len() > 1 {
            found.push(path);
        } else if path.len() < DEPTH {
            let inner =
                fields.iter().map(|(name, field)| ([path.as_slice(), std::slice::from_ref(name)].concat(), field));
            open.extend(inner);
        }
    }
    let places: Vec<String> = found.iter().map(|path| format!("`{}.{word}`", path.join("."))).collect();
    (!places.is_empty()).then(|| format!("its place is {}", places.join(", ")))
}

impl Rules {
    /// The keys of a table, or of the items of an array of tables.
    fn fields<'a>(&'a self, field: &'a FieldRule) -> Option<&'a BTreeMap<String, FieldRule>> {
        match self.resolve(&field.rule) {
            Rule::Table { fields, .. } | Rule::Choice { tags: fields, .. } => Some(fields),
            Rule::Array { item, .. } | Rule::Several(item) => self.fields(item),
            Rule::Either(_, table) => self.fields(table),
            _ => None,
        }
    }
}
