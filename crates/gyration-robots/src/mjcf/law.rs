//! Laws of actuators, with the defaults that all kinds of them share.
//!
//! A class has one law of each shortcut, `position` and `velocity`, and that of `general`, which each shortcut in the
//! class sets, too; a `general` sets all. An element begins with the laws of its class. Found by compiling models with
//! MuJoCo 3.17 and 4.0.

use crate::report::{Report, named};
use crate::tag::Tag;

/// a; b₀, b₁, b₂; the words gaintype, biastype, dyntype.
#[derive(Debug, Clone, Copy)]
pub(super) struct Law<'a> {
    pub gain: f64,
    pub bias: [f64; 3],
    kinds: [&'a str; 3],
}

/// A motor: a = 1.
const MOTOR: Law<'_> = Law { gain: 1.0, bias: [0.0; 3], kinds: FIXED };
const FIXED: [&str; 3] = ["fixed", "none", "none"];
const AFFINE: [&str; 3] = ["fixed", "affine", "none"];

/// The laws with which an element of each kind begins.
#[derive(Debug, Clone, Copy)]
struct Laws<'a> {
    general: Law<'a>,
    position: Law<'a>,
    velocity: Law<'a>,
}

/// The law of an element behind its defaults; lists it where it has a state or another law than the affine.
pub(super) fn law<'a>(tag: &Tag<'a, '_>, report: &mut Report) -> Option<Law<'a>> {
    let mut laws = Laws { general: MOTOR, position: MOTOR, velocity: MOTOR };
    let layers: Vec<Tag<'_, '_>> = tag.layers().collect();
    for layer in layers.iter().rev() {
        laws.read(layer, report);
    }
    let law = laws.general;
    match law.kinds {
        AFFINE => Some(law),
        FIXED => Some(Law { bias: [0.0; 3], ..law }),
        _ => {
            let why = "only a fixed gain and an affine bias without a state are read";
            report.leave_out(tag.node(), named(tag.node()), why);
            None
        }
    }
}

impl<'a> Laws<'a> {
    /// Sets what one element says.
    fn read(&mut self, layer: &Tag<'a, '_>, report: &mut Report) {
        match layer.node().tag_name().name() {
            "motor" => self.general = MOTOR,
            "position" => {
                let gain = layer.number("kp", report).unwrap_or(self.position.gain);
                let by_rate = layer.number("kv", report).map_or(self.position.bias[2], |damping| -damping);
                self.position = Law { gain, bias: [0.0, -gain, by_rate], kinds: AFFINE };
                self.general = self.position;
            }
            "velocity" => {
                let gain = layer.number("kv", report).unwrap_or(self.velocity.gain);
                self.velocity = Law { gain, bias: [0.0, 0.0, -gain], kinds: AFFINE };
                self.general = self.velocity;
            }
            "general" => {
                self.general.set(layer, report);
                (self.position, self.velocity) = (self.general, self.general);
            }
            // Shortcuts of other laws.
            other => self.general = Law { kinds: [other; 3], ..MOTOR },
        }
    }
}

impl<'a> Law<'a> {
    /// Sets the attributes of a `general`.
    fn set(&mut self, tag: &Tag<'a, '_>, report: &mut Report) {
        if let Some(gain) = tag.list("gainprm", report).and_then(|gains| gains.first().copied()) {
            self.gain = gain;
        }
        for (entry, written) in self.bias.iter_mut().zip(tag.list("biasprm", report).unwrap_or_default()) {
            *entry = written;
        }
        for (kind, name) in self.kinds.iter_mut().zip(["gaintype", "biastype", "dyntype"]) {
            *kind = tag.text(name).unwrap_or(kind);
        }
    }
}
