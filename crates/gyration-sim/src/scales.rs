//! The scales of a body that do not change in a run: how fast it moves by itself, how much energy that is, how fast its
//! springs swing it.

use gyration::Inadmissible;
use gyration::acting::Load;
use gyration::balance::fastest_speed;
use gyration::body::{Body, Solid};
use gyration::contact::Contact;
use gyration::contractile::Contraction;
use gyration::dynamics::{Scratch, Workspace, each_push};
use gyration::instant::{BodyAt, MotionAt};
use gyration::model::Model;
use gyration::neighbours::PairRule;
use gyration::pair::PairForm;
use gyration::signal::Signal;
use gyration::state::{BodyMotion, State};
use gyration::support::{MotionPart, SupportMotion};
use gyration::tensor::Mat3;
use gyration_ode::Components;
use std::convert::Infallible;
use std::ops::Range;
use std::sync::Arc;

/// The energy in play of a body [J]: ½ m v², or without inertia what the fluid turns into heat while it moves by its
/// size, η v size².
pub(crate) fn energy_scale(model: &Model, body: &Body, speed: f64) -> f64 {
    match &model.fluid {
        Some(fluid) if !body.has_inertia() => fluid.viscosity * speed * body.size * body.size,
        _ => 0.5 * body.solid.mass.mass * speed * speed,
    }
}

/// A speed below this part of a size in a period of what drives the body is the rounding of none: a drive may begin
/// where it turns round.
const TURNING: f64 = 1e-9;
/// The speed scale of a body with a material that nothing moves, over that of its elastic waves: its tolerances are
/// then no less than the rounding of stresses.
const STIRRED: f64 = 1e-4;
/// Stresses below this part of those of a strain of one, and their energies, are rounding.
pub(crate) const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The speed scales of the bodies of a run [m/s]; those of an island are the same as those of the run.
///
/// A body's own scale is its initial speed or √(g·size), or one size in a period of what drives it. A body that starts
/// at rest without gravity takes that of the accelerations which contacts, springs and other bodies would give it one
/// by one, or the speed of a support, as far as it reaches the body: where they cancel, what is left is rounding, and
/// so is the stress of a body that is only turned. Whatever bodies act on one another, however far they are, may share
/// their motion: each takes the largest speed among them, as far as their largest momentum would move it. A body that
/// nothing moves takes one size a second, or a part of the speed of its elastic waves, of which the rounding of its
/// stresses is 1e-16.
///
/// # Errors
/// [`Inadmissible`] if the start is outside the model.
pub(crate) fn speed_scales(model: &Model, start: &State, slopes: &[f64]) -> Result<Vec<f64>, Inadmissible> {
    let bodies = model.bodies.len();
    let mut scales: Vec<f64> = (0..bodies).map(|index| own_scale(model, start, slopes, index)).collect();
    if scales.contains(&0.0) {
        let mut workspace = Workspace::default();
        let (instant, scratch) = workspace.read(model, start)?;
        for (index, scale) in scales.iter_mut().enumerate().filter(|(_, scale)| **scale == 0.0) {
            *scale = pushed(&instant.at(index), slopes, scratch)?;
        }
    }
    for members in Components::joined(bodies, model.chain()).iter().filter(|members| members.len() > 1) {
        let mass = |body: usize| model.bodies[body].solid.mass.mass;
        let moving = || members.iter().filter(|body| model.bodies[**body].has_inertia());
        let speed = moving().map(|body| scales[*body]).fold(0.0, f64::max);
        let momentum = moving().map(|body| mass(*body) * scales[*body]).fold(0.0, f64::max);
        moving().for_each(|body| scales[*body] = scales[*body].max(speed.min(momentum / mass(*body))));
    }
    for (scale, body) in scales.iter_mut().zip(&model.bodies).filter(|(scale, _)| **scale == 0.0) {
        let stirred = if body.has_inertia() { STIRRED * elastic_frequency(body) } else { 0.0 };
        *scale = body.size * f64::max(1.0, stirred);
    }
    Ok(scales)
}

/// How fast a body moves by itself [m/s]; zero if it starts at rest and neither gravity nor a drive moves it.
fn own_scale(model: &Model, start: &State, slopes: &[f64], index: usize) -> f64 {
    let (body, slots) = (&model.bodies[index], model.slots(index));
    let (motion, falling) = match body.has_inertia() {
        true => (start.motion(model, index), (model.gravity.norm() * body.size).sqrt()),
        // Gravity moves it as fast as the fluid allows.
        false => (BodyMotion::of_rates(body, slots, &start.bodies, slopes), 0.0),
    };
    let scale = fastest_speed(body, &motion).max(falling);
    let drive = body.contraction().map(Contraction::signal);
    let driving = drive.into_iter().chain(model.fluid.iter().flat_map(|fluid| fluid.signals()));
    let driven = body.size * driving.map(Signal::highest_frequency).fold(0.0, f64::max);
    match () {
        () if scale > TURNING * driven => scale,
        () if !body.has_inertia() => driven,
        () => 0.0,
    }
}

