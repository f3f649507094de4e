//! How far the centres of mass travel: level displacement from the start, and the length of the level path.
//!
//!   d(t) = (1 − u⊗u)(p₀(t) − p₀(0)),   s(t) = Σ |Δd| over the samples
//!
//! u is the direction against gravity. The axis along which bodies get farthest comes first; the other one is drawn
//! where anything happens along it.

use super::bodies::{MOST_NAMES, body_series, drawn_bodies, hue, time_axis, values};
use crate::chart::ticks::length_in_words;
use crate::chart::{Axis, Chart, DASHED, DOTTED, Series, extremes};
use crate::cycle::{AtTime, Cycle, rounded};
use crate::draw::Point;
use crate::error::PlotError;
use crate::recorded::RecordedScene;
use crate::thin::Thinner;
use gyration::tensor::Vec3;

const HEIGHT: f64 = 120.0;
/// An axis along which bodies move by less than this part of the other is left out.
const ASIDE: f64 = 1e-3;

/// A body that gets no farther than this part of its size travels nowhere: what is left is rounding, and errors of
/// steps.
pub const NOWHERE: f64 = 1e-6;

/// Two level directions with their names.
pub struct LevelAxes([(String, Vec3); 2]);

impl LevelAxes {
    /// x and y as far as they are level; else x, or y, made level, and what is normal to it.
    pub fn to(up: &Vec3) -> Self {
        let level = |axis: Vec3| axis - up * up.dot(&axis);
        let first = if level(Vec3::x()).norm() > 0.5 { level(Vec3::x()) } else { level(Vec3::y()) }.normalize();
        let second = up.cross(&first);
        let second = if second.sum() < 0.0 { -second } else { second };
        Self([first, second].map(|axis| (axis_name(&axis), axis)))
    }

    /// The level parts of a displacement [m].
    pub fn parts(&self, displacement: &Vec3) -> [f64; 2] {
        [0, 1].map(|k| self.0[k].1.dot(displacement))
    }
}

fn axis_name(axis: &Vec3) -> String {
    let along = |unit: Vec3| (axis - unit).norm() < 1e-9;
    for (name, unit) in [("x", Vec3::x()), ("y", Vec3::y()), ("z", Vec3::z())] {
        if along(unit) {
            return name.to_owned();
        }
    }
    format!("({})", [axis.x, axis.y, axis.z].map(rounded).join(", "))
}

/// The travels of the bodies drawn.
struct Travels {
    bodies: Vec<usize>,
    /// Along the two level directions, and the path, of each body.
    lines: [Vec<Vec<Point>>; 3],
    /// What the last cycle added along the two directions, where there is one [m].
    by_cycle: Vec<Option<[f64; 2]>>,
}

impl Travels {
    fn read(recorded: &RecordedScene, level: &LevelAxes) -> Result<Self, PlotError> {
        let bodies = drawn_bodies(recorded);
        let span = recorded.span()?;
        let cycles: Vec<Option<Cycle>> =
            bodies.iter().map(|body| Cycle::last(recorded.bodies[*body].period, span)).collect();
        let mut marks: Vec<Option<AtTime<2>>> = cycles.iter().map(|c| c.map(|c| AtTime::at(c.start))).collect();
        let mut thinners = recorded.thinners(3 * bodies.len());
        // The start of each body, its last displacement, and its path.
        let mut tracks: Vec<Option<(Vec3, [f64; 2], f64)>> = vec![None; bodies.len()];
        recorded.each_row(&["position"], |time, row| {
            for (k, body) in bodies.iter().enumerate() {
                let place = Vec3::from_column_slice(&row[0][3 * body..][..3]);
                let (start, before, path) = tracks[k].unwrap_or((place, [0.0; 2], 0.0));
                let parts = level.parts(&(place - start));
                let path = path + libm::hypot(parts[0] - before[0], parts[1] - before[1]);
                tracks[k] = Some((start, parts, path));
                if let Some(mark) = &mut marks[k] {
                    mark.push(time, parts);
                }
                let [along, across] = parts;
                for (part, value) in [along, across, path].into_iter().enumerate() {
                    thinners[3 * k + part].push(time, value);
                }
            }
        })?;
        let mut lines = [Vec::new(), Vec::new(), Vec::new()];
        for (k, thinner) in thinners.into_iter().map(Thinner::finish).enumerate() {
            lines[k % 3].push(thinner);
        }
        let by_cycle = marks.iter().map(|mark| mark.as_ref().and_then(AtTime::since)).collect();
        Ok(Self { bodies, lines, by_cycle })
    }

