//! What acts along the free motion of a hinge or slider: limits with their stops, and drives.

use super::context::SceneContext;
use super::own::{accepted, constants};
use super::signal::SignalBuilder;
use super::unit::Unit;
use crate::check::Reporter;
use crate::file::{DriveLaw, Entry, Joint, JointDrive, Signal};
use crate::key::Key;
use crate::quantity::AnyQuantity;
use crate::units::parse_quantity;
use gyration::joint::{ANGLE_NAMES, Drive, JointKind, Motor, MotorFault, Stop, StopLaw, WAY_NAMES};
use gyration::tensor::Mat3;
use gyration_expression::{Expression, Scratch};
use std::f64::consts::PI;
use std::sync::Arc;

/// A joint whose motor is read.
pub(super) struct WrittenMotor<'a> {
    pub key: &'a Key,
    pub value: &'a Joint,
    pub kind: JointKind,
    /// The coordinate at the start, as the scene has it \[rad\], \[m\].
    pub start: f64,
}

/// What the coordinate, the push and the resistance of a hinge are.
const OF_HINGE: [Unit; 3] = [Unit::ANGLE, Unit::TORQUE, Unit::TORQUE_PER_RATE];
/// Those of a slider.
const OF_SLIDER: [Unit; 3] = [Unit::LENGTH, Unit::FORCE, Unit::FORCE_PER_VELOCITY];

