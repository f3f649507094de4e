//! Figures: a title and panels below each other, their frames in line.
//!
//! Charts that follow each other over the same axis share its words.

use crate::chart::frame::{self, BELOW, Content, NAME_SIZE, words_at};
use crate::chart::{Chart, LEGEND_SIZE, Legend, ShapeChart, Shapes};
use crate::draw::{Anchor, Film, Format, Label, Page, Rect, Text, color, font};
use crate::strip::{Motion, Strip};

/// Width of a page [pt]: fits between the margins of A4 and letter paper.
const WIDTH: f64 = 540.0;
/// Around everything [pt].
const MARGIN: f64 = 12.0;
/// Between the frame and the legend [pt].
const BESIDE: f64 = 12.0;
/// Above a frame: its title [pt].
const ABOVE: f64 = 22.0;
/// Between charts that share an axis [pt].
const BETWEEN: f64 = 8.0;
/// Height of the letters of the title [pt].
const TITLE_SIZE: f64 = 12.0;

/// One part of a figure.
#[derive(Debug, Clone, PartialEq)]
pub enum Panel {
    /// Series over axes.
    Chart(Chart),
    /// Series over axes, with areas, dots or intervals under them.
    ShapeChart(ShapeChart),
    /// Outlines at successive times.
    Strip(Strip),
    /// Outlines that move.
    Motion(Motion),
}

impl Panel {
    /// The chart, unless it shows bodies.
    fn chart(&self) -> Option<&Chart> {
        match self {
            Self::Chart(chart) => Some(chart),
            Self::ShapeChart(field) => Some(&field.chart),
            Self::Strip(_) | Self::Motion(_) => None,
        }
    }

    /// What stands under the series.
    fn shapes(&self) -> &[Shapes] {
        if let Self::ShapeChart(field) = self { &field.shapes } else { &[] }
    }
}

/// Panels under a title.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// What it is about, in plain words.
    pub title: String,
    /// A second line, in plain words.
    pub subtitle: String,
    /// From above to below.
    pub panels: Vec<Panel>,
}

/// The left and the right edge of all frames [pt].
struct FrameEdges {
    left: f64,
    right: f64,
}

impl Figure {
    /// The bytes of its picture.
    pub fn render(&self, format: Format) -> Vec<u8> {
        self.draw().render(format)
    }

    /// What moves on it, as pictures that follow one another; of what does not move, one picture.
    pub fn film(&self) -> Film {
        Film::of(&self.draw())
    }

    /// Lays the figure out and draws it.
    pub fn draw(&self) -> Page {
        let edges = self.edges();
        let mut drawing = Page::new(WIDTH, 0.0, self.title.clone());
        let mut y = self.draw_title(&mut drawing);
        for (index, panel) in self.panels.iter().enumerate() {
            let area = Rect { x: MARGIN, y: y + MARGIN, width: WIDTH - 2.0 * MARGIN, height: 0.0 };
            y = match panel {
                Panel::Strip(strip) => strip.draw(&mut drawing, area) + MARGIN,
                Panel::Motion(motion) => motion.draw(&mut drawing, area) + MARGIN,
                Panel::Chart(chart) | Panel::ShapeChart(ShapeChart { chart, .. }) => {
                    let next = self.panels.get(index + 1).and_then(Panel::chart);
                    let with_words = next.is_none_or(|next| next.x != chart.x);
                    let content = Content { chart, shapes: panel.shapes(), with_words };
                    draw_chart(&content, &mut drawing, &edges, y)
                }
            };
        }
        drawing.height = (y + 0.5 * MARGIN).ceil();
        drawing
    }

    /// One left edge and one width for all frames; the legends' column is as wide as the widest.
    fn edges(&self) -> FrameEdges {
        let charts = || self.panels.iter().filter_map(|panel| panel.chart());
        let left = charts().map(frame::left_margin).fold(0.0, f64::max);
        let legend = charts().map(|chart| chart.legend().width()).fold(0.0, f64::max);
        let right = if legend > 0.0 { legend + BESIDE } else { 0.0 };
        FrameEdges { left: MARGIN + left, right: WIDTH - MARGIN - right }
    }

    /// Draws the title; returns where it ends.
    fn draw_title(&self, drawing: &mut Page) -> f64 {
        let line = |words: &str, y: f64, size: f64| Text {
            label: Label::plain(words),
            ..words_at("", [MARGIN, y], Anchor::Start, size, color::INK)
        };
        let mut y = MARGIN;
        if !self.title.is_empty() {
            y += TITLE_SIZE;
            drawing.text(Text { bold: true, ..line(&self.title, y, TITLE_SIZE) });
        }
        for (number, words) in in_lines(&self.subtitle).iter().enumerate() {
            y += if number == 0 { 1.6 } else { 1.3 } * LEGEND_SIZE;
            drawing.text(Text { color: color::GREY, ..line(words, y, LEGEND_SIZE) });
        }
        y + 0.5 * MARGIN
    }
}

/// Words in lines as wide as the page.
fn in_lines(words: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split(' ').filter(|word| !word.is_empty()) {
        match lines.last_mut() {
            Some(line) if font::width(&format!("{line} {word}"), LEGEND_SIZE, false) < WIDTH - 2.0 * MARGIN => {
                *line += " ";
                *line += word;
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Draws a chart below `y`; returns where it ends.
fn draw_chart(content: &Content, drawing: &mut Page, edges: &FrameEdges, y: f64) -> f64 {
    let chart = content.chart;
    let above = if chart.title.is_empty() { BETWEEN } else { ABOVE };
    let legend: Legend = chart.legend();
    let height = chart.height.max(legend.height());
    let area = Rect { x: edges.left, y: y + above, width: edges.right - edges.left, height };
    frame::draw(content, drawing, area);
    legend.draw(drawing, [area.right() + BESIDE, area.y]);
    area.bottom() + if content.with_words { BELOW + 0.5 * NAME_SIZE } else { BETWEEN }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_subtitles_are_broken_between_words() {
        assert_eq!(in_lines("came to rest"), ["came to rest"]);
        assert!(in_lines("").is_empty());
        let words =
            "stopped at t = 1.234567 s: the smallest gap between the body and its support has closed ".repeat(3);
        let lines = in_lines(&words);
        assert!(lines.len() > 1 && lines.iter().all(|line| font::width(line, LEGEND_SIZE, false) < WIDTH), "{lines:?}");
        assert_eq!(lines.join(" "), words.trim());
    }
}
