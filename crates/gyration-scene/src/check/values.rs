//! What the structure cannot say about supports, contacts, springs between bodies and times: names, references,
//! directions, counts.
//!
//! Bodies are checked where they are built, but for directions of motions.

use super::ends::check_ends;
use super::joints;
use super::named::Named;
use super::partial::BodyWords;
use super::{PartialScene, Placed, Reporter};
use crate::file::{Contact, Motion, OneOrMany, Record, Support, Time};
use crate::key::{Key, is_name};
use crate::suggest;
use crate::tree::{Node, Value};
use gyration::tensor::Vec3;
use std::collections::{BTreeSet, HashSet};

/// The most samples of a recording.
const MOST_SAMPLES: f64 = 1e8;

/// Notes what is wrong with the values of a partial scene, its bodies apart.
pub(crate) fn values(partial: &PartialScene, reporter: &mut Reporter<'_>) {
    let (supports, bodies) = (Named::of("support", reporter), Named::of_bodies(partial, reporter));
    if let Some(time) = &partial.time {
        samples(time, reporter);
    }
    if let Some(record) = &partial.record {
        once(record, reporter);
    }
    partial.supports.iter().for_each(|support| directions(support, reporter));
    for body in &partial.bodies {
        for (index, spring) in body.value.spring.iter().enumerate() {
            let key = body.key.key("spring").index(index).key("anchor_motion");
            motion_directions(spring.anchor_motion.as_ref(), &key, reporter);
        }
    }
    references("support", &supports, reporter);
    references("body", &bodies, reporter);
    let groups: BTreeSet<&str> = partial.roll.iter().flat_map(|body| &body.words).map(String::as_str).collect();
    let are_known = partial.roll.iter().all(|body| body.are_known);
    ends("spring", &bodies, (&groups, are_known), reporter);
    ends("bond", &bodies, (&BTreeSet::new(), true), reporter);
    Named::of("joint", reporter);
    joints::ends(&supports, &bodies, reporter);
    partners(&supports, &bodies, &partial.roll, reporter);
    partial.contacts.iter().for_each(|contact| exponents(contact, reporter));
}

/// Notes the contacts, well formed or not, that name a support or a body that is not there.
fn references(section: &str, known: &Named, reporter: &mut Reporter<'_>) {
    let contacts = Key::root().key("contact");
    let document = reporter.document;
    let items = document.root.get("contact").map(Node::items).unwrap_or_default();
    for (index, item) in items.iter().enumerate() {
        let Some(node) = item.get(section) else { continue };
        if reporter.diagnostics.is_full() {
            return;
        }
        if let Some(name) = node.text().filter(|name| known.lacks(name)) {
            let help = suggest::fix(name, known.iter(), section);
            let message = format!("there is no {section} \"{name}\"");
            reporter.diagnostics.at(node.span, &contacts.index(index).key(section), message, help);
        }
    }
}

/// Notes the springs or bonds between bodies that name a body that is not there or one body twice; springs may name
/// groups, if it is known which there are.
fn ends(section: &str, known: &Named, (groups, are_known): (&BTreeSet<&str>, bool), reporter: &mut Reporter<'_>) {
    check_ends(section, reporter, |end| {
        let name = end.name;
        let is_group = known.many(name).is_some() || !known.has(name);
        if is_group && groups.contains(name) {
            None
        } else if known.lacks(name) && are_known {
            let what = if groups.is_empty() { "body" } else { "body or group" };
            let names = known.iter().chain(groups.iter().copied().filter(|group| !known.has(group)));
            Some((format!("there is no {what} \"{name}\""), suggest::fix(name, names, "one of")))
        } else if let Some(fault) = known.many(name) {
            Some(fault)
        } else if end.is_twice() && !leads_away(end.item) {
            let help = "name two different bodies, or in a lattice the `cell` of the second; to a point of space \
                        leads a `spring` of the body";
            Some((format!("both ends are at the body \"{name}\""), help.to_owned()))
        } else {
            None
        }
    });
}

/// Whether a spring leads to another cell.
fn leads_away(spring: &Node) -> bool {
    let numbers = spring.get("cell").map(Node::items).unwrap_or_default();
    numbers.iter().any(|node| !matches!(node.value, Value::Number(n) if n == 0.0))
}

