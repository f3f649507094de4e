//! Forces of contact over time: their parts along and across the support's normal.
//!
//! Where all supports have one normal it is used, else the direction against gravity. Impacts exceed the weight by
//! orders of magnitude: then the axis is logarithmic, from a thousandth of the weight on.

use super::{body_series, drawn_bodies, time_axis, values};
use crate::plot::PlotError;
use crate::plot::chart::ticks::short;
use crate::plot::chart::{Axis, Chart, DOTTED, Scale, Series, extremes};
use crate::plot::recorded::Recorded;
use gyration::tensor::Vec3;

const HEIGHT: f64 = 120.0;
/// Forces that exceed the weight by this factor are drawn over a logarithmic axis.
const VIOLENT: f64 = 30.0;

/// Normal and tangential force of each body.
pub fn chart(recorded: &Recorded) -> Result<Chart, PlotError> {
    let normal = common_normal(recorded);
    let bodies = drawn_bodies(recorded);
    let count = bodies.len();
    let part = |row: &[&[f64]], k: usize| {
        let force = Vec3::from_column_slice(&row[0][3 * bodies[k % count]..][..3]);
        let along = force.dot(&normal);
        if k < count { along } else { (force - along * normal).norm() }
    };
    let mut lines = recorded.lines(&["contact_force"], 2 * count, part)?;
    let tangential = lines.split_off(count);
    let largest = |lines: &[Vec<[f64; 2]>]| {
        extremes(lines.iter().flatten().map(|point| point[1].abs())).map_or(0.0, |(_, high)| high)
    };
    let most = largest(&lines).max(largest(&tangential));
    if most == 0.0 || !most.is_finite() {
        return Err(PlotError::Nothing { what: "forces", reason: "no support acts on a body" });
    }
    let (mut series, mut remarks) = body_series(recorded, &bodies, lines);
    remarks.push(sampling(recorded)?);
    if count == 1 {
        series[0].name = "normal".into();
    }
    // Across the normal there is but rounding where nothing slides.
    if largest(&tangential) > 1e-9 * most {
        let (across, _) = body_series(recorded, &bodies, tangential);
        series.extend(across.into_iter().enumerate().map(|(k, line)| {
            let name = match count {
                1 => "tangential".to_owned(),
                _ if k == 0 => "tangential: dotted".to_owned(),
                _ => String::new(),
            };
            let hue = if count == 1 { 1 } else { bodies[k] };
            Series::solid(name, line.points, hue).dashed(DOTTED)
        }));
    }
    let x = time_axis(recorded)?;
    let weight =
        bodies.iter().map(|body| recorded.bodies[*body].mass).fold(0.0, f64::max) * recorded.gravity.dot(&normal).abs();
    if weight > 0.0 && count == 1 {
        series.push(Series::level("weight", weight, &x));
    }
    let y = axis(&series, weight, most);
    let title = "Force of contact".to_owned();
    Ok(Chart { title, x, y, series, remarks, height: HEIGHT })
}

/// How far samples are apart: peaks of shorter impacts are not seen whole.
fn sampling(recorded: &Recorded) -> Result<String, PlotError> {
    let times = recorded.recording.read_rows("time", 0..recorded.recording.rows().min(2))?.data;
    let spacing = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
    Ok(format!("sampled every {} s", short(spacing)))
}

fn axis(series: &[Series], weight: f64, most: f64) -> Axis {
    let attraction = values(series).any(|force| force < -1e-6 * most);
    if weight > 0.0 && most > VIOLENT * weight && !attraction {
        let floor = Axis::logarithmic("force", "N", [1e-3 * weight, most]);
        return Axis { low: 1e-3 * weight, scale: Scale::Logarithmic, ..floor };
    }
    Axis::linear("force", "N", values(series).chain([0.0]))
}

/// The normal that all supports share, else the direction against gravity.
fn common_normal(recorded: &Recorded) -> Vec3 {
    let up = recorded.up();
    let Some(first) = recorded.supports.first() else { return up };
    let same = recorded.supports.iter().all(|support| (support.normal - first.normal).norm() < 1e-9);
    if same { first.normal } else { up }
}
