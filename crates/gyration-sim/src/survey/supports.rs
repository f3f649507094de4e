//! What the survey says of the supports themselves, beside what bodies have to do with them.

use crate::format::vector;
use gyration::model::Model;
use serde::Serialize;
use std::fmt::Write as _;

/// A support at the start.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SupportSurvey {
    /// Its name.
    pub name: String,
    /// A plane: a point of it and its unit normal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plane: Option<PlaneSurvey>,
    /// A solid: where its centre is [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solid_position: Option<[f64; 3]>,
    /// Whether it moves as prescribed.
    pub moves: bool,
}

/// A plane at the start.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlaneSurvey {
    /// A point of it [m].
    pub origin: [f64; 3],
    /// Its unit normal, towards the bodies.
    pub normal: [f64; 3],
}

impl SupportSurvey {
    /// The planes of a model, then the solids.
    pub fn all(model: &Model) -> Vec<Self> {
        let planes = model.supports.iter().map(|support| Self {
            name: support.name.clone(),
            plane: Some(PlaneSurvey { origin: support.origin.into(), normal: support.normal.into() }),
            solid_position: None,
            moves: !support.motion.is_fixed(),
        });
        let solids = model.solid_supports.iter().map(|support| Self {
            name: support.name.clone(),
            plane: None,
            solid_position: Some(support.start.position.into()),
            moves: !support.motion.is_fixed(),
        });
        planes.chain(solids).collect()
    }
}

/// The supports as text, a line each.
pub(super) fn write_supports(text: &mut String, supports: &[SupportSurvey]) {
    for SupportSurvey { name, plane, solid_position, moves } in supports {
        if let Some(PlaneSurvey { origin, normal }) = plane {
            let moves = if *moves { ", moves as prescribed" } else { "" };
            let (origin, normal) = (vector(origin), vector(normal));
            let _ = writeln!(text, "support    {name}: plane through {origin} m, normal {normal}{moves}");
        }
        if let Some(place) = solid_position {
            let moves = if *moves { "moves as prescribed" } else { "fixed" };
            let _ = writeln!(text, "support    {name}: a solid about {} m, {moves}", vector(place));
        }
    }
}
