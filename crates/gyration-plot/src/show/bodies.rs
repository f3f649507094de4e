//! What charts of bodies share: a line a body as far as there are few, over time.

use crate::chart::{Axis, Chart, Series};
use crate::draw::Point;
use crate::error::PlotError;
use crate::recorded::RecordedScene;
use std::collections::BTreeSet;

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

/// A series for each body in the colour of its class, each class named once, and how many bodies have no line.
pub fn body_series(recorded: &RecordedScene, indices: &[usize], lines: Vec<Vec<Point>>) -> (Vec<Series>, Vec<String>) {
    let classes = &recorded.classes;
    let mut named = vec![false; classes.names.len()];
    let series = indices.iter().zip(lines).map(|(body, points)| {
        let class = classes.of_body[*body];
        let is_named = std::mem::replace(&mut named[class], true);
        let name = if is_named { String::new() } else { classes.label(class) };
        Series::solid(name, points, class)
    });
    let mut series: Vec<Series> = series.collect();
    if series.len() > MOST_NAMES {
        series.iter_mut().for_each(|line| line.stroke.width = THIN);
    }
    let all = recorded.bodies.len();
    let remarks = (all > MOST_LINES).then(|| format!("lines of {} of {all} bodies", indices.len()));
    (series, remarks.into_iter().collect())
}

/// So many bodies.
pub fn bodies_in_words(count: usize) -> String {
    if count == 1 { "1 body".to_owned() } else { format!("{count} bodies") }
}

/// The colour of a body's lines, by its index.
pub fn hue(recorded: &RecordedScene, body: usize) -> usize {
    recorded.classes.of_body[body]
}

/// The chart's finite values upwards.
pub fn values(series: &[Series]) -> impl Iterator<Item = f64> + '_ {
    series.iter().flat_map(|series| &series.points).map(|point| point[1]).filter(|y| y.is_finite())
}

/// Indices of the bodies that have lines of their own: of many an even choice, with one of each class at least.
pub fn drawn_bodies(recorded: &RecordedScene) -> Vec<usize> {
    let all = recorded.bodies.len();
    if all <= MOST_LINES {
        return (0..all).collect();
    }
    let of_body = &recorded.classes.of_body;
    let mut drawn: BTreeSet<usize> = (0..MOST_LINES).map(|k| k * (all - 1) / (MOST_LINES - 1)).collect();
    for class in 0..recorded.classes.names.len() {
        if !drawn.iter().any(|body| of_body[*body] == class) {
            drawn.extend(of_body.iter().position(|of| *of == class));
        }
    }
    drawn.into_iter().collect()
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
