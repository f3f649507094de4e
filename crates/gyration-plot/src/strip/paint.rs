//! Strips on the page: one scale for all, supports hatched, times written beside the bodies, a bar for the scale.

use super::frames::{FRAMES, Outlines, Strip};
use super::ground::{Cut, Ground};
use super::silhouette::Silhouette;
use crate::chart::ticks::{length_in_words, round_step};
use crate::draw::{Anchor, Color, Label, Page, Point, Rect, Stroke, Text, color};

/// Height of times [pt].
pub(super) const TIME_SIZE: f64 = 7.5;
/// The highest a picture for all times may be [pt].
pub(super) const MOST_HEIGHT: f64 = 260.0;
/// The height aimed at for pictures of one time each, all rows together [pt].
const FRAMES_HEIGHT: f64 = 210.0;
/// Between pictures of one time each [pt].
const GUTTER: f64 = 10.0;
/// Depth of the hatching below a support [pt].
pub(super) const HATCH: f64 = 6.0;

/// Width of the line of the largest force [pt].
const WIDEST: f64 = 3.0;
/// What is weaker is drawn as if it were this part of the largest force.
const LEAST_WEIGHT: f64 = 0.05;

/// Points of an outline that are nearer to each other are one [pt].
const RESOLUTION: f64 = 0.4;
/// Bodies narrower than this are drawn without edges [pt].
const LEAST_EDGED: f64 = 8.0;
/// Beside and above what is drawn, as fractions of its longer side.
const MARGINS: [f64; 2] = [0.03, 0.012];
/// Room above a picture for the time of the highest body [pt].
const HEADROOM: f64 = 12.0;

/// From metres to points of the page.
#[derive(Clone, Copy)]
pub(super) struct PageMap {
    scale: f64,
    /// Where the lower left corner of the bounds is on the page.
    corner: Point,
    low: Point,
}

impl PageMap {
    /// Points of the page a metre, and where the lower left corner of what is shown is on it.
    pub fn new(scale: f64, corner: Point, shown: &Viewport) -> Self {
        Self { scale, corner, low: shown.low }
    }

    pub fn place(&self, point: Point) -> Point {
        [self.corner[0] + self.scale * (point[0] - self.low[0]), self.corner[1] - self.scale * (point[1] - self.low[1])]
    }

    /// A line on the page, without points that lie so near to the one before that nobody sees them.
    fn place_line(&self, line: &[Point]) -> Vec<Point> {
        let mut placed: Vec<Point> = Vec::with_capacity(line.len());
        for (index, point) in line.iter().enumerate() {
            let point = self.place(*point);
            let near = |last: &Point| libm::hypot(point[0] - last[0], point[1] - last[1]) < RESOLUTION;
            if index + 1 == line.len() || !placed.last().is_some_and(near) {
                placed.push(point);
            }
        }
        placed
    }
}

/// The rectangle of the picture's plane that is shown [m].
#[derive(Clone, Copy)]
pub(super) struct Viewport {
    pub low: Point,
    pub high: Point,
}

impl Viewport {
    pub fn width(&self) -> f64 {
        self.high[0] - self.low[0]
    }

    pub fn height(&self) -> f64 {
        self.high[1] - self.low[1]
    }

    /// Points of the page a metre, where it is at most so wide and high [pt].
    pub fn scale(&self, [width, height]: [f64; 2]) -> f64 {
        (width / self.width()).min(height / self.height())
    }

    /// All bodies, strays as far as the others reach, and the grounds next to them where they are not far off.
    pub fn of(strip: &Strip) -> Self {
        let frames = || strip.frames.iter();
        let mut bounds = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
        let silhouettes = frames().flat_map(|frame| &frame.bodies);
        let bodies = silhouettes.filter(|body| strip.shows(body.body, body.center)).flat_map(Silhouette::points);
        let paths = strip.paths.iter().enumerate().filter(|_| strip.shared);
        let paths = paths.flat_map(|(body, path)| path.iter().filter(move |point| strip.shows(body, **point)));
        bodies.chain(paths).for_each(|point| bounds.include(*point));
        if !bounds.width().is_finite() {
            return Self { low: [-1.0, -1.0], high: [1.0, 1.0] };
        }
        let reach = 1.5 * bounds.width().max(bounds.height());
        let center = [0, 1].map(|k| 0.5 * (bounds.low[k] + bounds.high[k]));
        for point in frames().flat_map(|frame| &frame.grounds).flat_map(|ground| ground.points(center)) {
            if libm::hypot(point[0] - center[0], point[1] - center[1]) < reach {
                bounds.include(point);
            }
        }
        bounds.widened()
    }

