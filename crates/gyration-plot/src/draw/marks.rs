//! Marks on a page: lines, areas, labels.

use super::color::Color;
use super::font::{self, OutlineSegment};
use super::geometry::{Point, Rect};
use super::label::Label;

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Colour.
    pub color: Color,
    /// Width [pt].
    pub width: f64,
    /// Lengths of dashes and of the gaps between them [pt]; empty: solid.
    pub dash: &'static [f64],
}

impl Stroke {
    /// A solid line.
    pub fn solid(color: Color, width: f64) -> Self {
        Self { color, width, dash: &[] }
    }
}

/// Where a label stands relative to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// It begins there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

impl Anchor {
    /// The fraction of the width that stands before the point.
    fn fraction(self) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Middle => 0.5,
            Self::End => 1.0,
        }
    }
}

/// A label on the page; the point is on its base line.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// The words.
    pub label: Label,
    /// Where [pt].
    pub at: Point,
    /// Which part of the label is there.
    pub anchor: Anchor,
    /// Height of the letters [pt].
    pub size: f64,
    /// Colour.
    pub color: Color,
    /// Whether the letters are bold.
    pub bold: bool,
    /// Whether the label reads from below to above.
    pub upright: bool,
}

impl Text {
    /// Hands the outlines of the letters, in their place on the page, to `each`.
    pub(super) fn trace(&self, each: &mut dyn FnMut(OutlineSegment)) {
        let mut along = -self.anchor.fraction() * self.label.width(self.size, self.bold);
        for (level, words) in &self.label.parts {
            let (scale, shift) = level.size_and_shift();
            let size = self.size * scale;
            let place = |[x, y]: [f64; 2]| {
                let (x, y) = (along + x, y - shift * self.size);
                let (x, y) = if self.upright { (y, -x) } else { (x, y) };
                [self.at[0] + x, self.at[1] + y]
            };
            font::outline(words, size, self.bold, &mut |segment| {
                each(match segment {
                    OutlineSegment::Move(p) => OutlineSegment::Move(place(p)),
                    OutlineSegment::Line(p) => OutlineSegment::Line(place(p)),
                    OutlineSegment::Curve(c, p) => OutlineSegment::Curve(place(c), place(p)),
                    OutlineSegment::Close => OutlineSegment::Close,
                });
            });
            along += font::width(words, size, self.bold);
        }
    }
}

/// Lines through points, all drawn in one way; closed ones may be filled.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// The lines.
    pub lines: Vec<Vec<Point>>,
    /// Whether each line returns to its first point.
    pub closed: bool,
    /// How it is drawn, if it is.
    pub stroke: Option<Stroke>,
    /// What it is filled with, if it is.
    pub fill: Option<Color>,
    /// What lies outside of this is not drawn.
    pub clip: Option<Rect>,
}

/// One thing on the page.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// Lines and areas.
    Path(Path),
    /// A label.
    Text(Text),
}

/// Marks that are seen for a while, again and again.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// The marks.
    pub marks: Vec<Mark>,
    /// When they are first seen, as a part of the whole.
    pub begin: f64,
    /// When they are last seen, likewise.
    pub end: f64,
    /// How long the whole takes [s].
    pub lasts: f64,
    /// Whether it is seen where nothing moves.
    pub is_still: bool,
}

/// A page.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// Width [pt].
    pub width: f64,
    /// Height [pt].
    pub height: f64,
    /// What it shows, for readers that cannot see it.
    pub title: String,
    /// From the lowest to the uppermost.
    pub marks: Vec<Mark>,
    /// What is seen above these for a while, one after the other.
    pub moments: Vec<Moment>,
}

impl Page {
    /// An empty page.
    pub fn new(width: f64, height: f64, title: impl Into<String>) -> Self {
        Self { width, height, title: title.into(), marks: Vec::new(), moments: Vec::new() }
    }

    /// What is seen where nothing moves.
    pub(super) fn still(&self) -> impl Iterator<Item = &Mark> {
        let still = self.moments.iter().filter(|moment| moment.is_still);
        self.marks.iter().chain(still.flat_map(|moment| &moment.marks))
    }

    /// Draws one open line.
    pub fn line(&mut self, points: Vec<Point>, stroke: Stroke, clip: Option<Rect>) {
        self.lines(vec![points], stroke, clip);
    }

    /// Draws open lines.
    pub fn lines(&mut self, lines: Vec<Vec<Point>>, stroke: Stroke, clip: Option<Rect>) {
        self.marks.push(Mark::Path(Path { lines, closed: false, stroke: Some(stroke), fill: None, clip }));
    }

    /// Draws an area.
    pub fn area(&mut self, points: Vec<Point>, fill: Option<Color>, stroke: Option<Stroke>, clip: Option<Rect>) {
        self.marks.push(Mark::Path(Path { lines: vec![points], closed: true, stroke, fill, clip }));
    }

    /// Draws a dot.
    pub fn dot(&mut self, center: Point, radius: f64, fill: Color, clip: Option<Rect>) {
        const CORNERS: usize = 16;
        let corner = |k: usize| {
            let (sine, cosine) = libm::sincos(std::f64::consts::TAU * k as f64 / CORNERS as f64);
            [center[0] + radius * cosine, center[1] + radius * sine]
        };
        self.area((0..CORNERS).map(corner).collect(), Some(fill), None, clip);
    }

    /// Writes a label.
    pub fn text(&mut self, text: Text) {
        self.marks.push(Mark::Text(text));
    }
}
