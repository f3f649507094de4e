//! Means and shares over a parameter, with intervals of 95 %.
//!
//! A number has one curve, a word has one for each of its values: the share of the runs that have it. A column of
//! colour divides the runs further. Where there is one run a point, there is a line and no interval.

use super::layout::{HEIGHT, Layers};
use super::palette;
use super::request::{Ordinate, PlotRequest};
use super::statistics::{self, Estimate};
use super::table::{ColumnValues, RunTable, TableColumn};
use crate::chart::{Axis, AxisScale, LINE, Series, Shapes, raised};
use crate::draw::Stroke;
use crate::error::PlotError;
use crate::figure::Panel;
use std::collections::BTreeSet;

/// With more points than this a curve has no dots.
const MOST_DOTS: usize = 60;
/// Curves at most.
const MOST_CURVES: usize = 14;
/// Between the intervals of curves at one place, as a part of the axis.
const BESIDE: f64 = 0.006;
/// Radius of dots [pt].
const RADIUS: f64 = 2.0;

/// What is averaged: a number a run, NaN where there is none.
struct Averaged {
    name: String,
    values: Vec<f64>,
    /// Whether the numbers are hits and misses.
    is_share: bool,
}

/// Places on the level axis, and the runs that stand there.
struct AxisPlaces {
    axis: Axis,
    runs: Vec<(f64, Vec<usize>)>,
}

/// The chart of a table.
pub fn panel(table: &RunTable, request: &PlotRequest) -> Result<Panel, PlotError> {
    let x = table.axis_or(request.x.as_deref(), 0)?;
    let measure = match &request.y {
        Some(text) => Ordinate::read(text),
        None => Ordinate { column: table.kept()?.name.clone(), values: Vec::new() },
    };
    let quantities = quantities(table, &measure)?;
    let groups = groups(table, request, x)?;
    let count = quantities.len() * groups.len();
    if count > MOST_CURVES {
        return Err(PlotError::arguments(
            format!("{count} curves are too many to tell apart"),
            "ask for the share of one value, --y COLUMN=VALUE, or for a map: --x NAME --y NAME --colour COLUMN",
        ));
    }
    let places = AxisPlaces::of(x, request, table.len())?;
    let (mut layers, mut range) = (Layers::default(), Vec::new());
    for (group, runs) in &groups {
        for quantity in &quantities {
            let points = places.estimates(quantity, runs);
            range.extend(points.iter().flat_map(|(_, e)| [e.value, e.low, e.high]));
            let parts = [group.as_str(), if quantities.len() > 1 { &quantity.name } else { "" }];
            let name = parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ");
            let beside = BESIDE * (layers.series.len() as f64 - 0.5 * (count - 1) as f64);
            draw(&points, name, &places.axis, beside, &mut layers);
        }
    }
    layers.add_references(request);
    range.extend(request.reference.iter().flat_map(|reference| reference.points.iter().map(|point| point[1])));
    let y = upright(request, &quantities, &table.column(&measure.column)?.unit, &range);
    let intervals = layers.shapes.iter().any(|shapes| matches!(shapes, Shapes::Intervals { .. }));
    let remarks = if intervals { vec!["intervals of 95 %".to_owned()] } else { Vec::new() };
    Ok(layers.panel(places.axis, y, remarks, HEIGHT))
}

/// The column itself if it has numbers, the share of each of its words, or the share of some values.
fn quantities(table: &RunTable, measure: &Ordinate) -> Result<Vec<Averaged>, PlotError> {
    let column = table.column(&measure.column)?;
    let share = |name: String, is_hit: &dyn Fn(usize, &str) -> bool| {
        let value = |run: usize| column.word(run).map_or(f64::NAN, |word| f64::from(u8::from(is_hit(run, &word))));
        Averaged { name, values: (0..table.len()).map(value).collect(), is_share: true }
    };
    if measure.values.is_empty() {
        return match &column.values {
            ColumnValues::Numbers(values) => {
                Ok(vec![Averaged { name: column.name.clone(), values: values.clone(), is_share: false }])
            }
            ColumnValues::Words(_) => {
                let of = |word: String| share(word.clone(), &|_, other| other == word);
                Ok(column.categories().into_iter().map(of).collect())
            }
            ColumnValues::Lists(_) => Err(PlotError::arguments(
                format!("`{}` has several numbers a run, which have no mean over a parameter", column.name),
                "leave the kind to the program, or ask for `--kind scatter`",
            )),
        };
    }
    let words = || (0..table.len()).filter_map(|run| column.word(run)).collect::<BTreeSet<_>>();
    let is_face = |value: &str| value.len() == 2 && value.starts_with(['+', '-']) && value.ends_with(['x', 'y', 'z']);
    for value in &measure.values {
        // A face may never have come; another word that no run has is a slip.
        if table.column(value).is_err() && !is_face(value) && !words().contains(value) {
            let there: Vec<String> = words().into_iter().take(MOST_CURVES).collect();
            let problem = format!("no run has `{value}` in the column `{}`", column.name);
            return Err(PlotError::arguments(problem, format!("it has {}", there.join(", "))));
        }
    }
    let others: Vec<Option<&TableColumn>> = measure.values.iter().map(|value| table.column(value).ok()).collect();
    let is_hit = |run: usize, word: &str| {
        let agrees = |(value, other): (&String, &Option<&TableColumn>)| match other {
            Some(other) => other.word(run).as_deref() == Some(word),
            None => value == word,
        };
        measure.values.iter().zip(&others).any(agrees)
    };
    let name = format!("share of {} = {}", measure.column, measure.values.join(" or "));
    Ok(vec![share(name, &is_hit)])
}

