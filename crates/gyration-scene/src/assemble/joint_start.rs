//! How joints start: places and velocities as they keep them, and equations that do not follow from others.
//!
//! A start that is off by digits is put right; one that is off by more is an error with the nearest that is right.

use super::constraint::rows;
use super::joint::PlacedJoint;
use crate::check::Reporter;
use gyration::balance::fastest_speed;
use gyration::body::BodyKind;
use gyration::dynamics::{Held, JointMisfit, Workspace};
use gyration::joint::{Joint, JointKind};
use gyration::load::{Interaction, Party};
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Vec3;

/// Places and velocities that agree to this part of sizes and speeds were meant to: ten digits are written.
const AGREEMENT: f64 = 1e-9;

/// Puts the first state right, or notes by how much it misses the joints; notes joints that are over-determined.
pub(super) fn check_start(model: &Model, state: &mut State, joints: &[PlacedJoint], reporter: &mut Reporter<'_>) {
    let mut workspace = Workspace::default();
    // A state outside the model is told where the run begins.
    let Ok(misfits) = workspace.joint_misfits(model, state) else { return };
    let mut nearest = state.clone();
    let mut held = Held { time: nearest.time, high: &mut nearest.bodies, low: &mut [] };
    if workspace.hold_places(model, &mut held).and_then(|_| workspace.hold_velocities(model, &mut held)).is_err() {
        nearest = state.clone();
    }
    let mut is_right = true;
    for (placed, misfit) in joints.iter().zip(&misfits) {
        let start = JointStart { model, placed, state };
        if !start.meets(misfit, reporter) || !start.moves(misfit, &nearest, reporter) {
            is_right = false;
        }
    }
    if !is_right {
        return;
    }
    if let Ok(Some(found)) = workspace.dependent_joint(model, state.time, state.numbers()) {
        let PlacedJoint { key, joint, .. } = &joints[found.joint];
        let (name, dependent, all) = (&joint.name, found.dependent, joint.rows().len());
        let message = format!(
            "the joint \"{name}\" is over-determined: {dependent} of its {all} equations follow from those of the \
             joints before it, or hold what is held already"
        );
        reporter.note(key, message, help_of_dependent(model, joint));
        return;
    }
    *state = nearest;
}

/// The fix for a joint that is over-determined.
fn help_of_dependent(model: &Model, joint: &Joint) -> &'static str {
    let bodies = || joint.parties().into_iter().filter_map(Party::body);
    if bodies().any(|body| model.bodies[body].pin.is_some()) {
        return "a pin holds a point already: leave the pin out and write a ball to \"space\" in its place, or leave the \
                joint out";
    }
    if bodies().any(|body| model.bodies[body].guide.is_some()) {
        return "`keep` holds directions already: leave `keep` out, which the hinges of a linkage in a plane do not need, \
                or write a kind that holds less";
    }
    match joint.kind {
        JointKind::Hinge => {
            "leave it out if the others hold the bodies; in a loop of hinges in a plane write in the place of this one two \
             distances, from its point on the one to two places of the other, in the plane and in different directions \
             (or balls in the place of two hinges, between which a link may spin)"
        }
        JointKind::Ball | JointKind::Slider | JointKind::Weld | JointKind::Distance => {
            "leave it out, or write a kind that holds less"
        }
    }
}

/// A joint and the state that it starts in.
struct JointStart<'a> {
    model: &'a Model,
    placed: &'a PlacedJoint,
    state: &'a State,
}

impl JointStart<'_> {
    fn bodies(&self) -> impl Iterator<Item = usize> {
        self.placed.joint.parties().into_iter().filter_map(Party::body)
    }

    /// Whether its places are right but for digits; notes it otherwise.
    fn meets(&self, misfit: &JointMisfit, reporter: &mut Reporter<'_>) -> bool {
        let Self { model, placed: PlacedJoint { key, joint, .. }, state } = self;
        let place = |end: usize| match joint.parties()[end] {
            Party::Body(body) => state.motion(model, body).placement.place(joint.point(end)),
            Party::Support(_) | Party::SolidSupport(_) | Party::Space => joint.anchor.at(state.time).0,
        };
        let reach = |end: usize| place(end).norm();
        let size = self.bodies().map(|body| model.bodies[body].size).fold(0.0, f64::max);
        // Rounding of places far from the origin stands beside it.
        if misfit.place <= AGREEMENT * size + 8.0 * f64::EPSILON * (reach(0) + reach(1)) {
            return true;
        }
        let [one, other] = [0, 1].map(|end| told(model, joint, end, &place(end)));
        let apart = place(1) - place(0);
        let body = self.bodies().next().unwrap_or_default();
        let position = state.motion(model, body).placement.position + apart;
        let ([x, y, z], name) = (<[f64; 3]>::from(position), model.name(body));
        let what = if joint.kind == JointKind::Slider { "are beside the axis, by" } else { "are apart by" };
        let message = format!(
            "the points of the joint \"{}\" {what} {:e} m at the start: {one}, {other}",
            joint.name, misfit.place
        );
        let help = format!("write position = [{x:?}, {y:?}, {z:?}] of \"{name}\", or other points");
        reporter.note(&key.key("points"), message, help);
        false
    }

    /// Whether its velocities are right but for digits; notes it otherwise.
    fn moves(&self, misfit: &JointMisfit, nearest: &State, reporter: &mut Reporter<'_>) -> bool {
        let Self { model, placed: PlacedJoint { key, joint, .. }, state } = self;
        let speed = |body: usize| fastest_speed(&model.bodies[body], &state.motion(model, body));
        let speed = self.bodies().map(speed).fold(0.0, f64::max);
        // Directions turn at a rate, points part at a speed: the larger of both scales.
        let size = self.bodies().map(|body| model.bodies[body].size).fold(f64::INFINITY, f64::min);
        // A support that turns round stands still but for the rounding of its speed.
        let carried = joint.anchor.motion.bound(&joint.anchor.start);
        let rounding = 8.0 * f64::EPSILON * carried.speed.max(carried.speed / size).max(carried.spin);
        if misfit.velocity <= AGREEMENT * speed.max(speed / size) + rounding {
            return true;
        }
        let message = format!(
            "the velocities of the start do not go with the joint \"{}\": it would part at {:e} m/s or 1/s",
            joint.name, misfit.velocity
        );
        let fixes: Vec<String> = self.bodies().map(|body| velocities(model, nearest, body)).collect();
        reporter.note(key, message, format!("the nearest that do: {}", fixes.join("; ")));
        false
    }
}

/// A point of a joint in words.
fn told(model: &Model, joint: &Joint, end: usize, place: &Vec3) -> String {
    let [x, y, z] = (*place).into();
    let whose = match joint.parties()[end] {
        Party::Space => "space".to_owned(),
        party => format!("{:?}", model.party_name(party)),
    };
    format!("that of {whose} at [{x:?}, {y:?}, {z:?}]")
}

/// The velocities of a body as a scene has them.
fn velocities(model: &Model, state: &State, body: usize) -> String {
    let motion = state.motion(model, body);
    let vector = |vector: Vec3| {
        let [x, y, z] = vector.into();
        format!("[{x:?}, {y:?}, {z:?}]")
    };
    let turns = match &model.bodies[body].kind {
        BodyKind::Rigid(_) => format!("angular_velocity = {}", vector(motion.angular_velocity())),
        BodyKind::Affine(_) | BodyKind::Contractile(_) => {
            format!("gradient_rate = {}", rows(&motion.velocity.gradient_rate))
        }
    };
    format!("velocity = {}, {turns} of {:?}", vector(motion.velocity.velocity), model.name(body))
}
