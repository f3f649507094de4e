//! What the survey says of each body: beside every support, and where it rests.

use super::cell;
use super::joints::{JointSurvey, LinkageSurvey};
use super::kind::KindSurvey;
use super::laws::LawSurvey;
use super::mass::MassSurvey;
use super::meetings::{MeetingSurvey, Meetings};
use super::modes::{RestState, SystemRestState};
use super::rest::{Approach, RestGap};
use super::softness::SoftnessSurvey;
use super::springs::SpringSurvey;
use super::supports::SupportSurvey;
use crate::plan::RunPlan;
use crate::resistance::completed;
use crate::survey::remarks::Remarks;
use crate::wall_time::within_wall_time;
use gyration::body::Body;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::Components;
use gyration_scene::{Scene, SceneErrors};
use serde::Serialize;
use serde_json::{Value, json};
use std::borrow::Cow;
use std::sync::Arc;

/// What can be said of a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Survey {
    /// The bodies, in order.
    pub bodies: Vec<BodySurvey>,
    /// The supports, planes first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub supports: Vec<SupportSurvey>,
    /// The joints, in order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<JointSurvey>,
    /// The bodies that joints join, and how many freedoms are left to them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub linkages: Vec<LinkageSurvey>,
    /// The springs between bodies, in order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub springs: Vec<SpringSurvey>,
    /// The bodies that meet; of a lattice those of one cell with each other and with images.
    pub meetings: Vec<MeetingSurvey>,
    /// How soft the laws of a crowd are, where softer ones cost less.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub softness: Vec<SoftnessSurvey>,
    /// How many meetings there are, and how many pairs of bodies feel each other however far they are.
    #[serde(skip)]
    pub pairs: [usize; 2],
    /// What must be told of the scene besides.
    #[serde(flatten)]
    pub remarks: Remarks,
}

/// What can be said of one body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BodySurvey {
    /// Its name.
    pub name: String,
    /// The largest side of its bounding box [m].
    pub size: f64,
    /// How it may deform, and what it is made of.
    pub kind: KindSurvey,
    /// Mass properties.
    pub mass: MassSurvey,
    /// Where a body that deforms rests, how much it is deformed there, and how it moves about that state.
    pub rest_state: Option<RestState>,
    /// Why a body that deforms has no rest state, in words.
    pub no_rest_state_because: Option<String>,
    /// What it has to do with each support; empty for mass points.
    pub supports: Vec<PairSurvey>,
}

/// What can be said of a body and a support.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairSurvey {
    /// Name of the support.
    pub support: String,
    /// Smallest distance at the start [m].
    pub initial_gap: f64,
    /// The part of the weight that presses on the support, −m g·n [N].
    pub weight: f64,
    /// The laws between the two; empty if they do not act on each other.
    pub laws: Vec<LawSurvey>,
    /// Whether one of the laws forbids touching.
    pub forbids_touching: bool,
    /// Gaps at which the central laws carry the weight, ascending: with the orientation of the start, and with its P if
    /// the body deforms.
    pub rests: Vec<RestGap>,
    /// Why no such gap is given, in words: something else holds the body too.
    pub no_rest_because: Option<&'static str>,
}

/// The rest states of a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SceneModes {
    /// Those of bodies on which no other acts; of the others what they are.
    pub bodies: Vec<BodyModes>,
    /// Those of bodies that springs, bonds, joints or contacts join.
    pub systems: Vec<SystemModes>,
}

/// Where one body rests, and how it moves about that state.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BodyModes {
    /// Its name.
    pub name: String,
    /// How it may deform, and what it is made of.
    pub kind: KindSurvey,
    /// The number of the system of which it is a member.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub system: Option<usize>,
    /// Its rest state, with the modes; none of a member of a system.
    pub rest_state: Option<RestState>,
    /// Why it has none, in words.
    pub no_rest_state_because: Option<String>,
}

/// Where the bodies of a system rest together, and how they move about that state.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SystemModes {
    /// Their names.
    pub bodies: Vec<String>,
    /// Why it has no rest state, in words.
    pub no_rest_state_because: Option<String>,
    /// Its rest state, with the modes.
    pub rest_state: Option<SystemRestState>,
}

/// The modes of every body and system of a scene.
pub fn modes(scene: &Scene) -> SceneModes {
    let built = scene.built();
    let carried = cell::at_rest(built);
    // In cells that find no rest no body does.
    let is_at_rest = carried.as_ref().map_err(String::clone);
    let (model, start) = match &carried {
        Ok(Some((model, start))) => (model, start),
        Ok(None) | Err(_) => (&built.model, &built.state),
    };
    let systems = systems(model);
    let of = |(index, body): (usize, &Arc<Body>)| {
        let system = systems.iter().position(|members| members.binary_search(&index).is_ok());
        let found = || is_at_rest.clone().and_then(|_| RestState::of(model, start, index));
        let alone = system.is_none().then(|| told(found()));
        let (rest_state, no_rest_state_because) = alone.unwrap_or_default();
        BodyModes {
            name: model.name(index).to_owned(),
            kind: KindSurvey::of(body),
            system,
            rest_state,
            no_rest_state_because,
        }
    };
    let bodies = model.bodies.iter().enumerate().map(of).collect();
    let joint = |members: &Vec<usize>| {
        let found = match members.len() {
            many if many > MOST_MEMBERS => Err(format!(
                "{many} bodies hang together; rest states are found of {MOST_MEMBERS} at most: join fewer, or give \
                 contacts between them a reach"
            )),
            _ => is_at_rest.clone().and_then(|_| SystemRestState::of(model, start, members)),
        };
        let (rest_state, no_rest_state_because) = told(found);
        let bodies = members.iter().map(|body| model.name(*body).to_owned()).collect();
        SystemModes { bodies, no_rest_state_because, rest_state }
    };
    SceneModes { bodies, systems: systems.iter().map(joint).collect() }
}

