//! Scales of the state, and derivatives of what is known in a state along a direction of it.

use super::Meaningless;
use crate::adapter::{ModelSystem, Tolerance};
use crate::outcome::Stop;
use crate::variation::NoDerivative;
use gyration::Inadmissible;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::System as _;

/// Scales of the state, lengths being gaps: what changes by one of them has changed altogether. A thousandth of the
/// body's own size and speed counts at least.
pub(crate) const SCALES: Tolerance = Tolerance { rtol: 10.0, atol: 1e-2 };
/// The state is varied along S by this part of its scales.
const PROBE: f64 = 5e-4;

/// The derivative of something along a direction of the state, by differences of fourth order; `evaluate` gives it at a
/// multiple of the direction.
pub(super) fn along<E>(
    direction: &[f64],
    scales: &[f64],
    mut evaluate: impl FnMut(f64) -> Result<Vec<f64>, E>,
) -> Result<Vec<f64>, E> {
    let size = direction.iter().zip(scales).map(|(part, scale)| part.abs() / scale).fold(0.0, f64::max);
    if size == 0.0 {
        return Ok(vec![0.0; evaluate(0.0)?.len()]);
    }
    let step = PROBE / size;
    let [a, b, c, d] = [evaluate(-2.0 * step)?, evaluate(-step)?, evaluate(step)?, evaluate(2.0 * step)?];
    let at = |i: usize| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * step);
    Ok((0..a.len()).map(at).collect())
}

/// The scales of state and works.
pub(super) fn fill_scales(system: &mut ModelSystem, state: &State, scales: &mut [f64]) {
    let (bodies, works) = scales.split_at_mut(state.bodies.len());
    system.error_scales(state.time, &state.bodies, &state.works, bodies, works);
}

/// Why a state is outside the model, in words.
pub(super) fn reason(model: &Model, time: f64, left: &Inadmissible) -> String {
    Stop::by_inadmissible(model, time, left).what
}

/// A fault in words.
pub(super) fn meaningless(model: &Model, time: f64, fault: &NoDerivative) -> Meaningless {
    let reason = match fault {
        NoDerivative::Reason(reason) => reason.clone(),
        NoDerivative::Inadmissible(left) => format!("with a little more or less of it, {}", reason(model, time, left)),
    };
    Meaningless { from: time, reason }
}
