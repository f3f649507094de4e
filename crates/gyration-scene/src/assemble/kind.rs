//! How a body may deform: rigid, affine or contractile, with what each needs of its mass.

use super::affine::{AffineParts, Places, inverts};
use super::context::SceneContext;
use super::contractile::{WrittenContraction, feels_no_gap};
use super::kinetic::kinetic;
use crate::check::{Placed, Reporter};
use crate::file::Body;
use crate::key::Key;
use crate::quantity::si;
use gyration::affine::Kinetic;
use gyration::body::{BodyKind, Contractile, Pin, RigidInertia};
use gyration::mass::MassProperties;
use gyration::signal::Jet;
use gyration::tensor::Vec3;

/// What the file says of the deformation of a body. Outside whether it says so, inside whether without error.
#[derive(Debug, Clone)]
pub(super) struct WrittenDeformation {
    parts: Option<Option<AffineParts>>,
    contracting: Option<Option<WrittenContraction>>,
    kinetic: Option<Option<Kinetic>>,
}

impl WrittenDeformation {
    /// Reads it; notes what is wrong with it, and a body of two kinds.
    pub(super) fn of(placed: &Placed<Body>, context: &SceneContext, reporter: &mut Reporter<'_>) -> Self {
        let Placed { key, value, .. } = placed;
        one_kind(value, key, reporter);
        let parts = value.deformable().map(|(name, it)| AffineParts::of(it, &key.key(name), context.files, reporter));
        let contracting = value.contractile.as_ref();
        let contracting = contracting.map(|it| WrittenContraction::of(it, &key.key("contractile"), context, reporter));
        let is_incompressible = parts.iter().flatten().any(AffineParts::is_incompressible);
        let kinetic = kinetic(placed, is_incompressible, context, reporter);
        Self { parts, contracting, kinetic }
    }

    /// The contraction at the start, if there is one without error.
    pub(super) fn start(&self) -> Option<Jet> {
        Some(self.contracting.as_ref()?.as_ref()?.start)
    }

    /// The kind of a body of this mass; notes what the kind does not allow.
    pub(super) fn kind(
        self,
        placed: &Placed<Body>,
        mass: &MassProperties,
        has_surface: bool,
        reporter: &mut Reporter<'_>,
    ) -> Option<BodyKind> {
        let Placed { key, value, .. } = placed;
        let name = if value.mass_properties.is_some() { "mass_properties" } else { "shape" };
        let arm = value.pin.as_ref().map(si);
        let interior = key.key(value.deformable().map_or("affine", |(name, _)| name));
        let places = Places { interior, mass: key.key(name) };
        let Some(parts) = self.parts else { return inertia(mass, arm, &places.mass, reporter).map(BodyKind::Rigid) };
        let (Some(contracting), Some(written)) = (self.contracting, &value.contractile) else {
            let mut affine = parts?.with_mass(mass, arm.as_ref(), &places, reporter)?;
            affine.interior.kinetic = self.kinetic?;
            return Some(BodyKind::Affine(Box::new(affine)));
        };
        let fills = fills_a_volume(mass, &places.interior, reporter);
        let feels = has_surface || feels_no_gap(written, &places.interior, reporter);
        let (parts, contracting) = (parts?, contracting?);
        self.kinetic?;
        let suits = contracting.suits(parts.is_incompressible(), &places.interior, reporter);
        if !fills {
            return None;
        }
        let affine = parts.with_mass(mass, arm.as_ref(), &places, reporter)?;
        let contraction = contracting.contraction;
        (feels && suits).then(|| BodyKind::Contractile(Box::new(Contractile::new(affine, contraction))))
    }
}

/// Notes a body of two kinds.
fn one_kind(body: &Body, key: &Key, reporter: &mut Reporter<'_>) {
    let kinds = [
        ("rigid", body.rigid.is_some()),
        ("affine", body.affine.is_some()),
        ("contractile", body.contractile.is_some()),
    ];
    let mut given = kinds.iter().filter(|(_, is_given)| *is_given).map(|(name, _)| *name);
    let Some(first) = given.next() else { return };
    for name in given {
        let help = format!("keep one of `{first}` and `{name}`");
        reporter.note(&key.key(name), format!("the body is also `{first}`"), help);
    }
}

/// Whether there is a volume for the drive to act on.
fn fills_a_volume(mass: &MassProperties, key: &Key, reporter: &mut Reporter<'_>) -> bool {
    let fills = mass.volume > 0.0;
    if !fills {
        let message = "the body has no volume, so that a drive, which is a stress, has nothing to act on";
        reporter.note(key, message, "give the body a `shape` with a volume, or make it `affine`");
    }
    fills
}

/// The inertia about the centre of mass or the pin; notes one that cannot be inverted.
fn inertia(mass: &MassProperties, arm: Option<Vec3>, key: &Key, reporter: &mut Reporter<'_>) -> Option<RigidInertia> {
    // All mass in one place: a point has no turns that could be asked for.
    if mass.euler_tensor.iter().all(|entry| *entry == 0.0) && arm.is_none() {
        return Some(RigidInertia::POINT);
    }
    let pin = arm.map(|point| Pin { point, anchor: Vec3::zeros() });
    match RigidInertia::new(mass, pin.as_ref()) {
        Ok(inertia) if inverts(&inertia.tensor, &inertia.inverse) => Some(inertia),
        Ok(inertia) => {
            let message = format!("the inertia, {:e} kg m², leaves the range of numbers", inertia.tensor.amax());
            reporter.note(key, message, "change the size or the mass");
            None
        }
        Err(error) => {
            reporter.note(key, error.to_string(), "add mass off the line, or a `pin` off the line");
            None
        }
    }
}
