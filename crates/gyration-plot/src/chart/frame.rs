//! The frame of a chart: grid, ticks, words, title, and the series inside.

use super::axis::{Axis, AxisScale};
use super::series::{Chart, Series};
use super::shapes::{self, Shapes};
use super::ticks::Tick;
use crate::draw::{Anchor, Color, Label, Page, Point, Rect, Stroke, Text, color};

/// Height of the words at ticks [pt].
pub const TICK_SIZE: f64 = 8.0;
/// Height of the names of axes [pt].
pub const NAME_SIZE: f64 = 9.0;
/// Height of titles [pt].
pub const TITLE_SIZE: f64 = 9.5;
/// Length of major ticks [pt].
const TICK: f64 = 4.0;
/// Between a tick and its words [pt].
const SPACE: f64 = 3.0;
/// Points of an upright axis for every tick with words.
const UPRIGHT_PITCH: f64 = 20.0;
/// Points of a level axis for every tick with words.
const LEVEL_PITCH: f64 = 62.0;
/// Lines are drawn through at most so many points at once: viewers slow down on longer ones.
const LONGEST_LINE: usize = 4000;

/// The part of the page that a chart takes to the left of its frame [pt].
pub fn left_margin(chart: &Chart) -> f64 {
    let ticks = upright_ticks(chart);
    let widest = ticks.iter().filter_map(|tick| tick.label.as_deref());
    let widest = widest.map(|words| Label::new(words).width(TICK_SIZE, false)).fold(0.0, f64::max);
    TICK + SPACE + widest + 6.0 + 1.3 * NAME_SIZE
}

/// The part below the frame that words and name of the level axis take [pt].
pub const BELOW: f64 = TICK + SPACE + 1.1 * TICK_SIZE + 1.5 * NAME_SIZE;

fn upright_ticks(chart: &Chart) -> Vec<Tick> {
    chart.y.ticks((chart.height / UPRIGHT_PITCH).max(2.0) as usize)
}

/// What stands in a frame.
pub struct Content<'a> {
    /// Axes and series.
    pub chart: &'a Chart,
    /// What stands under the series.
    pub shapes: &'a [Shapes],
    /// Whether the level axis has its words.
    pub with_words: bool,
}

/// Draws a chart into the frame.
pub fn draw(content: &Content, drawing: &mut Page, frame: Rect) {
    let Content { chart, shapes, with_words } = *content;
    let level = chart.x.ticks((frame.width / LEVEL_PITCH).max(2.0) as usize);
    let upright = upright_ticks(chart);
    let x = |value: f64| frame.x + chart.x.place(value) * frame.width;
    let y = |value: f64| frame.bottom() - chart.y.place(value) * frame.height;
    let grid = Stroke::solid(color::FAINT, 0.5);
    let major = |tick: &&Tick| tick.label.is_some();
    let across = |tick: &Tick| vec![[frame.x, y(tick.value)], [frame.right(), y(tick.value)]];
    drawing.lines(upright.iter().filter(major).map(across).collect(), grid, None);
    let along = |tick: &Tick| vec![[x(tick.value), frame.y], [x(tick.value), frame.bottom()]];
    drawing.lines(level.iter().filter(major).map(along).collect(), grid, None);
    shapes.iter().for_each(|shape| shapes::draw(shape, chart, drawing, frame));
    for series in &chart.series {
        draw_series(series, chart, drawing, frame);
    }
    draw_spines(drawing, frame);
    for tick in &upright {
        let length = if tick.label.is_some() { TICK } else { 0.5 * TICK };
        let at = [frame.x - length, y(tick.value)];
        drawing.line(vec![at, [frame.x, at[1]]], Stroke::solid(color::INK, 0.7), None);
        if let Some(words) = &tick.label {
            let at = [frame.x - TICK - SPACE, at[1] + 0.35 * TICK_SIZE];
            drawing.text(words_at(words, at, Anchor::End, TICK_SIZE, color::INK));
        }
    }
    for tick in &level {
        let length = if tick.label.is_some() { TICK } else { 0.5 * TICK };
        let at = [x(tick.value), frame.bottom() + length];
        drawing.line(vec![[at[0], frame.bottom()], at], Stroke::solid(color::INK, 0.7), None);
        if let (Some(words), true) = (&tick.label, with_words) {
            let at = [at[0], frame.bottom() + TICK + SPACE + 0.8 * TICK_SIZE];
            drawing.text(words_at(words, at, Anchor::Middle, TICK_SIZE, color::INK));
        }
    }
    draw_names(chart, drawing, frame, with_words);
}

fn draw_spines(drawing: &mut Page, frame: Rect) {
    let [upper_left, _, lower_right, lower_left] = frame.corners();
    drawing.line(vec![upper_left, lower_left, lower_right], Stroke::solid(color::INK, 0.8), None);
}

