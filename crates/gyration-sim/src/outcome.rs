//! How a run ended, in words and in data.

mod flattened;

use crate::format::significant;
use gyration::joint::JointKind;
use gyration::load::FrictionFault;
use gyration::model::Model;
use gyration::{FormulaOf, Inadmissible, Party, Quantity};
use gyration_ode::{Cause, Failure, Limit};
use gyration_threads::{Interrupted, Interruption};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

/// How a run ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// It reached the end of the scene.
    Completed,
    /// Every body was slower than `stop_at_rest.speed` for `stop_at_rest.hold`.
    AtRest {
        /// When [s].
        time: f64,
    },
    /// It could not, or should not, go on.
    Stopped(Stop),
}

/// Why a run stopped early.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Stop {
    /// When [s].
    pub time: f64,
    /// The kind of reason.
    pub reason: Reason,
    /// The body concerned, by name.
    pub body: Option<String>,
    /// What happened, in a sentence.
    pub what: String,
    /// What to change.
    pub advice: String,
}

/// The kinds of reason for an early stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// A surface reached a support.
    GapClosed,
    /// The gap between two bodies is smaller than the digits of a number tell: they touch.
    Touching,
    /// A body that deforms was flattened: its volume vanished.
    Inverted,
    /// A linkage came to where its joints lock it.
    Locked,
    /// Nothing resists the motion of a body without inertia.
    Unresisted,
    /// A body that deforms in a fluid was drawn out to a thread or flattened to a film.
    TooSlender,
    /// The resistance of a body that deforms in a fluid is not known as well as was asked for.
    Unresolved,
    /// A contractile body contracted to nothing: det G vanished.
    Collapsed,
    /// A spring lost its direction.
    SpringCollapsed,
    /// A body of a lattice left the surroundings of its place.
    Strayed,
    /// A formula of the scene has no value or derivative there.
    Undefined,
    /// The matrix of a friction is none: it would feed energy in.
    IndefiniteFriction,
    /// The tolerance cannot be met with any step.
    StepTooSmall,
    /// A number stopped being finite.
    NotFinite,
    /// `max_wall_time` was reached; the recording can be resumed.
    WallTime,
    /// The user asked to stop; the recording can be resumed.
    Interrupted,
}

impl Outcome {
    /// Whether the run is over, so that there is nothing to resume.
    pub fn is_final(&self) -> bool {
        match self {
            Self::Completed | Self::AtRest { .. } => true,
            Self::Stopped(stop) => !matches!(stop.reason, Reason::WallTime | Reason::Interrupted),
        }
    }

    /// The outcome in a sentence or two.
    pub fn in_words(&self) -> String {
        match self {
            Self::Completed => "completed".into(),
            Self::AtRest { time } => format!("came to rest, stopped at t = {time:.6} s"),
            Self::Stopped(stop) => {
                format!("stopped at t = {:.9} s: {}. {}", stop.time, stop.what, stop.advice)
            }
        }
    }
}

impl From<Interrupted> for Reason {
    fn from(interrupted: Interrupted) -> Self {
        match interrupted {
            Interrupted::Overdue => Self::WallTime,
            Interrupted::Raised => Self::Interrupted,
        }
    }
}

impl Stop {
    /// A stop because of the interruption in force.
    pub fn by_interruption(time: f64) -> Self {
        Self::by_request(time, Interruption::due().map_or(Reason::Interrupted, Reason::from))
    }

    /// A stop for reasons outside the physics.
    pub fn by_request(time: f64, reason: Reason) -> Self {
        let (what, advice) = match reason {
            Reason::WallTime => (
                "the run took longer than solver.max_wall_time",
                "Go on with --resume and a larger solver.max_wall_time, or loosen solver.rtol.",
            ),
            _ => ("the run was interrupted", "Go on with --resume."),
        };
        Self { time, reason, body: None, what: what.into(), advice: advice.into() }
    }

    /// A stop because two bodies touch, as far as digits tell: the gap [m] between one of them and their plane, and the
    /// size [m] with which it is compared.
    pub fn by_touch(model: &Model, time: f64, parties: [Party; 2], gap: f64, size: f64) -> Self {
        let [one, other] = parties.map(|party| model.party_name(party));
        Self {
            time,
            reason: Reason::Touching,
            body: Some(one.to_owned()),
            what: format!(
                "{} {one:?} and {other:?} touch: the plane between them is {gap:.1e} m off one, {:.1e} of the size \
                 of the smaller one, below what the digits of a number tell",
                sort(parties),
                gap / size
            ),
            advice:
                "Their law hardly forbids it: give its repulsion a larger exponent nu, d0 or alpha, so that they turn \
                     back before, or reduce the speed."
                    .into(),
        }
    }

