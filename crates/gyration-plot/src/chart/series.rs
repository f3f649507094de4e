//! Series over two axes.

use super::axis::Axis;
use super::legend::Legend;
use crate::draw::{Color, Point, Stroke, color};

/// A line through values.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its name in the legend; empty: not in the legend.
    pub name: String,
    /// The values (x, y); one that is not finite interrupts the line.
    pub points: Vec<Point>,
    /// How it is drawn.
    pub stroke: Stroke,
    /// Whether heads of arrows tell in which sense it runs.
    pub arrows: bool,
}

/// Widths of lines of data [pt].
pub const LINE: f64 = 1.3;
/// Dashes of the second style of lines [pt].
pub const DASHED: &[f64] = &[5.0, 2.5];
/// Dashes of the third style of lines [pt].
pub const DOTTED: &[f64] = &[1.5, 2.0];
/// Dashes of the fourth style of lines [pt].
pub const DASH_DOTTED: &[f64] = &[6.0, 2.0, 1.5, 2.0];
/// Width of the samples of areas in legends [pt].
const SWATCH: f64 = 7.0;

impl Series {
    /// A solid line in the colour of this index.
    pub fn solid(name: impl Into<String>, points: Vec<Point>, index: usize) -> Self {
        Self { name: name.into(), points, stroke: Stroke::solid(color::series(index), LINE), arrows: false }
    }

    /// The same in another style.
    pub fn dashed(self, dash: &'static [f64]) -> Self {
        Self { stroke: Stroke { dash, ..self.stroke }, ..self }
    }

    /// A level line from one end of the axis to the other.
    pub fn level(name: impl Into<String>, y: f64, axis: &Axis) -> Self {
        let stroke = Stroke { color: color::GREY, width: 0.9, dash: DASHED };
        Self { name: name.into(), points: vec![[axis.low, y], [axis.high, y]], stroke, arrows: false }
    }
}

impl Series {
    /// The entry of an area or of dots in a legend.
    pub fn swatch(name: impl Into<String>, color: Color) -> Self {
        Self { name: name.into(), points: Vec::new(), stroke: Stroke::solid(color, SWATCH), arrows: false }
    }

    /// The entry of a legend that says what the next ones are.
    pub fn heading(name: impl Into<String>) -> Self {
        Self::swatch(name, Color { rgb: [0xFF; 3], opacity: 0.0 })
    }
}

/// Series over two axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// What it shows; above the frame.
    pub title: String,
    /// The axis to the right.
    pub x: Axis,
    /// The axis upwards.
    pub y: Axis,
    /// From the lowest to the uppermost.
    pub series: Vec<Series>,
    /// Remarks at the end of the legend.
    pub remarks: Vec<String>,
    /// Height of the frame [pt].
    pub height: f64,
}

impl Chart {
    /// The legend; empty if there is but one series whose name the axis tells.
    pub fn legend(&self) -> Legend {
        let mut legend = Legend::default();
        for series in self.series.iter().filter(|series| !series.name.is_empty()) {
            legend.entry(&series.name, series.stroke);
        }
        self.remarks.iter().for_each(|remark| legend.remark(remark));
        legend
    }
}