    fn include(&mut self, point: Point) {
        if point.iter().all(|c| c.is_finite()) {
            self.low = [0, 1].map(|k| self.low[k].min(point[k]));
            self.high = [0, 1].map(|k| self.high[k].max(point[k]));
        }
    }

    /// A margin around, and no side shorter than a sixth of the other.
    fn widened(&self) -> Self {
        let longest = self.width().max(self.height()).max(f64::MIN_POSITIVE);
        let (mut low, mut high) = (self.low, self.high);
        for k in [0, 1] {
            let lacking = (longest / 6.0 - (high[k] - low[k])).max(0.0);
            low[k] -= 0.5 * lacking + MARGINS[k] * longest;
            high[k] += 0.5 * lacking + MARGINS[k] * longest;
        }
        Self { low, high }
    }
}

impl Strip {
    /// Draws it from the upper edge of the area on; returns where it ends.
    pub fn draw(&self, drawing: &mut Page, area: Rect) -> f64 {
        let bounds = Viewport::of(self);
        let bottom = match self.shared {
            true => draw_shared(self, &bounds, drawing, area),
            false => draw_frames(self, &bounds, drawing, area),
        };
        self.draw_remarks(drawing, area, bottom)
    }

    /// What colours mean, and how many bodies are not drawn, below the picture; returns where they end.
    pub(super) fn draw_remarks(&self, drawing: &mut Page, area: Rect, bottom: f64) -> f64 {
        let bottom = self.draw_classes(drawing, area, bottom);
        if self.left_out > 0 {
            let words = match self.left_out {
                1 => "1 more body is not drawn".to_owned(),
                more => format!("{more} more bodies are not drawn"),
            };
            drawing.text(caption(&words, [area.x, bottom + 10.0], Anchor::Start));
            return bottom + 14.0;
        }
        bottom
    }
}

pub(super) fn caption(words: &str, at: Point, anchor: Anchor) -> Text {
    Text { label: Label::new(words), at, anchor, size: TIME_SIZE, color: color::GREY, bold: false, upright: false }
}

fn draw_shared(strip: &Strip, bounds: &Viewport, drawing: &mut Page, area: Rect) -> f64 {
    let scale = bounds.scale([area.width, MOST_HEIGHT]);
    let floor = area.y + HEADROOM + scale * bounds.height();
    let frame = Rect { height: floor + HATCH - area.y, ..area };
    // The picture stands in the middle of the width.
    let corner = [area.x + 0.5 * (area.width - scale * bounds.width()), floor];
    let map = PageMap::new(scale, corner, bounds);
    let last = strip.frames.len() - 1;
    draw_grounds(&strip.frames[last].grounds, &map, drawing, frame);
    draw_paths(strip, &map, drawing, frame);
    let hue = |body: &Silhouette| color::series(strip.hues[body.body]);
    let (clock, mut written) = (strip.clock(), Vec::<Rect>::new());
    for (index, moment) in strip.frames.iter().enumerate() {
        let age = if last == 0 { 1.0 } else { index as f64 / last as f64 };
        moment.bodies.iter().for_each(|body| draw_body((body, hue(body)), 0.12 + 0.3 * age, &map, drawing, frame));
    }
    for chain in &strip.chains {
        let stroke = Stroke::solid(color::INK, WIDEST * chain.weight.max(LEAST_WEIGHT));
        drawing.line(chain.ends.map(|end| map.place(end)).to_vec(), stroke, Some(frame));
    }
    strip.mark_strays(&strip.frames[last], (bounds, &map), drawing);
    for moment in &strip.frames {
        let words = clock.words(moment.time);
        write_time(moment, &words, &map, drawing, &mut written);
    }
    draw_scale_bar(scale, drawing, [frame.right(), frame.bottom() + 8.0]);
    frame.bottom() + 10.0
}

