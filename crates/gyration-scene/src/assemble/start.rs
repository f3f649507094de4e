//! How a body starts: p₀, P, ṗ₀ and Ṗ, from what of them the file gives.
//!
//!   P = R of an `orientation`, or a `gradient`;   Ṗ = [ω]× P of an `angular_velocity`, or a `gradient_rate`
//!
//! A contractile body starts relaxed, P = R G, unless it has a `gradient`, and follows a contraction that is
//! prescribed, Ṗ = [ω]× P + F Ġ with F = P G⁻¹, unless it has a `gradient_rate`. The centre of a pinned body moves at
//! ṗ₀ = −Ṗ r, r being the pin; a velocity that is given must agree. An incompressible body starts on its constraint
//! (`constraint`).

use super::constraint::{self, GradientStart, VolumeConstraint};
use super::orientation::orientation;
use crate::check::{Placed, Reporter};
use crate::file::Body;
use crate::key::Key;
use crate::places::CopyPlace;
use crate::quantity::si;
use gyration::affine::AffineBody;
use gyration::body::BodyKind;
use gyration::kinematics::{Placement, Quaternion, Velocity};
use gyration::signal::Jet;
use gyration::state::{RigidStart, Start};
use gyration::tensor::{Mat3, Vec3, cross_matrix};

/// P and Ṗ as the file has them, before any constraint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WrittenPlacement {
    orientation: Quaternion,
    angular_velocity: Vec3,
    gradient: Mat3,
    gradient_rate: Mat3,
    /// G and its rate; I of a body that does not contract.
    contraction: Jet,
}

impl WrittenPlacement {
    /// Reads P and Ṗ of a body that starts with a contraction, if it has one; notes what cannot be, what is said twice,
    /// and what only another kind of body has.
    pub(super) fn of(placed: &Placed<Body>, contraction: Option<Jet>, reporter: &mut Reporter<'_>) -> Option<Self> {
        let Placed { key, value, .. } = placed;
        match value.deformable() {
            None => deformable_keys(value, key, reporter),
            Some(_) => said_twice(value, key, reporter),
        }
        let turned = value.orientation.as_ref().map(|written| orientation(written, &key.key("orientation"), reporter));
        let gradient = value.gradient.map(|rows| {
            let gradient = matrix(&rows);
            invertible(&gradient, &key.key("gradient"), reporter).then_some(gradient)
        });
        let orientation = turned.unwrap_or(Some(Quaternion::IDENTITY))?;
        let relaxed = || contraction.map_or(orientation.rotation(), |jet| orientation.rotation() * jet.value);
        let gradient = gradient.unwrap_or_else(|| Some(relaxed()))?;
        let angular_velocity = si(&value.angular_velocity.unwrap_or_default());
        let contraction = contraction.unwrap_or(Jet { value: Mat3::identity(), ..Jet::default() });
        let moves = || cross_matrix(&angular_velocity) * gradient + following(&gradient, &contraction);
        let gradient_rate = value.gradient_rate.as_ref().map_or_else(moves, matrix);
        Some(Self { orientation, angular_velocity, gradient, gradient_rate, contraction })
    }

    /// The same of a copy at a place: turned, with more spin.
    fn of_copy(&self, body: &Body, place: &CopyPlace) -> Self {
        let Self { mut orientation, mut gradient, mut gradient_rate, contraction, .. } = *self;
        if let Some(turn) = &place.turn {
            let rotation = turn.rotation();
            orientation = turn.times(&orientation);
            (gradient, gradient_rate) = (rotation * gradient, rotation * gradient_rate);
        }
        let angular_velocity = self.angular_velocity + place.angular_velocity;
        gradient_rate = match body.gradient_rate {
            Some(_) => gradient_rate + cross_matrix(&place.angular_velocity) * gradient,
            None => cross_matrix(&angular_velocity) * gradient + following(&gradient, &contraction),
        };
        Self { orientation, angular_velocity, gradient, gradient_rate, contraction }
    }

