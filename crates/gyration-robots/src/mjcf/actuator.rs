//! Actuators without state, as terms of the drive of a joint.
//!
//! With the gear r, the length l = r q and the input u, an actuator has the force a u + b₀ + b₁ l + b₂ l̇, and acts on
//! the joint by r times that.

use super::Reader;
use super::why::why;
use crate::report::{Read, Report, elements, named};
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

/// a, and b₀, b₁, b₂.
struct Law {
    gain: f64,
    bias: [f64; 3],
}

impl<'a, 'i> Reader<'a, 'i, '_> {
    /// Adds the actuators of a section to the drives of their joints; lists those that are none.
    pub(super) fn actuators(&mut self, section: Node<'a, 'i>) {
        self.report
            .rest(section, Read { attributes: &[], elements: &["motor", "position", "velocity", "general"], why });
        for node in elements(section) {
            let attributes = match node.tag_name().name() {
                "motor" => MOTOR,
                "position" => POSITION,
                "velocity" => VELOCITY,
                "general" => GENERAL,
                _ => continue,
            };
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
        let range = tag.numbers::<2>("forcerange", self.report);
        let is_limited = match tag.text("forcelimited") {
            Some("true") => true,
            Some("false") => false,
            _ => self.compiler.has_automatic_limits,
        };
        let connection = &mut self.robot.links[link].connection;
        let Some(coordinate) = connection.kind.coordinate() else { return };
        let input = connection.drive.input();
        let Law { gain, bias: [constant, by_length, by_rate] } = law;
        let length = shifted(coordinate, -reference);
        let terms =
            [(gain, input), (constant, "1".to_owned()), (by_length * gear, length), (by_rate * gear, "rate".into())];
        let written = terms.iter().filter(|(factor, _)| *factor != 0.0);
        let sum: Vec<String> = written.map(|(factor, what)| format!("{factor:?}*{what}")).collect();
        let mut force = if sum.is_empty() { "0".to_owned() } else { sum.join(" + ") };
        if let Some([low, high]) = range.filter(|_| is_limited) {
            force = format!("max({low:?}, min({high:?}, {force}))");
        }
        let factor = if gear == 1.0 { String::new() } else { format!("{gear:?}*") };
        let force = if sum.len() > 1 && !factor.is_empty() { format!("({force})") } else { force };
        connection.drive.terms.push(format!("{factor}{force}"));
        let what = format!("{}: its input is the constant `u` of the drive, zero", named(node));
        self.report.choose(Some(self.report.line(node)), what, "a file has no inputs in time");
    }
}

/// The law of an actuator; lists it where it has a state or another law.
fn law(tag: &Tag<'_, '_>, report: &mut Report) -> Option<Law> {
    let number = |name: &str, default: f64, report: &mut Report| tag.number(name, report).unwrap_or(default);
    match tag.node().tag_name().name() {
        "motor" => Some(Law { gain: 1.0, bias: [0.0; 3] }),
        "position" => {
            let (gain, damping) = (number("kp", 1.0, report), number("kv", 0.0, report));
            Some(Law { gain, bias: [0.0, -gain, -damping] })
        }
        "velocity" => {
            let gain = number("kv", 1.0, report);
            Some(Law { gain, bias: [0.0, 0.0, -gain] })
        }
        _ => {
            let word = |name: &str, default: &'static str| tag.text(name).unwrap_or(default).to_owned();
            let kinds = [word("gaintype", "fixed"), word("biastype", "none"), word("dyntype", "none")];
            let [gain_kind, bias_kind, state] = kinds.each_ref().map(String::as_str);
            if gain_kind != "fixed" || !matches!(bias_kind, "none" | "affine") || state != "none" {
                report.leave_out(
                    tag.node(),
                    named(tag.node()),
                    "only a fixed gain and an affine bias without a state are read",
                );
                return None;
            }
            let gain = tag.list("gainprm", report).and_then(|gains| gains.first().copied()).unwrap_or(1.0);
            let written = tag.list("biasprm", report).unwrap_or_default();
            let entry = |k: usize| if bias_kind == "affine" { written.get(k).copied().unwrap_or(0.0) } else { 0.0 };
            Some(Law { gain, bias: [entry(0), entry(1), entry(2)] })
        }
    }
}
