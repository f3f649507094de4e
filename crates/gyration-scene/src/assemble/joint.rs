//! Joints, and the frames in which they are told.
//!
//! A hinge is at the angle by which the second is turned about the axis beside the first: zero where the axes of both
//! coincide. Of a start that turns otherwise too, it is the part about the axis.

use super::body::{AssembledBody, lever};
use super::context::SceneContext;
use super::motor::WrittenMotor;
use super::start::placement;
use super::support::{AssembledSupports, Begins};
use crate::check::{PartialScene, Placed, Reporter, SPACE, direction};
use crate::file::{self, JointWord};
use crate::key::Key;
use crate::quantity::si;
use gyration::joint::{Joint, JointKind, frame_beside, turned_about_axis};
use gyration::kinematics::{Placement, Quaternion};
use gyration::load::{Interaction, Party};
use gyration::state::Start;
use gyration::tensor::{Mat3, Vec3};
use std::collections::HashMap;
use std::sync::Arc;

/// Entries of a direction that differ by this part of the largest are equal.
const EQUAL: f64 = 1e-9;

/// A joint and where it stands in the file.
#[derive(Debug, Clone)]
pub(super) struct PlacedJoint {
    pub key: Key,
    pub joint: Joint,
    /// The distance of its points at the start \[m\].
    pub length: f64,
}

/// The joints; notes what is wrong with them.
pub(super) fn joints(
    partial: &PartialScene,
    (assembled, supports): (&[Option<AssembledBody>], &AssembledSupports),
    context: &SceneContext,
    reporter: &mut Reporter<'_>,
) -> Vec<PlacedJoint> {
    let name = |(index, body): (usize, &Option<AssembledBody>)| Some((body.as_ref()?.name.clone(), index));
    let named: HashMap<String, usize> = assembled.iter().enumerate().filter_map(name).collect();
    let mut joints = Vec::new();
    for Placed { key, value, .. } in &partial.joints {
        if partial.lattice.is_some() {
            let help = "leave out the lattice, or write a stiff spring or bond";
            reporter.note(key, "this version has no joints in a lattice", help);
            continue;
        }
        let ends = value.between.each_ref().map(|name| match named.get(name) {
            Some(&index) => Some(End { party: Party::Body(index), body: assembled[index].as_ref(), support: None }),
            None if name == SPACE => Some(End { party: Party::Space, body: None, support: None }),
            // A joint to a support is one to a place that moves as the support does.
            None => supports.begins(name).map(|begins| End { party: begins.party, body: None, support: Some(begins) }),
        });
        let [Some(one), Some(other)] = ends else { continue };
        // The checks have noted joints of one body to itself, and of none.
        if one.party == other.party || (one.body.is_none() && other.body.is_none()) {
            continue;
        }
        let is_constant = |end: &End| end.body.and_then(|own| own.body.affine()?.interior.kinetic).is_none();
        if ![&one, &other].into_iter().all(is_constant) {
            let message = "a joint asks for bodies of the kinetic energy ½ tr(Ṗ J Ṗᵀ)";
            reporter.note(key, message, "leave out one of the joint and `kinetic`");
            continue;
        }
        let joint = Written { key, value, ends: [one, other] }.joint(context, reporter);
        joints.extend(joint.map(|(joint, length)| PlacedJoint { key: key.clone(), joint, length }));
    }
    joints
}

/// Gives mass points that have none yet a size: the shortest of the distances that they keep, or of the sizes of what
/// they are on.
pub(super) fn give_sizes(assembled: &mut [Option<AssembledBody>], joints: &[PlacedJoint]) {
    // What one has got is a size for those that are on it.
    while give_sizes_once(assembled, joints) {}
}

/// The same of what has a size so far; whether any got one.
fn give_sizes_once(assembled: &mut [Option<AssembledBody>], joints: &[PlacedJoint]) -> bool {
    let sizes: Vec<f64> = assembled.iter().map(|body| body.as_ref().map_or(0.0, |own| own.body.size)).collect();
    let mut any = false;
    for (index, body) in assembled.iter_mut().enumerate() {
        let Some(own) = body.as_mut().filter(|own| own.body.size == 0.0) else { continue };
        let is_own = |placed: &&PlacedJoint| placed.joint.parties().contains(&Party::Body(index));
        let length = |PlacedJoint { joint, length, .. }: &PlacedJoint| match joint.kind {
            JointKind::Distance => *length,
            // The points of other kinds are apart by digits alone.
            JointKind::Ball | JointKind::Hinge | JointKind::Slider | JointKind::Weld => {
                let others = joint.parties().into_iter().filter_map(Party::body);
                others.map(|other| sizes[other]).fold(0.0, f64::max)
            }
        };
        let lengths = joints.iter().filter(is_own).map(length).filter(|length| *length > 0.0);
        let shortest = lengths.fold(f64::INFINITY, f64::min);
        if shortest.is_finite() {
            Arc::make_mut(&mut own.body).size = shortest;
            any = true;
        }
    }
    any
}

