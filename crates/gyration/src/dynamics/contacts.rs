//! A body at its supports: gaps, relative motion, and the contacts that are to be integrated.

use crate::contact::{Contact, Deformation, Meeting, Partner, RelativeMotion};
use crate::contractile::Nearest;
use crate::inadmissible::{Inadmissible, Quantity};
use crate::instant::BodyAt;
use crate::model::Model;
use crate::state::BodyMotion;
use crate::surface::GapClosed;
use crate::tensor::Vec3;

/// Hands a contact of a body to `integrate`, unless a gap is closed; none without a surface.
#[inline]
pub(super) fn meet<T>(
    at: &BodyAt,
    contact: &Contact,
    integrate: impl FnOnce(&Meeting) -> Result<T, GapClosed>,
) -> Result<Option<T>, Inadmissible> {
    let BodyAt { model, body, motion, .. } = at;
    let Some(surface) = &body.solid.surface else { return Ok(None) };
    let Partner::Support(index) = contact.partner;
    let support = &model.supports[index];
    let field = support.gap_field(&motion.placement, at.time);
    let result = if surface.is_above(&field, body.least_gap(&field)) {
        let motion = RelativeMotion::to(support, &motion.velocity, at.time);
        integrate(&Meeting { surface, field, motion, deformation: deformation(at) }).map(Some)
    } else {
        Err(GapClosed { gap: surface.smallest_gap(&field).0 })
    };
    result.map_err(|closed| at.outside(Quantity::Gap { support: index }, closed.gap))
}

/// The velocity with which the partner of a contact is moved [m/s].
pub(super) fn carrying(at: &BodyAt, contact: &Contact) -> Vec3 {
    let Partner::Support(index) = contact.partner;
    at.model.supports[index].motion.velocity(at.time)
}

/// How the body takes its surface along; none of a rigid one.
#[inline]
fn deformation(at: &BodyAt) -> Option<Deformation> {
    let gyration = at.gyration()?;
    Some(Deformation { inverse: gyration.inverse, cofactor: gyration.volume_ratio * gyration.inverse.transpose() })
}

/// The support next to a body's surface; none without supports or surface.
pub fn nearest(model: &Model, time: f64, index: usize, motion: &BodyMotion) -> Option<Nearest> {
    let surface = model.bodies[index].solid.surface.as_ref()?;
    let near = model.supports.iter().map(|support| {
        let (gap, point) = surface.smallest_gap(&support.gap_field(&motion.placement, time));
        let speed = (motion.velocity.at(&point) - support.motion.velocity(time)).dot(&support.normal);
        Nearest { gap, normal: support.normal, point, speed }
    });
    near.min_by(|a, b| a.gap.total_cmp(&b.gap))
}
