//! What the survey says of the springs between bodies: how long they are, and how fast they swing.
//!
//!   T = 2π √(μ/k),   ζ = c/(2 √(kμ)),   1/μ = 1/m₁ + 1/m₂
//!
//! of two free bodies on the line of the spring; what else holds or turns them makes it another period.

use crate::format::significant;
use gyration::load::Spring;
use gyration::model::Model;
use gyration::state::State;
use serde::Serialize;
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// Springs that are told one by one.
const MOST: usize = 12;

/// What can be said of a spring between two bodies.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpringSurvey {
    /// Names of its bodies.
    pub between: [String; 2],
    /// k [N/m].
    pub stiffness: f64,
    /// l₀ [m].
    pub rest_length: f64,
    /// l at the start [m].
    pub initial_length: f64,
    /// T [s]; none without stiffness, or without inertia of both.
    pub period: Option<f64>,
    /// ζ; none without stiffness or without a dashpot.
    pub damping_ratio: Option<f64>,
}

impl SpringSurvey {
    /// The springs between the bodies of a model, in order.
    pub fn all(model: &Model, start: &State) -> Vec<Self> {
        model.springs().iter().filter_map(|spring| Self::of(model, start, spring)).collect()
    }

    /// Of one between two bodies; none of others.
    fn of(model: &Model, start: &State, spring: &Spring) -> Option<Self> {
        let (law, bodies) = (spring.law, spring.bodies()?);
        let [m, n] = bodies.map(|body| model.bodies[body].solid.mass.mass);
        let reduced = m * n / (m + n);
        // Without inertia nothing swings.
        let swings = law.stiffness > 0.0 && bodies.iter().all(|body| model.bodies[*body].has_inertia());
        let period = swings.then(|| TAU * (reduced / law.stiffness).sqrt());
        let damped = period.filter(|_| law.damping > 0.0);
        Some(Self {
            between: bodies.map(|body| model.name(body).to_owned()),
            stiffness: law.stiffness,
            rest_length: law.rest_length,
            initial_length: spring.length(&model.lattice, |body| start.motion(model, body).placement),
            period,
            damping_ratio: damped.map(|_| law.damping / (2.0 * (law.stiffness * reduced).sqrt())),
        })
    }
}

/// The springs as text, a line each.
pub(super) fn write_springs(text: &mut String, springs: &[SpringSurvey]) {
    let short = |value: f64| significant(value, 5);
    for spring in springs.iter().take(MOST) {
        let [one, other] = &spring.between;
        let (stiffness, rest, length) =
            (short(spring.stiffness), short(spring.rest_length), short(spring.initial_length));
        let period = spring.period.map(|period| format!("; period {} s", short(period))).unwrap_or_default();
        let ratio = spring.damping_ratio.map(|ratio| format!(", damping ratio {}", short(ratio))).unwrap_or_default();
        let _ = writeln!(
            text,
            "spring     {one} to {other}: {stiffness} N/m, {rest} m without force, \
             {length} m at the start{period}{ratio}"
        );
    }
    if springs.len() > MOST {
        let _ = writeln!(text, "           and {} springs more: all with --json", springs.len() - MOST);
    }
}
