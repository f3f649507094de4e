//! The gravity of a body on itself: of spheres and ellipsoids whose mass is spread evenly, as long as they deform.

use super::context::SceneContext;
use crate::check::{Placed, Reporter};
use crate::file::Body;
use gyration::body::BodyKind;
use gyration::load::SelfGravity;
use gyration::mass::MassProperties;
use gyration::shape::Shape;

/// That of a body: none if it is rigid, since what it changes then is a constant. Outside none where it has no closed
/// form, which is noted.
pub(super) fn self_gravity(
    placed: &Placed<Body>,
    (shape, mass): (&Shape, &MassProperties),
    kind: &BodyKind,
    context: &SceneContext,
    reporter: &mut Reporter<'_>,
) -> Option<Option<SelfGravity>> {
    let Some(constant) = context.self_gravity.filter(|_| !matches!(kind, BodyKind::Rigid(_))) else {
        return Some(None);
    };
    let Placed { key, value, .. } = placed;
    let Some(semi_axes) = shape.semi_axes() else {
        let message = "`world.self_gravity` has a closed form for spheres and ellipsoids alone";
        let help = "write a sphere or an ellipsoid, make the body `rigid`, or leave out `world.self_gravity`";
        reporter.note(&key.key("shape"), message, help);
        return None;
    };
    if value.mass_properties.is_some() {
        let message = "`world.self_gravity` is that of a mass which is spread evenly";
        reporter.note(&key.key("mass_properties"), message, "give a `density` or a `mass` instead");
        return None;
    }
    Some(Some(SelfGravity::new(constant, mass.mass, &semi_axes)))
}
