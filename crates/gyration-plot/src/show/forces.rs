//! Forces of contact over time: their parts along and across the support's normal.
//!
//! Where all supports have one normal it is used, else the direction against gravity. Impacts exceed the weight by
//! orders of magnitude: then the axis is logarithmic, from a thousandth of the weight on.

use super::bodies::{body_series, drawn_bodies, time_axis, values};
use crate::chart::ticks::short;
use crate::chart::{Axis, AxisScale, Chart, DOTTED, Series, extremes};
use crate::draw::Point;
use crate::error::PlotError;
use crate::recorded::RecordedScene;
use gyration::tensor::Vec3;

const HEIGHT: f64 = 120.0;
/// Forces that exceed the weight by this factor are drawn over a logarithmic axis.
const VIOLENT: f64 = 30.0;

/// The forces on the bodies that are touched.
struct Forces {
    bodies: Vec<usize>,
    normal: Vec<Vec<Point>>,
    tangential: Vec<Vec<Point>>,
}

/// Normal and tangential force of each body.
pub fn chart(recorded: &RecordedScene) -> Result<Chart, PlotError> {
    let normal = common_normal(recorded);
    let forces = Forces::read(recorded, &normal)?;
    let most = largest(&forces.normal).max(largest(&forces.tangential));
    if most == 0.0 || !most.is_finite() {
        return Err(PlotError::Nothing { what: "forces", reason: "no support acts on a body" });
    }
    let x = time_axis(recorded)?;
    let masses = forces.bodies.iter().map(|body| recorded.bodies[*body].mass);
    let weight = masses.fold(0.0, f64::max) * recorded.gravity.dot(&normal).abs();
    let (mut series, mut remarks) = forces.series(recorded, most);
    if weight > 0.0 && forces.bodies.len() == 1 {
        series.push(Series::level("weight", weight, &x));
    }
    remarks.push(sampling(recorded)?);
    let y = axis(&series, weight, most);
    let title = "Force of contact".to_owned();
    Ok(Chart { title, x, y, series, remarks, height: HEIGHT })
}

/// The largest magnitude.
fn largest(lines: &[Vec<Point>]) -> f64 {
    extremes(lines.iter().flatten().map(|point| point[1].abs())).map_or(0.0, |(_, high)| high)
}

impl Forces {
    fn read(recorded: &RecordedScene, normal: &Vec3) -> Result<Self, PlotError> {
        let bodies = drawn_bodies(recorded);
        let count = bodies.len();
        let part = |row: &[&[f64]], k: usize| {
            let force = Vec3::from_column_slice(&row[0][3 * bodies[k % count]..][..3]);
            let along = force.dot(normal);
            if k < count { along } else { (force - along * normal).norm() }
        };
        let mut along = recorded.lines(&["contact_force"], 2 * count, part)?;
        let across = along.split_off(count);
        let mut forces = Self { bodies: Vec::new(), normal: Vec::new(), tangential: Vec::new() };
        for (body, (along, across)) in bodies.into_iter().zip(along.into_iter().zip(across)) {
            let touched = along.iter().chain(&across).any(|point| point[1] != 0.0);
            if touched {
                forces.bodies.push(body);
                forces.normal.push(along);
                forces.tangential.push(across);
            }
        }
        Ok(forces)
    }

    /// A solid line for each normal force, a dotted one for each tangential force, and remarks.
    fn series(&self, recorded: &RecordedScene, most: f64) -> (Vec<Series>, Vec<String>) {
        let (mut series, remarks) = body_series(recorded, &self.bodies, self.normal.clone());
        let alone = series.len() == 1;
        if alone {
            series[0].name = "normal".into();
        }
        // Across the normal there is but rounding where nothing slides.
        if largest(&self.tangential) <= 1e-9 * most {
            return (series, remarks);
        }
        for (k, (body, points)) in self.bodies.iter().zip(&self.tangential).enumerate() {
            let name = match (alone, k) {
                (true, _) => "tangential",
                (false, 0) => "tangential: dotted",
                _ => "",
            };
            let hue = if alone { 1 } else { *body };
            series.push(Series::solid(name, points.clone(), hue).dashed(DOTTED));
        }
        (series, remarks)
    }
}

/// How far samples are apart: peaks of shorter impacts are not seen whole.
fn sampling(recorded: &RecordedScene) -> Result<String, PlotError> {
    let times = recorded.recording.read_rows("time", 0..recorded.recording.rows().min(2))?.data;
    let spacing = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
    Ok(format!("sampled every {} s", short(spacing)))
}

fn axis(series: &[Series], weight: f64, most: f64) -> Axis {
    let attraction = values(series).any(|force| force < -1e-6 * most);
    if weight > 0.0 && most > VIOLENT * weight && !attraction {
        let floor = Axis::logarithmic("force", "N", [1e-3 * weight, most]);
        return Axis { low: 1e-3 * weight, scale: AxisScale::Logarithmic, ..floor };
    }
    Axis::linear("force", "N", values(series).chain([0.0]))
}

/// The normal that all supports share, else the direction against gravity.
fn common_normal(recorded: &RecordedScene) -> Vec3 {
    let up = recorded.up();
    let Some(first) = recorded.supports.first() else { return up };
    let same = recorded.supports.iter().all(|support| (support.normal - first.normal).norm() < 1e-9);
    if same { first.normal } else { up }
}
