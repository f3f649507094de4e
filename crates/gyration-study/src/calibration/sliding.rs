//! A body on a slope: how fast it slides, and where it begins to.
//!
//! Viscous friction holds nothing: a body slides on every slope, v = (α/β) tan θ where both exponents are the same, and
//! a slope is measured together with a speed. A bound μ on friction lets it begin to slide at tan θ = μ, if nothing but
//! its weight presses.

use super::nearby::Nearby;
use super::scene::{body, force, normal, velocity};
use super::{Calibration, Experiment};
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Vec3;
use gyration_scene::Scene;

/// The steady speed under the part of gravity along the slope, from the friction in the rest state.
pub(super) fn speed(tilted: &Scene, experiment: &Experiment, slope: f64, nearby: &mut Nearby) -> Result<f64, String> {
    let drag = Drag::of(tilted, experiment, nearby)?;
    let name = &experiment.body;
    // |g| was multiplied by cos θ.
    let needed = drag.mass * drag.pressing * libm::tan(slope);
    let resistance = drag.at(1.0)?;
    if resistance <= 0.0 {
        return Err(format!("no friction acts on {name:?}: on a slope it gets faster for ever"));
    }
    if !drag.is_bounded {
        return Ok(needed / resistance);
    }
    let (mut low, mut high) = (-FASTEST, FASTEST);
    if drag.at(libm::exp(high))? <= needed {
        return Err(format!("the friction of {name:?} is bounded: on this slope it gets faster for ever"));
    }
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if drag.at(libm::exp(middle))? < needed { low = middle } else { high = middle }
    }
    Ok(libm::exp(0.5 * (low + high)))
}

/// The logarithm of a speed [m/s] that is far beyond all bounds.
const FASTEST: f64 = 30.0;
/// Halvings of that to rounding.
const BISECTIONS: usize = 70;
/// More steps than the secant takes, and when it ends [rad].
const MOST_SECANTS: usize = 50;
const SECANT_ENDS: f64 = 1e-13;
/// It also ends where it comes no nearer, for want of digits, if it is as near as this [rad]: a support a kilometre off
/// leaves a gap of a millimetre ten of its digits.
const SECANT_NEAR: f64 = 1e-7;

impl Calibration {
    /// The slope at which friction holds no more than the weight's part along it.
    pub(super) fn begins(&self, experiment: &Experiment, values: &[f64], nearby: &mut Nearby) -> Result<f64, String> {
        let scene = self.scene(experiment, 0.0, values, &[])?;
        let mut off = |slope: f64| -> Result<f64, String> {
            let gravity = self.pressing(experiment, &scene, slope)?;
            let tilted = self.scene(experiment, slope, values, &[gravity])?;
            let drag = Drag::of(&tilted, experiment, nearby)?;
            let most = drag.at(libm::exp(FASTEST))?;
            if !drag.is_bounded {
                let name = &experiment.body;
                return Err(format!("the friction of {name:?} is viscous: it slides on every slope; give it a `mu`"));
            }
            Ok(libm::atan(most / (drag.mass * drag.pressing)) - slope)
        };
        let mut before = off(0.0)?;
        let (mut last, mut here, mut nearest) = (0.0, before, (0.0, before));
        for _ in 0..MOST_SECANTS {
            let now = off(here)?;
            if now.abs() <= SECANT_ENDS {
                return Ok(here);
            }
            let is_nearer = now.abs() < nearest.1.abs();
            if now == before || (!is_nearer && nearest.1.abs() <= SECANT_NEAR) {
                break;
            }
            if is_nearer {
                nearest = (here, now);
            }
            let step = now * (here - last) / (before - now);
            (last, before) = (here, now);
            here += step;
        }
        if nearest.1.abs() <= SECANT_NEAR {
            return Ok(nearest.0);
        }
        Err(format!("no slope is found at which {:?} begins to slide", experiment.body))
    }
}

/// The friction of a body in its rest state.
struct Drag<'a> {
    model: &'a Model,
    index: usize,
    /// At rest.
    still: State,
    /// Across the normal of its support.
    along: Vec3,
    /// Where its velocity stands.
    at: usize,
    mass: f64,
    /// |g| [m/s²].
    pressing: f64,
    /// Whether friction of it has a bound.
    is_bounded: bool,
}

impl<'a> Drag<'a> {
    fn of(tilted: &'a Scene, experiment: &Experiment, nearby: &mut Nearby) -> Result<Self, String> {
        let built = tilted.built();
        let (model, index) = (&built.model, body(&built.model, experiment)?);
        let state = nearby.rest(model, &built.state, index)?;
        let normal = normal(model, index)?;
        let level = [Vec3::x(), Vec3::y()].map(|axis| axis - normal * normal.dot(&axis));
        let along = if level[0].norm() > level[1].norm() { level[0] } else { level[1] }.normalize();
        let mut still = built.state.clone();
        still.bodies[model.blocks()[index].clone()].copy_from_slice(state.block());
        Ok(Self {
            model,
            index,
            still,
            along,
            at: velocity(model, index)?,
            mass: model.bodies[index].solid.mass.mass,
            pressing: model.gravity.norm(),
            is_bounded: model.contacts_of(index).any(|contact| contact.law_set.mu().is_some()),
        })
    }

    /// What holds it back at a speed along its support [N].
    fn at(&self, speed: f64) -> Result<f64, String> {
        let Self { model, index, still, along, at, .. } = self;
        let mut moving = still.clone();
        moving.bodies[*at..at + 3].copy_from_slice((speed * along).as_slice());
        Ok(-(force(model, &moving, *index)? - force(model, still, *index)?).dot(along))
    }
}