    /// The largest displacement along a direction [m], of the bodies that contract, if there are any.
    fn reach(&self, recorded: &RecordedScene, direction: usize) -> f64 {
        let contracts = |body: &usize| recorded.bodies[*body].contracts();
        let any = self.bodies.iter().any(contracts);
        let counts = self.bodies.iter().zip(&self.lines[direction]).filter(|(body, _)| !any || contracts(body));
        counts.map(|(_, line)| farthest(line)).fold(0.0, f64::max)
    }
}

/// The largest magnitude on a line.
fn farthest(line: &[Point]) -> f64 {
    extremes(line.iter().map(|point| point[1].abs())).map_or(0.0, |(_, high)| high)
}

/// The chart.
pub fn chart(recorded: &RecordedScene) -> Result<Chart, PlotError> {
    let level = LevelAxes::to(&recorded.up());
    let travels = Travels::read(recorded, &level)?;
    let reach = [0, 1].map(|direction| travels.reach(recorded, direction));
    let nowhere = NOWHERE * travels.bodies.iter().map(|body| recorded.bodies[*body].size).fold(0.0, f64::max);
    let (main, aside) = if reach[1] > reach[0].max(nowhere) { (1, 0) } else { (0, 1) };
    let names = [0, 1].map(|k| format!("along {}", level.0[k].0));
    let (mut series, mut remarks) = body_series(recorded, &travels.bodies, travels.lines[main].clone());
    let alone = series.len() == 1;
    if alone {
        series[0].name.clone_from(&names[main]);
    } else {
        remarks.push(format!("solid: {}", names[main]));
    }
    let others = [(names[aside].as_str(), DASHED, aside), ("length of the path", DOTTED, 2)];
    for (name, dash, which) in others {
        let goes = |line: &[Point]| which == 2 || farthest(line) > nowhere.max(ASIDE * reach[main]);
        let lines = travels.bodies.iter().zip(&travels.lines[which]).filter(|(_, line)| goes(line));
        for (k, (body, points)) in lines.enumerate() {
            let name = match (alone, k) {
                (true, _) => name.to_owned(),
                (false, 0) => format!("{}: {name}", if dash == DASHED { "dashed" } else { "dotted" }),
                _ => String::new(),
            };
            series.push(Series::solid(name, points.clone(), hue(recorded, *body)).dashed(dash));
        }
    }
    remarks.extend(cycles_in_words(recorded, &travels, &names));
    // Rounding is not blown up to the height of the chart.
    let y = Axis::linear("distance", "m", values(&series).chain([-nowhere, nowhere]));
    let title = "Level distance of the centre of mass from its start".to_owned();
    Ok(Chart { title, x: time_axis(recorded)?, y, series, remarks, height: HEIGHT })
}

/// What the last cycle of each body gained, along the direction in which it gained more.
fn cycles_in_words(recorded: &RecordedScene, travels: &Travels, names: &[String; 2]) -> Vec<String> {
    let mut words = Vec::new();
    let alone = travels.bodies.len() == 1;
    for (body, gained) in travels.bodies.iter().zip(&travels.by_cycle) {
        let Some(gained) = gained else { continue };
        let body = &recorded.bodies[*body];
        let direction = if gained[1].abs() > gained[0].abs() { 1 } else { 0 };
        let length = format!("{} {}", signed_length(gained[direction]), names[direction]);
        if alone {
            let lengths = rounded(gained[direction].abs() / body.size);
            words.extend([format!("last cycle: {length}"), format!("= {lengths} body lengths")]);
        } else {
            words.push(format!("{}: {length}", body.name));
        }
    }
    words.truncate(MOST_NAMES);
    if !alone && !words.is_empty() {
        words.insert(0, "in the last cycle".to_owned());
    }
    words
}

/// A length of either sign, in the unit in which it reads best.
fn signed_length(length: f64) -> String {
    if length == 0.0 {
        return "0 m".to_owned();
    }
    // Below a femtometre there is but rounding.
    let words =
        if length.abs() < 1e-12 { format!("{} m", rounded(length.abs())) } else { length_in_words(length.abs()) };
    if length < 0.0 { format!("-{words}") } else { words }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn level_directions_are_level_and_have_the_names_of_axes() {
        let up = Vec3::new(0.3, 0.0, 1.0).normalize();
        for (up, names) in [(Vec3::z(), ["x", "y"]), (Vec3::y(), ["x", "z"]), (Vec3::x(), ["y", "z"])] {
            assert_eq!(LevelAxes::to(&up).0.map(|(name, _)| name), names, "{up}");
        }
        for (_, axis) in LevelAxes::to(&up).0 {
            assert!(axis.dot(&up).abs() < 1e-15 && (axis.norm() - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn lengths_keep_their_sign() {
        assert_eq!([0.0012, -0.0012, 0.0].map(signed_length), ["1.2 mm", "-1.2 mm", "0 m"]);
        assert_eq!(signed_length(-2e-15), "-2×10^{-15} m");
    }
}
