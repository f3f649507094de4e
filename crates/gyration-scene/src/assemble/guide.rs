//! `keep`: the guide of a body, and a start that it allows.
//!
//! Velocities that leave the guide by ten digits or less are taken to be meant on it, and put there; what differs by
//! rounding only is left as it is.

use super::constraint::rows;
use super::start::placement;
use crate::check::{Placed, Reporter, direction};
use crate::file::{Body, Copies, Keep};
use crate::key::Key;
use crate::quantity::si;
use gyration::affine::{AffineBody, StrainGuide};
use gyration::body::{BodyKind, Guide, RigidInertia, TurnGuide};
use gyration::kinematics::{Placement, Velocity};
use gyration::state::{RigidStart, Start};
use gyration::tensor::{Mat3, Vec3};

/// Numbers written with ten digits agree.
const AGREEMENT: f64 = 1e-9;
/// The rounding of nine products.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// What is kept to, with unit vectors.
#[derive(Debug, Clone, Copy)]
enum Kept {
    Plane(Vec3),
    Axis(Vec3),
    Line(Vec3),
    Stretch,
}

/// The guide of a body, if it has one, after which its kind and start are made; notes what cannot be kept to, and a
/// start that leaves it.
pub(super) fn guide(
    placed: &Placed<Body>,
    kind: &mut BodyKind,
    start: &mut Start,
    reporter: &mut Reporter<'_>,
) -> Option<Option<Box<Guide>>> {
    let Some(written) = placed.value.keep else { return Some(None) };
    let key = placed.key.key("keep");
    let kept = Kept::of(written, &key, reporter)?;
    let place = placement(start);
    let fault = kept.unfit(kind, placed.value.pin.as_ref().map(si), &place);
    if let Some((message, help)) = fault {
        reporter.note(&key.key(kept.name()), message, help);
        return None;
    }
    let guide = kept.guide(kind, start, placed.value.pin.is_some());
    hold(placed, &guide, kind, start, reporter).then(|| Some(Box::new(guide)))
}

impl Kept {
    fn of(written: Keep, key: &Key, reporter: &mut Reporter<'_>) -> Option<Self> {
        let mut along = |name: &str, vector: &[f64; 3]| {
            let found = direction(vector);
            if found.is_none() {
                reporter.note(&key.key(name), "the direction is zero", "write a direction, [0, 0, 1]");
            }
            found
        };
        match &written {
            Keep::Plane(normal) => along("plane", normal).map(Self::Plane),
            Keep::Axis(axis) => along("axis", axis).map(Self::Axis),
            Keep::Line(line) => along("line", line).map(Self::Line),
            Keep::StretchOnly(true) => Some(Self::Stretch),
            Keep::StretchOnly(false) => {
                let message = "`false` would keep the body to nothing";
                reporter.note(&key.key("stretch_only"), message, "write `true`, or leave `keep` out");
                None
            }
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Plane(_) => "plane",
            Self::Axis(_) => "axis",
            Self::Line(_) => "line",
            Self::Stretch => "stretch_only",
        }
    }

    /// Why a body cannot be kept to it, and what to do.
    fn unfit(self, kind: &BodyKind, pin: Option<Vec3>, place: &Placement) -> Option<(String, &'static str)> {
        let is_point = *kind == BodyKind::Rigid(RigidInertia::POINT);
        let deforms = !matches!(kind, BodyKind::Rigid(_));
        let (message, help) = match self {
            Self::Axis(_) if deforms => (
                "a body that deforms has no axis to turn about: turns about it and strains make up every motion",
                "write `plane` with this direction as normal, or `stretch_only = true`",
            ),
            Self::Axis(_) | Self::Stretch if is_point => (
                "all mass of the body is in one point, which does not turn",
                "leave `keep` out, or give the body some width",
            ),
            Self::Line(_) if pin.is_some() => {
                ("the centre of a pinned body goes where its turn takes it", "leave out one of `pin` and `keep`")
            }
            Self::Stretch if pin.is_some() && !deforms => (
                "a rigid body that is pinned and does not turn does not move",
                "leave out one of `pin` and `keep`, or let the body deform",
            ),
            Self::Plane(normal) if deforms => {
                let arm = place.gradient * pin?;
                let off = normal.dot(&arm);
                if off.abs() <= AGREEMENT * arm.norm() {
                    return None;
                }
                let message = format!(
                    "the pin is {off:e} m off the plane through the centre of mass, and the body would not stretch \
                     across the plane"
                );
                return Some((message, "move the pin into the plane, or leave out one of `pin` and `keep`"));
            }
            Self::Plane(_) | Self::Axis(_) | Self::Line(_) | Self::Stretch => return None,
        };
        Some((message.to_owned(), help))
    }

