//! A body: shape, mass, surface about the centre of mass, springs, pin, and how it starts.

use super::mass::{Source, lone_point, size};
use super::orientation::orientation;
use super::shape::Maker;
use crate::check::{Judge, Placed};
use crate::file::Body;
use crate::key::Key;
use crate::quantity::si;
use gyration::body::{Body as Moving, BodyKind, Pin, RigidInertia};
use gyration::kinematics::Quaternion;
use gyration::load::Spring;
use gyration::mass::MassProperties;
use gyration::state::RigidStart;
use gyration::tensor::{Mat3, Vec3};
use std::path::Path;

/// A body of the model and how it starts.
#[derive(Debug, Clone)]
pub(super) struct Solid {
    pub(super) body: Moving,
    pub(super) start: RigidStart,
}

impl Solid {
    /// Builds a body, without its contacts; notes what is wrong with it.
    pub(super) fn new(placed: &Placed<Body>, base: &Path, judge: &mut Judge<'_>) -> Option<Self> {
        let Placed { key, value } = placed;
        deformable_keys(value, key, judge);
        let turned = orientation(&value.orientation, &key.key("orientation"), judge);
        let source = Source::of(placed, judge);
        let shape = value.shape.as_ref().map(|written| {
            let density = source.map_or(Some(1.0), |source| source.density(written));
            Maker { base, judge }.shape(written, &key.key("shape"), density)
        });
        let source = source?;
        let shape = match (shape, source) {
            (Some(shape), _) => shape?,
            (None, Source::Properties(mass)) => lone_point(&mass),
            (None, _) => return None,
        };
        let mass = source.weigh(&shape, key, judge)?;
        let turned = turned?;
        let start = start(placed, turned, judge)?;
        let pin = value.pin.map(|point| {
            let point = si(&point);
            Pin { point, anchor: start.position + turned.rotation() * point }
        });
        let inertia = inertia(placed, &mass, pin.as_ref(), judge);
        let body = Moving {
            name: value.name.clone(),
            kind: BodyKind::Rigid(inertia?),
            mass,
            surface: shape.surface().map(|surface| surface.translated(&-mass.center)),
            size: size(&shape, &mass, &pin.map_or(Vec3::zeros(), |pin| pin.point)),
            shape,
            contacts: Vec::new(),
            springs: springs(placed, &start, judge),
            pin,
        };
        Some(Self { body, start })
    }
}

/// The inertia about the centre of mass or the pin; notes one that cannot be inverted.
fn inertia(
    placed: &Placed<Body>,
    mass: &MassProperties,
    pin: Option<&Pin>,
    judge: &mut Judge<'_>,
) -> Option<RigidInertia> {
    let name = if placed.value.mass_properties.is_some() { "mass_properties" } else { "shape" };
    let key = placed.key.key(name);
    match RigidInertia::new(mass, pin) {
        Ok(inertia) if inverts(&inertia) => Some(inertia),
        Ok(inertia) => {
            let message = format!("the inertia, {:e} kg m², leaves the range of numbers", inertia.tensor.amax());
            judge.note(&key, message, "change the size or the mass");
            None
        }
        Err(error) => {
            judge.note(&key, error.to_string(), "add mass off the line, or a `pin` off the line");
            None
        }
    }
}

/// Whether I⁻¹ is one: far from one kilogram and metre its entries leave the range of numbers.
fn inverts(inertia: &RigidInertia) -> bool {
    // Of all entries: the largest of a matrix passes over what is not a number.
    let residual = inertia.tensor * inertia.inverse - Mat3::identity();
    inertia.inverse.iter().all(|entry| entry.is_finite()) && residual.iter().all(|entry| entry.abs() < 0.5)
}

/// Refuses what only a deformable body has.
fn deformable_keys(body: &Body, key: &Key, judge: &mut Judge<'_>) {
    if body.gradient.is_some() {
        let help = "a rigid body starts with an `orientation`";
        judge.note(&key.key("gradient"), "a rigid body has no placement gradient of its own", help);
    }
    if body.gradient_rate.is_some() {
        let help = "a rigid body starts with an `angular_velocity`";
        judge.note(&key.key("gradient_rate"), "a rigid body has no gradient rate of its own", help);
    }
}

/// The initial motion; a pinned body's velocity follows from its spin, and a given one must agree.
fn start(placed: &Placed<Body>, orientation: Quaternion, judge: &mut Judge<'_>) -> Option<RigidStart> {
    let Placed { key, value } = placed;
    let (position, velocity) = (si(&value.position), si(&value.velocity));
    let angular_velocity: Vec3 = si(&value.angular_velocity);
    let start = RigidStart { position, orientation, velocity, angular_velocity };
    let Some(pin) = &value.pin else { return Some(start) };
    // p₀ = a − R X_p, so that ṗ₀ = −ω × R X_p.
    let follows = (orientation.rotation() * si(pin)).cross(&angular_velocity);
    let given = key.key("velocity");
    let written = given.is_written(&judge.document.root);
    // Numbers written with ten digits agree.
    const AGREEMENT: f64 = 1e-9;
    if written && (velocity - follows).norm() > AGREEMENT * follows.norm().max(velocity.norm()) {
        let [x, y, z] = follows.into();
        let message =
            format!("the pin does not allow it: with this spin the centre of mass moves at [{x:e}, {y:e}, {z:e}]");
        judge.note(&given, message, "leave `velocity` out: it follows from `angular_velocity`");
        return None;
    }
    Some(RigidStart { velocity: follows, ..start })
}

fn springs(placed: &Placed<Body>, start: &RigidStart, judge: &mut Judge<'_>) -> Vec<Spring> {
    let rotation = start.orientation.rotation();
    let key = placed.key.key("spring");
    let make = |(index, written): (usize, &crate::file::Spring)| {
        let spring = Spring {
            point: si(&written.point),
            anchor: si(&written.anchor),
            stiffness: written.stiffness.value(),
            rest_length: written.rest_length.value(),
            damping: written.damping.value(),
        };
        let directed = spring.rest_length > 0.0 || spring.damping > 0.0;
        if directed && start.position + rotation * spring.point == spring.anchor {
            let help = "move the anchor, or leave out `rest_length` and `damping`";
            judge.note(&key.index(index).key("anchor"), "the spring starts with no length and has no direction", help);
        }
        spring
    };
    placed.value.spring.iter().enumerate().map(make).collect()
}