/// Notes the contacts, well formed or not, that say neither or both of `support` and `between`, or name there what is
/// no body, group or support.
fn partners(supports: &Named, bodies: &Named, roll: &[BodyWords], reporter: &mut Reporter<'_>) {
    let document = reporter.document;
    let items = |section: &str| document.root.get(section).map(Node::items).unwrap_or_default();
    for (index, (body, words)) in items("body").iter().zip(roll).enumerate() {
        let own = body.get("name").and_then(Node::text);
        for word in words.words.iter().filter(|word| Some(word.as_str()) != own) {
            let Some(node) = body.get("group") else { continue };
            let key = Key::root().key("body").index(index).key("group");
            if !is_name(word) {
                let help = "use letters A to Z and a to z, digits, `_` and `-`";
                reporter.diagnostics.at(node.span, &key, format!("\"{word}\" is not a name"), help);
            } else if bodies.has(word) {
                let message = format!("\"{word}\" is the name of another body, which is a group of its own");
                reporter.diagnostics.at(node.span, &key, message, "give the group another name");
            }
        }
    }
    let moving: BTreeSet<&str> = roll.iter().flat_map(|body| &body.words).map(String::as_str).collect();
    let known: BTreeSet<&str> = supports.iter().chain(moving.iter().copied()).collect();
    let are_known = supports.are_known && roll.iter().all(|body| body.are_known);
    for (index, item) in items("contact").iter().enumerate() {
        if reporter.diagnostics.is_full() {
            return;
        }
        let key = Key::root().key("contact").index(index);
        let Some(between) = item.get("between") else {
            if item.get("support").is_none() {
                let help = "name a `support`, or two bodies, groups or supports `between` which it acts";
                reporter.diagnostics.at(item.span, &key.key("support"), "the key \"support\" is missing", help);
            }
            continue;
        };
        for short in ["support", "body"].into_iter().filter(|short| item.get(short).is_some()) {
            let help = format!("leave out `{short}`, or `between`");
            reporter.diagnostics.at(between.span, &key.key("between"), format!("it stands beside `{short}`"), help);
        }
        for (end, node) in between.items().iter().enumerate() {
            if let Some(name) =
                node.text().filter(|name| supports.has(name) && (moving.contains(*name) || bodies.has(name)))
            {
                let message = format!("\"{name}\" is a support, and a body or a group too");
                let help = "give the support another name";
                reporter.diagnostics.at(node.span, &key.key("between").index(end), message, help);
            }
            if let Some(name) = node.text().filter(|name| are_known && !known.contains(*name) && !bodies.has(name)) {
                let help = suggest::fix(name, known.iter().copied(), "one of");
                let message = format!("there is no body, group or support \"{name}\"");
                reporter.diagnostics.at(node.span, &key.key("between").index(end), message, help);
            }
        }
    }
}

fn samples(time: &Time, reporter: &mut Reporter<'_>) {
    let count = time.end.value() / time.sample.value();
    if count > MOST_SAMPLES {
        let message = format!("{count:.3e} samples are more than {MOST_SAMPLES:e}");
        let help = format!("write a spacing of at least {:e} s", time.end.value() / MOST_SAMPLES);
        reporter.note(&Key::root().key("time").key("sample"), message, help);
    }
}

/// Notes quantities that are asked for twice.
fn once(record: &Record, reporter: &mut Reporter<'_>) {
    let key = Key::root().key("record").key("quantities");
    let mut seen = HashSet::new();
    for (index, quantity) in record.quantities.iter().enumerate() {
        if !seen.insert(quantity) {
            reporter.note(&key.index(index), "the quantity is already recorded", "write each quantity once");
        }
    }
}

/// Notes what is wrong with the form and the directions of a support.
fn directions(support: &Placed<Support>, reporter: &mut Reporter<'_>) {
    let Placed { key, value, .. } = support;
    form(support, reporter);
    if value.plane.as_ref().is_some_and(|plane| direction(&plane.normal).is_none()) {
        reporter.note(&key.key("plane").key("normal"), "the normal is zero", "write a direction, [0, 0, 1]");
    }
    motion_directions(value.motion.as_ref(), &key.key("motion"), reporter);
}

/// Notes directions of a prescribed motion that are zero.
fn motion_directions(written: Option<&OneOrMany<Motion>>, key: &Key, reporter: &mut Reporter<'_>) {
    let motions = written.map(OneOrMany::as_slice).unwrap_or_default();
    for (index, motion) in motions.iter().enumerate() {
        let key = if matches!(written, Some(OneOrMany::Many(_))) { key.index(index) } else { key.clone() };
        let (place, what, written) = match motion {
            Motion::Velocity(_) => continue,
            Motion::Oscillate(oscillation) => {
                (key.key("oscillate").key("direction"), "direction", &oscillation.direction)
            }
            Motion::Rotate(rotation) => (key.key("rotate").key("axis"), "axis", &rotation.axis),
        };
        if direction(written).is_none() {
            reporter.note(&place, format!("the {what} is zero"), "write a direction, [0, 0, 1]");
        }
    }
}

/// Notes a support that is neither or both of a plane and a solid, and what a plane does not have.
fn form(support: &Placed<Support>, reporter: &mut Reporter<'_>) {
    let Placed { key, value, .. } = support;
    match (&value.plane, &value.shape) {
        (None, None) => {
            let help = "add `plane` or `shape`: a plane { origin = [x, y, z], normal = [x, y, z] }, or a solid";
            reporter.note(&key.key("plane"), "the key \"plane\", or \"shape\", is missing", help);
        }
        (Some(_), Some(_)) => {
            let help = "leave out one of them, or write two supports";
            reporter.note(&key.key("shape"), "it stands beside a plane", help);
        }
        (None, Some(_)) => {}
        (Some(_), None) => {
            for word in [value.position.as_ref().map(|_| "position"), value.orientation.as_ref().map(|_| "orientation")]
            {
                let Some(word) = word else { continue };
                let help = "write origin and normal of the plane, or give the support a `shape`";
                reporter.note(&key.key(word), "a plane has none", help);
            }
        }
    }
}

fn exponents(contact: &Placed<Contact>, reporter: &mut Reporter<'_>) {
    if let Some(adhesion) = &contact.value.adhesion {
        let (attractive, repulsive) = (adhesion.nu_attractive.0, adhesion.nu_repulsive.0);
        if repulsive <= attractive {
            let message = format!("{repulsive:?} is not greater than nu_attractive, which is {attractive:?}");
            let key = contact.key.key("adhesion").key("nu_repulsive");
            reporter.note(&key, message, "adhesion repels below d0 only if nu_repulsive > nu_attractive");
        }
    }
}

/// The unit vector along a vector of any finite length but zero.
pub(crate) fn direction(vector: &[f64; 3]) -> Option<Vec3> {
    let vector = Vec3::from(*vector);
    // The largest component first: squares of very long or short vectors leave the range of numbers.
    let largest = vector.amax();
    (largest > 0.0).then(|| (vector / largest).normalize())
}
