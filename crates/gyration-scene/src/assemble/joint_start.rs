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
use std::ops::Range;

/// Places and velocities that agree to this part of sizes and speeds were meant to: ten digits are written.
const AGREEMENT: f64 = 1e-9;

/// The rounding of places and speeds, as a part of them.
const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// The part of a speed below which a velocity is told as zero.
const NOTHING: f64 = 1e-12;
/// The velocities of no more bodies are told.
const MOST_TOLD: usize = 12;

/// Puts the first state right, or notes by how much it misses the joints; notes joints that are over-determined.
pub(super) fn check_start(model: &Model, state: &mut State, joints: &[PlacedJoint], reporter: &mut Reporter<'_>) {
    let mut workspace = Workspace::default();
    // A state outside the model is told where the run begins.
    let Ok(misfits) = workspace.joint_misfits(model, state) else { return };
    let starts = || joints.iter().map(|placed| JointStart { model, placed, state }).zip(&misfits);
    let met: Vec<bool> = starts().map(|(start, misfit)| start.meets(misfit, reporter)).collect();
    let are_met = met.iter().all(|met| *met);
    let nearest = nearest(&mut workspace, model, state);
    if are_met && let Ok(Some(found)) = workspace.dependent_joint(model, state.time, state.numbers()) {
        let PlacedJoint { key, joint, .. } = &joints[found.joint];
        let (name, dependent, all) = (&joint.name, found.dependent, joint.rows().len());
        let message = format!(
            "the joint \"{name}\" is over-determined: {dependent} of its {all} equations follow from those of the \
             joints before it, or hold what is held already"
        );
        reporter.note(key, message, help_of_dependent(model, joint));
        return;
    }
    // Velocities at other places than those meant say nothing.
    let of_met = starts().zip(&met).filter(|(_, met)| **met).map(|(start, _)| start);
    let parting = of_met.filter(|(start, misfit)| !start.moves(misfit, nearest.as_ref(), reporter)).count();
    if let Some(nearest) = nearest.filter(|_| are_met && parting == 0) {
        *state = nearest;
    }
}

/// The nearest state that goes with the joints; none where none is found.
fn nearest(workspace: &mut Workspace, model: &Model, state: &State) -> Option<State> {
    let mut nearest = state.clone();
    let mut held = Held { time: nearest.time, high: &mut nearest.bodies, low: &mut [] };
    workspace.hold_places(model, &mut held).and_then(|_| workspace.hold_velocities(model, &mut held)).ok()?;
    nearest.bodies.iter().all(|number| number.is_finite()).then_some(nearest)
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
        // Rounding of places far from the origin stands beside it. Directions are those of the start itself.
        if misfit.place <= AGREEMENT * size + ROUNDING * (reach(0) + reach(1)) {
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
    fn moves(&self, misfit: &JointMisfit, nearest: Option<&State>, reporter: &mut Reporter<'_>) -> bool {
        let Self { model, placed: PlacedJoint { key, joint, .. }, state } = self;
        let speed = |body: usize| fastest_speed(&model.bodies[body], &state.motion(model, body));
        let speed = self.bodies().map(speed).fold(0.0, f64::max);
        let size = self.bodies().map(|body| model.bodies[body].size).fold(f64::INFINITY, f64::min);
        // A support that turns round stands still but for the rounding of its speed. The rounding of the speed of a
        // fall by its own size is nothing for any body.
        let carried = joint.anchor.motion.bound(&joint.anchor.start);
        let falling = (model.gravity.norm() * size).sqrt();
        let velocity = AGREEMENT * speed + ROUNDING * falling.max(carried.speed);
        // Points part at a speed, directions turn at a rate.
        let spin = AGREEMENT * speed / size + ROUNDING * (falling / size).max(carried.spin);
        if misfit.velocity <= velocity && misfit.spin <= spin {
            return true;
        }
        let parts = match misfit.velocity > velocity {
            true => format!("it would part at {:e} m/s", misfit.velocity),
            false => format!("its directions would part at {:e} 1/s", misfit.spin),
        };
        let message = format!("the velocities of the start do not go with the joint \"{}\": {parts}", joint.name);
        let fix = match nearest {
            Some(nearest) => format!("the nearest that do: {}", self.fixes(nearest, speed.max(carried.speed))),
            None => "none that do were found near by: let the bodies start at rest, or leave joints out".to_owned(),
        };
        reporter.note(key, message, fix);
        false
    }

    /// The velocities of the nearest state, of its own bodies and of whatever else has others there.
    fn fixes(&self, nearest: &State, speed: f64) -> String {
        let Self { model, state, .. } = self;
        let is_own = |body: usize| self.bodies().any(|own| own == body);
        let is_other = |body: usize| {
            let slots = model.slots(body);
            let change = |numbers: Range<usize>| {
                let pairs = nearest.bodies[numbers.clone()].iter().zip(&state.bodies[numbers]);
                pairs.map(|(after, before)| (after - before).abs()).fold(0.0, f64::max)
            };
            let least = AGREEMENT * speed;
            change(slots.velocity()) > least || change(slots.rate()) > least / model.bodies[body].size
        };
        let told: Vec<usize> = (0..model.bodies.len()).filter(|body| is_own(*body) || is_other(*body)).collect();
        let mut fixes: Vec<String> =
            told.iter().take(MOST_TOLD).map(|body| velocities(model, nearest, *body, speed)).collect();
        if told.len() > MOST_TOLD {
            fixes.push(format!("and so on, of {} bodies more", told.len() - MOST_TOLD));
        }
        fixes.join("; ")
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

/// The velocities of a body as a scene has them, where a speed counts; what is rounding of it is zero.
fn velocities(model: &Model, state: &State, body: usize, speed: f64) -> String {
    let (motion, size) = (state.motion(model, body), model.bodies[body].size);
    let rounded = |number: f64, least: f64| if number.abs() > NOTHING * least { number } else { 0.0 };
    let vector = |vector: Vec3, least: f64| {
        let [x, y, z] = vector.map(|number| rounded(number, least)).into();
        format!("[{x:?}, {y:?}, {z:?}]")
    };
    let turns = match &model.bodies[body].kind {
        BodyKind::Rigid(_) if model.bodies[body].is_point() => String::new(),
        BodyKind::Rigid(_) => format!(", angular_velocity = {}", vector(motion.angular_velocity(), speed / size)),
        BodyKind::Affine(_) | BodyKind::Contractile(_) => {
            let rate = motion.velocity.gradient_rate.map(|number| rounded(number, speed / size));
            format!(", gradient_rate = {}", rows(&rate))
        }
    };
    format!("velocity = {}{turns} of {:?}", vector(motion.velocity.velocity, speed), model.name(body))
}
