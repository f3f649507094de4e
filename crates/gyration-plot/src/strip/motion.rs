//! The bodies as they move: a strip whose times follow one another in one place.
//!
//! A round number of times slower or faster than they do, so that it takes some seconds; the last time stays for a
//! while.

use super::frames::{Outlines, Strip};
use super::paint::{
    HATCH, MOST_HEIGHT, PageMap, TIME_SIZE, Viewport, caption, draw_bodies, draw_grounds, draw_scale_bar,
};
use crate::draw::{Anchor, Moment, Page, Rect};
use crate::error::PlotError;
use crate::recorded::RecordedScene;

/// The times that are shown.
const TIMES: usize = 80;
/// How long the whole takes, at least and at most [s].
const LASTS: [f64; 2] = [3.0, 8.0];
/// How long the last time stays [s].
const STAYS: f64 = 0.8;
/// The time of which a picture that does not move is, as a part of all.
const STILL: f64 = 0.4;

/// The bodies as they move.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    strip: Strip,
    supports_move: bool,
    pace: Pace,
}

/// How fast a motion is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Pace {
    /// So many times slower.
    Slowed(f64),
    /// So many times faster.
    Quickened(f64),
}

impl Pace {
    /// For a motion that takes so long [s].
    fn of(span: f64) -> Self {
        let round = (-12..=12).flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * libm::pow(10.0, f64::from(power))));
        let mut factors = round.filter(|factor| *factor >= 1.0);
        if span < LASTS[0] {
            let slow = factors.find(|factor| span * factor >= LASTS[0]);
            return Self::Slowed(slow.unwrap_or(1.0));
        }
        Self::Quickened(factors.find(|factor| span / factor <= LASTS[1]).unwrap_or(1.0))
    }

    /// Seconds in which a second of the motion is shown.
    fn factor(self) -> f64 {
        match self {
            Self::Slowed(factor) => factor,
            Self::Quickened(factor) => 1.0 / factor,
        }
    }

    fn words(self) -> String {
        match self {
            Self::Slowed(1.0) | Self::Quickened(1.0) => "in real time".to_owned(),
            Self::Slowed(factor) => format!("slowed {factor} times"),
            Self::Quickened(factor) => format!("{factor} times as fast"),
        }
    }
}

impl Motion {
    /// Of a recording.
    ///
    /// # Errors
    /// [`PlotError`] where it cannot be read or has no samples.
    pub fn of(recorded: &RecordedScene) -> Result<Self, PlotError> {
        let (strip, supports_move) = Strip::of_times(recorded, TIMES)?;
        let pace = Pace::of(span(&strip.frames));
        Ok(Self { strip, supports_move, pace })
    }

    /// Draws it from the upper edge of the area on; returns where it ends.
    pub fn draw(&self, drawing: &mut Page, area: Rect) -> f64 {
        let (strip, frames) = (&self.strip, &self.strip.frames);
        let bounds = Viewport::of(strip);
        let scale = bounds.scale([area.width, MOST_HEIGHT]);
        let floor = area.y + scale * bounds.height();
        let frame = Rect { height: floor + HATCH - area.y, ..area };
        // The picture stands in the middle of the width.
        let map = PageMap::new(scale, [area.x + 0.5 * (area.width - scale * bounds.width()), floor], &bounds);
        let still = (STILL * frames.len() as f64) as usize;
        if !self.supports_move
            && let Some(shown) = frames.get(still)
        {
            draw_grounds(&shown.grounds, &map, drawing, frame);
        }
        let (clock, lasts) = (strip.clock(), self.pace.factor() * span(frames) + STAYS);
        let at = [area.x, frame.bottom() + 8.0 + 0.35 * TIME_SIZE];
        for (index, shown) in frames.iter().enumerate() {
            let mut page = Page::new(drawing.width, drawing.height, "");
            if self.supports_move {
                draw_grounds(&shown.grounds, &map, &mut page, frame);
            }
            draw_bodies(strip, shown, &map, &mut page, frame);
            strip.mark_strays(shown, (&bounds, &map), &mut page);
            page.text(caption(&clock.words(shown.time), at, Anchor::Start));
            let part = |time: f64| self.pace.factor() * (time - frames[0].time) / lasts;
            let end = frames.get(index + 1).map_or(1.0, |next| part(next.time));
            let moment = Moment { marks: page.marks, begin: part(shown.time), end, lasts, is_still: index == still };
            drawing.moments.push(moment);
        }
        drawing.text(caption(&self.pace.words(), [area.x + 0.5 * area.width, at[1]], Anchor::Middle));
        draw_scale_bar(scale, drawing, [frame.right(), frame.bottom() + 8.0]);
        strip.draw_remarks(drawing, area, frame.bottom() + 10.0)
    }
}

/// How long it takes [s].
fn span(frames: &[Outlines]) -> f64 {
    frames.first().zip(frames.last()).map_or(0.0, |(first, last)| last.time - first.time)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motions_take_some_seconds_by_a_round_factor() {
        let told = |span: f64| Pace::of(span).words();
        assert_eq!([told(3.0), told(8.0), told(0.32)], ["in real time", "in real time", "slowed 10 times"]);
        assert_eq!(
            [told(1e-6), told(20.0), told(3600.0)],
            ["slowed 5000000 times", "5 times as fast", "500 times as fast"]
        );
        for span in [1e-9, 0.1, 2.9, 30.0, 1e6] {
            let shown = span * Pace::of(span).factor();
            assert!((LASTS[0]..=LASTS[1]).contains(&shown), "{span}: {shown}");
        }
        assert_eq!(told(0.0), "in real time");
    }
}
