//! The scales of a body that do not change in a run: how fast it moves by itself, how much energy that is, how fast its
//! springs swing it.

use gyration::acting::Load;
use gyration::balance::fastest_speed;
use gyration::body::Body;
use gyration::contractile::Contraction;
use gyration::model::Model;
use gyration::signal::Signal;
use gyration::state::{BodyMotion, State};
use std::convert::Infallible;
use std::ops::Range;

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

/// A body's own speed [m/s]: initial or √(g·size); where both vanish that of its first acceleration, one size in a
/// period of what drives it, and one size a second for a body that nothing moves.
pub(crate) fn speed_scale(model: &Model, start: &State, slopes: &[f64], index: usize) -> f64 {
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
    if scale > TURNING * driven {
        return scale;
    }
    if !body.has_inertia() {
        return if driven > 0.0 { driven } else { body.size };
    }
    // A body that starts at rest without gravity: the velocities' places in the rates hold the accelerations.
    let norm = |slot: Range<usize>| slopes[slot].iter().map(|number| number * number).sum::<f64>().sqrt();
    let acceleration = norm(slots.velocity()) + norm(slots.rate()) * body.size;
    // Where springs hold each other in balance, what is left of them is rounding.
    let scale = (acceleration.max(pulled(model, start, index)) * body.size).sqrt();
    if scale > 0.0 { scale } else { body.size }
}

/// The accelerations that the springs at a body would give to its centre one by one, in sum [m/s²].
fn pulled(model: &Model, start: &State, index: usize) -> f64 {
    let own = start.motion(model, index);
    let mut sum = 0.0;
    let listed = model.try_each_load(index, |load| {
        let loads = match load {
            Load::Spring(_, spring) => spring.loads(&own.placement, &own.velocity),
            Load::Bond(end) => {
                let other = start.motion(model, end.other());
                end.loads((&own.placement, &own.velocity), (&other.placement, &other.velocity))
            }
            _ => None,
        };
        sum += loads.map_or(0.0, |loads| loads.force.norm());
        Ok::<(), Infallible>(())
    });
    let Ok(()) = listed;
    sum / model.bodies[index].solid.mass.mass
}

/// √(Σk/m) of the springs at a body [1/s].
pub(crate) fn spring_frequency(model: &Model, index: usize) -> f64 {
    let mut stiffness = 0.0;
    let listed = model.try_each_load(index, |load| {
        stiffness += match load {
            Load::Spring(_, spring) => spring.law.stiffness,
            Load::Bond(end) => end.joint.law.stiffness,
            _ => 0.0,
        };
        Ok::<(), Infallible>(())
    });
    let Ok(()) = listed;
    (stiffness / model.bodies[index].solid.mass.mass).sqrt()
}
