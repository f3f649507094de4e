//! Whether a law forbids a shape to touch: its exponent against that of the sharpest feature.
//!
//! The work against d^−ν diverges at contact iff ν ≥ 1 + p, where the area nearer than d grows as d^p. The table of 1 +
//! p is that of `gyration::shape::Feature`. Source: `physics.md` §3.

use gyration::contact::{ContactLaw, LawKind};
use gyration::shape::Shape;
use serde::Serialize;

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
}

impl LawSurvey {
    /// The verdict on a law for a shape.
    pub fn of(law: &ContactLaw, shape: &Shape) -> Self {
        let feature = shape.sharpest_feature();
        let exponent = law.leading_exponent();
        let acts = law.terms().iter().flatten().any(|term| term.coefficient != 0.0);
        let forbids = |critical: f64| (law.kind() != LawKind::Friction).then_some(acts && exponent >= critical);
        let critical = feature.map(|feature| feature.critical_exponent());
        Self {
            law: law.kind().name(),
            exponent,
            feature: feature.map(|feature| feature.name()),
            critical_exponent: critical,
            acts,
            forbids_touching: critical.and_then(forbids),
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
            Some(true) => format!("{name:<10} ν = {exponent} ≥ {critical} ({feature}): forbids touching"),
            Some(false) => format!("{name:<10} ν = {exponent} < {critical} ({feature}): does not forbid touching"),
            None => format!("{name:<10} ν = {exponent}: acts across the normal, forbids nothing"),
        }
    }
}