/// The runs by the column of colour: the one asked for, else a second axis of the grid.
fn groups(table: &RunTable, request: &PlotRequest, x: &TableColumn) -> Result<Vec<(String, Vec<usize>)>, PlotError> {
    let column = match &request.colour {
        Some(name) => Some(table.column(name)?),
        None => table.axes().into_iter().find(|column| column.role != x.role),
    };
    let Some(column) = column else { return Ok(vec![(String::new(), (0..table.len()).collect())]) };
    let (levels, labels): (Vec<f64>, Vec<String>) = column.labels().into_iter().unzip();
    let word = |run: usize| match &column.values {
        ColumnValues::Numbers(values) => {
            let at = column.level(&levels, values[run])?;
            Some(labels[at].clone())
        }
        _ => column.word(run),
    };
    let mut groups: Vec<(String, Vec<usize>)> = Vec::new();
    for run in 0..table.len() {
        let Some(word) = word(run) else { continue };
        let unit = if column.unit.is_empty() { String::new() } else { format!(" {}", raised(&column.unit)) };
        let name = format!("{} = {word}{unit}", column.name);
        match groups.iter_mut().find(|(known, _)| *known == name) {
            Some((_, runs)) => runs.push(run),
            None => groups.push((name, vec![run])),
        }
    }
    Ok(groups)
}

impl AxisPlaces {
    fn of(column: &TableColumn, request: &PlotRequest, count: usize) -> Result<Self, PlotError> {
        let categories = column.categories();
        let levels: Vec<f64> = match &column.values {
            ColumnValues::Numbers(_) => column.levels(),
            ColumnValues::Words(_) => (0..categories.len()).map(|k| k as f64).collect(),
            ColumnValues::Lists(_) => {
                return Err(PlotError::arguments(
                    format!("`{}` is a list, not a parameter", column.name),
                    "name another --x",
                ));
            }
        };
        let beside = request.reference.iter().flat_map(|reference| reference.points.iter().map(|point| point[0]));
        let axis = match &column.values {
            ColumnValues::Words(_) => Axis::of_words(&column.name, categories.clone()),
            _ => column.axis(levels.iter().copied().chain(beside)),
        };
        let axis = if request.is_logarithmic("x") && axis.low > 0.0 && axis.scale == AxisScale::Linear {
            Axis::logarithmic(&column.name, &column.unit, levels.iter().copied())
        } else {
            axis
        };
        let mut runs: Vec<(f64, Vec<usize>)> = levels.iter().map(|level| (*level, Vec::new())).collect();
        for run in 0..count {
            let level = match &column.values {
                ColumnValues::Numbers(values) => column.level(&levels, values[run]),
                _ => column.word(run).and_then(|word| categories.iter().position(|other| *other == word)),
            };
            if let Some(level) = level {
                runs[level].1.push(run);
            }
        }
        Ok(Self { axis, runs })
    }

    /// An estimate at each place where some of the runs stand.
    fn estimates(&self, quantity: &Averaged, runs: &[usize]) -> Vec<(f64, Estimate)> {
        let estimate = |(level, here): &(f64, Vec<usize>)| {
            // Both are in the order of the runs.
            let ours = here.iter().filter(|run| runs.binary_search(run).is_ok());
            let values: Vec<f64> = ours.map(|run| quantity.values[*run]).filter(|value| !value.is_nan()).collect();
            let hits = values.iter().filter(|value| **value == 1.0).count();
            let estimate = match (values.len(), quantity.is_share) {
                (0, _) => return None,
                (n, true) => statistics::proportion(hits, n),
                (_, false) => statistics::mean(&values),
            };
            Some((*level, estimate))
        };
        self.runs.iter().filter_map(estimate).collect()
    }
}

/// A line, its dots and its intervals; if it has intervals, all stand a little aside, lest those of several curves hide
/// each other.
fn draw(points: &[(f64, Estimate)], name: String, axis: &Axis, beside: f64, layers: &mut Layers) {
    let colour = palette::category(layers.series.len());
    let at = |x: f64| match axis.scale {
        AxisScale::Linear => x + beside * (axis.high - axis.low),
        AxisScale::Logarithmic => x * libm::pow(axis.high / axis.low, beside),
    };
    let ends: Vec<_> = points.iter().map(|(x, e)| [[at(*x), e.low], [at(*x), e.high]]).collect();
    let has_intervals = ends.iter().any(|[low, high]| high[1] > low[1]);
    if has_intervals {
        layers.shapes.push(Shapes::Intervals { ends, stroke: Stroke::solid(colour, 0.8) });
    }
    let line: Vec<_> = points.iter().map(|(x, e)| [if has_intervals { at(*x) } else { *x }, e.value]).collect();
    if points.len() <= MOST_DOTS {
        layers.shapes.push(Shapes::Dots { at: line.clone(), radius: RADIUS, fill: colour });
    }
    layers.series.push(Series { name, points: line, stroke: Stroke::solid(colour, LINE), arrows: false });
}

fn upright(request: &PlotRequest, quantities: &[Averaged], unit: &str, range: &[f64]) -> Axis {
    let share = quantities.iter().all(|quantity| quantity.is_share);
    let name = match quantities {
        [one] => one.name.clone(),
        _ => "share of the runs".to_owned(),
    };
    let unit = if share { "" } else { unit };
    let values = || range.iter().copied();
    if request.is_logarithmic("y") {
        return Axis::logarithmic(&name, unit, values());
    }
    let axis = Axis::linear(&name, unit, values());
    if share { Axis { low: 0.0, high: axis.high.min(1.0), ..axis } } else { axis }
}
