//! Classes of defaults: a tree, whose root holds for all.

use super::actuator::{KINDS, SHARING};
use super::why::why;
use crate::report::{Read, Report, elements};
use crate::tag::Tag;
use roxmltree::Node;
use std::collections::BTreeMap;

/// The class of what names none and stands in no body that does.
const MAIN: &str = "main";
/// Elements whose defaults are read, with their attributes.
const READ: [(&str, &[&str]); 3] =
    [("geom", super::geom::ATTRIBUTES), ("joint", super::joint::ATTRIBUTES), ("mesh", &["scale"])];

/// The defaults of a file.
#[derive(Debug, Default)]
pub(super) struct Defaults<'a, 'i> {
    /// The elements of a class, and the class around it.
    classes: BTreeMap<&'a str, (Vec<Node<'a, 'i>>, Option<&'a str>)>,
    /// The class that holds for all.
    top: Option<&'a str>,
}

impl<'a, 'i> Defaults<'a, 'i> {
    /// Reads those of the top level; lists what is not used.
    pub fn read(root: Node<'a, 'i>, report: &mut Report) -> Self {
        let mut defaults = Self::default();
        let top = elements(root).filter(|node| node.tag_name().name() == "default");
        let mut waiting: Vec<(Node<'a, 'i>, Option<&'a str>)> = top.map(|node| (node, None)).collect();
        while let Some((node, outer)) = waiting.pop() {
            let class = match (node.attribute("class"), outer) {
                (Some(class), _) => class,
                (None, None) => defaults.top.unwrap_or(MAIN),
                (None, Some(_)) => {
                    report.fault(node, "a class of defaults has no name", "write class=\"…\"");
                    continue;
                }
            };
            if outer.is_none() {
                defaults.top.get_or_insert(class);
            }
            let mut known = vec!["default"];
            let read = || READ.iter().chain(&KINDS);
            known.extend(read().map(|(tag, _)| *tag));
            report.rest(node, Read { attributes: &["class"], elements: &known, why });
            for child in elements(node) {
                let tag = child.tag_name().name();
                if let Some((_, attributes)) = read().find(|(known, _)| *known == tag) {
                    report.rest(child, Read { attributes, elements: &[], why });
                }
            }
            waiting.extend(
                elements(node).filter(|child| child.tag_name().name() == "default").map(|it| (it, Some(class))),
            );
            defaults.classes.entry(class).or_insert((Vec::new(), outer)).0.push(node);
        }
        defaults
    }

    /// An element with what holds where it is silent: its class, else that of the body around it, else the main one.
    pub fn tag(&self, node: Node<'a, 'i>, childclass: Option<&'a str>, report: &mut Report) -> Tag<'a, 'i> {
        let named = node.attribute("class").or(childclass);
        let mut class = named.filter(|name| *name != MAIN).or(self.top);
        if let Some(name) = named.filter(|name| *name != MAIN && !self.classes.contains_key(name)) {
            report.fault(node, format!("there is no class \"{name}\" of defaults"), "name one, or leave it out");
            class = None;
        }
        let mut layers = Vec::new();
        // A class within itself would be a circle.
        for _ in 0..=self.classes.len() {
            let Some((nodes, outer)) = class.and_then(|name| self.classes.get(name)) else { break };
            let mut own: Vec<_> = nodes.iter().flat_map(|holder| elements(*holder)).collect();
            own.retain(|child| is_default_of(child.tag_name().name(), node.tag_name().name()));
            // The last written is the nearest.
            own.sort_by_key(|child| std::cmp::Reverse(child.range().start));
            layers.extend(own);
            class = *outer;
        }
        Tag::with(node, layers)
    }
}

/// Whether a default of one name holds for an element of another: all actuators of a class share theirs.
fn is_default_of(default: &str, element: &str) -> bool {
    default == element || (SHARING.contains(&default) && SHARING.contains(&element))
}
