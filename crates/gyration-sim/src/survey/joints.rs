//! What the survey says of joints, and of the freedoms that they leave to the bodies that they join.
//!
//!   freedoms = Σ (coordinates of a body) − equations
//!
//! A scene whose equations follow from one another has been refused: their rank is their number.

use crate::format::significant;
use crate::modes::coordinate_count;
use gyration::dynamics::{JointObservation, Workspace, observe_joint};
use gyration::joint::Joint;
use gyration::load::{Interaction, Party};
use gyration::model::Model;
use gyration::state::State;
use serde::Serialize;
use std::fmt::Write as _;

/// Joints and linkages that are told one by one.
const MOST: usize = 12;
/// Bodies of a linkage that are named.
const MOST_NAMED: usize = 8;

/// What can be said of a joint.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointSurvey {
    /// Its name.
    pub name: String,
    /// "ball", "hinge", "slider", "weld" or "distance".
    pub kind: &'static str,
    /// Names of its bodies, or of one and a support or "space", as the scene has them.
    pub between: [String; 2],
    /// How many equations it has.
    pub equations: usize,
    /// Of a hinge, at the start [rad].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
    /// Of a distance and a slider, at the start [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
    /// Between which a stop keeps it [rad] or [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limits: Option<[f64; 2]>,
    /// Whether a drive acts.
    pub driven: bool,
}

/// What can be said of bodies that joints join, or of one that they join to space.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LinkageSurvey {
    /// Names of the bodies.
    pub bodies: Vec<String>,
    /// How many coordinates they would have without joints.
    pub coordinates: usize,
    /// How many equations their joints have.
    pub equations: usize,
    /// How many freedoms are left.
    pub freedoms: usize,
}

impl JointSurvey {
    /// The joints of a model, in order.
    pub fn all(model: &Model, start: &State) -> Vec<Self> {
        let mut workspace = Workspace::default();
        let seen: Vec<JointObservation> = match workspace.read(model, start) {
            // A start outside the model has been refused.
            Err(_) => Vec::new(),
            Ok((instant, scratch)) => {
                (0..model.joints().len()).map(|number| observe_joint(&instant, scratch, number)).collect()
            }
        };
        let of = |(number, joint): (usize, &Joint)| {
            let mut between = joint.parties().map(|party| match party {
                Party::Space => "space".to_owned(),
                party => model.party_name(party).to_owned(),
            });
            if joint.is_reversed {
                between.reverse();
            }
            Self {
                name: joint.name.to_string(),
                kind: joint.kind.word(),
                between,
                equations: joint.rows().len(),
                angle: seen.get(number).and_then(|seen| seen.angle),
                distance: seen.get(number).and_then(|seen| seen.distance),
                limits: joint.motor.stop.map(|stop| stop.limits),
                driven: joint.motor.drive.is_some(),
            }
        };
        model.joints().iter().enumerate().map(of).collect()
    }
}

impl LinkageSurvey {
    /// The linkages of a model, in order.
    pub fn all(model: &Model, start: &State) -> Vec<Self> {
        let Some(graph) = model.joint_graph() else { return Vec::new() };
        let of = |places: &Vec<usize>| {
            let bodies: Vec<usize> = places.iter().map(|place| graph.bodies[*place]).collect();
            let coordinates = bodies.iter().map(|body| coordinate_count(model, start, *body)).sum();
            // A joint is counted at the first of its bodies.
            let own = places.iter().flat_map(|place| graph.joints_of[*place].iter()).filter(|(_, end)| *end == 0);
            let equations = own.map(|(joint, _)| model.joints()[*joint].rows().len()).sum();
            Self {
                bodies: bodies.iter().map(|body| model.name(*body).to_owned()).collect(),
                coordinates,
                equations,
                freedoms: coordinates.saturating_sub(equations),
            }
        };
        graph.linkages.iter().map(of).collect()
    }
}

/// Joints and linkages as text, a line each.
pub(super) fn write_joints(text: &mut String, joints: &[JointSurvey], linkages: &[LinkageSurvey]) {
    for joint in joints.iter().take(MOST) {
        let JointSurvey { name, kind, between: [one, other], .. } = joint;
        let equations = counted(joint.equations, "equation");
        let at = |value: Option<f64>, unit: &str| value.map(|value| format!(", {} {unit}", significant(value, 5)));
        let place = at(joint.angle, "rad").or(at(joint.distance, "m"));
        let place = place.map(|place| format!("{place} at the start")).unwrap_or_default();
        let unit = if *kind == "hinge" { "rad" } else { "m" };
        let limits = joint
            .limits
            .map(|[low, high]| format!(", stopped at {} and {} {unit}", significant(low, 5), significant(high, 5)));
        let driven = if joint.driven { ", driven" } else { "" };
        let limits = limits.unwrap_or_default();
        let _ = writeln!(text, "joint      {name}: {kind} of {one} and {other}, {equations}{place}{limits}{driven}");
    }
    if joints.len() > MOST {
        let _ = writeln!(text, "           and {} joints more: all with --json", joints.len() - MOST);
    }
    for linkage in linkages.iter().take(MOST) {
        let LinkageSurvey { bodies, coordinates, equations, freedoms } = linkage;
        let named = bodies.iter().take(MOST_NAMED).map(String::as_str).collect::<Vec<_>>().join(", ");
        let more = match bodies.len().saturating_sub(MOST_NAMED) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let (coordinates, equations) = (counted(*coordinates, "coordinate"), counted(*equations, "equation"));
        let left = match freedoms {
            0 => "nothing free".to_owned(),
            some => counted(*some, "freedom"),
        };
        let _ = writeln!(text, "linkage    {named}{more}: {coordinates} less {equations} leave {left}");
    }
    if linkages.len() > MOST {
        let _ = writeln!(text, "           and {} linkages more: all with --json", linkages.len() - MOST);
    }
}

fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
