//! What is recorded of a joint.

use super::super::Scratch;
use super::{Room, jets};
use crate::instant::{Instant, second};
use crate::load::Interaction;
use crate::tensor::Vec3;

/// What is recorded of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointObservation {
    /// The place of its point on the first party that the scene names \[m\].
    pub place: Vec3,
    /// The force on the first party that the scene names \[N\].
    pub force: Vec3,
    /// The torque on it about its point \[N m\].
    pub torque: Vec3,
    /// Of a hinge \[rad\].
    pub angle: Option<f64>,
    /// Of a distance and a slider \[m\].
    pub distance: Option<f64>,
    /// The largest misfit of its equations: of lengths \[m\], of directions.
    pub misfit: f64,
}

/// What is recorded of a joint at an instant whose forces are known.
pub fn observe_joint(instant: &Instant, scratch: &Scratch, number: usize) -> JointObservation {
    let model = instant.model();
    let joint = &model.joints()[number];
    let at = |body: usize| instant.motions().at(model, body);
    let jets = match &scratch.joints.room {
        Some(Room { graph, .. }) => jets(joint, &scratch.joints.members, graph, second(joint, at)),
        None => unreachable!("an instant of a model with joints has solved for them"),
    };
    let end = usize::from(joint.is_reversed);
    let [force, torque] = joint.wrench(&jets, instant.joint(number), end);
    let place = match joint.parties()[end].body() {
        Some(body) => at(body).motion.placement.place(joint.point(end)),
        None => joint.anchor.at(instant.motions().time()).0,
    };
    JointObservation {
        place,
        force,
        torque,
        angle: joint.angle(&jets),
        distance: joint.distance(&jets),
        misfit: joint.rows().iter().map(|row| row.value(&jets).abs()).fold(0.0, f64::max),
    }
}
