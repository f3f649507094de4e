//! A body at its supports: gaps, relative motion, and the contacts that are to be integrated.

use crate::contact::{Contact, Meeting, RelativeMotion};
use crate::contractile::Nearest;
use crate::extended::{Extended, rotated_back};
use crate::inadmissible::{Inadmissible, Quantity};
use crate::instant::{KindAt, MotionAt};
use crate::model::Model;
use crate::state::BodyMotion;
use crate::support::{PlaneAt, PlaneMotion, Support};
use crate::surface::{GapClosed, GapField, Surface};
use crate::tensor::Vec3;

/// What rounding leaves of a length, as a part of it.
const ROUNDING: f64 = 1e-12;

/// Hands a contact of a body to `integrate`, unless a gap is closed; none without a surface.
#[inline]
pub(super) fn meet<T>(
    at: &MotionAt,
    contact: &Contact,
    integrate: impl FnOnce(&Meeting) -> Result<T, GapClosed>,
) -> Result<Option<T>, Inadmissible> {
    let MotionAt { model, body, motion, .. } = at;
    let Some(surface) = &body.solid.surface else { return Ok(None) };
    let index = contact.support;
    let support = &model.supports[index];
    let field = gap_field(at, surface, support);
    let result = if surface.is_above(&field, body.least_gap(&field)) {
        let motion = RelativeMotion::to(support, motion, at.time);
        integrate(&Meeting { surface, field, motion, deformation: at.deformation() }).map(Some)
    } else {
        Err(GapClosed { gap: surface.smallest_gap(&field).0 })
    };
    result.map_err(|closed| at.outside(Quantity::Gap { support: index }, closed.gap))
}

/// The gap to a support: to twice the digits where it is small and the surface can use them.
#[inline]
fn gap_field(at: &MotionAt, surface: &Surface, support: &Support) -> GapField {
    let field = support.gap_field(&at.motion.placement, at.time);
    if at.numbers.low.is_empty() || surface.is_above(&field, at.body.near_gap(&field, &at.motion.placement.position)) {
        return field;
    };
    extended_gap_field(at, surface, support).unwrap_or(field)
}

/// g₀ = (p₀ − o(t))·n and m = Pᵀn to twice the digits, of a body that keeps them, and g₀ alone of others that have
/// inertia; a pinned one has p₀ = a − P r.
#[cold]
fn extended_gap_field(at: &MotionAt, surface: &Surface, support: &Support) -> Option<GapField> {
    let MotionAt { model, body, index, time, numbers, .. } = *at;
    let keeps_digits = body.keeps_digits(surface);
    if !keeps_digits && !body.has_inertia() {
        return None;
    }
    let slots = model.slots(index);
    let PlaneAt { origin, shift, normal } = &support.at(time);
    let place = slots.attitude().start;
    let direction = match at.kind() {
        KindAt::Rigid(..) => rotated_back([0, 1, 2, 3].map(|i| numbers.at(place + i)), normal),
        // P stands column by column.
        _ => [0, 3, 6].map(|column| Extended::dot(&[0, 1, 2].map(|row| numbers.at(place + column + row)), normal)),
    };
    let above = |i: usize, place: Extended| place - origin[i].into() - shift[i].into();
    let height = match &body.pin {
        None => {
            let position = slots.position().start;
            Extended::dot(&[0, 1, 2].map(|i| above(i, numbers.at(position + i))), normal)
        }
        Some(pin) => {
            let anchor = Extended::dot(&[0, 1, 2].map(|i| above(i, pin.anchor[i].into())), normal);
            anchor - Extended::dot(&direction, &pin.point)
        }
    };
    Some(match keeps_digits {
        true => GapField::extended(height, &direction),
        false => GapField::new(height.value(), at.motion.placement.gradient.tr_mul(normal)),
    })
}

/// How the support of a contact moves.
pub(super) fn carrying(at: &MotionAt, contact: &Contact) -> PlaneMotion {
    at.model.supports[contact.support].motion_at(at.time)
}

/// The angular velocity of the support of a contact [rad/s], if it turns.
pub(super) fn turning_of(at: &MotionAt, contact: &Contact) -> Option<Vec3> {
    carrying(at, contact).spin
}

/// The smallest distance of a body to a support that it has a contact with [m], to all the digits of the state;
/// infinite without one.
pub(super) fn support_gap_at(at: &MotionAt) -> f64 {
    least_of_supports(at.model, at.index, |surface, support| gap_field(at, surface, support))
}

/// The smallest distance of a body's surface to a support that it has a contact with [m]; infinite without one.
pub fn gap_to_supports(model: &Model, time: f64, index: usize, motion: &BodyMotion) -> f64 {
    least_of_supports(model, index, |_, support| support.gap_field(&motion.placement, time))
}

/// The least gap of the fields of those supports that a body has a contact with.
fn least_of_supports(model: &Model, index: usize, field: impl Fn(&Surface, &Support) -> GapField) -> f64 {
    let Some(surface) = &model.bodies[index].solid.surface else { return f64::INFINITY };
    let supports = model.contacts_of(index).map(|contact| &model.supports[contact.support]);
    supports.map(|support| surface.smallest_gap(&field(surface, support)).0).fold(f64::INFINITY, f64::min)
}

/// The support next to a body's surface, whether or not the two have a contact; none without supports or surface.
pub fn nearest(model: &Model, time: f64, index: usize, motion: &BodyMotion) -> Option<Nearest> {
    let surface = model.bodies[index].solid.surface.as_ref()?;
    let radius = model.bodies[index].solid.radius().unwrap_or(f64::INFINITY);
    let mut nearest: Option<Nearest> = None;
    for support in model.supports.iter() {
        let field = support.gap_field(&motion.placement, time);
        let least = field.height - (1.0 + ROUNDING) * radius * field.direction.norm();
        if nearest.is_some_and(|nearest| least > nearest.gap) {
            continue;
        }
        let (gap, point) = surface.smallest_gap(&field);
        if nearest.is_none_or(|nearest| gap.total_cmp(&nearest.gap).is_lt()) {
            let normal = support.at(time).normal;
            let carried = support.motion_at(time).at(&motion.placement.place(&point));
            nearest = Some(Nearest { gap, normal, point, speed: (motion.velocity.at(&point) - carried).dot(&normal) });
        }
    }
    nearest
}