impl WrittenMotor<'_> {
    /// The motor; notes what is wrong with it.
    pub fn motor(&self, context: &SceneContext, reporter: &mut Reporter<'_>) -> Option<Motor> {
        let Self { key, value, kind, .. } = self;
        if !kind.has_axis() {
            let keys =
                [("limits", value.limits.is_some()), ("stop", value.stop.is_some()), ("drive", value.drive.is_some())];
            for (name, _) in keys.iter().filter(|(_, is_written)| *is_written) {
                let message = format!("a joint of the kind \"{}\" leaves no one motion free", kind.word());
                reporter.note(&key.key(name), message, "leave it out, or write kind = \"hinge\" or \"slider\"");
            }
            let is_bare = keys.iter().all(|(_, is_written)| !is_written);
            return is_bare.then(Motor::default);
        }
        let stop = self.stop(reporter);
        let drive = match &value.drive {
            Some(drive) => Some(self.drive(drive, context, reporter)?),
            None => None,
        };
        Some(Motor { drive, stop: stop? })
    }

    /// The stop of the limits, if there are any; none at all if they are wrong.
    fn stop(&self, reporter: &mut Reporter<'_>) -> Option<Option<Stop>> {
        let Self { key, value, kind, start } = self;
        let (limits, written) = match (&value.limits, &value.stop) {
            (None, None) => return Some(None),
            (Some(limits), Some(stop)) => (limits.map(|limit| limit.0), stop),
            (Some(_), None) => {
                let help = "write stop = { repulsion = { alpha = 1, nu = 2, d0 = 0.01 } }";
                reporter.note(&key.key("limits"), "limits need a `stop`: the field that pushes back there", help);
                return None;
            }
            (None, Some(_)) => {
                reporter.note(&key.key("stop"), "a stop acts at `limits`, of which there are none", "write limits");
                return None;
            }
        };
        let place = key.key("limits");
        let [way, push, resistance] = self.units();
        let of_stop = |law: &str, name: &str| key.key("stop").key(law).key(name);
        let written_as = [
            (place.clone(), way),
            (of_stop("repulsion", "d0"), way),
            (of_stop("damping", "d0"), way),
            (of_stop("repulsion", "alpha"), push),
            (of_stop("damping", "beta"), resistance),
        ];
        let owner = kind.word();
        let wrong = written_as.iter().filter(|(key, unit)| !unit.is_of_all(key, owner, reporter)).count();
        let [low, high] = limits;
        if *kind == JointKind::Hinge && !(low >= -PI && high <= PI) {
            let help = "write angles from -180 deg to 180 deg";
            reporter.note(&place, format!("an angle is from −π to π, and the limits are {low:?} and {high:?}"), help);
            return None;
        }
        if low >= high {
            let message = format!("the limits {low:?} and {high:?} leave nothing between them");
            reporter.note(&place, message, "write the least first");
            return None;
        }
        if !(low < *start && *start < high) {
            let si = if *kind == JointKind::Hinge { "rad" } else { "m" };
            let message = format!("the joint starts at {start:?} {si}, which is not between {low:?} and {high:?} {si}");
            reporter.note(&place, message, "write limits around the start, or start elsewhere");
            return None;
        }
        let of = |coefficient: f64, exponent: f64, reference: f64| StopLaw { coefficient, exponent, reference };
        let repulsion = of(written.repulsion.alpha.value(), written.repulsion.nu.0, written.repulsion.d0.value());
        let damping = written.damping.map(|damping| of(damping.beta.value(), damping.nu.0, damping.d0.value()));
        if repulsion.exponent < 1.0 {
            let message = "an exponent below 1 lets the joint reach its limit";
            reporter.note(&key.key("stop").key("repulsion").key("nu"), message, "write at least 1");
            return None;
        }
        (wrong == 0).then_some(Some(Stop { limits, repulsion, damping }))
    }

    fn drive(&self, drive: &JointDrive, context: &SceneContext, reporter: &mut Reporter<'_>) -> Option<Drive> {
        let key = self.key.key("drive");
        let is_hinge = self.kind == JointKind::Hinge;
        let (name, other, names) =
            if is_hinge { ("torque", "force", ANGLE_NAMES) } else { ("force", "torque", WAY_NAMES) };
        let (own, wrong) = if is_hinge { (&drive.torque, &drive.force) } else { (&drive.force, &drive.torque) };
        if wrong.is_some() {
            let message = format!("a {} is driven by a {name}", self.kind.word());
            reporter.note(&key.key(other), message, format!("write `{name}`"));
            return None;
        }
        let Some(written) = own else {
            reporter.note(&key, format!("it has no `{name}`"), format!("write {name} = 1, or an expression in quotes"));
            return None;
        };
        let place = key.key(name);
        let text = match written {
            DriveLaw::Feedback(Entry::Number(number)) => format!("{number:?}"),
            DriveLaw::Feedback(Entry::Expression(text)) => text.to_string(),
            DriveLaw::Signal(signal) => return self.signal(signal, &place, drive, context, reporter),
        };
        let constants = constants((key.key("constants"), drive.constants.as_ref()), context, &names, reporter)?;
        let read = Expression::parse(&text, &names, &constants).map(|expression| expression.holding(&[2]));
        // A number with the unit of something else is no expression either.
        let [_, push, _] = self.units();
        if read.is_err() && parse_quantity(&text).is_ok() && !push.is_of_all(&place, self.kind.word(), reporter) {
            return None;
        }
        let expression = accepted(read, (&place, &text), reporter)?;
        let law = Drive::Feedback(Arc::new(expression));
        let motor = Motor { drive: Some(law.clone()), stop: None };
        if let Err(MotorFault::Undefined(undefined)) = motor.at([self.start, 0.0, 0.0], &mut Scratch::default()) {
            reporter.note(&place, undefined.to_string(), "write one that is defined and smooth at the start");
            return None;
        }
        Some(law)
    }

    /// A signal in the place of an expression.
    fn signal(
        &self,
        written: &Signal<AnyQuantity>,
        place: &Key,
        drive: &JointDrive,
        context: &SceneContext,
        reporter: &mut Reporter<'_>,
    ) -> Option<Drive> {
        let [_, push, _] = self.units();
        let owner = self.kind.word();
        let wrong = numbers(written, place).iter().filter(|key| !push.is_of_all(key, owner, reporter)).count();
        if drive.constants.is_some() {
            let key = self.key.key("drive").key("constants");
            reporter.note(&key, "a signal has no constants: they are those of an expression", "leave them out");
            return None;
        }
        let signal = SignalBuilder { context, reporter, symbol: 'u', rest: Mat3::zeros() }.bounded(written, place)?;
        (wrong == 0).then(|| Drive::Signal(Arc::new(signal)))
    }

    /// What its coordinate, its push and its resistance are.
    fn units(&self) -> &'static [Unit; 3] {
        if self.kind == JointKind::Hinge { &OF_HINGE } else { &OF_SLIDER }
    }
}

/// Where the torques or forces of a signal are written.
fn numbers(written: &Signal<AnyQuantity>, key: &Key) -> Vec<Key> {
    let (word, names): (&str, &[&str]) = match written {
        Signal::Constant(_) => ("constant", &["value"]),
        Signal::Sine(_) => ("sine", &["amplitude"]),
        Signal::Square(_) => ("square", &["amplitude"]),
        Signal::Ramp(_) => ("ramp", &["from", "to"]),
        Signal::Table(_) => return Vec::new(),
        Signal::Sum(parts) => {
            let key = key.key("sum");
            return parts.iter().enumerate().flat_map(|(index, part)| numbers(part, &key.index(index))).collect();
        }
    };
    names.iter().map(|name| key.key(word).key(name)).collect()
}
