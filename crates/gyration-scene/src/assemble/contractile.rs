//! What contracts a body: its viscosity, what G follows, and where it starts.
//!
//! A drive and feedback add up to Q; without either Q = 0. A G that is prescribed has to be a contraction over the
//! whole run, det G > 0, without jumps; where an incompressible material follows it, without kinks as well: det P = det
//! G has to have a second derivative.

use super::context::SceneContext;
use super::signal::{SignalBuilder, first_fault, not_finite};
use super::start::{flaw, invertible, matrix};
use crate::check::{Reporter, direction};
use crate::file::{self, FeltMeasure, OneOrMany};
use crate::key::Key;
use crate::quantity::Pressure;
use crate::units::shown;
use gyration::contractile::{Contraction, ContractionSource, Feedback, FeedbackMeasure, Spin};
use gyration::signal::{Jet, Signal, Smoothness};
use gyration::tensor::Mat3;

/// How a body contracts, and how that starts.
#[derive(Debug, Clone)]
pub(super) struct WrittenContraction {
    pub(super) contraction: Contraction,
    /// G and its rate at t = 0, the rate being zero unless it is prescribed.
    pub(super) start: Jet,
}

impl WrittenContraction {
    /// Reads it at a key; notes what is wrong with any part, and what cannot stand beside each other.
    pub(super) fn of(
        written: &file::Contractile,
        key: &Key,
        context: &SceneContext,
        reporter: &mut Reporter<'_>,
    ) -> Option<Self> {
        let viscosity = viscosity(written, key, reporter);
        let drive = written.drive.as_ref().map(|it| drive(it, &key.key("drive"), context, reporter));
        let feedback = feedbacks(written.feedback.as_ref(), &key.key("feedback"), context, reporter);
        let prescribed =
            written.prescribed.as_ref().map(|it| prescribed(it, &key.key("prescribed"), context, reporter));
        let initial = initial(written, &key.key("contraction"), reporter);
        if let Some(prescribed) = prescribed {
            let alone = stands_alone(key, reporter);
            let (viscosity, signal) = (viscosity?, prescribed?);
            let start = signal.jet(0.0);
            let source = ContractionSource::Prescribed(signal);
            let contraction = Contraction { viscosity, kept_volume: None, spin: Spin::Full, source };
            return alone.then_some(Self { contraction, start });
        }
        let drive = drive.unwrap_or_else(|| Some(Signal::Constant(Mat3::zeros())));
        let (viscosity, drive, feedback, initial) = (viscosity?, drive?, feedback?, initial?);
        let spin = match written.spin.unwrap_or_default() {
            file::Spin::Full => Spin::Full,
            file::Spin::Symmetric => Spin::Symmetric,
        };
        let kept_volume = written.isochoric.unwrap_or_default().then(|| initial.determinant());
        let contraction =
            Contraction { viscosity, kept_volume, spin, source: ContractionSource::Driven { drive, feedback } };
        Some(Self { contraction, start: Jet { value: initial, ..Jet::default() } })
    }

    /// Whether a body of such a material can contract like this; notes it at the contractile table otherwise.
    pub(super) fn suits(&self, is_incompressible: bool, key: &Key, reporter: &mut Reporter<'_>) -> bool {
        let ContractionSource::Prescribed(signal) = &self.contraction.source else { return true };
        let suits = !is_incompressible || signal.smoothness() == Smoothness::Smooth;
        if !suits {
            let message =
                "its rate jumps, and the volume of an incompressible body would have to change its rate at once";
            let help = "use `interpolation = \"cubic\"`, a sine, or give the material a `bulk` modulus";
            reporter.note(&key.key("prescribed"), message, help);
        }
        suits
    }
}

/// Whether a body without a surface never answers to a gap; notes the first place where it does.
pub(super) fn feels_no_gap(written: &file::Contractile, key: &Key, reporter: &mut Reporter<'_>) -> bool {
    let parts = written.feedback.as_ref().map(OneOrMany::as_slice).unwrap_or_default();
    let felt = parts.iter().position(|part| part.measure.is_support_gap());
    if let Some(index) = felt {
        let place = place(written.feedback.as_ref(), &key.key("feedback"), index).key("measure");
        let help = "give it a shape with a surface, or let it feel a `stretch` or a `rate`";
        reporter.note(&place, "the body has no surface that could be near a support", help);
    }
    felt.is_none()
}

/// μ_γ; notes that it is missing where it is needed.
fn viscosity(written: &file::Contractile, key: &Key, reporter: &mut Reporter<'_>) -> Option<f64> {
    match written.contraction_viscosity {
        Some(given) => Some(given.value()),
        None if written.prescribed.is_some() => Some(0.0),
        None => {
            let help = "add `contraction_viscosity`, a number in Pa s greater than 0: the time in which a stress \
                        contracts the body is that viscosity per stress";
            let message = "the key \"contraction_viscosity\" is missing";
            reporter.note(&key.key("contraction_viscosity"), message, help);
            None
        }
    }
}