    /// A stop because a friction of a body would feed energy in.
    pub fn by_friction(body: &str, time: f64, fault: &FrictionFault) -> Self {
        Self {
            time,
            reason: Reason::IndefiniteFriction,
            body: Some(body.to_owned()),
            what: format!("the linear_friction of body {body:?} is none there: {fault}"),
            advice:
                "Write a matrix that is symmetric and positive semi-definite wherever the body goes, or a constant \
                     one with a `scale` that is never negative."
                    .into(),
        }
    }

    /// A stop because the drive of a hinge has jumped by so much [N m].
    pub fn by_half_turn(joint: &str, time: f64, jump: f64) -> Self {
        let by = if jump.is_nan() { String::new() } else { format!(", by {} N m", significant(jump.abs(), 3)) };
        Self {
            time,
            reason: Reason::Undefined,
            body: None,
            what: format!(
                "joint {joint:?} has turned past half a turn: `angle` goes from π to −π there, and its drive jumps{by}"
            ),
            advice: "Write the drive with sin(angle) and cos(angle), as \"-5*sin(angle - 3*t)\", drive its rate, as \
                     \"-2*(rate - 3)\", or stop the hinge before with `limits`."
                .into(),
        }
    }

    /// A stop because the energies are beyond the range of numbers.
    pub fn by_infinite_energy(time: f64) -> Self {
        Self {
            time,
            reason: Reason::NotFinite,
            body: None,
            what: "the energy is not finite".into(),
            advice: "Look for masses, speeds or coefficients that are out of all proportion.".into(),
        }
    }

    /// A stop because the stepper could not go on from a state, of which these are the numbers. A body that is
    /// flattened there is the reason, whatever the stepper gave up at: no digit of time is left to it.
    pub fn by_failure(model: &Model, failure: &Failure<Inadmissible>, state: &[f64]) -> Self {
        let (time, step, cause) = match failure {
            Failure::StepTooSmall { time, step, cause } => (time, *step, cause),
            Failure::NoRates { time, cause } => (time, 0.0, cause),
        };
        let flat = match cause {
            Cause::Inadmissible(_) => None,
            Cause::NotFinite { .. } | Cause::Error { .. } | Cause::Newton => flattened::flattened(model, state),
        };
        if let Some((body, value)) = flat {
            return Self::by_inadmissible(model, *time, &Inadmissible { body, quantity: Quantity::Volume, value });
        }
        match cause {
            Cause::Inadmissible(left) if left.quantity == Quantity::Volume => {
                // The value is that of a trial.
                let value = flattened::volume(model, left.body, state);
                Self::by_inadmissible(model, *time, &Inadmissible { value, ..*left })
            }
            Cause::Inadmissible(left) => Self::by_inadmissible(model, *time, left),
            Cause::NotFinite { index } => Self {
                time: *time,
                reason: Reason::NotFinite,
                body: owner(model, *index),
                what: format!("a rate is not finite, in the {}", accuracy_of(model, *index)),
                advice: "Look for coefficients or speeds that are out of all proportion.".into(),
            },
            Cause::Error { component, .. } => Self {
                time: *time,
                reason: Reason::StepTooSmall,
                body: owner(model, *component),
                what: format!(
                    "no step meets the tolerance (the last tried was {step:e} s, limited by the {})",
                    limit_in_words(model, &Limit::Error { component: *component })
                ),
                advice: format!(
                    "Loosen solver.rtol or solver.atol{}: what happens within the last digit of the time cannot be \
                     followed.",
                    or_softer_contacts(model)
                ),
            },
            Cause::Newton => Self {
                time: *time,
                reason: Reason::StepTooSmall,
                body: None,
                what: format!("the implicit equations cannot be solved with a step of {step:e} s"),
                advice: format!(
                    "Loosen solver.rtol, let solver.method be \"auto\", or shorten solver.max_step{}: what happens \
                     within the last digit of the time cannot be followed.",
                    or_softer_contacts(model)
                ),
            },
        }
    }