/// The matrices of a search have the square of the number of coordinates, and it solves with them some hundred times.
const MOST_MEMBERS: usize = 100;

/// The sets of bodies that springs, bonds, joints or contacts join, each ascending; in a lattice one may be joined to
/// its own images alone.
fn systems(model: &Model) -> Vec<Vec<usize>> {
    let acting = |pair: &[usize; 2]| pair.iter().all(|body| model.is_joined(*body));
    let joined = Components::joined(model.bodies.len(), model.chain().filter(acting));
    let acts = |members: &&[usize]| members.iter().any(|body| model.is_joined(*body));
    joined.iter().filter(acts).map(<[usize]>::to_vec).collect()
}

/// What `gyration modes --json` prints of a scene.
pub fn modes_in_json(scene: &Scene) -> Value {
    let SceneModes { bodies, systems } = modes(scene);
    json!({ "scene": scene.name(), "bodies": bodies, "systems": systems })
}

/// What was found, or why it was not.
fn told<T>(found: Result<T, String>) -> (Option<T>, Option<String>) {
    match found {
        Ok(state) => (Some(state), None),
        Err(reason) => (None, Some(reason)),
    }
}

impl Survey {
    /// The survey of a scene in its first state. Only the rest state of a body that deforms takes its resistance in the
    /// fluid. What takes longer than a run may is given up.
    ///
    /// # Errors
    /// Why a surface has no resistance.
    pub fn of(scene: &Scene) -> Result<Self, SceneErrors> {
        within_wall_time(scene, || Self::whole(scene))
    }

    fn whole(scene: &Scene) -> Result<Self, SceneErrors> {
        let deforms = scene.unknown_forms().iter().any(|form| form.resolution.is_some());
        let scene = if deforms || scene.built().waves.is_some() { completed(scene)? } else { Cow::Borrowed(scene) };
        let (model, start) = (&scene.built().model, &scene.built().state);
        let bodies: Vec<_> = (0..model.bodies.len()).map(|index| survey_body(model, start, index)).collect();
        let cells = model.bodies.len() / scene.file().body.len().max(1);
        let Meetings { told: meetings, counts: pairs } = Meetings::of(model, start, cells);
        Ok(Self {
            softness: SoftnessSurvey::all(&scene, nearest(&bodies, &meetings)),
            bodies,
            supports: SupportSurvey::all(model),
            joints: JointSurvey::all(model, start),
            linkages: LinkageSurvey::all(model, start),
            springs: SpringSurvey::all(model, start),
            meetings,
            pairs,
            remarks: Remarks::at_start(model, start, &RunPlan::from(scene.built())),
        })
    }
}

fn survey_body(model: &Model, start: &State, index: usize) -> BodySurvey {
    let body = &model.bodies[index];
    let pair = |support: usize| {
        let approach = Approach::new(model, start, index, support)?;
        let contacts = model.contacts_of(index).filter(|contact| contact.support == support);
        let laws: Vec<LawSurvey> =
            contacts.flat_map(|contact| LawSurvey::all(contact.law_set.laws(), &body.solid.shape)).collect();
        Some(PairSurvey {
            support: model.supports[support].name.clone(),
            initial_gap: approach.initial_gap,
            weight: approach.weight,
            forbids_touching: laws.iter().any(|law| law.forbids_touching == Some(true)),
            laws,
            rests: approach.rests(),
            no_rest_because: approach.no_rest_because,
        })
    };
    let deforms = body.affine().is_some();
    let (rest_state, no_rest_state_because) =
        if deforms { told(RestState::of(model, start, index)) } else { (None, None) };
    BodySurvey {
        name: model.name(index).to_owned(),
        size: body.size,
        kind: KindSurvey::of(body),
        rest_state,
        no_rest_state_because,
        mass: MassSurvey::of(&body.solid.mass),
        supports: (0..model.supports.len()).filter_map(pair).collect(),
    }
}

/// The least gap at the start [m].
fn nearest(bodies: &[BodySurvey], meetings: &[MeetingSurvey]) -> f64 {
    let supports = bodies.iter().flat_map(|body| &body.supports).filter(|pair| !pair.laws.is_empty());
    let gaps = supports.map(|pair| pair.initial_gap).chain(meetings.iter().filter_map(|meeting| meeting.initial_gap));
    gaps.fold(f64::INFINITY, f64::min)
}