    /// The whole start of a body of this kind, or of a copy of it at a place; notes one that its constraint or its pin
    /// does not allow.
    pub(super) fn start(
        &self,
        placed: &Placed<Body>,
        kind: &BodyKind,
        copy: Option<&CopyPlace>,
        reporter: &mut Reporter<'_>,
    ) -> Option<Start> {
        let here = copy.map_or(*self, |place| self.of_copy(&placed.value, place));
        let center = Center::of(placed, copy);
        match kind {
            BodyKind::Rigid(_) => {
                let Self { orientation, angular_velocity, .. } = here;
                let follows = center.pin.map(|pin| (orientation.rotation() * pin).cross(&angular_velocity));
                let velocity = center.velocity(follows, reporter)?;
                Some(Start::Rigid(RigidStart { position: center.position, orientation, velocity, angular_velocity }))
            }
            BodyKind::Affine(affine) => {
                let (place, velocity) =
                    here.deformable_start(&center, &affine.interior, &VolumeConstraint::VOLUME, reporter)?;
                Some(Start::Affine(place, velocity))
            }
            BodyKind::Contractile(contractile) => {
                let kept = VolumeConstraint::beside(&contractile.contraction, &here.contraction);
                let (place, velocity) =
                    here.deformable_start(&center, &contractile.affine.interior, &kept, reporter)?;
                Some(Start::Contractile(place, velocity, here.contraction.value))
            }
        }
    }

    fn deformable_start(
        &self,
        center: &Center<'_>,
        body: &AffineBody,
        kept: &VolumeConstraint,
        reporter: &mut Reporter<'_>,
    ) -> Option<(Placement, Velocity)> {
        let given = GradientStart { gradient: self.gradient, rate: self.gradient_rate };
        let GradientStart { gradient, rate: gradient_rate } =
            constraint::hold(body, kept, given, &center.placed.key, reporter)?;
        let velocity = center.velocity(center.pin.map(|pin| -(gradient_rate * pin)), reporter)?;
        let place = Placement { position: center.position, gradient };
        Some((place, Velocity { velocity, gradient_rate }))
    }
}

/// The centre of mass at the start.
struct Center<'a> {
    placed: &'a Placed<Body>,
    is_copy: bool,
    position: Vec3,
    /// As it is given.
    given: Vec3,
    pin: Option<Vec3>,
}

/// F Ġ, F = P G⁻¹: the rate of a body that follows its contraction and keeps its elastic strain.
fn following(gradient: &Mat3, contraction: &Jet) -> Mat3 {
    if contraction.rate == Mat3::zeros() {
        return Mat3::zeros();
    }
    // G has been found to have an inverse.
    let inverse = contraction.value.try_inverse().unwrap_or_else(Mat3::identity);
    gradient * inverse * contraction.rate
}

/// Where a body starts.
pub(super) fn placement(start: &Start) -> Placement {
    match start {
        Start::Rigid(start) => Placement { position: start.position, gradient: start.orientation.rotation() },
        Start::Affine(placement, _) | Start::Contractile(placement, ..) => *placement,
    }
}

/// A matrix from its rows, in SI units.
pub(super) fn matrix<T: Into<f64> + Copy>(rows: &[[T; 3]; 3]) -> Mat3 {
    Mat3::from_rows(&[si(&rows[0]).transpose(), si(&rows[1]).transpose(), si(&rows[2]).transpose()])
}

/// Refuses what only a deformable body has.
fn deformable_keys(body: &Body, key: &Key, reporter: &mut Reporter<'_>) {
    if body.gradient.is_some() {
        let help = "a rigid body starts with an `orientation`; add `affine = {}` for one that deforms";
        reporter.note(&key.key("gradient"), "a rigid body has no placement gradient of its own", help);
    }
    if body.gradient_rate.is_some() {
        let help = "a rigid body starts with an `angular_velocity`; add `affine = {}` for one that deforms";
        reporter.note(&key.key("gradient_rate"), "a rigid body has no gradient rate of its own", help);
    }
}

