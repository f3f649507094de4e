//! How often each word came, against equal chances, and how often numbers came, by bins.
//!
//! The bins of numbers have the width 2 (q₃ − q₁) n^−⅓ (Freedman and Diaconis 1981), rounded to 1, 2 or 5 times a power
//! of ten; whole numbers of a small range have a bin each.

use super::layout::HEIGHT;
use super::request::{Ordinate, PlotRequest};
use super::table::{ColumnValues, RunTable};
use super::{palette, statistics};
use crate::chart::{Axis, Chart, DASHED, LINE, Series, ShapeChart, Shapes, extremes, raised, ticks};
use crate::draw::{Stroke, color};
use crate::error::PlotError;
use crate::figure::Panel;

/// With more groups than this the picture is not divided by groups.
const MOST_PANELS: usize = 6;
/// Bins of a histogram at most.
const MOST_BINS: f64 = 200.0;
/// Half the width of a bar of words, of which one takes 1.
const HALF_BAR: f64 = 0.36;

/// Runs that belong together, and their name.
type Group = (String, Vec<usize>);

/// A chart a group, below one another.
pub fn panels(table: &RunTable, request: &PlotRequest) -> Result<Vec<Panel>, PlotError> {
    let wanted = request.x.as_deref().or(request.y.as_deref()).map(|name| table.column(&Ordinate::read(name).column));
    let column = wanted.unwrap_or_else(|| table.kept())?;
    let groups = groups(table, request)?;
    let height = HEIGHT / (groups.len() as f64).sqrt();
    match &column.values {
        ColumnValues::Words(words) => {
            let names = column.categories();
            let counted = groups.iter().map(|(title, runs)| {
                let place = |run: &usize| words[*run].as_ref().and_then(|word| names.iter().position(|n| n == word));
                let mut counts = vec![0; names.len()];
                runs.iter().filter_map(place).for_each(|index| counts[index] += 1);
                of_words(&column.name, &names, title, &counts, height)
            });
            Ok(counted.collect())
        }
        ColumnValues::Numbers(values) => {
            let x = column.axis(values.iter().copied());
            let bins = Bins::of(values);
            let of_group = |(title, runs): &Group| {
                let values: Vec<f64> = runs.iter().map(|run| values[*run]).collect();
                of_numbers(&bins, &GroupValues { title, values: &values, by_run: &values, height }, &x)
            };
            Ok(groups.iter().map(of_group).collect())
        }
        ColumnValues::Lists(lists) => {
            let values: Vec<f64> = lists.iter().flatten().copied().collect();
            let x = Axis::linear(&column.name, &column.unit, values.iter().copied());
            // The numbers of a run depend on each other: the interval is that of the runs.
            let of_run = |list: &Vec<f64>| statistics::mean(list).value;
            let means: Vec<f64> = lists.iter().map(of_run).collect();
            let sample = GroupValues { title: "", values: &values, by_run: &means, height: HEIGHT };
            Ok(vec![of_numbers(&Bins::of(&values), &sample, &x)])
        }
    }
}

/// The runs by the values of a column: that of the colour, else the axis of the grid, if there are few.
fn groups(table: &RunTable, request: &PlotRequest) -> Result<Vec<Group>, PlotError> {
    let all = || vec![(String::new(), (0..table.len()).collect())];
    let column = match &request.colour {
        Some(name) => table.column(name)?,
        None => match table.axes().first() {
            Some(axis) => *axis,
            None => return Ok(all()),
        },
    };
    let mut groups: Vec<Group> = Vec::new();
    for run in 0..table.len() {
        let Some(word) = column.word(run) else { continue };
        let title = format!("{} = {word} {}", column.name, raised(&column.unit));
        match groups.iter_mut().find(|(known, _)| *known == title) {
            Some((_, runs)) => runs.push(run),
            None => groups.push((title, vec![run])),
        }
        if groups.len() > MOST_PANELS {
            return Ok(all());
        }
    }
    Ok(groups)
}

