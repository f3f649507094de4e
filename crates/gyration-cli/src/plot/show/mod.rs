//! What a figure shows: the quantities that a user may ask for, and the figure of several of them.

mod cost;
mod distance;
mod drive;
mod effort;
mod energy;
mod forces;
mod laws;
mod measure;
mod motion;
mod stretch;
mod stroke;
mod trace;

use super::PlotError;
use super::chart::{Chart, Figure, Panel, Series};
use super::draw::Point;
use super::recorded::Recorded;
use super::strip::Strip;

pub use laws::law_panels;

/// A quantity that may be asked for of a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// Height of the centres over time.
    Height,
    /// Smallest distance to a support over time.
    Gap,
    /// Energies, works, residual of the ledger.
    Energy,
    /// Forces of contact.
    Forces,
    /// Outlines at successive times.
    Strip,
    /// Principal stretches of bodies that deform.
    Stretch,
    /// Two measures of bodies that contract against each other.
    Stroke,
    /// Level distance of the centres from their starts over time.
    Distance,
    /// Work of the drive by weight and distance.
    Cost,
    /// Where the work of the drive goes, and its power.
    Drive,
}

/// Bodies with a line of their own in a chart.
const MOST_LINES: usize = 40;
/// Bodies with a name in the legend.
const MOST_NAMES: usize = 7;
/// Bodies with a chart of their own.
const MOST_CHARTS: usize = 6;
/// Width of lines where there are many [pt].
const THIN: f64 = 0.7;

/// The panels of one quantity.
///
/// # Errors
/// [`PlotError`] where the recording cannot be read or does not have the quantity.
pub fn panels(recorded: &Recorded, quantity: Quantity) -> Result<Vec<Panel>, PlotError> {
    Ok(match quantity {
        Quantity::Height => vec![Panel::Chart(motion::height(recorded)?)],
        Quantity::Gap => vec![Panel::Chart(motion::gap(recorded)?)],
        Quantity::Energy => energy::charts(recorded)?.into_iter().map(Panel::Chart).collect(),
        Quantity::Forces => vec![Panel::Chart(forces::chart(recorded)?)],
        Quantity::Strip => vec![Panel::Strip(Strip::of(recorded)?)],
        Quantity::Stretch => stretch::charts(recorded)?.into_iter().map(Panel::Chart).collect(),
        Quantity::Stroke => strokes(recorded, &[])?,
        Quantity::Distance => vec![Panel::Chart(distance::chart(recorded)?)],
        Quantity::Cost => vec![Panel::Chart(cost::chart(recorded)?)],
        Quantity::Drive => drive::charts(recorded)?.into_iter().map(Panel::Chart).collect(),
    })
}

/// The strokes of bodies that contract in the plane of two measures, or of those between which they enclose most.
///
/// # Errors
/// [`PlotError`] where the recording cannot be read, has no such body, or not these measures.
pub fn strokes(recorded: &Recorded, measures: &[String]) -> Result<Vec<Panel>, PlotError> {
    Ok(stroke::charts(recorded, measures)?.into_iter().map(Panel::Chart).collect())
}

/// Indices of the bodies that contract, for a quantity that only they have.
fn contracting_bodies(recorded: &Recorded, what: &'static str) -> Result<Vec<usize>, PlotError> {
    let all = recorded.bodies.iter().enumerate();
    let bodies: Vec<usize> = all.filter(|(_, body)| body.contracts()).map(|(index, _)| index).collect();
    if bodies.is_empty() {
        return Err(PlotError::Nothing { what, reason: "no body of the recording contracts" });
    }
    Ok(bodies)
}

/// Everything that the recording has, in one figure; how far bodies get where some drive themselves.
///
/// # Errors
/// [`PlotError`] where the recording cannot be read.
pub fn overview(recorded: &Recorded) -> Result<Vec<Panel>, PlotError> {
    let mut all = Vec::new();
    let order = [
        Quantity::Strip,
        Quantity::Height,
        Quantity::Distance,
        Quantity::Gap,
        Quantity::Stretch,
        Quantity::Forces,
        Quantity::Energy,
        Quantity::Stroke,
    ];
    let contracts = recorded.bodies.iter().any(|body| body.contracts());
    for quantity in order.into_iter().filter(|quantity| contracts || *quantity != Quantity::Distance) {
        match panels(recorded, quantity) {
            Ok(panels) => all.extend(panels),
            Err(PlotError::Nothing { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(all)
}

/// A figure of a recording under its title and outcome.
pub fn figure(recorded: &Recorded, panels: Vec<Panel>) -> Figure {
    let text = |name: &str| {
        let attribute = recorded.recording.attributes().get(name);
        attribute.and_then(serde_json::Value::as_str).unwrap_or_default().to_owned()
    };
    let title = match text("title") {
        title if title.is_empty() => text("scene_name"),
        title => title,
    };
    let subtitle = match text("outcome_in_words") {
        outcome if outcome.is_empty() => "not finished".to_owned(),
        outcome => outcome,
    };
    Figure { title, subtitle, panels }
}

/// A series for each body, named in the legend if they are few.
fn body_series(recorded: &Recorded, indices: &[usize], lines: Vec<Vec<Point>>) -> (Vec<Series>, Vec<String>) {
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
fn values(series: &[Series]) -> impl Iterator<Item = f64> + '_ {
    series.iter().flat_map(|series| &series.points).map(|point| point[1]).filter(|y| y.is_finite())
}

/// Indices of the bodies that have lines of their own.
fn drawn_bodies(recorded: &Recorded) -> Vec<usize> {
    (0..recorded.bodies.len().min(MOST_LINES)).collect()
}

/// The level axis of charts over time.
fn time_axis(recorded: &Recorded) -> Result<super::chart::Axis, PlotError> {
    let (start, end) = recorded.span()?;
    Ok(super::chart::Axis::exact("time", "s", start, end))
}

/// A single series needs no name: the axis tells it.
fn without_idle_names(mut chart: Chart) -> Chart {
    if let [only] = &mut chart.series[..] {
        only.name.clear();
    }
    chart
}
