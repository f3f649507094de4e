//! The letters of PNG and PDF, and the widths by which all pictures are laid out: Noto Sans.
//!
//! SVG names a generic family instead and leaves the letters to the reader's own fonts.

use super::geometry::Point;
use std::sync::OnceLock;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// The outline of letters: lines and quadratic curves [pt], y downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OutlineSegment {
    /// Begins a contour.
    Move(Point),
    /// A straight line.
    Line(Point),
    /// A quadratic curve: control point and end.
    Curve(Point, Point),
    /// Ends a contour.
    Close,
}

fn face(bold: bool) -> Option<&'static Face<'static>> {
    static FACES: OnceLock<[Option<Face<'static>>; 2]> = OnceLock::new();
    let parse = |bytes: &'static [u8]| Face::parse(bytes, 0).ok();
    let faces = FACES.get_or_init(|| [parse(notosans::REGULAR_TTF), parse(notosans::BOLD_TTF)]);
    faces[usize::from(bold)].as_ref()
}

/// The glyph of a letter; the box that stands for a missing one if the font has none.
fn glyph(face: &Face<'_>, letter: char) -> GlyphId {
    face.glyph_index(letter).unwrap_or(GlyphId(0))
}

/// Width of words [pt].
pub fn width(words: &str, size: f64, bold: bool) -> f64 {
    let Some(face) = face(bold) else { return 0.0 };
    let advance = |letter: char| face.glyph_hor_advance(glyph(face, letter)).unwrap_or(0);
    let units: u32 = words.chars().map(|letter| u32::from(advance(letter))).sum();
    f64::from(units) * size / f64::from(face.units_per_em())
}

/// Hands the outline of words that begin at the origin to `each`.
pub fn outline(words: &str, size: f64, bold: bool, each: &mut dyn FnMut(OutlineSegment)) {
    let Some(face) = face(bold) else { return };
    let scale = size / f64::from(face.units_per_em());
    let mut pen = Pen { scale, start: 0.0, each };
    for letter in words.chars() {
        let glyph = glyph(face, letter);
        face.outline_glyph(glyph, &mut pen);
        pen.start += scale * f64::from(face.glyph_hor_advance(glyph).unwrap_or(0));
    }
}

struct Pen<'a> {
    scale: f64,
    start: f64,
    each: &'a mut dyn FnMut(OutlineSegment),
}

impl Pen<'_> {
    fn point(&self, x: f32, y: f32) -> Point {
        [self.start + self.scale * f64::from(x), -self.scale * f64::from(y)]
    }
}

impl OutlineBuilder for Pen<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        let point = self.point(x, y);
        (self.each)(OutlineSegment::Move(point));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let point = self.point(x, y);
        (self.each)(OutlineSegment::Line(point));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (control, point) = (self.point(x1, y1), self.point(x, y));
        (self.each)(OutlineSegment::Curve(control, point));
    }

    /// The font is TrueType, whose curves are quadratic; a cubic would be drawn through its middle.
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.quad_to(0.5 * (x1 + x2), 0.5 * (y1 + y2), x, y);
    }

    fn close(&mut self) {
        (self.each)(OutlineSegment::Close);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_of_labels_are_in_the_font() {
        for bold in [false, true] {
            let face = face(bold).unwrap();
            for letter in "azAZ09αβνωθµΩ−×·°²≥≤→…–".chars() {
                assert!(face.glyph_index(letter).is_some(), "{letter} is missing");
            }
        }
    }

    #[test]
    fn widths_scale_with_the_size() {
        let (small, large) = (width("gap [m]", 8.0, false), width("gap [m]", 16.0, false));
        assert!((large - 2.0 * small).abs() < 1e-12 && small > 20.0);
    }
}
