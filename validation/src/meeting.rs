//! What several problems of bodies that meet measure.

use crate::Run;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::{Vec3, axial};

/// Σ m ṗ₀ and Σ (p₀ × m ṗ₀ + axial of Ṗ J Pᵀ), about the origin.
pub fn momenta(model: &Model, state: &State) -> (Vec3, Vec3) {
    let mut sum = (Vec3::zeros(), Vec3::zeros());
    for (index, body) in model.bodies.iter().enumerate() {
        let motion = state.motion(model, index);
        let momentum = body.solid.mass.mass * motion.velocity.velocity;
        let own = motion.velocity.gradient_rate * body.solid.mass.euler_tensor * motion.placement.gradient.transpose();
        sum.0 += momentum;
        sum.1 += motion.placement.position.cross(&momentum) + axial(&own);
    }
    sum
}

/// The speeds with which a wave of falling dominoes, `domino-0` and so on, goes from each to the next but the first
/// \[m/s\]: it passes one when that has turned by 2°, on a line between samples.
///
/// # Panics
/// If one of them stands to the end.
pub fn wave(run: &Run, dominoes: usize, pitch: f64) -> Vec<f64> {
    let turned = 0.035;
    let passed = |index: usize| {
        let sine = run.column(&format!("domino-{index}.P_xz"));
        let after = sine.iter().position(|it| *it > turned).unwrap_or_else(|| panic!("domino-{index} stands"));
        let share = (turned - sine[after - 1]) / (sine[after] - sine[after - 1]);
        run.times[after - 1] + share * (run.times[after] - run.times[after - 1])
    };
    (1..dominoes - 1).map(|index| pitch / (passed(index + 1) - passed(index))).collect()
}
