//! The die that the peers throw: side 2 cm, 10 g, from 0.1–0.3 m in any attitude, spinning up to 40 rad/s, until at
//! rest.
//!
//! In units of side L, density ρ and g, with d₀ = L:
//!
//!   ν = 6, α = γ⁶ ρgL (γ is the rest gap over L);   ν_d = ν_f = 3, β = b ρ√(gL), b = 5·10⁻⁴
//!
//! Throw k has random numbers of its own (SplitMix64 from the key k), so that it is the same whatever else is thrown.

use crate::random::Random;
use gyration::kinematics::Quaternion;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Vec3;
use gyration_scene::Scene;
use gyration_sim::RunPlan;
use std::path::Path;

/// The side of the die [m].
pub const SIDE: f64 = 0.02;
/// The acceleration of gravity [m/s²].
pub const GRAVITY: f64 = 9.81;
/// The peers' β of damping and friction in units of side, density and g.
pub const BETA: f64 = 5e-4;
/// The lowest and the highest start [m].
const HEIGHTS: (f64, f64) = (0.1, 0.3);
/// The fastest spin [rad/s].
const FASTEST_SPIN: f64 = 40.0;

/// A die above a table, its start, and the plan of a throw.
#[derive(Debug, Clone)]
pub struct Die {
    /// Die and table.
    pub model: Model,
    /// A start: level, 0.2 m above the table, at rest.
    pub start: State,
    /// Until at rest (slower than 0.1 mm/s for 0.1 s), or 20 s.
    pub plan: RunPlan,
}

impl Die {
    /// The die with a rest gap, as a fraction of its side, a coefficient b of damping and friction, and a relative
    /// tolerance.
    ///
    /// # Panics
    /// If the scene is not valid: a mistake in this file.
    pub fn new(rest_gap: f64, damping: f64, rtol: f64) -> Self {
        let density = 0.01 / SIDE.powi(3);
        let alpha = rest_gap.powi(6) * density * GRAVITY * SIDE;
        let beta = damping * density * (GRAVITY * SIDE).sqrt();
        let text = format!(
            r#"
title = "A thrown die"
world = {{ gravity = [0, 0, -{GRAVITY}] }}
time = {{ end = 20, sample = 20, stop_at_rest = {{ speed = 1e-4, hold = 0.1 }} }}
solver = {{ rtol = {rtol:e}, atol = {atol:e} }}
[[support]]
name = "table"
plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
[[contact]]
support = "table"
repulsion = {{ alpha = {alpha:e}, nu = 6, d0 = {SIDE} }}
damping = {{ beta = {beta:e}, nu = 3, d0 = {SIDE} }}
friction = {{ beta = {beta:e}, nu = 3, d0 = {SIDE} }}
[[body]]
name = "die"
shape = {{ box = {{ size = [{SIDE}, {SIDE}, {SIDE}] }} }}
mass = 0.01
position = [0, 0, 0.2]
"#,
            atol = 0.01 * rtol,
        );
        match Scene::parse("die.toml", &text, Path::new(""), &[]) {
            Ok(scene) => {
                let built = scene.built();
                Self { model: built.model.clone(), start: built.state.clone(), plan: built.into() }
            }
            Err(errors) => panic!("{errors}"),
        }
    }

    /// The start of throw `number`.
    pub fn throw(&self, number: u64) -> State {
        let mut random = Random::new(number);
        let (lowest, highest) = HEIGHTS;
        let height = lowest + (highest - lowest) * random.uniform();
        let quaternion = Quaternion(std::array::from_fn(|_| random.normal())).normalized();
        let axis = Vec3::from_fn(|_, _| random.normal()).normalize();
        let spin = FASTEST_SPIN * random.uniform() * axis;
        let mut start = self.start.clone();
        let slots = self.model.slots(0);
        start.bodies[slots.position()].copy_from_slice(&[0.0, 0.0, height]);
        start.bodies[slots.attitude()].copy_from_slice(&quaternion.0);
        start.bodies[slots.velocity()].fill(0.0);
        start.bodies[slots.rate()].copy_from_slice(spin.as_slice());
        start
    }

    /// A drop from 0.2 m without spin, turned by an angle [rad] about an axis.
    pub fn drop(&self, axis: &Vec3, angle: f64) -> State {
        let mut start = self.start.clone();
        let attitude = self.model.slots(0).attitude();
        start.bodies[attitude].copy_from_slice(&Quaternion::from_axis_angle(axis, angle).0);
        start
    }

    /// The face that a state shows to the table: 0 to 5, twice the axis plus one for its positive sense.
    pub fn lowest_face(&self, state: &State) -> usize {
        let down = state.motion(&self.model, 0).placement.gradient.tr_mul(&Vec3::new(0.0, 0.0, -1.0));
        let axis = down.iamax();
        2 * axis + usize::from(down[axis] > 0.0)
    }
}
