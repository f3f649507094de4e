//! How hard a body is to be torn off: the largest force towards its support over all gaps.

use super::Experiment;
use super::nearby::Nearby;
use super::scene::{body, force, normal, velocity};
use gyration::dynamics::gap_to_supports;
use gyration::tensor::Vec3;
use gyration_scene::Scene;

/// Points of a look for the largest force, over gaps from [`NEAREST`] to [`FARTHEST`] sizes of the body.
const POINTS: usize = 160;
const NEAREST: f64 = 1e-5;
const FARTHEST: f64 = 10.0;
/// How often it is looked for: to 1e-11 sizes. Smaller gaps are rounding of the places of body and support.
const LOOKS: usize = 2;
/// Steps of the golden section behind that: the maximum is then known to half of the digits, the force to all.
const SECTIONS: usize = 45;

/// That force [N].
pub(super) fn pull_off(scene: &Scene, experiment: &Experiment, nearby: &mut Nearby) -> Result<f64, String> {
    let built = scene.built();
    let (model, index) = (&built.model, body(&built.model, experiment)?);
    let (normal, at) = (normal(model, index)?, velocity(model, index)?);
    let start = model.blocks()[index].start;
    let mut state = built.state.clone();
    state.bodies[at..at + 3].fill(0.0);
    let gap = gap_to_supports(model, 0.0, index, &state.motion(model, index));
    let center = Vec3::from_column_slice(&state.bodies[start..start + 3]);
    let mut pull = |logarithm: f64| -> Result<f64, String> {
        let moved = center + normal * (libm::exp(logarithm) - gap);
        state.bodies[start..start + 3].copy_from_slice(moved.as_slice());
        Ok(-force(model, &state, index)?.dot(&normal))
    };
    let size = model.bodies[index].size;
    let step = libm::log(FARTHEST / NEAREST) / (POINTS - 1) as f64;
    let is_largest = |pull: &mut dyn FnMut(f64) -> Result<f64, String>, best: f64| -> Result<bool, String> {
        let [below, there, above] = [pull(best - step)?, pull(best)?, pull(best + step)?];
        Ok(there > 0.0 && there >= below && there >= above)
    };
    let best = match nearby.pull {
        Some(known) if is_largest(&mut pull, known)? => known,
        _ => largest_pull(&mut pull, (libm::log(NEAREST * size), step), experiment)?,
    };
    nearby.pull.get_or_insert(best);
    largest_between(&mut pull, [best - step, best + step])
}

/// The logarithm of the gap of the largest pull among those looked at, from the smallest on.
fn largest_pull(
    pull: &mut impl FnMut(f64) -> Result<f64, String>,
    (mut low, step): (f64, f64),
    experiment: &Experiment,
) -> Result<f64, String> {
    let name = &experiment.body;
    let span = (POINTS - 1) as f64 * step;
    for _ in 0..LOOKS {
        let forces = (0..POINTS).map(|k| pull(low + k as f64 * step)).collect::<Result<Vec<_>, _>>()?;
        let best =
            (0..POINTS).fold(0, |best, k| if forces[best].is_nan() || forces[k] > forces[best] { k } else { best });
        if forces[best] <= 0.0 || forces[best].is_nan() {
            return Err(format!("nothing holds {name:?} back: there is no adhesion"));
        }
        if (1..POINTS - 1).contains(&best) {
            return Ok(low + best as f64 * step);
        }
        // Two points are looked at once more, lest the largest stand at the seam.
        low += if best == 0 { 2.0 * step - span } else { span - 2.0 * step };
    }
    Err(format!("the pull on {name:?} has no largest value between any gaps that it could be torn off from"))
}

/// The largest value between two bounds, by the golden section: one of its two points is the next one's.
fn largest_between(
    value: &mut impl FnMut(f64) -> Result<f64, String>,
    [mut left, mut right]: [f64; 2],
) -> Result<f64, String> {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let mut points = [right - golden * (right - left), left + golden * (right - left)];
    let mut values = [value(points[0])?, value(points[1])?];
    for _ in 0..SECTIONS {
        if values[0] > values[1] {
            right = points[1];
            (points[1], values[1]) = (points[0], values[0]);
            points[0] = right - golden * (right - left);
            values[0] = value(points[0])?;
        } else {
            left = points[0];
            (points[0], values[0]) = (points[1], values[1]);
            points[1] = left + golden * (right - left);
            values[1] = value(points[1])?;
        }
    }
    value(0.5 * (left + right))
}
