//! Whether a law forbids a shape to touch: its exponent against that of the sharpest feature.
//!
//! The work against d^−ν diverges at contact iff ν ≥ 1 + p, where the area nearer than d grows as d^p; at ν = 1 + p
//! only as ln d, so that a body that is fast enough comes nearer than the digits of a number tell. The table of 1 + p
//! is that of `gyration::shape::Feature`. Source: `docs/theory-rigid.md`.

use crate::format::significant;
use gyration::contact::{ContactLaw, LawKind};
use gyration::shape::Shape;
use serde::Serialize;
use std::f64::consts::FRAC_1_SQRT_2;

/// What a law does when the body is pressed on the support.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LawSurvey {
    /// Its name in the scene.
    pub law: &'static str,
    /// ν; of adhesion the repulsive one.
    pub exponent: f64,
    /// The shape's sharpest feature.
    pub feature: Option<&'static str>,
    /// The least exponent that forbids this feature to touch.
    pub critical_exponent: Option<f64>,
    /// Whether the law does anything: its coefficient is not zero.
    pub acts: bool,
    /// Whether the law forbids touching; none for friction, which does not act along the normal.
    pub forbids_touching: Option<bool>,
    /// Whether it only just does: the work against it grows as the logarithm of the gap.
    pub only_just: bool,
    /// c = β/α of friction with the exponent of the repulsion: of the force N of that, friction is c N w at the slip w
    /// [s/m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strength: Option<f64>,
    /// μ, Coulomb's bound on friction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mu: Option<f64>,
    /// w₀ of one-sided damping [m/s].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub release: Option<f64>,
}

impl LawSurvey {
    /// The verdicts on laws that act together, for a shape.
    pub fn all(laws: &[ContactLaw], shape: &Shape) -> Vec<Self> {
        laws.iter().map(|law| Self { strength: strength(law, laws), ..Self::of(law, shape) }).collect()
    }

    /// The verdict on a law for a shape.
    fn of(law: &ContactLaw, shape: &Shape) -> Self {
        let feature = shape.sharpest_feature();
        let exponent = law.leading_exponent();
        let acts = law.terms().iter().flatten().any(|term| term.coefficient != 0.0);
        let forbids = |critical: f64| (law.kind() != LawKind::Friction).then_some(acts && exponent >= critical);
        let critical = feature.map(|feature| feature.critical_exponent());
        let forbids_touching = critical.and_then(forbids);
        Self {
            law: law.kind().name(),
            exponent,
            feature: feature.map(|feature| feature.name()),
            critical_exponent: critical,
            acts,
            forbids_touching,
            only_just: forbids_touching == Some(true) && critical == Some(exponent),
            strength: None,
            mu: law.mu(),
            release: law.release(),
        }
    }

    /// The touch-or-not verdict in words.
    pub(super) fn verdict(&self) -> String {
        let Self { law: name, exponent, .. } = self;
        let (Some(feature), Some(critical)) = (self.feature, self.critical_exponent) else {
            return format!("{name:<10} ν = {exponent}");
        };
        match self.forbids_touching {
            _ if !self.acts => format!("{name:<10} has no strength: does nothing"),
            Some(true) if self.only_just => format!(
                "{name:<10} ν = {exponent} = {critical} ({feature}): forbids touching only just, by a logarithm of the \
                 gap; a larger exponent forbids it"
            ),
            Some(true) => format!("{name:<10} ν = {exponent} ≥ {critical} ({feature}): forbids touching"),
            Some(false) => format!("{name:<10} ν = {exponent} < {critical} ({feature}): does not forbid touching"),
            None => {
                format!("{name:<10} ν = {exponent}: acts across the normal, forbids nothing{}", self.slipperiness())
            }
        }
    }

    /// What friction holds, in clauses.
    fn slipperiness(&self) -> String {
        let viscous = |c: &f64| format!("; as strong as the repulsion at a slip of {} m/s", significant(1.0 / c, 5));
        let creeps = |mu: f64, c: f64| {
            let (creep, part) = (significant(mu / c, 5), significant(FRAC_1_SQRT_2 * mu, 5));
            format!(", and what it holds creeps: at {creep} m/s where that is {part} of it")
        };
        match self.mu {
            None => self.strength.as_ref().map(viscous).unwrap_or_default(),
            Some(mu) => {
                let creep = self.strength.map(|c| creeps(mu, c)).unwrap_or_default();
                format!("; holds up to {} of the force of the repulsion{creep}", significant(mu, 5))
            }
        }
    }
}

/// c of a friction whose exponent is that of the repulsion beside it [s/m].
fn strength(law: &ContactLaw, laws: &[ContactLaw]) -> Option<f64> {
    let ContactLaw::Friction(_) = law else { return None };
    let [friction, ..] = law.terms();
    let repulsion = laws.iter().find(|law| law.kind() == LawKind::Repulsion)?;
    let [repulsion, ..] = repulsion.terms();
    let (friction, repulsion) = (friction?, repulsion?);
    let acts = friction.coefficient > 0.0 && repulsion.coefficient > 0.0;
    (acts && friction.exponent == repulsion.exponent).then(|| friction.coefficient / repulsion.coefficient)
}
