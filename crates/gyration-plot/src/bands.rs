//! Bands of a lattice: frequencies over the path of wave vectors, in the colour of what moves most; decay rates below,
//! where there are any.
//!
//! A wave that grows without oscillating stands below zero, at minus its rate. Vertices have their names; gaps between
//! branches are shaded where a mesh over the zone has found them.

use crate::chart::{Axis, Chart, Series, ShapeChart, Shapes};
use crate::draw::{Point, color};
use crate::figure::{Figure, Panel};
use gyration_sim::survey::{BandSurvey, ContinuumSurvey};

/// Heights of the frames [pt].
const HEIGHT: f64 = 260.0;
const DECAY_HEIGHT: f64 = 110.0;
/// The largest error of a continuum that is drawn [%].
const MOST_OFF: f64 = 10.0;
/// What may move, in the order of the shares.
const PARTS: [&str; 5] = ["translation", "rotation", "shear", "stretch", "breathing"];
/// A gap, on white.
const SHADE: f64 = 0.16;

/// A path of wave vectors.
struct Route<'a> {
    kappa: &'a [[f64; 3]],
    /// [1/m].
    k: &'a [[f64; 3]],
    labels: &'a [(usize, String)],
    /// The rows at which there are vertices.
    vertices: &'a [usize],
    /// The rows at which it begins anew.
    begins: &'a [usize],
}

/// The figure of bands along a path.
pub fn bands(title: &str, found: &BandSurvey) -> Figure {
    let BandSurvey { kappa, k, labels, vertices, begins, .. } = found;
    let route = Route { kappa, k, labels, vertices, begins };
    let places = route.places();
    let x = route.axis(&places);
    let height = |row: usize, branch: usize| match (found.omega[row][branch], found.decay[row][branch]) {
        (0.0, growth) if growth < 0.0 => growth,
        (omega, _) => omega,
    };
    let mut series = lines(found, &places, &height);
    let lowest = points(&series).map(|point| point[1]).fold(0.0, f64::min);
    if lowest < 0.0 {
        series.insert(0, Series::level("", 0.0, &x));
    }
    let grows = if lowest < 0.0 { vec!["below zero: growth rates".to_owned()] } else { Vec::new() };
    let gaps = found.zone.as_ref().map_or(&[][..], |zone| &zone.gaps[..]);
    let shaded = if gaps.is_empty() { None } else { Some("shaded: gaps".to_owned()) };
    let top = points(&series).map(|point| point[1]).fold(0.0, f64::max);
    let y = Axis::exact("ω", "rad/s", if lowest < 0.0 { 1.06 * lowest } else { 0.0 }, 1.06 * top);
    let corners = gaps.iter().map(|gap| [[x.low, gap.from], [x.high, gap.to]]).collect();
    let shapes = vec![Shapes::Areas { corners, fill: color::GREY.tint(SHADE) }];
    let remarks = grows.into_iter().chain(shaded).collect();
    let chart = Chart { title: String::new(), x: x.clone(), y, series, remarks, height: HEIGHT };
    let mut panels = vec![Panel::ShapeChart(ShapeChart { chart, shapes })];
    if found.decay.iter().flatten().any(|decay| *decay != 0.0) {
        panels.push(Panel::Chart(decay(found, &places, x)));
    }
    let subtitle =
        "waves along a path of wave vectors, in the colour of what has most of the kinetic energy".to_owned();
    Figure { title: title.to_owned(), subtitle, panels }
}

/// Decay rates of all branches.
fn decay(found: &BandSurvey, places: &[f64], x: Axis) -> Chart {
    let mut series = lines(found, places, &|row, branch| found.decay[row][branch]);
    // The colours are told above.
    series.iter_mut().for_each(|series| series.name.clear());
    let y = Axis::linear("decay rate", "1/s", points(&series).map(|point| point[1]).chain([0.0]));
    series.insert(0, Series::level("", 0.0, &x));
    Chart { title: String::new(), x, y, series, remarks: Vec::new(), height: DECAY_HEIGHT }
}

fn points(series: &[Series]) -> impl Iterator<Item = &Point> {
    series.iter().flat_map(|series| &series.points)
}