/// The speed that what acts on a body at rest gives it over its size [m/s], or that of a support or an anchor.
fn pushed(at: &BodyAt, slopes: &[f64], scratch: &mut Scratch) -> Result<f64, Inadmissible> {
    let MotionAt { model, body, index, .. } = **at;
    if !body.has_inertia() {
        return Ok(0.0);
    }
    // The velocities' places in the rates hold the accelerations.
    let slots = model.slots(index);
    let norm = |slot: Range<usize>| slopes[slot].iter().map(|number| number * number).sum::<f64>().sqrt();
    let acceleration = norm(slots.velocity()) + norm(slots.rate()) * body.size;
    let of_rounding = ROUNDING * body.size * elastic_frequency(body).powi(2);
    let acceleration = if acceleration > of_rounding { acceleration } else { 0.0 };
    let mut forces = 0.0;
    each_push(at, scratch, |push| forces += push.force)?;
    let supports = model.contacts_of(index).map(|contact| carried_by_plane(at, contact));
    let rules = model.rules().with_supports_of(index);
    let solids = rules.flat_map(|rule| rule.supports.iter().map(|support| carried_by_solid(at, rule, *support)));
    let springs = model.springs_of(index).filter_map(|end| end.interaction.anchor());
    let anchors = springs.chain(model.joints_of(index).map(|end| &end.interaction.anchor));
    let anchors = anchors.map(|anchor| anchor.motion.bound(&anchor.start).speed);
    let carried = supports.chain(solids).chain(anchors).fold(0.0, f64::max);
    Ok((acceleration.max(forces / body.solid.mass.mass) * body.size).sqrt().max(carried))
}

/// The largest speed [m/s] of a plane at a body that starts at rest; of one that moves to and fro no more than its
/// field can give the body from its foremost place, ½ m v² = W.
fn carried_by_plane(at: &BodyAt, contact: &Contact) -> f64 {
    let (body, placement) = (at.body, &at.motion.placement);
    let support = &at.model.supports[contact.support];
    let speed = support.motion.bound(&placement.position).speed;
    if speed == 0.0 {
        return 0.0;
    }
    let Some(surface) = &body.solid.surface else { return speed };
    let mut field = support.gap_field(placement, 0.0);
    field.height = (placement.position - support.origin).dot(&support.normal) - support.forward_amplitude();
    let distance = surface.smallest_gap(&field).0;
    if distance <= 0.0 || !only_oscillates(&support.motion) {
        return speed;
    }
    let work = contact.law_set.work_beyond(surface.area(), distance, speed);
    speed.min((2.0 * work / body.solid.mass.mass).sqrt())
}

/// The same of a support with a shape, whose sphere has a foremost place.
fn carried_by_solid(at: &BodyAt, rule: &PairRule, support: usize) -> f64 {
    let (body, support) = (at.body, &at.model.solid_supports[support]);
    let speed = support.largest_speed();
    if speed == 0.0 || !only_oscillates(&support.motion) {
        return speed;
    }
    let way = |part: &MotionPart| match part {
        MotionPart::Oscillation { direction, amplitude, .. } => amplitude.abs() * direction.norm(),
        MotionPart::Velocity(_) | MotionPart::Rotation { .. } => 0.0,
    };
    let placement = &at.motion.placement;
    let apart = (placement.position - support.start.position).norm();
    let ways: f64 = support.motion.parts().iter().map(way).sum();
    let distance = apart - ways - body.radius_at(placement) - support.solid.radius().unwrap_or(0.0);
    if distance <= 0.0 {
        return speed;
    }
    let work = |parts: [usize; 2]| {
        let surfaces = [body.solid.part(parts[0]), support.solid.part(parts[1])];
        PairForm::new(Arc::clone(&rule.laws), None, surfaces).most_work(distance, speed, surfaces)
    };
    let parts = Solid::parts_of([&*body.solid, &*support.solid]);
    let works: f64 = parts.map(work).sum();
    speed.min((2.0 * works / body.solid.mass.mass).sqrt())
}

/// Whether a motion only goes to and fro.
fn only_oscillates(motion: &SupportMotion) -> bool {
    motion.parts().iter().all(|part| matches!(part, MotionPart::Oscillation { .. }))
}

/// V |∂S/∂P| of the material of a body at P = 1 [J]; zero without one.
pub(crate) fn elastic_stiffness(body: &Body) -> f64 {
    let material = body.affine().and_then(|affine| affine.interior.material.as_ref());
    material.map_or(0.0, |material| body.solid.mass.volume * material.tangent(&Mat3::identity()).norm())
}

/// √(V |∂S/∂P|/J) of a body with a material, J the smallest principal moment [1/s]; zero of others.
pub(crate) fn elastic_frequency(body: &Body) -> f64 {
    let stiffness = elastic_stiffness(body);
    if stiffness == 0.0 { 0.0 } else { (stiffness / body.solid.mass.euler_tensor.symmetric_eigenvalues().min()).sqrt() }
}

/// √(Σk/m) of the springs and bonds at a body, where they start [1/s].
pub(crate) fn spring_frequency(model: &Model, start: &State, index: usize) -> f64 {
    let mut stiffness = 0.0;
    let listed = model.try_each_load(index, |load| {
        stiffness += match load {
            Load::Spring(end) => end.interaction.law.stiffness,
            Load::Bond(end) => {
                let [one, other] = end.interaction.bodies.map(|body| start.motion(model, body));
                let shift = model.lattice.place(end.interaction.cell);
                end.interaction.stiffness([&one, &other], &shift, start.time)
            }
            Load::Contact(_)
            | Load::Pair(_)
            | Load::Joint(_)
            | Load::Couple(_)
            | Load::Applied(_)
            | Load::Resistance(_)
            | Load::Potential(_)
            | Load::BodyForce(_)
            | Load::PointForce(_)
            | Load::OwnFriction(_)
            | Load::MassFriction(_)
            | Load::SelfGravity(_)
            | Load::Fluid(..)
            | Load::Walls(_)
            | Load::Neighbours(_) => 0.0,
        };
        Ok::<(), Infallible>(())
    });
    let Ok(()) = listed;
    (stiffness / model.bodies[index].solid.mass.mass).sqrt()
}