/// Notes what cannot stand beside `prescribed`.
fn stands_alone(key: &Key, reporter: &mut Reporter<'_>) -> bool {
    let others = [
        ("drive", "Q is then what it takes"),
        ("feedback", "Q is then what it takes"),
        ("contraction", "it says where G starts"),
        ("isochoric", "it says what the volume of G is"),
        ("spin", "it says how G spins"),
    ];
    let mut alone = true;
    for (name, why) in others {
        let place = key.key(name);
        if place.is_written(&reporter.document.root) {
            let message = format!("`prescribed` stands beside it: {why}");
            reporter.note(&place, message, format!("keep one of `{name}` and `prescribed`"));
            alone = false;
        }
    }
    alone
}

/// The initial G.
fn initial(written: &file::Contractile, key: &Key, reporter: &mut Reporter<'_>) -> Option<Mat3> {
    let contraction = written.contraction.as_ref().map_or_else(Mat3::identity, matrix);
    invertible(&contraction, key, reporter).then_some(contraction)
}

fn drive(
    written: &file::Signal<file::Rows<Pressure>>,
    key: &Key,
    context: &SceneContext,
    reporter: &mut Reporter<'_>,
) -> Option<Signal> {
    SignalBuilder { context, reporter, symbol: 'Q', rest: Mat3::zeros() }.bounded(written, key)
}

/// G in time, if it is a contraction throughout.
fn prescribed(
    written: &file::Signal<file::Rows<f64>>,
    key: &Key,
    context: &SceneContext,
    reporter: &mut Reporter<'_>,
) -> Option<Signal> {
    let signal = SignalBuilder { context, reporter, symbol: 'G', rest: Mat3::identity() }.signal(written, key)?;
    if signal.smoothness() == Smoothness::Jumps {
        let help = "use a sine, a ramp or a table: their values do not jump";
        reporter.note(key, "it jumps with a square wave, and the body would have to follow at once", help);
        return None;
    }
    let fault = |value: &Mat3| not_finite(value).or_else(|| flaw(value));
    let Some((time, message)) = first_fault(&signal, context.end.unwrap_or(0.0), fault) else { return Some(signal) };
    let help = "keep det G > 0 over the whole run: a contraction that varies about none is \
                { sum = [{ constant = { value = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] } }, …] }";
    reporter.note(key, format!("at t = {} s {message}", shown(time)), help);
    None
}

/// Where the part of a number stands.
fn place(written: Option<&OneOrMany<file::Feedback>>, key: &Key, index: usize) -> Key {
    match written {
        Some(OneOrMany::Many(_)) => key.index(index),
        _ => key.clone(),
    }
}

fn feedbacks(
    written: Option<&OneOrMany<file::Feedback>>,
    key: &Key,
    context: &SceneContext,
    reporter: &mut Reporter<'_>,
) -> Option<Vec<Feedback>> {
    let parts = written.map(OneOrMany::as_slice).unwrap_or_default().iter().enumerate();
    let made = parts.map(|(index, part)| feedback(part, &place(written, key, index), context, reporter));
    // All of them, so that each is checked.
    let made: Vec<Option<Feedback>> = made.collect();
    made.into_iter().collect()
}

fn feedback(
    written: &file::Feedback,
    key: &Key,
    context: &SceneContext,
    reporter: &mut Reporter<'_>,
) -> Option<Feedback> {
    let measure = measure(&written.measure, &key.key("measure"), context, reporter);
    let (gain, bias) = (matrix(&written.gain), matrix(&written.bias));
    if let Some([least, most]) = written.limits {
        if least >= most {
            let message = format!("the limits, {} and {}, do not increase", shown(least), shown(most));
            reporter.note(&key.key("limits"), message, "write [least, most], the values that the measure counts as");
            return None;
        }
        if let Some(message) = [least, most].iter().find_map(|limit| not_finite(&(gain * *limit + bias))) {
            reporter.note(&key.key("gain"), format!("{message} at a limit"), "write smaller numbers");
            return None;
        }
    }
    Some(Feedback { measure: measure?, gain, bias, limits: written.limits })
}

fn measure(
    written: &FeltMeasure,
    key: &Key,
    context: &SceneContext,
    reporter: &mut Reporter<'_>,
) -> Option<FeedbackMeasure> {
    let mut along = |name: &str, vector: &[f64; 3]| {
        let along = direction(vector);
        if along.is_none() {
            reporter.note(&key.key(name), "the direction is zero", "write a direction, [0, 0, 1]");
        }
        along
    };
    match written {
        FeltMeasure::Stretch(vector) => along("stretch", vector).map(FeedbackMeasure::Stretch),
        FeltMeasure::Rate(vector) => along("rate", vector).map(FeedbackMeasure::Rate),
        FeltMeasure::SupportGap | FeltMeasure::Gap => {
            if context.has_support {
                return Some(FeedbackMeasure::SupportGap);
            }
            let help = "add a [[support]] with a `plane`, or let the body feel a `stretch` or a `rate`";
            reporter.note(key, "there is no support that is a plane, which the body could be near", help);
            None
        }
    }
}