fn draw_names(chart: &Chart, drawing: &mut Page, frame: Rect, with_words: bool) {
    let name = |axis: &Axis| Label::new(&axis.label());
    let beside = [frame.x - left_margin(chart) + NAME_SIZE, frame.y + 0.5 * frame.height];
    let text = Text { upright: true, ..words_at("", beside, Anchor::Middle, NAME_SIZE, color::INK) };
    drawing.text(Text { label: name(&chart.y), ..text });
    if with_words {
        let below = [frame.x + 0.5 * frame.width, frame.bottom() + BELOW - 0.3 * NAME_SIZE];
        let text = words_at("", below, Anchor::Middle, NAME_SIZE, color::INK);
        drawing.text(Text { label: name(&chart.x), ..text });
    }
    if !chart.title.is_empty() {
        let above = [frame.x, frame.y - 6.0];
        let title = words_at(&chart.title, above, Anchor::Start, TITLE_SIZE, color::INK);
        drawing.text(Text { bold: true, ..title });
    }
}

/// A label with the usual properties.
pub fn words_at(words: &str, at: Point, anchor: Anchor, size: f64, color: Color) -> Text {
    Text { label: Label::new(words), at, anchor, size, color, bold: false, upright: false }
}

/// Lines through the finite values; a value alone becomes a dot.
fn draw_series(series: &Series, chart: &Chart, drawing: &mut Page, frame: Rect) {
    // A line's width more than the frame, so that a line along the edge keeps its width.
    let margin = series.stroke.width;
    let clip =
        Rect { x: frame.x, y: frame.y - margin, width: frame.width + margin, height: frame.height + 2.0 * margin };
    let place = |[x, y]: Point| {
        let y = if chart.y.scale == AxisScale::Logarithmic { y.max(f64::MIN_POSITIVE) } else { y };
        // Far outside is as good as just outside, and keeps the numbers of the file short.
        let upright = chart.y.place(y).clamp(-1.0, 2.0);
        [frame.x + chart.x.place(x) * frame.width, frame.bottom() - upright * frame.height]
    };
    let finite = |[x, y]: &Point| x.is_finite() && y.is_finite();
    for run in series.points.split(|point| !finite(point)).filter(|run| !run.is_empty()) {
        if let [alone] = run {
            drawing.dot(place(*alone), 1.5 * margin, series.stroke.color, Some(clip));
            continue;
        }
        if series.arrows {
            let points: Vec<Point> = run.iter().map(|point| place(*point)).collect();
            draw_arrows(&points, series.stroke, drawing, clip);
        }
        let mut start = 0;
        while start + 1 < run.len() {
            let end = (start + LONGEST_LINE).min(run.len());
            let points = run[start..end].iter().map(|point| place(*point)).collect();
            drawing.line(points, series.stroke, Some(clip));
            start = end - 1;
        }
    }
}

/// Length and half the width of the head of an arrow [pt].
const HEAD: [f64; 2] = [9.0, 3.6];
/// Heads along a line, evenly spread.
const HEADS: usize = 3;

/// Heads along a line of the page, each as its chord over the head's length runs.
fn draw_arrows(line: &[Point], stroke: Stroke, drawing: &mut Page, clip: Rect) {
    let lengths: Vec<f64> = line.windows(2).map(|pair| distance(pair[0], pair[1])).collect();
    let whole: f64 = lengths.iter().sum();
    let at = |along: f64| {
        let mut rest = along;
        for (pair, length) in line.windows(2).zip(&lengths) {
            if rest <= *length && *length > 0.0 {
                return [0, 1].map(|k| pair[0][k] + rest / length * (pair[1][k] - pair[0][k]));
            }
            rest -= length;
        }
        line[line.len() - 1]
    };
    // A line shorter than its heads has none.
    if whole < 2.0 * HEADS as f64 * HEAD[0] {
        return;
    }
    for k in 0..HEADS {
        let middle = (k as f64 + 0.5) / HEADS as f64 * whole;
        let [tail, tip] = [middle - 0.5 * HEAD[0], middle + 0.5 * HEAD[0]].map(at);
        let chord = distance(tail, tip);
        if chord > 0.5 * HEAD[0] {
            let along = [0, 1].map(|k| (tip[k] - tail[k]) / chord);
            let wing = |side: f64| {
                let across = side * HEAD[1];
                [tip[0] - HEAD[0] * along[0] - across * along[1], tip[1] - HEAD[0] * along[1] + across * along[0]]
            };
            drawing.area(vec![tip, wing(1.0), wing(-1.0)], Some(stroke.color), None, Some(clip));
        }
    }
}

fn distance(a: Point, b: Point) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}