/// The time above the highest body, if nothing is written there yet.
fn write_time(moment: &Outlines, words: &str, map: &PageMap, drawing: &mut Page, written: &mut Vec<Rect>) {
    let top = |body: &Silhouette| {
        let heights = body.hull.iter().chain([&body.center]).map(|point| map.place(*point)[1]);
        [map.place(body.center)[0], heights.fold(f64::INFINITY, f64::min)]
    };
    let Some(top) = moment.bodies.iter().map(top).min_by(|a, b| a[1].total_cmp(&b[1])) else { return };
    let label = Label::new(words);
    let width = label.width(TIME_SIZE, false);
    let at = [top[0], top[1] - 4.0];
    let space =
        Rect { x: at[0] - 0.5 * width - 2.0, y: at[1] - TIME_SIZE, width: width + 4.0, height: TIME_SIZE + 2.0 };
    let apart = |other: &Rect| {
        space.right() < other.x || other.right() < space.x || space.bottom() < other.y || other.bottom() < space.y
    };
    if written.iter().all(apart) {
        drawing.area(space.corners().to_vec(), Some(color::WHITE.faded(0.8)), None, None);
        drawing.text(Text { label, ..caption("", at, Anchor::Middle) });
        written.push(space);
    }
}

fn draw_frames(strip: &Strip, bounds: &Viewport, drawing: &mut Page, area: Rect) -> f64 {
    let count = strip.frames.len();
    let pitch = |columns: usize| (area.width + GUTTER) / columns as f64;
    let cell_height = |columns: usize| (pitch(columns) - GUTTER) * bounds.height() / bounds.width();
    let row_height = |columns: usize| cell_height(columns).min(MOST_HEIGHT) + HATCH + 2.0 * TIME_SIZE;
    let height = |columns: usize| count.div_ceil(columns) as f64 * row_height(columns);
    let miss = |columns: usize| (height(columns) - FRAMES_HEIGHT).abs();
    let full = |columns: &usize| count.is_multiple_of(*columns) || count < FRAMES;
    let columns = (1..=count).filter(full).min_by(|a, b| miss(*a).total_cmp(&miss(*b))).unwrap_or(1);
    let cell_width = pitch(columns) - GUTTER;
    let scale = bounds.scale([cell_width, MOST_HEIGHT]);
    let size = [scale * bounds.width(), scale * bounds.height()];
    let clock = strip.clock();
    for (index, moment) in strip.frames.iter().enumerate() {
        let x = area.x + pitch(columns) * (index % columns) as f64 + 0.5 * (cell_width - size[0]);
        let y = area.y + row_height(columns) * (index / columns) as f64;
        let cell = Rect { x, y, width: size[0], height: size[1] + HATCH };
        let map = PageMap::new(scale, [x, y + size[1]], bounds);
        draw_grounds(&moment.grounds, &map, drawing, cell);
        draw_bodies(strip, moment, &map, drawing, cell);
        strip.mark_strays(moment, (bounds, &map), drawing);
        let at = [x + 0.5 * size[0], cell.bottom() + 1.1 * TIME_SIZE];
        drawing.text(caption(&clock.words(moment.time), at, Anchor::Middle));
    }
    let bottom = area.y + height(columns);
    draw_scale_bar(scale, drawing, [area.right(), bottom + 8.0]);
    bottom + 12.0
}

fn draw_paths(strip: &Strip, map: &PageMap, drawing: &mut Page, frame: Rect) {
    for (body, path) in strip.paths.iter().enumerate() {
        let stroke = Stroke { color: color::series(strip.hues[body]).faded(0.55), width: 0.6, dash: &[2.0, 2.0] };
        drawing.line(map.place_line(path), stroke, Some(frame));
    }
}

/// The bodies at a time.
pub(super) fn draw_bodies(strip: &Strip, moment: &Outlines, map: &PageMap, drawing: &mut Page, frame: Rect) {
    let hue = |body: &Silhouette| color::series(strip.hues[body.body]);
    moment.bodies.iter().for_each(|body| draw_body((body, hue(body)), 0.3, map, drawing, frame));
}