/// Bars with Wilson's intervals, the line of equal chances, and its test.
fn of_words(name: &str, names: &[String], title: &str, counts: &[usize], height: f64) -> Panel {
    let total: usize = counts.iter().sum();
    let expected = total as f64 / names.len().max(1) as f64;
    let x = Axis::of_words(name, names.to_vec());
    let estimates: Vec<_> = counts.iter().map(|count| statistics::proportion(*count, total)).collect();
    let most = estimates.iter().map(|estimate| estimate.high * total as f64).fold(expected, f64::max);
    let y = Axis::exact("runs", "", 0.0, 1.05 * most);
    let bar = |(k, count): (usize, &usize)| Shapes::Areas {
        corners: vec![[[k as f64 - HALF_BAR, 0.0], [k as f64 + HALF_BAR, *count as f64]]],
        fill: palette::category(k),
    };
    let mut shapes: Vec<Shapes> = counts.iter().enumerate().map(bar).collect();
    let interval = |(k, estimate): (usize, &statistics::Estimate)| {
        [[k as f64, estimate.low * total as f64], [k as f64, estimate.high * total as f64]]
    };
    let ends = estimates.iter().enumerate().map(interval).collect();
    shapes.push(Shapes::Intervals { ends, stroke: Stroke::solid(color::INK, 0.9) });
    let level = Stroke { dash: DASHED, ..Stroke::solid(color::INK, LINE) };
    let points = vec![[x.low, expected], [x.high, expected]];
    let series = vec![Series { name: "equal chances".into(), points, stroke: level, arrows: false }];
    let mut remarks = vec![format!("{total} runs"), "bars with 95 % intervals".into()];
    if names.len() > 1 && total > 0 {
        let (chi_square, probability) = statistics::chi_square(counts);
        remarks.push(format!("χ² = {chi_square:.1}, {} degrees of freedom", names.len() - 1));
        let words = if probability < 1e-3 { "below 0.001".to_owned() } else { format!("= {probability:.3}") };
        remarks.push(format!("P of a larger one {words}"));
    }
    let chart = Chart { title: title.to_owned(), x, y, series, remarks, height };
    Panel::ShapeChart(ShapeChart { chart, shapes })
}

/// Bins of one width.
struct Bins {
    first: f64,
    width: f64,
    count: usize,
}

impl Bins {
    fn of(values: &[f64]) -> Self {
        let mut sorted: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let Some((low, high)) = extremes(sorted.iter().copied()) else {
            return Self { first: 0.0, width: 1.0, count: 1 };
        };
        if sorted.iter().all(|value| value.fract() == 0.0) && high - low < 50.0 {
            return Self { first: low - 0.5, width: 1.0, count: (high - low) as usize + 1 };
        }
        let quartile = |part: f64| sorted[(part * (sorted.len() - 1) as f64).round() as usize];
        let wanted = 2.0 * (quartile(0.75) - quartile(0.25)) * libm::pow(sorted.len() as f64, -1.0 / 3.0);
        let span = if high > low { high - low } else { low.abs().max(1.0) };
        let parts = if wanted > 0.0 { (span / wanted).clamp(5.0, MOST_BINS) } else { 20.0 };
        let width = ticks::round_step(span, parts.round() as usize);
        let first = (low / width).floor() * width;
        Self { first, width, count: ((high - first) / width) as usize + 1 }
    }

    fn count(&self, values: &[f64]) -> Vec<usize> {
        let mut counts = vec![0; self.count];
        for value in values.iter().filter(|value| value.is_finite()) {
            counts[(((value - self.first) / self.width) as usize).min(self.count - 1)] += 1;
        }
        counts
    }
}

/// The numbers of a group of runs.
struct GroupValues<'a> {
    title: &'a str,
    values: &'a [f64],
    /// One number a run.
    by_run: &'a [f64],
    /// Height of the chart [pt].
    height: f64,
}

/// Bars of values, and the mean of those of which each run has one.
fn of_numbers(bins: &Bins, sample: &GroupValues, x: &Axis) -> Panel {
    let GroupValues { title, values, by_run, height } = *sample;
    let counts = bins.count(values);
    let most = counts.iter().copied().max().unwrap_or(1);
    let y = Axis::exact("runs", "", 0.0, 1.05 * most as f64);
    let edge = |k: usize| bins.first + bins.width * k as f64;
    let bar = |(k, count): (usize, &usize)| [[edge(k), 0.0], [edge(k + 1), *count as f64]];
    let corners = counts.iter().enumerate().filter(|(_, count)| **count > 0).map(bar).collect();
    let x = Axis { low: x.low.min(edge(0)), high: x.high.max(edge(bins.count)), ..x.clone() };
    let finite = |values: &[f64]| -> Vec<f64> { values.iter().copied().filter(|value| value.is_finite()).collect() };
    let mean = statistics::mean(&finite(by_run));
    let remarks = vec![
        format!("{} values", finite(values).len()),
        format!(
            "mean {}{}",
            in_words(&mean),
            if x.unit.is_empty() { String::new() } else { format!(" {}", raised(&x.unit)) }
        ),
    ];
    let shapes = vec![Shapes::Areas { corners, fill: color::series(0) }];
    let chart = Chart { title: title.to_owned(), x, y, series: Vec::new(), remarks, height };
    Panel::ShapeChart(ShapeChart { chart, shapes })
}

/// A number with its interval, with as many digits as the interval leaves.
fn in_words(estimate: &statistics::Estimate) -> String {
    let half = 0.5 * (estimate.high - estimate.low);
    if half > 0.0 {
        let decimals = (1.0 - libm::log10(half).floor()).clamp(0.0, 12.0) as usize;
        return format!("{:.decimals$} ± {half:.decimals$}", estimate.value);
    }
    ticks::short(estimate.value)
}
