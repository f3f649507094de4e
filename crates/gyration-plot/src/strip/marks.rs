//! Words on a strip: the names of bodies that have left it, at the edge by which they did, and what colours mean where
//! they do not stand for single bodies.

use super::frames::{Outlines, Strip};
use super::paint::{PageMap, TIME_SIZE, Viewport, caption};
use crate::draw::{Anchor, Label, Page, Point, Rect, Text, color};

/// Length of the head of an arrow at the edge [pt].
const ARROW: f64 = 5.0;
/// Side of a sample of a colour [pt].
const SWATCH: f64 = 6.0;
/// Height of a line of classes [pt].
const LEADING: f64 = 11.0;

impl Strip {
    /// Whether a body with its centre at this point of the picture [m] is to be seen.
    pub fn shows(&self, body: usize, center: Point) -> bool {
        let ([x, y], radius) = self.room;
        let is_stray = self.strays.iter().any(|(stray, _)| *stray == body);
        !is_stray || libm::hypot(center[0] - x, center[1] - y) <= radius
    }

    /// An arrow and the name of each body that is beyond the edge.
    pub(super) fn mark_strays(&self, moment: &Outlines, (bounds, map): (&Viewport, &PageMap), drawing: &mut Page) {
        let center = [0, 1].map(|k| 0.5 * (bounds.low[k] + bounds.high[k]));
        let half = [0, 1].map(|k| 0.5 * (bounds.high[k] - bounds.low[k]));
        for (body, name) in &self.strays {
            let Some(seen) = moment.bodies.iter().find(|seen| seen.body == *body) else { continue };
            let away = [0, 1].map(|k| seen.center[k] - center[k]);
            let beyond = (away[0].abs() / half[0]).max(away[1].abs() / half[1]);
            if beyond.is_nan() || beyond <= 1.0 {
                continue;
            }
            let tip = map.place([0, 1].map(|k| center[k] + away[k] / beyond));
            // The page counts downwards.
            let length = libm::hypot(away[0], away[1]);
            let along = [away[0] / length, -away[1] / length];
            let at = |back: f64, aside: f64| {
                [tip[0] - back * along[0] - aside * along[1], tip[1] - back * along[1] + aside * along[0]]
            };
            let hue = color::series(self.hues[*body]);
            drawing.area(vec![tip, at(ARROW, 0.5 * ARROW), at(ARROW, -0.5 * ARROW)], Some(hue), None, None);
            let anchor = match along[0] {
                x if x > 0.4 => Anchor::End,
                x if x < -0.4 => Anchor::Start,
                _ => Anchor::Middle,
            };
            let [x, y] = at(ARROW + 3.0, 0.0);
            drawing.text(caption(name, [x, y + 0.35 * TIME_SIZE], anchor));
        }
    }

    /// The classes in lines below the picture; returns where they end.
    pub(super) fn draw_classes(&self, drawing: &mut Page, area: Rect, bottom: f64) -> f64 {
        let mut at = [area.x, bottom + LEADING];
        for (class, name) in self.classes.iter().enumerate() {
            let width = SWATCH + 4.0 + Label::new(name).width(TIME_SIZE, false);
            if at[0] > area.x && at[0] + width > area.right() {
                at = [area.x, at[1] + LEADING];
            }
            let swatch = Rect { x: at[0], y: at[1] - SWATCH, width: SWATCH, height: SWATCH };
            drawing.area(swatch.corners().to_vec(), Some(color::series(class)), None, None);
            let words = caption(name, [at[0] + SWATCH + 4.0, at[1]], Anchor::Start);
            drawing.text(Text { color: color::INK, ..words });
            at[0] += width + 12.0;
        }
        if self.classes.is_empty() { bottom } else { at[1] + 4.0 }
    }
}
