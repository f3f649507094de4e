//! A body: shape, mass, surface about the centre of mass, kind, springs, pin, guide, and how it starts.

use super::context::SceneContext;
use super::fluid::ImmersedBody;
use super::guide::guide;
use super::kind::WrittenDeformation;
use super::mass::{MassSource, lone_point, size};
use super::own::OwnForcesWritten;
use super::self_gravity::self_gravity;
use super::shape::ShapeBuilder;
use super::solids::Solids;
use super::start::{WrittenPlacement, placement};
use super::support;
use crate::check::{Placed, Reporter};
use crate::file::Body;
use crate::key::Key;
use crate::places::CopyPlace;
use crate::quantity::si;
use crate::units::shown;
use gyration::body::{Body as Moving, BodyKind, Pin, RigidInertia, Solid};
use gyration::fluid::Inclusion;
use gyration::kinematics::Placement;
use gyration::load::{Anchor, SelfGravity, Spring, SpringLaw};
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
    /// Its springs to anchors, of the body's index in the model.
    pub(super) springs: Vec<Spring>,
}

/// A body of the file but for where it is: what its copies have alike.
pub(super) struct PreparedBody<'a> {
    pub(super) placed: &'a Placed<Body>,
    attitude: WrittenPlacement,
    pub(super) solid: Arc<Solid>,
    kind: BodyKind,
    /// None where something is wrong with it.
    inclusion: Option<Option<Inclusion>>,
    own: Option<OwnForcesWritten>,
    /// None where something is wrong with it.
    self_gravity: Option<Option<SelfGravity>>,
    /// X of the pin \[m\].
    arm: Option<Vec3>,
    size: f64,
}

impl<'a> PreparedBody<'a> {
    /// Builds a body, without its contacts and its place; notes what is wrong with it.
    pub(super) fn new(
        placed: &'a Placed<Body>,
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
            ShapeBuilder { files: context.files, reporter }.shape(written, &key.key("shape"), density)
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
        let kind = kind?;
        let inclusion = ImmersedBody { placed, shape: &shape, mass: &mass, kind: &kind }.inclusion(context, reporter);
        let self_gravity = self_gravity(placed, (&shape, &mass), &kind, context, reporter);
        if kind == BodyKind::Rigid(RigidInertia::POINT) {
            point(placed, reporter);
        }
        let (attitude, size) = (attitude?, size(&shape, &mass, &arm.unwrap_or_default()));
        Some(Self { placed, attitude, solid: solids.share(shape, mass), kind, inclusion, own, self_gravity, arm, size })
    }

    /// How the body starts as it is written, without its copies.
    pub(super) fn start(&self, reporter: &mut Reporter<'_>) -> Option<Start> {
        self.attitude.start(self.placed, &self.kind, None, reporter)
    }

    /// The body alone, of this index in the model.
    pub(super) fn alone(
        &self,
        index: usize,
        solids: &mut Solids,
        reporter: &mut Reporter<'_>,
    ) -> Option<AssembledBody> {
        let start = self.start(reporter)?;
        self.starting(self.placed.value.name.clone(), index, start, solids, reporter)
    }

    /// Whether places give copies no velocity that follows from something else; notes it otherwise.
    pub(super) fn may_move(&self, places: &[CopyPlace], reporter: &mut Reporter<'_>) -> bool {
        let is_moved = |own: fn(&CopyPlace) -> Vec3| places.iter().any(|place| own(place) != Vec3::zeros());
        let is_free = self.placed.value.inclusion.as_ref().is_none_or(|inclusion| inclusion.inertia);
        let is_point = self.kind == BodyKind::Rigid(RigidInertia::POINT);
        let faults = [
            (
                self.arm.is_some() && is_moved(|place| place.velocity),
                "the pin says how the centre of mass moves, and so do the columns vx, vy, vz",
                "leave out the columns: it follows from the spin",
            ),
            (
                !is_free && (is_moved(|place| place.velocity) || is_moved(|place| place.angular_velocity)),
                "a body without inertia moves as the balance of forces says, from the start on",
                "leave out the columns of velocities and spins, or write `inertia = true`",
            ),
            (
                is_point && is_moved(|place| place.angular_velocity),
                "all its mass is in one point, and the spin of a point has no meaning",
                "leave out the columns wx, wy, wz, or give the body some width",
            ),
        ];
        let found: Vec<_> = faults.iter().filter(|(is_at_fault, ..)| *is_at_fault).collect();
        for (_, message, help) in &found {
            reporter.note(&self.placed.key.key("copies").key("places"), *message, *help);
        }
        found.is_empty()
    }

    /// Its copy of this number, at a place.
    pub(super) fn copy(
        &self,
        number: usize,
        place: &CopyPlace,
        solids: &mut Solids,
        reporter: &mut Reporter<'_>,
    ) -> Option<AssembledBody> {
        let start = self.attitude.start(self.placed, &self.kind, Some(place), reporter)?;
        let name = format!("{}-{number}", self.placed.value.name);
        // Springs to anchors, which need an index, have no copies.
        self.starting(name, number, start, solids, reporter)
    }

    fn starting(
        &self,
        name: String,
        index: usize,
        mut start: Start,
        solids: &mut Solids,
        reporter: &mut Reporter<'_>,
    ) -> Option<AssembledBody> {
        let mut kind = self.kind.clone();
        let guide = guide(self.placed, &mut kind, &mut start, reporter)?;
        let place = placement(&start);
        let springs = springs(self.placed, index, &place, reporter);
        let mut own = self.own.clone()?.at(&place, (&self.solid.shape, &self.solid.mass.center), reporter)?;
        own.self_gravity = self.self_gravity?;
        let body = Moving {
            kind,
            size: self.size,
            solid: Arc::clone(&self.solid),
            pin: self.arm.map(|point| Pin { point, anchor: place.place(&point) }),
            guide,
            inclusion: self.inclusion.clone()?,
            own,
        };
        Some(AssembledBody { name, body: solids.share_body(body), start, springs })
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

fn springs(placed: &Placed<Body>, index: usize, place: &Placement, reporter: &mut Reporter<'_>) -> Vec<Spring> {
    let key = placed.key.key("spring");
    let make = |(number, written): (usize, &crate::file::Spring)| {
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
                &key.index(number).key("anchor"),
                "the spring starts with no length and has no direction",
                help,
            );
        }
        Some(Spring::to(index, point, anchor, law))
    };
    placed.value.spring.iter().enumerate().filter_map(make).collect()
}