    /// A stop because a state is outside the model.
    pub fn by_inadmissible(model: &Model, time: f64, left: &Inadmissible) -> Self {
        let body = model.name(left.body).to_owned();
        let (reason, what, advice) = match left.quantity {
            Quantity::Gap { support } => (
                Reason::GapClosed,
                format!("body {body:?} reaches support {:?}{}", model.supports[support].name, in_brackets(left.value, "m")),
                "Either no law forbids the touch (`gyration check` tells the critical exponent), or the gap is too \
                 small for the digits of a number: raise an exponent, a coefficient or d0, or reduce the speed."
                    .to_string(),
            ),
            Quantity::PairPlane { other, rule } => {
                let parties = [Party::Body(left.body), other];
                let [one, other] = parties.map(|party| model.party_name(party));
                (
                    Reason::GapClosed,
                    format!("the plane between {} {one:?} and {other:?} cannot be found", sort(parties)),
                    hardly_forbidden(model, parties, rule).unwrap_or_else(|| {
                        "Their potential leaves the range of numbers, or the digits of their gap do not suffice: \
                         choose a d0 nearer to the gaps, a smaller exponent, or give the contact a `reach`."
                            .to_string()
                    }),
                )
            }
            Quantity::PairGap { other, rule } => {
                let parties = [Party::Body(left.body), other];
                let [one, other] = parties.map(|party| model.party_name(party));
                (
                    Reason::GapClosed,
                    format!("{} {one:?} and {other:?} reach each other{}", sort(parties), in_brackets(left.value, "m")),
                    hardly_forbidden(model, parties, rule).unwrap_or_else(|| {
                        "The gap is too small for the digits of a number: raise an exponent, a coefficient or d0, or \
                         reduce the speed."
                            .to_string()
                    }),
                )
            }
            Quantity::SpringLength { spring } => match model.springs()[spring].bodies() {
                Some(bodies) => {
                    let [one, other] = bodies.map(|body| model.name(body));
                    (
                        Reason::SpringCollapsed,
                        format!("the spring between bodies {one:?} and {other:?} has no length left"),
                        "Give it rest_length = 0 without damping, or other points.".to_string(),
                    )
                }
                None => {
                    // Those to anchors stand first.
                    let place = model.springs_of(left.body).position(|end| end.number == spring).unwrap_or(spring);
                    (
                        Reason::SpringCollapsed,
                        format!("spring {place} of body {body:?} has no length left"),
                        "Give it rest_length = 0 without damping, or another anchor.".to_string(),
                    )
                }
            },
            Quantity::BondLength { bond } => (
                Reason::SpringCollapsed,
                format!("the formula {} has no derivative where its points coincide", between(model, bond)),
                "Write a law with V′ = 0 at l = 0, or choose other points.".to_string(),
            ),
            Quantity::FluidGap { other } => (
                Reason::GapClosed,
                format!(
                    "the spheres {body:?} and {:?}, which feel each other through the fluid, touch{}",
                    model.name(other),
                    in_brackets(left.value, "m")
                ),
                "No force that is finite presses them together through the fluid, but a step may, and inertia of a \
                 fast one: start them apart, lower `rtol`, or give them a contact that holds them off."
                    .to_string(),
            ),
            Quantity::Stray => (
                Reason::Strayed,
                format!("body {body:?} has come {} m away from its place in the lattice", significant(left.value, 6)),
                "Which bodies meet across cells is listed by where they start: let them stay within half a cell of \
                 there beside one another, or write a larger cell that holds several."
                    .to_string(),
            ),
            Quantity::JointLimit { joint } => (
                Reason::GapClosed,
                {
                    let joint = &model.joints()[joint];
                    let unit = if joint.kind == JointKind::Hinge { "rad" } else { "m" };
                    format!("the joint {:?} reaches a limit{}", joint.name, in_brackets(left.value, unit))
                },
                "Its stop does not forbid that: raise its exponent, its coefficient or d0, or reduce the speed."
                    .to_string(),
            ),
            Quantity::Joints { joint } => (
                Reason::Locked,
                format!(
                    "the equations of the joint {:?} come to depend on those of others: a linkage is stretched out, \
                     folded or flat, where it is locked, or more than one motion goes on",
                    model.joints()[joint].name
                ),
                "End the run before, change the lengths so that the linkage does not reach such a place, start it \
                 elsewhere, or try another solver.rtol, 1e-6: a longer step may lead past it."
                    .to_string(),
            ),
            Quantity::Volume => (
                Reason::Inverted,
                format!("body {body:?} is flattened: det P has come down to {:.3e}", left.value),
                flattened::advice(model, left.body),
            ),
            Quantity::Resistance => (
                Reason::Unresisted,
                format!("nothing resists the motion of body {body:?}, which has no inertia"),
                "Give it `inclusion = { inertia = true }`, or look for sizes and viscosities out of all \
                    proportion.".to_string(),
            ),
            Quantity::Balance => (
                Reason::Unresisted,
                format!(
                    "no velocities are found at which body {body:?}, which has no inertia, is in balance: the last \
                     step towards them is {:.1e} of them",
                    left.value
                ),
                "Its friction is far beyond its bound where hardly anything else resists: leave out `mu`, or give it \
                 `inclusion = { inertia = true }`."
                    .to_string(),
            ),
            Quantity::Slenderness => (
                Reason::TooSlender,
                format!(
                    "body {body:?} is {:.1e} times as long as it is thick, beyond which its rates are not known",
                    left.value
                ),
                "The flow draws it out without end: end the run before, weaken the flow, or give it a stiffer material."
                    .to_string(),
            ),
            Quantity::Elements => (
                Reason::Unresolved,
                format!("the form of body {body:?} is too extreme for its boundary \
                    elements{}", by_estimate(left.value)),
                "Give it more `inclusion.triangles`, a mesh of more even triangles, or a stiffer material.".to_string(),
            ),
            Quantity::Interpolation => (
                Reason::Unresolved,
                format!(
                    "between the forms for which it was computed, the resistance of body {body:?} is wrong by {:.2e} of the power, \
                     more than inclusion.tolerance",
                    left.value
                ),
                "Give it a smaller `inclusion.spacing` (the error falls with its square), or a larger \
                    `inclusion.tolerance`."
                    .to_string(),
            ),
            Quantity::Formula { of, undefined } => {
                let formula = match of {
                    FormulaOf::Potential => "potential",
                    FormulaOf::BodyForce => "body_force",
                    FormulaOf::PointForce => "force",
                    FormulaOf::Friction => "linear_friction",
                    FormulaOf::Bond(_) => "formula",
                    FormulaOf::Joint(_) => "drive",
                };
                let whose = match of {
                    FormulaOf::Bond(bond) => between(model, bond),
                    FormulaOf::Joint(joint) => format!("of the joint {:?}", model.joints()[joint].name),
                    _ => format!("of body {body:?}"),
                };
                (
                    Reason::Undefined,
                    format!("the {formula} {whose} ends there: {undefined}"),
                    "Write a formula that is defined and smooth wherever the body goes.".to_string(),
                )
            }
            Quantity::Interruption => return Self::by_interruption(time),
            Quantity::Contraction => (
                Reason::Collapsed,
                format!("body {body:?} has contracted to nothing: det G has come down to {:e}", left.value),
                "The drive pulls it together without bound: give it a smaller or shorter drive, a larger \
                 contraction_viscosity, `isochoric = true`, or a prescribed contraction that stays above zero."
                    .to_string(),
            ),
        };
        Self { time, reason, body: Some(body), what, advice }
    }
}

