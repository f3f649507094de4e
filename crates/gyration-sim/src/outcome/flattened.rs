//! A body whose volume vanishes: when it is flattened, what may press it, and what withstands that.
//!
//! A step that is refused tells det P of a trial, which may be any number. What a body has come to is det P of the last
//! state that was accepted.

use gyration::acting::Load;
use gyration::contractile::ContractionSource;
use gyration::model::Model;
use gyration::signal::Signal;
use gyration::state::BodyMotion;
use gyration::tensor::Mat3;
use std::convert::Infallible;

/// det P below which a body that cannot go on is flattened: no matter withstands being pressed to a billionth of its
/// volume. Towards a time t at which det P vanishes, steps shrink down to the last digit of t, 2e-16 of it; det P is of
/// that order then, where its rate is one over t.
const FLAT: f64 = 1e-9;

/// The flattest body that deforms, with its det P, if that is below the bound; of the numbers of all bodies.
pub(super) fn flattened(model: &Model, numbers: &[f64]) -> Option<(usize, f64)> {
    let deforming = (0..model.bodies.len()).filter(|body| model.bodies[*body].affine().is_some());
    let flat = deforming.map(|body| (body, volume(model, body, numbers))).filter(|(_, volume)| *volume <= FLAT);
    flat.min_by(|(_, one), (_, other)| one.total_cmp(other))
}

/// det P of a body, of the numbers of all bodies.
pub(super) fn volume(model: &Model, body: usize, numbers: &[f64]) -> f64 {
    let motion = BodyMotion::read(&model.bodies[body], model.slots(body), numbers);
    motion.placement.gradient.determinant()
}

/// What to change so that a body keeps a volume, by what acts on it.
pub(super) fn advice(model: &Model, index: usize) -> String {
    let body = &model.bodies[index];
    let pressing = pressing(model, index).join(", ");
    let besides = if pressing.is_empty() { String::new() } else { format!(" What may press it besides: {pressing}.") };
    let source = body.contraction().map(|contraction| &contraction.source);
    match source {
        Some(ContractionSource::Prescribed(_)) => format!(
            "Its prescribed contraction leaves it no volume: prescribe one that stays farther above zero, or give it a \
             material that withstands compression.{besides}"
        ),
        Some(ContractionSource::Driven { drive, feedback }) => {
            let is_driven = *drive != Signal::Constant(Mat3::zeros()) || !feedback.is_empty();
            match (is_driven, pressing.is_empty()) {
                (true, _) => format!(
                    "Its drive contracts it without end, or faster than it yields: raise the `contraction_viscosity`, \
                     weaken the drive, or let it answer to the stretch by a `feedback`.{besides}"
                ),
                (false, true) => "It has no drive, but goes on as it starts: raise the `contraction_viscosity`, keep \
                                  its relaxed volume by `isochoric = true`, or start it with a smaller `gradient_rate`."
                    .to_owned(),
                (false, false) => format!(
                    "It has no drive, but yields without end to what presses it: {pressing}. Raise the \
                     `contraction_viscosity`, keep its relaxed volume by `isochoric = true`, or weaken that."
                ),
            }
        }
        None if !body.has_inertia() => {
            "The flow presses it flat: a body without elasticity closes like a void. Give it a material with a `bulk` \
             or a logarithm of the volume, or an incompressible one, or a weaker flow."
                .to_owned()
        }
        None => {
            let change = match pressing.is_empty() {
                true => "start it with a smaller `gradient_rate`".to_owned(),
                false => format!("weaken what presses it: {pressing}"),
            };
            format!(
                "Only a material whose energy grows without bound under compression forbids that: one with a `bulk` or \
                 a logarithm of the volume, or an incompressible one; or {change}."
            )
        }
    }
}

/// What may press a body together, in words, each once.
fn pressing(model: &Model, index: usize) -> Vec<&'static str> {
    let mut found: Vec<&'static str> = Vec::new();
    let mut note = |word| {
        if !found.contains(&word) {
            found.push(word);
        }
    };
    if model.has_contact(index) {
        note("its contacts");
    }
    let each = |load: Load<'_>| {
        if let Some(word) = word(&load) {
            note(word);
        }
        Ok::<(), Infallible>(())
    };
    let Ok(()) = model.try_each_load(index, each);
    found
}

fn word(load: &Load<'_>) -> Option<&'static str> {
    match load {
        Load::Contact(_) | Load::Pair(_) => Some("its contacts"),
        Load::Spring(_) => Some("its springs"),
        Load::Bond(_) => Some("its bonds"),
        Load::Joint(_) => Some("its joints"),
        Load::Couple(_) => Some("its `couple`"),
        Load::Applied(_) => Some("what a controller applies"),
        Load::Potential(_) => Some("its `potential`"),
        Load::BodyForce(_) => Some("its `body_force`"),
        Load::PointForce(_) => Some("its `force`"),
        Load::SelfGravity(_) => Some("its own gravity"),
        Load::Fluid(..) | Load::Walls(_) | Load::Neighbours(_) => Some("the fluid"),
        Load::Resistance(_) | Load::OwnFriction(_) | Load::MassFriction(_) => None,
    }
}
