//! What charts of bodies share: a line a body as far as there are few, over time.

use crate::chart::{Axis, Chart, Series};
use crate::draw::Point;
use crate::error::PlotError;
use crate::recorded::RecordedScene;

/// Bodies with a line of their own in a chart.
pub const MOST_LINES: usize = 40;
/// Bodies with a name in the legend.
pub const MOST_NAMES: usize = 7;
/// Bodies with a chart of their own.
pub const MOST_CHARTS: usize = 6;
/// Width of lines where there are many [pt].
pub const THIN: f64 = 0.7;

/// Indices of the bodies that contract, for a quantity that only they have.
pub fn contracting_bodies(recorded: &RecordedScene, what: &'static str) -> Result<Vec<usize>, PlotError> {
    let all = recorded.bodies.iter().enumerate();
    let bodies: Vec<usize> = all.filter(|(_, body)| body.contracts()).map(|(index, _)| index).collect();
    if bodies.is_empty() {
        return Err(PlotError::Nothing { what, reason: "no body of the recording contracts" });
    }
    Ok(bodies)
}

/// A series for each body, named in the legend if they are few.
pub fn body_series(recorded: &RecordedScene, indices: &[usize], lines: Vec<Vec<Point>>) -> (Vec<Series>, Vec<String>) {
    let names = |k: usize| if k < MOST_NAMES { recorded.bodies[indices[k]].name.clone() } else { String::new() };
    let lines = lines.into_iter().enumerate();
    let mut series: Vec<Series> = lines.map(|(k, points)| Series::solid(names(k), points, indices[k])).collect();
    if series.len() > MOST_NAMES {
        series.iter_mut().for_each(|line| line.stroke.width = THIN);
    }
    let unnamed = series.len().saturating_sub(MOST_NAMES);
    let undrawn = recorded.bodies.len().saturating_sub(MOST_LINES);
    let remark = |count: usize, words: &str| (count > 0).then(|| format!("{count} {words}"));
    let remarks = remark(unnamed, "more").into_iter().chain(remark(undrawn, "not drawn"));
    (series, remarks.collect())
}

/// The chart's finite values upwards.
pub fn values(series: &[Series]) -> impl Iterator<Item = f64> + '_ {
    series.iter().flat_map(|series| &series.points).map(|point| point[1]).filter(|y| y.is_finite())
}

/// Indices of the bodies that have lines of their own.
pub fn drawn_bodies(recorded: &RecordedScene) -> Vec<usize> {
    (0..recorded.bodies.len().min(MOST_LINES)).collect()
}

/// The level axis of charts over time.
pub fn time_axis(recorded: &RecordedScene) -> Result<Axis, PlotError> {
    let (start, end) = recorded.span()?;
    Ok(Axis::exact("time", "s", start, end))
}

/// A single series needs no name: the axis tells it.
pub fn without_idle_names(mut chart: Chart) -> Chart {
    if let [only] = &mut chart.series[..] {
        only.name.clear();
    }
    chart
}
