//! Words that are no keys where they stand: what is meant by them, or where else they are keys.

use super::rule::{FieldRule, Rule, Rules};
use crate::key::Key;
use std::collections::{BTreeMap, VecDeque};

/// Words that people write, the tables in which they do, and what to write there.
const MEANT: [(&[&str], &[&str], &str); 10] = [
    (&["spin", "omega"], &["body"], "`angular_velocity = [x, y, z]` says how it turns"),
    (&["point", "position", "center", "through"], &["plane"], "write `origin`, a point of the plane"),
    (&["diameter"], &["sphere", "cylinder", "cone", "capsule"], "write `radius`, half of it"),
    (
        &["thickness", "length", "depth"],
        &["cylinder", "cone", "capsule"],
        "write `height`, along the axis; of a capsule it is that of the cylinder between the caps",
    ),
    (
        &["friction", "friction_coefficient", "mu"],
        &["from"],
        "write `friction_angle`, the slope on which it begins to slide: mu = tan of it; and `sliding_speed`, far above \
            which it slides and below which it creeps",
    ),
    (
        &["damping", "friction", "stiffness"],
        &["joint"],
        "write `drive = { torque = \"-0.1*rate\" }`, of a slider `force`: it may depend on angle, rate and t",
    ),
    (&["motor", "servo", "torque", "actuator"], &["joint"], "write `drive = { torque = … }`, of a slider `force`"),
    (&["type"], &["joint"], "write `kind`: ball, hinge, slider, weld or distance"),
    (
        &["material"],
        &["body"],
        "what deforms has it: `affine = { material = \"rubber\" }`; a rigid body has its `density`, 8500 of brass, or \
            its `mass`",
    ),
    (
        &["stiffness", "young", "modulus"],
        &["contact"],
        "it is said of a layer: `from = { layer = { youngs_modulus = …, poissons_ratio = …, thickness = … } }`",
    ),
];

/// The same for all tables of these sections.
const MEANT_IN: [(&[&str], &[&str], &str); 5] = [
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
        &["dt", "timestep", "time_step", "step", "steps", "substeps", "fps"],
        &["", "time", "solver", "world"],
        "the solver chooses its steps: `[solver] rtol` says how accurate, `[time] sample` how often it is recorded",
    ),
];

/// What others call what one of several words says.
const CALLED: [(&[&str], &str); 5] = [
    (&["revolute", "continuous", "pin"], "hinge"),
    (&["prismatic", "linear"], "slider"),
    (&["fixed", "rigid"], "weld"),
    (&["spherical", "ball_and_socket"], "ball"),
    (&["rod", "strut"], "distance"),
];

/// How deep tables are looked into.
const DEPTH: usize = 6;

/// How many places of a word are told.
const LISTED: usize = 4;

/// What is meant by a word in the very table at this key: it goes before words that are written alike.
pub(super) fn meant(word: &str, key: &Key) -> Option<String> {
    among(&MEANT, word, key.names().last().unwrap_or_default())
}

/// What is meant by a word somewhere in the section of this key.
pub(super) fn meant_in(word: &str, key: &Key) -> Option<String> {
    among(&MEANT_IN, word, key.section().unwrap_or_default())
}

/// The word among these by which the format calls what others call so.
pub(super) fn called(word: &str, known: &[String]) -> Option<String> {
    let (_, name) = CALLED.iter().find(|(words, name)| words.contains(&word) && known.iter().any(|one| one == name))?;
    Some(format!("it is called \"{name}\" here"))
}

fn among(meant: &[(&[&str], &[&str], &str)], word: &str, place: &str) -> Option<String> {
    let is_here = |(words, places, _): &&(&[&str], &[&str], &str)| words.contains(&word) && places.contains(&place);
    meant.iter().find(is_here).map(|(.., help)| (*help).to_owned())
}

/// The tables of the same section of which a word is a key: those nearest to the table at this key, within it or within
/// what it stands in, least deep.
pub(super) fn elsewhere(word: &str, key: &Key, rules: &Rules) -> Option<String> {
    let names: Vec<&str> = key.names().collect();
    let mut around = Vec::with_capacity(names.len());
    let mut at = &rules.root;
    for name in &names {
        let Some(inner) = rules.fields(at).and_then(|fields| fields.get(*name)) else { break };
        around.push(inner);
        at = inner;
    }
    let (depth, found) = around.iter().enumerate().rev().find_map(|(depth, table)| {
        let found = within(word, table, rules);
        (!found.is_empty()).then_some((depth, found))
    })?;
    let place = |path: &Vec<&str>| format!("`{}`", [&names[..=depth], path, &[word]].concat().join("."));
    let places: Vec<String> = found.iter().map(place).collect();
    Some(format!("its place is {}", places.join(", ")))
}

/// The ways from a table to those of which a word is a key, itself included, least deep.
fn within<'a>(word: &str, table: &'a FieldRule, rules: &'a Rules) -> Vec<Vec<&'a str>> {
    let mut found: Vec<Vec<&str>> = Vec::new();
    let mut open = VecDeque::from([(Vec::new(), table)]);
    while let Some((path, field)) = open.pop_front() {
        let is_deeper = found.first().is_some_and(|first| path.len() > first.len());
        if is_deeper || found.len() == LISTED {
            break;
        }
        let Some(fields) = rules.fields(field) else { continue };
        if fields.contains_key(word) {
            found.push(path);
        } else if path.len() < DEPTH {
            open.extend(fields.iter().map(|(name, field)| ([path.as_slice(), &[name.as_str()]].concat(), field)));
        }
    }
    found
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