/// What a joint is at.
struct End<'a> {
    party: Party,
    /// None of space and of a support.
    body: Option<&'a AssembledBody>,
    support: Option<&'a Begins>,
}

/// A joint as it is written.
struct Written<'a> {
    key: &'a Key,
    value: &'a file::Joint,
    ends: [End<'a>; 2],
}

impl End<'_> {
    fn placement(&self) -> Placement {
        match (self.body, self.support) {
            (Some(body), _) => placement(&body.start),
            (None, Some(support)) => Placement { position: support.position, gradient: support.orientation.rotation() },
            (None, None) => Placement { position: Vec3::zeros(), gradient: Mat3::identity() },
        }
    }

    /// By how much a support has moved at the start \[m\].
    fn displacement(&self) -> Vec3 {
        self.support.map_or_else(Vec3::zeros, |support| support.motion.displacement(0.0))
    }

    /// How it is turned; none of one that deforms.
    fn orientation(&self) -> Option<Quaternion> {
        match self.body.map(|body| &body.start) {
            None => Some(self.support.map_or(Quaternion::IDENTITY, |support| support.orientation)),
            Some(Start::Rigid(start)) => Some(start.orientation),
            Some(Start::Affine(..) | Start::Contractile(..)) => None,
        }
    }
}

impl Written<'_> {
    /// The joint, and the distance of its points \[m\].
    fn joint(&self, context: &SceneContext, reporter: &mut Reporter<'_>) -> Option<(Joint, f64)> {
        let Self { key, value, ends } = self;
        let kind = match value.kind {
            JointWord::Ball => JointKind::Ball,
            JointWord::Hinge => JointKind::Hinge,
            JointWord::Slider => JointKind::Slider,
            JointWord::Weld => JointKind::Weld,
            JointWord::Distance => JointKind::Distance,
        };
        let points: [Vec3; 2] = value.points.each_ref().map(si);
        let axis = self.axis(kind, reporter);
        let can_be = [0, 1].map(|end| self.can_join(kind, &points[end], end, reporter));
        let (axis, true) = (axis?, can_be[0] && can_be[1]) else { return None };
        let anchored = [0, 1].map(|end| ends[end].placement().place(&points[end]));
        // An anchor may have left its place at the start.
        let places = [0, 1].map(|end| anchored[end] + ends[end].displacement());
        let length = (places[1] - places[0]).norm();
        if kind == JointKind::Distance && length == 0.0 {
            let [x, y, z] = places[0].into();
            let message = format!("both points are at [{x}, {y}, {z}]: a distance of zero has no direction");
            reporter.note(&key.key("points"), message, "write kind = \"ball\", or move a point");
            return None;
        }
        let frames = self.frames(&axis, kind);
        // What is no body is joined at its place in space, in the axes of space.
        let in_space = |end: usize| ends[end].body.is_none();
        let [first, second] = [0, 1].map(|end| match in_space(end) {
            true => ends[end].placement().gradient * frames[end],
            false => frames[end],
        });
        let points = [0, 1].map(|end| if in_space(end) { anchored[end] } else { points[end] });
        let [one, other] = [0, 1].map(|end| ends[end].party);
        let label = (value.name.as_str(), kind);
        let joint = match one {
            Party::Body(_) => Joint::new(label, [one, other], points, [first, second], length),
            Party::Support(_) | Party::SolidSupport(_) | Party::Space => {
                Joint::new(label, [other, one], [points[1], points[0]], [second, first], length).reversed()
            }
        };
        let motion = ends.iter().find_map(|end| end.support).map(|support| support.motion.clone());
        let joint = motion.into_iter().fold(joint, Joint::carried);
        let start = match kind {
            JointKind::Hinge => self.angle(&axis),
            _ => (places[1] - places[0]).dot(&(ends[0].placement().gradient * axis)),
        };
        let motor = WrittenMotor { key, value, kind, start }.motor(context, reporter)?;
        Some((joint.driven(motor), length))
    }

    /// The axis, in the axes of the first; of a joint without one any.
    fn axis(&self, kind: JointKind, reporter: &mut Reporter<'_>) -> Option<Vec3> {
        let key = self.key.key("axis");
        match (self.value.axis, kind.has_axis()) {
            (None, false) => Some(Vec3::z()),
            (Some(axis), true) => {
                let found = direction(&axis);
                if found.is_none() {
                    reporter.note(&key, "the axis is zero", "write a direction, [0, 0, 1]");
                }
                found
            }
            (None, true) => {
                let message = format!("a {} has an axis, and the key \"axis\" is missing", kind.word());
                reporter.note(&key, message, "write a direction in the axes of the first, axis = [0, 0, 1]");
                None
            }
            (Some(_), false) => {
                let message = format!("a joint of the kind \"{}\" has no axis", kind.word());
                reporter.note(&key, message, "leave it out, or write kind = \"hinge\" or \"slider\"");
                None
            }
        }
    }

    /// Whether a body can have such a joint at this point; notes it otherwise.
    fn can_join(&self, kind: JointKind, point: &Vec3, end: usize, reporter: &mut Reporter<'_>) -> bool {
        let Some(assembled) = self.ends[end].body else { return true };
        let (name, body) = (&assembled.name, &assembled.body);
        let key = self.key.key("between").index(end);
        if !body.has_inertia() {
            let message = format!("\"{name}\" has no inertia: this version has no joints of such bodies");
            reporter.note(&key, message, "use a spring, or let the body have inertia");
            return false;
        }
        if body.is_point() {
            lever(point, &self.key.key("points").index(end), reporter);
            if !matches!(kind, JointKind::Ball | JointKind::Distance) {
                let message = format!("\"{name}\" is a mass point, which does not turn: it has no {}", kind.word());
                reporter.note(&key, message, "write kind = \"ball\" or \"distance\", or give the body some width");
                return false;
            }
        }
        if body.affine().is_some() && matches!(kind, JointKind::Slider | JointKind::Weld) {
            let message = format!("\"{name}\" deforms: a {} of such a body has no one meaning", kind.word());
            let help = "join several of its points by balls, or make the body rigid";
            reporter.note(&key, message, help);
            return false;
        }
        true
    }

    /// The frames of both, a the axis: one in space at the angle zero. By which directions across the axis angles of
    /// bodies that deform are told, the first body says.
    fn frames(&self, axis: &Vec3, kind: JointKind) -> [Mat3; 2] {
        let [one, other] = [0, 1].map(|end| self.ends[end].placement().gradient);
        let in_space = one * axis;
        let (gradient, own) = match self.ends[0].body.is_some() {
            true => (one, *axis),
            false => (other, other.try_inverse().unwrap_or_else(Mat3::identity) * in_space),
        };
        // Of axes that are as little along it the first, whatever the rounding of a turn.
        let least = own.abs().min() + EQUAL * own.amax();
        let least = (0..3).find(|k| own[*k].abs() <= least).unwrap_or(0);
        let frame = frame_beside(&in_space, &gradient.column(least).into_owned());
        let angle = if kind == JointKind::Hinge { self.angle(axis) } else { 0.0 };
        // P of a body that starts has an inverse.
        let seen = |gradient: Mat3, frame: Mat3| gradient.try_inverse().unwrap_or_else(Mat3::identity) * frame;
        [seen(one, frame), seen(other, frame * turned_about_axis(angle))]
    }

    /// The part of the turn from the first to the second that is about an axis of the first \[rad\]; zero of bodies
    /// that deform.
    fn angle(&self, axis: &Vec3) -> f64 {
        let [Some(one), Some(other)] = [0, 1].map(|end| self.ends[end].orientation()) else { return 0.0 };
        let [w, x, y, z] = one.normalized().0;
        let [turned, rest @ ..] = Quaternion([w, -x, -y, -z]).times(&other).0;
        let along = Vec3::from(rest).dot(axis);
        // Twice the half angle, in (−π, π] whichever of two quaternions it is of.
        libm::atan2(2.0 * along * turned, turned * turned - along * along)
    }
}
