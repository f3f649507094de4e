//! Small bodies on large faces: one plane stands for the whole of a face, and tilts where a body is beside its middle.
//!
//! A body rests where the repulsion along the normal is its weight; the tangent of the tilt there is the part of the
//! weight that pushes it away from the middle. Source: `docs/theory-meetings.md`, large faces.

use crate::format::significant;
use crate::survey::Encounter;
use gyration::Party;
use gyration::model::Model;
use gyration::neighbours::Pair;
use gyration::shape::{Cuboid, Shape};
use gyration::state::State;
use gyration::tensor::Vec3;

/// A face so many times as wide as a body is large beside it.
const LARGE: f64 = 4.0;
/// A face is level whose normal is that much along the vertical.
const LEVEL: f64 = 0.99;
/// A push that no one sees, in weights.
const LEAST: f64 = 1e-8;
/// Pairs that are looked at.
const MOST_PAIRS: usize = 1000;
/// Bodies that are told.
const MOST: usize = 3;
/// Bisections of a slab, by geometric means between these parts of the size.
const BISECTIONS: usize = 40;
const SLABS: [f64; 2] = [1e-9, 1.0];

/// A body on a large face.
struct OnPlate<'a> {
    body: &'a str,
    plate: &'a str,
    /// What pushes it away from the middle, in weights.
    push: f64,
}

/// What must be told of bodies on large faces.
pub(super) fn notes(model: &Model, start: &State) -> Vec<String> {
    let between = model.pairs().take(MOST_PAIRS);
    let at_supports = model.pairs_with_supports().iter().take(MOST_PAIRS);
    let on = |pair: &Pair| [0, 1].into_iter().find_map(|plate| on_plate(model, start, pair, plate));
    let found: Vec<OnPlate> = between.filter_map(|pair| on(&pair)).chain(at_supports.filter_map(on)).collect();
    let told = found.iter().take(MOST).map(|OnPlate { body, plate, push }| {
        format!(
            "\"{body}\" is beside the middle of a large face of \"{plate}\", which is felt as a whole: where it lies \
             there, {} of its weight pushes it away; floors and tables are planes",
            significant(*push, 2)
        )
    });
    let more = found.len().saturating_sub(MOST);
    told.chain((more > 0).then(|| format!("{more} bodies more are beside the middle of large faces"))).collect()
}

/// The body on the one of a pair that is a plate, if it is.
fn on_plate<'a>(model: &'a Model, start: &State, pair: &Pair, plate: usize) -> Option<OnPlate<'a>> {
    let Party::Body(small) = pair.parties[1 - plate] else { return None };
    let (shape, placement) = match pair.parties[plate] {
        Party::Body(body) if model.bodies[body].affine().is_none() => {
            (&model.bodies[body].solid.shape, start.motion_in_space(model, body).placement)
        }
        Party::SolidSupport(support) => {
            (&model.solid_supports[support].solid.shape, model.solid_supports[support].at(start.time).placement)
        }
        _ => return None,
    };
    let Shape::Box(Cuboid { size }) = shape else { return None };
    let body = &model.bodies[small];
    let up = -model.gravity.try_normalize(0.0)?;
    let (axis, facing) =
        (0..3).map(|axis| (axis, placement.gradient.column(axis).dot(&up))).find(|it| it.1.abs() > LEVEL)?;
    let across = [(axis + 1) % 3, (axis + 2) % 3];
    let place =
        placement.gradient.tr_mul(&(start.motion_in_space(model, small).placement.position - placement.position));
    let is_over = |axis: usize| size[axis] > LARGE * body.size && 2.0 * place[axis].abs() < size[axis];
    if place[axis] * facing <= 0.0 || !across.into_iter().all(is_over) {
        return None;
    }
    let encounter = Encounter::new(model, start, pair)?;
    let normal = placement.gradient.column(axis) * facing.signum();
    let weight = body.solid.mass.mass * model.gravity.norm();
    let at_rest = rest(&encounter, body.size, weight)?;
    // From the plate to the body.
    let found: Vec3 = if plate == 1 { at_rest } else { -at_rest };
    let along = found.dot(&normal);
    let push = (found - along * normal).norm() / along;
    (push > LEAST).then(|| OnPlate { body: model.name(small), plate: model.party_name(pair.parties[plate]), push })
}

/// The normal of the plane where the repulsion is a weight \[N\]; none where it is not found.
fn rest(encounter: &Encounter, size: f64, weight: f64) -> Option<Vec3> {
    let [mut near, mut far] = SLABS.map(|part| part * size);
    for _ in 0..BISECTIONS {
        let middle = (near * far).sqrt();
        let [_, force] = encounter.at(middle)?;
        if force > weight { near = middle } else { far = middle }
    }
    encounter.normal_at(near)
}