    /// The guide of a body that starts like this; what concerns P of a body that deforms goes to its interior.
    fn guide(self, kind: &mut BodyKind, start: &Start, is_pinned: bool) -> Guide {
        let Placement { position, gradient } = placement(start);
        let center = match self {
            _ if is_pinned => None,
            Self::Plane(normal) => Some(Mat3::identity() - normal * normal.transpose()),
            Self::Line(line) => Some(line * line.transpose()),
            Self::Axis(_) | Self::Stretch => None,
        };
        let strain = |interior: &mut AffineBody| {
            let euler_tensor = &interior.euler_tensor;
            interior.guide = match self {
                Self::Plane(normal) => Some(Box::new(StrainGuide::plane(&normal, &gradient, euler_tensor))),
                Self::Stretch => Some(Box::new(StrainGuide::stretch(&gradient, euler_tensor))),
                Self::Axis(_) | Self::Line(_) => None,
            };
        };
        let turn = match (kind, start) {
            (BodyKind::Rigid(inertia), Start::Rigid(start)) if *inertia != RigidInertia::POINT => {
                let about = |axis: Option<&Vec3>| Some(TurnGuide::new(axis, start.orientation, inertia));
                match &self {
                    Self::Plane(axis) | Self::Axis(axis) => about(Some(axis)),
                    Self::Stretch => about(None),
                    Self::Line(_) => None,
                }
            }
            (BodyKind::Affine(affine), _) => {
                strain(&mut affine.interior);
                None
            }
            (BodyKind::Contractile(contractile), _) => {
                strain(&mut contractile.affine.interior);
                None
            }
            (BodyKind::Rigid(_), _) => None,
        };
        Guide { position, center, turn }
    }
}

/// Puts the velocities of a start on the guide; notes those that leave it.
fn hold(placed: &Placed<Body>, guide: &Guide, kind: &BodyKind, start: &mut Start, reporter: &mut Reporter<'_>) -> bool {
    let key = |name: &str| placed.key.key(name);
    // Those of a table of places come to those of the body.
    let is_sum = matches!(placed.value.copies.as_deref(), Some(Copies::Places(_)));
    let help = |name: &str, within: String| match is_sum {
        true => format!("let {name} of the body and of its place in the table add up to {within}"),
        false => format!("write {name} = {within}"),
    };
    let mut center = |velocity: &mut Vec3| {
        let Some(center) = &guide.center else { return true };
        let within = center * *velocity;
        let is_held = settle(velocity, within);
        if let Err(off) = is_held {
            let message = format!("the centre of mass would leave what `keep` keeps it to, at {off:e} m/s");
            reporter.note(&key("velocity"), message, help("velocity", list(&within)));
        }
        is_held.is_ok()
    };
    match start {
        Start::Rigid(RigidStart { orientation, velocity, angular_velocity, .. }) => {
            let moves = center(velocity);
            let Some(turn) = &guide.turn else { return moves };
            let within = turn.axis_in_space(orientation).map_or_else(Vec3::zeros, |a| a * a.dot(angular_velocity));
            let is_held = settle(angular_velocity, within);
            if let Err(off) = is_held {
                let message = format!("the body would turn otherwise than `keep` lets it, by {off:e} rad/s");
                reporter.note(&key("angular_velocity"), message, help("angular_velocity", list(&within)));
            }
            moves && is_held.is_ok()
        }
        Start::Affine(place, velocity) | Start::Contractile(place, velocity, _) => {
            let Velocity { velocity, gradient_rate } = velocity;
            let moves = center(velocity);
            let interior = match kind {
                BodyKind::Affine(affine) => &affine.interior,
                BodyKind::Contractile(contractile) => &contractile.affine.interior,
                BodyKind::Rigid(_) => return moves,
            };
            let Some(strain) = &interior.guide else { return moves };
            let mut within = strain.within(gradient_rate);
            if matches!(kind, BodyKind::Affine(_)) {
                within = interior.project(&place.gradient, &within).rate;
            }
            let is_held = settle(gradient_rate, within);
            if let Err(off) = is_held {
                let name = if placed.value.gradient_rate.is_some() { "gradient_rate" } else { "angular_velocity" };
                let message = format!("the body would deform otherwise than `keep` lets it, by {off:e} 1/s");
                reporter.note(&key(name), message, help("gradient_rate", rows(&within)));
            }
            moves && is_held.is_ok()
        }
    }
}

/// Takes the part of a velocity that stays within, where it differs from all of it by no more than digits.
///
/// # Errors
/// How far it leaves, where it is more.
fn settle<const COLUMNS: usize>(
    velocity: &mut nalgebra::SMatrix<f64, 3, COLUMNS>,
    within: nalgebra::SMatrix<f64, 3, COLUMNS>,
) -> Result<(), f64> {
    let (off, size) = ((*velocity - within).norm(), velocity.norm());
    if off > AGREEMENT * size {
        return Err(off);
    }
    if off > ROUNDING * size {
        *velocity = within;
    }
    Ok(())
}

/// A vector as a scene has it, with all its digits.
fn list(vector: &Vec3) -> String {
    format!("[{:?}, {:?}, {:?}]", vector.x, vector.y, vector.z)
}
