//! Actuators without state, as terms of the drive of a joint.
//!
//! With the gear r, the length l = r q and the input u, an actuator has the force a u + b₀ + b₁ l + b₂ l̇, and acts on
//! the joint by r times that.

use super::Reader;
use super::law::{Law, law};
use super::why::why;
use crate::report::{Read, elements, named};
use crate::robot::shifted;
use crate::tag::Tag;
use roxmltree::Node;

const COMMON: [&str; 6] = ["name", "class", "joint", "gear", "forcerange", "forcelimited"];
pub(super) const MOTOR: &[&str] = &COMMON;
pub(super) const POSITION: &[&str] = &["name", "class", "joint", "gear", "forcerange", "forcelimited", "kp", "kv"];
pub(super) const VELOCITY: &[&str] = &["name", "class", "joint", "gear", "forcerange", "forcelimited", "kv"];
pub(super) const GENERAL: &[&str] = &[
    "name",
    "class",
    "joint",
    "gear",
    "forcerange",
    "forcelimited",
    "gaintype",
    "gainprm",
    "biastype",
    "biasprm",
    "dyntype",
];

/// Elements that are read.
pub(super) const KINDS: [(&str, &[&str]); 4] =
    [("motor", MOTOR), ("position", POSITION), ("velocity", VELOCITY), ("general", GENERAL)];
/// All elements that share the defaults of actuators.
pub(super) const SHARING: [&str; 9] =
    ["motor", "position", "velocity", "general", "intvelocity", "damper", "cylinder", "muscle", "adhesion"];

impl<'a, 'i> Reader<'a, 'i, '_> {
    /// Adds the actuators of a section to the drives of their joints; lists those that are none.
    pub(super) fn actuators(&mut self, section: Node<'a, 'i>) {
        self.report.rest(section, Read { attributes: &[], elements: &KINDS.map(|(kind, _)| kind), why });
        for node in elements(section) {
            let kind = KINDS.iter().find(|(kind, _)| *kind == node.tag_name().name());
            let Some((_, attributes)) = kind else { continue };
            let tag = self.defaults.tag(node, None, self.report);
            self.report.rest(node, Read { attributes, elements: &[], why });
            self.actuator(&tag);
        }
    }

    fn actuator(&mut self, tag: &Tag<'a, 'i>) {
        let node = tag.node();
        let Some(name) = tag.text("joint") else {
            self.report.leave_out(node, named(node), "it acts on no joint");
            return;
        };
        let Some(&(link, reference)) = self.coordinates.get(name) else {
            if self.joints.contains(name) {
                let why = format!("\"{name}\" is no hinge or slide that a scene has");
                self.report.leave_out(node, named(node), why);
            } else {
                let message = format!("{} acts on the joint \"{name}\", which is not there", named(node));
                self.report.fault(node, message, "write the name of a joint");
            }
            return;
        };
        let Some(law) = law(tag, self.report) else { return };
        let gear = tag.list("gear", self.report).and_then(|gear| gear.first().copied()).unwrap_or(1.0);
        let range = self.compiler.limits(tag, ["forcerange", "forcelimited"], self.report);
        let connection = &mut self.robot.links[link].connection;
        let Some(coordinate) = connection.kind.coordinate() else { return };
        let input = connection.drive.input();
        let Law { gain, bias: [constant, by_length, by_rate], .. } = law;
        let length = shifted(coordinate, -reference);
        let terms = [
            (gain, input.clone()),
            (constant, "1".to_owned()),
            (by_length * gear, length),
            (by_rate * gear, "rate".into()),
        ];
        let written = terms.iter().filter(|(factor, _)| *factor != 0.0);
        let sum: Vec<String> = written.map(|(factor, what)| format!("{factor:?}*{what}")).collect();
        let mut force = if sum.is_empty() { "0".to_owned() } else { sum.join(" + ") };
        if let Some([low, high]) = range {
            force = format!("max({low:?}, min({high:?}, {force}))");
        }
        let factor = if gear == 1.0 { String::new() } else { format!("{gear:?}*") };
        let force = if sum.len() > 1 && !factor.is_empty() { format!("({force})") } else { force };
        connection.drive.terms.push(format!("{factor}{force}"));
        let what = format!("{}: its input is the constant `{input}` of the drive, zero", named(node));
        self.report.choose(Some(self.report.line(node)), what, "a file has no inputs in time");
    }
}
