//! Height of the centres and smallest gaps over time.

use super::bodies::{body_series, drawn_bodies, time_axis, values, without_idle_names};
use crate::chart::{Axis, Chart, extremes};
use crate::error::PlotError;
use crate::recorded::RecordedScene;

/// Height of a chart of one quantity [pt].
const HEIGHT: f64 = 110.0;
/// A gap that spans more than this factor is drawn over a logarithmic axis.
const WIDE: f64 = 20.0;

/// Height of the centres of mass over the origin, against gravity.
pub fn height(recorded: &RecordedScene) -> Result<Chart, PlotError> {
    let up = recorded.up();
    let bodies = drawn_bodies(recorded);
    let along = |row: &[&[f64]], k: usize| {
        let place = &row[0][3 * bodies[k]..];
        up.x * place[0] + up.y * place[1] + up.z * place[2]
    };
    let lines = recorded.lines(&["position"], bodies.len(), along)?;
    let (series, remarks) = body_series(recorded, &bodies, lines);
    let y = Axis::linear("height", "m", values(&series));
    let title = "Height of the centre of mass".to_owned();
    Ok(without_idle_names(Chart { title, x: time_axis(recorded)?, y, series, remarks, height: HEIGHT }))
}

/// Smallest distance of each body to what it meets.
pub fn gap(recorded: &RecordedScene) -> Result<Chart, PlotError> {
    let bodies = drawn_bodies(recorded);
    let lines = recorded.lines(&["gap"], bodies.len(), |row, k| row[0][bodies[k]])?;
    let has_gap = |line: &Vec<[f64; 2]>| line.iter().any(|point| point[1].is_finite());
    let (bodies, lines): (Vec<usize>, Vec<_>) = bodies.into_iter().zip(lines).filter(|(_, line)| has_gap(line)).unzip();
    if lines.is_empty() {
        return Err(PlotError::Nothing { what: "gap", reason: "no body with a surface has a contact" });
    }
    let (series, remarks) = body_series(recorded, &bodies, lines);
    let wide = extremes(values(&series)).is_some_and(|(low, high)| low > 0.0 && high > WIDE * low);
    let axis = if wide { Axis::logarithmic } else { Axis::linear };
    let y = axis("gap", "m", values(&series).collect::<Vec<f64>>());
    let title = "Smallest distance to what is met".to_owned();
    Ok(without_idle_names(Chart { title, x: time_axis(recorded)?, y, series, remarks, height: HEIGHT }))
}