/// Refuses two answers to one question.
fn said_twice(body: &Body, key: &Key, reporter: &mut Reporter<'_>) {
    if body.gradient.is_some() && body.orientation.is_some() {
        let help = "keep one: with `gradient` = R U leave `orientation` out";
        reporter.note(&key.key("orientation"), "`gradient` already says how the body is turned at the start", help);
    }
    if body.gradient_rate.is_some() && body.angular_velocity.is_some() {
        let help = "keep one: with `gradient_rate` leave `angular_velocity` out, which would give [ω]× P";
        reporter.note(
            &key.key("angular_velocity"),
            "`gradient_rate` already says how the body spins at the start",
            help,
        );
    }
}

/// Whether a matrix has a positive determinant beyond rounding, and an inverse that numbers can hold; notes it
/// otherwise.
pub(super) fn invertible(matrix: &Mat3, key: &Key, reporter: &mut Reporter<'_>) -> bool {
    let flaw = flaw(matrix);
    if let Some(message) = &flaw {
        let help = "write a matrix of positive determinant; [[1, 0, 0], [0, 1, 0], [0, 0, 1]] leaves the body as it is";
        reporter.note(key, message, help);
    }
    flaw.is_none()
}

/// Why a matrix cannot be a gradient or a contraction.
pub(super) fn flaw(matrix: &Mat3) -> Option<String> {
    let determinant = matrix.determinant();
    if determinant < f64::MIN_POSITIVE {
        let what = if determinant < 0.0 { "turned inside out" } else { "pressed flat" };
        return Some(format!("its determinant is {determinant:?}: the body would be {what}"));
    }
    let residual = matrix.try_inverse().map(|inverse| matrix * inverse - Mat3::identity());
    // Of all entries: the largest of a matrix passes over what is not a number.
    let inverts = residual.is_some_and(|residual| residual.iter().all(|entry| entry.abs() < 0.5));
    (!inverts).then(|| "it cannot be told from a matrix that has no inverse".to_owned())
}

impl<'a> Center<'a> {
    fn of(placed: &'a Placed<Body>, copy: Option<&CopyPlace>) -> Self {
        let (mut position, mut given): (Vec3, Vec3) = (si(&placed.value.position), si(&placed.value.velocity));
        if let Some(place) = copy {
            position += place.displacement;
            given += place.velocity;
        }
        Self { placed, is_copy: copy.is_some(), position, given, pin: placed.value.pin.as_ref().map(si) }
    }

    /// ṗ₀ as given, or as it follows from the pin; notes a given one that does not agree with the pin.
    fn velocity(&self, follows: Option<Vec3>, reporter: &mut Reporter<'_>) -> Option<Vec3> {
        let Self { placed, is_copy, given: velocity, .. } = *self;
        let Some(follows) = follows else { return Some(velocity) };
        let given = placed.key.key("velocity");
        // Of a body with copies its own velocity is looked at: that of each copy follows from how it is turned.
        let written = !is_copy && given.is_written(&reporter.document.root);
        // Numbers written with ten digits agree.
        const AGREEMENT: f64 = 1e-9;
        if written && (velocity - follows).norm() > AGREEMENT * follows.norm().max(velocity.norm()) {
            let [x, y, z] = follows.into();
            let (what, keys) = match placed.value.deformable() {
                None => ("spin", "`angular_velocity`"),
                Some(_) => ("rate", "`gradient_rate` or `angular_velocity`"),
            };
            let message = format!(
                "the pin does not allow it: with this {what} the centre of mass moves at [{x:e}, {y:e}, {z:e}]"
            );
            reporter.note(&given, message, format!("leave `velocity` out: it follows from {keys}"));
            return None;
        }
        Some(follows)
    }
}
