//! Bodies between planes that close on them: nothing gives way, and the run has no end.
//!
//!   s(t) = d₁(p, t) + d₂(p, t),   planes of opposite normals, whatever the point p
//!
//! Where s falls below the least width w of a rigid body its gaps vanish, and its swings between the planes become
//! faster without end: steps go with (s − w)³ for a repulsion of exponent 6, so that no number of them gets there.

use super::Island;
use crate::format::significant;
use crate::outcome::{Reason, Stop};
use gyration::body::{Body, BodyKind};
use gyration::kinematics::Placement;
use gyration::model::Model;
use gyration::shape::{Capsule, Cuboid, Cylinder, Ellipsoid, Shape, Sphere, Torus};
use gyration::tensor::Vec3;
use gyration_ode::StepReport;

/// Steps shorter than this part of the time that is left until the room is used up do not get there: where they go with
/// the third power of what is left, some 1/(2 · 1e-5) have been made by then.
const SHORT: f64 = 1e-5;
/// The room that a body has is looked at where it is below this part of its size.
const NARROW: f64 = 1e-2;
/// Nor where it is nearer to one of them than this part of the room: a bounce is short for another reason.
const BESIDE: f64 = 0.05;
/// Normals whose sum is below this are opposite.
const OPPOSITE: f64 = 1e-12;

/// A body between two planes that will leave it no room.
struct Pressed {
    body: usize,
    supports: [usize; 2],
    /// When there is none left \[s\].
    until: f64,
}

impl Island {
    /// Tests whether short steps are those of a body for which there will soon be no room.
    pub(super) fn check_presses(&self, report: &StepReport, end: f64) -> Result<(), Stop> {
        let (model, time, span) = (self.model(), report.end, report.end - report.start);
        if span > SHORT * (end - time) || model.supports.iter().all(|support| support.motion.is_fixed()) {
            return Ok(());
        }
        let placement = |body: usize| &self.step_ends[body].motion.placement;
        let found = (0..model.bodies.len()).find_map(|body| pressed(model, (body, placement(body)), time, end));
        match found.filter(|found| span < SHORT * (found.until - time)) {
            None => Ok(()),
            Some(pressed) => Err(pressed.stop(model, time)),
        }
    }
}

impl Pressed {
    fn stop(&self, model: &Model, time: f64) -> Stop {
        let [one, other] = self.supports.map(|support| &model.supports[support].name);
        let body = model.name(self.body);
        Stop {
            time,
            reason: Reason::GapClosed,
            body: Some(body.to_owned()),
            what: format!(
                "the supports {one:?} and {other:?} close on body {body:?}, which is rigid: they leave it no room from \
                 t = {} s on",
                significant(self.until, 6)
            ),
            advice:
                "Let them stop or turn back before, end the run there, or make the body an affine one, which gives \
                     way."
                    .into(),
        }
    }
}

/// The two planes that leave a body no room before the end of a run, where it has next to none now.
fn pressed(model: &Model, (body, placement): (usize, &Placement), time: f64, end: f64) -> Option<Pressed> {
    let width = least_width(&model.bodies[body])?;
    let surface = model.bodies[body].solid.surface.as_ref()?;
    let touched = || model.contacts_of(body).map(|contact| contact.support);
    let two = touched().flat_map(|one| touched().filter(move |other| one < *other).map(move |other| [one, other]));
    two.filter_map(|supports| {
        let [one, other] = supports.map(|support| &model.supports[support]);
        let room = |time: f64| one.gap(&Vec3::zeros(), time) + other.gap(&Vec3::zeros(), time) - width;
        let [first, second] = [one, other].map(|support| support.at(time).normal);
        let are_parallel = (first + second).norm() < OPPOSITE && !one.motion.turns() && !other.motion.turns();
        let now = room(time);
        let closing = one.motion.velocity(time).dot(&first) + other.motion.velocity(time).dot(&second);
        if !are_parallel || closing <= 0.0 || now <= 0.0 || now > NARROW * model.bodies[body].size {
            return None;
        }
        let gaps = [one, other].map(|support| surface.smallest_gap(&support.gap_field(placement, time)).0);
        if gaps[0].min(gaps[1]) < BESIDE * now {
            return None;
        }
        let until = time + now / closing;
        // Planes that turn back do so before twice the time.
        (until < end && room(end.min(time + 2.0 * (until - time))) <= 0.0).then_some(Pressed { body, supports, until })
    })
    .min_by(|a, b| a.until.total_cmp(&b.until))
}

/// The least distance of two parallel planes between which a rigid body of a simple shape fits \[m\]; none of others.
fn least_width(body: &Body) -> Option<f64> {
    if !matches!(body.kind, BodyKind::Rigid(_)) {
        return None;
    }
    match &body.solid.shape {
        Shape::Box(Cuboid { size }) => Some(size.min()),
        Shape::Sphere(Sphere { radius }) => Some(2.0 * radius),
        Shape::Ellipsoid(Ellipsoid { semi_axes }) => Some(2.0 * semi_axes.min()),
        Shape::Cylinder(Cylinder { radius, height }) => Some(height.min(2.0 * radius)),
        Shape::Capsule(Capsule { radius, .. }) => Some(2.0 * radius),
        Shape::Torus(Torus { minor_radius, .. }) => Some(2.0 * minor_radius),
        Shape::Cone(_) | Shape::Polyhedron(_) | Shape::Union(_) | Shape::Points(_) => None,
    }
}