impl Route<'_> {
    /// How far along the path each row is [1/m]; where it begins anew it goes on from where it ended.
    fn places(&self) -> Vec<f64> {
        let mut at = 0.0;
        let mut places = Vec::new();
        for (row, k) in self.k.iter().enumerate() {
            if row > 0 && !self.begins.contains(&row) {
                let before = &self.k[row - 1];
                let squares: f64 = k.iter().zip(before).map(|(k, before)| (k - before) * (k - before)).sum();
                at += libm::sqrt(squares);
            }
            places.push(at);
        }
        places
    }

    /// The axis with the names of the vertices.
    fn axis(&self, places: &[f64]) -> Axis {
        let level = Axis::exact("", "", 0.0, places.last().copied().unwrap_or(1.0));
        Axis { places: self.named(places), ..level }
    }

    /// The vertices with their names; where the path begins anew two stand at one place.
    fn named(&self, places: &[f64]) -> Vec<(f64, String)> {
        let mut vertices: Vec<(f64, String)> = Vec::new();
        for row in self.vertices {
            let name = self.name(*row);
            match vertices.last_mut() {
                Some((place, before)) if *place == places[*row] && *row > 0 => *before += &format!(" | {name}"),
                _ => vertices.push((places[*row], name)),
            }
        }
        vertices
    }

    fn name(&self, row: usize) -> String {
        match self.labels.iter().find(|(at, _)| *at == row).map(|(_, name)| name.as_str()) {
            Some("G" | "GAMMA" | "Gamma") => "Γ".to_owned(),
            Some(name) => name.to_owned(),
            None => {
                let rounded = |kappa: &f64| format!("{}", (1e3 * kappa).round() / 1e3 + 0.0);
                self.kappa[row].iter().map(rounded).collect::<Vec<_>>().join(", ")
            }
        }
    }

    /// A line for each column of a table, cut where the path begins anew.
    fn lines(&self, places: &[f64], table: &[Vec<f64>]) -> Vec<Vec<Point>> {
        let mut lines: Vec<Vec<Point>> = Vec::new();
        for column in 0..table.first().map_or(0, Vec::len) {
            for (row, (place, values)) in places.iter().zip(table).enumerate() {
                let point = [*place, values[column]];
                match lines.last_mut().filter(|_| row > 0 && !self.begins.contains(&row)) {
                    Some(line) => line.push(point),
                    None => lines.push(vec![point]),
                }
            }
        }
        lines
    }
}

/// The figure of a continuum beside the bands of its lattice.
pub fn continuum(title: &str, found: &ContinuumSurvey) -> Figure {
    let map = &found.map;
    let (kappa, k, labels) = (&map.kappa, &map.k, &map.labels);
    let route = Route { kappa, k, labels, vertices: &map.vertices, begins: &map.begins };
    let places = route.places();
    let x = route.axis(&places);
    let named = |lines: Vec<Vec<Point>>, name: &str, color: usize| {
        let line = move |(number, line)| Series::solid(if number == 0 { name } else { "" }, line, color);
        lines.into_iter().enumerate().map(line).collect::<Vec<Series>>()
    };
    let lattice = named(route.lines(&places, &map.omega), "lattice", 0);
    let top = points(&lattice).map(|point| point[1]).fold(0.0, f64::max);
    let model = found.model.name();
    let own = named(route.lines(&places, &map.continuum), model, 1);
    // A model that leaves the frequencies of the lattice behind leaves the frame.
    let y = Axis::exact("ω", "rad/s", 0.0, 1.25 * top);
    let percent = |row: &Vec<Option<f64>>| row.iter().map(|error| 100.0 * error.unwrap_or(0.0)).collect();
    let errors: Vec<Vec<f64>> = map.error.iter().map(percent).collect();
    let off = named(route.lines(&places, &errors), "", 1);
    let error_axis = Axis::exact("off by", "%", 0.0, MOST_OFF);
    let level = Series::level("", 1.0, &x);
    let series = lattice.into_iter().chain(own).collect();
    let chart = Chart { title: String::new(), x: x.clone(), y, series, remarks: Vec::new(), height: HEIGHT };
    let series = std::iter::once(level).chain(off).collect();
    let remarks = vec!["dashed: 1 %".to_owned()];
    let errors = Chart { title: String::new(), x, y: error_axis, series, remarks, height: DECAY_HEIGHT };
    let subtitle = format!("waves of the lattice, and of the continuum \"{model}\" in its place");
    Figure { title: title.to_owned(), subtitle, panels: vec![Panel::Chart(chart), Panel::Chart(errors)] }
}

/// The branches, cut where the path begins anew and where something else moves most.
fn lines(found: &BandSurvey, places: &[f64], height: &impl Fn(usize, usize) -> f64) -> Vec<Series> {
    let most = |row: usize, branch: usize| {
        let shares = &found.participation[row][branch];
        (0..PARTS.len()).fold(0, |most, part| if shares[part] > shares[most] + 1e-9 { part } else { most })
    };
    let mut pieces: Vec<(usize, Vec<Point>)> = Vec::new();
    for branch in 0..found.omega.first().map_or(0, Vec::len) {
        for (row, place) in places.iter().enumerate() {
            let (point, part) = ([*place, height(row, branch)], most(row, branch));
            let begins = row == 0 || found.begins.contains(&row);
            match pieces.last_mut().filter(|_| !begins) {
                Some((before, piece)) => {
                    piece.push(point);
                    if *before != part {
                        pieces.push((part, vec![point]));
                    }
                }
                None => pieces.push((part, vec![point])),
            }
        }
    }
    // A piece of one point lies on its neighbour, unless the path has no other.
    pieces.retain(|(_, piece)| piece.len() > 1 || places.len() == 1);
    pieces.sort_by_key(|(part, _)| *part);
    let mut named = [false; PARTS.len()];
    let series = pieces.into_iter().map(|(part, piece)| {
        let name = if std::mem::replace(&mut named[part], true) { "" } else { PARTS[part] };
        Series::solid(name, piece, part)
    });
    series.collect()
}
