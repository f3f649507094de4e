//! The spectrum of a ring: branches over κ, with dots that tell how much energy is in each, and the energy over time.

use crate::chart::{Axis, Chart, LINE, Series, ShapeChart, Shapes};
use crate::draw::{Point, Stroke, color};
use crate::figure::{Figure, Panel};
use crate::show::title;
use gyration_record::Recording;
use gyration_sim::RingSpectrum;

/// Heights of the frames [pt].
const HEIGHT: f64 = 260.0;
const ENERGY_HEIGHT: f64 = 110.0;
/// Parts of the energy, and the radii of the dots of what has at least as much [pt].
const DOTS: [(f64, f64); 4] = [(1e-1, 6.0), (1e-2, 4.2), (1e-4, 2.8), (1e-6, 1.6)];
const AS_MUCH: [&str; 4] = ["dots: 10 %, 1 %,", "0.01 %, 0.0001 %", "of the energy", "and more"];

/// The figure of a spectrum.
pub fn spectrum(recording: &Recording, found: &RingSpectrum) -> Figure {
    let branches = found.omega.first().map_or(0, Vec::len);
    let axis = (0..3).find(|a| found.kappa.iter().any(|kappa| kappa[*a] != 0.0)).unwrap_or(0);
    let is_line = found.kappa.iter().all(|kappa| (0..3).all(|a| a == axis || kappa[a] == 0.0));
    let x = Axis::exact(&format!("κ along cell vector {}", axis + 1), "", -0.5, 0.5);
    let place = |row: usize, branch: usize| [found.kappa[row][axis], found.omega[row][branch]];
    let line = |branch: usize| {
        let points = (0..found.kappa.len()).map(|row| place(row, branch)).collect();
        Series { name: String::new(), points, stroke: Stroke::solid(color::GREY, LINE), arrows: false }
    };
    // Along several directions waves of one κ lie above one another: dots alone.
    let series = if is_line { (0..branches).map(line).collect() } else { Vec::new() };
    let top = found.omega.iter().flatten().copied().fold(0.0, f64::max);
    let total = found.mean_energy();
    let share = |row: usize, branch: usize| (found.energy[row][branch] / total).abs();
    let dots = DOTS.iter().enumerate().rev().map(|(class, (least, radius))| {
        let most = class.checked_sub(1).map_or(f64::INFINITY, |above| DOTS[above].0);
        let all = (0..found.kappa.len()).flat_map(|row| (0..branches).map(move |branch| (row, branch)));
        let own = all.filter(|(row, branch)| (*least..most).contains(&share(*row, *branch)));
        let at: Vec<Point> = own.map(|(row, branch)| place(row, branch)).collect();
        Shapes::Dots { at, radius: *radius, fill: color::series(0) }
    });
    let shapes = dots.collect();
    let y = Axis::exact("ω", "rad/s", 0.0, if top > 0.0 { 1.06 * top } else { 1.0 });
    let remarks = AS_MUCH.map(str::to_owned).to_vec();
    let chart = Chart { title: String::new(), x, y, series, remarks, height: HEIGHT };
    let mut panels = vec![Panel::ShapeChart(ShapeChart { chart, shapes })];
    if found.t.len() > 1 {
        panels.push(Panel::Chart(energies(found)));
    }
    let subtitle = "the energy of a ring in the waves of its cell: mean over time above, all of it over time below";
    Figure { title: title(recording).to_owned(), subtitle: subtitle.to_owned(), panels }
}

/// The energy of all branches, and that of the run, over time.
fn energies(found: &RingSpectrum) -> Chart {
    let over_time = |values: &[f64]| found.t.iter().zip(values).map(|(t, value)| [*t, *value]).collect::<Vec<Point>>();
    let (branches, run) = (over_time(&found.total), over_time(&found.run));
    let values = branches.iter().chain(&run).map(|point| point[1]).filter(|value| value.is_finite()).chain([0.0]);
    let y = Axis::linear("energy", "J", values.collect::<Vec<f64>>());
    let x = Axis::exact("t", "s", found.t[0], found.t[found.t.len() - 1]);
    let series = vec![Series::solid("all branches", branches, 0), Series::solid("run, above rest", run, 1)];
    Chart { title: String::new(), x, y, series, remarks: Vec::new(), height: ENERGY_HEIGHT }
}