fn draw_body((body, hue): (&Silhouette, Color), strength: f64, map: &PageMap, drawing: &mut Page, frame: Rect) {
    let placed = |lines: &[Vec<Point>]| lines.iter().map(|line| map.place_line(line)).collect::<Vec<_>>();
    let hull = map.place_line(&body.hull);
    if hull.len() < 3 {
        drawing.dot(map.place(body.center), 1.5, hue, Some(frame));
        return;
    }
    // Thinner where the body is small on the page, so that its edges do not run together.
    let extents = [0, 1].map(|k| {
        let range = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = hull.iter().fold(range, |(low, high), point| (low.min(point[k]), high.max(point[k])));
        high - low
    });
    let extent = extents[0];
    let width = (0.02 * extent).clamp(0.25, 0.8);
    let ink = hue.faded((0.45 + strength).min(1.0));
    drawing.area(hull.clone(), Some(hue.tint(strength).faded(0.85)), None, Some(frame));
    if extent > LEAST_EDGED {
        drawing.lines(placed(&body.behind), Stroke::solid(hue.faded(0.18), 0.5 * width), Some(frame));
        drawing.lines(placed(&body.front), Stroke::solid(ink, 0.6 * width), Some(frame));
    }
    drawing.area(hull, None, Some(Stroke::solid(ink, width)), Some(frame));
    if body.lopsided && extent > LEAST_EDGED {
        drawing.dot(map.place(body.center), (0.05 * extents[0].min(extents[1])).clamp(0.5, 1.8), ink, Some(frame));
    }
}

/// The supports, behind everything else.
pub(super) fn draw_grounds(grounds: &[Ground], map: &PageMap, drawing: &mut Page, frame: Rect) {
    for ground in grounds {
        match ground {
            Ground::Cut(cut) => draw_cut(cut, map, drawing, frame),
            Ground::Solid(areas) => {
                for area in areas {
                    drawing.area(map.place_line(area), Some(color::GREY.tint(0.3)), None, Some(frame));
                }
            }
            Ground::Patch { corners, grid } => {
                let corners = map.place_line(corners);
                let lines = grid.iter().map(|line| map.place_line(line)).collect();
                drawing.area(corners.clone(), Some(color::GREY.tint(0.12)), None, Some(frame));
                drawing.lines(lines, Stroke::solid(color::GREY.faded(0.45), 0.3), Some(frame));
                drawing.area(corners, None, Some(Stroke::solid(color::GREY, 0.5)), Some(frame));
            }
        }
    }
}

/// The line of a support through the frame and hatching on its far side.
fn draw_cut(ground: &Cut, map: &PageMap, drawing: &mut Page, frame: Rect) {
    let center = [frame.x + 0.5 * frame.width, frame.y + 0.5 * frame.height];
    let origin = map.place(ground.origin);
    // The page counts downwards.
    let normal = [ground.normal[0], -ground.normal[1]];
    let along = [-normal[1], normal[0]];
    let offset = (center[0] - origin[0]) * along[0] + (center[1] - origin[1]) * along[1];
    let middle = [0, 1].map(|k| origin[k] + offset * along[k]);
    let reach = 0.5 * libm::hypot(frame.width, frame.height);
    let at = |s: f64, depth: f64| [0, 1].map(|k| middle[k] + s * along[k] - depth * normal[k]);
    let strokes = (reach / HATCH).ceil() as i64;
    // Of the two ways to lean, the one that is nearer to the vertical.
    let lean = if along[1] > 0.1 { HATCH } else { -HATCH };
    let hatch = (-strokes..=strokes).map(|k| {
        let s = HATCH * k as f64;
        vec![at(s, 0.0), at(s + lean, HATCH)]
    });
    drawing.lines(hatch.collect(), Stroke::solid(color::GREY, 0.4), Some(frame));
    drawing.line(vec![at(-reach, 0.0), at(reach, 0.0)], Stroke::solid(color::INK, 0.9), Some(frame));
}

/// A bar of a round length, with its length, ending at the point.
pub(super) fn draw_scale_bar(scale: f64, drawing: &mut Page, end: Point) {
    let length = round_step(90.0 / scale, 3);
    let words = length_in_words(length);
    let label = Label::new(&words);
    let x = end[0] - scale * length;
    let bar = vec![
        vec![[x, end[1] - 2.0], [x, end[1] + 2.0]],
        vec![[x, end[1]], end],
        vec![[end[0], end[1] - 2.0], [end[0], end[1] + 2.0]],
    ];
    drawing.lines(bar, Stroke::solid(color::GREY, 0.8), None);
    drawing.text(Text { label, ..caption("", [x - 4.0, end[1] + 0.35 * TIME_SIZE], Anchor::End) });
}
