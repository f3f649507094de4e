//! Forces of contact over time: their parts along and across the normals of the contacts.
//!
//! A body that only one plane, or planes of one normal, can touch has the parts of its recorded force. Where it meets
//! others, each contact is split by its own normal (`gyration::dynamics::ContactParts`), from what was recorded of that
//! or from model and states. Where a run has recorded peaks or impulses, `intervals` shows these instead. Impacts
//! exceed the weight by orders of magnitude: then the axis is logarithmic, from a thousandth of the weight on.

use super::bodies::{body_series, drawn_bodies, hue, time_axis, values};
use crate::chart::ticks::short;
use crate::chart::{Axis, AxisScale, Chart, DOTTED, Series, extremes};
use crate::draw::Point;
use crate::error::PlotError;
use crate::recorded::RecordedScene;
use crate::thin::Thinner;
use gyration::tensor::Vec3;
use gyration_sim::replay::Replay;
use std::collections::BTreeSet;

const HEIGHT: f64 = 120.0;
/// Forces that exceed the weight by this factor are drawn over a logarithmic axis.
const VIOLENT: f64 = 30.0;
/// Bodies times samples at which forces are computed again: some seconds.
const MOST_COMPUTED: usize = 40_000;

/// Why there is nothing to draw.
pub const NO_FORCES: &str = "no contact exerts a force on a body at any of its samples";

/// The forces on the bodies that are touched.
struct Forces {
    bodies: Vec<usize>,
    normal: Vec<Vec<Point>>,
    tangential: Vec<Vec<Point>>,
}

/// Normal and tangential force of each body.
pub fn chart(recorded: &RecordedScene) -> Result<Chart, PlotError> {
    let normal = common_normal(recorded);
    let (forces, are_split) = match normal {
        Some(normal) => (Forces::split(recorded, &normal)?, true),
        None if recorded.has(RECORDED[0]) && recorded.has(RECORDED[1]) => (Forces::recorded(recorded)?, true),
        None => match Forces::computed(recorded)? {
            Some(forces) => (forces, true),
            None => (Forces::whole(recorded)?, false),
        },
    };
    let most = largest(&forces.normal).max(largest(&forces.tangential));
    if most == 0.0 || !most.is_finite() {
        return Err(PlotError::Nothing { what: "forces", reason: NO_FORCES });
    }
    let x = time_axis(recorded)?;
    let weight = heaviest(recorded, &forces.bodies, &normal.unwrap_or_else(|| recorded.up()));
    let (mut series, mut remarks) = forces.series(recorded, most);
    if weight > 0.0 && forces.bodies.len() == 1 {
        series.push(Series::level("weight", weight, &x));
    }
    remarks.push(sampling(recorded)?);
    if !are_split {
        if forces.bodies.len() == 1 {
            series[0].name = "magnitude".to_owned();
        }
        remarks.push("magnitudes: the model is not known".to_owned());
    }
    let y = force_axis(&series, weight, most);
    let title = "Force of contact".to_owned();
    Ok(Chart { title, x, y, series, remarks, height: HEIGHT })
}

/// The largest magnitude.
fn largest(lines: &[Vec<Point>]) -> f64 {
    extremes(lines.iter().flatten().map(|point| point[1].abs())).map_or(0.0, |(_, high)| high)
}

/// The arrays of the parts, where they were recorded.
const RECORDED: [&str; 2] = ["normal_force", "tangential_force"];

impl Forces {
    /// By one normal.
    fn split(recorded: &RecordedScene, normal: &Vec3) -> Result<Self, PlotError> {
        let bodies = drawn_bodies(recorded);
        let count = bodies.len();
        let part = |row: &[&[f64]], k: usize| {
            let force = Vec3::from_column_slice(&row[0][3 * bodies[k % count]..][..3]);
            let along = force.dot(normal);
            if k < count { along } else { (force - along * normal).norm() }
        };
        Ok(Self::touched(&bodies, recorded.lines(&["contact_force"], 2 * count, part)?))
    }

    /// As the parts were recorded.
    fn recorded(recorded: &RecordedScene) -> Result<Self, PlotError> {
        let bodies = drawn_bodies(recorded);
        let count = bodies.len();
        let part = |row: &[&[f64]], k: usize| row[k / count][bodies[k % count]];
        Ok(Self::touched(&bodies, recorded.lines(&RECORDED, 2 * count, part)?))
    }

