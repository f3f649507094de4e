//! A body: shape, mass, surface about the centre of mass, kind, springs, pin, guide, and how it starts.

use super::context::SceneContext;
use super::fluid::ImmersedBody;
use super::guide::guide;
use super::kind::WrittenDeformation;
use super::mass::{MassSource, lone_point, size};
use super::own::OwnForcesWritten;
use super::shape::ShapeBuilder;
use super::solids::Solids;
use super::start::{WrittenPlacement, placement};
use super::support;
use crate::check::{Placed, Reporter};
use crate::file::Body;
use crate::key::Key;
use crate::quantity::si;
use crate::units::shown;
use gyration::body::{Body as Moving, BodyKind, Pin, RigidInertia};
use gyration::kinematics::Placement;
use gyration::load::{Anchor, Spring, SpringLaw};
use gyration::shape::Shape;
use gyration::state::Start;
use gyration::tensor::Vec3;
use std::sync::Arc;

/// A body of the model and how it starts.
#[derive(Debug, Clone)]
pub(super) struct AssembledBody {
    pub(super) name: String,
    pub(super) body: Arc<Moving>,
    pub(super) start: Start,
    /// Its springs to anchors, of the body's number in the scene.
    pub(super) springs: Vec<Spring>,
}

impl AssembledBody {
    /// Builds a body, without its contacts; notes what is wrong with it.
    pub(super) fn new(
        placed: &Placed<Body>,
        context: &SceneContext,
        solids: &mut Solids,
        reporter: &mut Reporter<'_>,
    ) -> Option<Self> {
        let Placed { key, value, .. } = placed;
        let deforming = WrittenDeformation::of(placed, context, reporter);
        let own = OwnForcesWritten::of(placed, context, reporter);
        let attitude = WrittenPlacement::of(placed, deforming.start(), reporter);
        let source = MassSource::of(placed, reporter);
        let shape = value.shape.as_ref().map(|written| {
            let density = source.map_or(Some(1.0), |source| source.density(written));
            ShapeBuilder { base: context.base, reporter }.shape(written, &key.key("shape"), density)
        });
        let source = source?;
        let shape = match (shape, source) {
            (Some(shape), _) => shape?,
            (None, MassSource::Properties(mass)) => lone_point(&mass),
            (None, _) => return None,
        };
        let mass = source.weigh(&shape, key, reporter)?;
        let kind = deforming.kind(placed, &mass, shape.surface().is_some(), reporter);
        let arm = value.pin.as_ref().map(si);
        near(arm.as_ref(), &shape, key, reporter);
        let mut kind = kind?;
        let inclusion = ImmersedBody { placed, shape: &shape, mass: &mass, kind: &kind }.inclusion(context, reporter);
        let mut start = attitude?.start(placed, &kind, reporter)?;
        let guide = guide(placed, &mut kind, &mut start, reporter)?;
        let place = placement(&start);
        let springs = springs(placed, &place, reporter);
        if kind == BodyKind::Rigid(RigidInertia::POINT) {
            point(placed, reporter);
        }
        let own = own?.at(&place, (&shape, &mass.center), reporter)?;
        let body = Moving {
            kind,
            size: size(&shape, &mass, &arm.unwrap_or_default()),
            solid: solids.share(shape, mass),
            pin: arm.map(|point| Pin { point, anchor: place.place(&point) }),
            guide,
            inclusion: inclusion?,
            own,
        };
        Some(Self { name: value.name.clone(), body: solids.share_body(body), start, springs })
    }
}

/// Notes what a mass point cannot have: it does not turn.
fn point(placed: &Placed<Body>, reporter: &mut Reporter<'_>) {
    let Placed { key, value, .. } = placed;
    let spin: Vec3 = value.angular_velocity.as_ref().map(si).unwrap_or_default();
    if spin != Vec3::zeros() {
        let message = "all its mass is in one point, and the spin of a point has no meaning";
        reporter.note(&key.key("angular_velocity"), message, "leave it out, or give the body some width");
    }
    for (index, spring) in value.spring.iter().enumerate() {
        lever(&si(&spring.point), &key.key("spring").index(index).key("point"), reporter);
    }
    for (index, force) in value.force.iter().enumerate() {
        lever(&si(&force.point), &key.key("force").index(index).key("point"), reporter);
    }
}

/// Notes a spring beside a mass point.
pub(super) fn lever(point: &Vec3, key: &Key, reporter: &mut Reporter<'_>) {
    if *point != Vec3::zeros() {
        let message = "all mass of the body is in one point: a force beside it would turn what has no inertia";
        reporter.note(key, message, "write [0, 0, 0], or give the body some width");
    }
}

/// The farthest pin, in sizes of the body: P is known to 1e-10 at the default tolerance, so that a centre this far from
/// its pin is known to a millionth of the body's size, which is what a gap needs.
const FARTHEST_PIN: f64 = 1e4;

/// Notes a pin outside of all reason. A body without extent has no size to compare with.
fn near(arm: Option<&Vec3>, shape: &Shape, key: &Key, reporter: &mut Reporter<'_>) {
    let (distance, size) = (arm.map_or(0.0, Vec3::norm), shape.size());
    if size > 0.0 && distance > FARTHEST_PIN * size {
        let (distance, size, farthest) = (shown(distance), shown(size), shown(FARTHEST_PIN * size));
        let message = format!("the pin is {distance} m from the centre of mass of a body of {size} m");
        let help = format!("write a point within {farthest} m, in metres from the centre of mass");
        reporter.note(&key.key("pin"), message, help);
    }
}

fn springs(placed: &Placed<Body>, place: &Placement, reporter: &mut Reporter<'_>) -> Vec<Spring> {
    let key = placed.key.key("spring");
    let make = |(index, written): (usize, &crate::file::Spring)| {
        let (point, start) = (si(&written.point), si(&written.anchor));
        let law = SpringLaw {
            stiffness: written.stiffness.value(),
            rest_length: written.rest_length.value(),
            damping: written.damping.value(),
        };
        // Its first direction is that of an anchor which may have left its place.
        let motion = Arc::new(support::motion(written.anchor_motion.as_ref())?);
        let anchor = Anchor { start, motion };
        if law.is_directed() && place.place(&point) == anchor.at(0.0).0 {
            let help = "move the anchor, or leave out `rest_length` and `damping`";
            reporter.note(
                &key.index(index).key("anchor"),
                "the spring starts with no length and has no direction",
                help,
            );
        }
        Some(Spring::to(placed.number, point, anchor, law))
    };
    placed.value.spring.iter().enumerate().filter_map(make).collect()
}
