//! What stands in a chart beside lines: areas, dots and intervals, at values of its axes.
//!
//! Shapes of one colour are one path of the page, so that a map of ten thousand cells remains a small file. They lie
//! over the grid and under the lines.

use super::series::Chart;
use crate::draw::{Color, Mark, Page, Path, Point, Rect, Stroke};
use std::f64::consts::TAU;

/// Marks of one kind and colour; points are values (x, y).
#[derive(Debug, Clone, PartialEq)]
pub enum Shapes {
    /// Rectangles between opposite corners.
    Areas {
        /// The corners.
        corners: Vec<[Point; 2]>,
        /// What they are filled with.
        fill: Color,
    },
    /// Dots.
    Dots {
        /// Their centres.
        at: Vec<Point>,
        /// Their radius [pt].
        radius: f64,
        /// What they are filled with.
        fill: Color,
    },
    /// Upright lines with a bar at each end: intervals in which a number is believed to lie.
    Intervals {
        /// Lower and upper ends.
        ends: Vec<[Point; 2]>,
        /// How they are drawn.
        stroke: Stroke,
    },
}

/// A chart with shapes under its lines.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapeChart {
    /// Axes, lines and remarks.
    pub chart: Chart,
    /// From the lowest to the uppermost.
    pub shapes: Vec<Shapes>,
}

/// Half the width of the bars at the ends of an interval [pt].
const BAR: f64 = 2.2;
/// Neighbouring areas overlap by this, lest a viewer show the page between them [pt].
const SEAM: f64 = 0.15;

/// Draws shapes into the frame of a chart.
pub fn draw(shapes: &Shapes, chart: &Chart, drawing: &mut Page, frame: Rect) {
    let place = |[x, y]: Point| {
        [
            frame.x + chart.x.place(x).clamp(-1.0, 2.0) * frame.width,
            frame.bottom() - chart.y.place(y).clamp(-1.0, 2.0) * frame.height,
        ]
    };
    let finite = |point: &Point| point[0].is_finite() && point[1].is_finite();
    let (lines, closed, stroke, fill) = match shapes {
        Shapes::Areas { corners, fill } => {
            let areas = corners.iter().filter(|pair| pair.iter().all(finite)).map(|pair| area(pair.map(place)));
            (areas.collect(), true, None, Some(*fill))
        }
        Shapes::Dots { at, radius, fill } => {
            let dots = at.iter().filter(|point| finite(point)).map(|point| dot(place(*point), *radius));
            (dots.collect(), true, None, Some(*fill))
        }
        Shapes::Intervals { ends, stroke } => {
            let ends = ends.iter().filter(|pair| pair.iter().all(finite));
            (ends.flat_map(|pair| interval(pair.map(place))).collect::<Vec<_>>(), false, Some(*stroke), None)
        }
    };
    if !lines.is_empty() {
        drawing.marks.push(Mark::Path(Path { lines, closed, stroke, fill, clip: Some(frame) }));
    }
}

fn area([a, b]: [Point; 2]) -> Vec<Point> {
    let (left, right) = (a[0].min(b[0]) - SEAM, a[0].max(b[0]) + SEAM);
    let (above, below) = (a[1].min(b[1]) - SEAM, a[1].max(b[1]) + SEAM);
    vec![[left, above], [right, above], [right, below], [left, below]]
}

/// A polygon that looks round at this size.
fn dot(center: Point, radius: f64) -> Vec<Point> {
    let corners = if radius < 1.0 { 6 } else { 14 };
    let corner = |k: usize| {
        let (sine, cosine) = libm::sincos(TAU * k as f64 / corners as f64);
        [center[0] + radius * cosine, center[1] + radius * sine]
    };
    (0..corners).map(corner).collect()
}

fn interval([low, high]: [Point; 2]) -> [Vec<Point>; 3] {
    let bar = |end: Point| vec![[end[0] - BAR, end[1]], [end[0] + BAR, end[1]]];
    [vec![low, high], bar(low), bar(high)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::Axis;
    use crate::draw::color;

    #[test]
    fn shapes_of_one_colour_are_one_path() {
        let axis = || Axis::exact("", "", 0.0, 1.0);
        let (x, y) = (axis(), axis());
        let chart = Chart { title: String::new(), x, y, series: Vec::new(), remarks: Vec::new(), height: 100.0 };
        let mut drawing = Page::new(100.0, 100.0, "");
        let frame = Rect { x: 0.0, y: 0.0, width: 100.0, height: 100.0 };
        let corners = vec![[[0.0, 0.0], [0.5, 0.5]], [[0.5, 0.5], [1.0, 1.0]], [[f64::NAN, 0.0], [1.0, 1.0]]];
        draw(&Shapes::Areas { corners, fill: color::GREY }, &chart, &mut drawing, frame);
        draw(&Shapes::Dots { at: vec![], radius: 1.0, fill: color::GREY }, &chart, &mut drawing, frame);
        let [Mark::Path(path)] = drawing.marks.as_slice() else { panic!("{:?}", drawing.marks) };
        assert_eq!(path.lines.len(), 2, "what is not finite is left out");
        assert_eq!(path.lines[0][0], [-SEAM, 50.0 - SEAM], "the origin is the lower left corner");
    }
}
