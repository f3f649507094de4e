//! A drawing as PNG: three pixels a point (216 dpi), letters as outlines.

use super::color::Color;
use super::font::OutlineSegment;
use super::geometry::Rect;
use super::marks::{Mark, Page, Path, Stroke, Text};
use tiny_skia::{FillRule, LineCap, LineJoin, Mask, Paint, PathBuilder, Pixmap, StrokeDash, Transform};

/// Pixels a point.
const SCALE: f32 = 3.0;
/// Largest side of a picture [pixels]; a longer one is scaled down.
const MOST_PIXELS: f32 = 16_000.0;

/// The bytes of the PNG file.
pub fn render(drawing: &Page) -> Vec<u8> {
    let longest = drawing.width.max(drawing.height) as f32;
    let scale = SCALE.min(MOST_PIXELS / longest);
    let side = |length: f64| ((length as f32 * scale).ceil() as u32).max(1);
    let size = [side(drawing.width), side(drawing.height)];
    let pixels = pixels(size, scale, drawing.still());
    pixels.and_then(|pixels| pixels.encode_png().ok()).unwrap_or_default()
}

/// Marks on white, so many pixels a point.
pub(super) fn pixels<'a>(
    [width, height]: [u32; 2],
    scale: f32,
    marks: impl Iterator<Item = &'a Mark>,
) -> Option<Pixmap> {
    let pixmap = Pixmap::new(width, height)?;
    let mut canvas = Canvas { pixmap, transform: Transform::from_scale(scale, scale), mask: None };
    canvas.pixmap.fill(tiny_skia::Color::WHITE);
    for mark in marks {
        match mark {
            Mark::Path(path) => canvas.path(path),
            Mark::Text(text) => canvas.text(text),
        }
    }
    Some(canvas.pixmap)
}

struct Canvas {
    pixmap: Pixmap,
    transform: Transform,
    /// The mask of the clip that was used last.
    mask: Option<(Rect, Mask)>,
}

impl Canvas {
    fn path(&mut self, path: &Path) {
        let mut builder = PathBuilder::new();
        for line in path.lines.iter().filter(|line| line.len() > 1) {
            for (index, point) in line.iter().enumerate() {
                let [x, y] = point.map(|c| c as f32);
                if index == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
            }
            if path.closed {
                builder.close();
            }
        }
        let Some(outline) = builder.finish() else { return };
        self.prepare_mask(path.clip);
        let mask = path.clip.and(self.mask.as_ref()).map(|(_, mask)| mask);
        if let Some(fill) = &path.fill {
            let paint = paint(fill);
            self.pixmap.fill_path(&outline, &paint, FillRule::Winding, self.transform, mask);
        }
        if let Some(stroke) = &path.stroke {
            let paint = paint(&stroke.color);
            self.pixmap.stroke_path(&outline, &paint, &line_style(stroke), self.transform, mask);
        }
    }

    fn prepare_mask(&mut self, clip: Option<Rect>) {
        let Some(clip) = clip else { return };
        if self.mask.as_ref().is_some_and(|(other, _)| *other == clip) {
            return;
        }
        let [x, y, width, height] = [clip.x, clip.y, clip.width, clip.height].map(|c| c as f32);
        let Some(mut mask) = Mask::new(self.pixmap.width(), self.pixmap.height()) else { return };
        if let Some(rect) = tiny_skia::Rect::from_xywh(x, y, width, height) {
            mask.fill_path(&PathBuilder::from_rect(rect), FillRule::Winding, true, self.transform);
        }
        self.mask = Some((clip, mask));
    }

    fn text(&mut self, text: &Text) {
        let mut builder = PathBuilder::new();
        text.trace(&mut |segment| {
            let as_f32 = |point: [f64; 2]| point.map(|c| c as f32);
            match segment {
                OutlineSegment::Move(p) => builder.move_to(as_f32(p)[0], as_f32(p)[1]),
                OutlineSegment::Line(p) => builder.line_to(as_f32(p)[0], as_f32(p)[1]),
                OutlineSegment::Curve(c, p) => {
                    let ([cx, cy], [x, y]) = (as_f32(c), as_f32(p));
                    builder.quad_to(cx, cy, x, y);
                }
                OutlineSegment::Close => builder.close(),
            }
        });
        let Some(outline) = builder.finish() else { return };
        let paint = paint(&text.color);
        self.pixmap.fill_path(&outline, &paint, FillRule::Winding, self.transform, None);
    }
}

fn paint(color: &Color) -> Paint<'static> {
    let [red, green, blue] = color.rgb;
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(red, green, blue, (255.0 * color.opacity).round() as u8);
    paint
}

fn line_style(stroke: &Stroke) -> tiny_skia::Stroke {
    let dash: Vec<f32> = stroke.dash.iter().map(|length| *length as f32).collect();
    let cap = if dash.is_empty() { LineCap::Round } else { LineCap::Butt };
    tiny_skia::Stroke {
        width: stroke.width as f32,
        line_cap: cap,
        line_join: LineJoin::Round,
        dash: StrokeDash::new(dash, 0.0),
        ..tiny_skia::Stroke::default()
    }
}
