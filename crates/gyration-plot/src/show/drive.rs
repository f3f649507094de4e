//! The ledger of the drive: where its work goes, and its power.
//!
//!   W = −Σ (works of all else) + (energies gained) − residual
//!
//! Works of contraction, viscosity, contacts are drawn with their signs reversed: what each has taken of the work of
//! the drive. What the drive gives and what is drawn besides add up at any time.

use super::bodies::{MOST_LINES, MOST_NAMES, body_series, time_axis, values};
use super::effort::{self, ARRAYS, Driven, Works};
use crate::chart::{Axis, Chart, DASHED, DOTTED, LINE, Series};
use crate::cycle::{AtTime, Cycle, rounded};
use crate::draw::{Point, Stroke, color};
use crate::error::PlotError;
use crate::recorded::RecordedScene;
use crate::thin::Thinner;

const HEIGHT: f64 = 150.0;
const POWER_HEIGHT: f64 = 95.0;
/// Works that stay below this part of the largest are not drawn: they would lie on the axis.
const NEGLIGIBLE: f64 = 1e-3;

/// What takes of the work, in the order of the legend, with names and colours.
const TAKERS: [(&str, &str, usize); 8] = [
    ("work_contraction", "lost in contraction", 2),
    ("work_viscosity", "lost in viscosity", 0),
    ("work_friction", "lost in friction", 3),
    ("work_damping", "lost in damping", 1),
    ("work_repulsion", "given to repulsion", 4),
    ("work_adhesion", "given to adhesion", 5),
    ("work_load", "given to loads", 4),
    ("work_support", "given to supports", 0),
];

/// Works, and below them the power.
pub fn charts(recorded: &RecordedScene) -> Result<Vec<Chart>, PlotError> {
    let driven = Driven::all(recorded, "drive")?;
    let ledger = ledger(recorded)?;
    let power = power(recorded, &driven, ledger.x.clone())?;
    Ok(vec![ledger, power])
}

/// The work of the drive and what became of it.
fn ledger(recorded: &RecordedScene) -> Result<Chart, PlotError> {
    let takers: Vec<_> = TAKERS.iter().copied().filter(|(array, _, _)| recorded.has(array)).collect();
    let stores = ["kinetic", "gravity", "elastic", "contact", "load"].map(|name| format!("energy_{name}"));
    let stores = stores.iter().map(String::as_str).filter(|array| recorded.has(array));
    let arrays: Vec<&str> =
        ["work_drive"].into_iter().chain(takers.iter().map(|(array, _, _)| *array)).chain(stores).collect();
    let gained = 1 + takers.len();
    let energy = |row: &[&[f64]]| row[gained..].iter().map(|entry| entry[0]).sum::<f64>();
    let mut initial = None;
    let mut thinners = recorded.thinners(gained + 1);
    recorded.each_row(&arrays, |time, row| {
        let initial = *initial.get_or_insert_with(|| energy(row));
        let taken = row[1..gained].iter().map(|entry| -entry[0]);
        let all = [row[0][0]].into_iter().chain(taken).chain([energy(row) - initial]);
        thinners.iter_mut().zip(all).for_each(|(thinner, value)| thinner.push(time, value));
    })?;
    let mut lines: Vec<Vec<Point>> = thinners.into_iter().map(Thinner::finish).collect();
    let kept = lines.pop().unwrap_or_default();
    let largest = lines.iter().map(|line| most(line)).fold(0.0, f64::max);
    let mut lines = lines.into_iter();
    let given = Stroke::solid(color::INK, 1.5 * LINE);
    let points = lines.next().unwrap_or_default();
    let mut series = vec![Series { name: "work of the drive".into(), points, stroke: given, arrows: false }];
    for ((_, name, hue), points) in takers.iter().zip(lines) {
        if most(&points) > NEGLIGIBLE * largest {
            let line = Series::solid(*name, points, *hue);
            // Losses in solid lines; what may come back is dashed.
            series.push(if name.starts_with("lost") { line } else { line.dashed(DASHED) });
        }
    }
    let stroke = Stroke { color: color::INK, width: LINE, dash: DOTTED };
    series.push(Series { name: "kept: energies gained".into(), points: kept, stroke, arrows: false });
    let y = Axis::linear("work", "J", values(&series));
    let title = "Work of the drive, and where it went".to_owned();
    Ok(Chart { title, x: time_axis(recorded)?, y, series, remarks: Vec::new(), height: HEIGHT })
}

fn most(line: &[Point]) -> f64 {
    line.iter().map(|point| point[1].abs()).fold(0.0, f64::max)
}

/// The power of each drive, and its mean over the last cycle.
fn power(recorded: &RecordedScene, driven: &[Driven], x: Axis) -> Result<Chart, PlotError> {
    let drawn = &driven[..driven.len().min(MOST_LINES)];
    let span = recorded.span()?;
    let mut works = vec![Works::default(); driven.len()];
    let cycles: Vec<Option<Cycle>> =
        drawn.iter().map(|it| Cycle::last(recorded.bodies[it.body].period, span)).collect();
    let mut marks: Vec<Option<AtTime<1>>> = cycles.iter().map(|c| c.map(|c| AtTime::at(c.start))).collect();
    let mut thinners = recorded.thinners(drawn.len());
    recorded.each_row(&ARRAYS, |time, row| {
        for (k, it) in driven.iter().enumerate() {
            let power = it.power(row);
            works[k].push(time, power);
            if let Some(thinner) = thinners.get_mut(k) {
                thinner.push(time, power);
            }
            if let Some(Some(mark)) = marks.get_mut(k) {
                mark.push(time, [works[k].net]);
            }
        }
    })?;
    let bodies: Vec<usize> = drawn.iter().map(|it| it.body).collect();
    let lines = thinners.into_iter().map(Thinner::finish).collect();
    let (mut series, mut remarks) = body_series(recorded, &bodies, lines);
    let alone = series.len() == 1;
    if alone {
        series[0].name = "power of the drive".into();
    }
    for ((body, cycle), mark) in bodies.iter().zip(&cycles).zip(&marks).take(MOST_NAMES) {
        if let (Some(cycle), Some([work])) = (cycle, mark.as_ref().and_then(AtTime::since)) {
            let of = if alone { "mean".to_owned() } else { recorded.bodies[*body].name.clone() };
            remarks.push(format!("{of}: {} W in the last cycle", rounded(work / cycle.period)));
        }
    }
    remarks.extend(effort::sampling(recorded, &works)?);
    let y = Axis::linear("power", "W", values(&series).chain([0.0]));
    let title = "Power of the drive".to_owned();
    series.insert(0, Series::level("", 0.0, &x));
    Ok(Chart { title, x, y, series, remarks, height: POWER_HEIGHT })
}
