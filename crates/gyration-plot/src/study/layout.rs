//! What pictures of studies share: height, entries of legends, what is known from elsewhere.

use super::request::PlotRequest;
use crate::chart::{Axis, Chart, DASH_DOTTED, DASHED, DOTTED, LINE, Series, ShapeChart, Shapes};
use crate::draw::{Color, Stroke, color};
use crate::figure::Panel;

/// Height of the frame of a chart [pt].
pub const HEIGHT: f64 = 240.0;

/// The remark on what a logarithmic scale leaves out.
pub fn left_out(count: usize) -> Vec<String> {
    if count == 0 { Vec::new() } else { vec![format!("{count} left out: not above zero")] }
}

/// What is drawn in a frame: shapes, and over them lines with the entries of the legend.
#[derive(Debug, Default)]
pub struct Layers {
    /// From the lowest to the uppermost.
    pub shapes: Vec<Shapes>,
    /// From the lowest to the uppermost.
    pub series: Vec<Series>,
}

impl Layers {
    /// Adds what is known from elsewhere, above everything else: lines, or dots in a ring.
    pub fn add_references(&mut self, request: &PlotRequest) {
        for (index, reference) in request.reference.iter().enumerate() {
            let ink = if index == 0 { color::INK } else { color::GREY };
            if reference.line {
                let dash = [DASHED, DOTTED, DASH_DOTTED][index % 3];
                let stroke = Stroke { dash, ..Stroke::solid(color::INK, LINE) };
                let points = reference.points.clone();
                self.series.push(Series { name: reference.name.clone(), points, stroke, arrows: false });
            } else {
                let dots = |radius: f64, fill: Color| Shapes::Dots { at: reference.points.clone(), radius, fill };
                self.shapes.extend([dots(4.4, color::WHITE), dots(3.4, ink)]);
                self.series.push(Series::swatch(reference.name.clone(), ink));
            }
        }
    }

    /// The panel of a chart without title.
    pub fn panel(self, x: Axis, y: Axis, remarks: Vec<String>, height: f64) -> Panel {
        let chart = Chart { title: String::new(), x, y, series: self.series, remarks, height };
        Panel::ShapeChart(ShapeChart { chart, shapes: self.shapes })
    }
}