/// What to do about a pair whose repulsion does not forbid its sharper feature to touch, or only just does.
fn hardly_forbidden(model: &Model, parties: [Party; 2], rule: usize) -> Option<String> {
    let features = parties.into_iter().filter_map(|party| model.solid_of(party)?.shape.sharpest_feature());
    let feature = features.max()?;
    let (exponent, critical) = (model.rules().all()[rule].laws.repulsion.exponent, feature.critical_exponent());
    let forbids = match exponent.partial_cmp(&critical)? {
        Ordering::Less => "does not forbid",
        Ordering::Equal => "only just forbids",
        Ordering::Greater => return None,
    };
    Some(format!(
        "A repulsion of exponent {exponent} {forbids} that they touch ({feature}): choose a larger exponent, more than \
         {critical}; or raise a coefficient or d0, or reduce the speed."
    ))
}

/// Softer contacts, as another way out; nothing where no body has one.
fn or_softer_contacts(model: &Model) -> &'static str {
    match (0..model.bodies.len()).any(|body| model.has_contact(body)) {
        true => ", or raise a coefficient or d0 of a contact, which makes impacts longer",
        false => "",
    }
}

/// What two parties are called together.
fn sort(parties: [Party; 2]) -> &'static str {
    if parties.iter().all(|party| party.body().is_some()) { "bodies" } else { "body and support" }
}

/// The gap in a unit, if the last attempt left one to tell.
fn in_brackets(gap: f64, unit: &str) -> String {
    if gap.is_finite() { format!(" (smallest gap tried {gap:e} {unit})") } else { String::new() }
}

/// The estimated error, if there is a matrix at all.
fn by_estimate(error: f64) -> String {
    if error.is_finite() { format!(", by their own estimate wrong by {error:.2e} of the power") } else { String::new() }
}

fn owner(model: &Model, index: usize) -> Option<String> {
    let body = model.blocks().iter().position(|block| block.contains(&index))?;
    Some(model.name(body).to_owned())
}

/// What limits a step, in words.
pub fn limit_in_words(model: &Model, limit: &Limit) -> String {
    match limit {
        Limit::Error { component } => accuracy_of(model, *component),
        Limit::Stability => "stiffness".into(),
        Limit::Domain => "a closing gap, or a body being flattened".into(),
        Limit::Newton => "the implicit equations".into(),
        Limit::MaxStep => "solver.max_step".into(),
        Limit::End => "an approaching support, or the end".into(),
    }
}

/// Whose accuracy a component of the state and the works stands for.
fn accuracy_of(model: &Model, component: usize) -> String {
    match owner(model, component) {
        Some(body) => format!("accuracy of {body:?}"),
        None => "accuracy of the ledger".into(),
    }
}
/// The bond of a number in words.
fn between(model: &Model, bond: usize) -> String {
    let [one, other] = model.bonds()[bond].bodies.map(|body| model.name(body));
    format!("of the bond between bodies {one:?} and {other:?}")
}
