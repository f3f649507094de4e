//! How many times its floor each piece of work takes: a bar a piece; a dashed line where it would be at its floor.

use crate::chart::{Axis, Chart, DASHED, Series, ShapeChart, Shapes};
use crate::draw::{Stroke, color};
use crate::figure::{Figure, Panel};

/// Height of a bar with its space [pt].
const PITCH: f64 = 20.0;
/// The part of it that the bar fills, half of it.
const HALF: f64 = 0.35;

/// A piece of work with a floor.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorBar {
    /// What is done.
    pub work: String,
    /// Its time over its floor.
    pub ratio: f64,
}

/// The figure; `machine` tells where it was measured.
pub fn floors(machine: &str, bars: &[FloorBar]) -> Figure {
    let most = bars.iter().map(|bar| bar.ratio).fold(1.0, f64::max);
    let x = Axis::exact("times its floor", "", 0.0, 1.1 * most);
    // The first stands on top.
    let y = Axis::of_words("", bars.iter().rev().map(|bar| bar.work.clone()).collect());
    let place = |index: usize| (bars.len() - 1 - index) as f64;
    let corners =
        bars.iter().enumerate().map(|(index, bar)| [[0.0, place(index) - HALF], [bar.ratio, place(index) + HALF]]);
    let shapes = vec![Shapes::Areas { corners: corners.collect(), fill: color::series(0) }];
    let height = PITCH * bars.len().max(1) as f64;
    let stroke = Stroke { color: color::INK, width: 0.9, dash: DASHED };
    let floor = Series { name: String::new(), points: vec![[1.0, y.low], [1.0, y.high]], stroke, arrows: false };
    let chart = Chart { title: String::new(), x, y, series: vec![floor], remarks: Vec::new(), height };
    Figure {
        title: "How near the floor".to_owned(),
        subtitle: machine.to_owned(),
        panels: vec![Panel::ShapeChart(ShapeChart { chart, shapes })],
    }
}
