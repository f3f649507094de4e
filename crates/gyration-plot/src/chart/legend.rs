//! Legends: a column of names, each with a piece of its line.

use crate::draw::{Anchor, Label, Page, Point, Stroke, Text, color};

/// Height of the letters [pt].
pub const SIZE: f64 = 8.0;
/// From one entry to the next [pt].
pub const LEADING: f64 = 12.5;
/// Length of the piece of line [pt].
const SAMPLE: f64 = 18.0;
/// Between the piece of line and the name [pt].
const SPACE: f64 = 5.0;
/// A stroke wider than this tells the colour of areas or dots: its sample is a square [pt].
const WIDEST_LINE: f64 = 4.0;
/// Names longer than this are cut [letters].
const LONGEST_NAME: usize = 34;

/// Names of what is drawn.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Legend {
    rows: Vec<(Label, Option<Stroke>)>,
}

impl Legend {
    /// Adds a name with its line.
    pub fn entry(&mut self, name: &str, stroke: Stroke) {
        self.rows.push((Label::new(&cut(name)), Some(stroke)));
    }

    /// Adds words without a line.
    pub fn remark(&mut self, words: &str) {
        self.rows.push((Label::new(words), None));
    }

    /// Width [pt]; 0 without entries.
    pub fn width(&self) -> f64 {
        let indent = |sampled: bool| if sampled { SAMPLE + SPACE } else { 0.0 };
        let row = |(label, stroke): &(Label, Option<Stroke>)| indent(stroke.is_some()) + label.width(SIZE, false);
        self.rows.iter().map(row).fold(0.0, f64::max)
    }

    /// Height [pt].
    pub fn height(&self) -> f64 {
        LEADING * self.rows.len() as f64
    }

    /// Draws it with its upper left corner at the point.
    pub fn draw(&self, drawing: &mut Page, corner: Point) {
        for (row, (label, stroke)) in self.rows.iter().enumerate() {
            let [x, y] = [corner[0], corner[1] + LEADING * (row as f64 + 0.5)];
            let indent = match stroke {
                Some(stroke) if stroke.width > WIDEST_LINE => {
                    let half = 0.5 * stroke.width;
                    let [left, right] = [x + 0.5 * SAMPLE - half, x + 0.5 * SAMPLE + half];
                    let corners = vec![[left, y - half], [right, y - half], [right, y + half], [left, y + half]];
                    drawing.area(corners, Some(stroke.color), None, None);
                    SAMPLE + SPACE
                }
                Some(stroke) => {
                    drawing.line(vec![[x, y], [x + SAMPLE, y]], *stroke, None);
                    SAMPLE + SPACE
                }
                None => 0.0,
            };
            drawing.text(Text {
                label: label.clone(),
                at: [x + indent, y + 0.35 * SIZE],
                anchor: Anchor::Start,
                size: SIZE,
                color: if stroke.is_some() { color::INK } else { color::GREY },
                bold: false,
                upright: false,
            });
        }
    }
}

/// A name of bearable length.
fn cut(name: &str) -> String {
    if name.chars().count() <= LONGEST_NAME {
        return name.to_owned();
    }
    name.chars().take(LONGEST_NAME - 1).chain(['…']).collect()
}
