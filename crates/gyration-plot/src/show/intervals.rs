//! Forces of contact from sample to sample, where a run has recorded its impulses and peaks: what happens between two
//! samples is not missed.
//!
//!   mean |∫ f dt|/Δt, peak max |f| over each interval

use super::bodies::{body_series, drawn_bodies, time_axis};
use super::forces::{NO_FORCES, force_axis, heaviest};
use crate::chart::{Chart, DASHED, Series, extremes};
use crate::draw::Point;
use crate::error::PlotError;
use crate::recorded::RecordedScene;
use crate::thin::Thinner;
use gyration::tensor::Vec3;

const HEIGHT: f64 = 120.0;
const PEAK: &str = "peak_force";
const IMPULSE: &str = "impulse";

/// Peak and mean of the force on each body, in steps.
struct Intervals {
    bodies: Vec<usize>,
    peaks: Option<Vec<Vec<Point>>>,
    means: Option<Vec<Vec<Point>>>,
}

/// The chart; none where neither was recorded.
pub fn chart(recorded: &RecordedScene) -> Result<Option<Chart>, PlotError> {
    if !recorded.has(PEAK) && !recorded.has(IMPULSE) {
        return Ok(None);
    }
    let intervals = Intervals::read(recorded)?;
    let (mut series, mut remarks) = intervals.series(recorded);
    let most =
        extremes(series.iter().flat_map(|line| &line.points).map(|point| point[1])).map_or(0.0, |(_, high)| high);
    if most == 0.0 {
        return Err(PlotError::Nothing { what: "forces", reason: NO_FORCES });
    }
    let (x, weight) = (time_axis(recorded)?, heaviest(recorded, &intervals.bodies, &recorded.up()));
    if weight > 0.0 && intervals.bodies.len() == 1 {
        series.push(Series::level("weight", weight, &x));
    }
    let shown = if intervals.peaks.is_some() { "peaks" } else { "means" };
    remarks.push(format!("{shown} from sample to sample"));
    let y = force_axis(&series, weight, most);
    Ok(Some(Chart { title: "Force of contact".to_owned(), x, y, series, remarks, height: HEIGHT }))
}

impl Intervals {
    /// Those of the bodies that something touches.
    fn read(recorded: &RecordedScene) -> Result<Self, PlotError> {
        let bodies = drawn_bodies(recorded);
        let peak = |row: &[f64], body: usize, _: f64| row[body];
        let mean = |row: &[f64], body: usize, span: f64| Vec3::from_column_slice(&row[3 * body..][..3]).norm() / span;
        let mut peaks = steps(recorded, &bodies, PEAK, peak)?;
        let mut means = steps(recorded, &bodies, IMPULSE, mean)?;
        let acts = |lines: &Option<Vec<Vec<Point>>>, k: usize| {
            lines.as_ref().is_some_and(|lines| lines[k].iter().any(|point| point[1] > 0.0))
        };
        let touched: Vec<bool> = (0..bodies.len()).map(|k| acts(&peaks, k) || acts(&means, k)).collect();
        for lines in [&mut peaks, &mut means].into_iter().flatten() {
            let mut keep = touched.iter();
            lines.retain(|_| keep.next() == Some(&true));
        }
        let bodies = bodies.into_iter().zip(touched).filter_map(|(body, touched)| touched.then_some(body)).collect();
        Ok(Self { bodies, peaks, means })
    }

    /// A line for each peak, of one body beside it a dashed one for the mean; means where there are no peaks.
    fn series(&self, recorded: &RecordedScene) -> (Vec<Series>, Vec<String>) {
        let first = self.peaks.as_ref().or(self.means.as_ref()).cloned().unwrap_or_default();
        let (mut series, remarks) = body_series(recorded, &self.bodies, first);
        let alone = series.len() == 1;
        if alone {
            series[0].name = if self.peaks.is_some() { "peak" } else { "mean" }.to_owned();
        }
        if let (true, Some(_), Some(means)) = (alone, &self.peaks, &self.means) {
            series.extend(means.iter().map(|points| Series::solid("mean", points.clone(), 1).dashed(DASHED)));
        }
        (series, remarks)
    }
}

/// A value of each body over each interval that has some length, from the row at its end, the body and its length; none
/// where the array is not recorded.
fn steps(
    recorded: &RecordedScene,
    bodies: &[usize],
    array: &str,
    value: impl Fn(&[f64], usize, f64) -> f64,
) -> Result<Option<Vec<Vec<Point>>>, PlotError> {
    if !recorded.has(array) {
        return Ok(None);
    }
    let mut thinners = recorded.thinners(bodies.len());
    let mut last = None;
    recorded.each_row(&[array], |time, row| {
        let begin = last.replace(time).unwrap_or(time);
        if time > begin {
            for (thinner, body) in thinners.iter_mut().zip(bodies) {
                let value = value(row[0], *body, time - begin);
                thinner.push(begin, value);
                thinner.push(time, value);
            }
        }
    })?;
    Ok(Some(thinners.into_iter().map(Thinner::finish).collect()))
}