    /// From model and states, at the samples that a picture of the recorded forces shows; none where the model cannot
    /// be had.
    fn computed(recorded: &RecordedScene) -> Result<Option<Self>, PlotError> {
        let bodies = drawn_bodies(recorded);
        let Ok(mut replay) = Replay::open(recorded.recording) else { return Ok(None) };
        let rows = shown_rows(recorded, &bodies)?;
        let times = recorded.recording.times()?;
        let mut lines = vec![Vec::with_capacity(rows.len()); 2 * bodies.len()];
        for row in rows {
            let Ok(parts) = replay.contact_parts(row) else { return Ok(None) };
            for (k, body) in bodies.iter().enumerate() {
                lines[k].push([times[row], parts[*body].normal]);
                lines[bodies.len() + k].push([times[row], parts[*body].tangential]);
            }
        }
        Ok(Some(Self::touched(&bodies, lines)))
    }

    /// The magnitudes alone.
    fn whole(recorded: &RecordedScene) -> Result<Self, PlotError> {
        let bodies = drawn_bodies(recorded);
        let count = bodies.len();
        let part = |row: &[&[f64]], k: usize| {
            if k < count { Vec3::from_column_slice(&row[0][3 * bodies[k]..][..3]).norm() } else { 0.0 }
        };
        Ok(Self::touched(&bodies, recorded.lines(&["contact_force"], 2 * count, part)?))
    }

    /// Of the lines of the normal parts of bodies and then of the tangential ones, those of bodies that are touched.
    fn touched(bodies: &[usize], mut along: Vec<Vec<Point>>) -> Self {
        let across = along.split_off(bodies.len());
        let mut forces = Self { bodies: Vec::new(), normal: Vec::new(), tangential: Vec::new() };
        for (body, (along, across)) in bodies.iter().zip(along.into_iter().zip(across)) {
            let touched = along.iter().chain(&across).any(|point| point[1] != 0.0);
            if touched {
                forces.bodies.push(*body);
                forces.normal.push(along);
                forces.tangential.push(across);
            }
        }
        forces
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
            let hue = if alone { 1 } else { hue(recorded, *body) };
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

/// The largest weight of some bodies along a direction [N].
pub fn heaviest(recorded: &RecordedScene, bodies: &[usize], along: &Vec3) -> f64 {
    let masses = bodies.iter().map(|body| recorded.bodies[*body].mass);
    masses.fold(0.0, f64::max) * recorded.gravity.dot(along).abs()
}

/// The axis of forces of which the largest magnitude is `most`: logarithmic where the weight is little beside it.
pub fn force_axis(series: &[Series], weight: f64, most: f64) -> Axis {
    let attraction = values(series).any(|force| force < -1e-6 * most);
    if weight > 0.0 && most > VIOLENT * weight && !attraction {
        let floor = Axis::logarithmic("force", "N", [1e-3 * weight, most]);
        return Axis { low: 1e-3 * weight, scale: AxisScale::Logarithmic, ..floor };
    }
    Axis::linear("force", "N", values(series).chain([0.0]))
}

/// The samples at which a picture shows the forces on some bodies: their least and largest in each column of pixels.
fn shown_rows(recorded: &RecordedScene, bodies: &[usize]) -> Result<BTreeSet<usize>, PlotError> {
    let mut thinners: Vec<Thinner> = recorded.thinners(bodies.len());
    let mut row = 0_u32;
    recorded.each_row(&["contact_force"], |_, rows| {
        for (thinner, body) in thinners.iter_mut().zip(bodies) {
            thinner.push(f64::from(row), Vec3::from_column_slice(&rows[0][3 * body..][..3]).norm());
        }
        row += 1;
    })?;
    let shown = thinners.into_iter().flat_map(Thinner::finish).map(|[row, _]| row as usize);
    let mut shown: BTreeSet<usize> = shown.collect();
    // Of a crowd fewer, evenly.
    let every = (shown.len() * recorded.bodies.len()).div_ceil(MOST_COMPUTED);
    if every > 1 {
        shown = shown.into_iter().step_by(every).collect();
    }
    Ok(shown)
}

/// The normal that all supports share, where bodies touch nothing else.
fn common_normal(recorded: &RecordedScene) -> Option<Vec3> {
    let resolved = recorded.recording.attributes().get("resolved");
    let contacts = resolved.and_then(|scene| scene["contact"].as_array()).map_or(&[][..], Vec::as_slice);
    if contacts.iter().any(|contact| !contact["between"].is_null()) {
        return None;
    }
    let Some(first) = recorded.supports.first() else { return Some(recorded.up()) };
    let same = recorded.supports.iter().all(|support| (support.normal - first.normal).norm() < 1e-9);
    same.then_some(first.normal)
}
